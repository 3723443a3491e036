#!/usr/bin/env python3
"""Compares umbrage's irradiance with that of Blender's Cycles: see README.md beside this file.

Takes the arguments of compare.py (of which --variant, --spp and --points concern Mitsuba alone), and
--blender, a Python that can import bpy. Writes cycles.md and cycles.png, and exits with 1 if something
disagrees.
"""
import json
import subprocess
import sys
import tempfile
import time
from dataclasses import dataclass
from pathlib import Path

import mitsuba as mi
import numpy as np

import cases
import closed
import page
import sheet
from agreement import ACCEPTED, AT_OUR_POINTS, EXCESS, Agreement, ratio
from compare import SAME_PLACE, arguments, picture, scale, umbrage
from pattern import ACCEPTED as NO_PATTERN, ENOUGH, pattern, summed

# Renderings with a seed each: from their spread comes Cycles' variance.
BATCHES, SAMPLES = 4, 32
KEYS = ["R", "E", "E0"]
# Where no pattern may be. E0 has Cycles' own, and E with it (see `head`); in R it cancels.
SHAPELESS = ["R"]
# Cosine between the normals of one surface.
SAME_NORMAL = 1 - 1e-4
HERE = Path(__file__).resolve().parent


def main():
    options = arguments(__doc__, more)
    # It only reads pictures here.
    mi.set_variant("scalar_rgb")
    with tempfile.TemporaryDirectory() as folder:
        results = [run(name, options, Path(folder)) for name in options.case]
    write(results, options)
    verdicts = [verdict for result in results for verdict in result.verdicts()]
    print("accepted" if all(verdicts) else "NOT accepted", f"({sum(verdicts)} of {len(verdicts)})")
    return 0 if all(verdicts) else 1


def more(parser):
    parser.add_argument("--blender", type=Path, required=True, help="a Python with bpy 4.5")
    parser.add_argument("--threads", type=int, default=2, help="Cycles'")


@dataclass
class Result:
    case: cases.Case
    hit: int
    elsewhere: int
    rows: list
    patterns: dict
    tiles: dict         # of R and E
    exact: tuple        # E0 over a closed form, less 1, in the worst block: umbrage's and Cycles'

    def verdicts(self):
        return [row.accepted for row in self.rows] + [self.patterns[key].accepted for key in SHAPELESS]


def run(name, options, folder):
    started = time.time()
    case = cases.make(name, options.atrium, folder)
    hit, points, values = umbrage(case, options, folder)
    size = [int(side) for side in options.size.split("x")]
    theirs, (place, normal) = cycles(case, options, folder)
    theirs = {key: values[hit] for key, values in theirs.items()}
    # Where the pixel filter reaches across an edge, the mean normal is neither side's.
    keep = np.linalg.norm(place[hit] - points[0], axis=1) < SAME_PLACE
    keep &= np.abs(np.einsum("ij,ij->i", normal[hit], points[1])) > SAME_NORMAL
    # Its own camera finds umbrage's points: they are the same, but for the pixel filter.
    agreement = Agreement(values, BATCHES * SAMPLES)
    both = [some | {"R": ratio(some)} for some in (values, theirs)]
    known = keep & np.isfinite(both[0]["R"]) & np.isfinite(both[1]["R"])
    agreement.ours = both[0]
    rows = [agreement.row(key, (AT_OUR_POINTS, True), both[1], known if key == "R" else keep) for key in KEYS]
    differences = {key: picture(np.where(keep, both[0][key] - both[1][key], np.nan), hit, size) for key in KEYS}
    variances = {key: picture(agreement.variance(key, both[1]), hit, size) for key in KEYS}
    patterns = {key: pattern(differences[key], scale(key, values, hit, size)) for key in KEYS}
    seen = picture(np.ones(len(keep)), hit, size) == 1
    exact = closed.unshadowed(case.light, *points)
    exact = picture(np.where(keep, exact, np.nan), hit, size)
    worst = [worst_block(picture(some["E0"], hit, size), exact) for some in both]
    print(f"{name}: {time.time() - started:.0f} s", file=sys.stderr, flush=True)
    tiles = {key: sheet.tile(differences[key], smooth(variances[key]), seen) for key in ("R", "E")}
    return Result(case, int(hit.sum()), int((~keep).sum()), rows, patterns, tiles, worst)


