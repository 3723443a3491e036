// The viewer: from its state to what is on the screen.
import { differenceOf, scaleOf } from "./colour.js";
import { data, fetchPlane, onPlane, plane } from "./planes.js";
import { groups, hasTime, isTiled, kindOf, labelOf, valuesOf } from "./layers.js";
import { unlike } from "./captions.js";
import { mapOf } from "./points.js";
import { Painter, drawPane, panes, pictureAt } from "./stage.js";
import { changed, current, onChange, state, whereIs } from "./state.js";
import { inspect } from "./inspect.js";
import { plotPoint } from "./series.js";
import { says } from "./says.js";

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

// Right less left; `refused`: why there is none.
function difference() {
  const ids = [state.left, state.right];
  const [left, right] = ids.map((id) => ({ kind: kindOf(id), label: labelOf(id) }));
  const refused = unlike(right, left);
  const [a, b] = refused ? [] : ids.map((id) => valuesOf(state.window, id, state.frame));
  return { id: ids.join("|"), kind: left.kind, refused, tiled: isTiled(state.window, state.left), values: a && b ? b.map((v, i) => v - a[i]) : null };
}

const single = (id) => ({ id, kind: kindOf(id), tiled: isTiled(state.window, id), values: valuesOf(state.window, id, state.frame) });

// A layer as the stage draws it.
function shown(slot) {
  const isDifference = slot === "difference";
  const { id, kind, values, tiled, refused } = isDifference ? difference() : single(state[slot]);
  const [map, w] = [mapNow(), current()];
  const { window, frame, moving, exposure, errorLimit, swimLimit } = state;
  const key = [window, id, frame, moving, exposure, errorLimit, swimLimit].join("/");
  const limits = { exposure, errorLimit, swimLimit, depthLimit: depthLimit(), cellLimits: w.cell_limits };
  const scale = isDifference ? differenceOf(kind, limits) : scaleOf(kind, limits);
  const ready = values && (!moving || frame === null || map);
  const value = (x, y) => {
    const at = y * w.width + x;
    const from = map ? map[at] : at;
    return from < 0 ? NaN : values[from];
  };
  // Points that move take their tiles with them: there is no middle to write in.
  const tile = tiled && !map ? data.tile_px : 0;
  const canvas = ready ? painter.picture(key, w, values, map, scale) : null;
  return { id, size: w, canvas, value, kind, scale, tile, tiled, refused, isDifference };
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

function render() {
  const [ctx, ratio] = fitStage();
  ctx.setTransform(1, 0, 0, 1, 0, 0);
  ctx.clearRect(0, 0, ctx.canvas.width, ctx.canvas.height);
  const marks = { tile: state.tiles ? data.tile_px : 0, crosses: crosses(), box: state.box };
  const drawn = panesNow().map((pane) => {
    const layer = shown(pane.slot);
    return { ...layer, form: drawPane(ctx, ratio, state.view, pane, size.height, layer, marks) };
  });
  says(root, mode(), drawn);
  stage.dataset.ready = String(drawn.every((d) => d.canvas || d.refused));
  stage.dataset.zoom = state.view.zoom.toFixed(3);
  // A pinned point is plotted; the inspector reads what is pointed at, and the pinned point otherwise.
  const pointed = state.cursor ? pixelAt(state.cursor) : null;
  inspect(find(".inspector"), pointed ?? state.pin, pointed === null && state.pin !== null);
  if (hasTime(state.window)) plotPoint(find(".point svg"), state.pin ?? pointed);
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
