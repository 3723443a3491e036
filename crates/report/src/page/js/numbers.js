// Numbers drawn into the pixels of a picture: ten thousand of them within a frame.
//
// Each text is set once and copied by hand: a canvas takes four times as long for as many small pictures.
import { isDark } from "./colour.js";
import { ADVANCE } from "./digits.js";

const sets = new Map();

// The texts of one size and ink that have been set.
function setOf(size, ratio, light) {
  const key = `${size}/${ratio}/${light}`;
  if (!sets.has(key)) {
    if (sets.size > 40) sets.clear();
    sets.set(key, new Map());
  }
  const set = sets.get(key);
  if (set.size > 3000) set.clear();
  return (text) => {
    if (!set.has(text)) set.set(text, letters(text, size * ratio, light));
    return set.get(text);
  };
}

// A text as pixels of the screen.
function letters(text, size, light) {
  const canvas = document.createElement("canvas");
  const [width, height] = [Math.ceil(text.length * ADVANCE * size + 2), Math.ceil(size)];
  [canvas.width, canvas.height] = [width, height];
  const ctx = canvas.getContext("2d", { willReadFrequently: true });
  ctx.font = `${size}px ui-monospace, Menlo, Consolas, "DejaVu Sans Mono", monospace`;
  // Without an outline: the colour around a small number has to be seen.
  [ctx.textAlign, ctx.textBaseline, ctx.fillStyle] = ["center", "middle", light ? "#fff" : "#000"];
  ctx.fillText(text, width / 2, height / 2 + 0.5);
  return { pixels: new Int32Array(ctx.getImageData(0, 0, width, height).data.buffer), width, height };
}

let sheet = null;

// A transparent picture of the size of the stage.
function cleared({ width, height }) {
  if (sheet?.image.width !== width || sheet.image.height !== height) {
    const canvas = document.createElement("canvas");
    [canvas.width, canvas.height] = [width, height];
    const image = new ImageData(width, height);
    sheet = { canvas, image, ctx: canvas.getContext("2d"), pixels: new Int32Array(image.data.buffer) };
  }
  sheet.pixels.fill(0);
  return sheet;
}

function copy({ pixels, width, height }, left, top, to) {
  const { width: columns, height: rows } = to.image;
  const [x0, x1] = [Math.max(0, -left), Math.min(width, columns - left)];
  for (let y = Math.max(0, -top); y < Math.min(height, rows - top); y++) {
    const row = (top + y) * columns + left;
    for (let x = x0; x < x1; x++) if (pixels[y * width + x]) to.pixels[row + x] = pixels[y * width + x];
  }
}

// One number a pixel, or a tile of `step` pixels.
export function numbers(ctx, view, [ox, oy], { x0, x1, y0, y1 }, { value, form, step, ratio, size, scale, cut }) {
  const to = cleared(ctx.canvas);
  // Half a number beside half of another layer's would be a third number.
  const whole = ([low, high], from, upTo) => (low <= 0 || from >= low * ratio) && (high * ratio >= ctx.canvas.width || upTo <= high * ratio);
  const [dark, light] = [false, true].map((is) => setOf(form.size, ratio, is));
  const middle = (from, top) => 0.5 * (from + Math.min(top, from + step));
  for (let y = y0; y < y1; y += step) {
    const cy = (oy + middle(y, size.height) * view.zoom) * ratio;
    for (let x = x0; x < x1; x += step) {
      const number = value(x, y);
      const text = form.text(number);
      if (!text) continue;
      const set = (isDark(number, scale) ? light : dark)(text);
      const cx = (ox + middle(x, size.width) * view.zoom) * ratio;
      if (!whole(cut, cx - set.width / 2, cx + set.width / 2)) continue;
      copy(set, Math.round(cx - set.width / 2), Math.round(cy - set.height / 2), to);
    }
  }
  to.ctx.putImageData(to.image, 0, 0);
  ctx.save();
  ctx.setTransform(1, 0, 0, 1, 0, 0);
  ctx.drawImage(to.canvas, 0, 0);
  ctx.restore();
}
