// SPDX-License-Identifier: Apache-2.0
// Groups of parameters: those of the declaration, otherwise by the first word of the names.

/** @typedef {import("../net/types.js").Parameter} Parameter */

const FEWEST_FOR_GROUPS = 12, FEWEST_IN_GROUP = 3;

/** First words that mean the same, and titles of groups. */
const ALIAS = /** @type {Record<string, string>} */ ({reflectivity: "refl", transparency: "refr", reflect: "refl", refract: "refr", skip: "options", overall: "bump"});
const TITLES = /** @type {Record<string, string>} */ ({
  refl: "Reflection", refr: "Refraction", ao: "Ambient occlusion", brdf: "Reflection by angle", anisotropy: "Anisotropy", diffuse: "Diffuse", bump: "Bump",
  thin: "Thin walls", fg: "Final gathering", options: "Options", no: "Options", additional: "Additional", sun: "Sun", ground: "Ground", red: "Colour", sky: "Sky", motion: "Motion", out: "Output"});

/** @param {string} name */
function firstWord(name) {
  const word = name.split("_")[0].toLowerCase();
  return ALIAS[word] ?? word;
}

/** @param {string} word */
const title = (word) => TITLES[word] ?? word[0].toUpperCase() + word.slice(1);

/** Parameters by group, in the order of the first of each. @param {Parameter[]} parameters @returns {[string, Parameter[]][]} */
export function grouped(parameters) {
  const declared = parameters.some((p) => p.group);
  if (!declared && parameters.length < FEWEST_FOR_GROUPS) return [["Parameters", parameters]];
  const counts = new Map();
  for (const p of parameters) counts.set(title(firstWord(p.name)), (counts.get(title(firstWord(p.name))) ?? 0) + 1);
  const groups = new Map();
  for (const p of parameters) {
    const word = title(firstWord(p.name));
    const name = declared ? p.group || "Other" : counts.get(word) >= FEWEST_IN_GROUP ? word : "Other";
    groups.set(name, [...(groups.get(name) ?? []), p]);
  }
  const other = groups.get("Other");
  if (other) {
    groups.delete("Other");
    groups.set("Other", other);  // last
  }
  return [...groups];
}
