"""Instanced scenes from outside: the pictures of the scenes written out, closed rooms, many instances."""
import os
import re
import shutil
import sys

import program
from acne_test import box, lights_around
from law1_test import FLOOR, smooth_mesh
from program import Picture, diffuse, material, orthographic, quad, scene, sky, sphere, statistics, swell

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "bench"))
import make_grid_ply  # noqa: E402

# Turned, mirrored, flattened, far away, tiny.
PLACES = ["Translate -3 0 0\n", "Translate -1 0 0\nRotate 50 1 2 3\n", "Translate 1 0 0\nScale -1 1 1\n",
          "Translate 3 0 0\nRotate 30 0 0 1\nScale 0.5 1.2 0.8\n"]


def define(name, content):
    return f'ObjectBegin "{name}"\n{content}ObjectEnd\n'


def place(name, transform=""):
    return f'AttributeBegin\n{transform}ObjectInstance "{name}"\nAttributeEnd\n'


def inline(content, transform=""):
    return f"AttributeBegin\n{transform}{content}AttributeEnd\n"


PARTS = {
    "smooth": "Translate 0 0.8 0\nScale 0.6 0.6 0.6\n" + material("conductor", '"float roughness" [ 0.3 ]')
              + smooth_mesh(16, 24),
    "glass": material("dielectric", '"float eta" [ 1.5 ]') + sphere(0, -0.7, 0, 0.5),
    "boards": diffuse(0.7, 0.4, 0.2) + quad((-0.8, -1.3, 0.5), (-0.8, 1.3, 0.5), (0.8, 1.3, 0.5), (0.8, -1.3, 0.5))
              + "ReverseOrientation\n" + sphere(0.7, 0, 0, 0.2),
}


