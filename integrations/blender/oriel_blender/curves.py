# SPDX-License-Identifier: Apache-2.0
"""Hair: curves objects and particle hair as binary hair objects."""
import numpy

from . import mi

DEFAULT_RADIUS = 0.01  # of Cycles, for curves without the attribute


def hair_text(name, points, radii, first):
    """Chunks of a hair object.

    points: float32 (points, 3); radii: float32 (points,); first: offsets of curves, one more than
    curves. Curves with fewer than two points are dropped.
    """
    counts = numpy.diff(first)
    good = counts >= 2
    if not numpy.any(good):
        return None
    keep = numpy.repeat(good, counts)
    points, radii, counts = points[keep], radii[keep], counts[good]
    scalars = numpy.concatenate([points, radii[:, None]], axis=1).astype(">f4")
    offsets = numpy.concatenate([[0], numpy.cumsum(counts)]) * 4
    head = (f"object {mi.quoted(name)} visible on shadow on trace on\nhair\n  degree 1\n"
            f"  vertex radius\n  scalar [{scalars.size}] `")
    return [head.encode(), scalars.tobytes(), f"`\n  hair [{len(offsets)}] `".encode(),
            offsets.astype(">u4").tobytes(), b"`\nend hair\nend object\n"]


def curves_arrays(curves):
    """Points, radii and offsets of a hair curves data-block."""
    count = len(curves.points)
    points = numpy.empty(count * 3, numpy.float32)
    curves.position_data.foreach_get("vector", points)
    first = numpy.empty(len(curves.curves) + 1, numpy.int32)
    curves.curve_offset_data.foreach_get("value", first)
    radii = numpy.full(count, DEFAULT_RADIUS, numpy.float32)
    attribute = curves.attributes.get("radius")
    if attribute is not None and len(attribute.data) == count:
        attribute.data.foreach_get("value", radii)
    return points.reshape(-1, 3), radii, first


def particle_arrays(ob, system, matrix_inverse):
    """Points in object space, radii and offsets of a particle hair system."""
    settings = system.settings
    parents, children = len(system.particles), len(system.child_particles)
    begin = parents if children and settings.child_type != "NONE" else 0
    steps = 2 ** settings.render_step + 1
    rows, counts = [], []
    for i in range(begin, parents + children):
        curve = [tuple(system.co_hair(ob, particle_no=i, step=step)) for step in range(steps)]
        curve = [p for k, p in enumerate(curve) if k == 0 or p != curve[k - 1]]
        if len(curve) >= 2 and any(curve[-1]):
            rows.extend(curve)
            counts.append(len(curve))
    if not counts:
        return None
    points = numpy.array(rows, numpy.float64)
    inverse = numpy.array(matrix_inverse)
    points = points @ inverse[:3, :3].T + inverse[:3, 3]
    # The settings are diameters.
    root = settings.root_radius * settings.radius_scale / 2
    tip = 0.0 if settings.use_close_tip else settings.tip_radius * settings.radius_scale / 2
    radii = numpy.concatenate([numpy.linspace(root, tip, n) for n in counts])
    first = numpy.concatenate([[0], numpy.cumsum(counts)])
    return points.astype(numpy.float32), radii.astype(numpy.float32), first
