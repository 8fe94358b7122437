# SPDX-License-Identifier: Apache-2.0
"""Text of the .mi scene language: numbers, names, shader calls and matrices."""
import numpy


class Connection(str):
    """The name of a shader that computes a parameter."""


class Words(str):
    """Text that is written as it is."""


def quoted(text):
    """A string of the language. It cannot contain line breaks."""
    clean = text if text.isprintable() else "".join(" " if ord(c) < 32 else c for c in text)
    return '"' + clean.replace("\\", "\\\\").replace('"', '\\"') + '"'


def number(value):
    value = float(value)
    if not numpy.isfinite(value):
        return "0"
    return f"{value:.9g}"


def numbers(values):
    return " ".join(number(v) for v in values)


def value_text(value):
    """A parameter value: connection, boolean, number, vector or colour, string, list."""
    if value is None:
        return "null"
    if isinstance(value, Connection):
        return "= " + quoted(value)
    if isinstance(value, Words):
        return str(value)
    if isinstance(value, str):
        return quoted(value)
    if isinstance(value, bool):
        return "on" if value else "off"
    if isinstance(value, (int, float)):
        return number(value)
    if isinstance(value, list):
        return "[ " + ", ".join(value_text(v) for v in value) + " ]"
    return numbers(value)


class Call(str):
    """The text of a shader call."""
    shader = ""
    parameters = {}


def call(shader, **parameters):
    """A shader call; parameters whose value is Ellipsis are omitted."""
    return call_of(shader, parameters)


def call_of(shader, parameters):
    inside = ", ".join(f"{quoted(name)} {value_text(value)}"
                       for name, value in parameters.items() if value is not ...)
    result = Call(f"{quoted(shader)} ( {inside} )" if inside else f"{quoted(shader)} ()")
    result.shader, result.parameters = shader, parameters
    return result


def edit_value(value):
    """The value in an edit of the program; None if such a value cannot be edited."""
    if isinstance(value, bool):
        return "on" if value else "off"
    if isinstance(value, (int, float)):
        return number(value)
    if isinstance(value, tuple):
        return numbers(value)
    return None


class Part(str):
    """Text of an element whose values can be edited while the program renders it.

    frame: everything but the values; parts with equal frames differ in values only.
    values: edit target (ELEMENT.PARAMETER) -> value as in an edit.
    """
    frame = None
    values = {}


def part(text, frame, name, values):
    """A part. values: parameter -> value text. Edits cannot name elements with an equals sign."""
    result = Part(text)
    if "=" not in name and not any(ord(c) < 32 for c in name):
        result.frame = frame
        result.values = {f"{name}.{key}": value for key, value in values.items()}
    return result


def call_values(shader_call):
    """The parameters of a call that can be edited, and the frame of the others."""
    values, fixed = {}, [shader_call.shader]
    for key, value in shader_call.parameters.items():
        text = edit_value(value)
        if text is None:
            fixed.append((key, "" if value is ... else value_text(value)))
        else:
            values[key] = text
            fixed.append((key, None, len(value) if isinstance(value, tuple) else 0))
    return values, tuple(fixed)


def edits_between(base, parts):
    """Edits that turn the parts of a scene into others; None if they differ in more than values."""
    if len(base) != len(parts):
        return None
    edits = []
    for old, new in zip(base, parts):
        if old == new:
            continue
        frame = getattr(old, "frame", None)
        if frame is None or frame != getattr(new, "frame", None):
            return None
        edits += [f"{target}={value}" for target, value in new.values.items()
                  if old.values[target] != value]
    return edits


def inverse_rows(to_world):
    """The transform of an instance: the inverse as rows for row vectors, or None if singular."""
    matrix = numpy.array(to_world, dtype=numpy.float64)
    if not numpy.all(numpy.isfinite(matrix)) or abs(numpy.linalg.det(matrix[:3, :3])) < 1e-30:
        return None
    return numpy.linalg.inv(matrix).T.ravel().tolist()


IDENTITY = numpy.eye(4).ravel().tolist()


def transform(to_world, keyword="transform"):
    """The statement, or an empty text if the matrix is the identity; None if it is singular."""
    rows = inverse_rows(to_world)
    if rows is None:
        return None
    return f"  {keyword} {numbers(rows)}\n"


def instance_part(name, element, to_world, extra=""):
    """The text of an instance; None if the matrix is singular."""
    rows = inverse_rows(to_world)
    if rows is None:
        return None
    values = numbers(rows)
    placed = "" if rows == IDENTITY else f"  transform {values}\n"
    text = f"instance {quoted(name)} {quoted(element)}\n{placed}{extra}end instance\n"
    return part(text, ("instance", name, element, extra), name, {"transform": values})


class Names:
    """Unique names of elements."""

    def __init__(self):
        self._used = set()
        self._last = {}  # name -> the last number that was added to it

    def unique(self, wish):
        name, i = wish or "unnamed", self._last.get(wish, 1)
        while name in self._used:
            i += 1
            name = f"{wish}#{i}"
        self._used.add(name)
        self._last[wish] = i
        return name


class SceneText:
    """The parts of one scene file, with unique element names."""

    def __init__(self):
        self.names = Names()
        self.parts = []
        self.members = []

    def add(self, text):
        self.parts.append(text)

    def shader(self, wish, shader, **parameters):
        """Adds a named shader and returns a connection to it."""
        return self.shader_of(wish, shader, parameters)

    def shader_of(self, wish, shader, parameters):
        name = self.names.unique(wish)
        made = call_of(shader, parameters)
        values, fixed = call_values(made)
        self.add(part(f"shader {quoted(name)} {made}\n", ("shader", name, fixed), name, values))
        return Connection(name)

    def light(self, name, shader_call, rest):
        """Adds a light; rest: its other statements."""
        values, fixed = call_values(shader_call)
        self.add(part(f"light {quoted(name)}\n  {shader_call}\n{rest}end light\n",
                      ("light", name, fixed, rest), name, values))

    def instance(self, name, element, to_world, extra=""):
        """Adds an instance to the root group. Returns False if the matrix is singular."""
        placed = instance_part(name, element, to_world, extra)
        if placed is None:
            return False
        self.add(placed)
        self.members.append(name)
        return True

    def text(self):
        return "".join(self.parts)
