"""All samplers give one picture within noise, those with strata the less noisy, by name or by scene file."""
import os

import program
from program import swell, tool

BOX = os.path.join(program.LECTURE, "cornell-box.pbrt")
STRATIFYING = ["sobol", "zsobol", "halton", "stratified"]
SAMPLERS = STRATIFYING + ["independent"]
SMALL = ("--resolution", "64x64")


class Samplers(program.ProgramTest):
    def test_list_names_them(self):
        self.assertEqual(program.listed("samplers"), SAMPLERS)

    def test_all_give_the_same_block_means_within_noise(self):
        # No power of two and no square: strata that are not all filled weigh nothing more.
        self.assert_same_blocks({s: ("--sampler", s) for s in SAMPLERS}, BOX, *SMALL, "--spp", "61",
                                most_square=3.5)

    def test_strata_make_less_noise_than_none(self):
        reference = self.render(BOX, *SMALL, "--spp", "2048", "--seed", "99")
        error = {s: float(tool("rmse", self.render(BOX, *SMALL, "--spp", "16", "--sampler", s), reference))
                 for s in SAMPLERS}
        for sampler in STRATIFYING:
            self.assertLess(error[sampler], 0.97 * error["independent"], f"{sampler}: {error}")

    def test_scene_file_and_option_choose_the_same(self):
        with open(BOX, encoding="utf-8") as file:
            text = file.read()
        self.assertIn('Sampler "sobol" "integer pixelsamples"', text)
        pictures = []
        for sampler in SAMPLERS:
            count = '"stratified" "integer xsamples" [ 2 ] "integer ysamples" [ 4 ]' if sampler == "stratified" \
                else f'"{sampler}" "integer pixelsamples" [ 8 ]'
            lines = [f"Sampler {count}" if line.startswith("Sampler") else line for line in text.splitlines()]
            path = self.write(f"{sampler}.pbrt", "\n".join(lines))
            pictures.append(self.render(path, *SMALL))
            by_option = self.render(BOX, *SMALL, "--spp", "8", "--sampler", sampler)
            done = program.command(program.IMAGE_TOOL, "equal", pictures[-1], by_option)
            self.assertEqual(done.returncode, 0, f"{sampler}: {done.stdout}{done.stderr}")
        for i, a in enumerate(pictures):
            for b in pictures[i + 1:]:
                self.assertNotEqual(program.command(program.IMAGE_TOOL, "equal", a, b).returncode, 0)

    def test_what_swell_has_not_is_a_warning_that_names_what_is_used(self):
        path = self.write("scene.pbrt", 'Sampler "pmj02bn" "integer pixelsamples" 1\nWorldBegin\n' + program.sky(1, 1, 1))
        out = os.path.join(self.folder, "out.exr")
        done = swell("render", path, "--resolution", "8x8", "--outfile", out)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("swell samples with 'sobol' instead", done.stderr)


if __name__ == "__main__":
    program.main()
