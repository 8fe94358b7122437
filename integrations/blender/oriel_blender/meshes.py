# SPDX-License-Identifier: Apache-2.0
"""Meshes as binary triangle lists, one file each. The name of a file is the hash of what determines
its content, so an unchanged mesh is not written again."""
import hashlib
import os
import pathlib

import numpy

from . import mi, versions


class MeshData:
    """Evaluated arrays of one mesh: corners, normals, coordinates and triangles."""

    def __init__(self, points, corner_points, normals, uvs, triangles, labels, smooth=None):
        self.points = points                  # float32 (points, 3)
        self.corner_points = corner_points    # int32 (corners,)
        self.normals = normals                # float32 (corners, 3)
        self.uvs = uvs                        # list of float32 (corners, 2 or 3)
        self.triangles = triangles            # int32 (triangles, 3), corners
        self.labels = labels                  # int32 (triangles,), material slots
        # Smooth flags of the faces if they and the points determine the normals, else None. The
        # last bits of normals of vertices depend on the number of Blender's threads.
        self.smooth = smooth

    def inputs(self, motion):
        """Arrays that determine the file."""
        first = self.normals if self.smooth is None else self.smooth
        return [self.points, self.corner_points, first, *self.uvs, self.triangles, self.labels,
                *([] if motion is None else [motion])]


# Members of attribute values and the number of their components.
ATTRIBUTES = {"FLOAT": ("value", 1), "INT": ("value", 1), "INT8": ("value", 1),
              "BOOLEAN": ("value", 1), "FLOAT_VECTOR": ("vector", 3), "FLOAT2": ("vector", 2),
              "FLOAT_COLOR": ("color", 4), "BYTE_COLOR": ("color", 4)}


def colour_layer(mesh, name):
    """Linear vertex colours, or values of another attribute, of the corners by name; None if there
    are none."""
    layer = mesh.attributes.get(name) if name else mesh.color_attributes.active_color
    if layer is None or not len(layer.data) or layer.data_type not in ATTRIBUTES:
        return None
    member, width = ATTRIBUTES[layer.data_type]
    kind = {"INT": numpy.int32, "INT8": numpy.int32, "BOOLEAN": bool}.get(layer.data_type,
                                                                         numpy.float32)
    values = numpy.empty(len(layer.data) * width, kind)
    layer.data.foreach_get(member, values)
    values = values.reshape(-1, width).astype(numpy.float32)[:, :3]
    if width == 1:
        values = numpy.repeat(values, 3, axis=1)
    elif width == 2:
        values = numpy.pad(values, ((0, 0), (0, 1)))
    if layer.domain == "CORNER":
        return values
    if layer.domain == "FACE":
        return numpy.repeat(values, versions.face_sizes(mesh), axis=0)
    if layer.domain != "POINT":
        return None
    corners = numpy.empty(len(mesh.loops), numpy.int32)
    mesh.loops.foreach_get("vertex_index", corners)
    return values[corners]


def points_of(mesh):
    points = numpy.empty(len(mesh.vertices) * 3, numpy.float32)
    mesh.vertices.foreach_get("co", points)
    return points.reshape(-1, 3)


def read(mesh, spaces=()):
    """Reads an evaluated mesh; None if it has no triangles.

    spaces: texture spaces by name, each ("uv", layer) or ("colour", attribute).
    """
    mesh.calc_loop_triangles()
    count = len(mesh.loop_triangles)
    if count == 0:
        return None
    normals = versions.split_normals(mesh)
    mesh.calc_loop_triangles()
    corners = numpy.empty(len(mesh.loops), numpy.int32)
    mesh.loops.foreach_get("vertex_index", corners)
    triangles = numpy.empty(count * 3, numpy.int32)
    mesh.loop_triangles.foreach_get("loops", triangles)
    slots = numpy.empty(len(mesh.polygons), numpy.int32)
    mesh.polygons.foreach_get("material_index", slots)
    labels = slots[versions.triangle_polygons(mesh)]
    uvs = [space_values(mesh, kind, name) for kind, name in spaces]
    smooth = versions.smooth_faces(mesh) if versions.has_vertex_normals(mesh) else None
    return MeshData(points_of(mesh), corners, normals, uvs, triangles.reshape(-1, 3), labels,
                    smooth)


