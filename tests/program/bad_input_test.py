"""Bad input ends in one line on standard error, the right exit code, and no file left behind."""
import os
import resource
import signal
import struct
import subprocess
import tempfile

import program
from program import command, diffuse, scene, sky, sphere, swell

GOOD = scene(sky(1, 1, 1) + diffuse(0.5, 0.5, 0.5) + sphere(0, 0, 0, 1), size=(8, 8), spp=1)
BEGIN, WORLD = GOOD[:GOOD.index("WorldBegin")], GOOD[GOOD.index("WorldBegin") + len("WorldBegin\n"):]
MESH = 'Shape "trianglemesh" "point3 P" [ {} ] "integer indices" [ {} ]\n'


def world(text):
    return BEGIN + "WorldBegin\n" + text + "\n"


def options(text):
    return text + "\nWorldBegin\n" + WORLD


def ply(header, body=b"", kind="ascii"):
    return f"ply\nformat {kind} 1.0\n{header}end_header\n".encode() + body


XYZ = "property float x\nproperty float y\nproperty float z\n"
FACE = "property list uchar int vertex_indices\n"
MESH_HEADER = "element vertex {}\n" + XYZ + "element face {}\n" + FACE
TRIANGLE = b"0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n"

# name -> (scene, words the line must hold). The scene is named bad.pbrt.
SCENES = {
    "empty file": ("", ["bad.pbrt", "empty"]),
    "only comments": ("# nothing\n\n", ["WorldBegin"]),
    "no WorldBegin": (BEGIN, ["WorldBegin"]),
    "binary rubbish": (bytes(range(256)) * 20, []),
    "unknown directive": (world('Shaep "sphere"'), ["bad.pbrt:8", "Shaep", "Shape"]),
    "directive in the wrong block": (world('Camera "perspective"'), ["bad.pbrt:8", "WorldBegin"]),
    "text without an end": (world('Shape "sphere'), ["bad.pbrt:8"]),
    "brackets without an end": (world('Shape "sphere" "float radius" [ 1'), ["bad.pbrt:8"]),
    "parameter of the wrong type": (world('Shape "sphere" "string radius" "big"'), ["bad.pbrt:8", "radius"]),
    "parameter type that does not exist": (world('Shape "sphere" "flaot radius" 1'), ["flaot", "float"]),
    "number that is none": (world('Shape "sphere" "float radius" [ 1.2.3 ]'), ["bad.pbrt:8", "1.2.3"]),
    "not a number": (world('Shape "sphere" "float radius" [ nan ]'), ["bad.pbrt:8"]),
    "number beyond floats": (world('Shape "sphere" "float radius" [ 1e999 ]'), ["bad.pbrt:8"]),
    "negative radius": (world('Shape "sphere" "float radius" [ -1 ]'), ["bad.pbrt:8", "radius"]),
    "unknown shape": (world('Shape "sfere"'), ["bad.pbrt:8", "sfere", "sphere"]),
    "unknown material": (world('Material "difuse"'), ["bad.pbrt:8", "difuse", "diffuse"]),
    "undefined named material": (world('NamedMaterial "gold"\nShape "sphere"'), ["gold"]),
    "albedo above 1": (world('Material "diffuse" "rgb reflectance" [ 1 2 1 ]'), ["bad.pbrt:8", "reflectance"]),
    "sky image that is not there": (world('LightSource "infinite" "string filename" "sky.exr"'),
                                    ["bad.pbrt:8", "sky.exr", "not in the folder"]),
    "sky image that is a scene": (world('LightSource "infinite" "string filename" "bad.pbrt"'),
                                  ["bad.pbrt:8", "cannot be read"]),
    "unknown metal": (world('Material "conductor" "spectrum eta" "metal-Xx-eta"'), ["bad.pbrt:8", "metal-Xx-eta"]),
    "unbalanced AttributeBegin": (world("AttributeBegin"), ["bad.pbrt:8", "AttributeBegin"]),
    "unbalanced AttributeEnd": (world("AttributeEnd"), ["bad.pbrt:8", "AttributeEnd"]),
    "attributes nested without end": (world("AttributeBegin\n" * 200000), ["bad.pbrt"]),
    "singular scale": (world('Scale 1 0 1\nShape "sphere"'), ["bad.pbrt:8"]),
    "singular matrix": (world('Transform [ 1 0 0 0  1 0 0 0  0 0 1 0  0 0 0 1 ]'), ["bad.pbrt:8", "singular"]),
    "scales that flatten together": (world("Scale 1e-30 1 1\n" * 12 + 'Shape "sphere"'), ["bad.pbrt"]),
    "axis of length 0": (world("Rotate 30 0 0 0"), ["bad.pbrt:8"]),
    "LookAt along its up": (options("LookAt 0 0 0  0 1 0  0 1 0\n" + BEGIN), ["bad.pbrt:1"]),
    "NaN vertex": (world(MESH.format("0 0 0 1 0 0 0 nan 0", "0 1 2")), ["bad.pbrt:8"]),
    "infinite vertex": (world(MESH.format("0 0 0 1 0 0 0 1e39 0", "0 1 2")), ["bad.pbrt:8"]),
    "vertex that a transform makes infinite": (
        world("Scale 1e30 1e30 1e30\n" + MESH.format("0 0 0 1e20 0 0 0 1e20 0", "0 1 2")), ["bad.pbrt:9"]),
    "index out of range": (world(MESH.format("0 0 0 1 0 0 0 1 0", "0 1 3")), ["bad.pbrt:8", "3"]),
    "negative index": (world(MESH.format("0 0 0 1 0 0 0 1 0", "0 1 -1")), ["bad.pbrt:8", "-1"]),
    "index beyond integers": (world(MESH.format("0 0 0 1 0 0 0 1 0", "0 1 99999999999")), ["bad.pbrt:8"]),
    "two indices": (world(MESH.format("0 0 0 1 0 0 0 1 0", "0 1")), ["bad.pbrt:8"]),
    "vertices that do not come in threes": (world(MESH.format("0 0 0 1 0 0 0 1", "0 1 2")), ["bad.pbrt:8"]),
    "resolution 0": (options('Film "rgb" "integer xresolution" [ 0 ]'), ["bad.pbrt:1", "xresolution"]),
    "negative resolution": (options('Film "rgb" "integer yresolution" [ -5 ]'), ["bad.pbrt:1", "yresolution"]),
    "resolution beyond memory": (
        options('Film "rgb" "integer xresolution" [ 65535 ] "integer yresolution" [ 65535 ]'), ["memory"]),
    "crop window without a pixel": (
        options('Film "rgb" "float cropwindow" [ 0.5 0.5 0 1 ]'), ["crop window"]),
    "no samples": (options('Sampler "sobol" "integer pixelsamples" [ 0 ]'), ["bad.pbrt:1", "pixelsamples"]),
    "unknown camera": (options('Camera "perspektive"'), ["bad.pbrt:1", "perspective"]),
    "field of view of 180 degrees": (options('Camera "perspective" "float fov" 180'), ["bad.pbrt:1", "fov"]),
    "missing include": (world('Include "nowhere.pbrt"'), ["bad.pbrt:8", "nowhere.pbrt"]),
    "include of itself": (world('Include "bad.pbrt"'), ["bad.pbrt"]),
    "include of a folder": (world('Include "."'), ["bad.pbrt:8"]),
    "missing mesh": (world('Shape "plymesh" "string filename" "nowhere.ply"'), ["bad.pbrt:8", "nowhere.ply"]),
    "instance of nothing": (world('ObjectInstance "tree"'), ["bad.pbrt:8", "tree"]),
}

