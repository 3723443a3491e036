// What each kind of layer is, in what unit, and what to look for in it.
import { CELLS } from "./cells.js";

const CAPTIONS = {
  shadow: "Shadow: the visible fraction of the light. Compare where soft edges begin and end.",
  error: "Signed error: variant minus truth. Stripes of both colours along an edge are a wrong width; one colour alone is a shifted edge or a leak.",
  swim: "Swim map: how much each surface point changes while the camera moves. Whatever has a shape here crawls or breathes.",
  se: "Truth's standard error: smaller errors than this cannot be told.",
  region: "Penumbra mask: the cells are those of the penumbra; leaks are those of the umbra, false shadow that of the lit part.",
  depth: "Depth along the view.",
  mse: "ERROR: the root of the five cells' sum. Where it is bright, look which cell it comes from.",
  banding: "BANDING: what follows no smooth function of the true shadow, standing or crawling. Bright along soft edges: bands.",
  swimming: "SWIMMING: both moving cells. The truth stands still: all of it is error.",
  smooth_static: "Smooth static: a wrong width or depth that stands still. Bright where penumbrae are too wide, too narrow or missing.",
  structured_static: "Structured static: bands and aliasing that stand still. Few taps show here.",
  smooth_moving: "Smooth moving: penumbrae that breathe as the camera moves.",
  structured_moving: "Structured moving: bands and texels that crawl as the camera moves.",
  noise: "Noise: what differs between pattern seeds; a filter could still reduce it. Black: no randomness.",
};
const UNITS = { depth: "m" };

export const captionOf = (kind, pixels) => CAPTIONS[kind] + (kind in CELLS ? (pixels ? " Root of the cell at each point; hatched: no penumbra." : " Root of its mean over the penumbra of each tile; hatched: no penumbra in it.") : "");
export const unitOf = (kind) => UNITS[kind] ?? (kind in CELLS ? "visibility, root" : "visibility");

// Why two layers have no difference; nothing where they have one.
export function unlike(a, b) {
  if (a.kind === "region" || b.kind === "region") return "The penumbra mask holds names, not numbers: there is no difference.";
  if (a.kind === b.kind) return null;
  return `No difference: “${a.label}” and “${b.label}” are not of one kind. Choose two shadows (the truth is one), or the same map of two variants.`;
}
