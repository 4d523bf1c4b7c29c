"""The program under test: renders scenes given as text and reads the pictures back.

A test file is run as FILE SWELL IMAGE_TOOL [DATA]: the two executables and, for some, the real scenes.
"""
import math
import os
import subprocess
import sys
import tempfile
import unittest

SWELL = IMAGE_TOOL = DATA = ""
ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
LECTURE = os.path.join(ROOT, "scenes", "lecture")


class Picture:
    """Linear RGB pixels of an image file, row by row from the top."""

    def __init__(self, path):
        self.width, self.height = (int(n) for n in tool("size", path).split())
        self.pixels = [tuple(map(float, line.split())) for line in tool("dump", path).splitlines()]

    def at(self, x, y):
        return self.pixels[y * self.width + x]

    def mean(self, channel=None):
        return statistics(self.values(channel))[0]

    def values(self, channel=None):
        """All values of a channel, or the means of the three."""
        if channel is None:
            return [sum(p) / 3 for p in self.pixels]
        return [p[channel] for p in self.pixels]


def statistics(values):
    """Mean and the standard error of the mean of independent values."""
    count = len(values)
    mean = math.fsum(values) / count
    variance = math.fsum((v - mean) ** 2 for v in values) / max(count - 1, 1)
    return mean, math.sqrt(variance / count)


def command(*words, **options):
    """Runs words as a command; output as text, never an exception of its exit code."""
    options.setdefault("timeout", 300)
    return subprocess.run([str(w) for w in words], stdout=subprocess.PIPE, stderr=subprocess.PIPE,
                          stdin=subprocess.DEVNULL, text=True, errors="replace", check=False, **options)


def swell(*words, **options):
    return command(SWELL, *words, **options)


def tool(*words):
    """The output of image_tool, which must succeed."""
    done = command(IMAGE_TOOL, *words)
    if done.returncode != 0:
        raise AssertionError(f"image_tool {' '.join(map(str, words))}: {done.stdout}{done.stderr}")
    return done.stdout.strip()


def listed(topic):
    """The names of `swell list TOPIC`."""
    lines = swell("list", topic).stdout.splitlines()
    names = lines[lines.index("") + 1:]  # after the paragraph that explains the columns
    return [line for line in names if line and not line.startswith(" ")]


def usable_isas():
    lines = swell("list", "isas").stdout.splitlines()
    return [line.split()[0] for line in lines if line.startswith("  ") and " yes " in line]


class ProgramTest(unittest.TestCase):
    """A test with a folder of its own."""

    def setUp(self):
        folder = tempfile.TemporaryDirectory(prefix="swell-test-")
        self.addCleanup(folder.cleanup)
        self.folder = folder.name
        self.renders = 0

    def write(self, name, text):
        path = os.path.join(self.folder, name)
        with open(path, "wb" if isinstance(text, bytes) else "w") as file:
            file.write(text)
        return path

    def render(self, scene, *options):
        """Renders a scene file, or the text of one, and returns the path of the EXR."""
        if "WorldBegin" in scene:
            scene = self.write(f"scene{self.renders}.pbrt", scene)
        out = os.path.join(self.folder, f"picture{self.renders}.exr")
        self.renders += 1
        done = swell("render", scene, "--quiet", "--outfile", out, *options)
        self.assertEqual((done.returncode, done.stderr), (0, ""), f"swell render {scene} {options}")
        return out

    def picture(self, scene, *options):
        return Picture(self.render(scene, *options))

    def assert_near(self, value, expected, tolerance, what=""):
        self.assertLessEqual(abs(value - expected), tolerance,
                             f"{what}: {value:.9g} is not {expected:.9g} within {tolerance:.3g}")


    def assert_same_blocks(self, options_of, scene, *options, seeds=8, block=16, most_square=2.2):
        """Renders with the options of each name and several seeds: means of blocks agree within noise."""
        blocks = {}  # mean and standard error of every block over the seeds, which are independent
        whole = {}  # the same of the picture
        for name, own in options_of.items():
            runs = [[float(v) for v in tool("blocks", self.render(scene, *options, *own, "--seed", 1 + seed),
                                            block).split()] for seed in range(seeds)]
            blocks[name] = [statistics(list(values)) for values in zip(*runs)]
            whole[name] = statistics([statistics(run)[0] for run in runs])
        names = list(options_of)
        for i, a in enumerate(names):
            for b in names[i + 1:]:
                scores = [(mean_a - mean_b) / math.hypot(error_a, error_b)
                          for (mean_a, error_a), (mean_b, error_b) in zip(blocks[a], blocks[b])]
                # Student's t of 14 degrees: beyond 6.5 once in 70,000; 48 scores in each of some pairs.
                self.assertLess(max(map(abs, scores)), 6.5, f"{a} against {b}")
                # Their mean square is 14 / 12 for equal pictures; the spread over 48 is 0.3, or 0.5 where the
                # channels of a block are off together.
                square = statistics([s * s for s in scores])[0]
                self.assertLess(square, most_square, f"{a} against {b}")
                # A bias that all blocks share, down to a few in a hundred.
                (mean_a, error_a), (mean_b, error_b) = whole[a], whole[b]
                error = math.hypot(error_a, error_b)
                self.assertLess(error, 6e-3 * mean_a)
                self.assert_near(mean_a, mean_b, 6.5 * error, f"{a} against {b}")