# name -> bytes of mesh.ply, read by a scene whose line 8 names it.
MESHES = {
    "empty": b"",
    "no PLY": b"solid cube\n",
    "header without an end": b"ply\nformat ascii 1.0\nelement vertex 3\n",
    "unknown format": ply(MESH_HEADER.format(3, 1), TRIANGLE, "binary_middle_endian"),
    "fewer vertices than said": ply(MESH_HEADER.format(30, 1), TRIANGLE),
    "fewer faces than said": ply(MESH_HEADER.format(3, 9), TRIANGLE),
    "vertices beyond memory": ply(MESH_HEADER.format(4000000000, 1), TRIANGLE),
    "counts beyond integers": ply(MESH_HEADER.format(99999999999999999999, 1), TRIANGLE),
    "negative count": ply(MESH_HEADER.format(-3, 1), TRIANGLE),
    "binary, cut in a vertex": ply(MESH_HEADER.format(3, 1), b"\0" * 17, "binary_little_endian"),
    "binary, cut in a face": ply(MESH_HEADER.format(3, 1), struct.pack("<9f", *range(9)) + b"\3\0\0",
                                 "binary_little_endian"),
    "binary list longer than the file": ply(MESH_HEADER.format(3, 1), struct.pack("<9f", *range(9)) + b"\xff\0\0\0\0",
                                            "binary_little_endian"),
    "index out of range": ply(MESH_HEADER.format(3, 1), TRIANGLE.replace(b"3 0 1 2", b"3 0 1 7")),
    "negative index": ply(MESH_HEADER.format(3, 1), TRIANGLE.replace(b"3 0 1 2", b"3 0 1 -2")),
    "NaN vertex": ply(MESH_HEADER.format(3, 1), TRIANGLE.replace(b"1 0 0", b"nan 0 0")),
    "infinite vertex": ply(MESH_HEADER.format(3, 1), struct.pack(">9f", *range(8), float("inf"))
                           + struct.pack(">B3i", 3, 0, 1, 2), "binary_big_endian"),
    "no coordinates": ply("element vertex 3\nproperty float red\nelement face 1\n" + FACE, b"1\n2\n3\n3 0 1 2\n"),
    "letters for numbers": ply(MESH_HEADER.format(3, 1), TRIANGLE.replace(b"1 0 0", b"one 0 0")),
}

