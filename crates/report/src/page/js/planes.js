// Planes of a run, unpacked when they are first asked for.
import { unpack } from "./half.js";

export const data = JSON.parse(document.getElementById("viewer-data").textContent);

const loaded = new Map();
const asked = new Map();
const listeners = [];

// Called whenever a plane has arrived.
export function onPlane(listener) {
  listeners.push(listener);
}

const bytesOf = (text) =>
  Uint8Array.fromBase64 ? Uint8Array.fromBase64(text) : Uint8Array.from(atob(text), (c) => c.charCodeAt(0));

async function inflate(bytes) {
  const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream("deflate"));
  return new Uint8Array(await new Response(stream).arrayBuffer());
}

// Beside the page, planes are scripts: a page from a disk may not read files.
function textBeside(key) {
  return new Promise((resolve, reject) => {
    const script = document.createElement("script");
    globalThis.umbragePlanes ??= new Map();
    globalThis.umbragePlane ??= (name, text) => globalThis.umbragePlanes.get(name)?.(text);
    globalThis.umbragePlanes.set(key, resolve);
    script.addEventListener("error", () => reject(new Error(key + " is not beside the page")));
    script.src = data.beside + "/" + key + ".js";
    document.head.append(script);
  });
}

async function load(window, key) {
  const block = document.getElementById("plane-" + key);
  const text = block ? block.textContent : await textBeside(key);
  // Tiles have a pixel each.
  const side = key.endsWith("-tiles") ? data.tile_px : 1;
  const [width, height] = [data.windows[window].width, data.windows[window].height].map((n) => Math.ceil(n / side));
  const frames = unpack(await inflate(bytesOf(text)), width * height, width);
  loaded.set(key, frames);
  return frames;
}

// Whether a window has a plane: "truth", "v3-series".
export const has = (window, name) => `w${window}-${name}` in data.planes;

// The frames of a plane as a promise; nothing where the run has none.
export function fetchPlane(window, name) {
  if (!has(window, name)) return Promise.resolve(null);
  const key = `w${window}-${name}`;
  if (!asked.has(key)) {
    const failed = (error) => void console.warn(String(error));
    asked.set(key, load(window, key).then((frames) => (listeners.forEach((tell) => tell()), frames), failed));
  }
  return asked.get(key);
}

// The frames of a plane if they are here; otherwise they are sent for.
export function plane(window, name) {
  const frames = loaded.get(`w${window}-${name}`);
  if (!frames) fetchPlane(window, name);
  return frames ?? null;
}
