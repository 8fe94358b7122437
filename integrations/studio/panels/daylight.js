// SPDX-License-Identifier: Apache-2.0
// The sun panel: place, date, hour, haze; a set of hours that is scrubbed, animated and exported.
import {saveBlob} from "../net/files.js";
import {PLACES, between, hourList, hourText, isoTime, renderHours} from "../scene/daylight.js";
import {newGesture} from "../scene/latest.js";
import {zipStored} from "../scene/zip.js";
import {button, h, section, selectField, textField} from "../ui/dom.js";
import {numberField} from "../ui/number_field.js";
import {sunChart} from "../ui/sun_chart.js";

/** @typedef {import("./app.js").App} App */
/** @typedef {{hour: number, still: {width: number, height: number, pixels: Uint16Array}}} HourFrame */

/** @param {App} app */
export function createDaylightPanel(app) {
  const {session} = app;
  const s = {latitude: 48.14, longitude: 11.58, zone: 1, date: "2026-06-21", hour: 12, north: 0, haze: 0, setsHaze: false};
  const chart = sunChart();
  const sun = h("p", {class: "muted", text: "The edit sets direction of the sun and parameters of the sky."});
  const fields = (/** @type {number} */ hour) => ({latitude: s.latitude, longitude: s.longitude, time: isoTime(s.date, hour, s.zone), north: s.north, ...(s.setsHaze ? {haze: s.haze} : {})});
  const send = (/** @type {string} */ gesture) => {
    void session.daylight(fields(s.hour), gesture);
    chart.mark(s.hour);
    restored = true;
  };
  let restored = false;
  let pathRequest = 0;
  const loadPath = async () => {
    const request = ++pathRequest;
    try {
      const reply = await session.request("sun_path", {latitude: s.latitude, longitude: s.longitude, date: s.date, zone: s.zone, north: s.north});
      if (request === pathRequest) chart.show(reply.hours ?? []);
    } catch {
      chart.show([]);  // the chart stays empty; the sliders work without it
    }
    chart.mark(s.hour);
  };
  const changed = (/** @type {string} */ gesture, path = true) => {
    send(gesture);
    if (path) void loadPath();
  };
  const place = selectField("Place", [["", "custom"], ...PLACES.map(([name]) => /** @type {[string, string]} */ ([name, name]))], "Munich", (name) => {
    const found = PLACES.find((p) => p[0] === name);
    if (!found) return;
    [, s.latitude, s.longitude, s.zone] = found;
    latitude.set(s.latitude);
    longitude.set(s.longitude);
    zone.set(s.zone);
    changed(newGesture("place"));
  });
  const own = () => { place.select.value = ""; };
  const latitude = numberField({label: "Latitude", value: s.latitude, min: -90, max: 90, unit: "°", onInput: (v, g) => { s.latitude = v; own(); changed(g); }});
  const longitude = numberField({label: "Longitude", value: s.longitude, min: -180, max: 180, unit: "°", onInput: (v, g) => { s.longitude = v; own(); changed(g); }});
  const zone = numberField({label: "UTC offset", value: s.zone, min: -12, max: 14, unit: "h", doc: "Hours from UTC, with summer time", onInput: (v, g) => { s.zone = v; changed(g); }});
  const date = textField("Date", s.date, (v) => { if (/^\d{4}-\d\d-\d\d$/.test(v)) { s.date = v; changed(newGesture("date")); } }, {type: "date"});
  const hour = numberField({label: "Hour", value: s.hour, min: 0, max: 24, unit: "h", onInput: (v, g) => { s.hour = v; stopScrub(); changed(g, false); }});
  const north = numberField({label: "North", value: s.north, low: -180, high: 180, unit: "°", reset: 0, onInput: (v, g) => { s.north = v; changed(g); }});
  const haze = numberField({label: "Haze", value: s.haze, min: 0, max: 15, reset: 0, onInput: (v, g) => { s.haze = v; s.setsHaze = true; changed(g, false); }});
  hour.element.classList.add("strong");

  const hours = createHours(app, fields);
  const stopScrub = hours.leave;
  const none = h("p", {class: "empty", text: "The scene has no sun and sky."});
  const body = h("div", {}, section("Time", chart.element, hour.element, date.element, sun), section("Place", place.element, latitude.element, longitude.element, zone.element, north.element),
                 section("Air", haze.element), hours.element);
  session.on("state", (state) => {
    const d = state.daylight, time = /^(\d{4}-\d\d-\d\d)T(\d\d):(\d\d)(?::\d\d)?(?:Z|([+-]\d\d):(\d\d))$/.exec(d?.time ?? "");
    if (restored || !d || !time) return;
    restored = true;  // later states answer the changes of this panel
    Object.assign(s, {latitude: d.latitude, longitude: d.longitude, date: time[1], hour: Number(time[2]) + Number(time[3]) / 60,
                      zone: Number(time[4] ?? 0) + Math.sign(Number(time[4] ?? 0)) * Number(time[5] ?? 0) / 60, north: d.north ?? 0, haze: d.haze ?? s.haze, setsHaze: d.haze !== undefined});
    latitude.set(s.latitude);
    longitude.set(s.longitude);
    zone.set(s.zone);
    date.input.value = s.date;
    hour.set(s.hour);
    north.set(s.north);
    haze.set(s.haze);
    place.select.value = PLACES.find((p) => p[1] === s.latitude && p[2] === s.longitude)?.[0] ?? "";
    void loadPath();
  });
  session.on("outline", (outline) => {
    none.hidden = outline.daylight !== false;
    body.hidden = outline.daylight === false;
    if (outline.daylight !== false) void loadPath();
  });
  none.hidden = true;
  return h("div", {class: "panel"}, h("header", {}, h("h2", {text: "Daylight"})), none, body);
}

