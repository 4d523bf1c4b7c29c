"""Seeds for the fuzzers: the repository's own scenes and pictures, and small files of every format and
kind, written here.

Usage: fuzz_corpus.py TARGET FOLDER
"""
import base64
import json
import os
import struct
import sys
import zlib

ROOT = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
MOST_BYTES = 16384  # longer files of the repository are no seeds

PBRT = """Film "rgb" "integer xresolution" 32 "integer yresolution" 24 "string filename" "film.exr"
Sampler "zsobol" "integer pixelsamples" 4
PixelFilter "mitchell" "float xradius" 2
Integrator "path" "integer maxdepth" 5
LookAt 0 0 -5  0 0 0  0 1 0
Camera "perspective" "float fov" 40 "float lensradius" 0.1
WorldBegin
LightSource "infinite" "rgb L" [1 1 1]
LightSource "spot" "point3 from" [0 1 0] "float coneangle" 30
Texture "t" "spectrum" "imagemap" "string filename" "image.pfm" "float uscale" 2
Texture "c" "float" "checkerboard" "float tex1" 0.5 "float tex2" [ 1 ]
MakeNamedMaterial "white" "string type" "diffuse" "texture reflectance" "t"
MakeNamedMaterial "metal" "string type" "conductor" "spectrum eta" "metal-Cu-eta"
MakeNamedMaterial "both" "string type" "mix" "string materials" ["white" "metal"] "float amount" 0.25
AttributeBegin
  NamedMaterial "both"
  AreaLightSource "diffuse" "blackbody L" 3000 "float scale" 2
  Translate 2 0 0 Rotate 30 0 1 0 Scale 1 2 3
  Shape "sphere" "float radius" 1 "texture alpha" "c"
AttributeEnd
ObjectBegin "o"
  Shape "plymesh" "string filename" "mesh.ply"
  Shape "trianglemesh" "point3 P" [0 0 0 1 0 0 0 1 0] "integer indices" [0 1 2] "point2 uv" [0 0 1 0 0 1]
ObjectEnd
TransformBegin
  ConcatTransform [1 0 0 0  0 1 0 0  0 0 1 0  1 2 3 1]
  ObjectInstance "o"
TransformEnd
Material "dielectric" "float eta" 1.5
Shape "disk" "float radius" 2 "float innerradius" 0.5
Shape "bilinearmesh" "point3 P" [0 0 0 1 0 0 0 1 0 1 1 1]
"""

MORE_PBRT = """Option "string rendercoordsys" "world"
ColorSpace "srgb"
WorldBegin
Attribute "shape" "float radius" 2
MakeNamedMedium "m" "string type" "homogeneous" "rgb sigma_a" [1 1 1]
MediumInterface "m" ""
Shape "cylinder" "float zmin" -1 "float zmax" 1
Shape "curve" "point3 P" [0 0 0 0 1 0 0 2 0 0 3 1] "float width" 0.1
Shape "loopsubdiv" "integer levels" 2 "point3 P" [0 0 0 1 0 0 0 1 0] "integer indices" [0 1 2]
Material "coateddiffuse" "spectrum reflectance" [400 0.1 700 0.9]
Import "none.pbrt"
"""

OBJ = """mtllib m.mtl
o thing
v 0 0 0
v 1 0 0 1
v 1 1 0 1 0.5 0.5
v 0.2 0.2 0
v 0 1 0
vt 0 0
vt 1 0.5
vn 0 0 1
usemtl a
s 1
f 1/1/1 2/2/1 3/1/1
usemtl b
f 1 2 3 4 5
f -5 -4 \\
 -3
f 1//1 2//1 3//1
l 1 2
p 1
"""
MTL = """newmtl a
Kd 0.5 0.4 0.3
Ks 0.5 0.5 0.5
Ns 30
Ke 1 1 1
illum 2
map_Kd -s 2 2 -o 0.1 i.pfm
bump -bm 0.5 i.pfm
newmtl b
Ni 1.5
d 0.5
Tf 1 1 1
illum 7
Pr 0.5
Pm 1
map_d i.pfm
"""


def ply(kind, header, body):
    return f"ply\nformat {kind} 1.0\n{header}end_header\n".encode() + body


def plys():
    xyz = "element vertex 4\nproperty float x\nproperty float y\nproperty float z\n"
    faces = "element face 2\nproperty list uchar int vertex_indices\n"
    corners = [0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0]
    text = b"0 0 0\n1 0 0\n1 1 0\n0 1 0\n"
    yield "ascii", ply("ascii", xyz + faces, text + b"3 0 1 2\n4 0 1 2 3\n")
    for name, order in (("binary_little_endian", "<"), ("binary_big_endian", ">")):
        body = struct.pack(order + "12f", *corners)
        body += struct.pack(order + "B3iB3i", 3, 0, 1, 2, 3, 0, 2, 3)
        yield name, ply(name, xyz + faces, body)
    rich = ("comment made here\nelement vertex 3\nproperty double x\nproperty double y\nproperty double z\n"
            "property float nx\nproperty float ny\nproperty float nz\nproperty float u\nproperty float v\n"
            "property uchar red\nelement face 1\nproperty list uint ushort vertex_index\nproperty int flags\n"
            "element other 2\nproperty list uchar float xs\n")
    body = b"".join(struct.pack("<3d5fB", x, y, 0, 0, 0, 1, x, y, 9) for x, y in ((0, 0), (1, 0), (0, 1)))
    body += struct.pack("<I3Hi", 3, 0, 1, 2, 7) + struct.pack("<BfB", 1, 0.5, 0)
    yield "rich", ply("binary_little_endian", rich, body)


