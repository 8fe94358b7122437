// SPDX-License-Identifier: Apache-2.0
// GLSL of the display: the sum of the light layers, then the curves of `oriel tonemap` (src/tone).

/** Largest number of layers that are summed. */
export const MAX_WEIGHTS = 64;

// B. Wrensch, "Minimal AgX Implementation" (agx_mat), as in src/tone/display_views.cpp. Rows are
// normalised to sum 1.
const INSET = [
  [0.842479062253094, 0.0784335999999992, 0.0792237451477643],
  [0.0423282422610123, 0.878468636469772, 0.0791661274605434],
  [0.0423756549057051, 0.0784336, 0.879142973793104],
].map((row) => {
  const sum = row[0] + row[1] + row[2];
  return row.map((v) => v / sum);
});

/** Inverse of a 3x3 matrix by cofactors. @param {number[][]} m */
export function inverse3(m) {
  const c = (/** @type {number} */ i, /** @type {number} */ j) => {
    const a = (i + 1) % 3, b = (i + 2) % 3, d = (j + 1) % 3, e = (j + 2) % 3;
    return m[a][d] * m[b][e] - m[a][e] * m[b][d];
  };
  const det = m[0][0] * c(0, 0) + m[0][1] * c(0, 1) + m[0][2] * c(0, 2);
  return [0, 1, 2].map((i) => [0, 1, 2].map((j) => c(j, i) / det));
}

/** @param {number} v */
const literal = (v) => {
  const text = v.toPrecision(9);
  return /[.e]/.test(text) ? text : `${text}.0`;
};

/** GLSL of out[i] = sum_j m[i][j] c[j]; mat3 is given by columns. @param {number[][]} m */
const matrix = (m) => `mat3(${[0, 1, 2].flatMap((j) => m.map((row) => literal(row[j]))).join(", ")})`;

const SLOPE = 2, TOE = 3, SHOULDER = 3.25, PIVOT = 10 / 16.5;

/** Scale of a branch of the AgX curve. @param {number} x @param {number} y @param {number} power */
function branchScale(x, y, power) {
  return ((SLOPE * x) ** -power * ((SLOPE * x / y) ** power - 1)) ** (-1 / power);
}

const AGX = `
const mat3 kInset = ${matrix(INSET)};
const mat3 kOutset = ${matrix(inverse3(INSET))};
float branch(float distance, float scale, float power) {
  float t = ${literal(SLOPE)} * distance / scale;
  return t > 0.0 ? scale * t / pow(1.0 + pow(t, power), 1.0 / power) : 0.0;
}
float agxCurve(float x) {
  x = clamp(x, 0.0, 1.0);
  float y = x < ${literal(PIVOT)}
      ? 0.5 - branch(${literal(PIVOT)} - x, ${literal(branchScale(PIVOT, 0.5, TOE))}, ${literal(TOE)})
      : 0.5 + branch(x - ${literal(PIVOT)}, ${literal(branchScale(1 - PIVOT, 0.5, SHOULDER))},
                     ${literal(SHOULDER)});
  return clamp(y, 0.0, 1.0);
}
vec3 agx(vec3 linear) {
  vec3 c = kInset * linear;
  vec3 stops = log2(max(c, vec3(1e-30)) / 0.18);
  vec3 at = (stops + 10.0) / 16.5;
  return clamp(kOutset * vec3(agxCurve(at.r), agxCurve(at.g), agxCurve(at.b)), 0.0, 1.0);
}`;

const NEUTRAL = `
vec3 pbrNeutral(vec3 c) {
  const float kReflected = 0.04, kStart = 0.8 - kReflected, kDesaturation = 0.15;
  float least = min(c.r, min(c.g, c.b));
  c -= least <= 2.0 * kReflected ? least - least * least / (4.0 * kReflected) : kReflected;
  float peak = max(c.r, max(c.g, c.b));
  if (peak <= kStart) return c;
  float room = 1.0 - kStart;
  float lowered = 1.0 - room * room / (peak + room - kStart);
  float kept = 1.0 / (kDesaturation * (peak - lowered) + 1.0);
  return c * (lowered / peak) * kept + vec3(lowered) * (1.0 - kept);
}
vec3 srgbEncode(vec3 v) {
  return mix(12.92 * v, 1.055 * pow(max(v, vec3(1e-12)), vec3(1.0 / 2.4)) - 0.055,
             greaterThan(v, vec3(0.0031308)));
}`;

