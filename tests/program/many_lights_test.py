"""A thousand small lights: every light sampler converges to one picture, the light tree soonest."""
import math
import random

import program
from program import diffuse, emitting, material, quad, scene, sky, sphere

SAMPLERS = ("uniform", "power", "bvh")


def lamps(count, seed=1):
    """Small triangles that hang low over a wide floor, in groups of different radiance, facing about."""
    numbers = random.Random(seed)
    text = ""
    for group in range(10):
        points, faces = [], []
        for i in range(count // 10):
            x, y, z = numbers.uniform(-10, 10), numbers.uniform(1.6, 2.6), numbers.uniform(-10, 10)
            for _ in range(3):
                points += [v + numbers.uniform(-0.05, 0.05) for v in (x, y, z)]
            faces += [3 * i, 3 * i + 1, 3 * i + 2]
        level = 10 * 1.5 ** group
        mesh = (f'Shape "trianglemesh" "point3 P" [ {" ".join(f"{p:.5f}" for p in points)} ]'
                f' "integer indices" [ {" ".join(map(str, faces))} ]\n')
        text += emitting(mesh, level, level * numbers.uniform(0.3, 1), level * numbers.uniform(0.3, 1),
                         two_sided=group % 2 == 0)
    return text


WORLD = (lamps(1000) + diffuse(0.5, 0.5, 0.5) + quad((-12, 0, -12), (-12, 0, 12), (12, 0, 12), (12, 0, -12))
         + sphere(-2, 0.4, 0, 0.4) + material("conductor", '"float roughness" [ 0.3 ]') + sphere(0, 0.4, 0, 0.4)
         + material("dielectric") + sphere(2, 0.4, 0, 0.4))
LOOK = "0 1.4 -2  0 0 0.5  0 1 0"  # from below the lamps: none is in sight, so no pixel holds an edge of one


class ManyLights(program.ProgramTest):
    def measure(self, text, spp):
        """Mean, and mean squared error of a pixel, by sampler: of two seeds each."""
        means, errors = {}, {}
        for sampler in SAMPLERS:
            one, two = (self.picture(text, "--lightsampler", sampler, "--spp", str(spp), "--seed", seed).values()
                        for seed in ("1", "2"))
            means[sampler] = (math.fsum(one) + math.fsum(two)) / 2 / len(one)
            errors[sampler] = sum((p - q) ** 2 for p, q in zip(one, two)) / 2 / len(one)
        return means, errors

    def check_means(self, means, errors, pixels, sharp):
        for sampler in ("uniform", "power"):
            noise = math.sqrt((errors[sampler] + errors["bvh"]) / 2 / pixels)
            self.assert_near(means[sampler], means["bvh"], 4 * noise, f"{sampler} against bvh: {errors}")
            self.assertLess(noise, sharp * means["bvh"], "the test is sharp")

    def test_samplers_agree_and_the_tree_has_the_least_error(self):
        means, errors = self.measure(scene(WORLD, look=LOOK, size=(32, 32), depth=2), 64)
        self.check_means(means, errors, 32 * 32, 0.02)
        self.assertLess(errors["power"], errors["uniform"])
        self.assertLess(3 * errors["bvh"], errors["power"], str(errors))

    def test_lights_at_infinity_and_beside_the_tree_add_up(self):
        world = (sky(0.2, 0.3, 0.4) + 'LightSource "distant" "point3 from" [ 1 2 -1 ] "point3 to" [ 0 0 0 ]\n'
                 + 'LightSource "point" "rgb I" [ 6 8 9 ] "point3 from" [ 4 4 -4 ]\n' + WORLD)
        means, errors = self.measure(scene(world, look=LOOK, size=(24, 24), depth=3), 64)
        self.check_means(means, errors, 24 * 24, 0.05)

    def test_light_tree_is_the_same_however_it_is_run(self):
        text = self.write("scene.pbrt", scene(sky(0.1, 0.1, 0.1) + WORLD, look=LOOK, size=(48, 32), spp=4))
        reference = self.render(text, "--lightsampler", "bvh")
        for way in [("--nthreads", "1"), ("--wave", "64"), ("--window", "1"), ("--window", "8"),
                    ("--engine", "megakernel"), ("--regeneration", "off", "--wave", "65536")]:
            other = self.render(text, "--lightsampler", "bvh", *way)
            done = program.command(program.IMAGE_TOOL, "equal", reference, other)
            self.assertEqual((done.returncode, done.stdout.strip()), (0, "same"), f"{way}: {done.stderr}")

    def test_scene_files_choose_the_sampler_and_the_command_line_overrides_it(self):
        names = {}
        for named in SAMPLERS:
            text = scene(WORLD, look=LOOK, size=(8, 8), spp=1).replace(
                'Integrator "path"', f'Integrator "path" "string lightsampler" "{named}"')
            names[named] = text
            by_file = self.render(text)
            by_option = self.render(names["uniform"], "--lightsampler", named)
            done = program.command(program.IMAGE_TOOL, "equal", by_file, by_option)
            self.assertEqual((done.returncode, done.stdout.strip()), (0, "same"), named + done.stderr)


if __name__ == "__main__":
    program.main()