def worst_block(values, exact):
    """Of sums over blocks, relative to the closed form."""
    known = np.isfinite(exact) & (exact > 0)
    sums, exacts, count = (summed(np.where(known, image, 0)) for image in (values, exact, known))
    apart = sums[count >= ENOUGH] / exacts[count >= ENOUGH] - 1
    return float(apart[np.argmax(np.abs(apart))]) if len(apart) else np.nan


def smooth(variance):
    """Over 5x5 pixels: that of a single pixel is known from four renderings only."""
    known = np.isfinite(variance)
    padded = [np.pad(image, 2) for image in (np.nan_to_num(variance), known.astype(float))]
    height, width = variance.shape
    total, count = (sum(image[y:y + height, x:x + width] for y in range(5) for x in range(5)) for image in padded)
    return np.where(known, total / np.maximum(count, 1), np.nan)


def cycles(case, options, folder):
    """E and E0 with variances; positions and normals: of all pixels in row order."""
    job = {
        "obj": str(case.obj), "light": case.light, "camera": case.camera, "out": str(folder),
        "size": [int(side) for side in options.size.split("x")],
        "samples": SAMPLES, "batches": BATCHES, "threads": options.threads,
    }
    told = folder / "job.json"
    told.write_text(json.dumps(job))
    command = [str(options.blender), str(HERE / "cycles/side.py"), str(told)]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    if done.returncode:
        sys.exit(f"Cycles' side failed:\n{done.stdout[-2000:]}\n{done.stderr[-2000:]}")
    pictures = {key: [read(folder / f"{key}-{batch}.exr") for batch in range(BATCHES)] for key in ("E", "E0")}
    each = [{key: np.pi * pictures[key][batch]["Combined.R"] for key in pictures} for batch in range(BATCHES)]
    result = {}
    for key in pictures:
        values = np.stack([batch[key] for batch in each])
        result[key] = values.mean(axis=0)
        result[f"{key}.variance"] = values.var(axis=0, ddof=1) / BATCHES
    # Batches of E and E0 share their samples.
    fractions = np.stack([batch["E"] / np.maximum(batch["E0"], np.finfo(float).tiny) for batch in each])
    result["R.variance"] = fractions.var(axis=0, ddof=1) / BATCHES
    surface = [np.stack([pictures["E"][0][f"{name}.{axis}"] for axis in "XYZ"], axis=1) for name in ("Position", "Normal")]
    return result, surface


def read(path):
    bitmap = mi.Bitmap(str(path))
    pixels = np.array(bitmap, dtype=float).reshape(-1, bitmap.channel_count())
    return {field.name.removeprefix("ViewLayer."): pixels[:, k] for k, field in enumerate(bitmap.struct_())}


def write(results, options):
    options.out.mkdir(parents=True, exist_ok=True)
    across = len(cases.KINDS)
    for key, name in (("R", "cycles"), ("E", "cycles-e")):
        tiles = [result.tiles[key] for result in results]
        if len(tiles) % across == 0:
            sheet.write(options.out / f"{name}.png", [tiles[k:k + across] for k in range(0, len(tiles), across)])
    (options.out / "cycles.md").write_text(head(results, options) + "\n")


