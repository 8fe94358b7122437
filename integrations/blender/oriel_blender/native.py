# SPDX-License-Identifier: Apache-2.0
"""Native nodes: one node class for each shader, made from the declarations of the program."""
import bpy

from . import mi, program

PREFIX = "OrielNode_"
SOCKETS = {"scalar": "NodeSocketFloat", "integer": "NodeSocketInt", "boolean": "NodeSocketBool",
           "color": "NodeSocketColor", "vector": "NodeSocketVector", "string": "NodeSocketString",
           "shader": "NodeSocketShader"}
TEXTURES = {"color texture", "vector texture", "scalar texture"}
_classes = []


def default_of(parameter):
    """The default of a declaration as a socket value; None if it has none."""
    words = str(parameter.get("default", "")).split()
    kind = parameter["type"]
    try:
        if kind == "boolean":
            return words[0] in {"on", "true", "1"}
        if kind == "integer":
            return int(float(words[0]))
        if kind == "scalar":
            return float(words[0])
        if kind == "vector":
            return tuple(float(w) for w in words[:3])
        if kind == "color":
            values = [float(w) for w in words]
            return tuple(values[:3]) + (values[3] if len(values) > 3 else 1.0,)
    except (IndexError, ValueError):
        pass
    return None


class OrielNode:
    """What the classes of all shaders share."""
    bl_icon = "MATERIAL"
    parameters = ()
    shader = ""

    @classmethod
    def poll(cls, tree):
        return tree.bl_idname == "ShaderNodeTree"

    def init(self, _context):
        for parameter in self.parameters:
            kind = SOCKETS.get(parameter["type"])
            if kind is None:
                continue
            socket = self.inputs.new(kind, parameter["name"], identifier=parameter["name"])
            if hasattr(socket, "description"):
                socket.description = help_of(parameter)
            value = default_of(parameter)
            if value is not None:
                socket.default_value = value
        self.outputs.new("NodeSocketShader", "BSDF")
        self.outputs.new("NodeSocketColor", "Color")
        self.outputs.new("NodeSocketVector", "Vector")
        self.width = 240

    def draw_buttons(self, _context, layout):
        for parameter in self.parameters:
            if parameter["type"] in TEXTURES:
                layout.prop(self, "image_" + parameter["name"], text=parameter["name"])

    def draw_label(self):
        return self.shader


def help_of(parameter):
    text = parameter.get("doc", "")
    limits = [str(parameter[k]) for k in ("min", "max") if k in parameter]
    if len(limits) == 2:
        text += f" Range {limits[0]} to {limits[1]}."
    if parameter.get("unit"):
        text += f" Unit: {parameter['unit']}."
    return text


def class_of(declaration):
    """The node class of a shader."""
    annotations = {}
    for parameter in declaration["parameters"]:
        if parameter["type"] in TEXTURES:
            annotations["image_" + parameter["name"]] = bpy.props.PointerProperty(
                type=bpy.types.Image, name=parameter["name"], description=help_of(parameter))
    return type(PREFIX + declaration["name"], (OrielNode, bpy.types.ShaderNode), {
        "bl_idname": PREFIX + declaration["name"], "bl_label": declaration["name"],
        "bl_description": declaration.get("doc", ""), "__annotations__": annotations,
        "parameters": tuple(declaration["parameters"]), "shader": declaration["name"],
        "library": declaration.get("library", "")})


# Parameters that are the number of a texture space: the UV maps of the mesh in their order.
SPACES = {"select", "space"}


def call_of_node(graph, node):
    """Writes the shader call of a native node; returns a connection to it."""
    cls = type(node)
    parameters = {}
    graph.space("uv", "")  # shaders read texture coordinates without naming a map
    for parameter in cls.parameters:
        name, kind = parameter["name"], parameter["type"]
        if kind in TEXTURES:
            image = getattr(node, "image_" + name)
            if image is not None:
                texture = graph.images.texture(image, graph.material, node.name,
                                               kind != "color texture")
                if texture:
                    parameters[name] = mi.Words(mi.quoted(texture))
            continue
        if kind == "transform" and name in node:
            parameters[name] = tuple(node[name])
        socket = node.inputs.get(name)
        if socket is None:
            continue
        if kind == "shader":
            found = graph.value(socket) if socket.is_linked else None
            if isinstance(found, mi.Connection):
                parameters[name] = str(found)
        elif kind == "string":
            if socket.default_value:
                parameters[name] = socket.default_value
        else:
            parameters[name] = plain(kind, socket, graph, default_of(parameter))
            if name in SPACES and isinstance(parameters[name], int) and parameters[name] > 0:
                parameters[name] = graph.space("uv", parameters[name])
    return graph.out.shader_of(f"{graph.material}.{node.name}", cls.shader, parameters)


def plain(kind, socket, graph, default):
    """The value of a number, colour or vector; Ellipsis if it is the default."""
    if socket.is_linked:
        value = graph.value(socket)
        if isinstance(value, mi.Connection):
            return value
    else:
        value = socket.default_value
    if kind == "boolean":
        return ... if bool(value) == default else bool(value)
    if kind == "integer":
        return ... if int(value) == default else int(value)
    if kind == "scalar":
        number = float(graph.scalar(value))
        return ... if default is not None and abs(number - default) < 1e-7 else number
    values = tuple(value) if hasattr(value, "__iter__") else (float(value),) * 3
    if default is None and not any(values[:3]):
        return ...
    return values


def may_transmit(node):
    """Whether shadow rays must call the shader."""
    names = {"transparency", "cutout_opacity", "transp", "opacity"}
    return type(node).shader in {"transmat", "dielectric_material", "mib_dielectric"} or any(
        s.name in names and (s.is_linked or s.default_value != (1.0 if "opacity" in s.name else 0.0))
        for s in node.inputs)


class ORIEL_MT_nodes(bpy.types.Menu):
    bl_idname = "ORIEL_MT_nodes"
    bl_label = "Oriel"
    library = None

    def draw(self, _context):
        for library in sorted({c.library for c in _classes}):
            self.layout.menu(f"ORIEL_MT_nodes_{library}", text=library.capitalize())


def library_menu(library):
    def draw(self, _context):
        for cls in _classes:
            if cls.library == library:
                add = self.layout.operator("node.add_node", text=cls.bl_label)
                add.type, add.use_transform = cls.bl_idname, True
    return type(f"ORIEL_MT_nodes_{library}", (bpy.types.Menu,),
                {"bl_idname": f"ORIEL_MT_nodes_{library}", "bl_label": library.capitalize(),
                 "draw": draw})


def draw_menu(self, context):
    if getattr(context.space_data, "tree_type", "") == "ShaderNodeTree":
        self.layout.menu(ORIEL_MT_nodes.bl_idname)


_menus = []


def register():
    try:
        declarations = program.declarations()
    except Exception as error:  # without the program there are no native nodes
        print(f"Oriel: no native nodes: {error}")
        declarations = []
    for declaration in declarations:
        cls = class_of(declaration)
        bpy.utils.register_class(cls)
        _classes.append(cls)
    _menus.extend([ORIEL_MT_nodes] + [library_menu(l) for l in sorted({c.library for c in _classes})])
    for menu in _menus:
        bpy.utils.register_class(menu)
    bpy.types.NODE_MT_add.append(draw_menu)


def unregister():
    bpy.types.NODE_MT_add.remove(draw_menu)
    for cls in reversed(_menus):
        bpy.utils.unregister_class(cls)
    _menus.clear()
    for cls in reversed(_classes):
        bpy.utils.unregister_class(cls)
    _classes.clear()
