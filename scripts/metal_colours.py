#!/usr/bin/env python3
"""Turns published refractive indices into the numbers of kernels/metals.h and prints them.

Usage: metal_colours.py DATABASE, the folder `database/data` of a copy of refractiveindex.info's
database (CC0).

What a renderer of spectra with a colorimetric sensor would show of a metal under D65 is, for each
channel of linear sRGB and each angle, the mean of Fresnel's reflectance weighted by D65 and the
channel's matching function. Here eta and k of a channel are those whose Fresnel curve is nearest to
that mean, in least squares over the projected solid angle. Reflectances above 1, which colours
outside of sRGB have (gold's red), become just below 1. The index of a glass is its mean weighted by
D65 and the luminous efficiency.
"""
import math
import os
import re
import sys

METALS = {
    "Ag": "main/Ag/nk/Rakic-BB.yml",
    "Al": "main/Al/nk/Cheng.yml",
    "Au": "main/Au/nk/McPeak.yml",
    "Cu": "main/Cu/nk/Hagemann.yml",
    "CuZn": "other/alloys/Cu-Zn/nk/Querry-Cu70Zn30.yml",
    "MgO": "main/MgO/nk/Stephens-vis.yml",
    "TiO2": "main/TiO2/nk/Devore-e.yml",
}
GLASSES = {
    "glass-BK7": "N-BK7", "glass-BAF10": "N-BAF10", "glass-FK51A": "N-FK51A", "glass-LASF9": "N-LASF9",
    "glass-F5": "SF5", "glass-F10": "SF10", "glass-F11": "SF11",
}
# CIE 15:2004, table T.1: relative power of D65 from 380 to 780 nm in steps of 10 nm.
D65 = [49.9755, 54.6482, 82.7549, 91.4860, 93.4318, 86.6823, 104.865, 117.008, 117.812, 114.861,
       115.923, 108.811, 109.354, 107.802, 104.790, 107.689, 104.405, 104.046, 100.000, 96.3342,
       95.7880, 88.6856, 90.0062, 89.5991, 87.6987, 83.2886, 83.6992, 80.0268, 80.2146, 82.2778,
       78.2842, 69.7213, 71.6091, 74.3490, 61.6040, 69.8856, 75.0870, 63.5927, 46.4182, 66.8054,
       63.3828]
SRGB = ((3.2404542, -1.5371385, -0.4985314),  # IEC 61966-2-1
        (-0.9692660, 1.8760108, 0.0415560),
        (0.0556434, -0.2040259, 1.0572252))
WAVELENGTHS = range(380, 781, 2)
COSINES = [(i + 0.5) / 24 for i in range(24)]


def lobe(nm, peak, below, above):
    t = (nm - peak) * (below if nm < peak else above)
    return math.exp(-0.5 * t * t)


def matching(nm):
    """CIE 1931 by Wyman, Sloan and Shirley, JCGT 2(2), 2013, equation 4."""
    return (1.056 * lobe(nm, 599.8, 0.0264, 0.0323) + 0.362 * lobe(nm, 442.0, 0.0624, 0.0374)
            - 0.065 * lobe(nm, 501.1, 0.0490, 0.0382),
            0.821 * lobe(nm, 568.8, 0.0213, 0.0247) + 0.286 * lobe(nm, 530.9, 0.0613, 0.0322),
            1.217 * lobe(nm, 437.0, 0.0845, 0.0278) + 0.681 * lobe(nm, 459.0, 0.0385, 0.0725))


def linear(table, x):
    """Linear between the rows (x, y...) of a table, constant outside."""
    if x <= table[0][0]:
        return table[0][1:]
    for low, high in zip(table, table[1:]):
        if x <= high[0]:
            t = (x - low[0]) / (high[0] - low[0])
            return tuple(a + t * (b - a) for a, b in zip(low[1:], high[1:]))
    return table[-1][1:]


