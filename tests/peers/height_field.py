"""Writes a height field of 10 million triangles as glb, for the floor of memory: height_field.py OUT.glb"""
import json
import struct
import sys

import numpy as np

SIDE = 2237

x, z = np.meshgrid(*[np.linspace(-50, 50, SIDE, dtype=np.float32)] * 2)
y = (np.sin(x * 1.7) * np.cos(z * 1.3) + 0.05 * np.sin(37 * x) * np.sin(41 * z)).astype(np.float32)
positions = np.stack([x, y, z], -1).reshape(-1, 3)
at = np.arange(SIDE * SIDE, dtype=np.uint32).reshape(SIDE, SIDE)
a, b, c, d = at[:-1, :-1], at[:-1, 1:], at[1:, :-1], at[1:, 1:]
triangles = np.concatenate([np.stack(t, -1).reshape(-1, 3) for t in ([a, c, b], [b, c, d])])
first, second = positions.tobytes(), triangles.tobytes()
document = {
    "asset": {"version": "2.0"},
    "scene": 0,
    "scenes": [{"nodes": [0]}],
    "nodes": [{"mesh": 0, "name": "field"}],
    "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1}]}],
    "buffers": [{"byteLength": len(first) + len(second)}],
    "bufferViews": [
        {"buffer": 0, "byteOffset": 0, "byteLength": len(first)},
        {"buffer": 0, "byteOffset": len(first), "byteLength": len(second)},
    ],
    "accessors": [
        {"bufferView": 0, "componentType": 5126, "type": "VEC3", "count": len(positions),
         "min": positions.min(0).tolist(), "max": positions.max(0).tolist()},
        {"bufferView": 1, "componentType": 5125, "type": "SCALAR", "count": triangles.size},
    ],
}
text = json.dumps(document).encode()
text += b" " * (-len(text) % 4)
data = first + second
body = struct.pack("<II", len(text), 0x4E4F534A) + text + struct.pack("<II", len(data), 0x004E4942) + data
with open(sys.argv[1], "wb") as file:
    file.write(struct.pack("<III", 0x46546C67, 2, 12 + len(body)) + body)
print(len(triangles), "triangles")
