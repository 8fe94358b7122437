// SPDX-License-Identifier: Apache-2.0
// Dark, light, or as the system.

const THEMES = ["system", "dark", "light"];

/** @param {() => void} onChange */
export function createTheme(onChange) {
  let current = localStorage.getItem("oriel-theme") ?? "system";
  const apply = () => {
    if (!THEMES.includes(current)) current = "system";
    if (current === "system") delete document.documentElement.dataset.theme;
    else document.documentElement.dataset.theme = current;
    localStorage.setItem("oriel-theme", current);
    onChange();
  };
  matchMedia("(prefers-color-scheme: dark)").addEventListener("change", onChange);
  apply();
  return {
    get current() { return current; },
    next() {
      current = THEMES[(THEMES.indexOf(current) + 1) % THEMES.length];
      apply();
      return current;
    },
  };
}
