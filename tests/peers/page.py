"""The page: reports/peers/mitsuba.md and a picture for each case."""
import hashlib
import platform
import subprocess

import drjit as dr
import mitsuba as mi
import numpy as np

import cases
import pattern
import sheet
from agreement import ACCEPTED, AT_OUR_POINTS, EXCESS

# The difference of V at which its picture's colours end.
SCALE = 0.1
# Cases side by side on the sheet: a scene's four lights.
ACROSS = len(cases.KINDS)


def write(results, options):
    options.out.mkdir(parents=True, exist_ok=True)
    sections = [section(result) for result in results]
    for result in results:
        if result.case.name in cases.PICTURED:
            draw(result, options.out / f"{result.case.name}.png")
    tiles = [sheet.tile(r.difference, r.variance, np.isfinite(r.ours)) for r in results]
    if len(tiles) % ACROSS == 0:
        sheet.write(options.out / "mitsuba.png", [tiles[k:k + ACROSS] for k in range(0, len(tiles), ACROSS)])
    (options.out / "mitsuba.md").write_text("\n\n".join([head(results, options), *sections]) + "\n")


def head(results, options):
    failed = [f"{r.case.name}: {row.quantity}, {row.what}" for r in results for row in r.rows
              if row.required and not row.accepted]
    failed += [f"{r.case.name}: pattern of {key}" for r in results for key, good in r.shapeless().items() if not good]
    denied = {r.case.name: sum(w.contradicts for w in r.witnesses) for r in results}
    failed += [f"{name}: brute force contradicts umbrage at {count} points" for name, count in denied.items() if count]
    asked = sum(len(r.witnesses) for r in results)
    required = sum(row.required for r in results for row in r.rows)
    tests = sum(len(r.shapeless()) for r in results)
    verdict = ("**Not accepted**: " + "; ".join(failed) if failed
               else f"**Accepted**: all {required} required rows, all {tests} tests for a pattern and brute force at all {asked} points.")
    return f"""# Ground truth against Mitsuba 3

Written by `tests/peers/compare.py`; its README says how to run it and what each number means.

{verdict} Required (rows in bold) is a mean ratio within {ACCEPTED:g}
of 1, and at umbrage's points also a mean square that exceeds the expected one by at most
{EXCESS:g} sigma: the mean alone would not see a penumbra that is too wide (`planted.md`). A pattern is
accepted if neighbours and blocks are within {pattern.ACCEPTED:g} sigma of what noise gives. Of a sphere's light V
and R are tested, of others E and E0 as well. At single points V must be within four errors of brute
force, bold where it is not.

| | |
| --- | --- |
| umbrage | {said(options.umbrage, "--version")}, checkout at {said("git", "-C", cases.REPOSITORY, "describe", "--always", "--dirty", "--exclude", "*")}, {options.samples} light samples in each of two halves, method {options.method} |
| Mitsuba | {mi.__version__}, Dr.Jit {dr.__version__}, `{options.variant}`, {options.spp} independent samples a point |
| Python | {platform.python_version()}, numpy {np.__version__} |
| atrium | {fingerprint(options.atrium)} |
| pictures | {options.size}, one point in the middle of each pixel |
| command | `python tests/peers/compare.py{changed(options)}` |

V is the unoccluded fraction of the light, E the irradiance from it, E0 the same with nothing between,
R = E / E0 where E0 is more than a hundredth of its mean.
*Ratio* is umbrage's mean over Mitsuba's, *bias* umbrage's less Mitsuba's, each with one standard
error. *Expected* is what the RMSE would be from the noise of the samples alone, *excess* by how many
standard errors the mean square is above that.

"At our points" Mitsuba looks at the light from umbrage's positions and normals, with rays lifted by
1e-6 of 1 + the largest coordinate. Points where a surface crosses the way to the light within 1 cm are
left out, and counted. Mitsuba's own lift, 8.9e-5 of the same, lets light in under nearby blockers: the
rows with lifts show the size of that, with the same samples each time.

*Neighbours* is the correlation of a pixel's difference with those of the pixels beside and below it,
which independent noise makes 0, and how many standard errors that is; *blocks* by how many standard
errors the squares of sums over {pattern.BLOCK}x{pattern.BLOCK} pixels are above those of independent noise; *worst block* the
largest such sum in units of its noise. E and E0 share Mitsuba's samples, V has its own. *E0 exact* is the mean of umbrage's E0 over that of a closed form, less 1, and
the same of Mitsuba's, at points that see the whole light or none of it (a tilted disk has no such form
here). Mitsuba's density of samples on a sphere has 1 - cos of a small angle in f32: on a wall 18 m away
from a sphere of 0.3 m its E0 is 5e-5 too large. Blocks of E see that; umbrage's E0 is exact there, and
R, where the density cancels, has no pattern.

Single points are apart by more sigmas than a normal distribution has, because V near 0 or 1 is a count
of few samples; there, brute force says who is right.

{overview(results)}

![all differences](mitsuba.png)

All differences of V at our points, in units of their noise, four pixels in one: from blue (umbrage
says less by {sheet.END:g} sigma) over white to red (more); a row of rectangle, sun, disk and sphere for each
scene, yellow where a contact is left out. Noise is to be seen in penumbrae, and no shape.

In the pictures below, V is above; under it umbrage's V less Mitsuba's, from blue (-{SCALE}) over white to
red (+{SCALE})."""


