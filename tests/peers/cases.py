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
# Lamps hang in the other scenes too, a metre or more from everything; the sun is the scene's own.
LAMPS = {
    "colonnade": ([-1.0, 6.0, 2.0], 0.4),
    "foliage": ([2.5, 7.0, 1.5], 0.4),
    "curved-receivers": ([-1.0, 6.5, -1.0], 0.4),
    "contact": ([1.5, 5.0, 1.5], 0.3),
}
KINDS = ["rect", "sun", "disk", "sphere"]
BUILTIN_NAMES = [f"{scene}-{kind}" for scene in LAMPS for kind in KINDS]
NAMES = [*ATRIUM_LIGHTS, *BUILTIN_NAMES]
# Each kind of light in a picture of its own, and a built-in scene.
PICTURED = [*ATRIUM_LIGHTS, "colonnade-sun"]


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
    return atrium_case(name, atrium, folder) if name in ATRIUM_LIGHTS else builtin_case(name, folder)


def atrium_case(name, atrium, folder):
    light = ATRIUM_LIGHTS[name]
    home = folder / name
    home.mkdir(exist_ok=True)
    link = home / "atrium.obj"
    if not link.exists():
        link.symlink_to(atrium.resolve())
    geometry = f'files = ["{link.name}"]'
    (home / "scene.toml").write_text(scene_toml(geometry, light, (EYE, TARGET, YFOV_DEGREES)))
    if light["kind"] == "sun":
        light = light | {"angular_diameter_radians": math.radians(light["angular_diameter_degrees"])}
    camera = {"eye": EYE, "target": TARGET, "up": [0, 1, 0], "yfov_degrees": YFOV_DEGREES}
    return Case(name, str(home), "P0", atrium, light, camera)


def scene_toml(geometry, light, camera):
    # JSON's strings, numbers and lists of numbers are TOML's as well.
    fields = "\n".join(f"{key} = {json.dumps(value)}" for key, value in light.items())
    eye, target, yfov_degrees = camera
    motion = f'{{ kind = "still", eye = {eye}, target = {target} }}'
    return f"""title = "A case"
[geometry]
{geometry}
[[light]]
{fields}
[[path]]
name = "P0"
frames = 1
yfov_degrees = {yfov_degrees}
motion = {motion}
"""


def builtin_case(name, folder):
    """A built-in scene: umbrage makes its surfaces, others read the export's. With its own sun umbrage
    knows all by the scene's name; lamps are written down for it."""
    scene, _, kind = name.rpartition("-")
    obj, told = exported(scene, folder)
    # Columns: right, up, back, eye.
    _, up, back, eye = (column[:3] for column in told["camera"]["world_from_camera"])
    camera = {
        "eye": eye,
        "target": [e - b for e, b in zip(eye, back)],
        "up": up,
        "yfov_degrees": math.degrees(told["camera"]["yfov_radians"]),
    }
    if kind == "sun":
        return Case(name, scene, "P0", obj, told["light"], camera)
    light = lamp(kind, *LAMPS[scene])
    home = folder / name
    home.mkdir(exist_ok=True)
    view = camera["eye"], camera["target"], camera["yfov_degrees"]
    (home / "scene.toml").write_text(scene_toml(f'generator = "{scene}"', light, view))
    return Case(name, str(home), "P0", obj, light, camera)


def lamp(kind, centre, size):
    """All of about one width; the flat ones look down, a little to the side."""
    if kind == "rect":
        return {"kind": kind, "centre": centre, "half_u": [size, 0.0, 0.0], "half_v": [0.0, 0.6 * size, 0.8 * size]}
    light = {"kind": kind, "centre": centre, "radius_world": size}
    return light | {"normal": [0.2, -1.0, 0.1]} if kind == "disk" else light


def exported(scene, folder):
    obj = folder / f"{scene}.obj"
    if not obj.exists():
        export = ["cargo", "run", "--quiet", "--release", "-p", "umbrage-scene", "--example", "export", "--"]
        subprocess.run([*export, scene, str(obj), "P0", "0"], cwd=REPOSITORY, check=True, stdout=subprocess.DEVNULL)
    return obj, json.loads(obj.with_suffix(".json").read_text())
