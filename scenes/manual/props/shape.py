# SPDX-License-Identifier: Apache-2.0
"""Shapes of the props: faces whose corners know point, normal and texture coordinates.

Built with z up as in scenes/interior/mesh.py; written with y up.
"""
import math
import pathlib
import sys

HERE = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parents[1] / "interior"))
sys.dont_write_bytecode = True
from mesh import area_vector, corner_normals, cross, number, subtract, unit, write_packed  # noqa: E402


def spline(points, steps):
    """Points of a Catmull-Rom curve through `points`, `steps` to each span."""
    ends = [points[0], *points, points[-1]]
    curve = []
    for a, b, c, d in zip(ends, ends[1:], ends[2:], ends[3:]):
        for k in range(steps):
            t = k / steps
            curve.append(tuple(
                0.5 * (2 * q + (r - p) * t + (2 * p - 5 * q + 4 * r - s) * t * t
                       + (3 * q - p - 3 * r + s) * t ** 3)
                for p, q, r, s in zip(a, b, c, d)))
    return curve + [tuple(points[-1])]


def grid(rows, ring=False, u_scale=1.0):
    """Faces of a grid of points; outside is where column × row points. `ring`: columns close."""
    count = len(rows[0])
    normals = [[grid_normal(rows, i, k, ring) for k in range(count)] for i in range(len(rows))]
    lengths = arc_lengths(rows)
    faces = []
    for i in range(len(rows) - 1):
        for k in range(count if ring else count - 1):
            n = (k + 1) % count
            face = []
            for row, column, u in ((i, k, k), (i, n, k + 1), (i + 1, n, k + 1), (i + 1, k, k)):
                along = u / (count if ring else count - 1) * u_scale
                face.append((rows[row][column], normals[row][column], (along, lengths[row])))
            faces.append(without_doubles(face))
    return [face for face in faces if len(face) > 2]


def grid_normal(rows, i, k, ring):
    """Across the neighbours of a point; at a pole, whose row is one point, across the next row."""
    count = len(rows[0])
    before, after = (k - 1, k + 1) if ring else (max(k - 1, 0), min(k + 1, count - 1))
    lower, upper = rows[max(i - 1, 0)][k], rows[min(i + 1, len(rows) - 1)][k]
    if math.dist(rows[i][before], rows[i][after % count]) > 1e-9:
        across = subtract(rows[i][after % count], rows[i][before])
        return unit(cross(across, subtract(upper, lower)))
    near = rows[i + 1] if i == 0 else rows[i - 1]
    normal = unit(area_vector(near))
    return normal if i else tuple(-x for x in normal)


def arc_lengths(rows):
    """How far along the columns each row lies, 0 to 1."""
    far = [max(math.dist(p, q) for p, q in zip(a, b)) for a, b in zip(rows, rows[1:])]
    total, at, result = sum(far), 0.0, [0.0]
    for step in far:
        at += step
        result.append(at / total)
    return result


def without_doubles(face):
    """A face without corners that coincide."""
    return [corner for n, corner in enumerate(face)
            if math.dist(corner[0], face[n - 1][0]) > 1e-9]


def lathe(profile, segments=48):
    """Turns (radius, z) pairs about z; outside is to the right of the profile's direction."""
    ring = [(math.cos(2 * math.pi * k / segments), math.sin(2 * math.pi * k / segments))
            for k in range(segments)]
    return grid([[(r * c, r * s, z) for c, s in ring] for r, z in profile], ring=True)


def sweep(path, width, height, segments=16):
    """An oval bar along a path in the plane y = 0; width across it, height within it."""
    rows = []
    for n, point in enumerate(path):
        before, after = path[max(n - 1, 0)], path[min(n + 1, len(path) - 1)]
        along = unit(subtract(after, before))
        side = cross(along, (0, 1, 0))
        rows.append([tuple(p + height(n) * math.cos(a) * s - width(n) * math.sin(a) * y
                           for p, s, y in zip(point, side, (0, 1, 0)))
                     for a in (2 * math.pi * k / segments for k in range(segments))])
    return grid(rows, ring=True)


def faces_of(mesh, crease=40, scale=10.0):
    """Faces of a mesh of scenes/interior; texture coordinates from the side it looks to."""
    faces = []
    for (points, _), normals in zip(mesh.faces, corner_normals(mesh, crease)):
        flat = unit(cross(subtract(points[1], points[0]), subtract(points[2], points[0])))
        axis = max(range(3), key=lambda n, flat=flat: abs(flat[n]))
        u, v = [(1, 2), (0, 2), (0, 1)][axis]
        faces.append([(p, n, (p[u] / scale, p[v] / scale)) for p, n in zip(points, normals)])
    return faces


def moved(faces, x, y, z):
    return [[((p[0] + x, p[1] + y, p[2] + z), n, t) for p, n, t in face] for face in faces]


def write_object(out, name, faces):
    """One .mi object with y up."""
    pool, vertices, polygons = {}, {}, []

    def pooled(vector):
        text = " ".join(number(x) for x in vector)
        return pool.setdefault(text, len(pool))

    for face in faces:
        indices = []
        for p, n, t in face:
            place = pooled((p[0], p[2], -p[1]))
            spot = (round(t[0], 3), round(t[1], 3), 0)
            vertex = f"v {place} n {pooled((n[0], n[2], -n[1]))} t {pooled(spot)}"
            indices.append(vertices.setdefault(vertex, len(vertices)))
        polygons.append("c " + " ".join(map(str, indices)))
    out.write(f'\nobject "{name}" visible on shadow on trace on\n  group\n')
    for lines in (pool, vertices, polygons):
        write_packed(out, list(lines))
    out.write("  end group\nend object\n")
