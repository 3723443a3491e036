// Cameras: world to picture and back. Matrices are sixteen numbers, column after column.

// The inverse of a matrix, by elimination with pivots.
export function inverse(m) {
  const rows = [0, 1, 2, 3].map((r) => [0, 1, 2, 3, 4, 5, 6, 7].map((c) => (c < 4 ? m[4 * c + r] : c - 4 === r ? 1 : 0)));
  for (let c = 0; c < 4; c++) {
    let pivot = c;
    for (let r = c + 1; r < 4; r++) if (Math.abs(rows[r][c]) > Math.abs(rows[pivot][c])) pivot = r;
    [rows[c], rows[pivot]] = [rows[pivot], rows[c]];
    const by = rows[c][c];
    rows[c] = rows[c].map((v) => v / by);
    for (let r = 0; r < 4; r++) {
      if (r === c) continue;
      const times = rows[r][c];
      rows[r] = rows[r].map((v, i) => v - times * rows[c][i]);
    }
  }
  return [0, 1, 2, 3].flatMap((c) => [0, 1, 2, 3].map((r) => rows[r][4 + c]));
}

const times = (m, [x, y, z, w]) =>
  [0, 1, 2, 3].map((r) => m[r] * x + m[4 + r] * y + m[8 + r] * z + m[12 + r] * w);

// Where a world point lands: pixels (centres at +0.5) and linear depth; null behind the camera.
export function project(clipFromWorld, [x, y, z], { width, height }) {
  const [cx, cy, , cw] = times(clipFromWorld, [x, y, z, 1]);
  if (!(cw > 0)) return null;
  return { x: (0.5 + (0.5 * cx) / cw) * width, y: (0.5 - (0.5 * cy) / cw) * height, depth: cw };
}

// The world point at a place of the picture and a linear depth. In perspective the depth is clip w.
export function unproject(worldFromClip, { x, y, depth }, { width, height }) {
  const [cx, cy] = [((2 * x) / width - 1) * depth, (1 - (2 * y) / height) * depth];
  // w of a world point is 1: that settles the clip depth.
  const [at0, perZ] = [times(worldFromClip, [cx, cy, 0, depth]), times(worldFromClip, [0, 0, 1, 0])];
  const cz = (1 - at0[3]) / perZ[3];
  return [0, 1, 2].map((i) => at0[i] + cz * perZ[i]);
}