def head(results, options):
    failed = [f"{r.case.name}: {row.quantity}" for r in results for row in r.rows if not row.accepted]
    failed += [f"{r.case.name}: pattern of {key}" for r in results for key in SHAPELESS if not r.patterns[key].accepted]
    count = sum(len(r.verdicts()) for r in results)
    verdict = "**Not accepted**: " + "; ".join(failed) if failed else f"**Accepted**: all {count} rows and tests for a pattern."
    version = page.said(options.blender, "-c", "import bpy; print(bpy.app.version_string)").splitlines()[-1]
    return f"""# Ground truth against Blender's Cycles

Written by `tests/peers/compare_cycles.py`; the README there says how to run it and what each number means.

{verdict}

Asked for are, of E, E0 and R = E / E0, a mean ratio within {ACCEPTED:g} of 1 and a mean square that exceeds the
expected one by at most {EXCESS:g} sigma; and neighbours and blocks of R within {NO_PATTERN:g} sigma of what noise gives.

| | |
| --- | --- |
| umbrage | {page.said(options.umbrage, "--version")}, checkout at {page.said("git", "-C", cases.REPOSITORY, "describe", "--always", "--dirty", "--exclude", "*")}, {options.samples} light samples in each of two halves, method {options.method} |
| Cycles | of Blender {version}, on the CPU, a program of its own; {BATCHES} renderings of {SAMPLES} samples a pixel |
| atrium | {page.fingerprint(options.atrium)} |
| pictures | {options.size}, one point in the middle of each pixel |
| command | `python tests/peers/compare_cycles.py{page.changed(options)} --blender PYTHON` |

E is irradiance from the light, E0 the same with nothing between; Cycles has no way to say V. It brings
its own camera, ray tracer, samples and light shapes: a pixel filter of 0.01 pixels makes it look at
umbrage's points. Points that it sees 1 mm away or more, or with another normal, are left out, and
counted (*elsewhere*): the filter reaches across edges. Contacts are not left out: Cycles does not lift
its rays. Its variance is that of the mean of {BATCHES} renderings. R is compared where E0 is more than a
hundredth of its mean. Ratio, bias, expected, excess, neighbours and blocks are those of
[mitsuba.md](mitsuba.md).

**E0 and E have a pattern, and it is Cycles'**: their noise is so small where all of the light is seen
that blocks show how Cycles rounds, worst with spheres and rectangles that are far away. *E0 exact* says
who is right: in the block where it is furthest off, E0 over a closed form, less 1, of umbrage and of
Cycles, at points that see the whole light (a tilted disk has no such form here). R, in which the
rounding cancels, shows shadows alone.

| case | points | elsewhere | | mean | ratio | bias in sigma | RMSE | expected | excess | neighbours | blocks | worst block | E0 exact |
| --- | ---: | ---: | --- | --- | --- | --- | --- | --- | --- | --- | --- | --- | --- |
{chr(10).join(line(result, row) for result in results for row in result.rows)}

![differences of R](cycles.png)

All differences of R in units of their noise, four pixels in one: from blue (umbrage says less by
{sheet.END:g} sigma) over white to red (more); a row of rectangle, sun, disk and sphere for each scene, yellow
where points are left out or E0 is too small. Then the same of E, where lit places show Cycles' rounding.

![differences of E](cycles-e.png)"""


def line(result, row):
    found = result.patterns[row.quantity]
    exact = "{:+.0e}, {:+.0e}".format(*result.exact) if row.quantity == "E0" and np.isfinite(result.exact).all() else ""
    return (f"| {result.case.name} | {row.points} | {result.elsewhere} | {row.quantity} | {row.ours:.4g} "
            f"| {row.ratio:.5f} ± {row.ratio_sigma:.5f} | {row.bias / row.bias_sigma:+.1f} | {row.rmse:.3g} | {row.expected:.3g} "
            f"| {row.excess:+.1f} | {found.correlation:+.4f} ({found.neighbours:+.1f}) | {found.blocks:+.1f} | {found.worst:.1f} of {found.count} | {exact} |")


if __name__ == "__main__":
    sys.exit(main())
