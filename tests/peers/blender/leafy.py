"""Makes tests/models/leafy.glb with Blender's own exporter: what a user's file looks like.

A textured floor, leaves cut out by a picture's alpha (one mesh under two objects, and once mirrored),
and a camera that moves. `pip install bpy==4.5.*` (Python 3.11), then `python3 leafy.py OUT.glb`.
"""

import math
import sys

import bpy

SIDE = 24


def picture(name, colour_at):
    image = bpy.data.images.new(name, SIDE, SIDE, alpha=True)
    image.pixels = [c for y in range(SIDE) for x in range(SIDE) for c in colour_at(x, y)]
    image.pack()
    return image


def leaf_at(x, y):
    """A leaf of no symmetry, with a hole."""
    u, v = (x + 0.5) / SIDE - 0.5, (y + 0.5) / SIDE - 0.5
    inside = (u / 0.46) ** 2 + (v / (0.25 + 0.2 * u)) ** 2 < 1
    hole = (u + 0.2) ** 2 + v**2 < 0.006
    return 0.1, 0.5 + 0.3 * v, 0.1, float(inside and not hole)


def floor_at(x, y):
    light = 0.75 if (x // 6 + y // 6) % 2 else 0.3
    return light, light * 0.9, light * 0.8, 1.0


def material(name, image, is_cut_out):
    made = bpy.data.materials.new(name)
    made.use_nodes = True
    nodes, links = made.node_tree.nodes, made.node_tree.links
    shader = nodes["Principled BSDF"]
    texture = nodes.new("ShaderNodeTexImage")
    texture.image = image
    links.new(texture.outputs["Color"], shader.inputs["Base Color"])
    if is_cut_out:
        # The exporter takes "alpha > 0.5" for glTF's MASK.
        clip = nodes.new("ShaderNodeMath")
        clip.operation = "GREATER_THAN"
        clip.inputs[1].default_value = 0.5
        links.new(texture.outputs["Alpha"], clip.inputs[0])
        links.new(clip.outputs["Value"], shader.inputs["Alpha"])
        made.use_backface_culling = False
    return made


def plane(name, size, paint):
    bpy.ops.mesh.primitive_plane_add(size=size)
    made = bpy.context.object
    made.name = name
    made.data.materials.append(paint)
    return made


def main(out):
    bpy.ops.wm.read_factory_settings(use_empty=True)
    plane("floor", 8, material("tiles", picture("tiles", floor_at), False))
    paint = material("leaf", picture("leaf", leaf_at), True)
    first = plane("leaf", 1.6, paint)
    first.location, first.rotation_euler = (-0.9, 0.2, 1.1), (0.3, 0.2, 0.4)
    places = [((0.9, 0.6, 1.4), (0.2, -0.3, 1.9), 1.0), ((0.3, -0.9, 0.8), (0.1, 0.4, 2.6), -1.0)]
    for number, (at, turn, side) in enumerate(places):
        copy = bpy.data.objects.new(f"leaf copy {number}", first.data)
        bpy.context.collection.objects.link(copy)
        copy.location, copy.rotation_euler, copy.scale = at, turn, (side, 1, 1)
    bpy.ops.mesh.primitive_cube_add(size=0.4, location=(1.6, -0.6, 0.2))
    lens = bpy.data.cameras.new("camera")
    camera = bpy.data.objects.new("camera", lens)
    bpy.context.collection.objects.link(camera)
    bpy.context.scene.camera = camera
    bpy.context.scene.render.fps = 24
    bpy.context.scene.frame_start, bpy.context.scene.frame_end = 1, 25
    for frame, x in [(1, -0.6), (25, 0.6)]:
        camera.location = (x, -5.5, 3.4)
        camera.rotation_euler = (math.radians(60), 0, 0.1 * x)
        camera.keyframe_insert("location", frame=frame)
        camera.keyframe_insert("rotation_euler", frame=frame)
    bpy.ops.export_scene.gltf(
        filepath=out, export_format="GLB", export_cameras=True, export_animations=True, export_normals=False
    )


main(sys.argv[1])
