# SPDX-License-Identifier: Apache-2.0
"""The manual's figures listed in scenes/manual/*/figures.toml, their images and measured values."""
import dataclasses
import json
import math
import pathlib
import re
import tomllib

import numpy
import OpenImageIO as oiio

HERE = pathlib.Path(__file__).resolve().parent
SCENES = HERE.parents[1] / "scenes"
STATUS = {"kept": "matches"}  # names in STATUS.md
GAP, LABEL = 6, 26  # pixels between panels, and of the text under one
SIZES = {1: "640x360", 2: "476x357", 3: "316x316", 4: "235x235"}


@dataclasses.dataclass
class Panel:
    scene: pathlib.Path
    args: list
    label: str
    tonemap: list  # options of `oriel tonemap`, where it makes the picture
    denoise: bool
    layer: str  # of the EXR file, where it is what is shown


@dataclasses.dataclass
class Figure:
    """One entry of a list; `numbers` are its tables as written there."""
    folder: pathlib.Path
    name: str
    section: str
    shows: str
    page: pathlib.Path
    status: str
    panels: list
    numbers: list
    columns: int
    script: pathlib.Path | None

    @property
    def image(self):
        return HERE / "images" / f"{self.name}.{'svg' if self.script else 'jpg'}"


def load(folder):
    """The figures of one section's folder."""
    with open(folder / "figures.toml", "rb") as file:
        entries = tomllib.load(file).get("figure", [])
    return [figure(folder, entry) for entry in entries]


def figure(folder, entry):
    panels = entry.get("panel", [])
    columns = entry.get("columns", 0) or len(panels)
    size = [] if any("--size" in p.get("args", []) + entry.get("args", []) for p in panels) \
        else ["--size", SIZES.get(columns, "316x237")]
    script = folder / entry["script"] if entry.get("kind") == "diagram" else None
    return Figure(folder, entry["name"], entry["section"], entry["shows"], HERE / entry["page"],
                  entry["status"],
                  [Panel(folder / p["scene"], [*size, *entry.get("args", []), *p.get("args", [])],
                         p.get("label", ""), p.get("tonemap", []), p.get("denoise", True),
                         p.get("layer", ""))
                   for p in panels],
                  entry.get("number", []), columns, script)


def load_all():
    return [f for toml in sorted(SCENES.glob("manual/*/figures.toml")) for f in load(toml.parent)]


# --- pictures

class Picture:
    """A rendered EXR file, its layers read when they are asked for, and the file shown of it."""

    def __init__(self, path, seconds, shown):
        self.path, self.seconds, self.shown, self.layers = path, seconds, shown, {}

    def layer(self, name):
        if name not in self.layers:
            spec = oiio.ImageInput.open(str(self.path)).spec()
            prefix = f"{name}." if name else "linear."
            if not name and spec.channelindex("linear.R") < 0:
                prefix = ""
            wanted = [spec.channelindex(prefix + c) for c in "RGB"]
            if min(wanted) < 0:
                wanted = [spec.channelindex(name)] * 3
            if min(wanted) < 0:
                raise ValueError(f"{self.path.name} has no layer {name}")
            pixels = oiio.ImageBuf(str(self.path)).get_pixels(oiio.FLOAT)
            self.layers[name] = pixels[:, :, wanted]
        return self.layers[name]

    def view(self, layer):
        """Pixels of the file that is shown, or of one layer in sRGB."""
        if not layer:
            return oiio.ImageBuf(str(self.shown)).get_pixels(oiio.FLOAT)[:, :, :3]
        light = self.layer(layer).clip(0, 1)
        return numpy.where(light < 0.0031308, 12.92 * light, 1.055 * light ** (1 / 2.4) - 0.055)

    def part(self, x0, y0, x1, y1, layer=""):
        """Pixels of a rectangle, 0..1 from the upper left."""
        pixels = self.layer(layer)
        high, wide = pixels.shape[:2]
        return pixels[round(y0 * high):max(round(y1 * high), round(y0 * high) + 1),
                      round(x0 * wide):max(round(x1 * wide), round(x0 * wide) + 1)]

    def display(self, x0, y0, x1, y1):
        """Mean of a rectangle of the picture that is shown, 0..1."""
        pixels = oiio.ImageBuf(str(self.shown)).get_pixels(oiio.FLOAT)
        high, wide = pixels.shape[:2]
        return float(pixels[round(y0 * high):round(y1 * high),
                            round(x0 * wide):round(x1 * wide), :3].mean())


