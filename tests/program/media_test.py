"""Media that absorb: Beer's law through glass, borders and around the camera, whatever the way of rendering."""
import base64
import json
import math
import struct

import program
from program import diffuse, emitting, fresnel, material, orthographic, quad, scene, sky, sphere

SIGMA = (0.5, 2.0, 0.0)
MEDIUM = (f'MakeNamedMedium "green" "string type" "homogeneous" "rgb sigma_a" [ {" ".join(map(str, SIGMA))} ] '
          '"rgb sigma_s" [ 0 0 0 ]\n')
BORDER = material("interface")


def wall(z, half=50):
    """A square that faces -z, towards the camera at z < 0."""
    return quad((-half, -half, z), (-half, half, z), (half, half, z), (half, -half, z))


def slab(thickness, before):
    """Two walls with the medium in between; small ones, as rays start off large triangles farther."""
    return ("AttributeBegin\n" + 'MediumInterface "green" ""\n' + before + wall(-thickness / 2, 4)
            + "ReverseOrientation\n" + wall(thickness / 2, 4) + "AttributeEnd\n")


def gltf_slabs(scales, thickness, volume):
    """A file of slabs of one mesh, 40 apart, a camera before and a lamp of radiance 2 behind each."""
    corners = [(x, y, z) for z in (-thickness / 2, thickness / 2) for x, y in ((-4, -4), (4, -4), (4, 4), (-4, 4))]
    faces = [4, 5, 6, 4, 6, 7, 0, 2, 1, 0, 3, 2]
    data = struct.pack("<24f", *(value for corner in corners for value in corner)) + struct.pack("<12H", *faces)
    glass = {"pbrMetallicRoughness": {"metallicFactor": 0, "roughnessFactor": 0}, "extensions": {
        "KHR_materials_ior": {"ior": 1}, "KHR_materials_transmission": {"transmissionFactor": 1},
        "KHR_materials_volume": volume}}
    lamp = {"emissiveFactor": [1, 1, 1], "pbrMetallicRoughness": {"baseColorFactor": [0, 0, 0, 1]}, "extensions": {
        "KHR_materials_emissive_strength": {"emissiveStrength": 2}}}
    nodes = []
    for i, scale in enumerate(scales):
        x = 40 * i
        nodes += [{"mesh": 0, "scale": [scale] * 3, "translation": [x, 0, 0]},
                  {"mesh": 1, "translation": [x, 0, -5]}, {"camera": i, "translation": [x, 0, 5]}]
    lens = {"type": "orthographic", "orthographic": {"xmag": 0.1, "ymag": 0.1, "znear": 0.1, "zfar": 100}}
    attributes = {"POSITION": 0}
    return json.dumps({
        "asset": {"version": "2.0"}, "nodes": nodes, "cameras": [lens] * len(scales), "materials": [glass, lamp],
        "meshes": [{"primitives": [{"attributes": attributes, "indices": 1, "material": m}]} for m in range(2)],
        "buffers": [{"byteLength": len(data), "uri": "data:application/octet-stream;base64,"
                     + base64.b64encode(data).decode()}],
        "bufferViews": [{"buffer": 0, "byteLength": 96}, {"buffer": 0, "byteOffset": 96, "byteLength": 24}],
        "accessors": [{"bufferView": 0, "componentType": 5126, "count": 8, "type": "VEC3"},
                      {"bufferView": 1, "componentType": 5123, "count": 12, "type": "SCALAR"}]})


def left(distance):
    return [math.exp(-sigma * distance) for sigma in SIGMA]


