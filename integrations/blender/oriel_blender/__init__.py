# SPDX-License-Identifier: Apache-2.0
"""Oriel as a render engine of Blender, and the import of mental ray scenes."""
bl_info = {
    "name": "Oriel",
    "author": "Oriel contributors",
    "version": (0, 1, 0),
    "blender": (3, 4, 0),
    "location": "Render engine menu; File > Import",
    "description": "Physically based rendering for architecture",
    "category": "Render",
}

from . import bake, data_panels, engine, importer, native, panels, preferences, properties, sun_position

MODULES = (preferences, properties, native, engine, panels, data_panels, sun_position, bake, importer)


def register():
    for module in MODULES:
        module.register()


def unregister():
    for module in reversed(MODULES):
        module.unregister()
