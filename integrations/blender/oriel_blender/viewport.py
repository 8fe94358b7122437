# SPDX-License-Identifier: Apache-2.0
"""The rendered viewport: a process per view that is restarted on changes, and its newest picture."""


class Session:
    def __init__(self, engine):
        self.engine = engine

    def scene_changed(self, context, depsgraph):
        pass

    def draw(self, context, depsgraph):
        pass

    def stop(self):
        pass
