// A surface point over the frames: every variant against the truth.
import { data, has, plane } from "./planes.js";
import { hasSeries, truthAt } from "./layers.js";
import { current, middle, state } from "./state.js";

const [WIDTH, HEIGHT, LEFT, RIGHT, TOP, BOTTOM] = [620, 250, 44, 12, 22, 34];

function element(parent, name, attributes, text) {
  const made = document.createElementNS(parent.namespaceURI, name);
  for (const [key, value] of Object.entries(attributes)) made.setAttribute(key, value);
  if (text !== undefined) made.textContent = text;
  parent.append(made);
  return made;
}

// [class, values] of everything that is known of a point.
function lines(pixel) {
  const frames = Array.from({ length: current().frames }, (_, t) => t);
  const truth = ["truth", frames.map((t) => truthAt(state.window, t)?.[pixel])];
  const of = (v) => [data.variants[v].class, plane(state.window, `v${v}-series`)?.map((f) => f[pixel]) ?? [], v];
  const variants = data.variants.map((_, v) => v).filter((v) => hasSeries(state.window, v));
  return [...variants.map(of), truth].filter(([, values]) => values.length && values.every(Number.isFinite));
}

// Draws the plot of a point; nothing where there is no series.
export function plotPoint(svg, pixel) {
  svg.replaceChildren();
  const all = pixel === null ? [] : lines(pixel);
  svg.parentElement.hidden = all.length === 0;
  if (!all.length) return;
  const values = all.flatMap(([, v]) => v);
  let [low, high] = [Math.min(...values), Math.max(...values)];
  // A range that shows no rounding as motion, and ends within what a shadow can be.
  const room = Math.max(0.02, 0.15 * (high - low));
  [low, high] = [Math.max(-0.02, low - room), Math.min(1.02, high + room)];
  const atX = (t) => LEFT + (t / Math.max(1, current().frames - 1)) * (WIDTH - LEFT - RIGHT);
  const atY = (v) => HEIGHT - BOTTOM - ((v - low) / (high - low)) * (HEIGHT - TOP - BOTTOM);
  axes(svg, low, high, atX, atY);
  const path = (v) => "M" + v.map((y, t) => `${atX(t).toFixed(1)} ${atY(y).toFixed(1)}`).join("L");
  const se = has(state.window, "se") ? plane(state.window, "se")?.[0][pixel] : 0;
  const truth = all.at(-1)[1];
  if (se > 0) {
    const [top, back] = [truth.map((v) => v + 2 * se), truth.map((v) => v - 2 * se)];
    const there = path(top);
    const ways = back.map((y, t) => `${atX(t).toFixed(1)} ${atY(y).toFixed(1)}`).reverse();
    element(svg, "path", { class: "truth-band", d: there + "L" + ways.join("L") + "Z" });
  }
  for (const [look, line] of all) element(svg, "path", { class: look === "truth" ? "truth-line" : "line " + look, d: path(line) });
  if (state.frame !== null) element(svg, "line", { class: "now", x1: atX(state.frame), x2: atX(state.frame), y1: TOP, y2: HEIGHT - BOTTOM });
  svg.setAttribute("aria-label", describe(all));
}

function axes(svg, low, high, atX, atY) {
  const step = [0.01, 0.02, 0.05, 0.1, 0.2, 0.5].find((s) => (high - low) / s <= 6) ?? 0.5;
  for (let v = Math.ceil(low / step) * step; v <= high; v += step) {
    element(svg, "line", { class: "grid", x1: LEFT, x2: WIDTH - RIGHT, y1: atY(v), y2: atY(v) });
    element(svg, "text", { class: "tick", x: LEFT - 6, y: atY(v) + 4, "text-anchor": "end" }, v.toFixed(2).replace("-0.00", "0.00"));
  }
  const every = Math.ceil(current().frames / 16);
  for (let t = 0; t < current().frames; t += every) {
    element(svg, "text", { class: "tick", x: atX(t), y: HEIGHT - BOTTOM + 16, "text-anchor": "middle" }, current().first + t * current().step);
  }
  element(svg, "text", { class: "axis", x: 0, y: 10 }, "visibility of this point");
  element(svg, "text", { class: "axis", x: WIDTH - RIGHT, y: HEIGHT - 2, "text-anchor": "end" }, "frame");
}

// The plot in words: how far each variant moves.
function describe(all) {
  const range = (v) => (Math.max(...v) - Math.min(...v)).toFixed(3);
  const words = all.map(([, v, variant]) => `${variant === undefined ? "truth" : data.variants[variant].name} ${range(v)}`);
  return "Visibility of this point over the frames. Largest less smallest: " + words.join(", ");
}

// The frame that a place of the plot stands for.
export const frameAt = (fraction) => {
  const inside = (fraction * WIDTH - LEFT) / (WIDTH - LEFT - RIGHT);
  return Math.max(0, Math.min(current().frames - 1, Math.round(inside * (current().frames - 1))));
};

export const startFrame = () => state.frame ?? middle();
