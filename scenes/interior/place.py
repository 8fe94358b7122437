# SPDX-License-Identifier: Apache-2.0
"""Where things stand: rows of a world to local matrix, as `transform` takes them (row vectors)."""
from mesh import cross, dot, number, unit


def matrix(rows):
    return "\n            ".join(" ".join(number(x, 6) for x in row) for row in rows)


def to_local(x, y, z, at=(0, 0, 0)):
    """World to local: the local axes are columns."""
    rows = [(x[i], y[i], z[i], 0) for i in range(3)]
    return rows + [(-dot(at, x), -dot(at, y), -dot(at, z), 1)]


def looking(back, at=(0, 0, 0), up=(0, 0, 1)):
    """Of a camera or light whose own z axis is `back`; up in the picture is up."""
    right = unit(cross(up, back))
    return to_local(right, cross(back, right), back, at)


def camera(eye, target, up=(0, 0, 1)):
    return looking(unit(tuple(e - t for e, t in zip(eye, target))), eye, up)


def instance(out, name, element, rows, words=""):
    out.write(f'instance "{name}" "{element}"{words}\n  transform {matrix(rows)}\nend instance\n')
