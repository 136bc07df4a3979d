"""The side of bench/cycles that runs in Blender.

blender -b --factory-startup -P cycles_blender.py -- prepare MESH.obj PANORAMA.hdr FOLDER SIZE DEPTH
    closes the mesh and writes it with a scene file for minirtc to FOLDER: glass under the panorama
blender ... -- render SCENE.json SEED PREFIX THREADS SAMPLES...
    renders that scene by Cycles; for each number of samples PREFIX_<samples>.pfm and a line "samples seconds processor-seconds" in
    PREFIX.times
"""
import json
import math
import os
import struct
import sys
import time

import bmesh
import bpy
from mathutils import Vector


def import_mesh(path):
    """The one mesh of an OBJ file; Blender's z is up, so that (x, y, z) of the file is (x, -z, y) here."""
    bpy.ops.wm.read_factory_settings(use_empty=True)
    bpy.ops.wm.obj_import(filepath=path, forward_axis="NEGATIVE_Z", up_axis="Y")
    return bpy.context.selected_objects[0]


def close(mesh):
    """Fills holes, triangulates, and forgets normals and materials."""
    shape = bmesh.new()
    shape.from_mesh(mesh)
    bmesh.ops.remove_doubles(shape, verts=shape.verts, dist=0)
    bmesh.ops.holes_fill(shape, edges=[edge for edge in shape.edges if edge.is_boundary], sides=0)
    bmesh.ops.triangulate(shape, faces=shape.faces)
    bmesh.ops.recalc_face_normals(shape, faces=shape.faces)
    shape.to_mesh(mesh)
    shape.free()


def write_obj(mesh, path):
    with open(path, "w", encoding="ascii") as file:
        for vertex in mesh.vertices:
            x, y, z = vertex.co
            file.write(f"v {x:.9g} {z:.9g} {-y:.9g}\n")
        for face in mesh.polygons:
            file.write("f " + " ".join(str(i + 1) for i in face.vertices) + "\n")


def prepare(source, panorama, folder, size, depth):
    thing = import_mesh(source)
    bpy.ops.object.transform_apply()
    close(thing.data)
    write_obj(thing.data, os.path.join(folder, "mesh.obj"))
    corners = [[f(axis) for axis in zip(*(v.co for v in thing.data.vertices))] for f in (min, max)]
    low, high = [Vector((x, z, -y)) for x, y, z in corners]
    center, radius = (low + high) / 2, (high - low).length / 2
    eye = center + Vector((0.35, 0.3, 1)).normalized() * radius * 2.6
    scene = {
        "camera": {"position": list(eye), "target": list(center), "vfov": 40},
        "background": {"image": os.path.abspath(panorama)},
        "materials": {"glass": {"model": "pbr", "transmission": 1, "roughness": 0, "ior": 1.5}},
        "objects": [{"mesh": "mesh.obj", "material": "glass", "smooth": False}],
        "render": {"integrators": ["whitted", "wavefront"], "accuracy": {"weak_rays": "roulette"}, "maxDepth": int(depth), "size": [int(size), int(size)]},
    }
    with open(os.path.join(folder, "scene.json"), "w", encoding="utf-8") as file:
        json.dump(scene, file, indent=1)


def add_glass(thing):
    material = bpy.data.materials.new("glass")
    material.use_nodes = True
    nodes, links = material.node_tree.nodes, material.node_tree.links
    nodes.clear()
    glass = nodes.new("ShaderNodeBsdfGlass")
    glass.distribution = "SHARP"
    glass.inputs["Color"].default_value = (1, 1, 1, 1)
    glass.inputs["IOR"].default_value = 1.5
    output = nodes.new("ShaderNodeOutputMaterial")
    links.new(glass.outputs["BSDF"], output.inputs["Surface"])
    thing.data.materials.clear()
    thing.data.materials.append(material)


def add_panorama(path):
    world = bpy.data.worlds.new("panorama")
    world.use_nodes = True
    picture = world.node_tree.nodes.new("ShaderNodeTexEnvironment")
    picture.image = bpy.data.images.load(path)
    world.node_tree.links.new(picture.outputs["Color"], world.node_tree.nodes["Background"].inputs["Color"])
    bpy.context.scene.world = world


def add_camera(camera):
    def turned(v):
        return Vector((v[0], -v[2], v[1]))

    lens = bpy.data.cameras.new("camera")
    lens.sensor_fit = "VERTICAL"
    lens.angle = math.radians(camera["vfov"])
    thing = bpy.data.objects.new("camera", lens)
    thing.location = turned(camera["position"])
    thing.rotation_euler = (turned(camera["target"]) - thing.location).to_track_quat("-Z", "Y").to_euler()
    bpy.context.collection.objects.link(thing)
    bpy.context.scene.camera = thing
    lens.clip_start = 1e-4


def set_cycles(render, threads, seed):
    """The same estimate as minirt's: nothing clamped, blurred, denoised or ended early; box filter."""
    scene = bpy.context.scene
    scene.render.engine = "CYCLES"
    scene.render.resolution_x, scene.render.resolution_y = render["size"]
    scene.render.resolution_percentage = 100
    scene.render.threads_mode, scene.render.threads = "FIXED", threads
    scene.render.image_settings.file_format = "OPEN_EXR"
    scene.render.image_settings.color_depth = "32"
    cycles = scene.cycles
    cycles.device = "CPU"
    cycles.seed = seed
    cycles.use_adaptive_sampling = cycles.use_denoising = cycles.use_auto_tile = False
    cycles.pixel_filter_type, cycles.filter_width = "BOX", 1.0
    cycles.sample_clamp_direct = cycles.sample_clamp_indirect = 0
    cycles.blur_glossy = 0
    cycles.caustics_reflective = cycles.caustics_refractive = True
    for kind in ("max_bounces", "glossy_bounces", "transmission_bounces", "diffuse_bounces", "transparent_max_bounces"):
        setattr(cycles, kind, render["maxDepth"])


def write_pfm(exr, path):
    picture = bpy.data.images.load(exr)
    width, height = picture.size
    pixels = picture.pixels[:]
    colours = [value for i, value in enumerate(pixels) if i % 4 != 3]
    with open(path, "wb") as file:
        file.write(f"PF\n{width} {height}\n-1.0\n".encode("ascii"))
        file.write(struct.pack(f"<{len(colours)}f", *colours))
    bpy.data.images.remove(picture)


def render(scene_file, seed, prefix, threads, *samples):
    with open(scene_file, encoding="utf-8") as file:
        scene = json.load(file)
    add_glass(import_mesh(os.path.join(os.path.dirname(scene_file), scene["objects"][0]["mesh"])))
    add_panorama(scene["background"]["image"])
    add_camera(scene["camera"])
    set_cycles(scene["render"], int(threads), int(seed))
    bpy.context.scene.render.filepath = prefix + ".exr"
    bpy.context.scene.cycles.samples = 1
    bpy.ops.render.render(write_still=True)  # what is made once does not count
    with open(prefix + ".times", "w", encoding="ascii") as times:
        for count in samples:
            bpy.context.scene.cycles.samples = int(count)
            start, processor = time.perf_counter(), time.process_time()
            bpy.ops.render.render(write_still=True)
            times.write(f"{count} {time.perf_counter() - start} {time.process_time() - processor}\n")
            write_pfm(prefix + ".exr", f"{prefix}_{count}.pfm")


command, *arguments = sys.argv[sys.argv.index("--") + 1 :]
{"prepare": prepare, "render": render}[command](*arguments)
