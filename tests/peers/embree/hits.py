"""Whether umbrage and Embree ROBUST hit the same: identical f32 rays over two models.

    python tests/peers/embree/hits.py --embree DIR/embree_side --models MODELS

MODELS holds `atrium.obj` and `crytek_sponza.obj`. Writes hits.md beside the other reports and exits
with 1 if more than 2 rays in a million differ. Needs numpy.
"""
import argparse
import subprocess
import sys
import tempfile
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np

from compare import REPOSITORY, bench

ACCEPTED = 2e-6
NOTHING = 0xFFFFFFFF
# Shadow rays start this far above the surface: at the surface itself, f32's rounding decides whether
# it is hit.
LIFT = 1e-4
# Origins and lamps' places are multiples of this, so that the way from one to the other is an f32:
# 24 bits reach 32 m.
GRID = 2.0**-19
# Of the way to a lamp; both programs leave the rest out.
LIGHT_END = 1 - 1e-4
# Camera rays that hit different triangles at the same distance: edges and surfaces that coincide.
SAME_DISTANCE = 1e-5


@dataclass
class Exported:
    """What the bench writes for a case."""
    light: tuple            # kind, a, b, c
    triangles: np.ndarray   # (count, 3, 3), f32
    receivers: np.ndarray   # (count, 2, 3), positions and normals
    eye: np.ndarray
    directions: np.ndarray  # of camera rays


@dataclass
class Count:
    """Rays of one kind over one case."""
    case: str
    what: str
    rays: int
    hits: int
    differ: int
    packets: int = 0        # with Embree's packets in place of single rays
    others: int = 0         # first hits of another triangle farther or nearer
    notes: list = field(default_factory=list)


def main():
    options = arguments()
    program = bench()
    with tempfile.TemporaryDirectory() as folder:
        # Both cases of the atrium have the same camera.
        counts = [count for case, camera in (("atrium-rect", True), ("atrium-sun", False), ("sponza-sun", True))
                  for count in Comparison(case, program, options, Path(folder)).counts(camera)]
    page = written(counts, options)
    options.out.mkdir(parents=True, exist_ok=True)
    (options.out / "hits.md").write_text(page)
    print(page)
    return 0 if sum(c.differ for c in counts) <= ACCEPTED * sum(c.rays for c in counts) else 1


def arguments():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--embree", type=Path, required=True, help="the program that build.py makes")
    parser.add_argument("--models", type=Path, required=True)
    parser.add_argument("--size", default="1920x1080", help="of the picture whose points send shadow rays")
    parser.add_argument("--rays", type=int, default=4, help="shadow rays from each point")
    parser.add_argument("--out", type=Path, default=REPOSITORY / "reports/peers")
    return parser.parse_args()


