# SPDX-License-Identifier: Apache-2.0
"""The sun by place and time: settings of worlds, which turn the sky textures of the world.

The program computes the position. Cycles and EEVEE show the same sun, because the settings change
the nodes.
"""
import calendar
import functools
import json
import math
import subprocess

import bpy
from bpy.props import BoolProperty, EnumProperty, FloatProperty, IntProperty, PointerProperty

from . import program
from .engine import ENGINE


@functools.lru_cache(maxsize=256)
def position(path, latitude, longitude, time, north):
    """Azimuth in degrees clockwise from +Y, and elevation in degrees."""
    run = subprocess.run(
        [path, "sun", "--at", f"{latitude:.6f},{longitude:.6f}", f"--time={time}",
         f"--north={north:.6f}", "--json"], capture_output=True, text=True, timeout=30, check=False)
    if run.returncode != 0:
        raise program.ProgramMissing((run.stderr.strip() or "the position failed").splitlines()[-1])
    found = json.loads(run.stdout)
    x, y, z = found["direction"]["z_up"]
    return math.degrees(math.atan2(x, y)) % 360, math.degrees(math.asin(min(max(z, -1), 1)))


def time_text(settings):
    """Date and time with zone, as ISO 8601."""
    minutes = round(settings.hour * 60)
    zone = round(settings.zone * 60)
    sign = "-" if zone < 0 else "+"
    days = calendar.monthrange(settings.year, settings.month)[1]
    return (f"{settings.year:04d}-{settings.month:02d}-{min(settings.day, days):02d}T"
            f"{min(minutes // 60, 23):02d}:{minutes % 60 if minutes < 1440 else 59:02d}"
            f"{sign}{abs(zone) // 60:02d}:{abs(zone) % 60:02d}")


def skies(world):
    tree = world.node_tree if world.use_nodes else None
    return [node for node in tree.nodes if node.type == "TEX_SKY"] if tree else []


def apply(world):
    """Turns the sky textures of a world to its place and time. Returns azimuth and elevation."""
    settings = world.oriel
    azimuth, elevation = position(program.find(), settings.latitude, settings.longitude,
                                  time_text(settings), settings.north)
    turn, height = math.radians(azimuth), math.radians(elevation)
    for node in skies(world):
        if hasattr(node, "sun_elevation"):
            node.sun_elevation, node.sun_rotation = height, turn
        if hasattr(node, "sun_direction"):
            node.sun_direction = (math.sin(turn) * math.cos(height),
                                  math.cos(turn) * math.cos(height), math.sin(height))
    settings.shown = f"Sun {azimuth:.1f}\u00b0 clockwise from +Y, {elevation:.1f}\u00b0 high"
    return azimuth, elevation


def changed(settings, _context):
    world = settings.id_data
    if not settings.use_place:
        return
    try:
        apply(world)
    except (program.ProgramMissing, OSError, ValueError, KeyError, subprocess.TimeoutExpired) as error:
        settings.shown = str(error)


class OrielWorldSettings(bpy.types.PropertyGroup):
    sky_model: EnumProperty(
        name="Sky Textures", default="CYCLES",
        items=[("CYCLES", "As in Cycles", "A picture of the sky that Cycles renders, and its sun"),
               ("PHYSICAL", "Physical Sky of Oriel", "mia_physicalsky and mia_physicalsun")])
    use_place: BoolProperty(name="Sun by Place and Time", default=False, update=changed,
                            description="Turn the sky textures of this world to a place and time")
    latitude: FloatProperty(name="Latitude", default=52.5, min=-90, max=90, update=changed,
                            description="Degrees north")
    longitude: FloatProperty(name="Longitude", default=13.4, min=-180, max=180, update=changed,
                             description="Degrees east")
    year: IntProperty(name="Year", default=2026, min=1901, max=2099, update=changed)
    month: IntProperty(name="Month", default=6, min=1, max=12, update=changed)
    day: IntProperty(name="Day", default=21, min=1, max=31, update=changed)
    hour: FloatProperty(name="Hour", default=12.0, min=0.0, max=23.999, update=changed,
                        description="Local time: 13.5 is half past one")
    zone: FloatProperty(name="Time Zone", default=1.0, min=-14, max=14, update=changed,
                        description="Hours ahead of UTC, with summer time")
    north: FloatProperty(name="North", default=0.0, min=-360, max=360, update=changed,
                         description="Degrees clockwise from +Y, seen from above")
    shown: bpy.props.StringProperty(options={"HIDDEN"})


class ORIEL_OT_add_sky(bpy.types.Operator):
    """Add a sky texture to the world"""
    bl_idname = "world.oriel_add_sky"
    bl_label = "Add Sky"
    bl_options = {"UNDO"}

    def execute(self, context):
        world = context.scene.world
        world.use_nodes = True
        tree = world.node_tree
        background = next((n for n in tree.nodes if n.type == "BACKGROUND"), None)
        if background is None:
            self.report({"ERROR"}, "Oriel: the world has no Background node")
            return {"CANCELLED"}
        sky = tree.nodes.new("ShaderNodeTexSky")
        sky.location = background.location.x - 250, background.location.y
        tree.links.new(sky.outputs["Color"], background.inputs["Color"])
        changed(world.oriel, context)
        return {"FINISHED"}


class WorldPanel:
    """A panel of the world."""
    bl_space_type = "PROPERTIES"
    bl_region_type = "WINDOW"
    bl_context = "world"
    COMPAT_ENGINES = {ENGINE}

    @classmethod
    def poll(cls, context):
        return context.engine in cls.COMPAT_ENGINES and context.scene.world


class ORIEL_PT_sky(WorldPanel, bpy.types.Panel):
    bl_label = "Sky"

    def draw(self, context):
        self.layout.use_property_split = True
        self.layout.prop(context.scene.world.oriel, "sky_model")


class ORIEL_PT_sun(WorldPanel, bpy.types.Panel):
    bl_label = "Sun by Place and Time"

    def draw_header(self, context):
        self.layout.prop(context.scene.world.oriel, "use_place", text="")

    def draw(self, context):
        layout, settings = self.layout, context.scene.world.oriel
        layout.use_property_split = True
        layout.active = settings.use_place
        for names in (("latitude", "longitude"), ("year", "month", "day"), ("hour", "zone"),
                      ("north",)):
            column = layout.column(align=True)
            for name in names:
                column.prop(settings, name)
        if not skies(context.scene.world):
            layout.operator(ORIEL_OT_add_sky.bl_idname)
        elif settings.use_place and settings.shown:
            layout.label(text=settings.shown)


CLASSES = (OrielWorldSettings, ORIEL_OT_add_sky, ORIEL_PT_sky, ORIEL_PT_sun)


def register():
    for cls in CLASSES:
        bpy.utils.register_class(cls)
    bpy.types.World.oriel = PointerProperty(type=OrielWorldSettings)


def unregister():
    del bpy.types.World.oriel
    for cls in reversed(CLASSES):
        bpy.utils.unregister_class(cls)
