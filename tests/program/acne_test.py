"""No shadow acne, no light leaks: lone surfaces keep their light, closed rooms stay black."""
import math
import os

import program
from program import Picture, diffuse, material, orthographic, quad, scene, sky, sphere, statistics

SUN = 'LightSource "distant" "point3 from" [ {} ] "point3 to" [ 0 0 0 ] "rgb L" [ 1 1 1 ]\n'


def lights_around(half):
    """Sky, sun and a lamp, all outside of rooms that reach `half` from the origin."""
    far, level = 40 * max(1, half), 9e5 * max(1, half) ** 2
    lamp = f'LightSource "point" "point3 from" [ {far} {1.5 * far} {1.25 * far} ] "rgb I" [ {level} {level} {level} ]\n'
    return sky(50, 50, 50) + SUN.format("1 2 -3") + lamp


def box(x, y, z, half):
    """The six walls of a cube as one mesh of 8 shared vertices."""
    points = [f"{x + half * i} {y + half * j} {z + half * k}" for k in (-1, 1) for j in (-1, 1) for i in (-1, 1)]
    faces = [(0, 2, 3, 1), (4, 5, 7, 6), (0, 1, 5, 4), (2, 6, 7, 3), (0, 4, 6, 2), (1, 3, 7, 5)]
    indices = " ".join(f"{a} {b} {c} {a} {c} {d}" for a, b, c, d in faces)
    return f'Shape "trianglemesh" "point3 P" [ {" ".join(points)} ] "integer indices" [ {indices} ]\n'


def plane(transform, half):
    return f"AttributeBegin\n{transform}" + quad((-half, 0, -half), (-half, 0, half), (half, 0, half), (half, 0, -half)) \
        + "AttributeEnd\n"