class Comparison:
    """Both programs over one case."""

    def __init__(self, case, program, options, folder):
        self.case, self.program, self.options, self.folder = case, program, options, folder
        self.exported = self.folder / "case.bin"
        self.run(["--size", options.size, "--samples", "1", "--export", self.exported])
        self.model = read_case(self.exported)
        self.random = np.random.default_rng(20)

    def counts(self, camera):
        return [*([self.camera()] if camera else []), self.shadow()]

    def run(self, words):
        command = [self.program, self.case, "--models", self.options.models, *words]
        subprocess.run(list(map(str, command)), check=True, stdout=subprocess.DEVNULL)

    def embree(self, case, commands):
        command = [self.options.embree, case, "--robust", "--threads", "2"]
        done = subprocess.run(list(map(str, command)), input="\n".join(commands) + "\n", check=True, text=True, stdout=subprocess.PIPE)
        if "error" in done.stdout:
            sys.exit(done.stdout)

    def camera(self):
        """First hits from one eye, which is moved to the origin with everything else."""
        model = self.model
        eye = model.eye
        directions = largest_is_one(model.directions)
        moved = (model.triangles - eye).astype(np.float32)
        asked = self.folder / "camera.rays"
        write(asked, [1, len(directions)], eye, directions)
        self.run(["--rays", asked])
        ours = np.fromfile(asked.with_suffix(".answers"), np.uint32)
        case, theirs = self.folder / "moved.bin", self.folder / "ids"
        write(case, [0x554D4231, len(moved), 0, 0, 1, len(directions), 0, 0], np.eye(3), moved, np.zeros(3), directions)
        self.embree(case, ["camera", f"dumphits {theirs}"])
        theirs = np.fromfile(theirs, np.uint32)
        count = Count(self.case, "camera rays, first hit", len(ours), int((ours != NOTHING).sum()), int(((ours == NOTHING) != (theirs == NOTHING)).sum()))
        for ray in np.flatnonzero(ours != theirs):
            ends = [distance(moved, ids[ray], directions[ray]) for ids in (ours, theirs)]
            if np.isfinite(ends).all() and abs(ends[0] - ends[1]) < SAME_DISTANCE:
                continue
            count.others += int(np.isfinite(ends).all())
            # The one of the two that is nearer is there or not.
            nearer = (ours, theirs)[int(np.argmin(ends))][ray]
            count.notes.append(near(moved[[nearer]], (np.zeros(3), directions[ray], np.inf)))
        return count

    def shadow(self):
        """Any hit between points and places on the light."""
        origins, directions, ends = self.segments()
        asked = self.folder / "shadow.rays"
        rays = np.concatenate([origins, directions, np.full((len(origins), 1), ends)], axis=1).astype(np.float32)
        write(asked, [0, len(rays)], rays)
        self.run(["--rays", asked])
        ours = np.fromfile(asked.with_suffix(".answers"), np.uint8)
        found = []
        for command in ("rays", "rays16"):
            self.embree(self.exported, [f"{command} {asked}"])
            found.append(np.fromfile(f"{asked}.embree", np.uint8))
        differ = ours != found[0]
        count = Count(self.case, "shadow rays, any hit", len(ours), int(ours.sum()), int(differ.sum()), int((ours != found[1]).sum()))
        end = LIGHT_END if ends else np.inf
        for ray in np.flatnonzero(differ | (ours != found[1])):
            count.notes.append(near(self.model.triangles, (origins[ray], directions[ray], end)))
        return count

    def segments(self):
        """Origins and directions, and whether they end with the direction: only what an f32 holds."""
        kind, a, b, c = self.model.light
        position, normal = (np.repeat(self.model.receivers[:, k].astype(float), self.options.rays, axis=0) for k in (0, 1))
        origins = on_grid(position + LIFT * normal)
        if kind == 0:
            directions = sun(a, 0.5 * b[0], self.random.random((len(origins), 2)))
        else:
            u = 2 * self.random.random((len(origins), 2)) - 1
            directions = on_grid(a + u[:, :1] * b + u[:, 1:] * c) - origins
        directions = directions.astype(np.float32).astype(float)
        # Exact: so is the sum, of which umbrage is told.
        held = ((origins + directions).astype(np.float32) == origins + directions).all(axis=1) | (kind == 0)
        kept = held & (np.einsum("ij,ij->i", directions, normal) > 0)
        rays = np.unique(np.concatenate([origins, directions], axis=1)[kept], axis=0)
        return rays[:, :3], rays[:, 3:], float(kind != 0)


def read_case(path):
    words = np.fromfile(path, np.uint32)
    triangles, receivers, kind, camera = words[1], words[2], words[3], words[5]
    numbers = words[8:].view(np.float32)
    light, numbers = numbers[:9].reshape(3, 3).astype(float), numbers[9:]
    corners, numbers = numbers[:9 * triangles].reshape(-1, 3, 3), numbers[9 * triangles:]
    points, numbers = numbers[:6 * receivers].reshape(-1, 2, 3), numbers[6 * receivers:]
    if kind not in (0, 2):
        sys.exit("only a sun and a rectangle are known here")
    return Exported((int(kind), *light), corners, points, numbers[:3], numbers[3:].reshape(camera, 3))


def write(path, head, *numbers):
    with open(path, "wb") as file:
        np.array(head, np.uint32).tofile(file)
        for some in numbers:
            np.ascontiguousarray(some, np.float32).tofile(file)


def on_grid(places):
    return np.round(places / GRID) * GRID


