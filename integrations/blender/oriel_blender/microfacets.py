# SPDX-License-Identifier: Apache-2.0
"""Reflectance of rough surfaces by direction: GGX of Cycles, and the curve of mia_material_x."""
import functools

import numpy

MIN_ALPHA = 1e-3
EXPONENTS = numpy.arange(1.0, 12.01, 0.25)


def fresnel(cosine, ior):
    """Reflectance of a dielectric from outside."""
    t = numpy.sqrt(numpy.maximum(ior * ior - 1 + cosine * cosine, 0))
    s = (t - cosine) / (t + cosine)
    p = (ior * ior * cosine - t) / (ior * ior * cosine + t)
    return (s * s + p * p) / 2


def reflected(mu, alpha, ior):
    """Reflected share of light by cosine, by single scattering: of white facets, and of facets whose
    reflectance rises from 0 to 1 as that of the dielectric rises above its minimum.

    Source: Walter et al. 2007 with the height-correlated masking of Heitz 2014, integrated over
    visible normals (Heitz 2018) by 256 points.
    """
    mu = mu[:, None]
    u = ((numpy.arange(256) + .5) / 256)[None, :]
    v = (numpy.arange(256) * 0.6180339887498949 % 1)[None, :]
    sine = numpy.sqrt(1 - mu * mu)
    vx, vz = alpha * sine, mu + 0 * u
    length = numpy.sqrt(vx * vx + vz * vz)
    vx, vz = vx / length, vz / length
    r, phi = numpy.sqrt(u), 2 * numpy.pi * v
    t1, t2 = r * numpy.cos(phi), r * numpy.sin(phi)
    s = (1 + vz) / 2
    t2 = (1 - s) * numpy.sqrt(1 - t1 * t1) + s * t2
    # Basis: T1 = (0, 1, 0), T2 = cross(V, T1) = (-vz, 0, vx).
    t3 = numpy.sqrt(numpy.maximum(0, 1 - t1 * t1 - t2 * t2))
    nx, ny, nz = -vz * t2 + vx * t3, t1, vx * t2 + vz * t3
    hx, hy, hz = alpha * nx, alpha * ny, numpy.maximum(nz, 1e-9)
    norm = numpy.sqrt(hx * hx + hy * hy + hz * hz)
    hx, hz = hx / norm, hz / norm
    facet = numpy.clip(sine * hx + mu * hz, 0, 1)
    cosine = 2 * facet * hz - mu

    def masking(c):
        c = numpy.clip(c, 1e-6, 1)
        return (numpy.sqrt(1 + alpha * alpha * (1 / (c * c) - 1)) - 1) / 2
    ratio = (1 + masking(mu)) / (1 + masking(mu) + masking(cosine))
    ratio = numpy.where(cosine > 0, ratio, 0)
    least = fresnel(numpy.array(1.0), ior)
    rise = (fresnel(facet, ior) - least) / (1 - least)
    return ratio.mean(axis=1), (ratio * rise).mean(axis=1)


def burley(view, light, half, roughness):
    """The diffuse lobe of Principled until 3.6, times pi. half: cosine between light and view.

    Source: Burley, "Physically-Based Shading at Disney", 2012.
    """
    at_view, at_light = (1 - view) ** 5, (1 - light) ** 5
    retro = roughness * (1 + half)
    return (1 - at_view / 2) * (1 - at_light / 2) + \
        retro * (at_view + at_light + at_view * at_light * (retro - 1))


def burley_albedo(view, roughness, count=48):
    """Its directional albedo: the integral over directions of light, by the midpoint rule."""
    steps = (numpy.arange(count) + .5) / count
    light, turn = numpy.meshgrid(steps, steps * numpy.pi, indexing="ij")
    half = light * view + numpy.sqrt((1 - light ** 2) * (1 - view ** 2)) * numpy.cos(turn)
    return float((burley(view, light, half, roughness) * light).mean() * 2)


@functools.lru_cache(maxsize=64)
def diffuse_curve(roughness):
    """a and b of a + b (1 - cosine)^5, which is nearest to the directional albedo by view."""
    views = (numpy.arange(16) + .5) / 16
    albedo = numpy.array([burley_albedo(view, roughness) for view in views])
    columns = numpy.stack([numpy.ones_like(views), (1 - views) ** 5], axis=1) / albedo[:, None]
    a, b = numpy.linalg.lstsq(columns, numpy.ones_like(views), rcond=None)[0]
    return float(a), float(b)


@functools.lru_cache(maxsize=64)
def lost_energy(alpha):
    """Share of light that GGX loses by single scattering: 1 - albedo, averaged over cosine."""
    if alpha < MIN_ALPHA:
        return 0.0
    mu = numpy.sqrt((numpy.arange(32) + .5) / 32)
    return float(1 - reflected(mu, alpha, 1.5)[0].mean())


@functools.lru_cache(maxsize=256)
def reflectance_curve(alpha, f0, ior, single):
    """Reflectance at 0 and 90 degrees and exponent of the curve f0 + (f90 - f0) (1 - cosine)^c that
    comes nearest to GGX facets with reflectance f0 at normal incidence.

    single: light that facets scatter again is lost.
    """
    mu = (numpy.arange(24) + .5) / 24
    white, rise = reflected(mu, max(alpha, MIN_ALPHA), ior)
    if not single:
        white, rise = numpy.ones_like(white), rise / white
    target = f0 * white + (1 - f0) * rise
    best = None
    for exponent in EXPONENTS:
        columns = numpy.stack([numpy.ones_like(mu), (1 - mu) ** exponent], axis=1)
        solution = numpy.linalg.lstsq(columns, target, rcond=None)[0]
        error = float(((columns @ solution - target) ** 2).sum())
        if best is None or error < best[0]:
            best = error, solution, float(exponent)
    low, slope = best[1]
    return float(numpy.clip(low, 0, 1)), float(numpy.clip(low + slope, 0, 1)), best[2]
