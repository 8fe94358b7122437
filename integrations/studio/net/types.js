// SPDX-License-Identifier: Apache-2.0
// Types of the messages of the protocol (docs/dev/studio-protocol.md). This module has no code.

/** @typedef {[number, number, number]} Triple */

/**
 * @typedef {object} Look
 * @property {Triple} from
 * @property {Triple} to
 * @property {Triple} up
 */

/**
 * @typedef {object} Budget
 * @property {number | null} samples
 * @property {number | null} noise
 * @property {number | null} seconds
 */

/**
 * @typedef {object} SceneState
 * @property {number} epoch
 * @property {string[]} edits
 * @property {string} [content] a name for what the scene contains: its files with the edits
 * @property {number} undo
 * @property {number} redo
 * @property {boolean} saved
 * @property {[number, number]} size
 * @property {[number, number, number, number] | null} region
 * @property {number} scale
 * @property {string} camera
 * @property {string[]} cameras
 * @property {Look | null} look
 * @property {number} fov horizontal field of view in degrees
 * @property {number} [gamma] of the options, for integer files
 * @property {string[]} layers
 * @property {string[]} available_layers
 * @property {string[]} light_layers
 * @property {number} unit_luminance
 * @property {string} [unit_luminance_source]
 * @property {boolean} paused
 * @property {Budget} budget
 * @property {boolean} look_stored
 * @property {{latitude: number, longitude: number, time: string, north?: number, haze?: number} | null} [daylight]
 * @property {{min: Triple, max: Triple} | null} [bounds]
 * @property {{shader: string, parameters?: Record<string, number>}} [exposure]
 */

/**
 * @typedef {object} Progress
 * @property {number} epoch
 * @property {number} divider
 * @property {number} pass
 * @property {number} samples
 * @property {number | null} noise
 * @property {number} elapsed
 * @property {number | null} remaining
 * @property {number} done
 * @property {string | null} stage
 * @property {string} status
 * @property {number | null} latency
 */

/**
 * @typedef {object} SceneMessage
 * @property {"note" | "warning" | "error"} severity
 * @property {string} code
 * @property {string} message
 * @property {string} [hint]
 * @property {string} [file]
 * @property {number} [line]
 * @property {number} [column]
 */

/** @typedef {{texture: string, file: string, where?: string}} MissingTexture */

/**
 * @typedef {object} Parameter
 * @property {string} name
 * @property {string} [set] target of an edit; absent: read-only
 * @property {string} type
 * @property {any} [value]
 * @property {any} [default]
 * @property {string} [text] value of an array or a structure, as in a scene file
 * @property {number} [min]
 * @property {number} [max]
 * @property {string} [unit]
 * @property {string} [doc]
 * @property {string} [support]
 * @property {string} [form] values of a statement
 * @property {string} [group]
 * @property {string[]} [choices]
 * @property {boolean} [edited]
 * @property {ShaderCall} [connection]
 */

/**
 * @typedef {object} ShaderCall
 * @property {string} shader
 * @property {string} [name]
 * @property {string} [slot]
 * @property {string} [doc]
 * @property {boolean} [texture] the connection is a texture element
 * @property {string} [file]
 * @property {(Parameter | string)[]} parameters may be missing in connections of textures
 */

/**
 * @typedef {object} SceneElement
 * @property {string} name
 * @property {string} kind
 * @property {string} [file]
 * @property {number} [line]
 * @property {ShaderCall[]} shaders
 */

/**
 * @typedef {object} Outline
 * @property {{name: string, shader: string}[]} materials
 * @property {{name: string, instance: string, shader: string, kind: string}[]} lights
 * @property {{name: string, instance: string}[]} cameras
 * @property {{name: string, item: string}[]} instances
 * @property {{name: string, file: string, missing: boolean}[]} textures
 * @property {{name: string, shader: string}[]} shaders
 * @property {string[]} options
 * @property {boolean} daylight
 * @property {boolean} [cut]
 */

/** @typedef {{value: number, half_width: number, samples?: number, precise?: boolean}} Measured */

/**
 * @typedef {object} ProbeReply
 * @property {number} x
 * @property {number} y
 * @property {boolean} hit
 * @property {string} [instance]
 * @property {string} [object]
 * @property {string} [material]
 * @property {Triple} [position]
 * @property {Triple} [normal]
 * @property {number} [distance]
 * @property {Triple} [radiance]
 * @property {Measured} [luminance]
 * @property {Measured} [illuminance]
 */

/**
 * @typedef {object} LuxGrid
 * @property {{position: Triple, normal: Triple, value: number, half_width: number}[]} sensors
 * @property {number} columns
 * @property {number} rows
 * @property {Measured} mean
 * @property {number} min
 * @property {number} max
 * @property {number} uniformity
 */

/**
 * @typedef {object} Job
 * @property {string} state
 * @property {number} [done]
 * @property {number} [samples]
 * @property {number | null} [noise]
 * @property {number | null} [remaining]
 * @property {string[]} [files]
 * @property {string} [command]
 * @property {string} [message]
 */

/**
 * @typedef {object} Strip part of a layer, rows from the top
 * @property {number} format
 * @property {boolean} last
 * @property {boolean} preview
 * @property {number} epoch
 * @property {number} layer
 * @property {number} divider
 * @property {number} x
 * @property {number} y
 * @property {number} width
 * @property {number} height
 * @property {number} samples
 * @property {number} frame
 * @property {Uint16Array | Float32Array} data
 */

export {};
