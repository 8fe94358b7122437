// SPDX-License-Identifier: Apache-2.0
// The WebGL2 canvas: textures of half floats, the tone shader, comparison by a wipe, read-back.
import {FRAGMENT_SHADER, MAX_WEIGHTS, VERTEX_SHADER} from "./tone_shader.js";
import {toneUniforms} from "./tone.js";

/** @typedef {import("./tone.js").ToneSettings} ToneSettings */
/** @typedef {import("./frame_store.js").DirtyRows} DirtyRows */

/**
 * @typedef {object} Picture texture array with its size
 * @property {WebGLTexture} texture
 * @property {number} width
 * @property {number} height
 * @property {number} count
 */

/**
 * @typedef {object} Look what is drawn of a picture
 * @property {"light" | "false" | "direction" | "data"} show
 * @property {number[][]} weights RGB factor of each layer
 * @property {ToneSettings} tone
 * @property {{low: number, high: number, logarithmic: boolean}} scale of false colours
 * @property {number} unit cd/m2 per unit of the picture
 */

/** @typedef {{x: number, y: number, width: number, height: number}} Place in canvas pixels */

const SHOW = {light: 0, false: 1, direction: 2, data: 3};

/** @param {WebGL2RenderingContext} gl @param {number} kind @param {string} source */
function compile(gl, kind, source) {
  const shader = gl.createShader(kind);
  if (!shader) throw new Error("WebGL2: no shader");
  gl.shaderSource(shader, source);
  gl.compileShader(shader);
  if (!gl.getShaderParameter(shader, gl.COMPILE_STATUS) && !gl.isContextLost())
    throw new Error(`WebGL2: ${gl.getShaderInfoLog(shader)}`);
  return shader;
}

export class GlDisplay {
  /** @type {WebGL2RenderingContext} */ gl;
  /** @type {WebGLProgram} */ #program;
  /** @type {Map<string, WebGLUniformLocation | null>} */ #uniforms = new Map();
  maxSize = 0;

  /** @param {HTMLCanvasElement} canvas */
  constructor(canvas) {
    const gl = canvas.getContext("webgl2", {alpha: false, antialias: false, depth: false});
    if (!gl) throw new Error("This browser has no WebGL2.");
    this.canvas = canvas;
    this.gl = gl;
    this.#program = this.#build();
  }

  /** Builds the program again, after the context was restored. */
  restore() {
    this.#uniforms.clear();
    this.#program = this.#build();
  }

