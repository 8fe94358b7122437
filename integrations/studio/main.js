// SPDX-License-Identifier: Apache-2.0
// Starts the page: connects the session with viewport, panels, bars and keys.
import {takeToken} from "./net/connection.js";
import {createComparePanel} from "./panels/compare.js";
import {createDaylightPanel} from "./panels/daylight.js";
import {createDeliverPanel} from "./panels/deliver.js";
import {createDisplayPanel} from "./panels/display.js";
import {createElementPanel} from "./panels/element.js";
import {createLightsPanel} from "./panels/lights.js";
import {createMeasurePanel} from "./panels/measure.js";
import {createMessagesPanel} from "./panels/messages.js";
import {createOutline} from "./panels/outline.js";
import {DisplaySettings} from "./scene/display_settings.js";
import {Events} from "./scene/events.js";
import {focusAt} from "./scene/focus.js";
import {toneOfScene} from "./scene/scene_exposure.js";
import {Session} from "./scene/session.js";
import {Snapshots} from "./scene/snapshots.js";
import {createBanner} from "./ui/banner.js";
import {h} from "./ui/dom.js";
import {createLegend} from "./ui/legend.js";
import {installShortcuts} from "./ui/shortcuts.js";
import {createStatusBar} from "./ui/status_bar.js";
import {createTabs} from "./ui/tabs.js";
import {createTheme} from "./ui/theme.js";
import {Toasts} from "./ui/toast.js";
import {createTopBar} from "./ui/top_bar.js";
import {Viewport} from "./ui/viewport.js";
import {ViewportInput} from "./ui/viewport_input.js";

const scheme = location.protocol === "https:" ? "wss:" : "ws:";
const session = new Session(`${scheme}//${location.host}/ws`, takeToken());
const display = new DisplaySettings();
const snapshots = new Snapshots();
const toasts = new Toasts();
const events = new Events();

/** @param {unknown} error */
function fatal(error) {
  document.body.append(h("div", {class: "fatal", attributes: {role: "alert"}}, h("h1", {text: "Oriel Studio cannot start"}),
                         h("p", {text: error instanceof Error ? error.message : String(error)})));
}

function start() {
  const viewport = new Viewport(session, display, snapshots);
  /** @type {import("./panels/app.js").App} */
  const app = {
    session, display, snapshots, viewport, toasts, events,
    showPanel: (id) => tabs.show(id),
    select: (name) => {
      tabs.show("edit");
      events.emit("select", name);
    },
  };
  const compare = createComparePanel(app), deliver = createDeliverPanel(app);
  const tabs = createTabs([
    {id: "edit", title: "Edit", icon: "edit", element: createElementPanel(app).element},
    {id: "display", title: "Display", icon: "display", element: createDisplayPanel(app)},
    {id: "lights", title: "Lights", icon: "lights", element: createLightsPanel(app)},
    {id: "daylight", title: "Daylight", icon: "sun", element: createDaylightPanel(app)},
    {id: "measure", title: "Measure", icon: "measure", element: createMeasurePanel(app)},
    {id: "compare", title: "Compare", icon: "compare", element: compare.element},
    {id: "deliver", title: "Deliver", icon: "deliver", element: deliver.element},
    {id: "messages", title: "Messages", icon: "messages", element: createMessagesPanel(app, (text) => tabs.badge("messages", text))},
  ]);
  const status = createStatusBar(app);
  const input = new ViewportInput(viewport, {
    click: (tool, x, y) => void click(app, tool, x, y),
    region: (region) => session.view({region}),
    hover: (x, y) => status.hover(x, y),
    tool: (tool) => top.showTool(tool),
  });
  const theme = createTheme(() => viewport.invalidate());
  const shortcuts = installShortcuts(app, input, {take: compare.take, save: deliver.save, theme: theme.next});
  const top = createTopBar(app, input, {help: shortcuts.show, theme, save: deliver.save});
  viewport.element.append(createLegend(app));
  document.body.append(h("a", {class: "skip", text: "Skip to the picture", attributes: {href: "#viewport"}}), top.element,
                       createOutline(app), h("main", {class: "stage", attributes: {id: "viewport", tabindex: "-1"}}, createBanner(app), viewport.element, status.element, toasts.element),
                       h("aside", {class: "inspector", attributes: {"aria-label": "Panels"}}, tabs.host, tabs.rail), toasts.status, shortcuts.dialog);
  input.choose("navigate");
  installTone(app);
  installHints(app);
  session.on("failed", (error) => toasts.show(error instanceof Error ? error.message : String(error), "error"));
  installTestHook(app);
  session.start();
}

