"""Makes leaves.glb: a tree of cut-out twigs, a trellis whose mask repeats, and a floor with a picture.

`python3 make.py` writes it beside itself; nothing but the standard library, the same scene each time.
"""

import json
import math
import pathlib
import random
import struct
import zlib

SIDE = 64
TWIGS, TWIG, CROWN, HEIGHT = 260, 0.62, 1.7, 3.1
dice = random.Random(14)


def png(colour_at):
    rows = b"".join(
        b"\0" + bytes(c for x in range(SIDE) for c in colour_at((x + 0.5) / SIDE, (y + 0.5) / SIDE))
        for y in range(SIDE)
    )
    chunk = lambda kind, data: struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))
    head = struct.pack(">IIBBBBB", SIDE, SIDE, 8, 6, 0, 0, 0)
    return b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", head) + chunk(b"IDAT", zlib.compress(rows, 9)) + chunk(b"IEND", b"")


def twig_at(u, v):
    """Seven leaflets on a stalk that rises from the middle of the lower edge."""
    x, y = u - 0.5, 1 - v
    stalk = abs(x) < 0.012 and y < 0.9
    leaflet = False
    for k in range(7):
        side = 0 if k == 6 else 1 if k % 2 else -1
        root, lean = 0.16 + 0.115 * k, 0.9 * side
        along = (x * math.sin(lean) + (y - root) * math.cos(lean) - 0.15) / 0.15
        across = (x * math.cos(lean) - (y - root) * math.sin(lean)) / 0.062
        leaflet |= along**2 + across**2 < 1
    shade = 0.75 + 0.25 * math.sin(9 * v)
    return int(60 * shade), int(125 * shade), int(40 * shade), 255 if stalk or leaflet else 0


def slats_at(u, v):
    """One crossing of two slats."""
    return 150, 110, 70, 255 if abs(u - 0.5) < 0.17 or abs(v - 0.5) < 0.17 else 0


def tiles_at(u, v):
    grey = 150 if (u % 0.5) > 0.02 and (v % 0.5) > 0.02 else 90
    grey += 25 if (u < 0.5) == (v < 0.5) else 0
    return grey, grey - 6, grey - 16, 255


class Mesh:
    def __init__(self):
        self.positions, self.uvs = [], []

    def quad(self, middle, u, v, tiles=(1, 1)):
        corner = lambda s, t: [middle[i] + s * u[i] + t * v[i] for i in range(3)]
        at = [(-1, -1, 0, tiles[1]), (1, -1, tiles[0], tiles[1]), (1, 1, tiles[0], 0), (-1, 1, 0, 0)]
        for s, t, x, y in (at[k] for k in (0, 1, 2, 0, 2, 3)):
            self.positions.append(corner(s, t))
            self.uvs.append((x, y))


def unit(v):
    length = math.sqrt(sum(c * c for c in v))
    return [c / length for c in v]


def in_ball():
    while True:
        at = [dice.uniform(-1, 1) for _ in range(3)]
        if 0.01 < sum(c * c for c in at) < 1:
            return at


def cross(a, b):
    return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]


def meshes():
    # As in the scene `foliage`: the shadow's middle lies at (0, -1) under a sun at elevation 50, azimuth 30.
    back = HEIGHT / math.tan(math.radians(50))
    crown = [back * math.cos(math.radians(30)), HEIGHT, back * math.sin(math.radians(30)) - 1]
    floor, twigs, trellis, trunk = Mesh(), Mesh(), Mesh(), Mesh()
    floor.quad([0, 0, 0], [5, 0, 0], [0, 0, -5], (10, 10))
    for _ in range(TWIGS):
        middle = [c + CROWN * o for c, o in zip(crown, in_ball())]
        facing, lean = unit(in_ball()), in_ball()
        u = unit(cross(facing, lean))
        v = cross(u, facing)
        twigs.quad(middle, [0.5 * TWIG * c for c in u], [0.5 * TWIG * c for c in v])
    trellis.quad([-2.2, 1.0, 0.9], [1.8, 0, 0], [0, 0.95, 0], (20, 10.5))
    for k in range(8):
        a, b = (math.tau * (k + e) / 8 for e in (0, 1))
        ends = [[0.11 * math.cos(t), 0, 0.11 * math.sin(t)] for t in (b, a)]
        middle = [crown[0] + 0.5 * (ends[0][0] + ends[1][0]), 1.3, crown[2] + 0.5 * (ends[0][2] + ends[1][2])]
        trunk.quad(middle, [0.5 * (q - p) for p, q in zip(*ends)], [0, 1.3, 0])
    return [("floor", floor, 0), ("twigs", twigs, 1), ("trellis", trellis, 2), ("trunk", trunk, 3)]


def main():
    parts, blob = [], b""

    def view(data):
        nonlocal blob
        parts.append({"buffer": 0, "byteOffset": len(blob), "byteLength": len(data)})
        blob += data + b"\0" * (-len(data) % 4)
        return len(parts) - 1

    accessors, nodes, shapes = [], [], []
    for name, mesh, paint in meshes():
        flat = lambda rows: struct.pack(f"<{len(rows) * len(rows[0])}f", *(c for row in rows for c in row))
        bounds = {k: [f(p[i] for p in mesh.positions) for i in range(3)] for k, f in (("min", min), ("max", max))}
        for rows, kind, more in ((mesh.positions, "VEC3", bounds), (mesh.uvs, "VEC2", {})):
            accessors.append(
                {"bufferView": view(flat(rows)), "componentType": 5126, "type": kind, "count": len(rows), **more}
            )
        last = len(accessors) - 1
        primitive = {"attributes": {"POSITION": last - 1, "TEXCOORD_0": last}, "material": paint}
        shapes.append({"primitives": [primitive]})
        nodes.append({"name": name, "mesh": len(shapes) - 1})
    pictures = [png(at) for at in (tiles_at, twig_at, slats_at)]
    images = [{"bufferView": view(p), "mimeType": "image/png"} for p in pictures]
    colour = lambda k: {"pbrMetallicRoughness": {"baseColorTexture": {"index": k}}}
    masked = {"alphaMode": "MASK", "alphaCutoff": 0.5, "doubleSided": True}
    bark = {"name": "bark", "pbrMetallicRoughness": {"baseColorFactor": [0.32, 0.24, 0.17, 1]}}
    materials = [
        {"name": "tiles", **colour(0)},
        {"name": "twig", **colour(1), **masked},
        {"name": "trellis", **colour(2), **masked},
        bark,
    ]
    document = {
        "asset": {"version": "2.0", "generator": "make.py"},
        "nodes": nodes,
        "meshes": shapes,
        "materials": materials,
        "textures": [{"source": k} for k in range(3)],
        "images": images,
        "accessors": accessors,
        "bufferViews": parts,
        "buffers": [{"byteLength": len(blob)}],
    }
    text = json.dumps(document, separators=(",", ":")).encode()
    text += b" " * (-len(text) % 4)
    whole = struct.pack("<4sII", b"glTF", 2, 28 + len(text) + len(blob))
    whole += struct.pack("<I4s", len(text), b"JSON") + text + struct.pack("<I4s", len(blob), b"BIN\0") + blob
    pathlib.Path(__file__).with_name("leaves.glb").write_bytes(whole)


main()
