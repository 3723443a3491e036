#!/usr/bin/env python3
"""Compares umbrage's diffuse interreflection with Mitsuba's path tracer in a closed room.

    python tests/peers/bounces.py

Writes bounces.md, and exits with 1 if a mean is more than 1 % off. Needs what compare.py needs.
"""
import argparse
import subprocess
import sys
import tempfile
from dataclasses import dataclass
from pathlib import Path

import mitsuba as mi
import numpy as np

import cases
import page
from cases import scene_toml

# What the issue asks for; between two path tracers a lost cosine or albedo is tens of percents.
ACCEPTED = 0.01
CHUNK = 64
CAMERA = ([2.6, 1.7, 2.1], [-0.9, 1.1, -0.8], 70.0)
# The lamp closes a hole of the ceiling: in umbrage a lamp is no surface, and a path that leaves through
# the hole ends there; in Mitsuba it meets the lamp, which is black. Nothing else differs.
LAMP = {"kind": "rect", "centre": [0.3, 3.0, -0.2], "half_u": [0.6, 0.0, 0.0], "half_v": [0.0, 0.0, 0.4]}
ALBEDOS = {
    "white": [0.75, 0.75, 0.75], "red": [0.7, 0.08, 0.06], "green": [0.1, 0.6, 0.12],
    "floor": [0.5, 0.45, 0.4], "blocks": [0.3, 0.4, 0.85],
}
WIDTH, HEIGHT, DEPTH = 3.0, 3.0, 2.5  # half of x, all of y, half of z


def main():
    options = arguments()
    mi.set_variant(options.variant)
    with tempfile.TemporaryDirectory() as folder:
        room = Room(Path(folder))
        rows = [row for bounces in options.bounces for row in compare(room, bounces, options)]
    options.out.mkdir(parents=True, exist_ok=True)
    text = written(rows, room, options)
    (options.out / "bounces.md").write_text(text)
    print(text)
    return 0 if all(row.accepted for row in rows) else 1


def arguments():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--umbrage", type=Path, default=cases.REPOSITORY / "target/release/umbrage")
    parser.add_argument("--size", default="160x120")
    parser.add_argument("--bounces", type=int, nargs="+", default=[0, 1, 2, 5])
    parser.add_argument("--samples", type=int, default=1024, help="umbrage's paths a pixel")
    parser.add_argument("--spp", type=int, default=2048, help="Mitsuba's, a multiple of 64")
    parser.add_argument("--variant", default="llvm_ad_rgb")
    parser.add_argument("--out", type=Path, default=cases.REPOSITORY / "reports/peers")
    return parser.parse_args()


class Room:
    """A closed room with three blocks: one OBJ for umbrage, one for each material for Mitsuba."""

    def __init__(self, folder):
        self.folder = folder
        self.quads = walls() + blocks()
        lines, first = ["mtllib room.mtl"], 1
        for material, corners in self.quads:
            lines += [f"v {x} {y} {z}" for x, y, z in corners]
            lines += [f"usemtl {material}", f"f {first} {first + 1} {first + 2} {first + 3}"]
            first += 4
        (folder / "room.obj").write_text("\n".join(lines) + "\n")
        colours = [f"newmtl {name}\nKd {r} {g} {b}" for name, (r, g, b) in ALBEDOS.items()]
        (folder / "room.mtl").write_text("\n".join(colours) + "\n")
        (folder / "scene.toml").write_text(scene_toml('files = ["room.obj"]', LAMP, CAMERA))
        for name in ALBEDOS:
            own = [corners for material, corners in self.quads if material == name]
            vertices = [f"v {x} {y} {z}" for corners in own for x, y, z in corners]
            faces = [f"f {4 * k + a} {4 * k + b} {4 * k + c}" for k in range(len(own)) for a, b, c in ((1, 2, 3), (1, 3, 4))]
            (folder / f"{name}.obj").write_text("\n".join(vertices + faces) + "\n")

    def for_mitsuba(self):
        scene = {"type": "scene", "lamp": lamp()}
        for name, albedo in ALBEDOS.items():
            diffuse = {"type": "diffuse", "reflectance": {"type": "rgb", "value": albedo}}
            scene[name] = {"type": "obj", "filename": str(self.folder / f"{name}.obj"), "face_normals": True,
                           "bsdf": {"type": "twosided", "inner": diffuse}}
        return mi.load_dict(scene)


