"""Law 1: the same picture however it is run; each test renders one scene in many ways and compares bits."""
import base64
import json
import math
import os
import struct
import zlib

import program
from program import diffuse, emitting, material, quad, scene, sky, sphere, swell, tool


def smooth_mesh(rings, segments):
    """A unit sphere as triangles with the sphere's normals."""
    points, faces = [], []
    for i in range(rings + 1):
        for k in range(segments):
            theta, phi = math.pi * i / rings, 2 * math.pi * k / segments
            points += [math.sin(theta) * math.cos(phi), math.cos(theta), math.sin(theta) * math.sin(phi)]
    for i in range(rings):
        for k in range(segments):
            a, b = i * segments + k, i * segments + (k + 1) % segments
            faces += [a, b, b + segments, a, b + segments, a + segments]
    text = " ".join(f"{p:.6f}" for p in points)
    return (f'Shape "trianglemesh" "point3 P" [ {text} ] "normal N" [ {text} ]\n'
            f'"integer indices" [ {" ".join(map(str, faces))} ]\n')


FLOOR = quad((-9, 0, -9), (-9, 0, 9), (9, 0, 9), (9, 0, -9))
MIXED = scene(
    sky(0.3, 0.4, 0.6) + emitting(sphere(-3, 5, -3, 0.8), 20, 18, 15)
    + 'LightSource "point" "point3 from" [ 4 4 -4 ] "rgb I" [ 6 8 9 ]\n'
    + 'LightSource "distant" "point3 from" [ 1 2 -1 ] "point3 to" [ 0 0 0 ] "rgb L" [ 0.5 0.4 0.3 ]\n'
    + diffuse(0.5, 0.45, 0.4) + FLOOR
    + material("dielectric", '"float eta" [ 1.5 ]') + sphere(-1.5, 0.7, 0, 0.7)
    + material("dielectric", '"float eta" [ 0.6666667 ]') + sphere(-1.5, 0.7, 0, 0.6)
    + material("mirror", '"rgb reflectance" [ 0.9 0.8 0.7 ]') + sphere(0, 0.7, 0.6, 0.7)
    + material("fuzzymirror", '"float fuzz" [ 0.4 ]') + sphere(1.5, 0.7, 0, 0.7)
    + material("conductor", '"spectrum eta" "metal-Au-eta" "spectrum k" "metal-Au-k"')
    + sphere(0.6, 0.35, -1, 0.35)
    + material("dielectric", '"string eta" "water" "string fresnel" "schlick"') + sphere(-0.6, 0.3, -1.2, 0.3)
    + diffuse(0.7, 0.2, 0.1) + sphere(0, 0.2, -1.8, 0.2),
    look="0 1.8 -6  0 0.6 0  0 1 0", size=(96, 64), spp=16, pixel_filter="gaussian",
    camera='"perspective" "float fov" [ 34 ] "float lensradius" [ 0.05 ] "float focaldistance" [ 5.5 ]')
# Every material that MIXED has not, with stretched facets, walks between layers and mixes in mixes.
MATERIALS = scene(
    sky(0.4, 0.4, 0.5) + emitting(sphere(-3, 5, -3, 0.8), 20, 18, 15)
    + material("coateddiffuse", '"rgb reflectance" [ 0.6 0.4 0.2 ] "float roughness" [ 0.2 ]') + FLOOR
    + material("coateddiffuse", '"float thickness" [ 0.5 ] "float g" [ 0.4 ] "rgb albedo" [ 0.9 0.7 0.5 ]')
    + sphere(-1.5, 0.7, 0, 0.7)
    + material("coatedconductor", '"float conductor.roughness" [ 0.1 ]') + sphere(0, 0.7, 0.6, 0.7)
    + material("conductor", '"float uroughness" [ 0.02 ] "float vroughness" [ 0.4 ]') + sphere(1.5, 0.7, 0, 0.7)
    + material("thindielectric") + sphere(0.6, 0.35, -1, 0.35)
    + material("diffusetransmission", '"rgb transmittance" [ 0.4 0.3 0.1 ]') + sphere(-0.6, 0.3, -1.2, 0.3)
    + 'MakeNamedMaterial "a" "string type" "diffuse"\nMakeNamedMaterial "b" "string type" "dielectric"\n'
    + 'MakeNamedMaterial "ab" "string type" "mix" "string materials" [ "a" "b" ] "float amount" [ 0.3 ]\n'
    + material("mix", '"string materials" [ "ab" "b" ]') + sphere(0, 0.2, -1.8, 0.2)
    + material("principled", '"rgb base_color" [ 0.7 0.2 0.1 ] "float metallic" [ 0.4 ] "float roughness" [ 0.3 ]'
               ' "float clearcoat" [ 0.8 ] "rgb sheen_color" [ 0.3 0.3 0.6 ] "float sheen_roughness" [ 0.4 ]')
    + sphere(0.9, 0.25, -1.7, 0.25),
    look="0 1.8 -6  0 0.6 0  0 1 0", size=(96, 64), spp=16, pixel_filter="box")
