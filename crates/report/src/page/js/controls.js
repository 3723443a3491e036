// The viewer's buttons, fields, pointer and the frames.
import { data } from "./planes.js";
import { hasTime } from "./layers.js";
import { centre, changed, chooseFrame, chooseWindow, current, middle, onChange, state } from "./state.js";
import { fetchWindow, fillSlots, find, fit, pixelAt, placeAt, root, stageSize, stage, start, zoom } from "./viewer.js";
import { frameAt } from "./series.js";

let timer = null;
export const playing = () => timer !== null;

// Plays round and round, or stops.
export function play(on = !playing()) {
  clearInterval(timer);
  timer = null;
  if (on && hasTime(state.window)) {
    timer = setInterval(() => chooseFrame((state.frame ?? -1) + 1), 1000 / Number(find(".speed").value));
  }
  changed();
}

export const step = (by) => {
  play(false);
  chooseFrame((state.frame ?? middle()) + by);
};

// Pins the point at the cursor (or the middle of the view) and brings it to the middle, or lets it go.
export function follow() {
  const place = state.cursor ?? { x: state.view.x, y: state.view.y };
  state.pin = state.pin === null ? pixelAt(place) : null;
  centre();
  changed();
}

export function setMode(name) {
  const before = state.mode;
  state.mode = name;
  find(`input[name=v-mode][value=${name}]`).checked = true;
  // Half the width shows half as much: fit again.
  if ((before === "side") !== (name === "side")) state.view.zoom = 0;
  changed();
}

export const setExposure = (stops) => {
  state.exposure = Math.max(-8, Math.min(10, stops));
  changed();
};

export const actions = {
  "zoom-in": () => zoom(2), "zoom-out": () => zoom(0.5),
  fit: () => { fit(); changed(); },
  swap: () => { [state.left, state.right] = [state.right, state.left]; changed(); },
  tiles: () => { state.tiles = !state.tiles; changed(); },
  help: () => { const help = find(".help"); help.open ? help.close() : help.showModal(); },
  play: () => play(), back: () => step(-1), forward: () => step(1), follow,
  still: () => { play(false); chooseFrame(null); },
  reset: () => { Object.assign(state, { exposure: 0, errorLimit: data.error_limit, swimLimit: current().swim_limit }); changed(); },
};

// Fields show the state, whoever changed it.
function showState() {
  const [time, w] = [hasTime(state.window), current()];
  find("select.where").value = state.window;
  for (const slot of ["left", "right"]) find("select." + slot).value = state[slot];
  find(".exposure").value = state.exposure;
  find(".exposure-value").textContent = (state.exposure > 0 ? "+" : "") + String(state.exposure).replace("-", "−");
  if (document.activeElement !== find(".error-limit")) find(".error-limit").value = Number(state.errorLimit.toPrecision(3));
  if (document.activeElement !== find(".swim-limit")) find(".swim-limit").value = Number(state.swimLimit.toPrecision(3));
  find(".split").value = state.split;
  find(".split").closest("label").hidden = state.mode !== "slider";
  find(".transport").hidden = !time;
  find(".no-time").hidden = time;
  find(".no-time").textContent = w.frames < 2 ? "One frame only: nothing to play." : "Frames of this size are not kept: nothing to play.";
  find(".frame").max = w.frames - 1;
  find(".frame").value = state.frame ?? middle();
  find(".frame").setAttribute("aria-valuetext", "frame " + (w.first + (state.frame ?? middle()) * w.step));
  find(".frame-name").textContent = state.frame === null ? `frame ${w.first + middle() * w.step}, as shown` : `frame ${w.first + state.frame * w.step}`;
  find("[data-do=play]").textContent = playing() ? "Pause" : "Play";
  find("[data-do=follow]").setAttribute("aria-pressed", String(state.pin !== null));
  find("[data-do=tiles]").setAttribute("aria-pressed", String(state.tiles));
  find(".moving").checked = state.moving;
  stage.dataset.frame = String(state.frame);
  stage.dataset.mode = state.mode;
}

export function openWindow(window) {
  play(false);
  chooseWindow(window);
  fillSlots();
  find(".swimming").replaceChildren();
  const plot = document.querySelector(`#time svg.plot[data-window="${window}"]`);
  if (plot) {
    const copy = plot.cloneNode(true);
    // The copy gets a cursor of its own.
    copy.querySelectorAll(".now").forEach((line) => line.remove());
    find(".swimming").append(copy);
    scrubber(copy);
  }
  fetchWindow(window);
}

// A plot over frames that sets the frame where it is pressed.
export function scrubber(svg) {
  const now = document.createElementNS(svg.namespaceURI, "line");
  const { left, right, top, bottom, width, frames, window } = svg.dataset;
  now.setAttribute("class", "now");
  svg.append(now);
  svg.classList.add("scrubber");
  const go = (event) => {
    if (Number(window) !== state.window) openWindow(Number(window));
    const box = svg.getBoundingClientRect();
    const inside = (((event.clientX - box.left) / box.width) * width - left) / (width - left - right);
    play(false);
    chooseFrame(Math.max(0, Math.min(frames - 1, Math.round(inside * (frames - 1)))));
  };
  svg.addEventListener("pointerdown", (event) => { svg.setPointerCapture(event.pointerId); go(event); });
  svg.addEventListener("pointermove", (event) => event.buttons && go(event));
  onChange(() => {
    const on = Number(window) === state.window && state.frame !== null;
    const x = Number(left) + ((state.frame ?? 0) / Math.max(1, frames - 1)) * (width - left - right);
    for (const [key, value] of Object.entries({ x1: x, x2: x, y1: top, y2: bottom })) now.setAttribute(key, value);
    now.style.display = on ? "" : "none";
  });
}

