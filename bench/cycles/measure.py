# SPDX-License-Identifier: Apache-2.0
"""Errors of pictures, and processor time, wall-clock time and peak memory of programs."""
import json
import subprocess
import sys

import numpy
import OpenImageIO as oiio

LEFT_OUT = .001  # share of the pixels without which errors are computed

# A child's peak memory starts with that of the process that starts it, so a small one does.
LAUNCHER = """
import json, os, subprocess, sys, time
begin = time.time()
child = subprocess.Popen(sys.argv[1:], stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
text = child.stdout.read().decode(errors="replace")
_, status, usage = os.wait4(child.pid, 0)
print(json.dumps({"status": status, "wall": time.time() - begin, "text": text,
                  "seconds": usage.ru_utime + usage.ru_stime, "memory": usage.ru_maxrss / 1024}))
"""


def run(command):
    """Processor and wall-clock seconds, memory in MB, text, and lines of JSON of a program."""
    result = json.loads(subprocess.run([sys.executable, "-S", "-c", LAUNCHER, *command], check=True,
                                       capture_output=True, text=True).stdout)
    if result["status"]:
        raise SystemExit(" ".join(command) + "\n" + result["text"][-3000:])
    result["events"] = [json.loads(line) for line in result["text"].splitlines()
                        if line.startswith("{") and line.endswith("}")]
    return result


def picture(path):
    # Not an ImageBuf: its cache takes a file that was written again within a second for the old one.
    file = oiio.ImageInput.open(path)
    return file.read_image(oiio.FLOAT)[..., :3].astype(numpy.float64)


def save(image, path):
    kept = oiio.ImageBuf(image.astype(numpy.float32))
    kept.write(path)


def preview(images, path):
    """Pictures side by side, exposed alike."""
    row = numpy.concatenate(images, axis=1) * (.35 / numpy.median(images[0].mean(axis=2)))
    shown = numpy.where(row < .0031308, 12.92 * row,
                        1.055 * numpy.maximum(row, 1e-9) ** (1 / 2.4) - .055)
    save(shown.clip(0, 1), path)


def error(image, reference, level=None, left_out=LEFT_OUT):
    """Mean squared error relative to a level (the reference), without the pixels where it is largest."""
    level = reference if level is None else level
    squares = ((image - reference) / (level + .01 * level.mean())) ** 2
    squares = numpy.sort(squares.mean(axis=2).ravel())
    return squares[:int(len(squares) * (1 - left_out))].mean()


def noise(pictures, level):
    """Half of the mean squared difference of pictures, relative to a level, without .2 % of the pixels."""
    return numpy.mean([error(a, b, level, .002) / 2 for i, a in enumerate(pictures) for b in pictures[:i]])


def blocks(image):
    h, w = (n // 8 * 8 for n in image.shape[:2])
    return image[:h, :w].reshape(h // 8, 8, w // 8, 8, 3).mean(axis=(1, 3))


def difference(image, reference):
    """Ratio of the means, and mean absolute difference of blocks of 8 x 8 relative to the mean."""
    off = numpy.abs(blocks(image) - blocks(reference)).mean() / reference.mean()
    return image.mean() / reference.mean(), off


def block_bias(images, reference):
    """Root mean square of the difference of blocks without its noise, relative to the mean.

    The product of the differences of two independent pictures has the square of the bias as its mean.
    """
    a, b = (blocks(i) - blocks(reference) for i in images[:2])
    return numpy.sqrt(max((a * b).mean(), 0)) / reference.mean()
