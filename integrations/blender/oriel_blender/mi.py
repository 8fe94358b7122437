# SPDX-License-Identifier: Apache-2.0
"""Text of the .mi scene language: numbers, names, shader calls and matrices."""
import numpy


class Connection(str):
    """The name of a shader that computes a parameter."""


class Words(str):
    """Text that is written as it is."""


def quoted(text):
    """A string of the language. It cannot contain line breaks."""
    clean = "".join(" " if ord(c) < 32 else c for c in text)
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


def call(shader, **parameters):
    """A shader call; parameters whose value is Ellipsis are omitted."""
    return call_of(shader, parameters)


def call_of(shader, parameters):
    inside = ", ".join(f"{quoted(name)} {value_text(value)}"
                       for name, value in parameters.items() if value is not ...)
    return f"{quoted(shader)} ( {inside} )" if inside else f"{quoted(shader)} ()"


def inverse_rows(to_world):
    """The transform of an instance: the inverse as rows for row vectors, or None if singular."""
    matrix = numpy.array(to_world, dtype=numpy.float64)
    if not numpy.all(numpy.isfinite(matrix)) or abs(numpy.linalg.det(matrix[:3, :3])) < 1e-30:
        return None
    return numpy.linalg.inv(matrix).T.ravel()


def transform(to_world, keyword="transform"):
    """The statement, or an empty text if the matrix is the identity; None if it is singular."""
    rows = inverse_rows(to_world)
    if rows is None:
        return None
    if keyword == "transform" and numpy.array_equal(rows, numpy.eye(4).ravel()):
        return ""
    return f"  {keyword} {numbers(rows)}\n"


class Names:
    """Unique names of elements."""

    def __init__(self):
        self._used = set()

    def unique(self, wish):
        name, i = wish or "unnamed", 1
        while name in self._used:
            i += 1
            name = f"{wish}#{i}"
        self._used.add(name)
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
        self.add(f"shader {quoted(name)} {call_of(shader, parameters)}\n")
        return Connection(name)

    def instance(self, name, element, to_world, extra=""):
        """Adds an instance to the root group. Returns False if the matrix is singular."""
        placed = transform(to_world)
        if placed is None:
            return False
        self.add(f"instance {quoted(name)} {quoted(element)}\n{placed}{extra}end instance\n")
        self.members.append(name)
        return True

    def text(self):
        return "".join(self.parts)