class Media(program.ProgramTest):
    def all_near(self, picture, expected, relative, what):
        for pixel in picture.pixels:
            for value, wanted in zip(pixel, expected):
                self.assert_near(value, wanted, relative * wanted, what)

    def test_light_goes_straight_through_a_slab_by_its_thickness(self):
        light = MEDIUM + emitting(wall(5), 1, 1, 1)
        for name, before in (("border", BORDER), ("glass of index 1", material("dielectric", '"float eta" [ 1 ]'))):
            for angle in (0, 60):
                with self.subTest(name, angle=angle):
                    world = light + f"Rotate {angle} 0 1 0\n" + slab(0.8, before)
                    picture = self.picture(scene(world, camera=orthographic(0.1)))
                    self.all_near(picture, left(0.8 / math.cos(math.radians(angle))), 1e-4, name)

    def test_glass_loses_at_every_crossing(self):
        # T^2 A (1 + R^2 A^2 + ...), with T = 1 - R.
        share = fresnel(1, 1.5)
        world = MEDIUM + emitting(wall(400, 30), 1, 1, 1) + slab(0.6, material("dielectric"))
        picture = self.picture(scene(world, look="0 0 -300  0 0 0  0 1 0", camera=orthographic(0.01),
                                     spp=1024, depth=100))
        for channel, a in enumerate(left(0.6)):
            expected = (1 - share) ** 2 * a / (1 - (share * a) ** 2)
            deviation = math.sqrt(0.25 / (32 * 32 * 1024))
            self.assert_near(picture.mean(channel), expected, 4 * deviation, "glass")

    def test_the_camera_may_stand_in_a_medium(self):
        text = scene(emitting(wall(0), 1, 1, 1), camera=orthographic(0.1))
        text = MEDIUM + text.replace("Camera", 'MediumInterface "" "green"\nCamera')
        self.all_near(self.picture(text), left(5), 1e-4, "camera")

    def test_what_a_medium_swallows_whole_is_the_sky(self):
        text = scene(sky(1, 1, 1), camera=orthographic(0.1))
        text = MEDIUM + text.replace("Camera", 'MediumInterface "" "green"\nCamera')
        self.assertEqual(set(self.picture(text).pixels), {(0.0, 0.0, 1.0)})

    def test_shadow_rays_lose_on_both_sides_of_a_border(self):
        # A lamp above a border above a floor: the medium fills the space between the last two.
        world = MEDIUM + 'LightSource "point" "point3 from" [ 0 0 -4 ] "rgb I" [ 1 1 1 ]\n' + diffuse(1, 1, 1) \
            + wall(0, 4) + slab(2, BORDER)
        picture = self.picture(scene(world, camera=orthographic(0.001), depth=1))
        self.all_near(picture, [a * a / 16 / math.pi for a in left(1)], 1e-4, "floor under a medium")

    def test_a_surface_within_a_medium_keeps_it(self):
        # The floor has no media of its own; its light goes back through what it came from.
        world = MEDIUM + 'LightSource "point" "point3 from" [ 0 0 -0.5 ] "rgb I" [ 1 1 1 ]\n' + diffuse(1, 1, 1) \
            + wall(0) + 'MediumInterface "green" ""\n' + BORDER + sphere(0, 0, 0, 1)
        picture = self.picture(scene(world, camera=orthographic(0.001), depth=1))
        self.all_near(picture, [a / 0.25 / math.pi for a in left(1.5)], 1e-4, "floor within")

    def test_borders_that_media_do_not_divide_are_not_there(self):
        world = MEDIUM + emitting(wall(5), 1, 1, 1) + BORDER + sphere(0, 0, 0, 1) \
            + 'MediumInterface "green" "green"\n' + sphere(0, 0, 0, 2)
        self.assertEqual(set(self.picture(scene(world, camera=orthographic(0.1))).pixels), {(1.0, 1.0, 1.0)})

    def test_every_way_of_rendering_gives_the_same_bits(self):
        world = MEDIUM + sky(0.3, 0.4, 0.5) + emitting(sphere(-2, 3, -2, 0.5), 9, 9, 9) + diffuse(0.7, 0.7, 0.7) \
            + wall(3) + 'MediumInterface "green" ""\n' + BORDER + sphere(-1, 0, 0, 0.8) + material("dielectric") \
            + sphere(1, 0, 0, 0.8) + diffuse(0.5, 0.2, 0.1) + 'MediumInterface "" ""\n' + sphere(-1, 0, 0, 0.3)
        text = scene(world, spp=8, size=(48, 48))
        expected = program.Picture(self.render(text)).pixels
        for options in (("--window", 1), ("--window", 8), ("--wave", 64), ("--nthreads", 1),
                        ("--traversal", "single"), ("--traversal", "packet"), ("--engine", "megakernel")):
            with self.subTest(options):
                self.assertEqual(program.Picture(self.render(text, *options)).pixels, expected)

    def test_volumes_of_gltf_lose_by_the_way_through_them_in_the_world(self):
        # Slabs of glass of index 1, 0.8 thick in the mesh, whose thickness factor says something else; the
        # second of them twice as large.
        density = {"attenuationColor": left(2), "attenuationDistance": 2, "thicknessFactor": 5}
        for nodes, scales in (((1,), (1,)), ((2,), (2,)), ((1, 2), (1, 2))):
            path = self.write("slabs.gltf", gltf_slabs(nodes, 0.8, density))
            for camera, scale in enumerate(scales):
                with self.subTest(nodes=nodes, scale=scale):
                    picture = self.picture(path, "--camera", camera, "--resolution", "16x16", "--spp", 16)
                    self.all_near(picture, [2 * a for a in left(0.8 * scale)], 1e-4, "slab")


if __name__ == "__main__":
    program.main()
