"""The four ways to draw a diffuse direction give one picture within noise: z-tests of block means."""
import math
import os

import program
from program import statistics, tool

SAMPLINGS = ["disk", "normal-plus-sphere", "normal-plus-rejected-sphere", "normal-plus-gaussian"]
SEEDS = 8
BLOCK = 16


class DiffuseSampling(program.ProgramTest):
    def block_means(self, sampling):
        """One list for each seed: the means of all blocks and channels."""
        box = os.path.join(program.LECTURE, "cornell-box.pbrt")
        runs = []
        for seed in range(SEEDS):
            path = self.render(box, "--resolution", "64x64", "--spp", "32", "--diffuse-sampling", sampling,
                               "--seed", 1 + seed)
            runs.append([float(v) for v in tool("blocks", path, BLOCK).split()])
        return runs

    def test_all_give_the_same_block_means_within_noise(self):
        # Mean and standard error of every block over the seeds, which are independent.
        blocks = {s: [statistics(list(values)) for values in zip(*self.block_means(s))] for s in SAMPLINGS}
        for i, a in enumerate(SAMPLINGS):
            for b in SAMPLINGS[i + 1:]:
                scores = []
                for (mean_a, error_a), (mean_b, error_b) in zip(blocks[a], blocks[b]):
                    scores.append((mean_a - mean_b) / math.hypot(error_a, error_b))
                # Student's t of 14 degrees: beyond 6.5 once in 70,000; 48 scores in each of 6 pairs.
                self.assertLess(max(map(abs, scores)), 6.5, f"{a} against {b}")
                # Their mean square is 14 / 12 for equal pictures; the spread over 48 is 0.3.
                square = statistics([s * s for s in scores])[0]
                self.assertLess(square, 2.2, f"{a} against {b}")
                # A bias that all blocks share: the picture's mean to one in a thousand.
                mean_a, mean_b = (statistics([m for m, _ in blocks[s]])[0] for s in (a, b))
                self.assert_near(mean_a / mean_b, 1, 2e-3, f"{a} against {b}")


if __name__ == "__main__":
    program.main()
