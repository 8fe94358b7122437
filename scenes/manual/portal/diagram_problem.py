#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Draws what the gather rays of one point see: outdoors, in a lit room, behind a window, and there
with a portal. Every ray is traced; its colour is what it meets.

    python3 scenes/manual/portal/diagram_problem.py OUT.svg
"""
import math
import sys

SKY, LIT, DARK, INK, BLOCKED = "#3d8fd6", "#e0a526", "#3a3a3a", "#222", "#b0b0b0"
WIDE, HIGH, GAP, RAYS = 225, 165, 15, 22


class Scene:
    """Walls are segments with what a ray finds there; the rest is sky."""

    def __init__(self, title, note, walls, point, lamps=(), portal=None,
                 reach=128):
        self.title, self.note, self.walls, self.point = title, note, walls, point
        self.lamps, self.portal, self.reach = lamps, portal, reach


def hit(origin, direction, wall):
    """Distance to a segment, or None."""
    (x0, y0), (x1, y1), _ = wall
    ex, ey = x1 - x0, y1 - y0
    det = direction[0] * -ey + direction[1] * ex
    if abs(det) < 1e-9:
        return None
    dx, dy = x0 - origin[0], y0 - origin[1]
    t = (dx * -ey + dy * ex) / det
    s = (direction[0] * dy - direction[1] * dx) / det
    return t if t > 1e-6 and 0 <= s <= 1 else None


def traced(scene, angle):
    direction = (math.cos(angle), -math.sin(angle))
    found = [(t, wall[2]) for wall in scene.walls
             if (t := hit(scene.point, direction, wall)) is not None]
    t, colour = min(found, default=(scene.reach, SKY))
    return (scene.point[0] + t * direction[0], scene.point[1] + t * direction[1]), colour


def line(a, b, colour, width=1.0, dash=""):
    return (f'<path d="M{a[0]:.1f} {a[1]:.1f}L{b[0]:.1f} {b[1]:.1f}" stroke="{colour}" '
            f'stroke-width="{width}"{dash}/>')


def drawn(scene, left):
    out = [f'<g transform="translate({left} 30)">',
           f'<text x="{WIDE / 2}" y="-12" text-anchor="middle" font-weight="bold">'
           f'{scene.title}</text>']
    counts = {}
    for k in range(RAYS):
        end, colour = traced(scene, math.pi * (k + 0.5) / RAYS)
        counts[colour] = counts.get(colour, 0) + 1
        out.append(line(scene.point, end, colour, 1.3 if colour != DARK else 0.8))
        out.append(f'<circle cx="{end[0]:.1f}" cy="{end[1]:.1f}" r="1.8" fill="{colour}"/>')
    for a, b, _ in scene.walls:
        out.append(line(a, b, INK, 3))
    for x, y in scene.lamps:
        out.append(f'<circle cx="{x}" cy="{y}" r="6" fill="#ffd447" stroke="{INK}"/>')
    if scene.portal:
        out += shown_portal(scene)
    x, y = scene.point
    out.append(f'<circle cx="{x}" cy="{y}" r="3.5" fill="{INK}"/>')
    words = [f'{counts[c]} see {name}' for c, name in ((SKY, "sky"), (LIT, "lit walls"),
                                                       (DARK, "black")) if c in counts]
    if BLOCKED in counts:
        words.append(f"{counts[BLOCKED]} ends at the portal")
    for n, text in enumerate((f"of {RAYS} rays " + ", ".join(words), scene.note)):
        out.append(f'<text x="{WIDE / 2}" y="{HIGH + 14 + 15 * n}" text-anchor="middle">'
                   f'{text}</text>')
    return out + ["</g>"]


def shown_portal(scene):
    """The portal in the window, and light from it as shadow rays find it."""
    (x0, y0), (x1, y1) = scene.portal
    out = [line((x0, y0), (x1, y1), SKY, 5)]
    for k in range(5):
        s = (k + 0.5) / 5
        out.append(line(scene.point, (x0 + s * (x1 - x0), y0 + s * (y1 - y0)), SKY, 1,
                        ' stroke-dasharray="4 3"'))
    return out


def room(colour, window=True, high=HIGH - 25):
    floor, right = high, 205
    sill, lintel = high - 62, high - 92
    walls = [((20, floor), (right, floor), DARK), ((right, floor), (right, 15), colour),
             ((right, 15), (20, 15), colour), ((20, floor), (20, sill), colour),
             ((20, lintel), (20, 15), colour)]
    if not window:
        walls.append(((20, sill), (20, lintel), colour))
    return walls


def main():
    ground = HIGH - 25
    window = ((20, ground - 62), (20, ground - 92))
    closed = [*room(LIT), (*window, BLOCKED)]
    scenes = [
        Scene("outdoors", "even light: few rays do",
              [((5, ground), (220, ground), DARK), ((150, ground), (150, 75), LIT),
               ((150, 75), (215, 75), LIT)], (80, ground - 1), reach=72),
        Scene("a room with lamps", "lit walls: few rays do", room(LIT), (130, ground - 1),
              ((75, 32), (150, 32))),
        Scene("a window alone", "luck decides who finds it", room(DARK), (130, ground - 1)),
        Scene("a portal in the window", "its light is direct; rays see lit walls", closed,
              (130, ground - 1), (), window)]
    total = len(scenes) * (WIDE + GAP) - GAP
    out = [f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {total} {HIGH + 70}" '
           f'width="{total}" height="{HIGH + 70}" font-family="sans-serif" font-size="11" '
           f'fill="{INK}">', f'<rect width="{total}" height="{HIGH + 70}" fill="#fff"/>']
    for n, scene in enumerate(scenes):
        out += drawn(scene, n * (WIDE + GAP))
    with open(sys.argv[1], "w", encoding="utf-8") as file:
        file.write("\n".join(out) + "\n</svg>\n")


if __name__ == "__main__":
    main()
