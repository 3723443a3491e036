"""A third witness for single points: every triangle against every light sample, in float64.

No tree, no lift, no early end; numpy and nothing else. Slow, hence for a few points.
"""
import numpy as np

# Triangles at a time, so that a table of triangles by samples stays below 200 MB.
BATCH = 2048


def load_obj(path):
    """Triangles as (count, 3, 3), read as float32 like both renderers do."""
    vertices, faces = [], []
    for line in open(path):
        word, *rest = line.split() or [""]
        if word == "v":
            vertices.append([float(x) for x in rest[:3]])
        elif word == "f":
            faces.append([int(corner.split("/")[0]) - 1 for corner in rest])
    return np.array(vertices, np.float32).astype(float)[np.array(faces)]


def visibility(triangles, light, point, samples):
    """(V, its standard error) at a point (position, normal) on a triangle: `samples` squared strata."""
    position, own, normal = on_surface(triangles, *point)
    rays = directions(light, position, samples)
    open_ = rays @ normal > 0
    corners = triangles - position
    above = ((corners @ normal) > 1e-12).any(axis=1)
    above[own] = False
    candidates = corners[above & near_shaft(corners, rays)]
    for start in range(0, len(candidates), BATCH):
        open_ &= ~crossed(candidates[start:start + BATCH], rays, light["kind"] == "sun")
    mean = open_.mean()
    # The error of jittered strata is below that of as many independent samples.
    return mean, np.sqrt(max(mean * (1 - mean), 1 / len(rays)) / len(rays))


def on_surface(triangles, position, normal):
    """The point on the plane of the triangle that it lies on, that triangle, and its normal."""
    a, b, c = (triangles[:, k] - position for k in range(3))
    cross = np.cross(b - a, c - a)
    unit = cross / np.maximum(np.linalg.norm(cross, axis=1, keepdims=True), 1e-300)
    height = np.einsum("ij,ij->i", unit, a)
    inside = np.min([np.einsum("ij,ij->i", np.cross(p, q), unit) for p, q in ((a, b), (b, c), (c, a))], axis=0)
    faces_it = np.abs(unit @ normal) > 0.999
    # Inside to f32's rounding: 1e-6 m at 10 m, times edges of up to 30 m.
    distance = np.where(faces_it & (inside > -3e-5), np.abs(height), np.inf)
    own = int(np.argmin(distance))
    unit = unit[own] * np.sign(unit[own] @ normal)
    return position + unit * (unit @ a[own]), own, unit


def directions(light, position, samples):
    """From the point to places on the light, or to the sky: jittered strata, seeded by the place."""
    generator = np.random.default_rng(np.abs(position * 1e6).astype(np.int64))
    grid = np.stack(np.meshgrid(np.arange(samples), np.arange(samples)), -1).reshape(-1, 2)
    u, v = ((grid + generator.random(grid.shape)) / samples).T
    if light["kind"] == "rect":
        half_u, half_v = np.array(light["half_u"]), np.array(light["half_v"])
        return np.array(light["centre"]) - position + np.outer(2 * u - 1, half_u) + np.outer(2 * v - 1, half_v)
    if light["kind"] == "disk":
        s, t = pair(np.array(light["normal"], float))
        radius = np.sqrt(u) * light["radius_world"]
        plane = np.outer(np.cos(2 * np.pi * v) * radius, s) + np.outer(np.sin(2 * np.pi * v) * radius, t)
        return np.array(light["centre"]) - position + plane
    return cone(light, position, (u, v))


def cone(light, position, uv):
    u, v = uv
    if light["kind"] == "sun":
        axis, half = np.array(light["direction_to_light"], float), 0.5 * light["angular_diameter_radians"]
        distance = 1.0
    else:
        axis = np.array(light["centre"]) - position
        distance = np.linalg.norm(axis)
        half = np.arcsin(light["radius_world"] / distance)
    axis /= np.linalg.norm(axis)
    s, t = pair(axis)
    q = u * 2 * np.sin(half / 2) ** 2
    sine = np.sqrt(q * (2 - q))
    unit = np.outer(1 - q, axis) + np.outer(sine * np.cos(2 * np.pi * v), s) + np.outer(sine * np.sin(2 * np.pi * v), t)
    if light["kind"] == "sun":
        return unit
    # To the near side of the sphere.
    along = (1 - q) * distance
    return unit * (along - np.sqrt(np.maximum(along**2 - distance**2 + light["radius_world"] ** 2, 0)))[:, None]


def pair(axis):
    """Two unit vectors square to an axis and to each other."""
    axis = axis / np.linalg.norm(axis)
    s = np.cross(axis, [1.0, 0, 0] if abs(axis[0]) < 0.6 else [0, 1.0, 0])
    s /= np.linalg.norm(s)
    return s, np.cross(axis, s)


def near_shaft(corners, rays):
    """Whether a triangle's bounding ball touches the cone round all rays: a shortcut only."""
    unit = rays / np.linalg.norm(rays, axis=1, keepdims=True)
    axis = unit.mean(axis=0)
    axis /= np.linalg.norm(axis)
    widest = np.arccos(np.clip((unit @ axis).min(), -1, 1))
    centre = corners.mean(axis=1)
    radius = np.linalg.norm(corners - centre[:, None], axis=2).max(axis=1)
    distance = np.linalg.norm(centre, axis=1)
    angle = np.arccos(np.clip(centre @ axis / np.maximum(distance, 1e-300), -1, 1))
    reach = np.arcsin(np.clip(radius / np.maximum(distance, 1e-300), 0, 1))
    return (distance <= radius) | (angle <= widest + reach + 1e-9)


def crossed(corners, rays, endless):
    """Per ray, whether any of the triangles is between its start and its end: the ray is on the
    inner side of the three planes through the start and an edge, and ends behind the triangle."""
    a, b, c = (corners[:, k] for k in range(3))
    bc, ca, ab = np.cross(b, c), np.cross(c, a), np.cross(a, b)
    volume = np.einsum("ij,ij->i", a, bc)
    sign = np.where(volume < 0, -1.0, 1.0)[:, None]
    inner = ((sign * bc) @ rays.T >= 0) & ((sign * ca) @ rays.T >= 0) & ((sign * ab) @ rays.T >= 0)
    depth = (sign * (bc + ca + ab)) @ rays.T
    inner &= depth > (0 if endless else np.abs(volume)[:, None])
    return inner.any(axis=0)
