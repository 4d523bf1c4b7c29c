#!/usr/bin/env python3
"""Integrates glTF's sheen over the hemisphere and prints the table of kernels/sheen_albedo.h.

Usage: sheen_albedo.py

KHR_materials_sheen: D and V are Estevez and Kulla's ("Production Friendly Microfacet Sheen BRDF",
2017), alpha the square of the roughness. Rows are roughness, columns the root of the cosine of the view,
both from the middle of the first to that of the last of SIZE equal parts of [0, 1].
"""
import math

SIZE = 16
LEAST_ROUGHNESS = 0.07


def shadowing(cosine, alpha):
    """Their fit of Smith's Lambda (table 1 and section 2)."""
    t = (1.0 - alpha) ** 2
    a, b, c, d, e = ((1.0 - t) * rough + t * smooth for rough, smooth in (
        (21.5473, 25.3245), (3.82987, 3.32435), (0.19823, 0.16801), (-1.97760, -1.27393),
        (-4.32054, -4.85967)))

    def curve(x):
        return a / (1.0 + b * x ** c) + d * x + e
    if cosine < 0.5:
        return math.exp(curve(cosine))
    return math.exp(2.0 * curve(0.5) - curve(1.0 - cosine))


def sheen(view, light, half, alpha):
    sine = math.sqrt(max(0.0, 1.0 - half * half))
    density = (2.0 + 1.0 / alpha) * sine ** (1.0 / alpha) / (2.0 * math.pi)
    return density / ((1.0 + shadowing(view, alpha) + shadowing(light, alpha)) * 4.0 * light * view)


def albedo(view, roughness, rings=192, turns=192):
    """The mean of many directions, equal in solid angle."""
    total = 0.0
    alpha = max(roughness, LEAST_ROUGHNESS) ** 2
    x = math.sqrt(1.0 - view * view)
    for i in range(rings):
        light = (i + 0.5) / rings
        sine = math.sqrt(1.0 - light * light)
        for k in range(turns):
            turn = math.pi * (k + 0.5) / turns  # the other half is the same
            lx, ly = sine * math.cos(turn), sine * math.sin(turn)
            half = (view + light) / math.sqrt((x + lx) ** 2 + ly * ly + (view + light) ** 2)
            total += sheen(view, light, half, alpha) * light
    return total * 2.0 * math.pi / (rings * turns)


def main():
    for row in range(SIZE):
        values = [albedo(((column + 0.5) / SIZE) ** 2, (row + 0.5) / SIZE) for column in range(SIZE)]
        for part in (values[:8], values[8:]):
            print("    " + ", ".join(f"{value:.4f}f" for value in part) + ",")


if __name__ == "__main__":
    main()