const PHOTOGRAPHIC = `
float power(float v, float exponent) {
  return exponent == 1.0 ? v : v > 0.0 ? pow(v, exponent) : 0.0;
}
vec3 photographic(vec3 c) {
  if (uFilm.x != 1.0) c = tame(uFilm.x * c + (1.0 - uFilm.x) * (c / (1.0 + c)));
  if (uFilm.y != 1.0) {
    float grey = luminance(c);
    c = tame(grey + (c - grey) * uFilm.y);
  }
  float y = luminance(c);
  if (uFilm.z != 1.0 && y < 1.0) {
    float share = sqrt(y);
    vec3 toe = vec3(power(c.r, uFilm.z), power(c.g, uFilm.z), power(c.b, uFilm.z));
    c = tame(toe + (c - toe) * share);
  }
  return vec3(power(c.r, uFilm.w), power(c.g, uFilm.w), power(c.b, uFilm.w));
}
float simpleChannel(float value) {
  float v = tame((value + uSimple.x) * uSimple.y);
  float over = v - uSimple.z;
  if (over > 0.0)
    v = uSimple.z + (uAsymptotic ? 1.0 / (1.0 / over + uSimple.w) : over / (1.0 + uSimple.w));
  return power(tame(v), uFilm.w);
}`;

// 16 steps of viridis, as in src/image/false_color.cpp.
export const VIRIDIS = [
  0x440154, 0x481a6c, 0x472f7d, 0x414487, 0x39568c, 0x31688e, 0x2a788e, 0x23888e,
  0x1f988b, 0x22a884, 0x35b779, 0x54c568, 0x7ad151, 0xa5db36, 0xd2e21b, 0xfde725];

const rgb = (/** @type {number} */ bits) =>
    `vec3(${[bits >> 16, (bits >> 8) & 255, bits & 255].map((v) => literal(v / 255)).join(", ")})`;

const FALSE_COLOR = `
const vec3 kViridis[16] = vec3[16](${VIRIDIS.map(rgb).join(", ")});
vec3 viridis(float t) {
  float at = clamp(t, 0.0, 1.0) * 15.0;
  int i = min(int(at), 14);
  return mix(kViridis[i], kViridis[i + 1], at - float(i));
}
vec3 falseColor(float value) {
  if (!(value > 0.0)) return vec3(0.0);
  float low = uFalse.x, high = uFalse.y;
  float t = uFalse.w > 0.5 ? log(max(value, low) / low) / log(high / low) : (value - low) / (high - low);
  return viridis(t);
}`;

export const VERTEX_SHADER = `#version 300 es
void main() {
  vec2 corner = vec2(gl_VertexID & 1, gl_VertexID >> 1);
  gl_Position = vec4(corner * 4.0 - 1.0, 0.0, 1.0);
}`;

/** Shows: 0 tone-mapped light, 1 false colours, 2 directions (normals), 3 values as they are. */
export const FRAGMENT_SHADER = `#version 300 es
precision highp float;
precision highp int;
precision highp sampler2DArray;
uniform sampler2DArray uLayers;
uniform vec3 uWeights[${MAX_WEIGHTS}];
uniform int uCount;
uniform vec4 uPlace;   // left, top, width, height of the picture in pixels of the target
uniform float uTargetHeight;
uniform bool uFlip;    // rows from the top
uniform int uShow, uMode;
uniform vec3 uScale;
uniform vec4 uFilm, uSimple, uFalse;
uniform bool uAsymptotic;
uniform vec3 uSurround;
out vec4 fragment;

float tame(float v) { return v > 0.0 ? min(v, 3.0e38) : 0.0; }
vec3 tame(vec3 v) { return vec3(tame(v.r), tame(v.g), tame(v.b)); }
float luminance(vec3 c) { return dot(c, vec3(0.2126, 0.7152, 0.0722)); }
${PHOTOGRAPHIC}
${AGX}
${NEUTRAL}
${FALSE_COLOR}

void main() {
  vec2 pixel = vec2(gl_FragCoord.x, uFlip ? gl_FragCoord.y : uTargetHeight - gl_FragCoord.y);
  vec2 at = (pixel - uPlace.xy) / uPlace.zw;
  if (any(lessThan(at, vec2(0.0))) || any(greaterThanEqual(at, vec2(1.0)))) {
    fragment = vec4(uSurround, 1.0);
    return;
  }
  vec3 light = vec3(0.0);
  for (int i = 0; i < ${MAX_WEIGHTS}; ++i) {
    if (i >= uCount) break;
    if (uWeights[i] != vec3(0.0)) light += uWeights[i] * texture(uLayers, vec3(at, float(i))).rgb;
  }
  vec3 shown;
  if (uShow == 1) shown = falseColor(uFalse.z * luminance(light));
  else if (uShow == 2) shown = light * 0.5 + 0.5;
  else if (uShow == 3) shown = light;
  else if (uMode == 1) shown = vec3(simpleChannel(light.r), simpleChannel(light.g), simpleChannel(light.b));
  else {
    vec3 exposed = tame(light * uScale);
    shown = uMode == 2 ? agx(exposed)
          : uMode == 3 ? srgbEncode(pbrNeutral(exposed)) : photographic(exposed);
  }
  fragment = vec4(clamp(shown, 0.0, 1.0), 1.0);
}`;
