#!/usr/bin/env python3
"""How long umbrage and Mitsuba take for V of the atrium to the same error: see README.md beside this file.

    python tests/peers/race.py atrium.obj

Writes time.md. Both look through the middle of each pixel once and spend the rest on the light; what is
timed is that, without loading, trees and compilation. They take turns, and medians count.
"""
import argparse
import statistics
import subprocess
import sys
import tempfile
import time
from pathlib import Path

import drjit as dr
import mitsuba as mi
import numpy as np

import cases
import page
from embree.compare import Side, bench

CASE = "atrium-rect"
GOAL = 0.002
# Tried in this order until the error is small enough.
OURS = [256, 512, 640, 768, 896, 1024, 1152, 1280, 1536, 2048, 4096]
THEIRS = [256, 361, 484, 625, 784, 1024, 1296, 1600, 2025, 2500, 3600, 4900]
# Lanes of one launch, so that memory does not run out.
LANES = 1 << 26


def main():
    options = arguments()
    mi.set_variant(options.variant)
    with tempfile.TemporaryDirectory() as folder:
        race = Race(options, Path(folder))
        ours = next((count, error) for count in OURS if (error := race.our_error(count)) <= GOAL)
        theirs = {"multijitter": next((count, error) for count in THEIRS if (error := race.their_error("multijitter", count)) <= GOAL)}
        if options.independent:
            count = int(np.ceil(256 * (race.their_error("independent", 256) / GOAL) ** 2 / 64)) * 64
            theirs["independent"] = count, race.their_error("independent", count)
        times = race.rounds(ours[0], theirs)
    options.out.mkdir(parents=True, exist_ok=True)
    text = written(ours, theirs, times, options)
    (options.out / "time.md").write_text(text)
    print(text)
    return 0


def arguments():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("atrium", type=Path, help="OBJ of the atrium, named atrium.obj")
    parser.add_argument("--umbrage", type=Path, default=cases.REPOSITORY / "target/release/umbrage")
    parser.add_argument("--size", default="1920x1080")
    parser.add_argument("--truth", type=int, default=1024, help="Sobol points in each half of what errors are taken against")
    parser.add_argument("--rounds", type=int, default=5)
    parser.add_argument("--independent", action="store_true", help="Mitsuba's independent sampler too: ten times slower")
    parser.add_argument("--variant", default="llvm_ad_rgb")
    parser.add_argument("--out", type=Path, default=cases.REPOSITORY / "reports/peers")
    return parser.parse_args()