# Words after `swell`; OUT and SCENE stand for a file to write and a good scene.
USAGE = [
    [], ["rendr"], ["--nonsense"], ["render"], ["info"], ["list"], ["list", "everything"],
    ["render", "SCENE", "--sppp", "4"], ["render", "SCENE", "--spp"], ["render", "SCENE", "--spp", "0"],
    ["render", "SCENE", "--spp", "-4"], ["render", "SCENE", "--spp", "many"], ["render", "SCENE", "--spp", "4.5"],
    ["render", "SCENE", "--spp", "99999999999"], ["render", "SCENE", "--spp", "4", "--spp", "8"],
    ["render", "SCENE", "--resolution", "0x5"], ["render", "SCENE", "--resolution", "12"],
    ["render", "SCENE", "--resolution", "70000x1"], ["render", "SCENE", "--cropwindow", "0,1,0"],
    ["render", "SCENE", "--cropwindow", "0.5,0.4,0,1"], ["render", "SCENE", "--cropwindow", "0,nan,0,1"],
    ["render", "SCENE", "--engine", "steam"], ["render", "SCENE", "--traversal", "stream"],
    ["render", "SCENE", "--wave", "0"], ["render", "SCENE", "--wave", "8", "--window", "16"],
    ["render", "SCENE", "--regeneration", "maybe"], ["render", "SCENE", "--isa", "avx9"],
    ["render", "SCENE", "--nthreads", "-1"], ["render", "SCENE", "--outfile", "picture.jpg"],
    ["render", "SCENE", "--stats", "stats.txt"], ["render", "SCENE", "--dump-wave", "intersect:2"],
    ["render", "SCENE", "--diffuse-sampling", "square"], ["render", "SCENE", "--sort-rays", "morton"],
    ["render", "SCENE", "--checkpoint", "OUT"], ["render", "SCENE", "--perf"],
]


