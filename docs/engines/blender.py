"""Frames of a Blender scene for `umbrage score`.

    blender shot.blend --background --python blender.py -- OUT [--engine CYCLES] [--samples 64] [--seed 0]

Writes into OUT what the active camera sees from the scene's first frame to its last:

    scene.glb            the surfaces, y up, as Blender's own exporter writes them
    cameras.json         the camera of every frame, in Blender's own axes
    sun.toml             the one sun or area light that is scored
    lit.####.exr         with shadows, depth beside it; linear light
    unlit.####.exr       the same without shadows

The light that is scored must be the only one, and surfaces are rendered white and matte: what is measured is
the shadow, and the ratio of the two pictures is exact then.
"""
import argparse
import json
import math
import sys
from pathlib import Path

import bpy
from mathutils import Vector


def main(words):
    options = parse(words)
    options.out.mkdir(parents=True, exist_ok=True)
    scene = bpy.context.scene
    lamp = the_light(scene)
    (options.out / "sun.toml").write_text(light_toml(lamp))
    write_cameras(scene, options.out / "cameras.json")
    bpy.ops.export_scene.gltf(filepath=str(options.out / "scene.glb"), export_yup=True, export_apply=True)
    set_up(scene, options)
    for shadows, name in ((True, "lit"), (False, "unlit")):
        lamp.data.use_shadow = shadows
        for frame in range(scene.frame_start, scene.frame_end + 1):
            scene.frame_set(frame)
            # Noise of its own in each frame, as a game has it.
            if scene.render.engine == "CYCLES":
                scene.cycles.seed = options.seed * 100_003 + frame
            scene.render.filepath = str(options.out / f"{name}.{frame:04}.exr")
            bpy.ops.render.render(write_still=True)


def parse(words):
    parser = argparse.ArgumentParser(prog="blender.py")
    parser.add_argument("out", type=Path)
    parser.add_argument("--engine", default="CYCLES")
    parser.add_argument("--samples", type=int, default=64)
    parser.add_argument("--seed", type=int, default=0)
    return parser.parse_args(words)


def the_light(scene):
    lamps = [thing for thing in scene.objects if thing.type == "LIGHT" and not thing.hide_render]
    if len(lamps) != 1:
        sys.exit(f"{len(lamps)} lights are on: one is scored at a time; turn the others off")
    return lamps[0]


def light_toml(lamp):
    """As `[[light]]` of a scene file; Blender's (x, y, z) is (x, z, -y) there."""
    turned = lambda v: [v[0], v[2], -v[1]]
    world = lamp.matrix_world
    if lamp.data.type == "SUN":
        # A lamp shines along its -z.
        to_light = turned(world.to_3x3() @ Vector((0, 0, 1)))
        return (
            f'kind = "sun"\nangular_diameter_degrees = {math.degrees(lamp.data.angle)}\n'
            f"direction_to_light = {to_light}\n"
        )
    if lamp.data.type == "AREA" and lamp.data.shape in ("SQUARE", "RECTANGLE"):
        across = lamp.data.size
        down = lamp.data.size_y if lamp.data.shape == "RECTANGLE" else across
        u, v = world.col[0].xyz * across / 2, world.col[1].xyz * down / 2
        return (
            f'kind = "rect"\ncentre = {turned(world.translation)}\n'
            f"half_u = {turned(u)}\nhalf_v = {turned(v)}\n"
        )
    sys.exit(f"a light of type {lamp.data.type} is not known to this script: write its file by hand")


def write_cameras(scene, path):
    width = scene.render.resolution_x * scene.render.resolution_percentage // 100
    height = scene.render.resolution_y * scene.render.resolution_percentage // 100
    frames = []
    for frame in range(scene.frame_start, scene.frame_end + 1):
        scene.frame_set(frame)
        camera = scene.camera
        if camera.data.type != "PERSP" or camera.data.shift_x or camera.data.shift_y:
            sys.exit("the camera must be a perspective one, without shift")
        # Whatever side the sensor is fitted to: the corners of the picture.
        corner = camera.data.view_frame(scene=scene)[0]
        half = abs(corner.y / corner.z)
        matrix = camera.matrix_world.normalized()
        frames.append({
            "index": frame,
            "world_from_camera": [matrix[row][column] for column in range(4) for row in range(4)],
            "yfov": 2 * math.atan(half),
            "near": camera.data.clip_start,
            "far": camera.data.clip_end,
            "width": width,
            "height": height,
        })
    fps = scene.render.fps / scene.render.fps_base
    cameras = {"version": 1, "convention": {"preset": "blender"}, "fps": fps, "frames": frames}
    path.write_text(json.dumps(cameras, indent=1))


def set_up(scene, options):
    scene.render.engine = options.engine
    scene.render.film_transparent = False
    scene.render.image_settings.file_format = "OPEN_EXR_MULTILAYER"
    scene.render.image_settings.color_depth = "32"
    scene.view_settings.view_transform = "Raw"
    # Anything but the light would have to be taken off the ratio.
    scene.world = scene.world or bpy.data.worlds.new("dark")
    scene.world.use_nodes = True
    scene.world.node_tree.nodes["Background"].inputs["Strength"].default_value = 0
    layer = scene.view_layers[0]
    layer.use_pass_z = True
    layer.material_override = white()
    if options.engine == "CYCLES":
        scene.cycles.samples = options.samples
        scene.cycles.use_adaptive_sampling = False
        scene.cycles.use_denoising = False
        scene.cycles.max_bounces = 0
        # Truth is the shadow at each pixel's centre.
        scene.cycles.pixel_filter_type = "BOX"
        scene.cycles.filter_width = 0.01
    else:
        scene.eevee.taa_render_samples = options.samples
        scene.render.filter_size = 0.01


def white():
    material = bpy.data.materials.new("white for the ratio")
    material.use_nodes = True
    nodes = material.node_tree.nodes
    nodes.clear()
    surface, diffuse = nodes.new("ShaderNodeOutputMaterial"), nodes.new("ShaderNodeBsdfDiffuse")
    diffuse.inputs["Color"].default_value = (1, 1, 1, 1)
    material.node_tree.links.new(diffuse.outputs[0], surface.inputs[0])
    return material


if __name__ == "__main__":
    main(sys.argv[sys.argv.index("--") + 1:])