ENVIRONMENT = scene(
    sky(0.9, 1.0, 1.2) + diffuse(0.4, 0.4, 0.4) + FLOOR
    + "AttributeBegin\nTranslate -1.1 1 0\n" + diffuse(0.7, 0.5, 0.3) + smooth_mesh(24, 40) + "AttributeEnd\n"
    + "AttributeBegin\nTranslate 1.1 1 0\nScale 1 0.9 0.8\n"
    + material("fuzzymirror", '"float fuzz" [ 0.2 ]') + smooth_mesh(16, 24) + "AttributeEnd\n"
    + "AttributeBegin\nTranslate 0 0.5 -1.4\nScale 0.5 0.5 0.5\n"
    + material("dielectric") + smooth_mesh(20, 30) + "AttributeEnd\n",
    look="0 2 -6  0 0.8 0  0 1 0", size=(96, 64), spp=16, pixel_filter="mitchell")

# Textured parameters, bumps, holes, and lights that are images; "sky.pfm" and "image.pfm" stand beside.
TEXTURED = scene(
    'LightSource "infinite" "string filename" "sky.pfm"\n'
    + 'Texture "image" "spectrum" "imagemap" "string filename" "image.pfm" "float uscale" 3 "float vscale" 3\n'
    + 'Texture "noise" "float" "fbm"\nTexture "holes" "float" "checkerboard" "float uscale" 8 "float vscale" 8\n'
    + 'Texture "faint" "float" "dots" "float uscale" 6 "float vscale" 6 "float inside" 0.3 "float outside" 0.8\n'
    + 'Texture "stone" "spectrum" "marble" "float scale" 4\nTexture "small" "float" "scale" "texture tex" "noise" "float scale" 0.05\n'
    + material("diffuse", '"texture reflectance" "image"') + FLOOR
    + material("conductor", '"texture roughness" "noise"') + sphere(-1.5, 0.7, 0, 0.7)
    + material("diffuse", '"texture reflectance" "stone" "texture displacement" "small"') + sphere(0, 0.7, 0.6, 0.7)
    + diffuse(0.8, 0.6, 0.4) + "AttributeBegin\nTranslate 1.5 0.7 0\n"
    + 'Shape "sphere" "float radius" 0.7 "texture alpha" "holes"\nAttributeEnd\n'
    + 'AttributeBegin\nTranslate 0.3 0.3 -1.4\nShape "sphere" "float radius" 0.3 "texture alpha" "faint"\nAttributeEnd\n'
    + 'AttributeBegin\nAreaLightSource "diffuse" "string filename" "image.pfm" "float scale" 9\n'
    + sphere(-2, 3, -2, 0.4) + "AttributeEnd\n"
    + 'LightSource "spot" "rgb I" [ 9 9 9 ] "point3 from" [ 3 4 -3 ] "point3 to" [ 0 0 0 ]\n'
    + 'LightSource "goniometric" "string filename" "sky.pfm"\n',
    look="0 1.8 -6  0 0.6 0  0 1 0", size=(96, 64), spp=16)

