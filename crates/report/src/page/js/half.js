// Half floats: from packed bytes to numbers. See viewer/encode.rs for the layout.

let values = null;

// Every half float there is, by its bits.
function table() {
  if (values) return values;
  values = new Float32Array(65536);
  for (let bits = 0; bits < 65536; bits++) {
    const [sign, exponent, fraction] = [bits & 0x8000 ? -1 : 1, (bits >> 10) & 31, bits & 1023];
    if (exponent === 31) values[bits] = fraction ? NaN : sign * Infinity;
    else if (exponent === 0) values[bits] = sign * fraction * 2 ** -24;
    else values[bits] = sign * (1 + fraction / 1024) * 2 ** (exponent - 15);
  }
  return values;
}

// Frames of `size` values each, in rows of `width`.
export function unpack(bytes, size, width) {
  const count = (bytes.length - 1) / 2;
  const bits = new Uint16Array(count);
  for (let i = 0; i < count; i++) bits[i] = (bytes[1 + i] << 8) | bytes[1 + count + i];
  if (bytes[0] === 1) {
    for (let i = 1; i < size; i++) if (i % width) bits[i] += bits[i - 1];
    for (let i = size; i < count; i++) bits[i] += bits[i - size];
  }
  const floats = Float32Array.from(bits, (b) => table()[b]);
  return Array.from({ length: count / size }, (_, t) => floats.subarray(t * size, (t + 1) * size));
}