function fields() {
  const on = (selector, event, act) => find(selector).addEventListener(event, (e) => (act(e.target), changed()));
  find("select.where").replaceChildren(...data.windows.map((w, i) => new Option(`${w.scene} · ${w.path}`, i)));
  on("select.where", "change", (t) => openWindow(Number(t.value)));
  for (const slot of ["left", "right"]) on("select." + slot, "change", (t) => (state[slot] = t.value));
  for (const radio of root.querySelectorAll("input[name=v-mode]")) radio.addEventListener("change", () => setMode(radio.value));
  on(".exposure", "input", (t) => setExposure(Number(t.value)));
  const limit = (name) => (t) => { if (Number(t.value) > 0) state[name] = Number(t.value); };
  on(".error-limit", "input", limit("errorLimit"));
  on(".swim-limit", "input", limit("swimLimit"));
  on(".split", "input", (t) => (state.split = Number(t.value)));
  on(".frame", "input", (t) => { play(false); chooseFrame(Number(t.value)); });
  on(".speed", "change", () => playing() && play(true));
  on(".moving", "change", (t) => {
    state.moving = t.checked;
    if (state.frame === null) chooseFrame(middle());
    centre();
  });
  for (const button of root.querySelectorAll("button[data-do]")) button.addEventListener("click", () => actions[button.dataset.do]());
  find(".point svg").addEventListener("pointerdown", (e) => {
    const box = e.currentTarget.getBoundingClientRect();
    play(false);
    chooseFrame(frameAt((e.clientX - box.left) / box.width));
  });
}

const pointers = new Map();

function pointer() {
  const at = (event) => {
    const box = stage.getBoundingClientRect();
    return [event.clientX - box.left, event.clientY - box.top];
  };
  let grabbed = null;
  stage.addEventListener("pointerdown", (event) => {
    const [x, y] = at(event);
    pointers.set(event.pointerId, [x, y]);
    stage.setPointerCapture(event.pointerId);
    grabbed = state.mode === "slider" && Math.abs(x - state.split * stageSize().width) < 14 ? "split" : "view";
  });
  stage.addEventListener("pointermove", (event) => {
    const [x, y] = at(event);
    const before = pointers.get(event.pointerId);
    if (before) {
      if (pointers.size === 2) pinch(event.pointerId, [x, y]);
      else if (grabbed === "split") state.split = Math.max(0, Math.min(1, x / stageSize().width));
      else {
        state.view.x -= (x - before[0]) / state.view.zoom;
        state.view.y -= (y - before[1]) / state.view.zoom;
        // Some of the picture stays in sight.
        const { width, height } = current();
        state.view.x = Math.max(0, Math.min(width, state.view.x));
        state.view.y = Math.max(0, Math.min(height, state.view.y));
      }
      pointers.set(event.pointerId, [x, y]);
    }
    state.cursor = placeAt(x, y);
    changed();
  });
  const release = (event) => pointers.delete(event.pointerId);
  stage.addEventListener("pointerup", release);
  stage.addEventListener("pointercancel", release);
  // What the pointer is over is flipped to; a finger flips while it rests, and reads where it was.
  stage.addEventListener("pointerdown", (e) => {
    if (e.pointerType === "mouse") return;
    Object.assign(state, { flipped: true, cursor: { ...placeAt(...at(e)), shown: true } });
    changed();
  });
  stage.addEventListener("pointerup", (e) => { if (e.pointerType !== "mouse") { state.flipped = Boolean(state.held); changed(); } });
  stage.addEventListener("pointerenter", (e) => { if (e.pointerType === "mouse") { state.flipped = true; changed(); } });
  stage.addEventListener("pointerleave", (e) => {
    state.flipped = Boolean(state.held);
    if (e.pointerType === "mouse") state.cursor = null;
    changed();
  });
  stage.addEventListener("dblclick", (event) => zoom(2, placeAt(...at(event))));
  stage.addEventListener("wheel", (event) => {
    // The page scrolls until somebody means the picture.
    if (document.activeElement !== stage && !event.ctrlKey) return;
    event.preventDefault();
    zoom(2 ** (-event.deltaY / 240), placeAt(...at(event)));
  }, { passive: false });
}

function pinch(id, to) {
  const [other] = [...pointers].filter(([key]) => key !== id).map(([, place]) => place);
  const apart = (a) => Math.hypot(a[0] - other[0], a[1] - other[1]);
  const before = apart(pointers.get(id));
  if (before > 0) zoom(apart(to) / before, placeAt((to[0] + other[0]) / 2, (to[1] + other[1]) / 2));
}

export function startControls() {
  root.hidden = false;
  start();
  fields();
  pointer();
  onChange(showState);
  document.querySelectorAll("#time svg.plot[data-window]").forEach(scrubber);
  // The first picture is drawn when it can be seen: nothing is unpacked for who never looks.
  const seen = new IntersectionObserver((entries) => {
    if (!entries.some((e) => e.isIntersecting)) return;
    seen.disconnect();
    if (!stage.dataset.opened) openWindow(0);
    stage.dataset.opened = "true";
  }, { rootMargin: "400px" });
  seen.observe(root);
}
