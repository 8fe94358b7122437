# SPDX-License-Identifier: Apache-2.0
"""Polygon shapes for the interior, and how they are written as .mi text. Metres, z up."""
import math


class Mesh:
    """Polygons as lists of points, counter-clockwise from outside, each with a material or None."""

    def __init__(self):
        self.faces = []

    def add(self, points, material=None):
        self.faces.append(([tuple(p) for p in points], material))
        return self

    def merge(self, *others):
        for other in others:
            self.faces += other.faces
        return self

    def map(self, function):
        result = Mesh()
        result.faces = [([function(p) for p in points], m) for points, m in self.faces]
        return result

    def moved(self, x, y, z=0):
        return self.map(lambda p: (p[0] + x, p[1] + y, p[2] + z))

    def scaled(self, s):
        return self.map(lambda p: (p[0] * s, p[1] * s, p[2] * s))

    def turned(self, degrees, axis="z"):
        """Right-handed turn about an axis through the origin."""
        c, s = math.cos(math.radians(degrees)), math.sin(math.radians(degrees))
        turn = {"z": lambda p: (c * p[0] - s * p[1], s * p[0] + c * p[1], p[2]),
                "x": lambda p: (p[0], c * p[1] - s * p[2], s * p[1] + c * p[2]),
                "y": lambda p: (c * p[0] + s * p[2], p[1], c * p[2] - s * p[0])}
        return self.map(turn[axis])

    def painted(self, material):
        result = Mesh()
        result.faces = [(points, material) for points, _ in self.faces]
        return result


def subtract(a, b):
    return (a[0] - b[0], a[1] - b[1], a[2] - b[2])


def cross(a, b):
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


def dot(a, b):
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


def unit(v):
    length = math.sqrt(dot(v, v))
    return (v[0] / length, v[1] / length, v[2] / length) if length else v


def area_vector(points):
    """Normal of a polygon, as long as its area (Newell)."""
    x = y = z = 0.0
    for (ax, ay, az), (bx, by, bz) in zip(points, points[1:] + points[:1]):
        x += (ay - by) * (az + bz)
        y += (az - bz) * (ax + bx)
        z += (ax - bx) * (ay + by)
    return (x / 2, y / 2, z / 2)


def box(x0, y0, z0, x1, y1, z1):
    """Box with sharp edges between two corners."""
    a, b, c, d = (x0, y0, z0), (x1, y0, z0), (x1, y1, z0), (x0, y1, z0)
    e, f, g, h = (x0, y0, z1), (x1, y0, z1), (x1, y1, z1), (x0, y1, z1)
    mesh = Mesh()
    for face in ([d, c, b, a], [e, f, g, h], [a, b, f, e], [b, c, g, f], [c, d, h, g],
                 [d, a, e, h]):
        mesh.add(face)
    return mesh


def grid_box(coordinates, place):
    """The six sides of a box as grids: `coordinates` are the cuts per axis, `place` moves them."""
    mesh = Mesh()
    for axis in range(3):
        u, v = (axis + 1) % 3, (axis + 2) % 3
        for end in (0, -1):
            for i in range(len(coordinates[u]) - 1):
                for j in range(len(coordinates[v]) - 1):
                    corners = []
                    for du, dv in ((0, 0), (1, 0), (1, 1), (0, 1)):
                        p = [0.0, 0.0, 0.0]
                        p[axis] = coordinates[axis][end]
                        p[u], p[v] = coordinates[u][i + du], coordinates[v][j + dv]
                        corners.append(place(tuple(p)))
                    mesh.add(corners if end == -1 else corners[::-1])
    return mesh


def rounded_box(sx, sy, sz, radius, steps=3):
    """Box of the given size, centred in x and y, standing on z = 0, with round edges."""
    half = (sx / 2, sy / 2, sz / 2)
    cuts = []
    for h in half:
        arc = [h - radius + radius * math.tan(math.pi / 4 * k / steps) for k in range(steps + 1)]
        cuts.append([-x for x in reversed(arc)] + arc)

    def place(p):
        inner = tuple(max(-(h - radius), min(h - radius, x)) for x, h in zip(p, half))
        n = unit(subtract(p, inner))
        return tuple(i + radius * d for i, d in zip(inner, n))

    return grid_box(cuts, place).moved(0, 0, half[2])


def cushion(sx, sy, sz, puff, radius=0.05):
    """A rounded box whose broad sides swell by `puff` metres in the middle."""
    half = (sx / 2, sy / 2, sz / 2)
    cuts = []
    for h in half:
        even = [(h - radius) * k / 4 for k in range(-4, 5)]
        edge = [h - radius + radius * math.tan(math.pi / 8), h]
        cuts.append([-x for x in reversed(edge)] + even + edge)

    def place(p):
        inner = tuple(max(-(h - radius), min(h - radius, x)) for x, h in zip(p, half))
        n = unit(subtract(p, inner))
        x, y, z = (i + radius * d for i, d in zip(inner, n))
        swell = (1 - (p[0] / half[0]) ** 2) * (1 - (p[1] / half[1]) ** 2)
        return (x, y, z * (1 + puff * swell / half[2]))

    return grid_box(cuts, place).moved(0, 0, sz / 2)


