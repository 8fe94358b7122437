# SPDX-License-Identifier: Apache-2.0
"""Preferences of the add-on: the path of the program."""
import bpy

from . import program


class OrielPreferences(bpy.types.AddonPreferences):
    bl_idname = __package__

    program: bpy.props.StringProperty(
        name="Program", subtype="FILE_PATH", default="",
        description="Path of the program 'oriel' (default: found in PATH)")

    def draw(self, _context):
        self.layout.prop(self, "program")
        try:
            self.layout.label(text=program.find(), icon="CHECKMARK")
        except program.ProgramMissing as error:
            self.layout.label(text=str(error), icon="ERROR")


def register():
    bpy.utils.register_class(OrielPreferences)


def unregister():
    bpy.utils.unregister_class(OrielPreferences)