def read_index(path):
    """nm -> (eta, k) of a file of the database."""
    with open(path, encoding="utf-8") as file:
        text = file.read()
    formula = re.search(r"type: formula (\d)\s+wavelength_range:.*\s+coefficients: (.*)", text)
    if formula:
        c = [float(v) for v in formula.group(2).split()] + [0.0] * 20

        def sellmeier(nm):
            square = (nm / 1000) ** 2
            if formula.group(1) == "2":
                n2 = 1 + c[0] + sum(c[i] * square / (square - c[i + 1]) for i in (1, 3, 5))
            else:  # 4
                n2 = c[0] + sum(c[i] * (nm / 1000) ** c[i + 1] / (square - c[i + 2] ** c[i + 3])
                                for i in (1, 5)) + c[9] * (nm / 1000) ** c[10]
            return math.sqrt(n2), 0.0
        return sellmeier
    rows = [[float(v) for v in line.split()] for line in text.split("data: |")[1].splitlines()
            if re.fullmatch(r"\s*[\d.eE+-]+\s+[\d.eE+-]+\s+[\d.eE+-]+\s*", line)]
    table = sorted((1000 * um, n, k) for um, n, k in rows)
    return lambda nm: linear(table, nm)


def fresnel(cosine, eta, k):
    """Reflectance of a conductor for unpolarised light (Born and Wolf, section 14.2)."""
    index = complex(eta, k)
    inner = (1 - (1 - cosine * cosine) / (index * index)) ** 0.5
    parallel = (index * cosine - inner) / (index * cosine + inner)
    perpendicular = (cosine - index * inner) / (cosine + index * inner)
    return (abs(parallel) ** 2 + abs(perpendicular) ** 2) / 2


def channel_weights():
    """For each channel of sRGB, then for luminance: weights of WAVELENGTHS, of sum 1."""
    light = [(380 + 10 * i, power) for i, power in enumerate(D65)]
    rows = []
    for mix in SRGB + ((0, 1, 0),):
        row = [linear(light, nm)[0] * sum(m * v for m, v in zip(mix, matching(nm))) for nm in WAVELENGTHS]
        rows.append([value / sum(row) for value in row])
    return rows


def fit(target):
    """(eta, k) whose Fresnel curve over COSINES is nearest to `target`, by a shrinking pattern search."""
    def error(point):
        return sum(c * (fresnel(c, *point) - min(t, 0.9999)) ** 2 for c, t in zip(COSINES, target))
    best = min(((e / 4, k / 2) for e in range(1, 16) for k in range(0, 16)), key=error)
    step = 0.25
    while step > 1e-5:
        near = [(max(1e-3, best[0] + a * step), max(0.0, best[1] + b * step))
                for a in (-1, 0, 1) for b in (-1, 0, 1)]
        found = min(near, key=error)
        if error(found) < error(best):
            best = found
        else:
            step /= 2
    return best


def main(database):
    *weights, luminance = channel_weights()
    for name, path in METALS.items():
        index = read_index(os.path.join(database, path))
        values = [index(nm) for nm in WAVELENGTHS]
        curves = [[fresnel(c, *v) for v in values] for c in COSINES]
        channels = [fit([sum(w * f for w, f in zip(row, curve)) for curve in curves]) for row in weights]
        for label, part in (("Eta", 0), ("K", 1)):
            numbers = ", ".join(f"{channel[part]:.4f}f" for channel in channels)
            print(f"inline constexpr float k{name}{label}[3] = {{{numbers}}};")
    for name, stem in GLASSES.items():
        index = read_index(os.path.join(database, "specs/schott/optical", stem + ".yml"))
        mean = sum(w * index(nm)[0] for w, nm in zip(luminance, WAVELENGTHS))
        print(f'    {{"{name}", {{{mean:.5f}f}}}},')


if __name__ == "__main__":
    if len(sys.argv) != 2 or not os.path.isdir(sys.argv[1]):
        sys.exit(__doc__)
    main(sys.argv[1])