class Race:
    def __init__(self, options, folder):
        from peer import Peer
        self.options, self.folder = options, folder
        self.size = [int(side) for side in options.size.split("x")]
        self.case = cases.make(CASE, options.atrium, folder)
        self.peer = Peer(self.case)
        # Other samples than those in the race: Sobol's points, not scanlines.
        self.hit, self.truth, self.own = self.umbrage(options.truth, "shafts")

    def umbrage(self, half, method):
        out = self.folder / "ours.exr"
        command = [str(self.options.umbrage), "reference", *self.case.arguments(), "--size", self.options.size,
                   "--samples", str(half), "--method", method, "--out", str(out)]
        subprocess.run(command, check=True, stdout=subprocess.DEVNULL)
        bitmap = mi.Bitmap(str(out))
        pixels = np.array(bitmap, dtype=float).reshape(-1, bitmap.channel_count())
        layers = {field.name: pixels[:, k] for k, field in enumerate(bitmap.struct_())}
        return layers["depth.Z"] > 0, layers["reference.V"], layers["variance.V"]

    def error(self, values, hit):
        """RMSE, less what the truth's own variance adds."""
        both = self.hit & hit
        return float(np.sqrt(np.mean(((values - self.truth) ** 2 - self.own)[both])))

    def our_error(self, count):
        hit, values, _ = self.umbrage(count // 2, "scanlines")
        return self.error(values, hit)

    def their_error(self, sampler, count):
        _, values, hit = self.their_picture(sampler, count, 1)
        return self.error(values, hit)

    def their_picture(self, kind, count, seed):
        """Seconds, V and where anything is hit."""
        from peer import lifted
        peer, (width, height) = self.peer, self.size
        pixels = width * height
        started = time.perf_counter()
        position, normal, hit = self.first_hits()
        # In bands of pixels: in passes of fewer samples their strata would be lost.
        sampler = mi.load_dict({"type": kind, "sample_count": count})
        count = sampler.sample_count()
        sampler.set_samples_per_wavefront(count)
        band = max(1, LANES // count)
        seen = np.zeros(pixels)
        for first in range(0, pixels, band):
            some = min(band, pixels - first)
            sampler.seed(dr.opaque(mi.UInt32, seed * 4096 + first // band), some * count)
            owner = dr.opaque(mi.UInt32, first) + dr.arange(mi.UInt32, some * count) // count
            it = dr.zeros(mi.SurfaceInteraction3f, some * count)
            it.p, it.n = dr.gather(mi.Point3f, position, owner), dr.gather(mi.Normal3f, normal, owner)
            active = dr.gather(mi.Bool, hit, owner)
            ray = lifted(it, peer.light.place(it, sampler.next_2d()), 1e-6)
            active &= dr.dot(it.n, ray.d) > 0
            visible = active & ~peer.scene.ray_test(ray, active)
            seen[first:first + some] = np.array(dr.block_sum(dr.select(visible, mi.Float(1), 0), count)) / count
        return time.perf_counter() - started, seen, np.array(hit)

    def first_hits(self):
        width, height = self.size
        camera = self.case.camera
        if not hasattr(self, "sensor"):
            self.sensor = mi.load_dict({
                "type": "perspective", "fov": camera["yfov_degrees"], "fov_axis": "y", "near_clip": 1e-3, "far_clip": 1e4,
                "to_world": mi.ScalarTransform4f().look_at(origin=camera["eye"], target=camera["target"], up=camera["up"]),
                "film": {"type": "hdrfilm", "width": width, "height": height},
            })
        pixel = dr.arange(mi.UInt32, width * height)
        centre = mi.Point2f((pixel % width + 0.5) / width, (pixel // width + 0.5) / height)
        ray, _ = self.sensor.sample_ray(0.0, 0.5, centre, mi.Point2f(0.5))
        si = self.peer.scene.ray_intersect(mi.Ray3f(ray.o, ray.d))
        normal = dr.select(dr.dot(si.n, ray.d) > 0, -si.n, si.n)
        hit = si.is_valid()
        dr.eval(si.p, normal, hit)
        return si.p, normal, hit

    def rounds(self, ours, theirs):
        """Seconds of each: lists of one number a round."""
        command = [bench(), CASE, "--models", self.options.atrium.resolve().parent, "--size", self.options.size,
                   "--samples", str(ours), "--serve", "--method", "scanlines"]
        side = Side(command)
        times = {"umbrage": [], **{kind: [] for kind in theirs}}
        for turn in range(self.options.rounds):
            times["umbrage"].append(side.ask("camera")["seconds"] + side.ask("truth")["seconds"])
            for kind, (count, _) in theirs.items():
                times[kind].append(self.their_picture(kind, count, 2 + turn)[0])
        side.close()
        return times


def written(ours, theirs, times, options):
    medians = {who: statistics.median(seconds) for who, seconds in times.items()}
    lines = [f"""# Time to an error of {GOAL:g}

Written by `tests/peers/race.py`; the README there says how to run it.

V of the atrium with the rectangular lamp, {options.size}, one camera ray through the middle of each pixel. The
error is that of V over the points that are hit (RMSE) against {2 * options.truth} of umbrage's Sobol points, which
neither uses here, and whose own variance is taken off. Seconds are those of camera rays and V, without loading, trees and compilation:
medians of {options.rounds} rounds in turns, both on all cores of one machine that had other work to do. Only the
ratio means something.

| | samples a point | RMSE | ratio of times |
| --- | ---: | ---: | ---: |
| umbrage {page.said(options.umbrage, "--version").removeprefix("umbrage ")}, scanlines | {ours[0]} | {ours[1]:.5f} | 1 |"""]
    for kind, (count, error) in theirs.items():
        each = sorted(b / a for a, b in zip(times["umbrage"], times[kind]))
        lines.append(f"| Mitsuba {mi.__version__}, {options.variant}, {kind} | {count} | {error:.5f} "
                     f"| **{medians[kind] / medians['umbrage']:.1f}** ({each[0]:.1f} to {each[-1]:.1f} in single rounds) |")
    lines.append("""
Mitsuba traces rays lifted by 1e-6 of 1 + the largest coordinate: with its own lift its error does not
come down to the goal (`mitsuba.md`).""")
    return "\n".join(lines) + "\n"


if __name__ == "__main__":
    sys.exit(main())
