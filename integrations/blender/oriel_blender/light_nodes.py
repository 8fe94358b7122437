# SPDX-License-Identifier: Apache-2.0
"""Node trees of lights: a colour and a strength that multiply the light, and an IES profile."""
from . import mi, nodes


class LightNodes:
    """Reads the node tree of a light, whose values are constants."""

    def __init__(self, out, images, light, report):
        self._light = light
        self._report = report
        self.graph = nodes.Graph(
            out, images, light.name,
            lambda text: report(text.replace("material", "light", 1)), [])

    def ignored(self, node, what="is unsupported and ignored"):
        self._report(f'light "{self._light.name}": node "{node.name}" {what}')

    def constant(self, socket, default):
        """The value of a socket; the default if it depends on the place or direction."""
        value = self.graph.value(socket)
        if isinstance(value, mi.Connection):
            self.ignored(self.graph.origin(socket)[0])
            return default
        return value

    def strength(self, socket):
        """The factor of the strength and the IES texture that it reads, or None."""
        found = self.graph.origin(socket)
        node = None if found is None or found[0] is nodes.CONSTANT else found[0]
        if node is None or node.type not in {"TEX_IES", "LIGHT_FALLOFF"}:
            return self.graph.scalar(self.constant(socket, 1.0)), None
        factor = self.graph.scalar(self.constant(node.inputs["Strength"], 1.0))
        if node.type == "TEX_IES":
            return factor, node
        if found[1].identifier != "Quadratic" or self.graph.scalar(
                self.constant(node.inputs["Smooth"], 0.0)) > 0:
            self.ignored(node, "has a falloff that is not quadratic; it is read as quadratic")
        return factor, None


def factor(out, images, light, report):
    """Colour times strength of a light's node tree, and the node of its IES profile or None."""
    if not light.use_nodes or light.node_tree is None:
        return (1.0, 1.0, 1.0), None
    output = next((n for n in light.node_tree.nodes
                   if n.type == "OUTPUT_LIGHT" and n.is_active_output), None)
    read = LightNodes(out, images, light, report)
    found = read.graph.origin(output.inputs["Surface"]) if output else None
    if found is None or found[0] is nodes.CONSTANT:
        return (0.0, 0.0, 0.0), None
    node = found[0]
    if node.type != "EMISSION":
        read.ignored(node)
        return (1.0, 1.0, 1.0), None
    strength, profile = read.strength(node.inputs["Strength"])
    rgb = read.graph.colour(read.constant(node.inputs["Color"], (1.0, 1.0, 1.0)))
    return tuple(c * strength for c in rgb), profile
