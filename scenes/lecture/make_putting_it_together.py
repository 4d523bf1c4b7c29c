#!/usr/bin/env python3
"""Writes putting-it-together.pbrt: a field of small spheres around three big ones, under a soft sky.

Usage: make_putting_it_together.py > putting-it-together.pbrt. The same bytes each time.
"""
import math
import random

SEED = 19
HEADER = """\
# Putting it together: diffuse, mirror, rough, metal and glass spheres, a thin lens and a soft sky.
# The glow around the sun is a flat shield of rings far away, each a little dimmer than the one
# inside; elsewhere the sky is constant. Made by make_putting_it_together.py.
# Lecture: "Putting it together".
Integrator "path" "integer maxdepth" [ 24 ]
Sampler "sobol" "integer pixelsamples" [ 64 ]
Film "rgb" "integer xresolution" [ 640 ] "integer yresolution" [ 360 ]
    "string filename" [ "putting-it-together.exr" ]
LookAt -2.6 2.6 -11.5  0.1 0.8 0  0 1 0
Camera "perspective" "float fov" [ 22.5 ] "float lensradius" [ 0.07 ] "float focaldistance" [ 10.9 ]
WorldBegin
"""

SKY = (0.34, 0.47, 0.72)          # radiance far from the sun
GLOW = (5.6, 4.3, 2.9)            # added at the sun's centre
GLOW_WIDTH = math.radians(24)     # falls as exp(-(angle / width)^2)
GLOW_END = math.radians(56)
SUN_ELEVATION, SUN_AZIMUTH = 31, 316  # degrees; the azimuth turns from +z to +x
RINGS = 150
FAR = 10000.0

BIG = [(-2.55, 1.0, 1.3), (0.0, 1.0, 0.0), (2.5, 1.0, -0.9)]  # x, radius, z

DIFFUSE = [(0.60, 0.13, 0.08), (0.78, 0.42, 0.10), (0.80, 0.68, 0.42), (0.10, 0.32, 0.38),
           (0.07, 0.14, 0.34), (0.34, 0.44, 0.16), (0.74, 0.70, 0.64), (0.40, 0.12, 0.22)]
METAL = ["Cu", "Au", "Ag", "Al"]


def radiance(angle):
    glow = math.exp(-((angle / GLOW_WIDTH) ** 2)) - math.exp(-((GLOW_END / GLOW_WIDTH) ** 2))
    return [sky + glow * sun for sky, sun in zip(SKY, GLOW)]


def numbers(values):
    return " ".join(f"{v:.5g}" for v in values)


def ring_edges():
    """Angles between which the logarithm of the green radiance falls by equal steps."""
    top, end = math.log(radiance(0.0)[1]), math.log(SKY[1])
    edges = [0.0]
    for i in range(1, RINGS):
        wanted = top + (end - top) * i / RINGS
        low, high = edges[-1], GLOW_END
        for _ in range(60):
            middle = 0.5 * (low + high)
            low, high = (middle, high) if math.log(radiance(middle)[1]) > wanted else (low, middle)
        edges.append(low)
    return edges + [GLOW_END]


def write_sky():
    print(f'LightSource "infinite" "rgb L" [ {numbers(SKY)} ]')
    print("\n# The glow: rings around the direction of the sun, facing the scene.")
    print("AttributeBegin")
    print(f"  Rotate {SUN_AZIMUTH - 180:g} 0 1 0")
    print(f"  Rotate {SUN_ELEVATION:g} 1 0 0")
    print(f"  Translate 0 0 {-FAR:g}")
    print('  Material "diffuse" "rgb reflectance" [ 0 0 0 ]')
    edges = ring_edges()
    for inner, outer in zip(edges, edges[1:]):
        light = numbers(radiance(0.5 * (inner + outer)))
        print(f'  AreaLightSource "diffuse" "rgb L" [ {light} ]')
        print(f'    Shape "disk" "float radius" [ {FAR * math.tan(outer):.6g} ]'
              f' "float innerradius" [ {FAR * math.tan(inner):.6g} ]')
    print("AttributeEnd")


def write_sphere(x, y, z, radius):
    print(f'AttributeBegin Translate {x:.4g} {y:.4g} {z:.4g}'
          f' Shape "sphere" "float radius" [ {radius:.4g} ] AttributeEnd')


def write_small(rng, x, z, radius):
    kind = rng.random()
    if kind < 0.58:
        tone = 0.75 + 0.35 * rng.random()
        color = [min(0.85, tone * c) for c in rng.choice(DIFFUSE)]
        print(f'Material "diffuse" "rgb reflectance" [ {numbers(color)} ]')
    elif kind < 0.70:
        metal = rng.choice(METAL)
        print(f'Material "conductor" "spectrum eta" "metal-{metal}-eta" "spectrum k" "metal-{metal}-k"')
    elif kind < 0.84:
        tint = [0.55 + 0.4 * c for c in rng.choice(DIFFUSE)]
        print(f'Material "fuzzymirror" "rgb reflectance" [ {numbers(tint)} ]'
              f' "float fuzz" [ {0.05 + 0.4 * rng.random():.3g} ]')
    else:
        print('Material "dielectric" "float eta" [ 1.5 ]')
    write_sphere(x, radius, z, radius)


def main():
    print(HEADER, end="")
    write_sky()
    print('\n# The ground.\nMaterial "diffuse" "rgb reflectance" [ 0.46 0.43 0.40 ]')
    write_sphere(0, -1000, 0, 1000)

    print("\n# The three big ones: red clay, glass, gold.")
    print('Material "diffuse" "rgb reflectance" [ 0.42 0.10 0.07 ]')
    write_sphere(BIG[0][0], BIG[0][1], BIG[0][2], BIG[0][1])
    print('Material "dielectric" "float eta" [ 1.5 ]')
    write_sphere(BIG[1][0], BIG[1][1], BIG[1][2], BIG[1][1])
    print('Material "conductor" "spectrum eta" "metal-Au-eta" "spectrum k" "metal-Au-k"')
    write_sphere(BIG[2][0], BIG[2][1], BIG[2][2], BIG[2][1])

    print("\n# The small ones.")
    rng = random.Random(SEED)
    placed = [(x, z, radius) for x, radius, z in BIG]
    tries = 0
    while len(placed) < 330 and tries < 20000:
        tries += 1
        x, z = -9 + 20 * rng.random(), -7.2 + 21 * rng.random()
        radius = 0.13 + 0.22 * rng.random() ** 2
        # Two spheres on the ground touch where the distance of their feet is 2 sqrt(r s).
        if any(math.hypot(x - a, z - b) < 2 * math.sqrt(radius * c) + 0.06 for a, b, c in placed):
            continue
        placed.append((x, z, radius))
        write_small(rng, x, z, radius)


if __name__ == "__main__":
    main()
