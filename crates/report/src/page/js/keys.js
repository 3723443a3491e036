// The viewer by keyboard alone.
import { data } from "./planes.js";
import { groups, kindOf, variantOf } from "./layers.js";
import { changed, chooseFrame, current, state } from "./state.js";
import { actions, follow, play, setExposure, setMode, step } from "./controls.js";
import { find, panesNow, root, stageSize, stage, zoom } from "./viewer.js";

// A variant into the right slot; what is shown of it stays the same where there is such a layer.
function chooseVariant(v) {
  const ids = groups(state.window).flatMap(([, all]) => all);
  const kind = variantOf(state.right) === null ? "shadow" : kindOf(state.right);
  const id = [`v${v}-${kind}`, `v${v}-shadow`].find((wanted) => ids.includes(wanted));
  if (id) state.right = id;
  changed();
}

// Moves the cursor by pixels and keeps it in view.
function move(dx, dy) {
  const { width, height } = current();
  const from = state.cursor ?? { x: Math.floor(state.view.x) + 0.5, y: Math.floor(state.view.y) + 0.5 };
  const clamp = (v, top) => Math.max(0.5, Math.min(top - 0.5, v));
  const to = { x: clamp(Math.floor(from.x) + 0.5 + dx, width), y: clamp(Math.floor(from.y) + 0.5 + dy, height), shown: true };
  state.cursor = to;
  const pane = panesNow()[0];
  const [halfX, halfY] = [pane.width / 2 / state.view.zoom - 1, stageSize().height / 2 / state.view.zoom - 1];
  const near = (v, centre, half) => (half > 0 ? Math.max(v - half, Math.min(v + half, centre)) : v);
  state.view.x = near(to.x, state.view.x, halfX);
  state.view.y = near(to.y, state.view.y, halfY);
  changed();
}

const about = () => state.cursor ?? undefined;
const light = () => data.variants.map((v, i) => [v, i]).filter(([v]) => v.label !== "as printed").map(([, i]) => i);

// By key: what it does. Arrows are those of the stage alone.
const KEYS = {
  r: () => { state.left = "truth"; changed(); },
  d: () => setMode(state.mode === "difference" ? "slider" : "difference"),
  s: () => setMode("slider"),
  b: () => setMode("side"),
  e: () => setExposure(state.exposure + 0.5),
  E: () => setExposure(state.exposure - 0.5),
  g: () => actions.tiles(),
  p: () => follow(),
  x: () => actions.swap(),
  m: () => find(".moving").click(),
  ",": () => step(-1),
  ".": () => step(1),
  " ": () => play(),
  "+": () => zoom(2, about()),
  "=": () => zoom(2, about()),
  "-": () => zoom(0.5, about()),
  0: () => actions.fit(),
  "?": () => actions.help(),
};
const ARROWS = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1] };

// The variant that a digit stands for, ten more with shift: by the key's place, for with shift it writes something else.
function numberOf({ code, key, shiftKey }) {
  const digit = Number(/^(?:Digit|Numpad)(\d)$/.exec(code)?.[1] ?? (/^\d$/.test(key) ? key : NaN));
  // Where shift and a digit write another key's sign, that key is meant.
  return Number.isNaN(digit) || (shiftKey && KEYS[key]) ? 0 : digit + (shiftKey ? 10 : 0);
}

function pressed(event) {
  if (event.ctrlKey || event.metaKey || event.altKey) return false;
  const key = event.key.length === 1 && event.key !== "E" ? event.key.toLowerCase() : event.key;
  if (key === "f") {
    if (state.mode !== "flip") setMode("flip");
    [state.held, state.flipped] = [true, true];
    changed();
    return true;
  }
  const number = numberOf(event);
  if (number) {
    // Light-matched ones first, as in the table.
    const order = [...light(), ...data.variants.keys()].filter((v, i, all) => all.indexOf(v) === i);
    if (order[number - 1] !== undefined) chooseVariant(order[number - 1]);
    return true;
  }
  if (key === "Escape") {
    if (find(".help").open) find(".help").close();
    else { state.pin = null; play(false); chooseFrame(null); }
    return true;
  }
  if (ARROWS[key] && document.activeElement === stage) {
    move(...ARROWS[key].map((v) => v * (event.shiftKey ? 10 : 1)));
    return true;
  }
  if (!KEYS[key]) return false;
  KEYS[key]();
  return true;
}

// Wherever the focus has gone meanwhile.
function letGo() {
  if (!state.held) return;
  [state.held, state.flipped] = [false, stage.matches(":hover")];
  changed();
}

export function startKeys() {
  // Keys belong to whoever has the focus; without one, to the viewer when it is in sight.
  const ours = (event) => {
    const [target, box] = [event.target, root.getBoundingClientRect()];
    const field = target.matches?.("input:not([type=range]):not([type=radio]):not([type=checkbox]), select, textarea");
    const pressable = event.key === " " && target.matches?.("button, summary, a, input");
    if (field || pressable) return false;
    return root.contains(target) || (target === document.body && box.top < innerHeight && box.bottom > 0);
  };
  document.addEventListener("keydown", (event) => {
    if (ours(event) && pressed(event)) event.preventDefault();
  });
  document.addEventListener("keyup", (event) => {
    if (event.key.toLowerCase() === "f") letGo();
  });
  window.addEventListener("blur", letGo);
}
