# SPDX-License-Identifier: Apache-2.0
"""Light linking (from Blender 4.0): lights that light some objects only, as light lists of instances."""
from . import mi


def members(collection, state="INCLUDE"):
    """Names of the objects of a collection and of those below it, by whether a light includes them."""
    found = {}
    for item in collection.collection_children:
        inner = collection.children[item.name]
        own = item.light_linking.link_state if state == "INCLUDE" else state
        found.update(members(inner, own))
    for ob, item in zip(collection.objects, collection.collection_objects):
        found[ob.name] = item.light_linking.link_state if state == "INCLUDE" else state
    return found


class LightLinks:
    """The lights of a scene that light some objects only."""

    def __init__(self, report):
        self._report = report
        self._lights = []  # name of the instance, and functions of names of objects

    def add(self, ob, instance):
        """Adds a light whose instance was written."""
        linking = getattr(ob, "light_linking", None)
        if linking is None:
            return
        if linking.blocker_collection is not None:
            self._report(f'light "{ob.name}": all objects cast its shadows')
        if linking.receiver_collection is not None:
            states = members(linking.receiver_collection)
            self._lights.append((instance, states, "INCLUDE" in states.values()))

    def statement(self, name):
        """The light list of an instance of the object with that name."""
        dark = [instance for instance, states, only in self._lights
                if (states.get(name) != "INCLUDE" if only else states.get(name) == "EXCLUDE")]
        if not dark:
            return ""
        return f'  light "exclusive" [ {", ".join(mi.quoted(d) for d in dark)} ]\n'


def are_used(instances):
    """Whether a light of the dependency graph lights some objects only."""
    for instance in instances:
        linking = getattr(instance.object, "light_linking", None)
        if instance.object.type == "LIGHT" and linking is not None and (
                linking.receiver_collection is not None or linking.blocker_collection is not None):
            return True
    return False
