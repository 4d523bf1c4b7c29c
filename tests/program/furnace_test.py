"""White furnace: a sphere that loses no light, in a constant sky of radiance 1, cannot be seen."""
import struct

import program
from program import diffuse, material, orthographic, scene, sky, sphere, statistics

# Lossless parameters of every material: name -> [(parameters, expected mean, absolute tolerance)].
# The mean is over the disk of the sphere; the tolerance is beside four standard errors.
LOSSLESS = {
    # f cos / pdf is 1 up to the rounding of a product.
    "diffuse": [('"rgb reflectance" [ 1 1 1 ]', 1, 1e-6)],
    "mirror": [('"rgb reflectance" [ 1 1 1 ]', 1, 1e-6)],
    "dielectric": [('"float eta" [ 1.5 ]', 1, 1e-5), ('"string eta" "diamond"', 1, 1e-5),
                   ('"float eta" [ 0.75 ]', 1, 1e-5), ('"string fresnel" "schlick"', 1, 1e-5)],
    # The index behind "reflectance" is kept finite: at normal incidence 0.9999 is the most.
    "conductor": [('"rgb reflectance" [ 1 1 1 ]', 1, 1.5e-4)],
    # A direction at cosine c plus a point on a sphere of radius f ends above the surface with
    # probability min(1, (c / f + 1) / 2); over the disk c^2 is uniform, so 1 - f^2 / 6 is kept.
    "fuzzymirror": [('"float fuzz" [ 0 ]', 1, 1e-6), ('"float fuzz" [ 0.3 ]', 1 - 0.3 ** 2 / 6, 1e-4),
                    ('"float fuzz" [ 1 ]', 1 - 1 / 6, 1e-4)],
    "thindielectric": [("", 1, 1e-5)],
    "diffusetransmission": [('"rgb reflectance" [ 0.5 0.5 0.5 ] "rgb transmittance" [ 0.5 0.5 0.5 ]', 1, 1e-5)],
    "principled": [('"rgb base_color" [ 1 1 1 ] "float metallic" [ 1 ] "float roughness" [ 0 ]', 1, 1e-5)],
    # Walks end at maxdepth: with as many as there may be, no more than the tolerance is lost. The
    # metal's index behind "reflectance" is kept finite, as above, and met at every return from the coat.
    "coateddiffuse": [('"rgb reflectance" [ 1 1 1 ] "float thickness" [ 0 ] "integer maxdepth" [ 1000 ]', 1, 2e-3)],
    "coatedconductor": [('"rgb reflectance" [ 1 1 1 ] "float thickness" [ 0 ] "integer maxdepth" [ 1000 ]', 1, 2e-3)],
}
NO_SURFACE_OF_THEIR_OWN = ["interface", "mix"]
SIZE, SPP = 48, 64


def furnace(kind, parameters, before=""):
    # The square inside of the disk would not weigh its rim; the disk's own mean is formed below.
    return scene(sky(1, 1, 1) + material(kind, parameters) + sphere(0, 0, 0, 1, before), size=(SIZE, SIZE), spp=SPP,
                 camera=orthographic(1), depth=200)


