# SPDX-License-Identifier: Apache-2.0
"""The result of a surface node, and roughness of mia_material_x."""
import math

from . import mi, microfacets

MIN_ALPHA = 1e-5


def gloss_of_roughness(roughness, sharpest=1.0):
    """refl_gloss whose lobe has the width alpha = roughness^2: alpha = 2^(-1.5 - 7 gloss).

    sharpest: the maximum; 1 is a mirror.
    """
    alpha = min(max(roughness, 0.0), 1.0) ** 2
    if alpha < MIN_ALPHA:
        return sharpest
    return min(max(-(math.log2(alpha) + 1.5) / 7, 0.0), sharpest)


def single_scattering(value, roughness, f0):
    """Factor of the reflection for Cycles' GGX without multiple scattering."""
    if isinstance(roughness, mi.Connection) or isinstance(f0, mi.Connection):
        return value
    lost = microfacets.lost_energy(round(max(roughness, 0.0) ** 2, 4))
    return value / (1 + f0 * lost / (1 - lost))


def f0_of_ior(ior):
    return ((ior - 1) / (ior + 1)) ** 2


class Surface:
    """The result of a surface node: parameters of mia_material_x, or a finished shader."""

    def __init__(self, **parameters):
        self.parameters = parameters
        self.shader = None      # connection to a shader that replaces the parameters
        self.opacity = 1.0      # cutout
        self.transmits = False
        self.scattered = None   # connection to a shader whose light is added
