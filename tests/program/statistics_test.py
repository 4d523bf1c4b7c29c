"""What the program says of itself: the statistics file, progress, info, list, help and version."""
import json
import os
import re

import program
from program import emitting, material, quad, scene, sky, sphere, swell

WIDTH, HEIGHT, SPP = 40, 30, 16
FLOOR = quad((-9, 0, -9), (-9, 0, 9), (9, 0, 9), (9, 0, -9))
SCENE = scene(sky(1, 1, 1) + 'LightSource "point" "point3 from" [ 0 5 0 ]\n'
              + 'MakeNamedMaterial "ground" "string type" "diffuse"\nNamedMaterial "ground"\n' + FLOOR
              + emitting(sphere(-2, 1, 0, 0.5), 2, 2, 2) + material("mirror") + sphere(0, 1, 0, 1)
              + material("dielectric") + sphere(2, 1, 0, 1),
              look="0 2 -8  0 1 0  0 1 0", size=(WIDTH, HEIGHT), spp=SPP)
TOP = {"schema": int, "scene": str, "settings": dict, "machine": dict, "seconds": dict, "totals": dict, "stages": list}
STAGES = ["generate", "intersect", "sort", "shade_miss", "shade_emission", "shade", "occlude", "compact", "accumulate"]
ROW = {"stage", "bounce", "material", "calls", "rows", "lanes_active", "lanes_issued", "seconds", "bytes_read",
       "bytes_written", "perf"}


