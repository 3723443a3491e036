// What a slot of the viewer can show, and its values.
import { data, has, plane } from "./planes.js";
import { CELLS, byPixel, cellKinds, cellValues, hasCells, isCell } from "./cells.js";

export const REGIONS = ["left out", "umbra", "penumbra", "lit"];

// Names of the truth's own layers, with the kind that says how they are coloured.
const OWN = {
  truth: ["Truth", "shadow"],
  se: ["Truth's standard error", "se"],
  region: ["Penumbra mask", "region"],
  depth: ["Depth", "depth"],
};
const OF_VARIANT = { shadow: "shadow", error: "signed error", swim: "swim map" };

export const variantOf = (id) => (/^v\d+-/.test(id) ? Number(id.slice(1).split("-")[0]) : null);
export const kindOf = (id) => (variantOf(id) === null ? OWN[id][1] : id.split("-")[1]);

export function labelOf(id) {
  const v = variantOf(id);
  if (v === null) return OWN[id][0];
  const { name, label } = data.variants[v];
  return `${name}, ${label}: ${OF_VARIANT[kindOf(id)] ?? CELLS[kindOf(id)]}`;
}

// Whether a layer has a value for each tile, not for each pixel.
export const isTiled = (window, id) => isCell(kindOf(id)) && !byPixel(window, variantOf(id));

// Layers of a window in groups: [title, ids].
export function groups(window) {
  const own = ["Truth", Object.keys(OWN).filter((id) => has(window, id))];
  const all = data.variants.map((v, i) => {
    const kinds = Object.keys(OF_VARIANT).filter((kind) => has(window, `v${i}-${kind === "error" ? "shadow" : kind}`));
    if (hasCells(window, i)) kinds.push(...cellKinds(window));
    return [`${v.name}, ${v.label}`, kinds.map((kind) => `v${i}-${kind}`)];
  });
  return [own, ...all].filter(([, ids]) => ids.length);
}

export const hasSeries = (window, v) => has(window, `v${v}-series`);
export const hasTime = (window) => data.variants.some((_, v) => hasSeries(window, v));

const middle = (window) => Math.floor(data.windows[window].frames / 2);

// Truth at every point in a frame; of a light that stands still it is the same in all.
export function truthAt(window, frame) {
  if (frame !== null && has(window, "truth-series")) return plane(window, "truth-series")?.[frame];
  return plane(window, "truth")?.[0];
}

// A variant's shadow: of a frame, or as the middle frame is shown.
export function shadowAt(window, v, frame) {
  if (frame !== null && hasSeries(window, v)) return plane(window, `v${v}-series`)?.[frame];
  return plane(window, `v${v}-shadow`)?.[0];
}

const errors = new Map();

// What an error is made of; the still picture's truth is the middle frame's.
function parts(window, v, frame) {
  const [shadow, truth] = [shadowAt(window, v, frame), truthAt(window, frame ?? middle(window))];
  const region = has(window, "region") ? plane(window, "region")?.[0] : truth;
  if (!shadow || !truth || !region) return null;
  return { shadow, of: (i) => (region === truth || region[i] > 0 ? shadow[i] - truth[i] : NaN) };
}

// At one pixel.
export const errorOf = (window, v, frame, pixel) => parts(window, v, frame)?.of(pixel);

// Shadow less truth where a point is scored, NaN elsewhere.
export function errorAt(window, v, frame) {
  const from = parts(window, v, frame);
  if (!from) return null;
  const key = `${window}/${v}/${frame}`;
  if (!errors.has(key)) {
    if (errors.size > 60) errors.clear();
    errors.set(key, from.shadow.map((_, i) => from.of(i)));
  }
  return errors.get(key);
}

// The values of a layer, a number for each pixel of the middle frame; null until they are here.
export function valuesOf(window, id, frame) {
  const v = variantOf(id);
  if (id === "truth") return truthAt(window, frame);
  if (v === null) return plane(window, id)?.[0] ?? null;
  if (kindOf(id) === "shadow") return shadowAt(window, v, frame);
  if (kindOf(id) === "error") return errorAt(window, v, frame);
  if (isCell(kindOf(id))) return cellValues(window, v, kindOf(id));
  return plane(window, `v${v}-swim`)?.[0] ?? null;
}

// What a layer lacks while frames are shown; nothing where it has the frame, or is about all of them.
export function lacksFrame(window, id, frame) {
  const v = variantOf(id);
  if (frame === null || v === null || !["shadow", "error"].includes(kindOf(id)) || hasSeries(window, v)) return "";
  return data.beside ? " (no frames stored: the middle one)" : " (no frames stored in this file: --report dir keeps them; the middle one is shown)";
}
