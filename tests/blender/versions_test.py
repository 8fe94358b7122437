#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""The export of the extension with data of Blender 3.4 and 4.0 to 5.0, without Blender: all versions
write the same scene, but for the model of Principled BSDF."""
# acceptance: Y2
import importlib.util
import os
import pathlib
import re
import sys
import tempfile
import unittest

SYSTEM = "/usr/bin/python3"  # has the packages that Debian's Blender uses
if importlib.util.find_spec("numpy") is None and sys.executable != SYSTEM and os.path.exists(SYSTEM):
    os.execv(SYSTEM, [SYSTEM, *sys.argv])

HERE = pathlib.Path(__file__).resolve().parent
sys.path += [str(HERE), str(HERE.parents[1] / "integrations" / "blender")]
import mock_bpy as mock  # noqa: E402


def simple(tree, kind, **inputs):
    specs = [mock.colour(k, *v) if isinstance(v, tuple) else mock.number(k, v)
             for k, v in inputs.items()]
    return mock.rna(tree.node(kind, kind.title(), specs, [("BSDF", "SHADER", None)],
                              distribution="GGX"))


def diffuse(tree):
    node = simple(tree, "BSDF_DIFFUSE", Color=(.8, .2, .1), Roughness=0.0)
    node.inputs.append(tree.socket(node, "Normal", "VECTOR", None))
    return node


def grouped(release):
    """A diffuse surface whose colour is made by a group of a mix node and a noise texture."""
    def inner(tree, source):
        mix = tree.node("MIX_RGB", "Mix", [mock.number("Fac", .5), mock.colour("Color1", 0, 0, 0),
                                          mock.colour("Color2", .2, .4, .6)], ["Color"],
                        blend_type="MULTIPLY", use_clamp=False)
        tree.link(source, mix.inputs[1])
        return mix.outputs[0]

    def build(tree):
        noise = tree.node("TEX_NOISE", "Noise", [
            ("Vector", "VECTOR", None), mock.number("W", 0), mock.number("Scale", 3),
            mock.number("Detail", 2), mock.number("Roughness", .5),
            *([mock.number("Lacunarity", 2)] if release >= (4, 0, 0) else []),
            *([mock.number("Offset", 0), mock.number("Gain", 1)] if release >= (4, 1, 0) else []),
            mock.number("Distortion", 0)], [("Fac", "VALUE", None), "Color"], noise_dimensions="3D",
            **({"normalize": True} if release >= (4, 0, 0) else {}),
            **({"noise_type": "FBM"} if release >= (4, 1, 0) else {}))
        group = tree.node("GROUP", "Group", [mock.colour("Colour", 1, 1, 1)], ["Colour"],
                          node_tree=mock.group_tree(release, inner))
        surface = diffuse(tree)
        tree.link(noise.outputs[1], group.inputs[0])
        tree.link(group.outputs[0], surface.inputs["Color"])
        return surface
    return build


def materials(release):
    def layered(**values):
        return lambda tree: mock.principled(tree, release, **values)
    builds = {"diffuse": diffuse, "grouped": grouped(release),
              "glossy": lambda t: simple(t, "BSDF_GLOSSY", Color=(.9, .9, .8), Roughness=.2),
              "glass": lambda t: simple(t, "BSDF_GLASS", Color=(1.0, 1.0, 1.0), Roughness=0.0, IOR=1.5),
              "emission": lambda t: simple(t, "EMISSION", Color=(1.0, .9, .8), Strength=3.0),
              "transparent": lambda t: simple(t, "BSDF_TRANSPARENT", Color=(.5, .6, .7)),
              "metal": layered(Metallic=1.0, Roughness=.3), "mirror": layered(Metallic=1.0, Roughness=0.0),
              "glass2": layered(Transmission=1.0, Roughness=.0), "plastic": layered(Roughness=.5, Specular=0.0),
              "light": layered(Emission=(1.0, .5, .2, 1.0), Emission_Strength=2.0),
              "alpha": layered(Alpha=.5), "subsurface": layered(Subsurface=1.0),
              "coat": layered(Clearcoat=1.0), "sheen": layered(Sheen=.5)}
    return [mock.material(name, release, build) for name, build in builds.items()]


def world():
    tree = mock.Tree("World")
    background = tree.node("BACKGROUND", "Background", [mock.colour("Color", .2, .3, .4),
                                                       mock.number("Strength", 1.5)],
                           [("Background", "SHADER", None)])
    output = tree.node("OUTPUT_WORLD", "Output", [("Surface", "SHADER", None)], [],
                       is_active_output=True)
    tree.link(background.outputs[0], output.inputs[0])
    return mock.Data(name="World", use_nodes=True, node_tree=tree.tree, color=(0, 0, 0))


def exported(release, folder, change=None):
    """Text of the scene, its meshes and the messages."""
    mock.install(release)
    from oriel_blender import export, meshes
    instances = [mock.instance(m.name, "MESH", mock.square(m.name, release, [m]), release, (i, 0, 0))
                 for i, m in enumerate(materials(release))]
    for i, (kind, settings) in enumerate((
            ("POINT", {}), ("SUN", {"angle": .01}), ("AREA", {
                "shape": "RECTANGLE", "size": 1.0, "size_y": 2.0, "spread": 3.141592653589793}),
            ("SPOT", {"spot_size": 1.0, "spot_blend": 0.0}))):
        lamp = mock.light(kind, release, **settings)
        instances.append(mock.instance(kind, "LIGHT", lamp, release, (0, i, 3), visible_glossy=i != 2,
                                       visible_transmission=i != 2))
    settings = mock.Data(depth=8, indirect="path", threads=0)
    graph = mock.scene(release, instances, world(), settings)
    if change:
        change(graph)
    messages = []
    exporter = export.Exporter(graph, folder, meshes.MeshFolder(pathlib.Path(folder) / "meshes"),
                               messages.append)
    path = exporter.write(str(pathlib.Path(folder) / "scene.mi"), (64, 48))
    text = pathlib.Path(path).read_text(encoding="utf-8")
    return text, messages


def parts_of(text):
    """Shaders, materials and other elements by their first line."""
    elements = re.split(r"\n(?=shader |material |light |lightprofile |instance |camera |options |\$include )", text)
    return {e.split("(")[0].split("\n")[0].strip(): e for e in elements}


# The light of these follows Principled BSDF of 4.0, whose layers take light from those below; spots
# of Cycles until 3.4 fall with the cosine to their axis.
CHANGED = re.compile(r'"(plastic|light|alpha|subsurface|coat|sheen|glass2|metal|mirror)[".#]|"SPOT')


class Versions(unittest.TestCase):
    def test_all_write_the_same_scene(self):
        with tempfile.TemporaryDirectory() as folder:
            reference, messages = exported((3, 4, 1), folder)
            self.assertIn("one subsurface radius", "\n".join(messages))
            first = parts_of(reference)
            for release in mock.RELEASES[1:]:
                with self.subTest(release=release):
                    text, _messages = exported(release, folder)
                    other = parts_of(text)
                    for key in {*first, *other}:
                        if not CHANGED.search(key):
                            self.assertEqual(first.get(key), other.get(key), key)
                    self.assertGreater(sum(not CHANGED.search(k) for k in other), 40)

    def test_4_0_to_5_0_are_equal(self):
        with tempfile.TemporaryDirectory() as folder:
            texts = [exported(release, folder)[0] for release in mock.RELEASES[1:]]
            for text, release in zip(texts, mock.RELEASES[1:]):
                self.assertEqual(texts[0], text, release)

    def test_renamed_sockets_are_read(self):
        with tempfile.TemporaryDirectory() as folder:
            text = exported((4, 2, 0), folder)[0]
        parts = parts_of(text)
        element = next(v for k, v in parts.items() if "light.emission" in k)
        self.assertRegex(element, r'"color_0" 2 1 0\.4')  # Emission Color
        self.assertRegex(next(v for k, v in parts.items() if k.startswith('shader "plastic.surface"')),
                         r'"reflection_color" 0 0 0|"ior" 1\b')  # Specular IOR Level
        self.assertRegex(next(v for k, v in parts.items() if "glass2.surface" in k),
                         r'"transparency" 1\b')  # Transmission Weight
        self.assertRegex(next(v for k, v in parts.items() if k.startswith('shader "coat.coat"')),
                         r'"reflection_edge_weight" 1\b')  # Coat Weight
        self.assertTrue(any(k.startswith('shader "subsurface.subsurface"') for k in parts))
        self.assertTrue(any(k.startswith('shader "sheen.sheen"') for k in parts))

    def test_names_are_unique_whatever_their_order(self):
        mock.install((3, 4, 1))
        from oriel_blender import mi
        names = mi.Names()
        made = [names.unique(wish) for wish in ("a#2", "a", "a", "a#3", "a", "", "", "a#2")]
        self.assertEqual(made[:3], ["a#2", "a", "a#3"])
        self.assertEqual(len(set(made)), len(made))

    def test_random_numbers_of_instances_share_materials(self):
        mock.install((3, 4, 1))
        from oriel_blender import variants
        found, ob = set(), mock.Data(name="x")
        for k in range(5000):
            placed = mock.Data(random_id=k * 0x9e3779b9, is_instance=True)
            value = variants.values_of({"Random"}, ob, placed)["Random"]
            self.assertLess(abs(value - variants.random_of("", placed.random_id)), 1 / 500)
            found.add(value)
        self.assertEqual(len(found), variants.RANDOM_STEPS)

    def test_lights_light_the_objects_of_their_collection(self):
        def member(name, state):
            return mock.Data(name=name, light_linking=mock.Data(link_state=state))

        def collection(children=(), **states):
            inner = mock.Items(c for c, _ in children)
            return mock.Data(
                name="Lit", children=inner, objects=[mock.Data(name=n) for n in states],
                collection_objects=[member(n, s) for n, s in states.items()],
                collection_children=[member(c.name, s) for c, s in children])

        def exported_with(receivers):
            def change(graph):
                lamp = next(i.object for i in graph.object_instances if i.object.name == "POINT")
                lamp.light_linking = mock.Data(receiver_collection=receivers, blocker_collection=None)
            with tempfile.TemporaryDirectory() as folder:
                text = exported((4, 3, 0), folder, change)[0]
            lamp = re.search(r'instance "(\S+)" "POINT.light"', text)[1]
            return {e.split('"')[1] for e in parts_of(text).values()
                    if e.startswith("instance") and f'  light "exclusive" [ "{lamp}" ]' in e}
        names = {m.name for m in materials((4, 3, 0))}
        dark = {re.sub(r"#\d+$", "", n) for n in exported_with(
            collection(diffuse="INCLUDE", metal="INCLUDE", coat="EXCLUDE"))}
        self.assertEqual(dark, names - {"diffuse", "metal"})
        inner = collection(sheen="INCLUDE")
        dark = {re.sub(r"#\d+$", "", n) for n in exported_with(
            collection([(inner, "EXCLUDE")], coat="EXCLUDE"))}
        self.assertEqual(dark, {"sheen", "coat"})

    def test_exposure_and_temperature_of_lights(self):
        def brighter(graph):
            lamp = next(i.object.data for i in graph.object_instances if i.object.name == "POINT")
            lamp.exposure, lamp.use_temperature, lamp.temperature_color = 1.0, True, (.5, 1.0, 1.0)
        with tempfile.TemporaryDirectory() as folder:
            plain, bright = (exported((4, 5, 0), folder, change)[0] for change in (None, brighter))
        colours = [[float(x) for x in re.search(
            r'light "POINT\.light"\n  "physical_light" \( "color" (\S+) (\S+) ([^,\s]+)', t).groups()]
            for t in (plain, bright)]
        for before, after, factor in zip(*colours, (1.0, 2.0, 2.0)):
            self.assertAlmostEqual(after / before, factor, places=5)


if __name__ == "__main__":
    unittest.main()