class Acne(program.ProgramTest):
    # ------------------------------------------------------------ flat surfaces
    def test_a_lone_plane_under_the_sky_shows_its_albedo(self):
        # A plane cannot shadow itself: the radiance is the albedo, in all depths.
        for transform in ("", "Translate 0 1 0\n", "Rotate 37 1 0.3 0.2\n", "Translate 1000 -300 20\n", "Rotate 90 0 0 1\n"):
            for half in (1e-3, 1, 50, 1e5):
                with self.subTest(transform=transform, half=half):
                    world = sky(1, 1, 1) + diffuse(0.5, 0.5, 0.5) + plane(transform, half)
                    picture = self.picture(self.looking(world, transform, half))
                    mean, error = statistics(picture.values())
                    self.assert_near(mean, 0.5, 4 * error + 1e-5, "albedo")

    def looking(self, world, transform, half):
        """The world from a camera that looks down at the plane's centre, wherever that is."""
        text = scene(world, look="0 0 0  0 0 1  0 1 0", camera=orthographic(0.2 * half), size=(24, 24), spp=64, depth=4)
        # World to camera: the plane's transform is undone before the view from 45 degrees.
        inverse = "".join(reversed([self.inverse(line) for line in transform.splitlines()]))
        return text.replace("LookAt 0 0 0  0 0 1  0 1 0",
                            f"LookAt 0 {half} {-half}  0 0 0  0 1 0\n{inverse}")

    @staticmethod
    def inverse(line):
        words = line.split()
        if words[0] == "Translate":
            return f"Translate {' '.join(str(-float(w)) for w in words[1:])}\n"
        return f"Rotate {-float(words[1])} {' '.join(words[2:])}\n"

    def test_glass_planes_lose_no_light(self):
        # Water as a plane at height 0, seen from below: every grazing ray must leave for good.
        for height in (0, 0.3):
            world = sky(1, 1, 1) + material("dielectric", '"string eta" "water"') + plane(f"Translate 0 {height} 0\n", 500)
            picture = self.picture(scene(world, look="0 -3 0  0 0 0  0 0 1", camera='"perspective" "float fov" [ 130 ]',
                                         size=(48, 48), spp=256, depth=20))
            # Below the water lies the same sky: reflected or refracted, radiance 1 or 1.333^2 comes back.
            values = picture.values()
            self.assertGreater(min(values), 0.999)
            self.assertLess(max(values), 1.333 ** 2 + 1e-4)

    # ------------------------------------------------------------ closed rooms
    def check_black(self, world, look, fov=100, half=1):
        picture = self.picture(scene(lights_around(half) + world, look=look, camera=f'"perspective" "float fov" [ {fov} ]',
                                     size=(64, 64), spp=64, depth=12))
        lit = [p for p in picture.pixels if p != (0.0, 0.0, 0.0)]
        self.assertEqual(len(lit), 0, f"light leaks into pixels such as {lit[:3]}")

    def test_closed_boxes_stay_black_inside(self):
        for centre, half in (((0, 0, 0), 1), ((0, 0, 0), 1e-3), ((0, 0, 0), 1e6), ((1000, 300, -70), 1), ((0.1, 0.2, 0.3), 7)):
            with self.subTest(centre=centre, half=half):
                x, y, z = centre
                look = f"{x} {y} {z}  {x + half} {y + 0.3 * half} {z + 0.6 * half}  0 1 0"
                self.check_black(diffuse(0.9, 0.9, 0.9) + box(x, y, z, half), look, half=half)

    def test_turned_boxes_stay_black_inside(self):
        world = diffuse(0.9, 0.9, 0.9) + "Rotate 33 1 2 3\n" + box(0, 0, 0, 2)
        self.check_black(world, "0 0 0  1 0.2 0.3  0 1 0")

    def test_closed_spheres_stay_black_inside(self):
        for centre, radius in (("0 0 0", 1), ("0 0 0", 1e-3), ("0 0 0", 1e6), ("3 2 1", 0.5)):
            with self.subTest(centre=centre, radius=radius):
                x, y, z = map(float, centre.split())
                self.check_black(diffuse(0.9, 0.9, 0.9) + sphere(x, y, z, radius),
                                 f"{centre}  {x + radius} {y} {z + 0.5 * radius}  0 1 0", half=radius)

    def test_rooms_of_mixed_materials_stay_black(self):
        world = diffuse(0.8, 0.8, 0.8) + box(0, 0, 0, 2) + material("mirror") + sphere(1, -1, 1, 0.7) \
            + material("dielectric") + sphere(-1, -1, 1, 0.8) + material("fuzzymirror") + sphere(0, 1, 1.2, 0.5)
        self.check_black(world, "0 0 -1.5  0 0 1  0 1 0")

    # ------------------------------------------------------------ a small and a huge sphere
    def lit_sphere(self, world, centre, radius):
        """Pictures of one sphere of the world in parallel light from the side, and what they should be."""
        x, y, z = centre
        size = 64
        text = scene(SUN.format("1 0 -0.05") + world, look=f"{x} {y} {z - 3 * radius}  {x} {y} {z}  0 1 0",
                     camera=orthographic(1.1 * radius), size=(size, size), spp=64, depth=1)
        picture = self.picture(text)
        length = math.hypot(1, 0.05)
        light = (1 / length, 0, -0.05 / length)
        worst = 0
        for row in range(size):
            for column in range(size):
                value = picture.at(column, row)[0]
                # Least and greatest cosine over the pixel, from its 5 x 5 points.
                cosines = []
                for i in range(5):
                    for j in range(5):
                        px = (2 * (column + i / 4) / size - 1) * 1.1
                        py = (1 - 2 * (row + j / 4) / size) * 1.1
                        if px * px + py * py <= 1:
                            pz = -math.sqrt(1 - px * px - py * py)
                            cosines.append(max(0.0, px * light[0] + pz * light[2]))
                if len(cosines) < 25:
                    continue  # the outline
                scale = 0.5 / math.pi
                low, high = scale * min(cosines), scale * max(cosines)
                self.assertGreaterEqual(value, low - 1e-4, f"pixel {column} {row} is too dark")
                self.assertLessEqual(value, high + 1e-4, f"pixel {column} {row} is too bright")
                worst = max(worst, high)
        self.assertGreater(worst, 0.15)

    def test_spheres_of_radius_one_thousandth_and_one_million_are_lit_by_the_cosine(self):
        # Both in one scene, 3 degrees from the direction of view to grazing light.
        world = diffuse(0.5, 0.5, 0.5) + sphere(0, 0, 0, 1e-3) + sphere(0, -1000040, 0, 1e6)
        self.lit_sphere(world, (0, 0, 0), 1e-3)
        self.lit_sphere(diffuse(0.5, 0.5, 0.5) + sphere(0, 2000000, 0, 1e-3) + sphere(0, 0, 0, 1e6), (0, 0, 0), 1e6)

    def test_both_spheres_keep_their_light_under_the_sky(self):
        # Lone convex bodies: radiance is the albedo, at every pixel within noise.
        for centre, radius in (((0, 0, 0), 1e-3), ((0, 0, 0), 1), ((5, 5, 5), 1), ((0, 0, 0), 1e6)):
            with self.subTest(centre=centre, radius=radius):
                x, y, z = centre
                picture = self.picture(scene(sky(1, 1, 1) + diffuse(0.5, 0.5, 0.5) + sphere(x, y, z, radius),
                                             look=f"{x} {y} {z - 3 * radius}  {x} {y} {z}  0 1 0",
                                             camera=orthographic(0.6 * radius), size=(32, 32), spp=256, depth=5))
                mean, error = statistics(picture.values())
                self.assert_near(mean, 0.5, 4 * error + 1e-6, "albedo")
                self.assertGreater(min(picture.values()), 0.42, "a dark speckle")

    def test_the_acne_scene_has_no_speckles(self):
        # Every pixel lies near the median of its neighbours, far beyond noise: a speckle does not.
        path = self.render(os.path.join(program.LECTURE, "acne.pbrt"), "--resolution", "160x90", "--spp", "256")
        picture = Picture(path)
        speckles = 0
        for y in range(1, picture.height - 1):
            for x in range(1, picture.width - 1):
                around = sorted(picture.at(x + i, y + j)[1] for i in (-1, 0, 1) for j in (-1, 0, 1) if i or j)
                value = picture.at(x, y)[1]
                low, high = around[0], around[-1]
                if value < 0.7 * low or value > 1.4 * high:
                    speckles += 1
        self.assertEqual(speckles, 0)


if __name__ == "__main__":
    program.main()