def scene(world, look="0 0 -5  0 0 0  0 1 0", camera='"perspective" "float fov" [ 40 ]',
          size=(32, 32), spp=64, depth=16, pixel_filter="box"):
    """The text of a scene file around what stands between WorldBegin and the end."""
    return (f'Integrator "path" "integer maxdepth" [ {depth} ]\n'
            f'Sampler "sobol" "integer pixelsamples" [ {spp} ]\n'
            f'PixelFilter "{pixel_filter}"\n'
            f'Film "rgb" "integer xresolution" [ {size[0]} ] "integer yresolution" [ {size[1]} ]\n'
            f'LookAt {look}\nCamera {camera}\nWorldBegin\n{world}\n')


def orthographic(half):
    """A camera that sees the square from -half to half."""
    return f'"orthographic" "float screenwindow" [ {-half} {half} {-half} {half} ]'


def sky(*rgb):
    return f'LightSource "infinite" "rgb L" [ {" ".join(map(str, rgb))} ]\n'


def material(kind, parameters=""):
    return f'Material "{kind}" {parameters}\n'


def diffuse(*rgb):
    return material("diffuse", f'"rgb reflectance" [ {" ".join(map(str, rgb))} ]')


def sphere(x, y, z, radius, before=""):
    return (f'AttributeBegin\nTranslate {x} {y} {z}\n{before}'
            f'Shape "sphere" "float radius" [ {radius} ]\nAttributeEnd\n')


def quad(*corners):
    """Two triangles; seen from the normal's side the corners run counter-clockwise."""
    points = " ".join(str(c) for corner in corners for c in corner)
    return f'Shape "trianglemesh" "point3 P" [ {points} ] "integer indices" [ 0 1 2 0 2 3 ]\n'


def emitting(shapes, *rgb, two_sided=False):
    both = ' "bool twosided" true' if two_sided else ""
    return (f'AttributeBegin\nAreaLightSource "diffuse" "rgb L" [ {" ".join(map(str, rgb))} ]{both}\n'
            f'{diffuse(0, 0, 0)}{shapes}AttributeEnd\n')


def fresnel(cos_i, eta):
    """Unpolarised reflectance of a dielectric of relative index eta (Fresnel)."""
    sin2_t = (1 - cos_i * cos_i) / (eta * eta)
    if sin2_t >= 1:
        return 1.0
    cos_t = math.sqrt(1 - sin2_t)
    parallel = (eta * cos_i - cos_t) / (eta * cos_i + cos_t)
    perpendicular = (cos_i - eta * cos_t) / (cos_i + eta * cos_t)
    return 0.5 * (parallel ** 2 + perpendicular ** 2)


def main():
    global SWELL, IMAGE_TOOL, DATA
    if len(sys.argv) < 3:
        sys.exit(f"usage: {sys.argv[0]} SWELL IMAGE_TOOL [DATA]")
    SWELL, IMAGE_TOOL = (os.path.abspath(path) for path in sys.argv[1:3])
    DATA = sys.argv[3] if len(sys.argv) > 3 else ""
    unittest.main(argv=[sys.argv[0]], module="__main__", verbosity=2)
