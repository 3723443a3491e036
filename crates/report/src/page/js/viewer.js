// The viewer: from its state to what is on the screen.
import { scaleOf } from "./colour.js";
import { data, fetchPlane, onPlane, plane } from "./planes.js";
import { groups, hasTime, kindOf, labelOf, valuesOf } from "./layers.js";
import { mapOf } from "./points.js";
import { Painter, drawPane, panes, pictureAt } from "./stage.js";
import { changed, current, onChange, state, whereIs } from "./state.js";
import { inspect } from "./inspect.js";
import { plotPoint } from "./series.js";

export const root = document.querySelector("#viewer .viewer");
export const stage = root?.querySelector(".stage");
export const find = (selector) => root.querySelector(selector);

const painter = new Painter();
let size = { width: 0, height: 0 };

export const stageSize = () => size;
const mapNow = () => (state.moving && state.frame !== null ? mapOf(state.window, state.frame) : null);

// The point of the middle frame that a place of the shown picture belongs to; null outside.
export function pixelAt({ x, y }) {
  const { width, height } = current();
  if (!(x >= 0 && y >= 0 && x < width && y < height)) return null;
  const at = Math.floor(y) * width + Math.floor(x);
  const from = mapNow()?.[at] ?? at;
  return from < 0 ? null : from;
}

export const mode = () => (state.mode === "flip" ? (state.flipped ? "flipped" : "left") : state.mode);
export const panesNow = () => panes(mode(), state.split, size.width);
export const paneAt = (x) => panesNow().find((p) => x >= p.left + p.cut[0] && x < p.left + p.cut[1]) ?? panesNow()[0];

// Pixel, picture place and pane of a point of the stage.
export const placeAt = (x, y) => pictureAt(state.view, paneAt(x), size.height, x, y);

const depthLimits = new Map();
function depthLimit() {
  const depths = plane(state.window, "depth")?.[0];
  if (!depths) return 100;
  if (!depthLimits.has(state.window)) depthLimits.set(state.window, depths.reduce((most, d) => (d > most ? d : most), 0) || 1);
  return depthLimits.get(state.window);
}

// Right less left.
function difference() {
  const [a, b] = [state.left, state.right].map((id) => valuesOf(state.window, id, state.frame));
  return a && b ? b.map((v, i) => v - a[i]) : null;
}

const text = (kind, v) => {
  if (v === undefined || Number.isNaN(v)) return "";
  if (kind === "region") return "";
  if (kind === "depth") return v.toFixed(2);
  const short = Math.abs(v).toFixed(kind === "shadow" ? 2 : 3).replace(/^0/, "");
  return kind === "error" ? (v < 0 ? "−" : "+") + short : short;
};

function shown(slot) {
  const id = slot === "difference" ? `${state.left}|${state.right}` : state[slot];
  const kind = slot === "difference" ? "error" : kindOf(id);
  const [values, map, w] = [slot === "difference" ? difference() : valuesOf(state.window, id, state.frame), mapNow(), current()];
  const { window, frame, moving, exposure, errorLimit, swimLimit } = state;
  const key = [window, id, frame, moving, exposure, errorLimit, swimLimit].join("/");
  const scale = scaleOf(kind, { exposure, errorLimit, swimLimit, depthLimit: depthLimit() });
  const ready = values && (!moving || frame === null || map);
  const value = (x, y) => {
    const at = y * w.width + x;
    const from = map ? map[at] : at;
    return text(kind, from < 0 ? NaN : values[from]);
  };
  return { size: w, canvas: ready ? painter.picture(key, w, values, map, scale) : null, value, kind, scale };
}

function fitStage() {
  const [ratio, width] = [globalThis.devicePixelRatio || 1, stage.clientWidth];
  const { width: columns, height: rows } = current();
  const whole = state.mode === "side" ? width / 2 : width;
  const height = Math.round(Math.min(Math.max(0.74 * innerHeight, 180), (whole * rows) / columns));
  const canvas = stage.querySelector("canvas");
  if (size.width !== width || size.height !== height || canvas.width !== Math.round(width * ratio)) {
    [canvas.width, canvas.height] = [Math.round(width * ratio), Math.round(height * ratio)];
    [canvas.style.width, canvas.style.height] = [width + "px", height + "px"];
    if (size.width && state.view.zoom) state.view.zoom *= width / size.width;
    size = { width, height };
  }
  if (!state.view.zoom) fit();
  return [canvas.getContext("2d"), ratio];
}

