#!/usr/bin/env python3
"""Writes a pbrt scene that imports COUNT files, each with a wavy square of 2 N^2 triangles as text,
to measure what reading them at the same time brings.

Usage: make_imports_pbrt.py COUNT N FOLDER     8 300: 8 files of 6 MB; writes scene.pbrt, 0.pbrt, ...
"""
import math
import os
import sys

HEAD = """Film "rgb" "integer xresolution" 320 "integer yresolution" 240 "string filename" "imports.exr"
LookAt -1 -1 2  1 1 0  0 0 1
Camera "perspective" "float fov" 40
WorldBegin
LightSource "infinite" "rgb L" [ 0.6 0.8 1 ]
"""


def write_part(n, path):
    with open(path, "w", encoding="utf-8") as file:
        file.write('Shape "trianglemesh" "point3 P" [\n')
        for y in range(n + 1):
            file.writelines(f"{x / n:.6f} {y / n:.6f} {0.02 * math.sin(40 * x / n) * math.cos(30 * y / n):.6f}\n"
                            for x in range(n + 1))
        file.write('] "integer indices" [\n')
        for y in range(n):
            for a in range(y * (n + 1), y * (n + 1) + n):
                c = a + n + 1
                file.write(f"{a} {a + 1} {c}  {c} {a + 1} {c + 1}\n")
        file.write("]\n")


def write(count, n, folder):
    with open(os.path.join(folder, "scene.pbrt"), "w", encoding="utf-8") as file:
        file.write(HEAD)
        for i in range(count):
            write_part(n, os.path.join(folder, f"{i}.pbrt"))
            file.write(f'Import "{i}.pbrt"\nTranslate 0.1 0.1 0.1\n')


if __name__ == "__main__":
    write(int(sys.argv[1]), int(sys.argv[2]), sys.argv[3])
