// The surface points of a window: where they lie, and where each frame sees them.
import { inverse, project, unproject } from "./camera.js";
import { data, plane } from "./planes.js";

const positions = new Map();
const maps = new Map();

const middle = (window) => Math.floor(data.windows[window].frames / 2);

// World position of a pixel of the middle frame; null where nothing is seen.
export function positionOf(window, pixel) {
  const w = data.windows[window];
  const depth = plane(window, "depth")?.[0][pixel];
  if (!(depth > 0) || !w.cameras.length) return null;
  if (!positions.has(window)) positions.set(window, inverse(w.cameras[middle(window)]));
  const place = { x: (pixel % w.width) + 0.5, y: Math.floor(pixel / w.width) + 0.5, depth };
  return unproject(positions.get(window), place, w);
}

// Where a point of the middle frame lands in another one: pixels and depth.
export function placeIn(window, pixel, frame) {
  const world = positionOf(window, pixel);
  return world && project(data.windows[window].cameras[frame], world, data.windows[window]);
}

// For each pixel of a frame, the point of the middle frame that it shows, or -1.
export function mapOf(window, frame) {
  const key = window + "/" + frame;
  if (maps.has(key)) return maps.get(key);
  const w = data.windows[window];
  if (!plane(window, "depth") || !w.cameras.length) return null;
  const map = filled(splat(window, frame), w);
  maps.set(key, map);
  return map;
}

function splat(window, frame) {
  const { width, height } = data.windows[window];
  const map = new Int32Array(width * height).fill(-1);
  const nearest = new Float32Array(width * height).fill(Infinity);
  for (let pixel = 0; pixel < width * height; pixel++) {
    const place = placeIn(window, pixel, frame);
    if (!place || place.x < 0 || place.y < 0 || place.x >= width || place.y >= height) continue;
    const at = Math.floor(place.y) * width + Math.floor(place.x);
    if (place.depth < nearest[at]) [nearest[at], map[at]] = [place.depth, pixel];
  }
  return map;
}

// Closes the cracks that open between points as the camera comes closer: one pixel, between two neighbours.
function filled(map, { width, height }) {
  const out = map.slice();
  for (let y = 1; y + 1 < height; y++) {
    for (let x = 1; x + 1 < width; x++) {
      const at = y * width + x;
      if (map[at] >= 0) continue;
      const across = map[at - 1] >= 0 && map[at + 1] >= 0;
      const along = map[at - width] >= 0 && map[at + width] >= 0;
      if (across || along) out[at] = across ? map[at - 1] : map[at - width];
    }
  }
  return out;
}
