"""E0 by closed forms, in float64: who is right where two renderers differ in the fifth digit."""
import numpy as np


def unshadowed(light, position, normal):
    """E0 of a light of radiance 1, NaN where it crosses the horizon or no form is known here."""
    form = {"sun": sun, "sphere": sphere, "rect": rectangle}.get(light["kind"])
    return form(light, position, normal) if form else np.full(len(position), np.nan)


def sun(light, position, normal):
    axis = np.array(light["direction_to_light"], float)
    return cap(normal @ (axis / np.linalg.norm(axis)), np.sin(0.5 * light["angular_diameter_radians"]))


def sphere(light, position, normal):
    way = np.array(light["centre"]) - position
    distance = np.linalg.norm(way, axis=1)
    return cap(np.einsum("ij,ij->i", way, normal) / distance, light["radius_world"] / distance)


def cap(cosine, sine):
    """A disc of the sky whose half angle has this sine."""
    return np.where(np.abs(cosine) > sine, np.pi * sine**2 * np.maximum(cosine, 0), np.nan)


def rectangle(light, position, normal):
    """Lambert's formula for polygons."""
    centre, u, v = (np.array(light[key], float) for key in ("centre", "half_u", "half_v"))
    ways = np.stack([centre + a * u + b * v for a, b in ((-1, -1), (1, -1), (1, 1), (-1, 1))]) - position[:, None]
    heights = np.einsum("nkd,nd->nk", ways, normal)
    ways /= np.linalg.norm(ways, axis=2, keepdims=True)
    total = np.zeros(len(position))
    for k in range(4):
        a, b = ways[:, k], ways[:, (k + 1) % 4]
        cross = np.cross(a, b)
        sine = np.linalg.norm(cross, axis=1)
        total += np.arctan2(sine, np.einsum("ij,ij->i", a, b)) * np.einsum("ij,ij->i", cross, normal) / sine
    return np.where((heights > 0).all(axis=1), 0.5 * np.abs(total), np.where((heights < 0).all(axis=1), 0, np.nan))
