// SPDX-License-Identifier: Apache-2.0
// The scene of the mock server: a synthetic room whose lights sum to the picture.
import {floatToHalf} from "../../../integrations/studio/display/half.js";

export const LIGHTS = ["light_sun", "light_lamp", "light_rest"];

/** Linear colour of a light at a position of the picture, 0...1. The hour moves the sun. */
export function lightAt(name, u, v, state) {
  const floor = v > 0.62, wall = u < 0.2;
  const material = floor ? [0.45, 0.33, 0.22] : wall ? [0.6, 0.58, 0.55] : [0.7, 0.7, 0.68];
  let e = 0;
  if (name === "light_sun") {
    const centre = 0.3 + 0.4 * (state.hour / 24), d = Math.hypot((u - centre) * 3, (v - 0.8) * 6);
    e = (floor && d < 1 ? 40 : 0.5) * state.gloss;
  } else if (name === "light_lamp") {
    e = 1.5 / (0.05 + (u - 0.75) ** 2 + (v - 0.25) ** 2);
  } else {
    e = 4 * (1 - v * 0.6);
  }
  const tint = name === "light_lamp" ? [1, 0.75, 0.45] : name === "light_sun" ? [1, 0.95, 0.85] : [0.8, 0.9, 1];
  return material.map((m, k) => 20 * m * tint[k] * e);
}

/** Deterministic noise of mean 1. */
function noise(x, y, k, samples) {
  let n = Math.imul(x * 374761393 + y * 668265263 + k * 69069, 1274126177);
  n = Math.imul(n ^ (n >>> 13), 1274126177) >>> 0;
  return 1 + (n / 2 ** 32 - 0.5) / Math.sqrt(samples);
}

/** RGBA halves of a layer. */
export function layerPixels(name, width, height, samples, state) {
  const out = new Uint16Array(4 * width * height);
  for (let y = 0; y < height; ++y)
    for (let x = 0; x < width; ++x) {
      const u = (x + 0.5) / width, v = (y + 0.5) / height;
      let c;
      if (name === "normal") c = v > 0.62 ? [0, 0, 1] : u < 0.2 ? [1, 0, 0] : [0, -1, 0];
      else if (name === "depth") c = [5 - 3 * v, 5 - 3 * v, 5 - 3 * v];
      else if (name.startsWith("light_")) c = lightAt(name, u, v, state);
      else c = LIGHTS.map((l) => lightAt(l, u, v, state)).reduce((a, b) => a.map((w, k) => w + b[k]));
      const at = 4 * (y * width + x), factor = name === "normal" || name === "depth" ? 1 : noise(x, y, 1, samples);
      for (let k = 0; k < 3; ++k) out[at + k] = floatToHalf(c[k] * factor);
      out[at + 3] = 0x3c00;
    }
  return out;
}

export const OUTLINE = {
  materials: [{name: "floor", shader: "mia_material_x"}, {name: "wall", shader: "mia_material_x"}, {name: "<b>glass</b>", shader: "mia_material_x"}],
  lights: [{name: "sun", instance: "sun_inst", shader: "mia_physicalsun", kind: "directional"}, {name: "lamp", instance: "lamp_inst", shader: "mib_light_point", kind: "point"}],
  cameras: [{name: "cam", instance: "cam_inst"}],
  instances: [{name: "floor_inst", item: "floor_obj"}, {name: "wall_inst", item: "wall_obj"}],
  textures: [{name: "wood", file: "textures/wood.png", missing: false}, {name: "carpet", file: "C:\\maps\\carpet.jpg", missing: true}],
  shaders: [{name: "sky", shader: "mia_physicalsky"}, {name: "wood_map", shader: "mib_texture_lookup"}], options: ["opt"], daylight: true,
};

export const MESSAGES = {
  list: [{severity: "note", code: "texture-cache", message: "Texture cache of 1024 MB."},
         {severity: "warning", code: "missing-texture", message: "texture \"carpet\" is missing; it is shown in magenta", hint: "Relink it in the messages panel.", file: "room.mi", line: 88, column: 3}],
  missing: [{texture: "carpet", file: "C:\\maps\\carpet.jpg", where: "room.mi:88"}],
};

/** Parameters of a material with the values of the edits. */
export function elementOf(name, edits) {
  const values = new Map(edits.map((e) => [e.slice(0, e.indexOf("=")), e.slice(e.indexOf("=") + 1)]));
  const p = (parameter, type, value, more = {}) => {
    const set = `${name}.${parameter}`, text = values.get(set);
    const edited = text !== undefined;
    if (edited) value = type === "color" ? text.split(" ").map(Number) : type === "boolean" ? text === "on" : type === "scalar" || type === "integer" ? Number(text) : text;
    return {name: parameter, set, type, value, default: more.default ?? value, edited, support: "exact", ...more};
  };
  if (name === "cam") return {name, kind: "camera", file: "room.mi", line: 7, shaders: [{shader: "physical_lens_dof", slot: "lens", doc: "Depth of field", parameters: [p("plane", "scalar", -3, {doc: "Plane of focus"}), p("radius", "scalar", 0.01, {min: 0})]}]};
  return {name, kind: "material", file: "room.mi", line: 42, shaders: [{shader: "mia_material_x", slot: "surface", doc: "Architectural material", parameters: [
    p("diffuse_weight", "scalar", 1, {min: 0, max: 1, group: "Diffuse", doc: "Strength of the diffuse reflection"}),
    p("diffuse", "color", [0.45, 0.33, 0.22], {group: "Diffuse", doc: "Diffuse colour", connection: {name: "wood_map", shader: "mib_texture_lookup", parameters: [
      {name: "tex", set: "wood_map.tex", type: "texture", value: "wood", doc: "Picture"}, {name: "remap", type: "shader", set: "wood_map.remap", value: ""}]}}),
    p("diffuse_roughness", "scalar", 0, {min: 0, max: 1, group: "Diffuse", doc: "Oren-Nayar roughness"}),
    p("reflectivity", "scalar", 0.6, {min: 0, max: 1, group: "Reflection", doc: "Strength of the reflection"}),
    p("refl_color", "color", [1, 1, 1], {group: "Reflection"}),
    p("refl_gloss", "scalar", 1, {min: 0, max: 1, group: "Reflection", doc: "1 = mirror, 0 = diffuse"}),
    p("refl_gloss_samples", "integer", 8, {min: 0, max: 1024, group: "Reflection"}),
    p("refl_hl_only", "boolean", false, {group: "Reflection", doc: "Highlights of lights only", support: "approximate"}),
    p("transparency", "scalar", 0, {min: 0, max: 1, group: "Refraction"}),
    p("refr_ior", "scalar", 1.4, {min: 0.1, max: 5, group: "Refraction"}),
    p("refr_falloff_dist", "scalar", 0, {min: 0, unit: "m", group: "Refraction"}),
    {name: "lights", type: "array light", value: ["sun_inst"], group: "Advanced", doc: "List of lights"}]}]};
}
