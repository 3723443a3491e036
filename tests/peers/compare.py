#!/usr/bin/env python3
"""Compares umbrage's ground truth with Mitsuba 3: see README.md beside this file.

Exits with 0 if all that is required agrees, with 1 if not.
"""
import argparse
import subprocess
import sys
import tempfile
import time
from dataclasses import dataclass
from pathlib import Path

import mitsuba as mi
import numpy as np

import arbiter
import cases
import page
from agreement import AT_OUR_POINTS, Agreement

# Lift of the rays in Mitsuba, relative to 1 + the largest coordinate: about twenty times f32's
# rounding of a position, and a ninetieth of Mitsuba's own.
LIFT = 1e-6
LIFTS = {"lift 1e-5": 1e-5, "Mitsuba's own lift": None}
LAYERS = {"V": "reference.V", "V.variance": "variance.V", "E": "irradiance.E", "E0": "irradiance.E0"}
# Nearer than this, two camera rays have hit the same surface.
SAME_PLACE = 1e-3


def main():
    options = arguments()
    mi.set_variant(options.variant)
    with tempfile.TemporaryDirectory() as folder:
        results = [run(name, options, Path(folder)) for name in options.case]
    page.write(results, options)
    verdicts = [row.accepted for result in results for row in result.rows if row.required]
    print("accepted" if all(verdicts) else "NOT accepted", f"({sum(verdicts)} of {len(verdicts)})")
    return 0 if all(verdicts) else 1


def arguments(about=__doc__):
    parser = argparse.ArgumentParser(description=about, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("atrium", type=Path, nargs="?", help="OBJ of the atrium; without it, only built-in scenes")
    parser.add_argument("--umbrage", type=Path, default=cases.REPOSITORY / "target/release/umbrage")
    parser.add_argument("--size", default="480x270", help="WIDTHxHEIGHT")
    parser.add_argument("--samples", type=int, default=4096, help="umbrage's, in each of its two halves")
    parser.add_argument("--spp", type=int, default=512, help="Mitsuba's, a multiple of 32")
    parser.add_argument("--case", action="append", choices=cases.NAMES, help="several by repeating; all otherwise")
    parser.add_argument("--variant", default="llvm_ad_rgb", help="Mitsuba's; a vectorised one")
    parser.add_argument("--points", type=int, default=6, help="brute-forced in each case, twice")
    parser.add_argument("--out", type=Path, default=cases.REPOSITORY / "reports/peers")
    options = parser.parse_args()
    if options.spp < 64 or options.spp % 32:
        parser.error("--spp: a multiple of 32, at least 64")
    options.case = options.case or (cases.NAMES if options.atrium else [cases.BUILTIN_CASE])
    if not options.atrium and options.case != [cases.BUILTIN_CASE]:
        parser.error("these cases need the atrium's OBJ")
    if not options.umbrage.exists():
        parser.error(f"{options.umbrage} is missing: cargo build --release, or name another with --umbrage")
    return options


@dataclass
class Result:
    """A case; counts are of pixels or, what is the same, points."""
    case: cases.Case
    triangles: int
    pixels: int
    hit: int
    other_surface: int
    contact: int
    penumbra: int
    noise_share: float
    beyond: dict            # how many are apart by more than so many sigmas
    rows: list
    witnesses: list
    ours: np.ndarray        # V as a picture
    difference: np.ndarray  # as a picture, NaN at contacts


def run(name, options, folder):
    """One case, from files to numbers."""
    # Only now: it needs Mitsuba's variant.
    from peer import Peer, Settings
    started = time.time()
    case = cases.make(name, options.atrium, folder)
    hit, points, values = umbrage(case, options, folder)
    agreement = Agreement(values, options.spp)
    ours = values["V"]

    peer = Peer(case)
    size = [int(side) for side in options.size.split("x")]
    through = peer.hits(size)
    seen = [values[hit] for values in through]
    other = seen[2] & (np.linalg.norm(seen[0] - points[0], axis=1) > SAME_PLACE)
    theirs = peer.estimate(*points, Settings(options.spp, LIFT, 1))
    through_camera = peer.estimate(*seen[:2], Settings(options.spp, LIFT, 2))
    keep = ~theirs["contact"]

    required = name in cases.REQUIRED
    rows = [agreement.row(key, (AT_OUR_POINTS, required), theirs, keep) for key in ("V", "E", "E0")]
    label = "through Mitsuba's camera", required
    rows += [agreement.row(key, label, through_camera, keep & seen[2]) for key in ("V", "E")]
    rows += [agreement.row(key, (f"{AT_OUR_POINTS}, contacts too", False), theirs, keep | True) for key in ("V", "E")]
    for words, lift in LIFTS.items():
        # The same seed: the same samples of the light.
        lifted = peer.estimate(*points, Settings(options.spp, lift, 1))
        rows += [agreement.row(key, (f"{AT_OUR_POINTS}, {words}", False), lifted, keep) for key in ("V", "E")]

    apart = np.where(keep, agreement.apart(theirs), 0)
    witnesses = ask_arbiter(case, points, (ours, theirs["V"]), (apart, options.points))
    difference = np.where(keep, ours - theirs["V"], np.nan)
    print(f"{name}: {time.time() - started:.0f} s", file=sys.stderr)
    return Result(
        case, peer.triangles(), hit.size, len(keep), int((hit != through[2]).sum() + other.sum()), int((~keep).sum()),
        int(((ours > 0) & (ours < 1)).sum()), agreement.noise_share(),
        {level: int((apart > level).sum()) for level in (4, 5, 6)}, rows, witnesses,
        picture(ours, hit, size), picture(difference, hit, size),
    )


def umbrage(case, options, folder):
    """Where `umbrage reference` hits something; positions and normals there; values there."""
    out = folder / f"{case.name}.exr"
    command = [str(options.umbrage), "reference", *case.arguments(), "--size", options.size,
               "--samples", str(options.samples), "--out", str(out)]
    subprocess.run(command, check=True, stdout=subprocess.DEVNULL)
    bitmap = mi.Bitmap(str(out))
    pixels = np.array(bitmap, dtype=float).reshape(-1, bitmap.channel_count())
    layers = {field.name: pixels[:, k] for k, field in enumerate(bitmap.struct_())}
    hit = layers["depth.Z"] > 0
    points = [np.stack([layers[f"{name}.{axis}"][hit] for axis in "XYZ"], axis=1) for name in ("position", "normal")]
    return hit, points, {key: layers[name][hit] for key, name in LAYERS.items()}


def picture(values, hit, size):
    image = np.full(hit.shape, np.nan)
    image[hit] = values
    return image.reshape(size[1], size[0])


@dataclass
class Witness:
    """V at one point, three times."""
    why: str
    place: np.ndarray
    apart: float
    ours: float
    theirs: float
    value: float
    error: float


def ask_arbiter(case, points, both, which):
    """V by brute force at the points that are furthest apart, and at some in penumbrae."""
    (position, normal), (ours, theirs), (apart, count) = points, both, which
    triangles = arbiter.load_obj(case.obj)
    soft = np.flatnonzero((ours > 0.02) & (ours < 0.98) & (apart > 0))
    chosen = [("furthest apart", i) for i in np.argsort(-apart)[:count]]
    chosen += [("penumbra", i) for i in np.random.default_rng(7).choice(soft, min(count, len(soft)), replace=False)]
    return [
        Witness(why, position[i], apart[i], ours[i], theirs[i],
                *arbiter.visibility(triangles, case.light, (position[i], normal[i]), 64))
        for why, i in chosen
    ]


if __name__ == "__main__":
    sys.exit(main())