def space_values(mesh, kind, name):
    """Coordinates of the corners. Missing layers and attributes are zero."""
    if kind == "colour":
        colours = colour_layer(mesh, name)
        return numpy.zeros((len(mesh.loops), 3), numpy.float32) if colours is None else colours
    if isinstance(name, int):  # the number of a map
        layer = mesh.uv_layers[name] if name < len(mesh.uv_layers) else None
    else:
        layer = mesh.uv_layers.get(name) if name else None
    if layer is None:
        layer = next((l for l in mesh.uv_layers if l.active_render), None)
    if layer is None:
        return numpy.zeros((len(mesh.loops), 2), numpy.float32)
    return versions.uv_layer(layer)


def merged(data, motion):
    """Columns of the vertices after merging equal corners of a point, and the new corner indices."""
    columns = [data.points[data.corner_points], data.normals] + data.uvs
    if motion is not None:
        columns.append(motion[data.corner_points])
    count = len(data.corner_points)
    first = numpy.zeros(len(data.points), numpy.int64)
    first[data.corner_points[::-1]] = numpy.arange(count - 1, -1, -1)
    candidate = first[data.corner_points]
    equal = numpy.ones(count, bool)
    for column in columns[1:2 + len(data.uvs)]:
        for k in range(column.shape[1]):
            values = column[:, k]
            equal &= values == values[candidate]
    keep = numpy.where(equal, candidate, numpy.arange(count))
    used = keep == numpy.arange(count)
    index = numpy.cumsum(used) - 1
    return [column[used] for column in columns], index[keep]


def trilist(data, motion=None):
    """The header, vertex bytes, corner bytes and label bytes of a binary triangle list."""
    columns, index = merged(data, motion)
    fields = ["p", "n"]
    if data.uvs:
        fields.append("t " + " ".join(str(uv.shape[1]) for uv in data.uvs))
    if motion is not None:
        fields.append(f"m {motion.shape[1] // 3}")
    vertices = numpy.concatenate(columns, axis=1).astype(">f4")
    corners = index[data.triangles].astype(">u4")
    text = (f"trilist vertex {len(vertices)} {' '.join(fields)}\n"
            f"  triangle {len(corners)}\n")
    return text, vertices.tobytes(), corners.tobytes(), data.labels.astype(">u4").tobytes()


class MeshFolder:
    """Writes objects into a folder; each distinct content once."""

    def __init__(self, folder):
        self.folder = pathlib.Path(folder)
        self.folder.mkdir(parents=True, exist_ok=True)
        self.written = 0
        self._used = set()
        self._used_before = set()

    def store(self, chunks, kind="mesh"):
        """Writes the chunks unless a file of that content exists; returns its path."""
        return self._store(chunks, lambda: chunks, kind)

    def _store(self, inputs, chunks_of, kind):
        """Writes chunks_of() unless a file of these inputs exists; returns its path."""
        digest = hashlib.blake2b(digest_size=16)
        for data in inputs:
            digest.update(data)
        path = self.folder / f"{kind}-{digest.hexdigest()}.mi"
        self._used.add(path)
        if not path.exists():
            chunks = chunks_of()
            part = path.with_suffix(".part")
            with open(part, "wb") as file:
                file.writelines(chunks)
            os.replace(part, path)
            self.written += 1
        return path

    def add_mesh(self, name, data, motion=None):
        def chunks():
            head, vertices, corners, labels = trilist(data, motion)
            start = (f"object {mi.quoted(name)} visible on shadow on trace on tagged on\n{head}"
                     "  scalar `")
            return [start.encode(), vertices, b"`\n  integer `", corners, b"`\n  integer `",
                    labels, b"`\nend trilist\nend object\n"]
        arrays = data.inputs(motion)
        shapes = repr([(a.shape, a.dtype.str) for a in arrays])
        inputs = [f"{name}\0{shapes}".encode(), *(numpy.ascontiguousarray(a) for a in arrays)]
        return self._store(inputs, chunks, "mesh")

    def keep(self, path):
        """Marks a file of an earlier export as used."""
        self._used.add(pathlib.Path(path))

    def remove_unused(self):
        """Deletes files that the last two exports did not use, and starts a new export."""
        for path in self.folder.glob("*.mi"):
            if path not in self._used and path not in self._used_before:
                path.unlink(missing_ok=True)
        self._used_before, self._used = self._used, set()