def largest_is_one(directions):
    return (directions / np.abs(directions).max(axis=1, keepdims=True)).astype(np.float32)


def sun(axis, half, u):
    """Directions of a cone, uniform by solid angle."""
    axis = axis / np.linalg.norm(axis)
    s = np.cross(axis, [1.0, 0, 0])
    s /= np.linalg.norm(s)
    q = u[:, :1] * 2 * np.sin(half / 2) ** 2
    sine, turn = np.sqrt(q * (2 - q)), 2 * np.pi * u[:, 1:]
    return (1 - q) * axis + sine * np.cos(turn) * s + sine * np.sin(turn) * np.cross(axis, s)


def distance(triangles, index, direction):
    """Along a ray from 0 to a triangle's plane, in f64."""
    if index == NOTHING:
        return np.inf
    a, b, c = triangles[index].astype(float)
    direction = direction.astype(float)
    normal = np.cross(b - a, c - a)
    return (normal @ a) / (normal @ direction) * np.linalg.norm(direction)


def near(triangles, ray):
    """(hit or not by f64, how near in metres the ray passes an edge that matters for that)."""
    origin, direction, end = ray
    d = np.asarray(direction, float)
    a, b, c = (triangles[:, k].astype(float) - origin for k in range(3))
    # Inside by this much of an edge: the edge's distance from the ray, times the edge's side of it.
    sides = []
    for p, q in ((b, c), (c, a), (a, b)):
        across = np.cross(d, q - p)
        sides.append(np.einsum("ij,ij->i", across, p) / np.maximum(np.linalg.norm(across, axis=1), 1e-300))
    sides = np.stack(sides)
    inside = np.maximum(sides.min(axis=0), (-sides).min(axis=0))
    normal = np.cross(b - a, c - a)
    with np.errstate(divide="ignore", invalid="ignore"):
        t = np.einsum("ij,ij->i", normal, a) / (normal @ d)
    ahead = (t > 0) & (t < end)
    best = inside[ahead].max()
    return bool(best > 0), abs(float(best))


def written(counts, options):
    rays, differ = sum(c.rays for c in counts), sum(c.differ for c in counts)
    verdict = "**Accepted**" if differ <= ACCEPTED * rays else "**Not accepted**"
    lines = [f"""# Hits and misses against Embree ROBUST

Written by `tests/peers/embree/hits.py`; the README beside it says how to run it.

{verdict}: {differ} of {rays} distinct rays differ in whether they hit, {differ / rays:.1e}; {ACCEPTED:.0e} is allowed.

Embree is 4.4.0 with `RTC_SCENE_FLAG_ROBUST` and build quality high. Both programs get the same f32
triangles and the same f32 rays, bit by bit. Camera rays go through the pixels of {options.size} and ask
for the first triangle (in umbrage `Tracer::primary`, a picture of one pixel each). Shadow rays start
1e-4 m above those pixels' surfaces, {options.rays} from each but for those below the horizon, towards places on
the light, and ask for any hit (in umbrage `Tracer::truth`, method rays, a light without size).
*Packets* counts differences when Embree traces 16 rays at once. *Other triangle* are first hits more
than 1e-5 m apart.

| case | rays | distinct | hit something | hit or miss differs | packets | other triangle |
| --- | --- | ---: | ---: | ---: | ---: | ---: |"""]
    for c in counts:
        packets, others = (c.packets, "") if c.what.startswith("shadow") else ("", c.others)
        lines.append(f"| {c.case} | {c.what} | {c.rays} | {c.hits} | {c.differ} | {packets} | {others} |")
    notes = [(c, *note) for c in counts for note in c.notes]
    if notes:
        lines.append("\nRays that differ, looked at in f64 with every triangle: how near they pass to an edge.\n")
        lines.append("| case | rays | f64 says | from the edge |\n| --- | --- | --- | --- |")
        lines += [f"| {c.case} | {c.what} | {'hit' if hit else 'miss'} | {gap:.1e} m |" for c, hit, gap in notes[:20]]
        if len(notes) > 20:
            lines.append(f"\n{len(notes) - 20} more are not listed.")
    return "\n".join(lines) + "\n"


if __name__ == "__main__":
    sys.exit(main())
