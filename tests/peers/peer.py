"""Mitsuba's side: the light's unoccluded fraction and irradiance at given points.

Mitsuba brings its own OBJ reader, camera, ray tracer, random numbers, shapes and light sampling.
Written here are only the sums, and the sun, which Mitsuba lacks as a light of finite size: a cone of
directions, tested with its rays, so that no far-away disk has to stand in for it.
"""
import math
from dataclasses import dataclass

import drjit as dr
import mitsuba as mi
import numpy as np

# Lanes of one launch: samples of a point side by side.
CHUNK = 32
# A blocker nearer than this is a contact.
CONTACT = 0.01
# How far short of the point the search for contacts ends. Positions are f32: 1e-6 m off at 16 m, so
# that a ray with a cosine of 1e-2 meets the point's own surface this far ahead.
CONTACT_END = 1e-4
# How far short of the light our own rays end, relative to its distance; nothing is that near a lamp.
LIGHT_END = 1e-4


@dataclass
class Settings:
    """Of one estimate."""
    spp: int
    # Of a ray's origin along the normal, relative to 1 + the largest coordinate; with None, Mitsuba
    # makes the ray in its own way.
    lift: float | None
    seed: int


class Lamp:
    """A rectangle or disk that shines to both sides, or a sphere: Mitsuba's own emitters.

    They stand in scenes of their own, so that they shadow nothing, as umbrage's lights do not."""

    def __init__(self, light):
        shape = shape_of(light)
        shape["emitter"] = {"type": "area", "radiance": {"type": "rgb", "value": 1.0}}
        flips = [False] if light["kind"] == "sphere" else [False, True]
        self.sides = [mi.load_dict({"type": "scene", "light": shape | {"flip_normals": flip}}) for flip in flips]
        self.by_area = light["kind"] != "sphere"

    def place(self, it, u):
        """Uniform over a flat light's area, or over a sphere's solid angle; and no direction."""
        if self.by_area:
            return self.sides[0].shapes()[0].sample_position(0.0, u).p, None
        return self.sides[0].sample_emitter_direction(it, u, False)[0].p, None

    def irradiance(self, it, u):
        """A place, and what it would add if nothing were between, by Mitsuba's own density."""
        total = mi.Float(0)
        for side in self.sides:
            sample, weight = side.sample_emitter_direction(it, u, False)
            total += weight.x * dr.maximum(dr.dot(it.n, sample.d), 0)
        return (sample.p, None), total


class Sun:
    """A cone of directions, uniform by solid angle."""

    def __init__(self, light):
        self.axis = mi.Vector3f(*normalised(light["direction_to_light"]))
        # 1 - cos of the half angle, without its cancellation in f32.
        self.height = 2 * math.sin(0.25 * light["angular_diameter_radians"]) ** 2

    def place(self, it, u):
        q = u.x * self.height
        sine = dr.sqrt(q * (2 - q))
        s, c = dr.sincos(u.y * dr.two_pi)
        return None, mi.Frame3f(self.axis).to_world(mi.Vector3f(c * sine, s * sine, 1 - q))

    def irradiance(self, it, u):
        place, direction = self.place(it, u)
        weight = 2 * math.pi * self.height * dr.maximum(dr.dot(it.n, direction), 0)
        return (place, direction), weight


