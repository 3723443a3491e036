"""A small shot in Blender, and its frames for `umbrage score` as docs/engines/blender.py writes them.

    python blender_shot.py OUT [--engine CYCLES] [--samples 64] [--seed 0] [--size 320x180] [--frames 16]

Needs Blender as the module bpy. Boxes, a torus and thin rods over a floor, a sun of 2 degrees, a camera that
trucks past them by keyframes.
"""
import importlib.util
import math
import sys
from pathlib import Path

import bpy

GUIDE = Path(__file__).parents[2] / "docs/engines/blender.py"


def main(words):
    words, (width, height), frames = taken(words)
    bpy.ops.wm.read_factory_settings(use_empty=True)
    bpy.ops.mesh.primitive_plane_add(size=16)
    for x, y, size in ((-1.5, 0.5, 1.0), (1.2, 1.0, 0.7), (0.2, -1.0, 0.4)):
        bpy.ops.mesh.primitive_cube_add(size=size, location=(x, y, size / 2 + 0.3), rotation=(0.3, 0, 0.4 * x))
    bpy.ops.mesh.primitive_torus_add(location=(0, 0.6, 1.5), rotation=(0.6, 0.2, 0), major_radius=0.6, minor_radius=0.12)
    for i in range(6):
        bpy.ops.mesh.primitive_cylinder_add(radius=0.02, depth=2.5, location=(-2.5 + 0.35 * i, -0.8, 1.25))
    bpy.ops.object.light_add(type="SUN", rotation=(math.radians(40), math.radians(15), 0))
    bpy.context.object.data.angle = math.radians(2)
    bpy.context.object.data.energy = 3
    bpy.ops.object.camera_add()
    camera = bpy.context.object
    scene = bpy.context.scene
    scene.camera = camera
    scene.frame_start, scene.frame_end = 1, frames
    for frame, x in ((1, -0.4), (frames, 0.4)):
        camera.location = (x, -6.5, 3.2)
        camera.rotation_euler = (math.radians(64), 0, 0.05 * x)
        camera.keyframe_insert("location", frame=frame)
        camera.keyframe_insert("rotation_euler", frame=frame)
    scene.render.resolution_x, scene.render.resolution_y = width, height
    scene.render.resolution_percentage = 100
    spec = importlib.util.spec_from_file_location("guide", GUIDE)
    guide = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(guide)
    guide.main(words)


def taken(words):
    """The flags that are this script's own, and the rest."""
    rest, size, frames = [], "320x180", "16"
    words = iter(words)
    for word in words:
        if word == "--size":
            size = next(words)
        elif word == "--frames":
            frames = next(words)
        else:
            rest.append(word)
    return rest, tuple(int(n) for n in size.split("x")), int(frames)


if __name__ == "__main__":
    main(sys.argv[1:])
