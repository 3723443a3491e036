// From numbers to colours, with the ramps of the printed pictures.
import { data } from "./planes.js";

const opaque = (r, g, b) => (255 << 24) | (b << 16) | (g << 8) | r;
const ramp = (hex) => Int32Array.from(hex.match(/.{6}/g), (c) => opaque(...c.match(/../g).map((d) => parseInt(d, 16))));
const GREY = Int32Array.from({ length: 256 }, (_, i) => opaque(i, i, i));
const SIGNED = ramp(data.palettes.signed);
const MAGNITUDE = ramp(data.palettes.magnitude);
const HATCH = data.hatch.map((c) => opaque(...c));
const REGION = Int32Array.from([opaque(120, 128, 123), opaque(20, 20, 24), opaque(217, 130, 43), opaque(245, 245, 242)]);

// How a kind of layer is coloured: the ramp, and the numbers at its ends. Exposure is in stops.
export function scaleOf(kind, { exposure, errorLimit, swimLimit, depthLimit, cellLimits }) {
  const gain = 2 ** -exposure;
  if (kind in cellLimits) return { ramp: MAGNITUDE, low: 0, high: cellLimits[kind] * gain };
  if (kind === "error") return { ramp: SIGNED, low: -errorLimit * gain, high: errorLimit * gain };
  if (kind === "swim") return { ramp: MAGNITUDE, low: 0, high: swimLimit * gain };
  if (kind === "se") return { ramp: MAGNITUDE, low: 0, high: 0.02 * gain };
  if (kind === "region") return { ramp: REGION, low: 0, high: 3 };
  if (kind === "depth") return { ramp: MAGNITUDE, low: 0, high: depthLimit * gain };
  return { ramp: GREY, low: 0, high: gain };
}

// How a difference of two layers of a kind is coloured: that of shadows is an error.
export function differenceOf(kind, limits) {
  const { high } = scaleOf(kind === "shadow" ? "error" : kind, limits);
  return { ramp: SIGNED, low: -high, high };
}

export const regionColour = (i) => "#" + [0, 8, 16].map((shift) => ((REGION[i] >> shift) & 255).toString(16).padStart(2, "0")).join("");

// Whether white is easier to read on the colour of a value than black.
export function isDark(value, { ramp, low, high }) {
  const last = ramp.length - 1;
  const colour = ramp[Math.max(0, Math.min(last, Math.round(((value - low) / (high - low)) * last)))];
  // Luma of the three channels; the middle of the scale for the eye.
  return 0.299 * (colour & 255) + 0.587 * ((colour >> 8) & 255) + 0.114 * ((colour >> 16) & 255) < 128;
}

// Colours a picture. `map` says which value each pixel shows (-1: none); without it, its own.
export function paint(image, values, map, { ramp, low, high }) {
  const out = new Int32Array(image.data.buffer);
  const [last, width] = [ramp.length - 1, image.width];
  const by = last / (high - low);
  for (let i = 0; i < out.length; i++) {
    const from = map ? map[i] : i;
    const value = from < 0 ? NaN : values[from];
    if (value !== value) {
      out[i] = HATCH[((i % width) + Math.floor(i / width)) % 8 < 4 ? 1 : 0];
      continue;
    }
    const step = Math.round((value - low) * by);
    out[i] = ramp[step < 0 ? 0 : step > last ? last : step];
  }
}
