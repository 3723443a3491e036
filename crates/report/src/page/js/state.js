// What the viewer shows, in one object; whoever changes it calls `changed`.
import { data } from "./planes.js";
import { groups, hasTime } from "./layers.js";
import { placeIn } from "./points.js";

export const state = {
  window: 0, left: "truth", right: "truth", mode: "slider", split: 0.5, flipped: false,
  view: { zoom: 0, x: 0, y: 0 },
  exposure: 0, errorLimit: data.error_limit, swimLimit: 1,
  tiles: false,
  // Null: the middle frame as it is shown. A number: that frame of the window, at the points of the middle one.
  frame: null,
  // Whether frames are shown from their own camera, or all from the middle one's.
  moving: false,
  cursor: null, pin: null, box: null,
};

const listeners = [];
export const onChange = (listener) => listeners.push(listener);
let waiting = false;

// Tells everybody, once before the next picture is drawn.
export function changed() {
  if (waiting) return;
  waiting = true;
  requestAnimationFrame(() => {
    waiting = false;
    listeners.forEach((tell) => tell());
  });
}

export const current = () => data.windows[state.window];
export const middle = () => Math.floor(current().frames / 2);

// Another window: as much of the choice as it has, and the whole picture.
export function chooseWindow(window) {
  Object.assign(state, { window, frame: null, moving: false, cursor: null, pin: null, box: null });
  state.swimLimit = data.windows[window].swim_limit;
  state.view.zoom = 0;
  const ids = groups(window).flatMap(([, all]) => all);
  if (!ids.includes(state.left)) state.left = ids[0] ?? "truth";
  if (!ids.includes(state.right) || state.right === "truth") state.right = ids.find((id) => id.endsWith("-shadow")) ?? state.left;
  changed();
}

// Another frame; the pinned point stays in the middle of the stage.
export function chooseFrame(frame) {
  state.frame = frame === null || !hasTime(state.window) ? null : (frame + current().frames) % current().frames;
  centre();
  changed();
}

// Brings the pinned point to the middle of the stage.
export function centre() {
  const pinned = whereIs(state.pin);
  if (pinned) Object.assign(state.view, { x: pinned.x, y: pinned.y });
}

// Where a point of the middle frame lies in the shown picture.
export function whereIs(pixel) {
  if (pixel === null) return null;
  const { width } = current();
  const still = { x: (pixel % width) + 0.5, y: Math.floor(pixel / width) + 0.5 };
  return state.moving && state.frame !== null ? (placeIn(state.window, pixel, state.frame) ?? still) : still;
}