# Two objects, one within the other and both at many places, turned, mirrored and stretched.
INSTANCES = scene(
    sky(0.4, 0.5, 0.7) + emitting(sphere(-3, 5, -3, 0.8), 20, 18, 15) + diffuse(0.5, 0.45, 0.4) + FLOOR
    + 'ObjectBegin "thing"\n' + material("conductor", '"float roughness" [ 0.3 ]') + sphere(0, 0.5, 0, 0.4)
    + "Translate 0.5 0.3 0\nScale 0.3 0.3 0.3\n" + diffuse(0.7, 0.5, 0.3) + smooth_mesh(16, 24) + "ObjectEnd\n"
    + 'ObjectBegin "group"\n' + material("dielectric") + sphere(0, 1.2, 0, 0.3) + 'ObjectInstance "thing"\n'
    + 'Rotate 90 0 1 0\nScale 0.5 1 -0.7\nObjectInstance "thing"\nObjectEnd\n'
    + "".join(f'AttributeBegin\nTranslate {i % 5 - 2} 0 {i // 5 - 2}\nRotate {37 * i} 0 1 0\nScale {0.5 + 0.02 * i} 0.6 0.5\n'
              f'ObjectInstance "{"group" if i % 2 else "thing"}"\nAttributeEnd\n' for i in range(25)),
    look="0 2 -6  0 0.6 0  0 1 0", size=(96, 64), spp=16)


def png(size, pixels):
    """A PNG of size x size pixels, each three bytes."""
    def chunk(kind, data):
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))

    rows = b"".join(b"\0" + bytes(pixels[3 * size * y:3 * size * (y + 1)]) for y in range(size))
    header = struct.pack(">IIBBBBB", size, size, 8, 2, 0, 0, 0)
    data = chunk(b"IHDR", header) + chunk(b"IDAT", zlib.compress(rows))
    return b"\x89PNG\r\n\x1a\n" + data + chunk(b"IEND", b"")


def gltf():
    """A bent sheet with tangents and two sets of coordinates under a coat with relief, and a lamp with a picture."""
    def uri(kind, data):
        return f"data:{kind};base64,{base64.b64encode(data).decode()}"

    steps = range(5)
    points = [(x / 2 - 1, y / 2 - 1, 0.2 * math.sin(2 * x)) for y in steps for x in steps]
    normals = [(-0.4 * math.cos(2 * p[0]), 0.0, 1.0) for p in points]
    normals = [[c / math.hypot(*n) for c in n] for n in normals]
    tangents = [(n[2], 0.0, -n[0], -1.0 if p[1] > 0 else 1.0) for p, n in zip(points, normals)]
    uvs = [[(2 * p[0], 2 * p[1]) for p in points], [(p[1], 1 - p[0]) for p in points]]
    corners = [i for y in steps[:-1] for x in steps[:-1] for a in [5 * y + x]
               for i in (a, a + 1, a + 6, a, a + 6, a + 5)]
    parts = [(points, "3f"), (normals, "3f"), (tangents, "4f"), (uvs[0], "2f"), (uvs[1], "2f"),
             ([(i,) for i in corners], "I")]
    chunks = [b"".join(struct.pack("<" + form, *row) for row in rows) for rows, form in parts]
    views = [{"buffer": 0, "byteOffset": sum(map(len, chunks[:i])), "byteLength": len(chunk)}
             for i, chunk in enumerate(chunks)]
    types = ["VEC3", "VEC3", "VEC4", "VEC2", "VEC2", "SCALAR"]
    accessors = [{"bufferView": i, "componentType": 5125 if t == "SCALAR" else 5126, "count": len(parts[i][0]),
                  "type": t} for i, t in enumerate(types)]
    accessors[0].update(min=[-1, -1, -0.2], max=[1, 1, 0.2])
    names = ["POSITION", "NORMAL", "TANGENT", "TEXCOORD_0", "TEXCOORD_1"]
    relief = [b for i in range(64) for b in (100 + i * 37 % 56, 100 + i * 23 % 56, 235)]
    colours = [60 + i * 53 % 180 for i in range(192)]
    sheet = {"normalTexture": {"index": 0}, "pbrMetallicRoughness": {"roughnessFactor": 0.4, "metallicFactor": 0.5,
             "baseColorTexture": {"index": 1, "texCoord": 1}}, "extensions": {
                 "KHR_materials_anisotropy": {"anisotropyStrength": 0.7, "anisotropyRotation": 0.5},
                 "KHR_materials_clearcoat": {"clearcoatFactor": 0.6, "clearcoatRoughnessFactor": 0.2,
                                             "clearcoatNormalTexture": {"index": 0, "texCoord": 1}}}}
    lamp = {"emissiveFactor": [1, 1, 1], "emissiveTexture": {"index": 1, "texCoord": 1}, "doubleSided": True}
    primitive = {"attributes": {name: i for i, name in enumerate(names)}, "indices": 5}
    return json.dumps({
        "asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0, 1]}],
        "nodes": [{"mesh": 0, "scale": [1, -1, 1]},
                  {"mesh": 1, "translation": [0, 1.2, 0.8], "scale": [0.3, 0.3, 0.3]}],
        "meshes": [{"primitives": [dict(primitive, material=m)]} for m in (0, 1)], "materials": [sheet, lamp],
        "textures": [{"source": 0}, {"source": 1}],
        "images": [{"uri": uri("image/png", png(8, values))} for values in (relief, colours)],
        "buffers": [{"uri": uri("application/octet-stream", b"".join(chunks)), "byteLength": sum(map(len, chunks))}],
        "bufferViews": views, "accessors": accessors})