def overview(results):
    lines = ["| case | V ratio | E ratio | E0 ratio | V excess | E excess | V neighbours | R neighbours | E neighbours | V blocks | R blocks | E blocks | worst block | E0 exact |",
             "| --- | --- | --- | --- | --- | --- | --- | --- | --- | --- | --- | --- | --- | --- |"]
    for r in results:
        rows = {row.quantity: row for row in r.rows if row.what == AT_OUR_POINTS}
        ratios = " | ".join(f"{rows[key].ratio:.5f}" for key in ("V", "E", "E0"))
        excess = " | ".join(f"{rows[key].excess:+.1f}" for key in ("V", "E"))
        neighbours = " | ".join(f"{r.patterns[key].correlation:+.4f} ({r.patterns[key].neighbours:+.1f})" for key in ("V", "R", "E"))
        blocks = " | ".join(f"{r.patterns[key].blocks:+.1f}" for key in ("V", "R", "E"))
        lines.append(f"| {r.case.name} | {ratios} | {excess} | {neighbours} | {blocks} | {r.patterns['V'].worst:.1f} of {r.patterns['V'].count} | {exact(r)} |")
    return "\n".join(lines)


def exact(result):
    points, ours, theirs = result.exact
    return f"{ours - 1:+.0e}, {theirs - 1:+.0e}" if points else ""


def said(*command):
    done = subprocess.run([str(word) for word in command], capture_output=True, text=True, check=False)
    return done.stdout.strip() or "unknown"


def fingerprint(path):
    if path is None:
        return "none given"
    return f"{path.name}, SHA-256 {hashlib.sha256(path.read_bytes()).hexdigest()}"


def changed(options):
    words = [path.name for path in [options.atrium] if path]
    if options.case != (cases.NAMES if options.atrium else cases.BUILTIN_NAMES):
        words += [f"--case {name}" for name in options.case]
    for name, usual in (("size", "480x270"), ("samples", 4096), ("method", "scanlines"), ("spp", 512), ("points", 6)):
        if getattr(options, name) != usual:
            words.append(f"--{name} {getattr(options, name)}")
    return "".join(f" {word}" for word in words)


def section(result):
    case = result.case
    apart = ", ".join(f"{count} beyond {level} sigma" for level, count in result.beyond.items())
    shown = f"![{case.name}]({case.name}.png)\n\n" if case.name in cases.PICTURED else ""
    return f"""## {case.name}

{shown}{result.triangles} triangles; {described(case.light)}.
Of {result.pixels} pixels {result.hit} hit a surface in umbrage; at {result.other_surface} pixels
Mitsuba's camera sees something else: another place (1 mm away or more), or only one sees anything.
{result.penumbra} points are in a penumbra; {result.contact} have a contact.
Umbrage's own variance of V is {result.noise_share:.4f} of Mitsuba's.
Points by how far V is apart: {apart}.

{table(result.rows)}

V by brute force (float64, every triangle, 4096 jittered samples) at single points:

{witnesses(result.witnesses)}"""


def described(light):
    shown = {key: value for key, value in light.items() if key not in ("kind", "angular_diameter_degrees")}
    words = (f"{key.replace('_', ' ')} {np.round(value, 6).tolist()}" for key, value in shown.items())
    return f"light: a {light['kind']}, {', '.join(words)}"


def table(rows):
    lines = ["| | where | points | mean | ratio | bias | bias in sigma | RMSE | expected | excess | worst point |",
             "| --- | --- | --- | --- | --- | --- | --- | --- | --- | --- | --- |"]
    for row in rows:
        ratio = f"{row.ratio:.5f} ± {row.ratio_sigma:.5f}"
        ratio = f"**{ratio}**" if row.required else ratio
        lines.append(
            f"| {row.quantity} | {row.what} | {row.points} | {row.ours:.4g} | {ratio} | {row.bias:+.1e} ± {row.bias_sigma:.0e} "
            f"| {row.bias / row.bias_sigma:+.1f} | {row.rmse:.3g} | {row.expected:.3g} | {row.excess:+.1f} | {row.worst:.2g} |")
    return "\n".join(lines)


def witnesses(found):
    lines = ["| chosen | point | apart, sigma | umbrage | Mitsuba | brute force |", "| --- | --- | --- | --- | --- | --- |"]
    for w in found:
        place = ", ".join(f"{x:.3f}" for x in w.place)
        lines.append(f"| {w.why} | {place} | {w.apart:.1f} | {f'**{w.ours:.4f}**' if w.contradicts else f'{w.ours:.4f}'} | {w.theirs:.4f} | {w.value:.4f} ± {w.error:.4f} |")
    return "\n".join(lines)


def draw(result, path):
    """V above the difference."""
    grey = np.repeat(np.round(np.nan_to_num(result.ours) * 30)[..., None] * 8.5, 3, axis=2)
    colour = sheet.coloured(result.difference / SCALE)
    colour[np.isnan(result.difference)] = sheet.LEFT_OUT
    for image in (grey, colour):
        image[np.isnan(result.ours)] = sheet.NOTHING
    mi.Bitmap(np.concatenate([grey, colour]).astype(np.uint8)).write(str(path))
