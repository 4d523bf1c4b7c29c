"""Textures with a known answer: colours, holes, bumps and emission, through the whole pipeline."""
import math
import struct

import program
from program import diffuse, material, orthographic, quad, scene, sky, sphere, statistics

WALL = quad((-50, -50, 0), (-50, 50, 0), (50, 50, 0), (50, -50, 0))
# u runs along x, v along y, from 0 to 1 over the picture of orthographic(1).
MAPPED = ('Shape "trianglemesh" "point3 P" [ -1 -1 0 -1 1 0 1 1 0 1 -1 0 ] "integer indices" [ 0 1 2 0 2 3 ] '
          '"point2 uv" [ 0 0 0 1 1 1 1 0 ]\n')


class Textures(program.ProgramTest):
    def pfm(self, name, width, height, pixel):
        """An image whose pixel (x, y), y from the top, is pixel(x, y)."""
        values = [v for y in reversed(range(height)) for x in range(width) for v in pixel(x, y)]
        self.write(name, f"PF\n{width} {height}\n-1.0\n".encode() + struct.pack(f"<{len(values)}f", *values))

    def look(self, world, size=(16, 16), spp=64, depth=1):
        return self.picture(scene(world, camera=orthographic(1), size=size, spp=spp, depth=depth))

    def assert_pixel(self, picture, x, y, expected, what, tolerance=2e-3):
        for value, wanted in zip(picture.at(x, y), expected):
            self.assert_near(value, wanted, tolerance, f"{what} at {x} {y}")

    def test_an_image_on_a_wall_is_the_picture(self):
        self.pfm("image.pfm", 4, 2, lambda x, y: (0.1 + 0.2 * x, 0.3 + 0.4 * y, 0.5))
        picture = self.look(sky(1, 1, 1) + 'Texture "t" "spectrum" "imagemap" "string filename" "image.pfm" '
                            '"string filter" "point"\n' + material("diffuse", '"texture reflectance" "t"') + MAPPED)
        # The wall scatters an even sky by its albedo; the camera looks along +z with x to the right.
        for x in range(4):
            for y in range(2):
                self.assert_pixel(picture, 4 * x + 2, 8 * y + 4, (0.1 + 0.2 * x, 0.3 + 0.4 * y, 0.5), "image", 6e-3)

    def test_an_area_light_shows_its_image_and_lights_by_it(self):
        self.pfm("image.pfm", 2, 2, lambda x, y: (1 + x, 2 + y, 3))
        light = 'AttributeBegin\nAreaLightSource "diffuse" "string filename" "image.pfm" "float scale" 2\n'
        picture = self.look(light + diffuse(0, 0, 0) + MAPPED + "AttributeEnd\n", spp=4)
        for x, y in ((0, 0), (15, 0), (0, 15), (15, 15)):  # beyond the outer pixels' centres
            self.assert_pixel(picture, x, y, (2 * (1 + x // 8), 2 * (2 + y // 8), 6), "emission")
        # A patch far behind receives what an even light of the mean radiance would send.
        receiver = "AttributeBegin\nTranslate 0 0 -30\n" + diffuse(1, 1, 1)
        receiver += quad((-1, -1, 0), (1, -1, 0), (1, 1, 0), (-1, 1, 0)) + "AttributeEnd\n"
        means = []
        for emission in ('"string filename" "image.pfm" "float scale" 1e4', '"rgb L" [ 1.5e4 2.5e4 3e4 ]'):
            world = f'AttributeBegin\nAreaLightSource "diffuse" {emission}\n' + diffuse(0, 0, 0) + MAPPED + "AttributeEnd\n"
            means.append(self.picture(scene(world + receiver, look="0 0 -10  0 0 -30  0 1 0", size=(8, 8), spp=1024,
                                            camera=orthographic(1), depth=1)))
        for channel in range(3):
            mean, error = statistics(means[0].values(channel))
            even, even_error = statistics(means[1].values(channel))
            self.assertGreater(even, 1)
            self.assert_near(mean, even, 4 * (error + even_error) + 2e-3 * even, f"channel {channel}")

    def test_a_sheet_of_opacity_a_shows_a_of_itself_and_the_rest_of_what_is_behind(self):
        for alpha in (0, 0.25, 1):
            sheet = 'AttributeBegin\nAreaLightSource "diffuse" "rgb L" [ 3 3 3 ]\n' + diffuse(0, 0, 0)
            sheet += WALL[:-1] + f' "float alpha" {alpha}\nAttributeEnd\n'
            values = self.look(sky(1, 1, 1) + sheet, size=(32, 32)).values()
            mean, error = statistics(values)
            self.assert_near(mean, 3 * alpha + (1 - alpha), 4 * error + 1e-6, f"alpha {alpha}")

    def test_layers_of_sheets_multiply_their_holes(self):
        sheets = "".join(f'AttributeBegin\nTranslate 0 0 {z}\n{WALL[:-1]} "float alpha" 0.5\nAttributeEnd\n' for z in range(4))
        mean, error = statistics(self.look(sky(1, 1, 1) + diffuse(0, 0, 0) + sheets, size=(64, 64)).values())
        self.assert_near(mean, 0.5 ** 4, 4 * error, "four sheets of opacity 0.5")

    def test_shadows_have_the_sheets_holes(self):
        # A distant light straight through sheets of opacity 0.3 and 0.5, from behind the camera.
        light = 'LightSource "distant" "point3 from" [ 0 0 -1 ] "point3 to" [ 0 0 0 ] "rgb L" [ 3.14159265 3.14159265 3.14159265 ]\n'
        sheets = "".join(f'AttributeBegin\nTranslate 0 0 {z}\n{WALL[:-1]} "float alpha" {a}\nAttributeEnd\n'
                         for z, a in ((-8, 0.3), (-9, 0.5)))
        picture = self.picture(scene(light + diffuse(0.8, 0.8, 0.8) + WALL + sheets, camera=orthographic(1),
                                     size=(32, 32), spp=256, depth=1))
        mean, error = statistics(picture.values())
        self.assert_near(mean, 0.8 * 0.7 * 0.5, 4 * error, "light through two sheets")

    def test_a_checkerboard_of_alpha_is_a_sieve(self):
        texture = 'Texture "holes" "float" "checkerboard" "float uscale" 4 "float vscale" 4\n'
        light = 'AttributeBegin\nAreaLightSource "diffuse" "rgb L" [ 3 3 3 ]\n' + diffuse(0, 0, 0)
        picture = self.look(texture + light + MAPPED[:-1] + ' "texture alpha" "holes"\nAttributeEnd\n', spp=16)
        # Away from the edges of squares, which the footprint of a pixel softens.
        for y in (1, 2, 5, 6, 9, 10, 13, 14):
            for x in (1, 2, 5, 6, 9, 10, 13, 14):
                inside = (x // 4 + (15 - y) // 4) % 2 == 0
                self.assertEqual(picture.at(x, y)[0], 3 if inside else 0, f"{x} {y}")

    def test_a_normal_map_turns_the_light(self):
        light = 'LightSource "distant" "point3 from" [ 0 0 -1 ] "point3 to" [ 0 0 0 ] "rgb L" [ 3.14159265 3.14159265 3.14159265 ]\n'
        for normal, expected in (((0.5, 0.5, 1), 1), ((0.8, 0.5, 0.9), 0.8), ((0.5, 0.8, 0.9), 0.8)):
            self.pfm("normal.pfm", 1, 1, lambda x, y: normal)
            picture = self.look(light + material("diffuse", '"rgb reflectance" [ 0.5 0.5 0.5 ] "string normalmap" "normal.pfm"')
                                + MAPPED, size=(4, 4), spp=4)
            self.assert_pixel(picture, 1, 2, (0.5 * expected,) * 3, f"normal {normal}", 1e-5)

    def test_a_bump_turns_the_light(self):
        light = 'LightSource "distant" "point3 from" [ 0 0 -1 ] "point3 to" [ 0 0 0 ] "rgb L" [ 3.14159265 3.14159265 3.14159265 ]\n'
        ramp = 'Texture "ramp" "float" "bilerp" "float v00" 0 "float v01" 0 "float v10" 1.5 "float v11" 1.5\n'
        picture = self.look(light + ramp + material("diffuse", '"rgb reflectance" [ 1 1 1 ] "texture displacement" "ramp"')
                            + MAPPED, size=(4, 4), spp=4)
        self.assert_pixel(picture, 1, 2, (0.8,) * 3, "slope 3 / 4", 1e-3)

    def test_an_instance_has_the_textures_of_its_object(self):
        textures = ('Texture "c" "spectrum" "checkerboard" "float uscale" 6 "float vscale" 4 "rgb tex1" [ 0.9 0.2 0.1 ]\n'
                    'Texture "holes" "float" "dots" "float uscale" 9 "float vscale" 5\n'
                    + material("diffuse", '"texture reflectance" "c"'))
        shapes = MAPPED + 'Shape "sphere" "float radius" 0.7 "texture alpha" "holes"\n'
        place = "Translate 0.1 0.2 0.3\nRotate 30 1 1 0\nScale 0.7 0.6 0.8\n"
        plain = self.look(sky(1, 1, 1) + textures + "AttributeBegin\n" + place + shapes + "AttributeEnd\n", size=(32, 32))
        instanced = self.look(sky(1, 1, 1) + textures + 'ObjectBegin "o"\n' + shapes + "ObjectEnd\nAttributeBegin\n" + place
                              + 'ObjectInstance "o"\nAttributeEnd\n', size=(32, 32))
        for channel in range(3):
            differences = [a[channel] - b[channel] for a, b in zip(plain.pixels, instanced.pixels)]
            mean, error = statistics(differences)
            self.assert_near(mean, 0, 4 * error + 1e-4, f"channel {channel}")
            self.assertLess(sum(abs(d) > 0.25 for d in differences), 10, f"channel {channel}")

    def test_textured_roughness_is_that_roughness(self):
        light = sky(0.2, 0.2, 0.2) + 'LightSource "infinite" "rgb L" [ 0.1 0.1 0.1 ]\n'
        ball = sphere(0, 0, 0, 1)
        texture = 'Texture "even" "float" "bilerp" "float v00" 0.3 "float v01" 0.3 "float v10" 0.3 "float v11" 0.3\n'
        point = 'LightSource "point" "point3 from" [ 3 3 -5 ] "rgb I" [ 40 40 40 ]\n'
        pictures = [self.look(texture + light + point + material("conductor", f'"rgb reflectance" [ 0.9 0.9 0.9 ] {p} "float roughness" 0.3'
                                                        if not p else f'"rgb reflectance" [ 0.9 0.9 0.9 ] {p}') + ball, spp=16)
                    for p in ("", '"texture roughness" "even"')]
        for a, b in zip(pictures[0].pixels, pictures[1].pixels):
            for value, wanted in zip(a, b):
                self.assert_near(value, wanted, 1e-5 + 1e-4 * abs(wanted), "textured and constant roughness")

    def test_textured_roughness_along_u_and_v_lies_as_its_constants_do(self):
        light = sky(0.2, 0.2, 0.2) + 'LightSource "point" "point3 from" [ 3 3 -5 ] "rgb I" [ 40 40 40 ]\n'
        names = {"uroughness": 0.05, "vroughness": 0.5}
        textures = "".join(f'Texture "{name}" "float" "bilerp" ' + " ".join(f'"float v{corner}" {value}' for corner in
                                                                            ("00", "01", "10", "11")) + "\n"
                           for name, value in names.items())
        pictures = []
        for textured in ((), ("uroughness",), ("vroughness",), ("uroughness", "vroughness")):
            parameters = " ".join(f'"texture {name}" "{name}"' if name in textured else f'"float {name}" {value}'
                                  for name, value in names.items())
            surface = material("conductor", f'"rgb reflectance" [ 0.9 0.9 0.9 ] {parameters}')
            pictures.append(self.look(textures + light + surface + sphere(0, 0, 0, 1), spp=16))
        for picture in pictures[1:]:
            for a, b in zip(pictures[0].pixels, picture.pixels):
                for value, wanted in zip(a, b):
                    self.assert_near(value, wanted, 1e-5 + 1e-4 * abs(wanted), "textured and constant roughness")

    def test_a_mix_by_a_texture_is_each_material_where_the_texture_says(self):
        texture = ('Texture "squares" "float" "checkerboard" "float tex1" 0 "float tex2" 1 "float uscale" 2 '
                   '"float vscale" 2\nTexture "some" "float" "bilerp" "float v00" 0.25 "float v01" 0.25 '
                   '"float v10" 0.25 "float v11" 0.25\n')
        named = "".join(f'MakeNamedMaterial "{name}" "string type" "diffuse" "rgb reflectance" [ {color} ]\n'
                        for name, color in (("a", "0.8 0.4 0.2"), ("b", "0.2 0.6 0.6")))
        mix = 'Material "mix" "string materials" [ "a" "b" ] "texture amount" '
        picture = self.look(sky(1, 1, 1) + texture + named + mix + '"squares"\n' + MAPPED)
        for x, y in ((4, 4), (12, 4), (4, 12), (12, 12)):
            expected = (0.8, 0.4, 0.2) if (x > 8) == (y < 8) else (0.2, 0.6, 0.6)
            self.assert_pixel(picture, x, y, expected, "square", 6e-3)
        picture = self.look(sky(1, 1, 1) + texture + named + mix + '"some"\n' + MAPPED)
        for channel, expected in enumerate((0.65, 0.45, 0.3)):
            mean, error = statistics(picture.values(channel))
            self.assert_near(mean, expected, 4 * error + 1e-3, "a quarter of b")

    def lit_by(self, emitter, depth=1):
        """The mean radiance of a white patch that sees only this emitter, in front of it."""
        receiver = "AttributeBegin\nTranslate 0 0 -3\n" + diffuse(1, 1, 1)
        receiver += quad((-1, -1, 0), (1, -1, 0), (1, 1, 0), (-1, 1, 0)) + "AttributeEnd\n"
        world = emitter + receiver
        picture = self.picture(scene(world, look="0 0 -1  0 0 -3  0 1 0", size=(8, 8), spp=1024,
                                     camera=orthographic(1), depth=depth))
        return statistics(picture.values())

    def test_an_emitter_with_holes_lights_by_what_is_left_of_it(self):
        texture = ('Texture "squares" "float" "checkerboard" "float tex1" 0 "float tex2" 1 "float uscale" 8 '
                   '"float vscale" 8\n')
        for shape in (MAPPED, 'Shape "sphere" "float radius" 1\n'):
            def emitter(radiance, alpha=""):
                return (f'AttributeBegin\nAreaLightSource "diffuse" "rgb L" [ {radiance} {radiance} {radiance} ]\n'
                        + diffuse(0, 0, 0) + shape[:-1] + alpha + "\nAttributeEnd\n")

            half, half_error = self.lit_by(emitter(5))
            self.assertGreater(half, 0.1)
            for alpha in (' "float alpha" 0.5', ' "texture alpha" "squares"'):
                mean, error = self.lit_by(texture + emitter(10, alpha))
                self.assert_near(mean, half, 4 * (error + half_error) + 5e-3 * half, shape[:20] + alpha)

    def test_an_emitter_of_opacity_0_lights_and_is_not_seen(self):
        # As pbrt-v4 has it. No direction finds it, so light samples count in full.
        self.pfm("even.pfm", 2, 2, lambda x, y: (5, 5, 5))
        # Between parallel squares of side 2 at distance 3 (Howell, catalog of configuration factors, C-11).
        side = 2 / 3
        root = math.sqrt(1 + side * side)
        logarithm = math.log(root * root / math.sqrt(1 + 2 * side * side))
        arcs = 2 * side * (root * math.atan(side / root) - math.atan(side))
        expected = 5 * 2 / (math.pi * side * side) * (logarithm + arcs)
        for emission in ('"rgb L" [ 5 5 5 ]', '"string filename" "even.pfm"'):
            unseen = f'AttributeBegin\nAreaLightSource "diffuse" {emission}\n' + MAPPED[:-1] + ' "float alpha" 0\nAttributeEnd\n'
            mean, error = self.lit_by(unseen)
            self.assert_near(mean, expected, 4 * error, emission)
            self.assertEqual(set(self.look(unseen, spp=4).values()), {0.0})

    def test_half_an_emitter_lights_alike_by_light_samples_by_directions_and_by_both(self):
        # Half of the panel is cut away by its alpha mask, by the image's pixels and by a function.
        self.pfm("half.pfm", 8, 8, lambda x, y: 3 * (float(x < 4),))
        masks = ('Texture "half" "float" "imagemap" "string filename" "half.pfm" "string filter" "{}"\n')
        emission = 'AttributeBegin\nAreaLightSource "diffuse" "rgb L" [ 9 9 9 ]\n' + diffuse(0, 0, 0)
        half_panel = MAPPED.replace("-1 -1 0 -1 1 0 1 1 0 1 -1 0", "-1 -1 0 -1 1 0 0 1 0 0 -1 0")
        # Nothing samples lights behind a pane, and what passes it counts in full.
        pane = 'AttributeBegin\nTranslate 0 0 -2.5\n' + material("thindielectric", '"float eta" 1') + WALL + "AttributeEnd\n"
        for name in ("trilinear", "bilinear", "point"):
            masked = masks.format(name) + emission + MAPPED[:-1] + ' "texture alpha" "half"\nAttributeEnd\n'
            expected, expected_error = self.lit_by(emission + half_panel + "AttributeEnd\n")
            both, both_error = self.lit_by(masked)
            directions, directions_error = self.lit_by(masked + pane, depth=3)
            tolerance = 4 * expected_error + 5e-3 * expected  # filters blur the mask's edge and rim
            self.assert_near(both, expected, 4 * both_error + tolerance, f"{name}: both")
            self.assert_near(directions, expected, 4 * directions_error + tolerance, f"{name}: directions")


if __name__ == "__main__":
    program.main()