# More than two levels of the light tree.
LAMPS = scene(diffuse(0.5, 0.5, 0.5) + sphere(0, 0, 1, 1.2) + "".join(
    emitting(sphere(i % 12 / 3 - 2, i // 12 / 3 - 1.5, -0.5 - i % 7 / 9, 0.03), 3 + i % 5, 4, 6 - i % 4)
    for i in range(110)), size=(96, 64))

WAYS = [
    ("--nthreads", "1"), ("--nthreads", "2"),
    ("--wave", "64"), ("--wave", "4096"), ("--wave", "65536"),
    ("--window", "1"), ("--window", "8"), ("--wave", "4096", "--window", "4096"), ("--wave", "64", "--window", "8"),
    ("--traversal", "packet"), ("--traversal", "single"), ("--traversal", "auto"),
    ("--regeneration", "on"), ("--regeneration", "off"), ("--regeneration", "off", "--wave", "64"),
    ("--engine", "wavefront"), ("--engine", "megakernel"),
    ("--engine", "megakernel", "--nthreads", "1", "--regeneration", "off"),
]
SAMPLINGS = ["disk", "normal-plus-sphere", "normal-plus-rejected-sphere", "normal-plus-gaussian"]
# Edges of crop windows that cut through tiles and vectors.
X_EDGES, Y_EDGES = [0, 0.34, 0.61, 1], [0, 0.53, 1]


class Law1(program.ProgramTest):
    def assert_same(self, reference, other, how):
        done = program.command(program.IMAGE_TOOL, "equal", reference, other)
        self.assertEqual((done.returncode, done.stdout.strip()), (0, "same"), f"{how}: {done.stderr}")

    def check(self, text, size):
        text = self.write("scene.pbrt", text) if "WorldBegin" in text else text
        options = ("--resolution", f"{size[0]}x{size[1]}", "--spp", "16")
        reference = self.render(text, *options)
        low, high = (float(v) for v in tool("range", reference).split())
        self.assertGreater(low, -0.2)  # filters may have negative lobes
        self.assertGreater(high, 0.1, "the picture is not black")
        for way in WAYS:
            self.assert_same(reference, self.render(text, *options, *way), " ".join(way))

        self.check_isas(reference, text, options)
        self.check_crops(reference, text, options, size)
        other = self.render(text, *options, "--seed", "7")
        self.assertNotEqual(program.command(program.IMAGE_TOOL, "equal", reference, other).returncode, 0,
                            "another seed gives other noise")

    def check_isas(self, reference, text, options):
        usable = program.usable_isas()
        fused = [isa for isa in usable if isa in ("avx3", "avx2", "neon")]
        if not fused:
            print(f"skipped --isa: no instruction set here has fused multiply-add ({', '.join(usable)})")
        for isa in fused:
            self.assert_same(reference, self.render(text, *options, "--isa", isa), f"--isa {isa}")
            self.assert_same(reference, self.render(text, *options, "--isa", isa, "--engine", "megakernel"),
                             f"--isa {isa} --engine megakernel")

    def check_crops(self, reference, text, options, size):
        words = [os.path.join(self.folder, "pasted.exr"), *map(str, size)]
        for x0, x1 in zip(X_EDGES, X_EDGES[1:]):
            for y0, y1 in zip(Y_EDGES, Y_EDGES[1:]):
                crop = self.render(text, *options, "--cropwindow", f"{x0},{x1},{y0},{y1}")
                words += [crop, math.ceil(size[0] * x0), math.ceil(size[1] * y0)]
        tool("paste", *words)
        self.assert_same(reference, words[0], "crops pasted into the frame")

    def test_cornell_box_is_the_same_however_it_is_run(self):
        self.check(os.path.join(program.LECTURE, "cornell-box.pbrt"), (64, 64))

    def test_mixed_materials_are_the_same_however_they_are_run(self):
        self.check(MIXED, (96, 64))

    def test_layered_stretched_and_mixed_materials_are_the_same_however_they_are_run(self):
        self.check(MATERIALS, (96, 64))

    def test_environment_with_smooth_meshes_is_the_same_however_it_is_run(self):
        self.check(ENVIRONMENT, (96, 64))

    def test_textures_holes_and_image_lights_are_the_same_however_they_are_run(self):
        for name, size in (("sky.pfm", 16), ("image.pfm", 8)):
            values = [(7 * i * i + 3 * i) % 11 / 10 for i in range(3 * size * size)]
            self.write(name, f"PF\n{size} {size}\n-1.0\n".encode() + struct.pack(f"<{len(values)}f", *values))
        self.check(TEXTURED, (96, 64))

    def test_instances_are_the_same_however_they_are_run(self):
        self.check(INSTANCES, (96, 64))

    def test_tangents_and_second_coordinates_are_the_same_however_they_are_run(self):
        self.check(self.write("scene.gltf", gltf()), (96, 64))

    def test_many_lights_are_the_same_however_they_are_run(self):
        self.check(LAMPS, (96, 64))

    def test_each_diffuse_sampling_is_the_same_in_every_wave_and_engine(self):
        text = self.write("scene.pbrt", ENVIRONMENT)
        pictures = []
        for sampling in SAMPLINGS:
            options = ("--diffuse-sampling", sampling, "--spp", "4")
            pictures.append(self.render(text, *options))
            for way in [("--wave", "64"), ("--window", "1"), ("--engine", "megakernel"), ("--nthreads", "1"),
                        ("--wave", "65536", "--regeneration", "off")]:
                self.assert_same(pictures[-1], self.render(text, *options, *way), f"{sampling} {way}")
        for i, a in enumerate(pictures):
            for b in pictures[i + 1:]:
                self.assertNotEqual(program.command(program.IMAGE_TOOL, "equal", a, b).returncode, 0,
                                    "two samplings draw different directions")

    def test_each_sampler_is_the_same_in_every_wave_engine_and_crop(self):
        text = self.write("scene.pbrt", ENVIRONMENT)
        for sampler in ("zsobol", "halton", "stratified", "independent"):  # the default is in all of the above
            options = ("--sampler", sampler, "--spp", "7")
            picture = self.render(text, *options)
            for way in [("--wave", "64"), ("--window", "1"), ("--engine", "megakernel"), ("--nthreads", "1"),
                        ("--wave", "65536", "--regeneration", "off")]:
                self.assert_same(picture, self.render(text, *options, *way), f"{sampler} {way}")
            self.check_isas(picture, text, options)
            self.check_crops(picture, text, options, (96, 64))

    def test_each_light_sampler_is_the_same_in_every_wave_and_engine(self):
        text = self.write("scene.pbrt", MIXED)
        pictures = []
        for sampler in ("uniform", "power", "bvh"):
            options = ("--lightsampler", sampler, "--spp", "4")
            pictures.append(self.render(text, *options))
            for way in [("--wave", "64"), ("--window", "1"), ("--engine", "megakernel"), ("--nthreads", "1")]:
                self.assert_same(pictures[-1], self.render(text, *options, *way), f"{sampler} {way}")
        for i, a in enumerate(pictures):
            for b in pictures[i + 1:]:
                self.assertNotEqual(program.command(program.IMAGE_TOOL, "equal", a, b).returncode, 0,
                                    "two samplers draw different lights")

    def test_equal_runs_write_equal_bytes(self):
        files = []
        scene_file = self.write("scene.pbrt", MIXED)
        for name in ("a.png", "b.png"):
            files.append(os.path.join(self.folder, name))
            done = swell("render", scene_file, "--quiet", "--spp", "4", "--outfile", files[-1])
            self.assertEqual(done.returncode, 0, done.stderr)
        with open(files[0], "rb") as a, open(files[1], "rb") as b:
            self.assertEqual(a.read(), b.read())


if __name__ == "__main__":
    program.main()