class Statistics(program.ProgramTest):
    def run_with_stats(self, *options):
        path = self.write("scene.pbrt", SCENE)
        out, stats = (os.path.join(self.folder, name) for name in ("out.exr", "stats.json"))
        done = swell("render", path, "--quiet", "--outfile", out, "--stats", stats, *options)
        self.assertEqual((done.returncode, done.stdout, done.stderr), (0, "", ""))
        with open(stats) as file:
            return json.load(file)

    def rows(self, stats, stage, bounce=None):
        return sum(r["rows"] for r in stats["stages"]
                   if r["stage"] == stage and (bounce is None or r["bounce"] == bounce))

    def test_names_of_the_contract_are_there(self):
        stats = self.run_with_stats()
        for name, kind in TOP.items():
            self.assertIsInstance(stats[name], kind, name)
        self.assertEqual(stats["schema"], 1)
        self.assertTrue(stats["scene"].endswith("scene.pbrt"))
        self.assertLessEqual({"cpu", "isa", "lanes", "threads", "compiler", "git"}, set(stats["machine"]))
        self.assertEqual({"import", "build", "render", "output"}, set(stats["seconds"]))
        self.assertLessEqual({"paths", "closest_rays", "shadow_rays", "rays_per_second", "samples_per_second",
                              "non_finite_samples", "peak_rss_bytes"}, set(stats["totals"]))
        for row in stats["stages"]:
            self.assertEqual(set(row), ROW)
            self.assertIn(row["stage"], STAGES)
            self.assertIsNone(row["perf"])
        self.assertEqual({r["stage"] for r in stats["stages"]}, set(STAGES))

    def test_settings_are_those_in_effect(self):
        settings = self.run_with_stats("--wave", "256", "--window", "32", "--seed", "5", "--nthreads", "1",
                                       "--traversal", "single", "--engine", "megakernel", "--spp", "8")["settings"]
        for name, value in {"wave": 256, "window": 32, "seed": 5, "nthreads": 1, "traversal": "single",
                            "engine": "megakernel", "spp": 8, "resolution": [WIDTH, HEIGHT],
                            "diffuse_sampling": "disk", "sampler": "sobol"}.items():
            self.assertEqual(settings[name], value, name)

    def test_sums_are_those_of_the_picture(self):
        for options in ((), ("--wave", "64"), ("--engine", "megakernel"), ("--window", "1"), ("--regeneration", "off")):
            with self.subTest(options=options):
                stats = self.run_with_stats(*options)
                totals = stats["totals"]
                paths = WIDTH * HEIGHT * SPP
                self.assertEqual(totals["paths"], paths)
                self.assertEqual(self.rows(stats, "generate"), paths)
                self.assertEqual(self.rows(stats, "accumulate"), paths)
                self.assertEqual(self.rows(stats, "intersect", 0), paths)
                self.assertEqual(self.rows(stats, "intersect"), totals["closest_rays"])
                self.assertEqual(self.rows(stats, "occlude"), totals["shadow_rays"])
                self.assertEqual(totals["non_finite_samples"], 0)
                # Every ray that was traced hit a surface or left the scene.
                for bounce in range(4):
                    self.assertEqual(self.rows(stats, "shade", bounce) + self.rows(stats, "shade_miss", bounce),
                                     self.rows(stats, "intersect", bounce), f"bounce {bounce}")
                self.assertGreater(totals["shadow_rays"], paths / 4)

    def test_rates_are_counts_over_seconds(self):
        stats = self.run_with_stats()
        totals, seconds = stats["totals"], stats["seconds"]
        rays = totals["closest_rays"] + totals["shadow_rays"]
        self.assert_near(totals["samples_per_second"] * seconds["render"] / totals["paths"], 1, 1e-6)
        self.assert_near(totals["rays_per_second"] * seconds["render"] / rays, 1, 1e-6)
        self.assertGreater(totals["peak_rss_bytes"], 1 << 20)
        self.assertLess(sum(r["seconds"] for r in stats["stages"]),
                        1.5 * seconds["render"] * stats["settings"]["nthreads"] + 0.01)

    def test_lanes_are_counted_where_they_are_issued(self):
        wide = self.run_with_stats("--wave", "1024")
        lanes = wide["machine"]["lanes"]
        for row in wide["stages"]:
            self.assertLessEqual(row["lanes_active"], row["lanes_issued"], row)
            self.assertGreater(row["rows"], 0)
            self.assertGreater(row["calls"], 0)
        # One lane at a time is always full.
        for row in self.run_with_stats("--engine", "megakernel")["stages"]:
            if row["stage"] in ("shade", "generate"):
                self.assertEqual(row["lanes_active"], row["lanes_issued"], row)
        if lanes < 4:
            return

        def fullness(stats):
            rows = [r for r in stats["stages"] if r["stage"] == "shade"]
            return sum(r["lanes_active"] for r in rows) / sum(r["lanes_issued"] for r in rows)
        self.assertGreater(fullness(wide), 0.9)
        self.assertLess(fullness(self.run_with_stats("--window", "1")), 1.5 / lanes)

    def test_materials_carry_their_names(self):
        labels = {r["material"] for r in self.run_with_stats()["stages"] if r["stage"] == "shade"}
        self.assertIn("ground", labels)
        self.assertEqual(len(labels), 4)
        self.assertEqual({None}, {r["material"] for r in self.run_with_stats()["stages"] if r["stage"] != "shade"})

    def test_counts_do_not_depend_on_threads_or_waves(self):
        keep = ("paths", "closest_rays", "shadow_rays", "non_finite_samples")
        first = self.run_with_stats()
        for options in (("--nthreads", "1"), ("--wave", "64"), ("--engine", "megakernel"), ("--regeneration", "off")):
            other = self.run_with_stats(*options)
            self.assertEqual({k: other["totals"][k] for k in keep}, {k: first["totals"][k] for k in keep}, options)

    def test_stats_table_goes_to_standard_output(self):
        path = self.write("scene.pbrt", SCENE)
        done = swell("render", path, "--quiet", "--outfile", os.path.join(self.folder, "o.png"), "--stats", "table")
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        for word in ("intersect", "ground", "bounce", "lanes"):
            self.assertIn(word, done.stdout)

    def test_progress_is_plain_lines_where_there_is_no_terminal(self):
        path = self.write("scene.pbrt", SCENE)
        done = swell("render", path, "--outfile", os.path.join(self.folder, "o.exr"))
        self.assertEqual((done.returncode, done.stdout), (0, ""))
        self.assertNotIn("\r", done.stderr)
        self.assertNotIn("\x1b", done.stderr)
        for word in ("import", "build", "render", "output", "paths", "intersect"):
            self.assertIn(word, done.stderr)

    def test_info_says_what_was_read(self):
        path = self.write("scene.pbrt", SCENE + 'LightSource "spot"\n')
        done = swell("info", path)
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        figures = dict(re.findall(r"^  (\w[\w ,]*?)  +(\S.*)$", done.stdout.split("Memory")[0], re.MULTILINE))
        self.assertEqual(figures["triangles"], "2")
        self.assertEqual(figures["spheres"], "3")
        self.assertIn("-9 to 9", figures["bounds"])
        self.assertIn(f"{WIDTH}x{HEIGHT}", figures["film"])
        self.assertIn("2 diffuse", figures["materials"])
        self.assertIn("ground", done.stdout)
        self.assertIn("spot", done.stdout, "warnings are told")

    def test_list_names_what_the_build_has(self):
        self.assertLessEqual({"diffuse", "mirror", "fuzzymirror", "dielectric", "conductor"},
                             set(program.listed("materials")))
        self.assertEqual({"infinite", "point", "distant", "diffuse", "spot", "goniometric", "projection"},
                         set(program.listed("lights")))
        self.assertEqual({"sphere", "trianglemesh", "plymesh", "disk", "cylinder", "bilinearmesh", "curve", "loopsubdiv"},
                         set(program.listed("shapes")))
        self.assertTrue(program.usable_isas())
        self.assertLessEqual(set(program.usable_isas()), {"avx3", "avx2", "sse4", "neon", "scalar"})

    def test_help_names_every_option_and_version_the_program(self):
        done = swell("render", "--help")
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        for option in ("--outfile", "--spp", "--seed", "--maxdepth", "--resolution", "--cropwindow", "--nthreads",
                       "--quiet", "--engine", "--wave", "--window", "--traversal", "--isa", "--stats", "--dump-wave",
                       "--diffuse-sampling", "--regeneration", "--sampler"):
            self.assertIn(option, done.stdout)
        self.assertRegex(swell("--version").stdout, r"^swell \d+\.\d+\.\d+")

    def test_a_recorded_wave_is_written_whole(self):
        path = self.write("scene.pbrt", SCENE)
        dump = os.path.join(self.folder, "wave.bin")
        done = swell("render", path, "--quiet", "--outfile", os.path.join(self.folder, "o.exr"),
                     "--dump-wave", f"intersect:1:{dump}")
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        self.assertGreater(os.path.getsize(dump), 1000)


if __name__ == "__main__":
    program.main()
