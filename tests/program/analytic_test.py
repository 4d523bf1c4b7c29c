"""Pictures with a known answer: what a formula says, the program shows, through the whole pipeline."""
import math

import program
from program import (diffuse, emitting, fresnel, material, orthographic, quad, scene, sky, sphere, statistics)

DOWN = "0 3 0  0 0 0  0 0 1"  # a camera above the origin that looks down


def wall(z, half=50):
    """A square that faces -z, towards the camera at z < 0."""
    return quad((-half, -half, z), (-half, half, z), (half, half, z), (half, -half, z))


def floor(half=50):
    return quad((-half, 0, -half), (-half, 0, half), (half, 0, half), (half, 0, -half))


def rectangle_irradiance(corners):
    """Irradiance at the origin, normal +y, of a polygon of radiance 1 (Lambert's formula, 1760)."""
    total = 0
    for a, b in zip(corners, corners[1:] + corners[:1]):
        cross = [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
        sine, cosine = math.hypot(*cross), sum(p * q for p, q in zip(a, b))
        total += math.atan2(sine, cosine) * cross[1] / sine
    return abs(total) / 2


class Analytic(program.ProgramTest):
    def all_near(self, picture, expected, relative, what):
        for pixel in picture.pixels:
            for value, wanted in zip(pixel, expected):
                self.assert_near(value, wanted, relative * wanted, what)

    # ------------------------------------------------------------ emission and background
    def test_emission_is_exact(self):
        picture = self.picture(scene(emitting(wall(0), 3, 2, 1)))
        self.assertEqual(set(picture.pixels), {(3.0, 2.0, 1.0)})

    def test_emission_has_one_side_unless_told(self):
        for reverse in ("", "ReverseOrientation\n"):
            picture = self.picture(scene(reverse + emitting(wall(0), 3, 2, 1)))
            self.assertEqual(set(picture.pixels), {(0.0, 0.0, 0.0)} if reverse else {(3.0, 2.0, 1.0)})
            picture = self.picture(scene(reverse + emitting(wall(0), 3, 2, 1, two_sided=True)))
            self.assertEqual(set(picture.pixels), {(3.0, 2.0, 1.0)})

    def test_sky_is_exact_and_several_skies_add(self):
        picture = self.picture(scene(sky(0.5, 0.25, 2) + sky(0.25, 0, 1)))
        self.assertEqual(set(picture.pixels), {(0.75, 0.25, 3.0)})

    def test_depth_0_shows_emission_and_sky_alone(self):
        world = sky(0.5, 0.5, 0.5) + emitting(sphere(0, 0, 0, 0.5), 4, 4, 4) + diffuse(0.9, 0.9, 0.9) \
            + sphere(1.2, 0, 0, 0.5)
        picture = self.picture(scene(world, camera=orthographic(2), size=(64, 64)), "--maxdepth", "0")
        self.assertEqual(picture.at(32, 32), (4.0, 4.0, 4.0))
        self.assertEqual(picture.at(51, 32), (0.0, 0.0, 0.0))
        self.assertEqual(picture.at(1, 1), (0.5, 0.5, 0.5))

    def test_a_surface_may_emit_and_scatter(self):
        world = sky(1, 1, 1) + 'AreaLightSource "diffuse" "rgb L" [ 2 3 4 ]\n' + diffuse(0.5, 0.25, 0.1) + wall(0)
        picture = self.picture(scene(world, spp=256))
        for channel, expected in enumerate((2.5, 3.25, 4.1)):
            mean, error = statistics(picture.values(channel))
            self.assert_near(mean, expected, 4 * error + 1e-6, f"channel {channel}")

    # ------------------------------------------------------------ camera
    def test_picture_has_y_up_and_x_to_the_right(self):
        world = emitting(sphere(1, 0.6, 0, 0.3), 1, 0, 0) + emitting(sphere(-1, -0.6, 0, 0.3), 0, 1, 0)
        picture = self.picture(scene(world, camera=orthographic(2), size=(40, 40)))
        self.assertEqual(picture.at(30, 14), (1.0, 0.0, 0.0))
        self.assertEqual(picture.at(10, 26), (0.0, 1.0, 0.0))
        self.assertEqual(picture.at(10, 14), (0.0, 0.0, 0.0))

    def test_field_of_view_spans_the_shorter_side(self):
        # A sphere of radius r at distance d covers a disk of tan(asin(r / d)) on the plane z = 1.
        for size in ((60, 40), (40, 60)):
            picture = self.picture(scene(emitting(sphere(0, 0, 0, 1), 1, 1, 1), size=size, spp=256))
            radius = math.tan(math.asin(1 / 5)) / math.tan(math.radians(20)) * 20  # pixels
            self.assert_near(picture.mean() * size[0] * size[1], math.pi * radius ** 2, 1.5, f"{size}")

    # ------------------------------------------------------------ mirrors
    def test_mirror_shows_what_lies_in_the_mirror_direction_times_its_tint(self):
        world = emitting(quad((-9, 9, -9), (9, 9, -9), (9, 9, 9), (-9, 9, 9)), 4, 8, 2) \
            + material("mirror", '"rgb reflectance" [ 0.5 0.25 0.75 ]') + "Rotate 45 1 0 0\n" + wall(0, 1.2)
        picture = self.picture(scene(world, camera=orthographic(0.5)))
        self.assertEqual(set(picture.pixels), {(2.0, 2.0, 1.5)})

    def test_mirrors_face_to_face_multiply_their_tints(self):
        # At 45 degrees between y = 0 and 2: mirrored at z = 1, 3, 5 and 7, then out.
        world = sky(1, 1, 1) + material("mirror", '"rgb reflectance" [ 0.5 0.5 0.5 ]') \
            + quad((-9, 0, 0), (-9, 0, 6), (9, 0, 6), (9, 0, 0)) \
            + quad((-9, 2, 0), (-9, 2, 8), (9, 2, 8), (9, 2, 0))
        picture = self.picture(scene(world, look="0 1 0  0 0 1  0 1 0", camera='"perspective" "float fov" [ 1 ]',
                                     size=(8, 8)))
        self.assertEqual(set(picture.pixels), {(0.0625,) * 3})

    def test_conductor_reflects_the_fresnel_share_at_normal_incidence(self):
        # ((n - 1)^2 + k^2) / ((n + 1)^2 + k^2), by channel.
        eta, k = (0.2, 0.9, 1.4), (3.9, 2.4, 1.6)
        parameters = f'"rgb eta" [ {" ".join(map(str, eta))} ] "rgb k" [ {" ".join(map(str, k))} ]'
        picture = self.picture(scene(sky(1, 1, 1) + material("conductor", parameters) + wall(0),
                                     camera=orthographic(1)))
        expected = [((n - 1) ** 2 + a * a) / ((n + 1) ** 2 + a * a) for n, a in zip(eta, k)]
        self.all_near(picture, expected, 1e-5, "conductor")

    # ------------------------------------------------------------ glass
    def slab(self, angle, eta):
        """A slab seen at an angle from its normal: light behind it, none in front."""
        glass = f"AttributeBegin\nRotate {angle} 0 1 0\n" + material("dielectric", f'"float eta" [ {eta} ]') \
            + wall(-0.1, 200) + "ReverseOrientation\n" + wall(0.1, 200) + "AttributeEnd\n"
        return scene(emitting(wall(400, 30), 1, 1, 1) + glass, look="0 0 -300  0 0 0  0 1 0",
                     camera=orthographic(0.01), size=(32, 32), spp=1024, depth=100)

    def test_slab_transmits_the_series_of_its_internal_reflections(self):
        # T^2 (1 + R^2 + R^4 + ...) = (1 - R) / (1 + R), R by Fresnel's equations.
        for angle, eta in ((0, 1.5), (50, 1.5), (70, 1.5), (30, 2.417)):
            with self.subTest(angle=angle, eta=eta):
                share = fresnel(math.cos(math.radians(angle)), eta)
                expected = (1 - share) / (1 + share)
                picture = self.picture(self.slab(angle, eta))
                # All or nothing for each path: the binomial deviation bounds the noise.
                deviation = math.sqrt(expected * (1 - expected) / (32 * 32 * 1024))
                self.assert_near(picture.mean(), expected, 4 * deviation + 1e-5, "transmitted")

    def test_schlick_reflects_its_own_share(self):
        # R0 + (1 - R0)(1 - cos)^5 of the one surface of a half space that swallows the rest.
        for angle in (0, 60, 80):
            with self.subTest(angle=angle):
                cosine = math.cos(math.radians(angle))
                expected = 0.04 + 0.96 * (1 - cosine) ** 5
                world = sky(1, 1, 1) + f"Rotate {angle} 0 1 0\n" + material(
                    "dielectric", '"float eta" [ 1.5 ] "string fresnel" "schlick"') + wall(0, 500) \
                    + diffuse(0, 0, 0) + wall(1, 5000)
                picture = self.picture(scene(world, camera=orthographic(0.01), spp=1024, size=(32, 32)))
                deviation = math.sqrt(expected * (1 - expected) / (32 * 32 * 1024))
                self.assert_near(picture.mean(), expected, 4 * deviation + 1e-5, "reflected")

    def test_snells_window_has_its_radius_and_radiance(self):
        # Looking up from water into a sky of 1: eta^2 T inside of the critical angle, 0 beyond,
        # where the surface mirrors the black bottom.
        eta, fov, size = 1.333, 120, 121
        world = sky(1, 1, 1) + material("dielectric", '"string eta" "water"') + floor(5000) \
            + "Translate 0 -10 0\n" + diffuse(0, 0, 0) + floor(5000)
        picture = self.picture(scene(world, look="0 -3 0  0 0 0  0 0 1", camera=f'"perspective" "float fov" [ {fov} ]',
                                     size=(size, size), spp=256))
        pixel = math.tan(math.radians(fov / 2)) / (size / 2)  # of a pixel, on the plane z = 1
        edge = math.tan(math.asin(1 / eta))
        checked = [0, 0]
        for y in range(size):
            for x in range(size):
                r = math.hypot(x + 0.5 - size / 2, y + 0.5 - size / 2) * pixel
                value = picture.at(x, y)[1]
                if r > edge + pixel:
                    self.assertEqual(value, 0, f"pixel {x} {y} lies outside of the window")
                    checked[0] += 1
                elif r < edge - 4 * pixel:
                    through = 1 - fresnel(1 / math.sqrt(1 + r * r), 1 / eta)
                    deviation = eta ** 2 * math.sqrt(through * (1 - through) / 256)
                    self.assert_near(value, eta ** 2 * through, 5 * deviation + 0.01, f"pixel {x} {y}")
                    checked[1] += 1
        self.assertGreater(min(checked), 2000)
        area = sum(1 for p in picture.pixels if p[1] > 0.1) * pixel ** 2
        self.assert_near(math.sqrt(area / math.pi), edge, 0.5 * pixel, "radius of the window")

    def test_hollow_sphere_with_walls_of_no_thickness_to_speak_of_does_not_bend(self):
        # Before a half-white wall the border stays straight behind the bubble's centre.
        half = quad((0, -50, 9), (0, 50, 9), (50, 50, 9), (50, -50, 9))
        world = emitting(half, 1, 1, 1) + material("dielectric") + sphere(0, 0, 0, 1) \
            + material("dielectric", '"float eta" [ 0.666666667 ]') + sphere(0, 0, 0, 0.9999)
        picture = self.picture(scene(world, camera=orthographic(0.5), spp=256, depth=64))
        left = statistics([picture.at(x, y)[0] for y in range(32) for x in range(0, 15)])[0]
        right = statistics([picture.at(x, y)[0] for y in range(32) for x in range(17, 32)])[0]
        self.assertLess(left, 0.12)
        self.assertGreater(right, 0.75)

    # ------------------------------------------------------------ direct light
    def patch(self, world, **options):
        """A spot of the diffuse plane y = 0 at the origin, from above."""
        options.setdefault("size", (8, 8))
        return self.picture(scene(diffuse(0.6, 0.5, 0.4) + floor() + world, look=DOWN, camera=orthographic(1e-3),
                                  depth=1, **options))

    def test_point_light_falls_off_with_the_squared_distance(self):
        picture = self.patch('LightSource "point" "rgb I" [ 5 6 7 ] "point3 from" [ 3 4 0 ]\n')
        for_unit = (4 / 5) / 25 / math.pi
        self.all_near(picture, (5 * 0.6 * for_unit, 6 * 0.5 * for_unit, 7 * 0.4 * for_unit), 2e-3, "point light")

    def test_distant_light_falls_off_with_the_cosine(self):
        picture = self.patch('LightSource "distant" "rgb L" [ 5 6 7 ] "point3 from" [ 3 4 0 ] "point3 to" [ 0 0 0 ]\n')
        for_unit = (4 / 5) / math.pi
        self.all_near(picture, (5 * 0.6 * for_unit, 6 * 0.5 * for_unit, 7 * 0.4 * for_unit), 1e-5, "distant light")

    def test_rectangle_lights_a_plane_by_its_form_factor(self):
        for low, high, height in (((-1, -1), (1, 1), 2), ((1, -0.5), (3, 2), 1.5), ((-4, -4), (4, 4), 0.5)):
            with self.subTest(low=low, high=high, height=height):
                (x0, z0), (x1, z1) = low, high
                corners = [(x0, height, z0), (x1, height, z0), (x1, height, z1), (x0, height, z1)]
                # The camera stands below the light so as not to look at its back.
                picture = self.picture(scene(
                    diffuse(0.6, 0.5, 0.4) + floor() + emitting(quad(*corners), 10, 10, 10),
                    look="0 0.3 -0.3  0 0 0  0 1 0", camera=orthographic(1e-4), size=(16, 16), spp=1024, depth=1))
                irradiance = 10 * rectangle_irradiance(corners)
                for channel, albedo in enumerate((0.6, 0.5, 0.4)):
                    mean, error = statistics(picture.values(channel))
                    self.assertLess(error, 0.01 * mean, "the test is sharp")
                    self.assert_near(mean, albedo / math.pi * irradiance, 4 * error + 1e-3 * mean, "rectangle")

    def test_lights_do_not_block_their_own_light(self):
        # Where coordinates are 0, a point on the light has no rounding of its own; the ray that looks
        # for it has.
        def lit(light, height):
            world = f"Translate 0 {height} 0\n" + light + "Translate 0 -3 0\n" + diffuse(1, 1, 1) + floor()
            return self.picture(scene(world, look=f"0 {height - 2.5} 0  0 {height - 3} 0  0 0 1",
                                      camera=orthographic(1e-3), size=(16, 16), spp=256, depth=1))

        corners = [(-1, 0, -1), (1, 0, -1), (1, 0, 1), (-1, 0, 1)]
        panel = emitting(quad(*corners), 5, 5, 5)
        of_panel = 5 / math.pi * rectangle_irradiance([(x, 3, z) for x, _, z in corners])
        ball = emitting(sphere(0, 0, 0, 0.01), 5e4, 5e4, 5e4)
        of_ball = 5e4 * (0.01 / 3) ** 2
        for light, expected in ((panel, of_panel), (ball, of_ball)):
            for height in (0, 5):
                mean, error = statistics(lit(light, height).values(0))
                self.assertLess(error, 0.01 * mean, "the test is sharp")
                self.assert_near(mean, expected, 4 * error + 1e-3 * mean, f"light at height {height}")

    def test_sphere_light_lights_a_plane_as_its_solid_angle(self):
        # A whole visible sphere: E = pi L (r / d)^2 cos, also under a similar transform.
        for before in ("", "Rotate 50 1 2 3\nScale -0.5 0.5 0.5\n"):
            radius = 0.5 if before == "" else 1
            light = emitting(sphere(3, 4, 0, radius, before), 10, 10, 10)
            picture = self.patch(light, size=(16, 16), spp=256)
            mean, error = statistics(picture.values(0))
            self.assert_near(mean, 0.6 * 10 * (0.5 / 5) ** 2 * 4 / 5, 4 * error + 1e-3 * mean, "sphere light")

    def test_many_lights_add(self):
        lights = ""
        expected = 0
        for i in range(40):
            x, z, power = 2 * math.cos(i), 2 * math.sin(i), 1 + i % 7
            lights += f'LightSource "point" "rgb I" [ {power} {power} {power} ] "point3 from" [ {x:.9g} 1 {z:.9g} ]\n'
            expected += 0.6 / math.pi * power / 5 / math.sqrt(5)
        picture = self.patch(lights, size=(16, 16), spp=1024)
        mean, error = statistics(picture.values(0))
        self.assert_near(mean, expected, 4 * error + 1e-3 * expected, "sum of the lights")


if __name__ == "__main__":
    program.main()
