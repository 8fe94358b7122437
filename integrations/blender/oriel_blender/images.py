# SPDX-License-Identifier: Apache-2.0
"""Image data-blocks as files. Images without a usable file are saved into the scene's folder."""
import hashlib
import os
import re

import bpy
import numpy

from . import mi, versions

READABLE = {".png", ".jpg", ".jpeg", ".tif", ".tiff", ".exr", ".hdr", ".tga", ".bmp", ".webp", ".jp2",
            ".dpx"}

MAX_TILES = 100
FLOATING = {".exr", ".hdr"}  # files without a curve


def sequence_frame(user, frame):
    """The number of the file of a sequence in a frame of the scene."""
    count = max(user.frame_duration, 1)
    number = frame - user.frame_start + 1
    if user.use_cyclic:
        number = (number - 1) % count + 1
    return min(max(number, 0), count) + user.frame_offset


def frame_path(path, frame):
    """The path of a frame: the last number of the file name is that of the frame."""
    folder, name = os.path.split(path)
    stem, suffix = os.path.splitext(name)
    parts = re.match(r"(.*?)(\d+)(\D*)$", stem)
    if parts is None:
        return path
    digits = str(max(frame, 0)).zfill(len(parts[2]))
    return os.path.join(folder, parts[1] + digits + parts[3] + suffix)


class Images:
    """Texture elements of one scene, one for each image and reading."""

    def __init__(self, out, folder, report):
        self.out = out
        self.folder = str(folder)
        self.report = report
        self.frame = 1  # of the scene, for sequences
        self._textures = {}

    def tiles(self, image):
        """Numbers of the UDIM tiles; [None] of an image without tiles."""
        if image is None or image.source != "TILED":
            return [None]
        return sorted(tile.number for tile in image.tiles)[:MAX_TILES]

    @staticmethod
    def is_encoded(image):
        """Whether the values of the file are encoded by the sRGB curve."""
        if image is None or image.colorspace_settings.name in versions.linear_spaces():
            return False
        return not image.is_float and os.path.splitext(image.filepath)[1].lower() not in FLOATING

    def texture(self, image, material, node, vector=False, tile=None, coloured=True, user=None):
        """The name of the texture element, or None if the image cannot be read. Encoded values, see
        is_encoded(), are decoded by gamma 2.2, before pixels are averaged.

        coloured: colours are those of opaque pixels; else they are multiplied by alpha. user: the image
        user of the node, for the frame of a sequence.
        """
        if image is None:
            self.report(f'material "{material}": node "{node}" has no image')
            return None
        space = image.colorspace_settings.name
        kind = "color" if self.is_encoded(image) and not vector else "vector"
        frame = sequence_frame(user, self.frame) if image.source == "SEQUENCE" and user else None
        key = image.name_full, coloured, tile, kind, frame
        if key not in self._textures:
            path = self.path_of(image, material, node, tile, frame)
            if path and tile is None and not vector and frame is None:
                path = self.with_alpha(image, path, coloured)
            name = None
            if path:
                if space not in versions.linear_spaces() | {"sRGB"}:
                    self.report(f'image "{image.name}": the colour space {space} is read as sRGB')
                suffix = f".{tile}" if tile else ""
                name = self.out.names.unique(image.name + suffix)
                self.out.add(f"{kind} texture {mi.quoted(name)} {mi.quoted(path)}\n")
            self._textures[key] = name
        return self._textures[key]

    def path_of(self, image, material, node, tile, frame=None):
        if image.source == "TILED" and tile is None:
            tile = 1001
            self.report(f'material "{material}": node "{node}": only the first tile of '
                        f'"{image.name}" is used')
        path = bpy.path.abspath(image.filepath, library=image.library)
        if tile:
            u, v = (tile - 1001) % 10, (tile - 1001) // 10
            path = path.replace("<UDIM>", str(tile)).replace("<UVTILE>", f"u{u + 1}_v{v + 1}")
        if frame is not None:
            path = frame_path(path, frame)
        if image.source == "MOVIE":
            self.report(f'material "{material}": node "{node}": "{image.name}" is a movie, which is '
                        "unsupported")
            return None
        unchanged = image.source in {"FILE", "TILED", "SEQUENCE"} and not image.packed_file and \
            not image.is_dirty
        if unchanged and os.path.splitext(path)[1].lower() in READABLE and os.path.isfile(path):
            return os.path.abspath(path)
        # The size is 0 if Blender cannot read the file.
        if image.source in {"FILE", "TILED", "SEQUENCE"} and not image.packed_file and \
                (frame is not None or not image.size[0]):
            self.report(f'material "{material}": node "{node}": the file of image "{image.name}" '
                        f"is missing: {path}")
            return None
        if image.source == "TILED":
            self.report(f'material "{material}": node "{node}": tile {tile} of "{image.name}" is '
                        f"missing, or is packed into the file: {path}")
            return None
        return self.save(image)

    def with_alpha(self, image, path, coloured):
        """The path of the image, or of a copy whose colours are multiplied by alpha, or divided.

        Blender has the pixels of integer files with straight alpha and those of float files
        multiplied by it.
        """
        if image.channels < 4 or image.alpha_mode in {"NONE", "CHANNEL_PACKED"} or \
                image.is_float != coloured or not image.has_data and not image.size[0]:
            return path
        pixels = numpy.empty(len(image.pixels), numpy.float32)
        image.pixels.foreach_get(pixels)
        pixels = pixels.reshape(-1, 4)
        alpha = pixels[:, 3:]
        if len(pixels) == 0 or alpha.min() >= 1:
            return path
        if coloured:
            numpy.divide(pixels[:, :3], alpha, out=pixels[:, :3], where=alpha > 1e-6)
        else:
            pixels[:, :3] *= alpha
            pixels[:, 3] = 1
        return self.save_pixels(image, pixels.ravel(), "colour" if coloured else "premultiplied")

    def save(self, image):
        """Saves the pixels with their values, once for each content."""
        digest = hashlib.blake2b(digest_size=8)
        digest.update(repr((image.name_full, tuple(image.size))).encode())
        if image.packed_file:
            digest.update(image.packed_file.data)
            path = os.path.join(self.folder, f"image-{digest.hexdigest()}")
            suffix = os.path.splitext(image.filepath)[1].lower()
            path += suffix if suffix in READABLE else ".png"
            if suffix in READABLE and not image.is_dirty:
                if not os.path.exists(path):
                    with open(path, "wb") as file:
                        file.write(image.packed_file.data)
                return path
        pixels = numpy.empty(len(image.pixels), numpy.float32)
        image.pixels.foreach_get(pixels)
        return self.save_pixels(image, pixels)

    def save_pixels(self, image, pixels, kind="image"):
        digest = hashlib.blake2b(digest_size=8)
        digest.update(repr((image.name_full, tuple(image.size))).encode())
        digest.update(pixels.tobytes())
        path = os.path.join(self.folder, f"{kind}-{digest.hexdigest()}")
        path += ".exr" if image.is_float else ".png"
        if os.path.exists(path):
            return path
        copy = bpy.data.images.new("oriel.copy", *image.size, alpha=True, float_buffer=image.is_float)
        try:
            # Without a colour space of its own the copy would be encoded when it is saved.
            copy.colorspace_settings.name = "Non-Color" if image.is_float else \
                image.colorspace_settings.name
            copy.pixels.foreach_set(pixels)
            copy.file_format = "OPEN_EXR" if image.is_float else "PNG"
            copy.filepath_raw = path
            copy.save()
        finally:
            bpy.data.images.remove(copy)
        return path
