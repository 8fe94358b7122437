# SPDX-License-Identifier: Apache-2.0
"""A photographer's studio as a latitude-longitude picture in Radiance format."""
import math

WIDTH, HEIGHT = 1024, 512
# Soft boxes: azimuth and height of the middle, half sizes in degrees, panes, colour.
BOXES = [(58, 34, 26, 24, 3, (3.4, 3.3, 3.1)), (-62, 28, 10, 30, 1, (1.7, 1.85, 2.1)),
         (172, 24, 30, 12, 1, (1.3, 1.25, 1.2))]


def studio(azimuth, height):
    """Radiance from a direction, degrees; azimuth 0 is behind the table, the camera at 180."""
    up = math.sin(math.radians(height))
    if up >= 0:
        base = [0.2 + 0.2 * up, 0.2 + 0.215 * up, 0.2 + 0.24 * up]
    else:
        base = [0.1 + 0.1 * math.exp(6 * up)] * 3
        base = [b * tint for b, tint in zip(base, (1.1, 0.97, 0.82))]
    for middle, lift, wide, high, panes, colour in BOXES:
        x = ((azimuth - middle + 180) % 360 - 180) / wide
        y = (height - lift) / high
        share = edge(1 - abs(x), wide) * edge(1 - abs(y), high)
        if panes > 1:  # bars between the panes
            bar = abs(((x + 1) * panes / 2 + 0.5) % 1 - 0.5) * 2 / panes
            share *= edge(bar - 0.03, wide) * edge(abs(y) - 0.03, high)
        base = [b + share * (c - b) for b, c in zip(base, colour)]
    return base


def edge(inside, half):
    """0 to 1 over one degree at the edge of a box."""
    return min(1.0, max(0.0, inside * half + 0.5))


def rgbe(colour):
    top = max(colour)
    if top < 1e-20:
        return (0, 0, 0, 0)
    fraction, exponent = math.frexp(top)
    return (*(int(c * fraction * 256 / top) for c in colour), exponent + 128)


def packed(values):
    """Run lengths of one channel of one line."""
    out, n = bytearray(), 0
    while n < len(values):
        run = 1
        while n + run < len(values) and run < 127 and values[n + run] == values[n]:
            run += 1
        if run > 3:
            out += bytes((128 + run, values[n]))
        else:
            run = 1
            while n + run < len(values) and run < 128 and len(set(values[n + run:n + run + 4])) > 1:
                run += 1
            out += bytes((run, *values[n:n + run]))
        n += run
    return bytes(out)


def write(path):
    with open(path, "wb") as out:
        out.write(b"#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y %d +X %d\n" % (HEIGHT, WIDTH))
        for row in range(HEIGHT):
            height = 90 - 180 * (row + 0.5) / HEIGHT
            line = [rgbe(studio(360 * (x + 0.5) / WIDTH, height)) for x in range(WIDTH)]
            out.write(bytes((2, 2, WIDTH >> 8, WIDTH & 255)))
            for channel in zip(*line):
                out.write(packed(channel))