class Furnace(program.ProgramTest):
    def check(self, text, expected, tolerance, what):
        picture = self.picture(text)
        # The sky around the disk is 1 exactly: what the frame lacks, the disk lacks.
        disk = 3.14159265358979 / 4
        for channel in range(3):
            mean, error = statistics(picture.values(channel))
            wanted = 1 - disk * (1 - expected)
            self.assert_near(mean, wanted, 4 * error + tolerance, f"{what}, channel {channel}")
        # A lossless material shows no place, not only no mean: 6 x 6 blocks.
        if expected == 1:
            for y in range(0, SIZE, 8):
                for x in range(0, SIZE, 8):
                    block = [sum(picture.at(x + i, y + j)) / 3 for i in range(8) for j in range(8)]
                    mean, error = statistics(block)
                    self.assert_near(mean, 1, 5 * error + 2 * tolerance, f"{what}, block at {x} {y}")

    def test_every_registered_material_has_lossless_parameters_here(self):
        self.assertEqual(sorted(program.listed("materials")), sorted([*LOSSLESS, *NO_SURFACE_OF_THEIR_OWN]))

    def test_lossless_materials_cannot_be_seen_in_a_constant_sky(self):
        for kind, cases in LOSSLESS.items():
            for parameters, expected, tolerance in cases:
                with self.subTest(kind=kind, parameters=parameters):
                    self.check(furnace(kind, parameters), expected, tolerance, f"{kind} {parameters}")

    def test_lossless_ellipsoids_cannot_be_seen_either(self):
        for kind in ("diffuse", "mirror", "dielectric"):
            parameters, expected, tolerance = LOSSLESS[kind][0]
            with self.subTest(kind=kind):
                self.check(furnace(kind, parameters, "Scale 0.9 0.5 2\nRotate 30 1 2 3\n"), expected, tolerance, kind)

    def test_every_diffuse_sampling_loses_nothing(self):
        for sampling in ("disk", "normal-plus-sphere", "normal-plus-rejected-sphere", "normal-plus-gaussian"):
            with self.subTest(sampling=sampling):
                picture = self.picture(furnace("diffuse", '"rgb reflectance" [ 1 1 1 ]'),
                                       "--diffuse-sampling", sampling)
                mean, error = statistics(picture.values())
                self.assert_near(mean, 1, 4 * error + 1e-6, sampling)

    def test_albedo_is_the_radiance_of_a_lone_sphere(self):
        # A lone convex body sees sky only: its radiance is the albedo, channel by channel.
        picture = self.picture(scene(sky(1, 1, 1) + diffuse(0.8, 0.4, 0.1) + sphere(0, 0, 0, 1.5),
                                     size=(16, 16), camera=orthographic(1), spp=256))
        for channel, albedo in enumerate((0.8, 0.4, 0.1)):
            mean, error = statistics(picture.values(channel))
            self.assert_near(mean, albedo, 4 * error + 1e-6, f"channel {channel}")

    def test_an_image_of_an_even_sky_is_a_constant_sky(self):
        for name, width, height in (("square.pfm", 8, 8), ("wide.pfm", 16, 8)):
            pixels = struct.pack(f"<{3 * width * height}f", *[0.5] * (3 * width * height))
            self.write(name, f"PF\n{width} {height}\n-1.0\n".encode() + pixels)
            image = f'LightSource "infinite" "string filename" [ "{name}" ] "float scale" [ 2 ]\n'
            for albedo in (1, 0.5):
                with self.subTest(name=name, albedo=albedo):
                    picture = self.picture(scene("Rotate 30 1 2 3\n" + image + diffuse(albedo, albedo, albedo)
                                                 + sphere(0, 0, 0, 1.5), size=(16, 16), camera=orthographic(1), spp=256))
                    mean, error = statistics(picture.values())
                    self.assert_near(mean, albedo, 4 * error + 1e-5, name)

    def test_two_skies_add_up(self):
        picture = self.picture(scene(sky(0.2, 0.2, 0.2) + sky(0.8, 0.8, 0.8) + diffuse(0.5, 0.5, 0.5)
                                     + sphere(0, 0, 0, 1.5), size=(16, 16), camera=orthographic(1), spp=256))
        mean, error = statistics(picture.values())
        self.assert_near(mean, 0.5, 4 * error + 1e-5, "two skies")

    def test_closed_box_that_emits_has_the_radiance_of_its_geometric_series(self):
        # Radiance 1 emitted and half of it scattered at every wall: 1 + 1/2 + 1/4 + ... = 2.
        box = ('AreaLightSource "diffuse" "rgb L" [ 1 1 1 ]\n' + diffuse(0.5, 0.5, 0.5)
               + 'ReverseOrientation\nShape "sphere" "float radius" [ 3 ]\n')
        picture = self.picture(scene(box, look="0 0 0  0 0 1  0 1 0", size=(16, 16), spp=256, depth=500))
        mean, error = statistics(picture.values())
        self.assert_near(mean, 2, 4 * error + 1e-5, "inside of the sphere")
        self.assertLess(error, 0.01)


if __name__ == "__main__":
    program.main()