class Peer:
    """A model, a light and a camera in Mitsuba."""

    def __init__(self, case):
        mesh = {"type": "obj", "filename": str(case.obj), "face_normals": True}
        self.scene = mi.load_dict({"type": "scene", "mesh": mesh})
        self.light = Sun(case.light) if case.light["kind"] == "sun" else Lamp(case.light)
        self.camera = case.camera

    def triangles(self):
        return sum(shape.face_count() for shape in self.scene.shapes())

    def hits(self, size):
        """What Mitsuba's camera sees through the pixel centres: positions, normals on the viewer's
        side, and whether there is anything, in row order."""
        width, height = size
        camera = self.camera
        sensor = mi.load_dict({
            "type": "perspective", "fov": camera["yfov_degrees"], "fov_axis": "y",
            "near_clip": 1e-3, "far_clip": 1e4,
            "to_world": mi.ScalarTransform4f().look_at(origin=camera["eye"], target=camera["target"], up=camera["up"]),
            "film": {"type": "hdrfilm", "width": width, "height": height},
        })
        pixel = dr.arange(mi.UInt32, width * height)
        centre = mi.Point2f((pixel % width + 0.5) / width, (pixel // width + 0.5) / height)
        ray, _ = sensor.sample_ray(0.0, 0.5, centre, mi.Point2f(0.5))
        si = self.scene.ray_intersect(mi.Ray3f(ray.o, ray.d))
        normal = dr.select(dr.dot(si.n, ray.d) > 0, -si.n, si.n)
        return np.array(si.p).T, np.array(normal).T, np.array(si.is_valid())

    def estimate(self, position, normal, settings):
        """Means over `settings.spp` independent samples at each point, and the variances of those
        means: a dictionary of arrays."""
        sums = {}
        # The seed is no literal, so that all launches share one compiled kernel.
        for launch in range(settings.spp // CHUNK):
            seed = dr.opaque(mi.UInt32, settings.seed * 4096 + launch)
            for key, value in self.launch(position, normal, (settings.lift, seed)).items():
                sums[key] = sums.get(key, 0) + np.array(value, dtype=np.float64)
        return means(sums, settings.spp)

    def launch(self, position, normal, how):
        lift, seed = how
        count = len(position) * CHUNK
        point = dr.arange(mi.UInt32, count) // CHUNK
        it = dr.zeros(mi.SurfaceInteraction3f, count)
        it.p = dr.gather(mi.Point3f, mi.Point3f(np.ascontiguousarray(position.T, np.float32)), point)
        it.n = dr.gather(mi.Normal3f, mi.Normal3f(np.ascontiguousarray(normal.T, np.float32)), point)
        sampler = mi.load_dict({"type": "independent"})
        sampler.seed(seed, count)
        aim = self.light.place(it, sampler.next_2d())
        visible = self.visible(it, aim, lift)
        other, weight = self.light.irradiance(it, sampler.next_2d())
        shadowed = dr.select(self.visible(it, other, lift), weight, 0)
        terms = {
            "V": dr.select(visible, mi.Float(1), 0), "contact": dr.select(self.contact(it, aim), mi.Float(1), 0),
            "E": shadowed, "E.squares": shadowed**2, "E0": weight, "E0.squares": weight**2,
        }
        result = {key: dr.block_sum(value, CHUNK) for key, value in terms.items()}
        dr.eval(result)
        return result

    def visible(self, it, aim, lift):
        """Whether nothing is between a point and a place or direction. Nothing is seen below the
        horizon."""
        ray = spawned(it, aim) if lift is None else lifted(it, aim, lift)
        return (dr.dot(it.n, ray.d) > 0) & ~self.scene.ray_test(ray)

    def contact(self, it, aim):
        """Whether a surface crosses the way to the light right at the point. Looked for from a
        centimetre away back to the point, so that no lift can jump over it."""
        direction = towards(it.p, aim)
        ray = mi.Ray3f(it.p + CONTACT * direction, -direction)
        ray.maxt = CONTACT - CONTACT_END
        return (dr.dot(it.n, direction) > 0) & self.scene.ray_test(ray)


def spawned(it, aim):
    place, direction = aim
    return it.spawn_ray(direction) if place is None else it.spawn_ray_to(place)


def lifted(it, aim, lift):
    largest = dr.maximum(dr.maximum(dr.abs(it.p.x), dr.abs(it.p.y)), dr.abs(it.p.z))
    origin = it.p + it.n * (lift * (1 + largest))
    ray = mi.Ray3f(origin, towards(origin, aim))
    if aim[0] is not None:
        ray.maxt = dr.norm(aim[0] - origin) * (1 - LIGHT_END)
    return ray


def towards(origin, aim):
    place, direction = aim
    return direction if place is None else dr.normalize(place - origin)


def shape_of(light):
    if light["kind"] == "sphere":
        return {"type": "sphere", "center": light["centre"], "radius": light["radius_world"]}
    if light["kind"] == "rect":
        u, v = light["half_u"], light["half_v"]
        kind, axes = "rectangle", [u, v, normalised(np.cross(u, v))]
    else:
        frame = mi.Frame3f(mi.Vector3f(*normalised(light["normal"])))
        u, v = (np.array(axis).ravel() * light["radius_world"] for axis in (frame.s, frame.t))
        kind, axes = "disk", [u, v, normalised(light["normal"])]
    matrix = np.eye(4)
    matrix[:3, :3], matrix[:3, 3] = np.transpose(axes), light["centre"]
    return {"type": kind, "to_world": mi.ScalarTransform4f(matrix.tolist())}


def normalised(vector):
    vector = np.asarray(vector, float)
    return (vector / np.linalg.norm(vector)).tolist()


def means(sums, count):
    result = {key: sums[key] / count for key in ("V", "E", "E0")}
    for key in ("E", "E0"):
        spread = np.maximum(sums[f"{key}.squares"] / count - result[key] ** 2, 0)
        result[f"{key}.variance"] = spread / (count - 1)
    result["contact"] = sums["contact"] > 0
    return result
