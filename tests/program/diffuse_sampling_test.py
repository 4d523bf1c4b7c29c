"""The four ways to draw a diffuse direction give one picture within noise: z-tests of block means."""
import os

import program

SAMPLINGS = ["disk", "normal-plus-sphere", "normal-plus-rejected-sphere", "normal-plus-gaussian"]


class DiffuseSampling(program.ProgramTest):
    def test_all_give_the_same_block_means_within_noise(self):
        self.assert_same_blocks({s: ("--diffuse-sampling", s) for s in SAMPLINGS},
                                os.path.join(program.LECTURE, "cornell-box.pbrt"), "--resolution", "64x64",
                                "--spp", "32")


if __name__ == "__main__":
    program.main()
