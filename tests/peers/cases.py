"""What is compared: a model, a light and a camera each, told to both programs independently.

The atrium's light and camera are written down here once; umbrage gets them as a scene.toml, Mitsuba
from this file. A built-in scene's come from the export example, which writes down what umbrage
itself resolved. Lengths in metres, y up.
"""
import json
import math
import subprocess
from dataclasses import dataclass
from pathlib import Path

REPOSITORY = Path(__file__).resolve().parents[2]

EYE, TARGET, YFOV_DEGREES = [-9.5, 2.6, 1.6], [1.0, 2.3, -1.2], 60.0

# The court is open above |z| < 3.2: lamps hang in it, the sun shines into it.
ATRIUM_LIGHTS = {
    "atrium-rect": {"kind": "rect", "centre": [-3.0, 7.6, 0.8], "half_u": [0.3, 0.0, 0.0], "half_v": [0.0, 0.18, 0.24]},
    "atrium-sun": {"kind": "sun", "angular_diameter_degrees": 2.0, "direction_to_light": [0.25, 0.9, 0.35]},
    "atrium-disk": {"kind": "disk", "centre": [-3.0, 7.6, 0.8], "normal": [0.2, -1.0, 0.1], "radius_world": 0.3},
    "atrium-sphere": {"kind": "sphere", "centre": [-3.0, 7.6, 0.8], "radius_world": 0.3},
}
BUILTIN_CASE = "colonnade-sun"
NAMES = [*ATRIUM_LIGHTS, BUILTIN_CASE]
# What must hold for the proof to count; the others are extra.
REQUIRED = {"atrium-rect", "atrium-sun", BUILTIN_CASE}


@dataclass
class Case:
    name: str
    scene: str      # what umbrage is told
    path: str
    obj: Path       # what Mitsuba is told
    light: dict
    camera: dict    # eye, target, up, yfov_degrees

    def arguments(self):
        """Of `umbrage reference`, as far as they concern the scene."""
        return [self.scene, "--path", self.path, "--frame", "0"]


def make(name, atrium, folder):
    """The case of this name; files that it needs are made in `folder`."""
    return builtin_case(folder) if name == BUILTIN_CASE else atrium_case(name, atrium, folder)


def atrium_case(name, atrium, folder):
    light = ATRIUM_LIGHTS[name]
    home = folder / name
    home.mkdir(exist_ok=True)
    link = home / "atrium.obj"
    if not link.exists():
        link.symlink_to(atrium.resolve())
    (home / "scene.toml").write_text(scene_toml(light))
    if light["kind"] == "sun":
        light = light | {"angular_diameter_radians": math.radians(light["angular_diameter_degrees"])}
    camera = {"eye": EYE, "target": TARGET, "up": [0, 1, 0], "yfov_degrees": YFOV_DEGREES}
    return Case(name, str(home), "P0", atrium, light, camera)


def scene_toml(light):
    # JSON's strings, numbers and lists of numbers are TOML's as well.
    fields = "\n".join(f"{key} = {json.dumps(value)}" for key, value in light.items())
    motion = f'{{ kind = "still", eye = {EYE}, target = {TARGET} }}'
    return f"""title = "Atrium"
[geometry]
files = ["atrium.obj"]
[[light]]
{fields}
[[path]]
name = "P0"
frames = 1
yfov_degrees = {YFOV_DEGREES}
motion = {motion}
"""


def builtin_case(folder):
    scene, path = BUILTIN_CASE.removesuffix("-sun"), "P0"
    obj = folder / f"{scene}.obj"
    export = ["cargo", "run", "--quiet", "-p", "umbrage-scene", "--example", "export", "--"]
    subprocess.run([*export, scene, str(obj), path, "0"], cwd=REPOSITORY, check=True, stdout=subprocess.DEVNULL)
    told = json.loads(obj.with_suffix(".json").read_text())
    # Columns: right, up, back, eye.
    _, up, back, eye = (column[:3] for column in told["camera"]["world_from_camera"])
    camera = {
        "eye": eye,
        "target": [e - b for e, b in zip(eye, back)],
        "up": up,
        "yfov_degrees": math.degrees(told["camera"]["yfov_radians"]),
    }
    return Case(BUILTIN_CASE, scene, path, obj, told["light"], camera)