// The whole picture.
export function fit() {
  const { width, height } = current();
  const pane = panesNow()[0];
  state.view = { zoom: Math.min(pane.width / width, size.height / height), x: width / 2, y: height / 2 };
}

// Zooms about a place of the picture that stays where it is.
export function zoom(by, about = { x: state.view.x, y: state.view.y }) {
  const before = state.view.zoom;
  const least = Math.min(0.5, size.width / current().width / 4);
  state.view.zoom = Math.min(128, Math.max(least, before * by));
  const kept = before / state.view.zoom;
  state.view.x = about.x + (state.view.x - about.x) * kept;
  state.view.y = about.y + (state.view.y - about.y) * kept;
  changed();
}

function crosses() {
  const all = [];
  const pin = whereIs(state.pin);
  if (pin) all.push({ ...pin, pinned: true });
  if (state.cursor && state.cursor.shown) all.push({ x: Math.floor(state.cursor.x) + 0.5, y: Math.floor(state.cursor.y) + 0.5 });
  return all;
}

function tags(drawn) {
  const [left, right] = [find(".tag.left"), find(".tag.right")];
  const alone = { left: [state.left, null], flipped: [null, state.right] }[mode()];
  const [a, b] = alone ?? [state.left, state.right];
  const name = (id) => (id ? labelOf(id) : "");
  if (mode() === "difference") [left.textContent, right.textContent] = [`${name(b)}, minus ${name(a)}`, ""];
  else [left.textContent, right.textContent] = [name(a), name(b)];
  left.hidden = !left.textContent;
  right.hidden = !right.textContent;
  find(".split-line").hidden = mode() !== "slider";
  find(".split-line").style.left = 100 * state.split + "%";
  legends(drawn);
}

// A colour bar for each kind that is shown.
function legends(drawn) {
  const units = { shadow: ["shadow", "visibility"], error: ["error", "visibility"], swim: ["swim", "visibility"], se: ["swim", "visibility"], depth: ["swim", "m"] };
  const bars = drawn.filter((d, i) => units[d.kind] && drawn.findIndex((o) => o.kind === d.kind) === i).map(({ kind, scale }) => {
    const [bar, span] = [document.createElement("span"), document.createElement("span")];
    [bar.className, span.className] = ["bar " + units[kind][0], "scale"];
    const end = (v) => String(Number(v.toPrecision(3))).replace("-", "−");
    span.append(end(scale.low), bar, end(scale.high) + " " + units[kind][1]);
    return span;
  });
  find(".legends").replaceChildren(...bars);
}

function render() {
  const [ctx, ratio] = fitStage();
  ctx.setTransform(1, 0, 0, 1, 0, 0);
  ctx.clearRect(0, 0, ctx.canvas.width, ctx.canvas.height);
  const marks = { tile: state.tiles ? data.tile_px : 0, crosses: crosses(), box: state.box };
  const drawn = panesNow().map((pane) => {
    const layer = shown(pane.slot);
    drawPane(ctx, ratio, state.view, pane, size.height, layer, marks);
    return layer;
  });
  tags(drawn);
  stage.dataset.ready = String(drawn.every((d) => d.canvas));
  stage.dataset.zoom = state.view.zoom.toFixed(3);
  const pixel = state.pin ?? (state.cursor ? pixelAt(state.cursor) : null);
  inspect(find(".inspector"), pixel);
  if (hasTime(state.window)) plotPoint(find(".point svg"), pixel);
}

// The choices of a window's layers.
export function fillSlots() {
  for (const slot of ["left", "right"]) {
    const select = find("select." + slot);
    const of = ([title, ids]) => {
      const group = document.createElement("optgroup");
      group.label = title;
      group.append(...ids.map((id) => new Option(labelOf(id), id)));
      return group;
    };
    select.replaceChildren(...groups(state.window).map(of));
    select.value = state[slot];
  }
}

// Every plane of the shown window: the inspector wants them all.
export async function fetchWindow(window) {
  const names = Object.keys(data.planes).filter((key) => key.startsWith(`w${window}-`)).map((key) => key.slice(`w${window}-`.length));
  for (const name of names.sort((a, b) => a.endsWith("series") - b.endsWith("series"))) await fetchPlane(window, name);
}

export function start() {
  onChange(render);
  onPlane(changed);
  new ResizeObserver(changed).observe(stage);
}
