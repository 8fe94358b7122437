// SPDX-License-Identifier: Apache-2.0
// The deliver panel: files of the present picture, the command line, and the final render as a job.
import {downloadResult} from "../net/files.js";
import {tonemapOptions} from "../display/tone.js";
import {button, checkField, h, section, selectField, textField} from "../ui/dom.js";
import {numberField} from "../ui/number_field.js";

/** @typedef {import("./app.js").App} App */

/** @param {number | null | undefined} seconds */
export function durationText(seconds) {
  if (seconds === null || seconds === undefined || !Number.isFinite(seconds)) return "";
  const s = Math.max(0, Math.round(seconds));
  if (s < 60) return `${s} s`;
  if (s < 3600) return `${Math.floor(s / 60)} min ${s % 60} s`;
  return `${Math.floor(s / 3600)} h ${Math.floor(s % 3600 / 60)} min`;
}

/** File name without folder and suffix. @param {string} path */
const stem = (path) => (path.split("/").pop() ?? "picture").replace(/\.[^.]*$/, "") || "picture";

/** @param {App} app */
export function createDeliverPanel(app) {
  const {session, display} = app;
  const deliver = async (/** @type {"png" | "exr"} */ kind) => {
    const tone = kind === "png" ? {tone: tonemapOptions(display.tone)} : {};
    const reply = await session.attempt("deliver", {kind, ...tone});
    if (!reply) return;
    try {
      await downloadResult(reply.url, session.token, `${stem(session.scene.file)}.${kind}`);
    } catch (error) {
      app.toasts.show(String(/** @type {Error} */ (error).message), "error");
    }
  };
  const command = h("code", {class: "command", text: ""});
  const show = async () => {
    const reply = await session.attempt("command");
    if (reply) command.textContent = reply.text;
  };
  const copy = button("Copy", async () => {
    await show();
    await navigator.clipboard.writeText(command.textContent ?? "");
    app.toasts.show("The command line is in the clipboard.");
  });
  const save = (/** @type {string} */ mode) => async () => {
    const reply = await session.attempt("save", {mode});
    if (reply) app.toasts.show(`Saved: ${(reply.files ?? []).join(", ")}`);
  };
  const element = h("div", {class: "panel"}, h("header", {}, h("h2", {text: "Deliver"})),
    section("Save edits", h("p", {class: "muted", text: "Into the scene's own files, with comments and layout kept; or as an incremental file beside them."}),
            h("div", {class: "actions"}, button("Save scene", () => void save("mi")(), {class: "primary", title: "Ctrl+S"}), button("Save incremental file", () => void save("incremental")()))),
    section("Present picture", h("div", {class: "actions"}, button("PNG", () => void deliver("png"), {title: "Tone-mapped as shown"}), button("EXR with layers", () => void deliver("exr")))),
    section("Command line", command, h("div", {class: "actions"}, button("Show command", () => void show()), copy)),
    jobSection(app));
  return {element, save: save("mi")};
}

/** @param {App} app */
function jobSection(app) {
  const {session} = app;
  const s = {samples: 256, noise: 0, seconds: 0};
  const file = textField("File", "final.exr", () => {});
  const denoise = checkField("Denoise", false, () => {});
  const scale = selectField("Size", [["scene", "of the scene"], ["2", "twice"], ["0.5", "half"]], "scene", () => {});
  const layers = checkField("All layers", true, () => {});
  const progress = h("progress", {attributes: {max: "1", value: "0", "aria-label": "Final render"}});
  const text = h("p", {class: "muted", attributes: {"aria-live": "polite"}});
  const start = button("Start final render", async () => {
    const [w, h_] = session.state.size, factor = Number(scale.select.value);
    const fields = {action: "start", file: file.input.value.trim() || "final.exr", samples: Math.round(s.samples), denoise: denoise.input.checked,
                    ...(s.noise > 0 ? {noise: s.noise} : {}), ...(s.seconds > 0 ? {seconds: s.seconds} : {}),
                    ...(Number.isFinite(factor) ? {size: [Math.round(w * factor), Math.round(h_ * factor)]} : {}),
                    ...(layers.input.checked ? {layers: session.state.available_layers} : {})};
    await session.attempt("job", fields);
  }, {class: "primary"});
  const act = (/** @type {string} */ action) => () => void session.attempt("job", {action});
  const pause = button("Pause", act("pause")), resume = button("Resume", act("resume")), cancel = button("Cancel", act("cancel"));
  const update = () => {
    const job = session.job, state = job?.state ?? "";
    const active = state === "running" || state === "paused";
    start.disabled = active;
    pause.hidden = state !== "running";
    resume.hidden = state !== "paused";
    cancel.hidden = !active;
    progress.hidden = !active;
    if (!job) return;
    progress.value = Number(job.done ?? 0);
    const left = durationText(job.remaining);
    text.textContent = state === "done" ? `Done: ${(job.files ?? []).join(", ")}` : state === "failed" ? `Failed: ${job.message ?? ""}`
        : state === "cancelled" ? "Cancelled." : `${Math.round(100 * Number(job.done ?? 0))} %, ${Math.round(job.samples ?? 0)} samples${left ? `, ${left} left` : ""}${state === "paused" ? " (paused)" : ""}`;
  };
  session.on("job", update);
  update();
  return section("Final render", file.element, scale.element,
    numberField({label: "Samples", value: s.samples, min: 1, low: 1, high: 16384, logarithmic: true, integer: true, reset: 256, onInput: (v) => { s.samples = v; }}).element,
    numberField({label: "Noise limit", value: 0, min: 0, max: 1, reset: 0, doc: "Estimated relative error at which the render stops; 0: none", onInput: (v) => { s.noise = v; }}).element,
    numberField({label: "Time limit", value: 0, min: 0, high: 3600, unit: "s", reset: 0, doc: "0: none", onInput: (v) => { s.seconds = v; }}).element,
    denoise.element, layers.element, h("div", {class: "actions"}, start, pause, resume, cancel), progress, text);
}