def lamp():
    u, v = np.array(LAMP["half_u"]), np.array(LAMP["half_v"])
    # It must shine down: a rectangle shines along the product of its sides.
    if np.cross(u, v)[1] > 0:
        v = -v
    matrix = np.eye(4)
    matrix[:3, :3], matrix[:3, 3] = np.transpose([u, v, [0, -1, 0]]), LAMP["centre"]
    return {"type": "rectangle", "to_world": mi.ScalarTransform4f(matrix.tolist()),
            "bsdf": {"type": "diffuse", "reflectance": {"type": "rgb", "value": 0.0}},
            "emitter": {"type": "area", "radiance": {"type": "rgb", "value": 1.0}}}


def walls():
    w, h, d = WIDTH, HEIGHT, DEPTH
    (cx, _, cz), a, b = LAMP["centre"], LAMP["half_u"][0], LAMP["half_v"][2]
    level = lambda x0, x1, z0, z1: [(x0, h, z0), (x1, h, z0), (x1, h, z1), (x0, h, z1)]
    ceiling = [level(-w, cx - a, -d, d), level(cx + a, w, -d, d), level(cx - a, cx + a, -d, cz - b), level(cx - a, cx + a, cz + b, d)]
    return [
        ("floor", [(-w, 0, -d), (w, 0, -d), (w, 0, d), (-w, 0, d)]),
        *(("white", quad) for quad in ceiling),
        ("white", [(-w, 0, -d), (-w, h, -d), (w, h, -d), (w, 0, -d)]),
        ("white", [(-w, 0, d), (-w, h, d), (w, h, d), (w, 0, d)]),
        ("red", [(-w, 0, -d), (-w, h, -d), (-w, h, d), (-w, 0, d)]),
        ("green", [(w, 0, -d), (w, h, -d), (w, h, d), (w, 0, d)]),
    ]


def blocks():
    """Turned boxes; one hangs in the air."""
    quads = []
    for (x, y, z), (a, b, c), degrees in [
        ((-1.4, 0.0, -1.0), (0.5, 1.6, 0.5), 20), ((0.6, 0.0, 0.4), (0.6, 0.7, 0.5), -25), ((-0.3, 1.5, -1.2), (0.8, 0.15, 0.4), 40),
    ]:
        cos, sin = np.cos(np.radians(degrees)), np.sin(np.radians(degrees))
        at = lambda s, t, u: (round(x + cos * s * a - sin * u * c, 4), round(y + t * b, 4), round(z + sin * s * a + cos * u * c, 4))
        for axis in range(3):
            for side in (0, 1):
                corners = []
                for p, q in ((0, 0), (1, 0), (1, 1), (0, 1)):
                    unit = [p, q]
                    unit.insert(axis, side)
                    corners.append(at(2 * unit[0] - 1, unit[1], 2 * unit[2] - 1))
                quads.append(("blocks", corners))
    return quads


@dataclass
class Row:
    bounces: int
    channel: str
    pixels: int
    ours: float
    ratio: float
    ratio_sigma: float
    spread: float       # RMS of the difference over the mean
    noise: float        # what Mitsuba's samples alone would give

    @property
    def accepted(self):
        return abs(self.ratio - 1) <= ACCEPTED


def compare(room, bounces, options):
    hit, ours = umbrage(room, bounces, options)
    theirs, variance = mitsuba(room.for_mitsuba(), bounces, options)
    for k, channel in enumerate("RGB"):
        a, b = ours[hit, k], theirs[hit, k]
        difference = a - b
        # Both programs' noise is in the spread of the difference.
        sigma = difference.std() / np.sqrt(len(a))
        yield Row(bounces, channel, len(a), a.mean(), a.mean() / b.mean(), sigma / b.mean(),
                  np.sqrt(np.mean(difference**2)) / b.mean(), np.sqrt(variance[hit, k].mean()) / b.mean())


def umbrage(room, bounces, options):
    out = room.folder / "room.exr"
    command = [str(options.umbrage), "reference", str(room.folder), "--frame", "0", "--size", options.size, "--samples", "16",
               "--bounces", str(bounces), "--beauty-samples", str(options.samples), "--out", str(out)]
    subprocess.run(command, check=True, stdout=subprocess.DEVNULL)
    bitmap = mi.Bitmap(str(out))
    pixels = np.array(bitmap, dtype=float).reshape(-1, bitmap.channel_count())
    layers = {field.name: pixels[:, k] for k, field in enumerate(bitmap.struct_())}
    return layers["depth.Z"] > 0, np.stack([layers[channel] for channel in "RGB"], axis=1)


