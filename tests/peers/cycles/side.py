"""Cycles' side: a program of its own, run by a Python that has Blender as the module bpy.

    python side.py JOB.json

compare_cycles.py starts it and writes the job: an OBJ, a light, a camera, a size, samples and batches.
For each batch, with a seed of its own, this writes an EXR of radiance with shadows and one without,
with the positions and normals that were hit. Albedo is 1 everywhere: irradiance is pi times radiance.
"""
import json
import math
import sys
from pathlib import Path

import bpy
import numpy as np
from mathutils import Matrix

# Width of the pixel filter, the least that Blender allows: a ray misses the pixel's centre by less
# than half of it.
FILTER_PX = 0.01


def main():
    job = json.loads(Path(sys.argv[1]).read_text())
    bpy.ops.wm.read_factory_settings(use_empty=True)
    add("model", mesh(job["obj"]))
    lamps = [add("lamp", *lamp) for lamp in lamps_of(job["light"])]
    add_camera(job["camera"])
    settings(job)
    for batch in range(job["batches"]):
        for shadows in (True, False):
            for lamp in lamps:
                lamp.data.use_shadow = shadows
            render(batch, Path(job["out"]) / f"{'E' if shadows else 'E0'}-{batch}.exr")


def add(name, data, placed=None):
    thing = bpy.data.objects.new(name, data)
    if placed is not None:
        thing.matrix_world = placed
    # Of lamps: they are not to be seen.
    thing.visible_camera = not isinstance(data, bpy.types.Light)
    bpy.context.scene.collection.objects.link(thing)
    return thing


def mesh(path):
    vertices, faces = [], []
    for line in open(path):
        word, *rest = line.split() or [""]
        if word == "v":
            vertices.append([float(x) for x in rest[:3]])
        elif word == "f":
            faces.append([int(corner.split("/")[0]) - 1 for corner in rest])
    faces = np.array(faces, np.int32)
    made = bpy.data.meshes.new("model")
    made.vertices.add(len(vertices))
    made.vertices.foreach_set("co", np.array(vertices, np.float32).ravel())
    made.loops.add(faces.size)
    made.loops.foreach_set("vertex_index", faces.ravel())
    made.polygons.add(len(faces))
    made.polygons.foreach_set("loop_start", np.arange(len(faces), dtype=np.int32) * 3)
    made.update(calc_edges=True)
    # Meshes made here are smooth unless told otherwise.
    made.shade_flat()
    made.materials.append(white())
    return made


def white():
    material = bpy.data.materials.new("white")
    material.use_nodes = True
    nodes = material.node_tree.nodes
    nodes.clear()
    surface, diffuse = nodes.new("ShaderNodeOutputMaterial"), nodes.new("ShaderNodeBsdfDiffuse")
    diffuse.inputs["Color"].default_value = (1, 1, 1, 1)
    diffuse.inputs["Roughness"].default_value = 0
    material.node_tree.links.new(diffuse.outputs[0], surface.inputs[0])
    return material


def lamps_of(light):
    """Lamps of radiance 1, and how they stand. Those of Blender shine along their -z, to one side:
    a flat light takes two."""
    kind = light["kind"]
    if kind == "sun":
        lamp = bpy.data.lights.new("sun", "SUN")
        lamp.angle = light["angular_diameter_radians"]
        # A sun's strength is the irradiance straight below it.
        lamp.energy = math.pi * math.sin(0.5 * lamp.angle) ** 2
        return [finished(lamp, upright(light["direction_to_light"], [0, 0, 0]))]
    if kind == "sphere":
        lamp = bpy.data.lights.new("sphere", "POINT")
        lamp.shadow_soft_size = light["radius_world"]
        lamp.use_soft_falloff = False
        lamp.energy = 4 * (math.pi * light["radius_world"]) ** 2
        return [finished(lamp, upright([0, 0, 1], light["centre"]))]
    if kind == "disk":
        up = np.array(light["normal"], float)
        return [flat("DISK", [light["radius_world"]] * 2, upright(sign * up, light["centre"])) for sign in (1, -1)]
    u, v = np.array(light["half_u"], float), np.array(light["half_v"], float)
    if abs(u @ v) > 1e-6 * np.linalg.norm(u) * np.linalg.norm(v):
        sys.exit("a rectangle of Blender's has right angles")
    sizes = [np.linalg.norm(u), np.linalg.norm(v)]
    x, y = u / sizes[0], v / sizes[1]
    sides = [(x, y), (x, -y)]
    return [flat("RECTANGLE", sizes, matrix(x, y, np.cross(x, y), light["centre"])) for x, y in sides]