def png(width, height, depth, kind, row):
    def chunk(name, data):
        return struct.pack(">I", len(data)) + name + data + struct.pack(">I", zlib.crc32(name + data))
    header = struct.pack(">IIBBBBB", width, height, depth, kind, 0, 0, 0)
    pixels = zlib.compress((b"\0" + row) * height)
    return b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", header) + chunk(b"IDAT", pixels) + chunk(b"IEND", b"")


def images():
    """(index in fuzz_image.cc's names, bytes)"""
    yield "png-rgb", 0, png(2, 2, 8, 2, bytes(range(6)))
    yield "png-rgba16", 0, png(2, 2, 16, 6, bytes(range(16)))
    yield "png-grey1", 0, png(8, 2, 1, 0, b"\xa5")
    yield "hdr", 2, b"#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 2 +X 2\n" + bytes([128, 64, 32, 129] * 4)
    yield "pfm", 3, b"PF\n2 1\n-1.0\n" + struct.pack("<6f", 0, 0.5, 1, 2, 1e9, -1)
    yield "tga", 4, struct.pack("<BBBHHBHHHHBB", 0, 0, 2, 0, 0, 0, 0, 0, 2, 2, 24, 0) + bytes(range(12))
    bmp = struct.pack("<IiiHHIIiiII", 40, 2, 1, 1, 24, 0, 8, 0, 0, 0, 0) + bytes(range(8))
    yield "bmp", 6, b"BM" + struct.pack("<IHHI", 14 + len(bmp), 0, 0, 54) + bmp


def gltfs():
    corners = struct.pack("<9f", 0, 0, 0, 1, 0, 0, 0, 1, 0) + struct.pack("<3H", 0, 1, 2) + b"\0\0"
    def scene(uri):
        buffer = {"byteLength": len(corners)}
        if uri:
            buffer["uri"] = uri
        return {
            "asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0, 1]}],
            "nodes": [{"mesh": 0, "translation": [0, 0, 1], "children": [2]}, {"camera": 0},
                      {"mesh": 0, "rotation": [0, 0, 0, 1], "scale": [1, 2, 1]}],
            "cameras": [{"type": "perspective", "perspective": {"yfov": 0.7, "znear": 0.1}}],
            "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1, "material": 0}]}],
            "materials": [{"pbrMetallicRoughness": {"baseColorFactor": [1, 0.5, 0, 1], "metallicFactor": 0},
                           "emissiveFactor": [1, 1, 1], "alphaMode": "MASK", "doubleSided": True,
                           "extensions": {"KHR_materials_clearcoat": {"clearcoatFactor": 1},
                                          "KHR_materials_transmission": {"transmissionFactor": 0.5}}}],
            "buffers": [buffer],
            "bufferViews": [{"buffer": 0, "byteLength": 36}, {"buffer": 0, "byteOffset": 36, "byteLength": 6}],
            "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3",
                           "min": [0, 0, 0], "max": [1, 1, 0]},
                          {"bufferView": 1, "componentType": 5123, "count": 3, "type": "SCALAR"}]}
    uri = "data:application/octet-stream;base64," + base64.b64encode(corners).decode()
    yield "text", json.dumps(scene(uri)).encode()
    text = json.dumps(scene(None)).encode()
    text += b" " * (-len(text) % 4)
    chunks = struct.pack("<I4s", len(text), b"JSON") + text + struct.pack("<I4s", len(corners), b"BIN\0") + corners
    yield "binary", struct.pack("<4sII", b"glTF", 2, 12 + len(chunks)) + chunks


def files_of(endings):
    for folder, folders, names in os.walk(os.path.join(ROOT, "scenes")):
        folders.sort()
        for name in sorted(names):
            path = os.path.join(folder, name)
            if name.endswith(endings) and os.path.getsize(path) < MOST_BYTES:
                with open(path, "rb") as file:
                    yield name, file.read()


def words_of(target):
    """What the format's files are made of, for the fuzzer's dictionary."""
    if target == "pbrt":
        return sorted({word.strip('"[]') for word in (PBRT + MORE_PBRT).split() if word.strip('"[]').isalnum()})
    if target == "obj":
        return sorted({line.split()[0] for line in (OBJ + MTL).split("\n") if line.strip()})
    if target == "ply":
        return ["property", "element", "vertex", "face", "list", "uchar", "int", "float", "double", "format", "ascii",
                "binary_big_endian", "end_header", "vertex_indices", "tristrips"]
    if target == "gltf":
        text = next(gltfs())[1].decode()
        return sorted({word for word in text.split('"') if word.isidentifier()} | {"KHR_texture_transform", "sparse"})
    return []


def seeds(target):
    """(name, bytes) of each seed."""
    if target == "pbrt":
        yield "all", PBRT.encode()
        yield "more", MORE_PBRT.encode()
        yield from files_of(".pbrt")
    elif target == "ply":
        yield from plys()
    elif target == "obj":
        yield "all", (OBJ + "\0" + MTL).encode()
        yield "wide", b"\xff\xfe" + OBJ.encode("utf-16-le")
        yield "plain", b"v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"
    elif target == "gltf":
        yield from gltfs()
    elif target == "image":
        for name, index, data in images():
            yield name, bytes([index]) + data
            yield name + "-number", bytes([(140 // 7) * 7 + index]) + data
        for name, data in files_of(".png"):
            yield name, b"\0" + data


def make(target, folder):
    os.makedirs(folder, exist_ok=True)
    for name, data in seeds(target):
        with open(os.path.join(folder, name), "wb") as file:
            file.write(data)
    words = words_of(target)
    if words:
        with open(folder.rstrip("/") + ".dict", "w", encoding="utf-8") as file:
            file.writelines(f'"{word}"\n' for word in words)


if __name__ == "__main__":
    make(sys.argv[1], sys.argv[2])