def mitsuba(scene, bounces, options):
    """Means and their variances: `path` along rays through the pixels' centres."""
    import drjit as dr
    width, height = (int(side) for side in options.size.split("x"))
    eye, target, yfov_degrees = CAMERA
    sensor = mi.load_dict({
        "type": "perspective", "fov": yfov_degrees, "fov_axis": "y", "near_clip": 1e-3, "far_clip": 1e3,
        "to_world": mi.ScalarTransform4f().look_at(origin=eye, target=target, up=[0, 1, 0]),
        "film": {"type": "hdrfilm", "width": width, "height": height},
    })
    # A path's length in Mitsuba counts the lamp and the first surface; no roulette.
    integrator = mi.load_dict({"type": "path", "max_depth": bounces + 2, "rr_depth": 1000})
    lane = dr.arange(mi.UInt32, width * height * CHUNK)
    pixel = lane // CHUNK
    centre = mi.Point2f((pixel % width + 0.5) / width, (pixel // width + 0.5) / height)
    ray, _ = sensor.sample_ray(0.0, 0.5, centre, mi.Point2f(0.5))
    ray = mi.RayDifferential3f(ray.o, ray.d)
    sums = np.zeros((2, width * height, 3))
    for launch in range(options.spp // CHUNK):
        sampler = mi.load_dict({"type": "independent"})
        sampler.seed(dr.opaque(mi.UInt32, launch), width * height * CHUNK)
        colour, _, _ = integrator.sample(scene, sampler, ray)
        for power in (1, 2):
            sums[power - 1] += np.stack([np.array(dr.block_sum(channel**power, CHUNK)) for channel in (colour.x, colour.y, colour.z)], axis=1)
    mean, squares = sums / options.spp
    return mean, np.maximum(squares - mean**2, 0) / (options.spp - 1)


def written(rows, room, options):
    failed = [f"{row.bounces} bounces, {row.channel}" for row in rows if not row.accepted]
    verdict = "**Not accepted**: " + "; ".join(failed) if failed else f"**Accepted**: all {len(rows)} means."
    lines = [f"""# Diffuse interreflection against Mitsuba's path tracer

Written by `tests/peers/bounces.py`; the README there says how to run it.

{verdict} Asked for is a mean within {ACCEPTED:.0%}, for each colour.

| | |
| --- | --- |
| umbrage | {page.said(options.umbrage, "--version")}, checkout at {page.said("git", "-C", cases.REPOSITORY, "describe", "--always", "--dirty", "--exclude", "*")}, `reference --bounces N --beauty-samples {options.samples}` |
| Mitsuba | {mi.__version__}, `{options.variant}`, integrator `path`, `max_depth` N + 2, no roulette, {options.spp} samples |
| room | {2 * WIDTH:g} x {HEIGHT:g} x {2 * DEPTH:g} m, three blocks, {2 * len(room.quads)} triangles; a rectangle of 1.2 x 0.8 m in the ceiling |
| albedos | {"; ".join(f"{name} {', '.join(map(str, albedo))}" for name, albedo in ALBEDOS.items())} |
| pictures | {options.size}, through the middle of each pixel that sees a surface |

The lamp closes a hole of the ceiling, because in umbrage a lamp is no surface: a path that leaves
through the hole is lost there, and in Mitsuba it ends on the lamp, which is black. N counts reflections
after the first surface. *Ratio* is umbrage's mean over Mitsuba's, with one standard error from the
spread of the difference, hence both programs' noise. Colours share their paths and rows their seeds:
they deviate together. *RMSE* is that of a pixel, and *Mitsuba's noise*
what its samples alone would give, both over the mean.

| N | | mean | ratio | sigma | RMSE | Mitsuba's noise |
| --- | --- | --- | --- | --- | --- | --- |"""]
    for row in rows:
        lines.append(f"| {row.bounces} | {row.channel} | {row.ours:.5f} | **{row.ratio:.5f} ± {row.ratio_sigma:.5f}** "
                     f"| {(row.ratio - 1) / row.ratio_sigma:+.1f} | {row.spread:.4f} | {row.noise:.4f} |")
    return "\n".join(lines) + "\n"


if __name__ == "__main__":
    sys.exit(main())
