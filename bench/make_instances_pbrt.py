#!/usr/bin/env python3
"""Writes a pbrt scene of N x N instances of a wavy square of 100,352 triangles, to measure what
instances take.

Usage: make_instances_pbrt.py N FOLDER     N = 1000: a million instances; writes scene.pbrt and grid.ply
"""
import os
import sys

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
import make_grid_ply  # noqa: E402

HEAD = """Film "rgb" "integer xresolution" 320 "integer yresolution" 240 "string filename" "instances.exr"
Sampler "independent" "integer pixelsamples" 4
LookAt {0} {0} {1}  {2} {2} 0  0 0 1
Camera "perspective" "float fov" 40
WorldBegin
LightSource "infinite" "rgb L" [ 0.6 0.8 1 ]
Material "diffuse" "rgb reflectance" [ 0.7 0.6 0.4 ]
ObjectBegin "square"
Shape "plymesh" "string filename" "grid.ply"
ObjectEnd
"""


def write(n, folder):
    make_grid_ply.write(224, os.path.join(folder, "grid.ply"))
    with open(os.path.join(folder, "scene.pbrt"), "w", encoding="utf-8") as file:
        file.write(HEAD.format(-0.2 * n, 0.3 * n, 0.5 * n))
        for y in range(n):
            file.writelines(f'Transform [ 1 0 0 0 0 1 0 0 0 0 1 0 {x} {y} {(x * 7 + y * 13) % 5 / 10} 1 ]\n'
                            'ObjectInstance "square"\n' for x in range(n))


if __name__ == "__main__":
    write(int(sys.argv[1]), sys.argv[2])
