# SPDX-License-Identifier: Apache-2.0
"""Image data-blocks as files. Images without a usable file are saved into the scene's folder."""
import hashlib
import os

import bpy
import numpy

from . import mi, versions

READABLE = {".png", ".jpg", ".jpeg", ".tif", ".tiff", ".exr", ".hdr", ".tga", ".bmp", ".webp", ".jp2",
            ".dpx"}

MAX_TILES = 100


class Images:
    """Texture elements of one scene, one for each image and reading."""

    def __init__(self, out, folder, report):
        self.out = out
        self.folder = str(folder)
        self.report = report
        self._textures = {}

    def tiles(self, image):
        """Numbers of the UDIM tiles; [None] of an image without tiles."""
        if image is None or image.source != "TILED":
            return [None]
        return sorted(tile.number for tile in image.tiles)[:MAX_TILES]

    @staticmethod
    def is_encoded(image):
        """Whether the values of the file are encoded by the sRGB curve."""
        return image is not None and not image.is_float and \
            image.colorspace_settings.name not in versions.linear_spaces()

    def texture(self, image, material, node, vector=False, tile=None, coloured=True):
        """The name of the texture element, or None if the image cannot be read. Encoded values, see
        is_encoded(), are decoded by gamma 2.2, before pixels are averaged.

        coloured: colours are those of opaque pixels; else they are multiplied by alpha.
        """
        if image is None:
            self.report(f'material "{material}": node "{node}" has no image')
            return None
        space = image.colorspace_settings.name
        kind = "color" if self.is_encoded(image) and not vector else "vector"
        key = image.name_full, coloured, tile, kind
        if key not in self._textures:
            path = self.path_of(image, material, node, tile)
            if path and tile is None and not vector:
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

    def path_of(self, image, material, node, tile):
        if image.source == "TILED" and tile is None:
            tile = 1001
            self.report(f'material "{material}": node "{node}": only the first tile of '
                        f'"{image.name}" is used')
        path = bpy.path.abspath(image.filepath, library=image.library)
        if tile:
            u, v = (tile - 1001) % 10, (tile - 1001) // 10
            path = path.replace("<UDIM>", str(tile)).replace("<UVTILE>", f"u{u + 1}_v{v + 1}")
        unchanged = image.source in {"FILE", "TILED"} and not image.packed_file and not image.is_dirty
        if unchanged and os.path.splitext(path)[1].lower() in READABLE and os.path.isfile(path):
            return os.path.abspath(path)
        if not image.has_data and image.source in {"FILE", "TILED", "SEQUENCE", "MOVIE"} and \
                not image.packed_file:
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
