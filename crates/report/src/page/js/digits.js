// The numbers in pixels: as many digits as fit.

// Smallest letters, in pixels of the screen: below, no font has legible digits.
const SMALLEST = 8.5;
const LARGEST = 13;
// Width of a letter of a monospaced font, of its size.
export const ADVANCE = 0.6;

const minus = (v) => (v < 0 ? "−" : "+");
const bare = (v, digits) => Math.abs(v).toFixed(digits).replace(/^0/, "");

// From long to short: [letters, text of a value, what it says].
function forms(kind, { low, high }) {
  const limit = Math.max(Math.abs(low), high);
  const digits = Math.max(2, Math.min(5, 1 - Math.floor(Math.log10(limit))));
  const full = {
    shadow: [3, (v) => (v >= 0.995 ? "1" : bare(v, 2))],
    depth: [5, (v) => v.toFixed(2)],
  }[kind] ?? (low < 0 ? [digits + 2, (v) => minus(v) + bare(v, digits)] : [digits + 1, (v) => bare(v, digits)]);
  const steps = (letters) => {
    const unit = 10 ** (Math.ceil(Math.log10(limit) - 1e-9) - letters);
    const text = (v) => {
      const count = Math.round(Math.abs(v) / unit);
      return count < 10 ** letters ? String(count) : "+";
    };
    const sign = low < 0 ? "without sign, " : "";
    return [letters, text, `${sign}in steps of ${Number(unit.toPrecision(1))}; + is ${10 ** letters} or more`];
  };
  return [[...full, ""], steps(2), steps(1)];
}

// The form that fits into a pixel of `zoom` pixels of the page: {text(v), says, size}; null where none does.
export function fitting(kind, scale, zoom, ratio) {
  if (kind === "region") return null;
  for (const [letters, text, says] of forms(kind, scale)) {
    // Between numbers of several digits there has to be a gap; one digit alone may fill its pixel.
    const gap = letters > 1 ? 3 : 1;
    const size = Math.min(LARGEST, (zoom - gap) / (ADVANCE * letters), 1.12 * zoom);
    if (size >= SMALLEST / ratio) return { text: (v) => (v === undefined || Number.isNaN(v) ? "" : text(v)), says, size };
  }
  return null;
}