class BadInput(program.ProgramTest):
    def check(self, words, code, holds=(), **how):
        """Runs swell; checks the exit code, the single line, and that the folder is as before."""
        before = sorted(os.listdir(self.folder))
        done = swell(*words, timeout=60, cwd=self.folder, **how)
        lines = done.stderr.splitlines()
        self.assertEqual(done.returncode, code, f"{words}: {done.stderr[-2000:]}")
        self.assertEqual(len(lines), 1, f"{words}: {done.stderr[-2000:]}")
        self.assertTrue(done.stderr.endswith("\n"))
        self.assertTrue(lines[0].startswith("swell: error: "), lines[0])
        self.assertLess(len(lines[0]), 600, lines[0])
        self.assertTrue(lines[0].isprintable(), lines[0])
        for word in holds:
            self.assertIn(word, lines[0])
        self.assertEqual(done.stdout, "")
        self.assertEqual(sorted(os.listdir(self.folder)), before, "a file is left behind")
        return lines[0]

    def render(self, path, *more):
        return ["render", path, "--quiet", "--outfile", "out.exr", *more]

    def test_bad_scenes_are_one_line_that_names_file_and_line(self):
        for name, (text, holds) in SCENES.items():
            with self.subTest(name=name):
                self.write("bad.pbrt", text)
                self.check(self.render("bad.pbrt"), 1, holds)

    def test_info_says_the_same_of_bad_scenes(self):
        for name in ("unknown directive", "index out of range", "missing include"):
            text, holds = SCENES[name]
            self.write("bad.pbrt", text)
            self.assertEqual(self.check(["info", "bad.pbrt"], 1, holds), self.check(self.render("bad.pbrt"), 1, holds))

    def test_bad_meshes_are_one_line_that_names_the_mesh(self):
        self.write("bad.pbrt", world('Shape "plymesh" "string filename" "mesh.ply"'))
        for name, contents in MESHES.items():
            with self.subTest(name=name):
                self.write("mesh.ply", contents)
                self.check(self.render("bad.pbrt"), 1, ["bad.pbrt:8", "mesh.ply"])

    def test_every_cut_of_a_good_mesh_is_an_error_or_a_picture(self):
        whole = ply(MESH_HEADER.format(3, 1), struct.pack("<9f", *range(8), 9.5) + struct.pack("<B3i", 3, 0, 1, 2),
                    "binary_little_endian")
        self.write("bad.pbrt", world('Shape "plymesh" "string filename" "mesh.ply"'))
        for size in range(0, len(whole), 7):
            with self.subTest(size=size):
                self.write("mesh.ply", whole[:size])
                self.check(self.render("bad.pbrt"), 1, ["mesh.ply"])

    def test_files_that_cannot_be_read(self):
        self.write("good.pbrt", GOOD)
        self.check(self.render("nowhere.pbrt"), 1, ["nowhere.pbrt"])
        self.check(self.render("good.pbrt/inside.pbrt"), 1, ["good.pbrt/inside.pbrt"])
        os.mkdir(os.path.join(self.folder, "folder.pbrt"))
        self.check(self.render("folder.pbrt"), 1, ["folder.pbrt"])
        self.check(["info", "nowhere.pbrt"], 1, ["nowhere.pbrt"])
        self.write("scene.obj", "v 0 0 0\n")
        self.check(self.render("scene.obj"), 1, ["scene.obj"])

    def test_cyclic_includes_name_the_cycle(self):
        self.write("a.pbrt", world('Include "b.pbrt"'))
        self.write("b.pbrt", 'Include "c.pbrt"\n')
        self.write("c.pbrt", 'Include "b.pbrt"\n')
        self.check(self.render("a.pbrt"), 1, ["c.pbrt:1", "b.pbrt"])

    def test_degenerate_triangles_are_left_out(self):
        points = "0 0 0 1 0 0 0 1 0 0.5 0.5 0 1 1 0"
        self.write("scene.pbrt", world('Material "diffuse"\nLightSource "infinite"\n'
                                       + MESH.format(points, "0 1 2  0 0 0  0 1 1  1 3 2  1 4 2")))
        out = os.path.join(self.folder, "out.exr")
        done = swell(*self.render("scene.pbrt"), cwd=self.folder)
        self.assertEqual(done.returncode, 0, done.stderr)
        low, high = map(float, program.tool("range", out).split())
        self.assertTrue(0 <= low <= high <= 1.5, (low, high))

    # ------------------------------------------------------------ output
    def test_outputs_that_cannot_be_written_are_told_before_the_render(self):
        self.write("good.pbrt", GOOD)
        self.write("file", "")
        os.mkdir(os.path.join(self.folder, "folder.exr"))
        for path in ("nowhere/out.exr", "folder.exr", "file/out.png", "/proc/out.exr", "/dev/null/out.exr"):
            with self.subTest(path=path):
                self.check(["render", "good.pbrt", "--quiet", "--outfile", path], 1, [path])
                self.check(["render", "good.pbrt", "--quiet", "--outfile", "out.exr", "--outfile", path], 1, [path])
        self.check(["render", "good.pbrt", "--quiet", "--outfile", "out.exr", "--stats", "nowhere/s.json"], 1,
                   ["nowhere/s.json"])

    def test_a_failed_render_leaves_the_old_picture(self):
        self.write("good.pbrt", GOOD)
        self.write("out.exr", "old picture")
        self.write("bad.pbrt", world("Oops"))
        self.check(self.render("bad.pbrt"), 1)
        with open(os.path.join(self.folder, "out.exr")) as file:
            self.assertEqual(file.read(), "old picture")

    def test_a_full_disk_is_one_line_and_leaves_no_file(self):
        path = self.write("good.pbrt", GOOD)
        disk = tempfile.mkdtemp(prefix="swell-full-")
        self.addCleanup(os.rmdir, disk)
        mounted = command("mount", "-t", "tmpfs", "-o", "size=16k", "tmpfs", disk) if os.geteuid() == 0 else None
        if mounted is None or mounted.returncode != 0:
            print("skipped: a file system of 16 KiB cannot be mounted here")
            return
        self.addCleanup(command, "umount", disk)
        for name in ("out.exr", "out.png"):
            done = swell("render", path, "--quiet", "--resolution", "200x200", "--outfile", os.path.join(disk, name))
            self.assertEqual((done.returncode, len(done.stderr.splitlines())), (1, 1), done.stderr)
            self.assertTrue(done.stderr.startswith("swell: error: "), done.stderr)
            self.assertEqual(os.listdir(disk), [])

    def test_a_file_size_limit_is_one_line_and_leaves_no_file(self):
        self.write("good.pbrt", GOOD)

        def limit():
            resource.setrlimit(resource.RLIMIT_FSIZE, (4096, 4096))
        for name in ("out.exr", "out.png"):
            self.check(["render", "good.pbrt", "--quiet", "--resolution", "200x200", "--outfile", name], 1, [name],
                       preexec_fn=limit)

    def test_an_interrupted_render_leaves_no_file(self):
        self.write("good.pbrt", GOOD)
        for number in (signal.SIGINT, signal.SIGTERM):
            before = sorted(os.listdir(self.folder))
            with subprocess.Popen([program.SWELL, "render", "good.pbrt", "--spp", "4000000", "--resolution",
                                   "512x512", "--outfile", "out.exr"], cwd=self.folder, text=True,
                                  stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE) as run:
                while "render" not in run.stderr.readline():
                    pass
                run.send_signal(number)
                run.communicate(timeout=60)
            self.assertNotEqual(run.returncode, 0)
            self.assertEqual(sorted(os.listdir(self.folder)), before)

    # ------------------------------------------------------------ usage
    def test_wrong_usage_is_one_line_and_exit_code_2(self):
        self.write("good.pbrt", GOOD)
        for words in USAGE:
            with self.subTest(words=" ".join(words)):
                names = {"SCENE": "good.pbrt", "OUT": "out.exr"}
                self.check([names.get(word, word) for word in words], 2)

    def test_mistyped_options_get_a_suggestion(self):
        line = self.check(["render", "good.pbrt", "--resolutoin", "4x4"], 2)
        self.assertIn("--resolution", line)
        self.assertIn("render", self.check(["rendr"], 2))


if __name__ == "__main__":
    program.main()
