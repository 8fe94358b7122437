# SPDX-License-Identifier: Apache-2.0
"""Reads uncompressed OpenEXR scan line files, as `oriel render --exr float,none` writes them."""
import struct

import numpy

TYPES = {0: ">u4", 1: "<f2", 2: "<f4"}


class Picture:
    """Channels by name, the data window and the text attributes. Row 0 is the bottom row."""

    def __init__(self, channels, window, attributes):
        self.channels = channels
        self.window = window
        self.attributes = attributes

    @property
    def size(self):
        x0, y0, x1, y1 = self.window
        return x1 - x0 + 1, y1 - y0 + 1

    def stack(self, names):
        """The channels side by side, float32 of shape (pixels, channels); None if one is missing."""
        if any(name not in self.channels for name in names):
            return None
        planes = [self.channels[name].ravel() for name in names]
        return numpy.ascontiguousarray(numpy.stack(planes, axis=1))


def _string(data, at):
    end = data.index(b"\0", at)
    return data[at:end].decode("utf-8", "replace"), end + 1


def _channel_list(data):
    at, channels = 0, []
    while data[at] != 0:
        name, at = _string(data, at)
        kind = struct.unpack_from("<i", data, at)[0]
        if kind not in (0, 1, 2):
            raise ValueError("unknown type of a channel")
        channels.append((name, "<u4" if kind == 0 else TYPES[kind]))
        at += 16
    return channels


def _header(data):
    if len(data) < 8 or data[:4] != b"\x76\x2f\x31\x01":
        raise ValueError("not an OpenEXR file")
    if struct.unpack_from("<I", data, 4)[0] & 0x1E00 & ~0x400:
        raise ValueError("tiled and deep files are unsupported")
    at, attributes = 8, {}
    while data[at] != 0:
        name, at = _string(data, at)
        kind, at = _string(data, at)
        size = struct.unpack_from("<i", data, at)[0]
        if size < 0 or at + 4 + size > len(data):
            raise ValueError("the header is truncated")
        attributes[name] = (kind, data[at + 4:at + 4 + size])
        at += 4 + size
    return attributes, at + 1


def read(path):
    """Reads a file. Raises ValueError if it is damaged, compressed or not yet complete."""
    with open(path, "rb") as file:
        data = file.read()
    try:
        attributes, at = _header(data)
        window = struct.unpack("<4i", attributes["dataWindow"][1])
        channels = _channel_list(attributes["channels"][1])
        if attributes["compression"][1] != b"\0":
            raise ValueError("the file is compressed")
    except (IndexError, KeyError, struct.error) as error:
        raise ValueError(f"the header is damaged: {error}") from error
    width, height = window[2] - window[0] + 1, window[3] - window[1] + 1
    if width <= 0 or height <= 0 or width > 1 << 20 or height > 1 << 20:
        raise ValueError("the data window is invalid")
    row = numpy.dtype([("y", "<i4"), ("size", "<i4")] +
                      [(name, kind, (width,)) for name, kind in channels])
    at += 8 * height
    if len(data) < at + row.itemsize * height:
        raise ValueError("the file is truncated")
    rows = numpy.frombuffer(data, row, height, at)
    order = numpy.argsort(rows["y"])[::-1]
    planes = {name: rows[name][order].astype(numpy.float32) for name, _ in channels}
    texts = {name: value.decode("utf-8", "replace")
             for name, (kind, value) in attributes.items() if kind == "string"}
    return Picture(planes, window, texts)
