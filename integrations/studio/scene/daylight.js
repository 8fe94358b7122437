// SPDX-License-Identifier: Apache-2.0
// Place and time of daylight, and a set of hours that is rendered once.

/** Places: latitude, longitude (degrees, north and east positive), hours from UTC in winter. */
export const PLACES = /** @type {[string, number, number, number][]} */ ([
  ["Berlin", 52.52, 13.40, 1], ["Cairo", 30.04, 31.24, 2], ["Cape Town", -33.92, 18.42, 2], ["Helsinki", 60.17, 24.94, 2],
  ["London", 51.51, -0.13, 0], ["Madrid", 40.42, -3.70, 1], ["Mexico City", 19.43, -99.13, -6], ["Munich", 48.14, 11.58, 1],
  ["New York", 40.71, -74.01, -5], ["Reykjavik", 64.15, -21.94, 0], ["San Francisco", 37.77, -122.42, -8], ["Singapore", 1.35, 103.82, 8],
  ["Sydney", -33.87, 151.21, 10], ["Tokyo", 35.68, 139.69, 9]]);

/** ISO 8601 time with zone. @param {string} date YYYY-MM-DD @param {number} hour 0...24 @param {number} zone hours */
export function isoTime(date, hour, zone) {
  const minutes = Math.max(0, Math.min(24 * 60 - 1, Math.round(hour * 60)));
  const two = (/** @type {number} */ v) => String(Math.trunc(v)).padStart(2, "0");
  const z = Math.abs(zone);
  return `${date}T${two(minutes / 60)}:${two(minutes % 60)}:00${zone < 0 ? "-" : "+"}${two(z)}:${two(Math.round(z % 1 * 60))}`;
}

/** @param {number} hour */
export function hourText(hour) {
  const minutes = Math.round(hour * 60);
  return `${String(Math.floor(minutes / 60)).padStart(2, "0")}:${String(minutes % 60).padStart(2, "0")}`;
}

/** @param {number} from @param {number} to @param {number} step @returns {number[]} */
export function hourList(from, to, step) {
  const hours = [];
  for (let i = 0; from + i * step <= to + 1e-6 && hours.length < 200; ++i) hours.push(from + i * step);
  return hours;
}

/**
 * Stills and factors of a position between rendered hours: linear light, mixed linearly.
 * @template T
 * @param {{hour: number, still: T}[]} frames @param {number} hour
 * @returns {{stills: T[], factors: number[]} | null}
 */
export function between(frames, hour) {
  if (frames.length === 0) return null;
  const next = frames.findIndex((f) => f.hour >= hour);
  if (next === 0) return {stills: [frames[0].still], factors: [1]};
  if (next < 0) return {stills: [frames[frames.length - 1].still], factors: [1]};
  const a = frames[next - 1], b = frames[next], t = (hour - a.hour) / (b.hour - a.hour);
  return {stills: [a.still, b.still], factors: [1 - t, t]};
}

/**
 * Renders hours one after the other.
 * @param {import("./session.js").Session} session
 * @param {number[]} hours @param {number} samples
 * @param {(hour: number, gesture: string) => Promise<any>} setHour
 * @param {{signal: AbortSignal, onProgress: (done: number) => void, gesture: string}} o
 * @returns {Promise<{hour: number, still: {width: number, height: number, pixels: Uint16Array}}[]>}
 */
export async function renderHours(session, hours, samples, setHour, o) {
  const out = [];
  for (const hour of hours) {
    if (o.signal.aborted) break;
    const before = session.state.epoch;
    const reply = await setHour(hour, o.gesture);
    const epoch = Number(reply?.epoch ?? before + 1);
    const complete = await waitForSamples(session, epoch, samples, o.signal);
    if (!complete) break;
    const f = session.frames;
    out.push({hour, still: {width: f.width, height: f.height, pixels: f.layers[0].slice()}});
    o.onProgress(out.length / hours.length);
  }
  return out;
}

/** @param {import("./session.js").Session} session @param {number} epoch @param {number} samples @param {AbortSignal} signal @returns {Promise<boolean>} */
function waitForSamples(session, epoch, samples, signal) {
  return new Promise((resolve) => {
    const done = () => {
      const f = session.frames, p = session.progress;
      const ready = f.epoch >= epoch && f.divider === session.state.scale &&
          (f.samples >= samples || (p?.status === "converged" && p.epoch === f.epoch));
      if (!ready && !signal.aborted) return;
      for (const end of ends) end();
      signal.removeEventListener("abort", done);
      resolve(ready);
    };
    const ends = [session.on("frame", done), session.on("progress", done)];
    signal.addEventListener("abort", done);
    done();
  });
}
