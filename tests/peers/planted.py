#!/usr/bin/env python3
"""Proves that compare.py would notice: Mitsuba is told a slightly wrong light.

Takes the same arguments. Writes planted.md, and exits with 1 if a planted error is accepted, or if
the right light is not.
"""
import sys
import tempfile
from dataclasses import dataclass, replace
from pathlib import Path

import mitsuba as mi
import numpy as np

import cases
from agreement import AT_OUR_POINTS, Agreement
from compare import LIFT, arguments, picture, umbrage
from pattern import Pattern, pattern


def turned(vector, degrees):
    """About the vertical axis."""
    c, s = np.cos(np.radians(degrees)), np.sin(np.radians(degrees))
    x, y, z = vector
    return [c * x - s * z, y, s * x + c * z]


def scaled(light, key, factor):
    return light | {key: (np.array(light[key]) * factor).tolist()}


# What is said of it, and what becomes of the light.
PLANTED = {
    "atrium-rect": [
        ("nothing", lambda light: light),
        ("5 % wider", lambda light: scaled(light, "half_u", 1.05)),
        ("1 cm to the side", lambda light: light | {"centre": [light["centre"][0] + 0.01, *light["centre"][1:]]}),
    ],
    "colonnade-sun": [
        ("nothing", lambda light: light),
        ("5 % wider", lambda light: scaled(light, "angular_diameter_radians", 1.05)),
        ("0.1 degrees to the side", lambda light: light | {"direction_to_light": turned(light["direction_to_light"], 0.1)}),
    ],
}


def main():
    options = arguments(__doc__)
    mi.set_variant(options.variant)
    names = [name for name in PLANTED if name in options.case]
    with tempfile.TemporaryDirectory() as folder:
        results = [result for name in names for result in plant(name, options, Path(folder))]
    options.out.mkdir(parents=True, exist_ok=True)
    (options.out / "planted.md").write_text("\n".join([HEAD, *(line(result) for result in results)]) + "\n")
    wrong = [result for result in results if result.accepted != (result.what == "nothing")]
    print("as expected" if not wrong else f"NOT as expected: {wrong}")
    return 1 if wrong else 0


HEAD = """# Errors planted in the light that Mitsuba is told

Written by `tests/peers/planted.py`: what `compare.py` says at umbrage's points when the light differs.
The mean of V hardly knows how wide a penumbra is, or where; its mean square does, and so do a pixel's
neighbours and blocks of pixels.

| case | planted | V ratio | V excess, sigma | V neighbours, sigma | V blocks, sigma | E ratio | accepted |
| --- | --- | --- | --- | --- | --- | --- | --- |"""


@dataclass
class Planted:
    case: str
    what: str
    rows: dict
    pattern: Pattern  # of V

    @property
    def accepted(self):
        return all(row.accepted for row in self.rows.values()) and self.pattern.accepted


def plant(name, options, folder):
    from peer import Peer, Settings
    case = cases.make(name, options.atrium, folder)
    size = [int(side) for side in options.size.split("x")]
    hit, points, values = umbrage(case, options, folder)
    agreement = Agreement(values, options.spp)
    for what, change in PLANTED[name]:
        peer = Peer(replace(case, light=change(case.light)))
        theirs = peer.estimate(*points, Settings(options.spp, LIFT, 1))
        keep = ~theirs["contact"]
        difference = picture(np.where(keep, values["V"] - theirs["V"], np.nan), hit, size)
        shape = pattern(difference, 1)
        yield Planted(name, what, {key: agreement.row(key, (AT_OUR_POINTS, True), theirs, keep) for key in ("V", "E")}, shape)


def line(result):
    v, e = result.rows["V"], result.rows["E"]
    verdict = "yes" if result.accepted else "no"
    shape = result.pattern
    return (f"| {result.case} | {result.what} | {v.ratio:.5f} | {v.excess:+.1f} | {shape.neighbours:+.1f} "
            f"| {shape.blocks:+.1f} | {e.ratio:.5f} | {verdict} |")


if __name__ == "__main__":
    sys.exit(main())
