#!/usr/bin/env python3
"""Writes a binary PLY of a wavy square of 2 N^2 triangles, to measure what large meshes take.

Usage: make_grid_ply.py N FILE     N = 2236: 10 million triangles, 190 MB
"""
import array
import math
import sys


def write(n, path):
    with open(path, "wb") as file:
        file.write(f"ply\nformat binary_little_endian 1.0\nelement vertex {(n + 1) ** 2}\nproperty float x\n"
                   f"property float y\nproperty float z\nelement face {2 * n * n}\n"
                   "property list uchar int vertex_indices\nend_header\n".encode())
        for y in range(n + 1):
            row = array.array("f")
            for x in range(n + 1):
                row.extend((x / n, y / n, 0.02 * math.sin(40 * x / n) * math.cos(30 * y / n)))
            file.write(row.tobytes())
        for y in range(n):
            row = bytearray()
            for x in range(n):
                a = y * (n + 1) + x
                c = a + n + 1
                row += b"\3" + array.array("i", (a, a + 1, c)).tobytes()
                row += b"\3" + array.array("i", (c, a + 1, c + 1)).tobytes()
            file.write(row)


if __name__ == "__main__":
    write(int(sys.argv[1]), sys.argv[2])
