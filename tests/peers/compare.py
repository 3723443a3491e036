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
import closed
import page
from agreement import AT_OUR_POINTS, Agreement, ratio
from pattern import pattern

# Lift of the rays in Mitsuba, relative to 1 + the largest coordinate: about twenty times f32's
# rounding of a position, and a ninetieth of Mitsuba's own.
LIFT = 1e-6
# How many of brute force's errors umbrage may be away from it.
DENIED = 4
# What larger ones do is shown where there is much to lift rays over.
LIFTS = {"lift 1e-5": 1e-5, "Mitsuba's own lift": None}
LIFTED = cases.ATRIUM_LIGHTS
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
    verdicts += [verdict for result in results for verdict in result.shapeless().values()]
    verdicts += [not witness.contradicts for result in results for witness in result.witnesses]
    print("accepted" if all(verdicts) else "NOT accepted", f"({sum(verdicts)} of {len(verdicts)})")
    return 0 if all(verdicts) else 1


def arguments(about=__doc__, more=lambda parser: None):
    parser = argparse.ArgumentParser(description=about, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("atrium", type=Path, nargs="?", help="OBJ of the atrium; without it, only built-in scenes")
    parser.add_argument("--umbrage", type=Path, default=cases.REPOSITORY / "target/release/umbrage")
    parser.add_argument("--size", default="480x270", help="WIDTHxHEIGHT")
    parser.add_argument("--samples", type=int, default=4096, help="umbrage's, in each of its two halves")
    parser.add_argument("--method", default="scanlines", help="umbrage's")
    parser.add_argument("--spp", type=int, default=512, help="Mitsuba's, a multiple of 32")
    parser.add_argument("--case", action="append", choices=cases.NAMES, help="several by repeating; all otherwise")
    parser.add_argument("--variant", default="llvm_ad_rgb", help="Mitsuba's; a vectorised one")
    parser.add_argument("--points", type=int, default=6, help="brute-forced in each case, twice")
    parser.add_argument("--keep", type=Path, help="a folder that keeps umbrage's pictures, to be used again")
    parser.add_argument("--out", type=Path, default=cases.REPOSITORY / "reports/peers")
    more(parser)
    options = parser.parse_args()
    if options.spp < 64 or options.spp % 32:
        parser.error("--spp: a multiple of 32, at least 64")
    options.case = options.case or (cases.NAMES if options.atrium else cases.BUILTIN_NAMES)
    if not options.atrium and not set(options.case) <= set(cases.BUILTIN_NAMES):
        parser.error("these cases need the atrium's OBJ")
    if options.keep:
        options.keep.mkdir(parents=True, exist_ok=True)
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
    difference: np.ndarray  # of V as a picture, NaN at contacts
    variance: np.ndarray    # of that
    patterns: dict          # of V, R, E and E0
    exact: tuple            # of E0 by a closed form: points, ours over it, theirs over it, both in the mean

    def shapeless(self):
        """Verdicts on patterns. Of a sphere's E and E0 they do not count: Mitsuba's density of its samples
        is rounded, which shows where the sphere is far away; R, E over E0, is free of it."""
        keys = ["V", "R"] if self.case.light["kind"] == "sphere" else list(self.patterns)
        return {key: self.patterns[key].accepted for key in keys}


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

    rows = [agreement.row(key, (AT_OUR_POINTS, True), theirs, keep) for key in ("V", "E", "E0")]
    label = "through Mitsuba's camera", True
    rows += [agreement.row(key, label, through_camera, keep & seen[2]) for key in ("V", "E")]
    rows += [agreement.row(key, (f"{AT_OUR_POINTS}, contacts too", False), theirs, keep | True) for key in ("V", "E")]
    for words, lift in LIFTS.items() if name in LIFTED else ():
        # The same seed: the same samples of the light.
        lifted = peer.estimate(*points, Settings(options.spp, lift, 1))
        rows += [agreement.row(key, (f"{AT_OUR_POINTS}, {words}", False), lifted, keep) for key in ("V", "E")]

    apart = np.where(keep, agreement.apart(theirs), 0)
    witnesses = ask_arbiter(case, points, (ours, theirs["V"]), (apart, options.points))
    both = [some | {"R": ratio(some)} for some in (values, theirs)]
    differences = {key: picture(np.where(keep, both[0][key] - both[1][key], np.nan), hit, size) for key in ("V", "R", "E", "E0")}
    patterns = {key: pattern(differences[key], scale(key, values, hit, size)) for key in differences}
    print(f"{name}: {time.time() - started:.0f} s", file=sys.stderr)
    return Result(
        case, peer.triangles(), hit.size, len(keep), int((hit != through[2]).sum() + other.sum()), int((~keep).sum()),
        int(((ours > 0) & (ours < 1)).sum()), agreement.noise_share(),
        {level: int((apart > level).sum()) for level in (4, 5, 6)}, rows, witnesses,
        picture(ours, hit, size), differences["V"],
        picture(agreement.variance("V", theirs), hit, size), patterns,
        against_closed_form(case, points, values["E0"], theirs["E0"]),
    )


def umbrage(case, options, folder):
    """Where `umbrage reference` hits something; positions and normals there; values there."""
    out = (options.keep or folder) / f"{case.name}-{options.size}-{options.method}-{options.samples}.exr"
    command = [str(options.umbrage), "reference", *case.arguments(), "--size", options.size,
               "--samples", str(options.samples), "--method", options.method, "--out", str(out)]
    if not out.exists():
        subprocess.run(command, check=True, stdout=subprocess.DEVNULL)
    bitmap = mi.Bitmap(str(out))
    pixels = np.array(bitmap, dtype=float).reshape(-1, bitmap.channel_count())
    layers = {field.name: pixels[:, k] for k, field in enumerate(bitmap.struct_())}
    hit = layers["depth.Z"] > 0
    points = [np.stack([layers[f"{name}.{axis}"][hit] for axis in "XYZ"], axis=1) for name in ("position", "normal")]
    return hit, points, {key: layers[name][hit] for key, name in LAYERS.items()}


def against_closed_form(case, points, ours, theirs):
    exact = closed.unshadowed(case.light, *points)
    known = np.isfinite(exact) & (exact > 0)
    if not known.any():
        return 0, np.nan, np.nan
    return int(known.sum()), *(float(np.mean(values[known] / exact[known])) for values in (ours, theirs))


def scale(key, values, hit, size):
    """What noise goes with: that of fractions is of one size everywhere, that of E and E0 goes with E0."""
    return 1 if key in ("V", "R") else picture(np.maximum(values["E0"], 0.05 * values["E0"].mean()), hit, size)


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

    @property
    def contradicts(self):
        """Brute force denies what umbrage says."""
        return abs(self.ours - self.value) > DENIED * self.error


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
