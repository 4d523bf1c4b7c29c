"""Real scenes against other renderers' pictures: means of blocks agree within both renderers' noise.

The references are half float and may come twice, with two seeds, which tells their noise.
"""
import math
import os

import program
from program import statistics, tool

REFERENCE = "reference"
SEEDS = 4


class Reference(program.ProgramTest):
    def blocks(self, path, size):
        return [tuple(map(float, line.split())) for line in tool("blocks", path, size).splitlines()]

    def path(self, *names):
        path = os.path.join(program.DATA, *names)
        if not os.path.exists(path):
            self.skipTest(f"{path} is not there")
        return path

    def compare(self, scene, references, block, spp, columns=None, tolerance=0.0, options=()):
        """z of block means over SEEDS renders and all references; `tolerance` is a relative bias
        that the two programs may have. Columns: the share of the picture that counts."""
        ours = [self.blocks(self.render(scene, "--spp", spp, "--seed", 11 + seed, *options), block)
                for seed in range(SEEDS)]
        theirs = [self.blocks(reference, block) for reference in references]
        self.assertEqual(len(ours[0]), len(theirs[0]), "the pictures have one size")
        width = math.ceil(int(tool("size", references[0]).split()[0]) / block)
        # The references' noise, relative to a block's level, from the difference of their seeds.
        noise = 0.0
        if len(theirs) > 1:
            squares = [((a[c] - b[c]) / (0.05 + a[c] + b[c])) ** 2 for a, b in zip(*theirs) for c in range(3)]
            noise = math.sqrt(statistics(squares)[0])
        scores, ratios = [], []
        for i in range(len(ours[0])):
            if columns and not columns[0] <= (i % width + 0.5) / width <= columns[1]:
                continue
            for c in range(3):
                mean, error = statistics([blocks[i][c] for blocks in ours])
                expected = sum(blocks[i][c] for blocks in theirs) / len(theirs)
                # Half floats have 11 bits; their mean over a block is far better than one of them.
                allowed = math.sqrt(error ** 2 + (noise * (0.05 + 2 * expected)) ** 2
                                    + (2 ** -12 * expected) ** 2) + tolerance * expected + 1e-5
                scores.append((mean - expected) / allowed)
                ratios.append((mean, expected))
        ratio = sum(r[0] for r in ratios) / sum(r[1] for r in ratios)
        worst = max(map(abs, scores))
        print(f"{os.path.basename(scene)}: mean ratio {ratio:.5f}, worst block z {worst:.2f}, "
              f"rms z {math.sqrt(statistics([s * s for s in scores])[0]):.2f}, reference noise {noise:.5f}")
        self.assertLess(worst, 6, scene)
        self.assertLess(abs(ratio - 1), 0.004 + tolerance, scene)

    def ours_against_pbrt(self, name, **options):
        references = [self.path(REFERENCE, f"{name}.seed{n}.exr") for n in (1, 2)]
        self.compare(self.path(REFERENCE, f"{name}.pbrt"), references, 8, 512, **options)

    def test_grey_diffuse_box_is_the_picture_of_pbrt(self):
        self.ours_against_pbrt("01-diffuse-box-grey")

    def test_coloured_diffuse_box_is_the_picture_of_pbrt(self):
        # pbrt renders spectra there, which differ from RGB where colours multiply: 2 percent of a
        # block's level, somewhat more of the dark channels beside the coloured walls.
        self.ours_against_pbrt("02-diffuse-box-colour", tolerance=0.03)

    def test_smooth_glass_is_the_picture_of_pbrt(self):
        # The left fifth, around the smooth sphere; the others are of materials to come.
        self.ours_against_pbrt("03-dielectrics", columns=(0, 0.2), tolerance=0.01)

    def test_instances_are_the_picture_of_pbrt(self):
        self.ours_against_pbrt("10-instances")

    def test_point_spot_and_distant_lights_are_the_picture_of_pbrt(self):
        self.ours_against_pbrt("06-punctual-lights", tolerance=0.005)

    def test_environment_is_the_picture_of_pbrt(self):
        # pbrt's half floats and its metal's spectral reflectance leave half a percent.
        self.ours_against_pbrt("07-environment", tolerance=0.005)

    def test_many_lights_are_the_picture_of_pbrt(self):
        self.ours_against_pbrt("09-many-lights", tolerance=0.005)

    def test_lens_and_shaped_lights_are_the_picture_of_pbrt(self):
        self.ours_against_pbrt("11-lens-and-shaped-lights", tolerance=0.005)

    def test_cornell_box_is_the_picture_of_cycles(self):
        folder = ("pbrt-v4", "cornell-box")
        reference = self.path(*folder, "cycles-3.4-256x256-1024spp-boxfilter.exr")
        # The scene asks for a triangle filter; in blocks of 32 pixels that is no matter.
        self.compare(self.path(*folder, "scene-v4.pbrt"), [reference], 32, 64, tolerance=0.012,
                     options=("--resolution", "256x256"))


if __name__ == "__main__":
    program.main()