/** @param {App} app @param {(hour: number) => object} fields of a request for an hour */
function createHours(app, fields) {
  const {session, viewport, toasts} = app;
  const range = {from: 6, to: 20, step: 2, samples: 32};
  /** @type {HourFrame[]} */ let frames = [];
  /** @type {AbortController | null} */ let running = null;
  let playing = false, position = range.from;
  const note = h("p", {class: "muted", text: "Each hour is rendered once. Between hours the light is mixed linearly."});
  const progress = h("progress", {attributes: {max: "1", value: "0", "aria-label": "Hours rendered"}});
  progress.hidden = true;

  const showAt = (/** @type {number} */ at) => {
    position = at;
    viewport.substitute = between(frames, at);
    viewport.invalidate();
    note.textContent = `${hourText(at)} of ${frames.length} rendered hours`;
  };
  const leave = () => {
    playing = false;
    if (viewport.substitute) {
      viewport.substitute = null;
      viewport.invalidate();
    }
  };
  const scrub = numberField({label: "Scrub", value: range.from, low: 0, high: 24, unit: "h", onInput: (v) => { if (frames.length) showAt(Math.max(frames[0].hour, Math.min(frames[frames.length - 1].hour, v))); }});

  const render = async () => {
    if (running) return running.abort();
    const control = running = new AbortController();
    const before = session.state.undo, gesture = newGesture("hours");
    start.querySelector("span")?.replaceChildren("Stop");
    progress.hidden = false;
    progress.value = 0;
    leave();
    try {
      frames = await renderHours(session, hourList(range.from, range.to, range.step), range.samples,
                                 (hour, g) => session.request("daylight", {...fields(hour), gesture: g}),
                                 {signal: control.signal, gesture, onProgress: (done) => { progress.value = done; }});
    } catch (error) {
      toasts.show(String(error instanceof Error ? error.message : error), "error");
    }
    if (session.state.undo > before) await session.attempt("undo");
    running = null;
    start.querySelector("span")?.replaceChildren("Render hours");
    progress.hidden = true;
    for (const b of [play, save, live]) b.disabled = frames.length === 0;
    if (frames.length) showAt(frames[0].hour);
  };
  const animate = () => {
    if (!frames.length) return;
    playing = !playing;
    let last = performance.now();
    const step = (/** @type {number} */ now) => {
      if (!playing) return;
      const first = frames[0].hour, end = frames[frames.length - 1].hour;
      let at = position + (now - last) / 1000 * 1.5;  // 1.5 hours per second
      last = now;
      if (at > end) at = first;
      showAt(at);
      scrub.set(at);
      requestAnimationFrame(step);
    };
    if (playing) requestAnimationFrame(step);
  };
  const exportFrames = async () => {
    const files = [];
    for (const [i, frame] of frames.entries()) {
      const {pixels, width, height} = viewport.readStills([frame.still], [1]);
      const canvas = new OffscreenCanvas(width, height);
      canvas.getContext("2d")?.putImageData(new ImageData(new Uint8ClampedArray(pixels), width, height), 0, 0);
      const blob = await canvas.convertToBlob({type: "image/png"});
      files.push({name: `hour-${String(i + 1).padStart(3, "0")}-${hourText(frame.hour).replace(":", "")}.png`, bytes: new Uint8Array(await blob.arrayBuffer())});
    }
    saveBlob(new Blob([/** @type {any} */ (zipStored(files))], {type: "application/zip"}), "hours.zip");
  };
  const start = button("Render hours", () => void render(), {class: "primary"});
  const play = button("Play", animate), save = button("Export frames", () => void exportFrames()), live = button("Live picture", leave);
  for (const b of [play, save, live]) b.disabled = true;
  const element = section("Set of hours",
      numberField({label: "From", value: range.from, min: 0, max: 24, unit: "h", onInput: (v) => { range.from = v; }}).element,
      numberField({label: "To", value: range.to, min: 0, max: 24, unit: "h", onInput: (v) => { range.to = v; }}).element,
      numberField({label: "Step", value: range.step, min: 0.25, max: 6, unit: "h", onInput: (v) => { range.step = v; }}).element,
      numberField({label: "Samples", value: range.samples, min: 1, low: 1, high: 512, logarithmic: true, integer: true, onInput: (v) => { range.samples = v; }}).element,
      h("div", {class: "actions"}, start), progress, scrub.element, h("div", {class: "actions"}, play, live, save), note);
  return {element, leave};
}
