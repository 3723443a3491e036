// The stage: one canvas that shows two layers in one of four ways, zoomed and panned together.
import { paint } from "./colour.js";
import { fitting } from "./digits.js";
import { numbers } from "./numbers.js";

const BORDERS_FROM = 8;

// A painted picture, kept until something that it depends on changes.
export class Painter {
  constructor() {
    this.kept = new Map();
  }

  // `key` names everything that the colours depend on.
  picture(key, { width, height }, values, map, scale) {
    if (this.kept.has(key)) return this.kept.get(key);
    if (this.kept.size > 80) this.kept.clear();
    const canvas = document.createElement("canvas");
    [canvas.width, canvas.height] = [width, height];
    const image = new ImageData(width, height);
    paint(image, values, map, scale);
    canvas.getContext("2d").putImageData(image, 0, 0);
    this.kept.set(key, canvas);
    return canvas;
  }
}

// The rectangles that layers are shown in: [side, left, width] in screen pixels, and what is cut off.
export function panes(mode, split, width) {
  if (mode === "side") {
    const half = Math.floor(width / 2) - 2;
    return [
      { slot: "left", left: 0, width: half, cut: [0, half] },
      { slot: "right", left: width - half, width: half, cut: [0, half] },
    ];
  }
  const whole = (slot, cut) => ({ slot, left: 0, width, cut });
  if (mode === "slider") return [whole("left", [0, split * width]), whole("right", [split * width, width])];
  return [whole(mode === "difference" ? "difference" : mode === "flipped" ? "right" : "left", [0, width])];
}

// The place of the picture at a point of the stage.
export function pictureAt(view, pane, height, x, y) {
  return {
    x: view.x + (x - pane.left - pane.width / 2) / view.zoom,
    y: view.y + (y - height / 2) / view.zoom,
  };
}

// Draws one layer into its pane. `shown`: {canvas, value(x, y), size, kind, scale, tile}. Returns the form of its numbers.
export function drawPane(ctx, ratio, view, pane, height, shown, marks) {
  const { left, width, cut } = pane;
  ctx.save();
  ctx.setTransform(ratio, 0, 0, ratio, 0, 0);
  ctx.beginPath();
  ctx.rect(left + cut[0], 0, cut[1] - cut[0], height);
  ctx.clip();
  const origin = [left + width / 2 - view.x * view.zoom, height / 2 - view.y * view.zoom];
  let form = null;
  if (shown.canvas) {
    ctx.imageSmoothingEnabled = false;
    const { width: columns, height: rows } = shown.size;
    ctx.drawImage(shown.canvas, origin[0], origin[1], columns * view.zoom, rows * view.zoom);
    const seen = visible(view, pane, height, shown.size);
    if (view.zoom >= BORDERS_FROM) borders(ctx, view, origin, seen, 1);
    // A tile has room for its number sooner than a pixel.
    const step = shown.tile || 1;
    form = view.zoom >= BORDERS_FROM || step > 1 ? fitting(shown.kind, shown.scale, view.zoom * step, ratio) : null;
    if (form) numbers(ctx, view, origin, step > 1 ? wholeTiles(seen, step, shown.size) : seen, { ...shown, step, form, ratio, cut: [left + cut[0], left + cut[1]] });
    if (marks.tile) borders(ctx, view, origin, wholeTiles(seen, marks.tile, shown.size), marks.tile);
    marks.crosses.forEach((mark) => cross(ctx, view, origin, mark));
    if (marks.box) box(ctx, view, origin, marks.box);
  }
  ctx.restore();
  return form;
}

// Columns and rows that can be seen.
function visible(view, pane, height, size) {
  const a = pictureAt(view, pane, height, pane.left, 0);
  const b = pictureAt(view, pane, height, pane.left + pane.width, height);
  const clamp = (v, top) => Math.max(0, Math.min(top, v));
  return {
    x0: clamp(Math.floor(a.x), size.width), x1: clamp(Math.ceil(b.x), size.width),
    y0: clamp(Math.floor(a.y), size.height), y1: clamp(Math.ceil(b.y), size.height),
  };
}

const wholeTiles = ({ x0, x1, y0, y1 }, tile, size) => ({
  x0: Math.floor(x0 / tile) * tile, x1: Math.min(size.width, Math.ceil(x1 / tile) * tile),
  y0: Math.floor(y0 / tile) * tile, y1: Math.min(size.height, Math.ceil(y1 / tile) * tile),
});

function borders(ctx, view, [ox, oy], { x0, x1, y0, y1 }, step) {
  ctx.beginPath();
  for (let x = x0; x <= x1; x += step) {
    const at = Math.round(ox + x * view.zoom) + 0.5;
    ctx.moveTo(at, oy + y0 * view.zoom);
    ctx.lineTo(at, oy + y1 * view.zoom);
  }
  for (let y = y0; y <= y1; y += step) {
    const at = Math.round(oy + y * view.zoom) + 0.5;
    ctx.moveTo(ox + x0 * view.zoom, at);
    ctx.lineTo(ox + x1 * view.zoom, at);
  }
  ctx.strokeStyle = step > 1 ? "rgb(61 140 255 / .75)" : "rgb(128 128 128 / .45)";
  ctx.lineWidth = 1;
  ctx.stroke();
}

function cross(ctx, view, [ox, oy], { x, y, pinned }) {
  const [cx, cy] = [ox + x * view.zoom, oy + y * view.zoom];
  const r = Math.max(7, Math.min(view.zoom * 0.5, 22));
  for (const [style, width] of [["#000", 3], [pinned ? "#ffb000" : "#fff", 1.4]]) {
    ctx.strokeStyle = style;
    ctx.lineWidth = width;
    ctx.beginPath();
    if (pinned) ctx.arc(cx, cy, r, 0, 2 * Math.PI);
    for (const [dx, dy] of [[1, 0], [-1, 0], [0, 1], [0, -1]]) {
      ctx.moveTo(cx + dx * r * 0.6, cy + dy * r * 0.6);
      ctx.lineTo(cx + dx * r * 1.5, cy + dy * r * 1.5);
    }
    ctx.stroke();
  }
}

function box(ctx, view, [ox, oy], [x, y, w, h]) {
  ctx.strokeStyle = "#ffb000";
  ctx.lineWidth = 2;
  ctx.strokeRect(ox + x * view.zoom, oy + y * view.zoom, w * view.zoom, h * view.zoom);
}
