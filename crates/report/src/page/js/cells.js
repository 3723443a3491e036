// The cells of the squared error as maps: by pixel where they are stored so, otherwise by tile.
import { data, has, plane } from "./planes.js";

// What adds up to each map, by the places of the stored planes (viewer/cells.rs).
const PARTS = {
  mse: [0, 1, 2, 3, 4], banding: [1, 3], swimming: [2, 3],
  smooth_static: [0], structured_static: [1], smooth_moving: [2], structured_moving: [3], noise: [4],
};
const MOVING = [2, 3];

export const CELLS = {
  mse: "ERROR", banding: "BANDING", swimming: "SWIMMING",
  smooth_static: "smooth static", structured_static: "structured static",
  smooth_moving: "smooth moving", structured_moving: "structured moving", noise: "noise",
};

export const isCell = (kind) => kind in PARTS;
export const byPixel = (window, v) => has(window, `v${v}-cells`);
export const hasCells = (window, v) => byPixel(window, v) || has(window, `v${v}-tiles`);

// One frame says nothing about what moves.
const partsOf = (window, kind) => PARTS[kind].filter((p) => data.windows[window].frames > 1 || !MOVING.includes(p));
export const cellKinds = (window) => Object.keys(PARTS).filter((kind) => partsOf(window, kind).length);

export const grid = ({ width, height }) => ({ width: Math.ceil(width / data.tile_px), height: Math.ceil(height / data.tile_px) });

export function tileOf(window, pixel) {
  const { width } = data.windows[window];
  return { column: Math.floor((pixel % width) / data.tile_px), row: Math.floor(pixel / width / data.tile_px) };
}

// Mean squares; stored are roots, with the sign of an estimate that may be below 0.
const square = (root) => root * Math.abs(root);
const sum = (planes, parts, i) => parts.reduce((all, p) => all + square(planes[p][i]), 0);

// A cell of a tile, visibility squared: undefined until it is here, NaN without penumbra.
export function tileScore(window, v, kind, { column, row }) {
  const planes = has(window, `v${v}-tiles`) ? plane(window, `v${v}-tiles`) : null;
  if (!planes) return undefined;
  const parts = partsOf(window, kind);
  return parts.length ? sum(planes, parts, row * grid(data.windows[window]).width + column) : NaN;
}

const maps = new Map();

// The root of a cell at each pixel, 0 where its estimate is below; null until it is here.
export function cellValues(window, v, kind) {
  const key = `${window}/${v}/${kind}`;
  if (maps.has(key)) return maps.get(key);
  const pixels = byPixel(window, v);
  const planes = plane(window, `v${v}-${pixels ? "cells" : "tiles"}`);
  if (!planes) return null;
  if (maps.size > 40) maps.clear();
  const [parts, { width, height }] = [partsOf(window, kind), data.windows[window]];
  const { width: columns } = grid(data.windows[window]);
  const at = (i) => (pixels ? i : Math.floor(i / width / data.tile_px) * columns + Math.floor((i % width) / data.tile_px));
  const values = Float32Array.from({ length: width * height }, (_, i) => {
    const mean = sum(planes, parts, at(i));
    return mean > 0 ? Math.sqrt(mean) : mean * 0;
  });
  maps.set(key, values);
  return values;
}