def lathe(profile, segments=40):
    """Turns (radius, z) pairs about z; outside is to the right of the profile's direction."""
    ring = [(math.cos(2 * math.pi * k / segments), math.sin(2 * math.pi * k / segments))
            for k in range(segments)]
    mesh = Mesh()
    for (r0, z0), (r1, z1) in zip(profile, profile[1:]):
        for k in range(segments):
            (c0, s0), (c1, s1) = ring[k], ring[(k + 1) % segments]
            face = [(r0 * c0, r0 * s0, z0), (r0 * c1, r0 * s1, z0),
                    (r1 * c1, r1 * s1, z1), (r1 * c0, r1 * s0, z1)]
            if r0 == 0:
                face.pop(1)
            elif r1 == 0:
                face.pop(2)
            mesh.add(face)
    return mesh


def tube(start, end, r0, r1=None, segments=16):
    """Closed round bar between two points, radius r0 to r1."""
    r1 = r0 if r1 is None else r1
    axis = unit(subtract(end, start))
    side = unit(cross(axis, (0, 0, 1) if abs(axis[2]) < 0.9 else (1, 0, 0)))
    other = cross(axis, side)

    def rim(centre, radius):
        return [tuple(centre[i] + radius * (math.cos(a) * side[i] + math.sin(a) * other[i])
                      for i in range(3))
                for a in (2 * math.pi * k / segments for k in range(segments))]

    low, high = rim(start, r0), rim(end, r1)
    mesh = Mesh().add(low[::-1]).add(high)
    for k in range(segments):
        n = (k + 1) % segments
        mesh.add([low[k], low[n], high[n], high[k]])
    return mesh


def sheet(surface, nu, nv):
    """Open grid of surface(u, v) for u, v in [0, 1]."""
    mesh = Mesh()
    for i in range(nu):
        for j in range(nv):
            mesh.add([surface((i + a) / nu, (j + b) / nv)
                      for a, b in ((0, 0), (1, 0), (1, 1), (0, 1))])
    return mesh


def corner_normals(mesh, crease_deg):
    """Per face and corner: the area-weighted mean normal of the faces that meet there and turn
    from this face by less than the crease angle."""
    areas = [area_vector(points) for points, _ in mesh.faces]
    units = [unit(a) for a in areas]
    around = {}
    for f, (points, _) in enumerate(mesh.faces):
        for p in points:
            around.setdefault(key(p), set()).add(f)
    limit = math.cos(math.radians(crease_deg))
    result = []
    for f, (points, _) in enumerate(mesh.faces):
        corners = []
        for p in points:
            near = [g for g in sorted(around[key(p)]) if dot(units[f], units[g]) >= limit]
            total = tuple(sum(areas[g][i] for g in near) for i in range(3))
            corners.append(unit(total))
        result.append(corners)
    return result


def key(p):
    return tuple(round(x, 5) + 0.0 for x in p)


def number(x, digits=4):
    text = f"{x:.{digits}f}".rstrip("0").rstrip(".")
    return "0" if text in ("-0", "") else text


def write_object(out, name, mesh, crease_deg=40, uv=None):
    """One .mi object of one group. A crease angle of 0 leaves every polygon flat. `uv` gives the
    texture coordinates of a point, told the middle of its polygon as well (to know on which side
    of a seam it is)."""
    normals = corner_normals(mesh, crease_deg) if crease_deg else None
    pool, vertices, polygons = {}, {}, []

    def pooled(vector):
        text = " ".join(number(x) for x in vector)
        return pool.setdefault(text, len(pool))

    for f, (points, material) in enumerate(mesh.faces):
        indices = []
        middle = tuple(sum(p[i] for p in points) / len(points) for i in range(3))
        for c, p in enumerate(points):
            vertex = f"v {pooled(p)}" + (f" n {pooled(normals[f][c])}" if normals else "")
            if uv:
                vertex += f" t {pooled((*uv(p, middle), 0))}"
            index = vertices.setdefault(vertex, len(vertices))
            if index not in indices:
                indices.append(index)
        if len(indices) >= 3:
            named = f'c "{material}" ' if material else "c "
            polygons.append(named + " ".join(map(str, indices)))

    out.write(f'object "{name}" visible on shadow on trace on\n  group\n')
    for text in pool:
        out.write(f"    {text}\n")
    write_packed(out, list(vertices))
    write_packed(out, polygons)
    out.write("  end group\nend object\n")


def write_packed(out, items, width=96):
    line = "   "
    for item in items:
        if len(line) + 2 + len(item) > width:
            out.write(line + "\n")
            line = "   "
        line += "  " + item if line.strip() else " " + item
    if line.strip():
        out.write(line + "\n")