def measure(expression, pictures):
    """Value of a figure's number."""
    weights = numpy.array([0.2126, 0.7152, 0.0722])

    def grey(panel, *box, layer=""):
        return pictures[panel].part(*box, layer) @ weights

    names = {name: getattr(math, name) for name in dir(math) if not name.startswith("_")}
    names |= {"abs": abs, "min": min, "max": max, "sum": sum, "numpy": numpy, "range": range,
              "lum": lambda panel, *box, layer="": float(grey(panel, *box, layer=layer).mean()),
              "std": lambda panel, *box, layer="": float(grey(panel, *box, layer=layer).std()),
              "rgb": lambda panel, *box, layer="": pictures[panel].part(*box, layer)
              .reshape(-1, 3).mean(axis=0),
              "pixels": lambda panel, *box, layer="": pictures[panel].part(*box, layer),
              "shown": lambda panel, *box: pictures[panel].display(*box),
              "time": lambda panel: pictures[panel].seconds}
    return float(eval(expression, {"__builtins__": {}, **names}))  # our own lists


def holds(number, value):
    if "relation" in number:
        return bool(eval(f"{value!r} {number['relation']}", {"__builtins__": {}}))
    return abs(value - number["expected"]) <= number["tolerance"]


def mosaic(pictures, panels, columns, path):
    """Pictures in rows, each with its label below, as JPEG."""
    labelled = any(panel.label for panel in panels)
    tiles = [tile(picture.view(panel.layer), panel.label if labelled else None)
             for picture, panel in zip(pictures, panels)]
    rows = [tiles[n:n + columns] for n in range(0, len(tiles), columns)]
    wide = max(sum(t.shape[1] + GAP for t in row) - GAP for row in rows)
    lines = []
    for row in rows:
        line = numpy.ones((max(t.shape[0] for t in row), wide, 3), numpy.float32)
        x = (wide - sum(t.shape[1] + GAP for t in row) + GAP) // 2
        for t in row:
            line[:t.shape[0], x:x + t.shape[1]] = t
            x += t.shape[1] + GAP
        lines += [line, numpy.ones((GAP, wide, 3), numpy.float32)]
    pixels = numpy.concatenate(lines[:-1])
    spec = oiio.ImageSpec(wide, pixels.shape[0], 3, oiio.UINT8)
    spec.attribute("Compression", "jpeg:88")
    out = oiio.ImageOutput.create(str(path))
    out.open(str(path), spec)
    out.write_image(pixels)
    out.close()


def tile(pixels, label):
    """A picture over a line of text, unless there is none in its figure."""
    if label is None:
        return pixels
    wide = pixels.shape[1]
    strip = oiio.ImageBuf(oiio.ImageSpec(wide, LABEL, 3, oiio.FLOAT))
    oiio.ImageBufAlgo.fill(strip, (1.0, 1.0, 1.0))
    if label:
        oiio.ImageBufAlgo.render_text(strip, wide // 2, LABEL // 2, label, 14, "DejaVuSans",
                                      (0.25, 0.25, 0.25), "center", "center")
    return numpy.concatenate([pixels, strip.get_pixels(oiio.FLOAT)])


# --- pages

def measured(folder):
    """What the last build measured: by figure, seconds and the values of its numbers."""
    file = folder / "numbers.json"
    return json.loads(file.read_text(encoding="utf-8")) if file.is_file() else {}


def short(value):
    return f"{value:.3g}" if abs(value) < 1000 else f"{value:.0f}"


def number_table(figures):
    rows = ["| figure | claim | expected | measured |", "|---|---|---|---|"]
    for f in figures:
        values = measured(f.folder).get(f.name, {}).get("values", [])
        for number, value in zip(f.numbers, values):
            expected = number.get("relation") or \
                f"{short(number['expected'])} ± {short(number['tolerance'])}"
            rows.append(f"| {f.name} | {number['claim']} | {expected} | {short(value)} |")
    return "\n".join(rows)


def page_text(page, figures):
    """The page with its table as the numbers are now."""
    table = number_table([f for f in figures if f.page == page])
    return re.sub(r"(<!-- numbers -->).*?(<!-- end -->)",
                  lambda match: f"{match[1]}\n{table}\n{match[2]}",
                  page.read_text(encoding="utf-8"), flags=re.S)


def status_text(figures):
    kept = sum(f.status == "kept" for f in figures)
    numbers = [measured(f.folder).get(f.name, {}) for f in figures]
    count = sum(len(n.get("values", [])) for n in numbers)
    lines = ["# Status of the figures", "",
             f"{len(figures)} figures: {kept} match the manual, "
             f"{len(figures) - kept} differ. {count} measured values. Render time of all images: "
             f"{sum(n.get('seconds', 0) for n in numbers) / 60:.0f} minutes on one core. Written by `docs/manual/build`."]
    for page in dict.fromkeys(f.page for f in figures):
        lines += ["", f"## [{page.stem}]({page.name})", "",
                  "| section | figure | status |", "|---|---|---|"]
        lines += [f"| {f.section} | {f.shows} | {STATUS.get(f.status, f.status)} |" for f in figures if f.page == page]
    return "\n".join(lines) + "\n"