  #build() {
    const gl = this.gl;
    const program = gl.createProgram();
    if (!program) throw new Error("WebGL2: no program");
    gl.attachShader(program, compile(gl, gl.VERTEX_SHADER, VERTEX_SHADER));
    gl.attachShader(program, compile(gl, gl.FRAGMENT_SHADER, FRAGMENT_SHADER));
    gl.linkProgram(program);
    if (!gl.getProgramParameter(program, gl.LINK_STATUS) && !gl.isContextLost())
      throw new Error(`WebGL2: ${gl.getProgramInfoLog(program)}`);
    gl.bindVertexArray(gl.createVertexArray());
    this.maxSize = gl.getParameter(gl.MAX_TEXTURE_SIZE);
    return program;
  }

  /** @param {number} width @param {number} height @param {number} count @returns {Picture} */
  createPicture(width, height, count) {
    const gl = this.gl;
    if (width > this.maxSize || height > this.maxSize)
      throw new Error(`The picture exceeds the largest texture of this browser, ${this.maxSize}.`);
    const texture = gl.createTexture();
    if (!texture) throw new Error("WebGL2: no texture");
    gl.bindTexture(gl.TEXTURE_2D_ARRAY, texture);
    gl.texStorage3D(gl.TEXTURE_2D_ARRAY, 1, gl.RGBA16F, width, height, count);
    gl.texParameteri(gl.TEXTURE_2D_ARRAY, gl.TEXTURE_WRAP_S, gl.CLAMP_TO_EDGE);
    gl.texParameteri(gl.TEXTURE_2D_ARRAY, gl.TEXTURE_WRAP_T, gl.CLAMP_TO_EDGE);
    return {texture, width, height, count};
  }

  /** @param {Picture | null} picture */
  deletePicture(picture) {
    if (picture) this.gl.deleteTexture(picture.texture);
  }

  /**
   * Copies rows of a layer, or all rows.
   * @param {Picture} picture @param {Uint16Array} pixels RGBA halves of the whole layer
   * @param {number} layer @param {number} [y] @param {number} [rows]
   */
  upload(picture, pixels, layer, y = 0, rows = picture.height) {
    const gl = this.gl, from = 4 * y * picture.width;
    gl.bindTexture(gl.TEXTURE_2D_ARRAY, picture.texture);
    gl.pixelStorei(gl.UNPACK_ALIGNMENT, 2);
    gl.texSubImage3D(gl.TEXTURE_2D_ARRAY, 0, 0, y, layer, picture.width, rows, 1, gl.RGBA,
                     gl.HALF_FLOAT, pixels.subarray(from, from + 4 * rows * picture.width));
  }

  /** @param {string} name */
  #at(name) {
    let found = this.#uniforms.get(name);
    if (found === undefined) {
      found = this.gl.getUniformLocation(this.#program, name);
      this.#uniforms.set(name, found);
    }
    return found;
  }

  /** @param {number[]} surround encoded colour outside of the picture */
  clear(surround) {
    const gl = this.gl;
    gl.bindFramebuffer(gl.FRAMEBUFFER, null);
    gl.disable(gl.SCISSOR_TEST);
    gl.clearColor(surround[0], surround[1], surround[2], 1);
    gl.clear(gl.COLOR_BUFFER_BIT);
  }

  /**
   * Draws a picture into the canvas.
   * @param {Picture} picture @param {Look} look @param {Place} place @param {number[]} surround
   * @param {[number, number]} [columns] first and last + 1 column of the canvas to draw
   */
  draw(picture, look, place, surround, columns = [0, this.canvas.width]) {
    const gl = this.gl;
    gl.bindFramebuffer(gl.FRAMEBUFFER, null);
    gl.viewport(0, 0, this.canvas.width, this.canvas.height);
    gl.enable(gl.SCISSOR_TEST);
    gl.scissor(columns[0], 0, Math.max(0, columns[1] - columns[0]), this.canvas.height);
    this.#paint(picture, look, place, surround, this.canvas.height, false);
    gl.disable(gl.SCISSOR_TEST);
  }

  /**
   * Pixels of a picture at its own size, RGBA bytes, rows from the top.
   * @param {Picture} picture @param {Look} look
   */
  readPicture(picture, look) {
    const gl = this.gl, {width, height} = picture;
    const buffer = gl.createFramebuffer(), color = gl.createRenderbuffer();
    gl.bindRenderbuffer(gl.RENDERBUFFER, color);
    gl.renderbufferStorage(gl.RENDERBUFFER, gl.RGBA8, width, height);
    gl.bindFramebuffer(gl.FRAMEBUFFER, buffer);
    gl.framebufferRenderbuffer(gl.FRAMEBUFFER, gl.COLOR_ATTACHMENT0, gl.RENDERBUFFER, color);
    gl.viewport(0, 0, width, height);
    gl.disable(gl.SCISSOR_TEST);
    this.#paint(picture, look, {x: 0, y: 0, width, height}, [0, 0, 0], height, true);
    const bytes = new Uint8Array(4 * width * height);
    gl.readPixels(0, 0, width, height, gl.RGBA, gl.UNSIGNED_BYTE, bytes);
    gl.bindFramebuffer(gl.FRAMEBUFFER, null);
    gl.deleteRenderbuffer(color);
    gl.deleteFramebuffer(buffer);
    return bytes;
  }

  /**
   * Bytes of a rectangle of the canvas, rows from the top. Call it in the task that drew.
   * @param {Place} place
   */
  readCanvas(place) {
    const gl = this.gl, {width, height} = place;
    const bytes = new Uint8Array(4 * width * height);
    gl.readPixels(place.x, this.canvas.height - place.y - height, width, height, gl.RGBA,
                  gl.UNSIGNED_BYTE, bytes);
    const out = new Uint8Array(bytes.length);
    for (let y = 0; y < height; ++y)
      out.set(bytes.subarray(4 * y * width, 4 * (y + 1) * width), 4 * (height - 1 - y) * width);
    return out;
  }

  /**
   * @param {Picture} picture @param {Look} look @param {Place} place @param {number[]} surround
   * @param {number} targetHeight @param {boolean} flip
   */
  #paint(picture, look, place, surround, targetHeight, flip) {
    const gl = this.gl, tone = toneUniforms(look.tone);
    const enlarged = place.width >= picture.width;
    const filter = enlarged && place.width % picture.width === 0 ? gl.NEAREST : gl.LINEAR;
    gl.useProgram(this.#program);
    gl.activeTexture(gl.TEXTURE0);
    gl.bindTexture(gl.TEXTURE_2D_ARRAY, picture.texture);
    gl.texParameteri(gl.TEXTURE_2D_ARRAY, gl.TEXTURE_MIN_FILTER, filter);
    gl.texParameteri(gl.TEXTURE_2D_ARRAY, gl.TEXTURE_MAG_FILTER, filter);
    const count = Math.min(picture.count, look.weights.length, MAX_WEIGHTS);
    const weights = new Float32Array(3 * MAX_WEIGHTS);
    for (let i = 0; i < count; ++i) weights.set(look.weights[i], 3 * i);
    gl.uniform1i(this.#at("uLayers"), 0);
    gl.uniform3fv(this.#at("uWeights"), weights);
    gl.uniform1i(this.#at("uCount"), count);
    gl.uniform4f(this.#at("uPlace"), place.x, place.y, place.width, place.height);
    gl.uniform1f(this.#at("uTargetHeight"), targetHeight);
    gl.uniform1i(this.#at("uFlip"), flip ? 1 : 0);
    gl.uniform1i(this.#at("uShow"), SHOW[look.show]);
    gl.uniform1i(this.#at("uMode"), tone.mode);
    gl.uniform3fv(this.#at("uScale"), tone.scale);
    gl.uniform4fv(this.#at("uFilm"), tone.film);
    gl.uniform4fv(this.#at("uSimple"), tone.simple);
    gl.uniform1i(this.#at("uAsymptotic"), tone.asymptotic ? 1 : 0);
    gl.uniform4f(this.#at("uFalse"), look.scale.low, look.scale.high, look.unit,
                 look.scale.logarithmic ? 1 : 0);
    gl.uniform3fv(this.#at("uSurround"), surround);
    gl.drawArrays(gl.TRIANGLES, 0, 3);
  }
}