def flat(shape, halves, placed):
    lamp = bpy.data.lights.new("flat", "AREA")
    lamp.shape, lamp.size, lamp.size_y, lamp.spread = shape, 2 * halves[0], 2 * halves[1], math.pi
    area = 4 * halves[0] * halves[1] if shape == "RECTANGLE" else math.pi * halves[0] ** 2
    lamp.energy = math.pi * area
    return finished(lamp, placed)


def finished(lamp, placed):
    lamp.color = (1, 1, 1)
    lamp.cycles.max_bounces = 0
    lamp.cycles.use_multiple_importance_sampling = False
    return lamp, placed


def upright(z, place):
    z = np.array(z, float) / np.linalg.norm(z)
    x = np.cross([1.0, 0, 0] if abs(z[0]) < 0.6 else [0, 1.0, 0], z)
    x /= np.linalg.norm(x)
    return matrix(x, np.cross(z, x), z, place)


def matrix(x, y, z, place):
    return Matrix([[x[i], y[i], z[i], place[i]] for i in range(3)] + [[0, 0, 0, 1]])


def add_camera(told):
    data = bpy.data.cameras.new("camera")
    data.sensor_fit = "VERTICAL"
    data.angle = math.radians(told["yfov_degrees"])
    data.clip_start, data.clip_end = 1e-3, 1e4
    eye, target = np.array(told["eye"], float), np.array(told["target"], float)
    back = (eye - target) / np.linalg.norm(eye - target)
    right = np.cross(told["up"], back)
    right /= np.linalg.norm(right)
    bpy.context.scene.camera = add("camera", data, matrix(right, np.cross(back, right), back, eye))


def settings(job):
    scene = bpy.context.scene
    scene.view_layers[0].use_pass_position = scene.view_layers[0].use_pass_normal = True
    render, cycles = scene.render, scene.cycles
    render.engine = "CYCLES"
    render.resolution_x, render.resolution_y = job["size"]
    render.resolution_percentage = 100
    render.threads_mode, render.threads = "FIXED", job["threads"]
    render.use_persistent_data = True
    cycles.samples = job["samples"]
    # Without blue noise, which gives neighbours opposite errors.
    cycles.sampling_pattern = "TABULATED_SOBOL"
    cycles.pixel_filter_type, cycles.filter_width = "BLACKMAN_HARRIS", FILTER_PX
    cycles.use_adaptive_sampling = cycles.use_denoising = False
    cycles.max_bounces = cycles.diffuse_bounces = cycles.glossy_bounces = cycles.transmission_bounces = 0
    cycles.light_sampling_threshold = cycles.sample_clamp_direct = cycles.sample_clamp_indirect = 0
    # Not picked by importance: two lamps back to back get the same share of samples.
    cycles.use_light_tree = False
    scene.view_settings.view_transform = "Raw"
    render.image_settings.file_format = "OPEN_EXR_MULTILAYER"
    render.image_settings.color_depth = "32"


def render(seed, path):
    bpy.context.scene.cycles.seed = seed
    bpy.context.scene.render.filepath = str(path)
    bpy.ops.render.render(write_still=True)


main()