/** @param {import("./panels/app.js").App} app @param {string} tool @param {number} x @param {number} y */
async function click(app, tool, x, y) {
  events.emit("click", {tool, x, y});
  if (tool === "focus") {
    const message = await focusAt(app.session, x, y);
    toasts.show(message.text, message.failed ? "error" : "note");
  }
  if (tool !== "navigate") return;
  const picked = await app.session.attempt("pick", {x, y});
  if (picked?.material) app.select(picked.material);
  else if (picked) toasts.show(picked.hit ? "This surface has no named material." : "There is no surface below this pixel.");
}

/** Says what a beginner would look for: errors of the scene, and why the picture is black. @param {import("./panels/app.js").App} app */
function installHints(app) {
  const {session, toasts} = app;
  let reported = false, black = false;
  session.on("messages", (list) => {
    const errors = list.filter((/** @type {{severity: string}} */ m) => m.severity === "error");
    if (errors.length === 0 || reported) return;
    reported = true;
    toasts.show(`${errors.length === 1 ? "The scene has an error" : `The scene has ${errors.length} errors`}; see Messages. ${errors[0].message}`, "error");
  });
  const checkLight = async () => {
    const {outline, frames, progress} = session;
    if (progress?.status !== "converged" || black || frames.epoch !== progress.epoch || !outline || outline.lights.length > 0) return;
    const {sampleColors} = await import("./panels/display.js");
    const colors = sampleColors(app);
    if (colors.length === 0 || colors.some((c) => c[0] > 0 || c[1] > 0 || c[2] > 0)) return;
    black = true;
    toasts.show("The picture is black: the scene has no lights. Light comes from lights, from an environment, and from materials that emit.", "error");
  };
  // The last picture and the news that it is finished arrive in either order.
  session.on("progress", checkLight);
  session.on("frame", checkLight);
}

/** Starts the tone curve with the exposure of the scene, once. @param {import("./panels/app.js").App} app */
function installTone(app) {
  let done = false;
  app.session.on("state", (state) => {
    if (done || state.size[0] <= 1) return;  // the scene is not read yet
    done = true;
    app.display.changeTone(toneOfScene(state));
  });
  // Without a photographic exposure in the scene, the first picture sets the exposure.
  let exposed = false;
  app.session.on("frame", async () => {
    if (exposed) return;
    exposed = true;
    if (app.session.state.exposure) return;
    const [{automaticExposure}, {sampleColors}] = await Promise.all([import("./display/tone.js"), import("./panels/display.js")]);
    const stops = automaticExposure(sampleColors(app), app.display.tone);
    if (stops !== null) app.display.changeTone({exposure: Number(stops.toFixed(2))});
  });
}

/** State for tests in a browser (`?test`). @param {import("./panels/app.js").App} app */
function installTestHook(app) {
  if (!new URLSearchParams(location.search).has("test")) return;
  Object.defineProperty(window, "__studio", {value: {
    app,
    get epoch() { return app.session.frames.epoch; },
    get samples() { return app.session.frames.samples; },
    get drawnFrame() { return app.session.drawnFrame; },
    readCanvas: () => app.viewport.readCanvas(),
  }});
}

try {
  start();
} catch (error) {
  fatal(error);
}
