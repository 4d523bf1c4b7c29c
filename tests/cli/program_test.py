"""Runs the program as a person does: exit codes, one line of error, whole files or none.

Usage: program_test.py SWELL
"""
import json
import os
import signal
import subprocess
import sys
import tempfile
import time
import unittest

SWELL = ""

SCENE = """
Film "rgb" "integer xresolution" 32 "integer yresolution" 24 "string filename" "film.exr"
Sampler "zsobol" "integer pixelsamples" 4
LookAt 0 0 -5  0 0 0  0 1 0
Camera "perspective" "float fov" 40
WorldBegin
LightSource "infinite" "rgb L" [1 1 1]
MakeNamedMaterial "white" "string type" "diffuse" "rgb reflectance" [0.8 0.8 0.8]
NamedMaterial "white"
Shape "sphere" "float radius" 1
Material "diffuse" "rgb reflectance" [0.2 0.4 0.6]
Translate 2 0 0
Shape "sphere" "float radius" 0.5
"""


class Program(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.write("scene.pbrt", SCENE)

    def tearDown(self):
        self.folder.cleanup()

    def write(self, name, text):
        with open(os.path.join(self.folder.name, name), "w", encoding="utf-8") as file:
            file.write(text)

    def files(self):
        return sorted(os.listdir(self.folder.name))

    def run_swell(self, *arguments, **options):
        return subprocess.run([SWELL, *arguments], cwd=self.folder.name, text=True, timeout=120,
                              stdin=subprocess.DEVNULL,
                              **{"capture_output": True, **options})

    def check_fails(self, code, *arguments):
        """The command ends with `code`, one line of error, and no new file."""
        before = self.files()
        run = self.run_swell(*arguments)
        errors = [line for line in run.stderr.splitlines() if line.startswith("swell: error: ")]
        self.assertEqual(run.returncode, code, run.stderr)
        self.assertEqual(len(errors), 1, run.stderr)
        self.assertEqual(run.stdout, "")
        self.assertEqual(self.files(), before)
        return errors[0]

    def test_render_writes_what_was_asked_for(self):
        run = self.run_swell("render", "scene.pbrt", "--outfile", "a.exr", "--outfile", "a.png",
                             "--stats", "s.json", "--nthreads", "2")
        self.assertEqual(run.returncode, 0, run.stderr)
        self.assertEqual(self.files(), ["a.exr", "a.png", "s.json", "scene.pbrt"])
        for word in ("import", "build", "render", "output", "intersect", "white", "Msamples/s"):
            self.assertIn(word, run.stderr)
        self.assertRegex(run.stderr, r"swell: import [0-9.]+ s, [0-9.]+ MB/s\n")
        self.assertEqual(run.stdout, "")

    def test_stats_hold_the_contract(self):
        run = self.run_swell("render", "scene.pbrt", "--quiet", "--stats", "s.json", "--spp", "8")
        self.assertEqual((run.returncode, run.stderr), (0, ""))
        with open(os.path.join(self.folder.name, "s.json"), encoding="utf-8") as file:
            stats = json.load(file)
        self.assertEqual(stats["schema"], 1)
        self.assertEqual(stats["totals"]["paths"], 32 * 24 * 8)
        self.assertEqual(stats["totals"]["non_finite_samples"], 0)
        self.assertGreaterEqual(stats["totals"]["closest_rays"], 32 * 24 * 8)
        self.assertGreater(stats["totals"]["shadow_rays"], 0)
        self.assertGreater(stats["totals"]["peak_rss_bytes"], 1 << 20)
        self.assertEqual(stats["settings"]["spp"], 8)
        self.assertEqual(stats["settings"]["outfile"], ["film.exr"])
        rows = stats["stages"]
        shaded = {row["material"] for row in rows if row["stage"] == "shade"}
        self.assertEqual(len(shaded), 2)
        self.assertIn("white", shaded)
        self.assertRegex((shaded - {"white"}).pop(), r"^diffuse#\d+$")
        camera = [row for row in rows if row["stage"] == "generate"]
        self.assertEqual(sum(row["rows"] for row in camera), 32 * 24 * 8)
        for row in rows:
            self.assertIsNone(row["perf"])
            self.assertGreater(row["rows"], 0)
            self.assertLessEqual(row["lanes_active"], row["lanes_issued"])

    def test_default_file_is_the_films_or_the_scenes(self):
        self.assertEqual(self.run_swell("render", "scene.pbrt").returncode, 0)
        self.assertIn("film.exr", self.files())
        self.write("other.pbrt", SCENE.replace("film.exr", "film.pfm"))
        self.assertEqual(self.run_swell("render", "other.pbrt").returncode, 0)
        self.assertIn("other.exr", self.files())

    def test_picture_is_the_same_however_it_is_run(self):
        pictures = []
        ways = [[], ["--nthreads", "1"], ["--nthreads", "2", "--wave", "64"], ["--window", "8"],
                ["--window", "16"], ["--engine", "megakernel"], ["--traversal", "single"], ["--traversal", "packet"],
                ["--regeneration", "off"], ["--wave", "1"]]
        for way in ways:
            run = self.run_swell("render", "scene.pbrt", "--quiet", "--outfile", "a.exr", "--spp", "32",
                                 *way)
            self.assertEqual((run.returncode, run.stderr), (0, ""), way)
            with open(os.path.join(self.folder.name, "a.exr"), "rb") as file:
                pictures.append(file.read())
        for way, picture in zip(ways, pictures):
            self.assertEqual(picture, pictures[0], way)

    def test_table_goes_to_standard_output(self):
        run = self.run_swell("render", "scene.pbrt", "--quiet", "--stats", "table")
        self.assertEqual((run.returncode, run.stderr), (0, ""))
        self.assertIn("intersect", run.stdout)
        self.assertIn("bounce", run.stdout)

    def test_info_says_what_was_read(self):
        run = self.run_swell("info", "scene.pbrt")
        self.assertEqual((run.returncode, run.stderr), (0, ""))
        for line in ("spheres           2", "1 infinite", "32x24", "Warnings"):
            self.assertIn(line, run.stdout)
        self.assertEqual(self.files(), ["scene.pbrt"])

    def test_info_says_the_same_to_scripts(self):
        run = self.run_swell("info", "--json", "scene.pbrt")
        self.assertEqual((run.returncode, run.stderr), (0, ""))
        info = json.loads(run.stdout)
        self.assertEqual(info["schema"], 1)
        self.assertEqual(info["spheres"], {"unique": 2, "instanced": 2})
        self.assertEqual(info["lights"], {"by_type": {"infinite": 1}})
        self.assertEqual(info["materials"]["by_kind"], {"diffuse": 2})
        self.assertEqual(info["materials"]["list"][0], {"name": "white", "kind": "diffuse"})
        self.assertEqual((info["film"]["width"], info["film"]["spp"]), (32, 4))
        self.assertEqual(info["camera"]["fov_degrees"], 40)
        self.assertEqual(set(info["seconds"]), {"import", "lights", "build"})
        self.assertEqual(sum(info["memory_bytes"].values()), info["memory_bytes_together"])
        self.assertGreater(info["peak_rss_bytes"]["import"], 1 << 20)
        self.assertEqual(set(info["peak_rss_bytes"]), set(info["seconds"]))
        self.assertEqual((info["textures"], info["warnings"]), ([], []))

    def test_info_groups_warnings_and_lists_textures(self):
        names = "".join(f"newmtl m{i}\nmap_Kd no{i}.png\n" for i in range(3))
        self.write("a.mtl", names + "newmtl good\nmap_Kd grey.pfm\n")
        with open(os.path.join(self.folder.name, "grey.pfm"), "wb") as file:
            file.write(b"PF\n2 3\n-1.0\n" + bytes(2 * 3 * 3 * 4))
        faces = "".join(f"usemtl {name}\nf 1 2 3\n" for name in ("m0", "m1", "m2", "good"))
        self.write("a.obj", "mtllib a.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\n" + faces)
        run = self.run_swell("info", "--json", "a.obj")
        self.assertEqual((run.returncode, run.stderr), (0, ""))
        info = json.loads(run.stdout)
        self.assertEqual([warning["count"] for warning in info["warnings"]], [3])
        self.assertIn("a.mtl:1: texture 'no0.png' does not exist", info["warnings"][0]["text"])
        picture = [t for t in info["textures"] if t["use"] == "texture"]
        self.assertEqual([(t["file"], t["width"], t["height"]) for t in picture], [("grey.pfm", 2, 3)])
        text = self.run_swell("info", "a.obj").stdout
        self.assertIn("does not exist; its material goes without (and 2 more like it)", text)
        self.assertIn("grey.pfm", text)

    def test_list_says_what_there_is(self):
        for topic, word in (("materials", "reflectance"), ("lights", "infinite"),
                            ("textures", "imagemap"), ("shapes", "bilinearmesh"),
                            ("isas", "scalar")):
            run = self.run_swell("list", topic)
            self.assertEqual((run.returncode, run.stderr), (0, ""))
            self.assertIn(word, run.stdout)

    def test_wrong_usage_is_2(self):
        for arguments in ([], ["rendr"], ["render"], ["render", "scene.pbrt", "--spp", "0"],
                          ["render", "scene.pbrt", "--perf"], ["list", "cameras"],
                          ["render", "scene.pbrt", "--outfile", "a.jpg"]):
            self.check_fails(2, *arguments)

    def test_what_cannot_be_read_or_written_is_1(self):
        self.assertIn("missing.pbrt", self.check_fails(1, "render", "missing.pbrt"))
        self.check_fails(1, "info", "missing.pbrt")
        self.check_fails(1, "render", ".")
        self.check_fails(1, "render", "scene.pbrt", "--outfile", "no/such/folder.exr")
        self.check_fails(1, "render", "scene.pbrt", "--stats", "no/such/folder.json")
        self.check_fails(1, "render", "scene.pbrt", "--cropwindow", "0.51,0.515,0,1")
        os.mkdir(os.path.join(self.folder.name, "folder.exr"))
        self.check_fails(1, "render", "scene.pbrt", "--outfile", "folder.exr")

    def test_closed_standard_streams_do_no_harm(self):
        quoted = f'"{SWELL}"'
        for line, code in ((f"{quoted} list materials >&-", 1),
                           (f"{quoted} list materials >/dev/full", 1),
                           (f"{quoted} list nothing 2>&-", 2),
                           (f"{quoted} render scene.pbrt --outfile a.exr <&- >&- 2>&-", 0)):
            run = subprocess.run(["sh", "-c", line], cwd=self.folder.name, timeout=120, check=False,
                                 stderr=subprocess.DEVNULL)
            self.assertEqual(run.returncode, code, line)
        self.assertEqual(self.files(), ["a.exr", "scene.pbrt"])
        self.assertEqual(self.run_swell("info", "scene.pbrt").returncode, 0)

    def test_reader_that_leaves_early_is_no_failure(self):
        reader, writer = os.pipe()
        os.close(reader)
        run = self.run_swell("list", "materials", capture_output=False, stdout=writer,
                             stderr=subprocess.PIPE)
        os.close(writer)
        self.assertEqual((run.returncode, run.stderr), (0, ""))

    def test_interrupt_leaves_no_file(self):
        run = subprocess.Popen([SWELL, "render", "scene.pbrt", "--spp", "4194304"],
                               cwd=self.folder.name, stderr=subprocess.PIPE, text=True)
        time.sleep(1)
        run.send_signal(signal.SIGINT)
        _, errors = run.communicate(timeout=60)
        self.assertEqual(run.returncode, -signal.SIGINT)
        self.assertIn("swell: error: interrupted; no image was written", errors)
        self.assertEqual(self.files(), ["scene.pbrt"])


if __name__ == "__main__":
    SWELL = os.path.abspath(sys.argv.pop(1))
    unittest.main()