class Instances(program.ProgramTest):
    def world(self, instanced):
        """Every part at every place, between what stands in the world itself."""
        text = sky(0.3, 0.4, 0.6) + 'LightSource "distant" "point3 from" [ 1 2 -3 ] "point3 to" [ 0 0 0 ]\n'
        text += diffuse(0.5, 0.5, 0.5) + "AttributeBegin\nTranslate 0 -1.4 0\n" + FLOOR + "AttributeEnd\n"
        if instanced:
            text += "".join(define(name, part) for name, part in PARTS.items())
            # The half of the places through another object.
            text += define("all", "".join(place(name) for name in PARTS))
        for i, transform in enumerate(PLACES):
            if instanced and i % 2:
                text += place("all", transform)
                continue
            for name, part in PARTS.items():
                text += place(name, transform) if instanced else inline(part, transform)
        return scene(text, look="0 1 -9  0 0 0  0 1 0", size=(96, 48), spp=64, depth=8)

    def test_instances_show_the_picture_of_the_same_shapes_written_out(self):
        # The same random numbers, so only paths that rounding sends elsewhere differ.
        ours, written = self.picture(self.world(True)), self.picture(self.world(False))
        close = sum(all(abs(a - b) < 1e-3 * (0.1 + b) for a, b in zip(p, q))
                    for p, q in zip(ours.pixels, written.pixels))
        self.assertGreater(close, 0.9 * len(ours.pixels))
        for channel in range(3):
            self.assert_near(ours.mean(channel) / written.mean(channel), 1, 1e-3, "mean")

    def test_a_mesh_that_is_named_often_shows_the_picture_of_copies(self):
        make_grid_ply.write(64, os.path.join(self.folder, "grid.ply"))
        for name in "01234567":
            shutil.copy(os.path.join(self.folder, "grid.ply"), os.path.join(self.folder, f"{name}.ply"))

        def world(names):
            text = sky(0.3, 0.4, 0.6) + 'LightSource "distant" "point3 from" [ 1 2 -3 ] "point3 to" [ 0 0 0 ]\n'
            for i, (name, transform) in enumerate(zip(names, 2 * PLACES)):
                surface = diffuse(0.5, 0.6, 0.7) if i < 4 else material("conductor", '"float roughness" [ 0.2 ]')
                text += inline(surface + f'Shape "plymesh" "string filename" "{name}.ply"\n',
                               transform + ("Translate 0 -1 0.1\n" if i >= 4 else "") + "Scale 2 2 2\n")
            return scene(text, look="0 1 -9  0 0 0  0 1 0", size=(96, 48), spp=64, depth=5)

        once, copies = world(["grid"] * 8), world("01234567")
        counted = swell("info", self.write("once.pbrt", once)).stdout
        self.assertRegex(counted, r"triangles +16,384 unique, 65,536 with instances\n")
        self.assertRegex(counted, r"vertices +8,450\n")
        ours, written = self.picture(once), self.picture(copies)
        close = sum(all(abs(a - b) < 1e-3 * (0.1 + b) for a, b in zip(p, q))
                    for p, q in zip(ours.pixels, written.pixels))
        self.assertGreater(close, 0.9 * len(ours.pixels))
        for channel in range(3):
            self.assert_near(ours.mean(channel) / written.mean(channel), 1, 1e-3, "mean")

    # ------------------------------------------------------------ origins of rays
    def check_black(self, world, look, half=1):
        picture = self.picture(scene(lights_around(half) + world, look=look, camera='"perspective" "float fov" [ 100 ]',
                                     size=(64, 64), spp=64, depth=12))
        lit = [p for p in picture.pixels if p != (0.0, 0.0, 0.0)]
        self.assertEqual(len(lit), 0, f"light leaks into pixels such as {lit[:3]}")

    def test_rooms_that_are_instances_stay_black_inside(self):
        for transform in ("", "Rotate 33 1 2 3\n", "Scale 1 0.1 30\n", "Rotate 20 1 1 0\nScale 1 0.05 3\n", "Scale -2 3 4\n",
                          "Scale 1e-3 1e-3 1e-3\n", "Scale 1e6 1e6 1e6\n"):
            for shape in (box(0, 0, 0, 1), sphere(0, 0, 0, 1)):
                with self.subTest(transform=transform, shape=shape[:20]):
                    world = define("room", diffuse(0.9, 0.9, 0.9) + shape) + place("room", transform)
                    half = 1e6 if "1e6" in transform else 1
                    self.check_black(world, "0 0 0  1 0.2 0.3  0 1 0", half)

    def test_a_room_far_from_its_objects_origin_and_the_worlds_stays_black_inside(self):
        room = define("room", diffuse(0.9, 0.9, 0.9) + box(50, 20, -30, 1))
        self.check_black(room + place("room", "Translate 1000 300 -70\n"), "1050 320 -100  1051 320.3 -99.4  0 1 0")

    def test_a_lone_plane_as_an_instance_shows_its_albedo(self):
        for transform in ("", "Scale 3 1e-3 3\n", "Rotate 10 1 0 0\nScale 2 50 2\n", "Scale 1e3 1e3 1e3\n"):
            with self.subTest(transform=transform):
                world = sky(1, 1, 1) + define("plane", diffuse(0.5, 0.5, 0.5) + quad(
                    (-50, 0, -50), (-50, 0, 50), (50, 0, 50), (50, 0, -50))) + place("plane", transform)
                picture = self.picture(scene(world, look="0 20 -20  0 0 0  0 1 0", camera=orthographic(5),
                                             size=(24, 24), spp=64, depth=4))
                mean, error = statistics(picture.values())
                self.assert_near(mean, 0.5, 4 * error + 1e-5, "albedo")

    # ------------------------------------------------------------ many
    def test_a_million_instances_render_in_bounded_memory(self):
        side = 1000
        with open(os.path.join(self.folder, "many.pbrt"), "w") as file:
            file.write(scene(sky(1, 1, 1) + diffuse(0.5, 0.5, 0.5) + define("thing", smooth_mesh(40, 60) + sphere(0, 1, 0, 0.3)),
                             look="0 400 -700  0 0 0  0 1 0", size=(160, 90), spp=1, depth=3))
            for i in range(side * side):
                x, z = i % side - side // 2, i // side - side // 2
                file.write(f'AttributeBegin Translate {x} 0 {z} Rotate {i % 360} 0 1 0 Scale .3 .4 .3 '
                           'ObjectInstance "thing" AttributeEnd\n')
        done = swell("info", file.name)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertRegex(done.stdout, r"instances +1,000,000\n")
        self.assertRegex(done.stdout, r"triangles +4,680 unique, 4,680,000,000 with instances\n")
        out = os.path.join(self.folder, "many.exr")
        words = [program.SWELL, "render", file.name, "--quiet", "--outfile", out]
        # What the program and its other arrays take is found with as good as no instances.
        few = self.write("few.pbrt", scene(sky(1, 1, 1) + diffuse(0.5, 0.5, 0.5)
                                           + define("thing", smooth_mesh(40, 60) + sphere(0, 1, 0, 0.3)) + place("thing"),
                                           size=(160, 90), spp=1, depth=3))
        base = self.peak_bytes([program.SWELL, "render", few, "--quiet", "--outfile", out])
        peak = self.peak_bytes(words)
        # 150 bytes each stay; the build takes as much again for a while, and the text of the file is read.
        self.assertLess(peak - base, 500 * side * side)
        picture = Picture(out)
        self.assertGreater(picture.mean(), 0.2)

    @staticmethod
    def peak_bytes(words):
        script = "import resource, subprocess, sys; r = subprocess.run(sys.argv[1:]); " \
                 "print('peak', resource.getrusage(resource.RUSAGE_CHILDREN).ru_maxrss); sys.exit(r.returncode)"
        done = program.command("python3", "-c", script, *words)
        if done.returncode != 0:
            raise AssertionError(done.stderr)
        return 1024 * int(re.search(r"peak (\d+)", done.stdout).group(1))


if __name__ == "__main__":
    program.main()
