#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Writes the textures of templates.mi as small EXR files beside this script.

    python3 data/textures/generate.py

Every texture covers one unit of texture coordinates and tiles. Colours are linear reflectances.
The bump textures (grain, waves) hold signed changes of the normal. They are 0 at the corner, where
objects without texture coordinates look them up, so that those stay smooth.
"""
import math
import pathlib
import random

from exr import write_exr

HERE = pathlib.Path(__file__).resolve().parent


def mix(a, b, t):
    return tuple(x + (y - x) * t for x, y in zip(a, b)) if isinstance(a, tuple) else a + (b - a) * t


def smooth(low, high, x):
    t = max(0.0, min(1.0, (x - low) / (high - low)))
    return t * t * (3 - 2 * t)


def scaled(colour, s):
    return tuple(c * s for c in colour)


class Noise:
    """Value noise of a unit square that tiles; 0 to 1."""

    def __init__(self, columns, rows, seed):
        dice = random.Random(seed)
        self.columns, self.rows = columns, rows
        self.lattice = [[dice.random() for _ in range(columns)] for _ in range(rows)]

    def __call__(self, u, v):
        x, y = u * self.columns, v * self.rows
        i, j = math.floor(x), math.floor(y)
        s, t = smooth(0, 1, x - i), smooth(0, 1, y - j)
        low, high = self.lattice[j % self.rows], self.lattice[(j + 1) % self.rows]
        a, b = i % self.columns, (i + 1) % self.columns
        return mix(mix(low[a], low[b], s), mix(high[a], high[b], s), t)


class Fractal:
    """Octaves of noise, each finer by 2 and weaker by `gain`; 0 to 1."""

    def __init__(self, columns, rows, octaves, seed, gain=0.5):
        self.layers = [(gain ** k, Noise(columns << k, rows << k, seed + k))
                       for k in range(octaves)]
        self.total = sum(weight for weight, _ in self.layers)

    def __call__(self, u, v):
        return sum(weight * noise(u, v) for weight, noise in self.layers) / self.total


def wood():
    """Six oak boards along u, each as long as the tile; dark joints."""
    grain, figure = Fractal(4, 96, 3, 1), Fractal(3, 12, 3, 11)
    pores, warp = Noise(24, 256, 21), Fractal(3, 6, 2, 31)
    dice = random.Random(3)
    boards = [(dice.random(), 0.82 + 0.36 * dice.random(), dice.random()) for _ in range(6)]
    light, dark = (0.44, 0.265, 0.125), (0.15, 0.072, 0.028)

    def colour(u, v):
        row = min(5, int(v * 6))
        joint, tone, shift = boards[row]
        across, along = v * 6 - row, (u - joint) % 1.0
        bend = v + 0.05 * (warp(u + shift, v) - 0.5)
        rings = 0.5 + 0.5 * math.sin(2 * math.pi * (9 * figure(u + shift, bend) + 3 * across))
        t = 0.45 * grain(u + shift, bend) + 0.3 * rings * figure(u, v) + 0.1
        t += 0.25 * smooth(0.72, 0.95, pores(u + shift, v))
        gap = min(across, 1 - across) / 6
        edge = min(gap, 0.8 * min(along, 1 - along))
        face = scaled(mix(light, dark, min(1.0, t)), tone)
        return scaled(face, 0.15 + 0.85 * smooth(0, 0.004, edge))

    return 512, colour


def linoleum():
    """Marbled grey-green in streaks along u."""
    warp, clouds, fine = Fractal(3, 3, 3, 41), Fractal(6, 18, 4, 51), Fractal(40, 80, 2, 61)
    low, middle, high = (0.15, 0.225, 0.185), (0.2, 0.275, 0.225), (0.3, 0.355, 0.285)

    def colour(u, v):
        w = warp(u, v) - 0.5
        t = 0.7 * clouds(u + 0.25 * w, v + 0.3 * w) + 0.3 * fine(u, v)
        base = mix(low, middle, smooth(0.3, 0.5, t))
        return mix(base, high, smooth(0.5, 0.68, t))

    return 384, colour


def stone():
    """Limestone: warm clouds, fine grains, a few dark pores."""
    clouds, grains, pores = Fractal(4, 4, 5, 71), Noise(150, 150, 81), Fractal(40, 40, 2, 91)

    def colour(u, v):
        base = mix((0.36, 0.315, 0.25), (0.6, 0.555, 0.475), smooth(0.3, 0.7, clouds(u, v)))
        base = scaled(base, 0.82 + 0.36 * grains(u, v))
        return scaled(base, 1 - 0.55 * smooth(0.7, 0.82, pores(u, v)))

    return 384, colour


def brick():
    """Running bond: six courses of two bricks, joints of 1/45 of the tile."""
    clouds, grains, ragged = Fractal(10, 10, 4, 101), Noise(120, 120, 111), Fractal(24, 24, 2, 121)
    dice = random.Random(9)
    tones = [[(dice.random(), 0.72 + 0.5 * dice.random()) for _ in range(2)] for _ in range(6)]
    red, brown, mortar = (0.4, 0.125, 0.07), (0.25, 0.1, 0.07), (0.5, 0.465, 0.41)

    def colour(u, v):
        row = min(5, int(v * 6))
        x = (u * 2 + 0.5 * (row % 2)) % 2.0
        hue, tone = tones[row][int(x)]
        edge = min(min(x % 1, 1 - x % 1) / 2, min(v * 6 % 1, 1 - v * 6 % 1) / 6)
        edge += 0.006 * (ragged(u, v) - 0.5)
        face = scaled(mix(red, brown, hue), tone * (0.6 + 0.8 * clouds(u, v)))
        face = scaled(face, 0.85 + 0.3 * grains(u, v))
        joint = scaled(mortar, 0.75 + 0.5 * grains(v, u) * clouds(u, v))
        return mix(joint, face, smooth(0.009, 0.014, edge))

    return 384, colour


def brushed():
    """Streaks along u between middle grey and white."""
    fine, coarse, breaks = Noise(5, 256, 131), Noise(3, 90, 141), Noise(14, 256, 151)

    def colour(u, v):
        t = 0.55 * fine(u, v) + 0.2 * coarse(u, v) + 0.25 * breaks(u, v)
        grey = 0.5 + 0.5 * smooth(0.2, 0.8, t)
        return (grey, grey, grey)

    return 256, colour


def away_from_corner(u, v):
    du, dv = min(u, 1 - u), min(v, 1 - v)
    return smooth(0.008, 0.03, math.hypot(du, dv))


def grain():
    """Change of the normal of a rough surface, alike in all directions of space."""
    axes = [(Fractal(32, 32, 3, seed, 0.7)) for seed in (161, 171, 181)]

    def change(u, v):
        fade = 2 * away_from_corner(u, v)
        return tuple(fade * (noise(u, v) - 0.5) for noise in axes)

    return 256, change


def waves():
    """Slope of waves along x and across, for horizontal water with z or y up."""
    dice = random.Random(5)
    trains = []
    for _ in range(60):
        length = dice.uniform(1.5, 5.0) ** 2
        heading = dice.gauss(0.6, 0.8)
        kx, ky = round(length * math.cos(heading)), round(length * math.sin(heading))
        if kx or ky:
            trains.append((kx, ky, dice.uniform(0, 2 * math.pi), 1 / math.hypot(kx, ky) ** 0.5))
    norm = math.sqrt(sum(w * w for *_, w in trains) / 2)

    def change(u, v):
        x = y = 0.0
        for kx, ky, phase, weight in trains:
            slope = weight * math.cos(2 * math.pi * (kx * u + ky * v) + phase)
            k = math.hypot(kx, ky)
            x, y = x + slope * kx / k, y + slope * ky / k
        fade = away_from_corner(u, v) / norm
        return (fade * x, fade * y, fade * y)

    return 256, change


def main():
    for make in (wood, linoleum, stone, brick, brushed, grain, waves):
        size, value = make()

        def pixel(x, y, size=size, value=value):
            # v grows upward. 8 bits are enough and pack well.
            return [round(c * 256) / 256 for c in value((x + 0.5) / size, 1 - (y + 0.5) / size)]

        write_exr(HERE / f"{make.__name__}.exr", size, size, pixel)


if __name__ == "__main__":
    main()
