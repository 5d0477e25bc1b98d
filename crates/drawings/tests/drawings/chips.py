"""Ten chips as labs draw them, in `chips`.

`chips.json` has the porosity of each and the options that answer its question.

Usage: chips.py FOLDER, with ezdxf, svgwrite, gdstk and KLayout. Tests do not need it.
"""

import json
import math
import random
import sys
from pathlib import Path

import ezdxf
import gdstk
import klayout.db
import svgwrite

WAFER = [(-4, -2), (16, -2), (16, 10), (-4, 10)]
# 12 by 8 with two channels of 2 by 1.
CHAMBER = [
    (0, 0),
    (12, 0),
    (12, 3.5),
    (14, 3.5),
    (14, 4.5),
    (12, 4.5),
    (12, 8),
    (0, 8),
    (0, 4.5),
    (-2, 4.5),
    (-2, 3.5),
    (0, 3.5),
]
IN_PARTS = [
    [(0, 0), (12, 0), (12, 8), (0, 8)],
    [(-2, 3.5), (0.5, 3.5), (0.5, 4.5), (-2, 4.5)],
    [(11.5, 3.5), (14, 3.5), (14, 4.5), (11.5, 4.5)],
]
BOX = [(0, 0), (12, 0), (12, 8), (0, 8)]
TITLE = [(9, 0), (12, 0), (12, 0.3), (9, 0.3)]
QUARTER = math.tan(math.pi / 8)
ROUNDED = [
    (1, 0, 0), (11, 0, QUARTER), (12, 1, 0), (12, 7, QUARTER), (11, 8, 0), (1, 8, QUARTER), (0, 7, 0), (0, 1, QUARTER),
]  # fmt: skip

random.seed(5)


def noise():
    """A number from -0.5 to 0.5."""
    return random.random() - 0.5


POSTS = [
    (1.2 + 1.3 * i + 0.4 * (j % 2) + 0.1 * noise(), 1.2 + 1.4 * j + 0.1 * noise(), 0.4 * (1 + 0.3 * noise()))
    for j in range(5)
    for i in range(8)
]
POST_AREA = sum(math.pi * r * r for _, _, r in POSTS)
# Of the box around the chamber, of the page.
IN_CHAMBER = (100 - POST_AREA) / 128
ON_PAGE = (100 - POST_AREA) / 240


def dxf(path, outlines, posts="POSTS", marks=(), squares=False):
    """Writes outlines with their layers, posts and marks."""
    document = ezdxf.new(units=ezdxf.units.MM)
    space = document.modelspace()
    for layer, corners in outlines:
        kind = "xyb" if len(corners[0]) == 3 else "xy"
        space.add_lwpolyline(corners, format=kind, close=True, dxfattribs={"layer": layer})
    for x, y, r in POSTS:
        if squares:
            corners = [(x - r, y - r), (x + r, y - r), (x + r, y + r), (x - r, y + r)]
            space.add_lwpolyline(corners, close=True, dxfattribs={"layer": posts})
        else:
            space.add_circle((x, y), r, dxfattribs={"layer": posts})
    for layer, x, y in marks:
        space.add_line((x - 0.3, y), (x + 0.3, y), dxfattribs={"layer": layer})
        space.add_line((x, y - 0.3), (x, y + 0.3), dxfattribs={"layer": layer})
        space.add_text("chip", dxfattribs={"layer": layer}).set_placement((x + 0.5, y))
    document.saveas(path)
    cut_down(path)


def cut_down(path):
    """Leaves the unit and the entities of a DXF file."""
    lines = path.read_text().split("\n")
    pairs = [(lines[i].strip(), lines[i + 1].strip()) for i in range(0, len(lines) - 1, 2)]
    unit = pairs[pairs.index(("9", "$INSUNITS")) + 1]
    first = pairs.index(("2", "ENTITIES"))
    last = pairs.index(("0", "ENDSEC"), first)
    entities = [pair for pair in pairs[first:last] if pair[0] not in ("100", "330")]
    head = [("0", "SECTION"), ("2", "HEADER"), ("9", "$INSUNITS"), unit, ("0", "ENDSEC"), ("0", "SECTION")]
    pairs = [*head, *entities, ("0", "ENDSEC"), ("0", "EOF")]
    path.write_text("".join(f"{code}\n{value}\n" for code, value in pairs))


def svg(path, box, shapes, post):
    """Writes shapes and posts on a page."""
    x, y, width, height = box
    drawing = svgwrite.Drawing(path, size=(f"{width}mm", f"{height}mm"), viewBox=f"{x} {y} {width} {height}")
    for shape in shapes:
        drawing.add(shape)
    for x, y, r in POSTS:
        drawing.add(drawing.circle((x, y), r, **post))
    drawing.save()


def gds(path):
    """Writes chamber and posts as GDS, and as the DXF of KLayout."""
    library = gdstk.Library(unit=1e-6, precision=1e-9)
    cell = library.new_cell("CHIP")
    cell.add(gdstk.Polygon([(1e3 * x, 1e3 * y) for x, y in CHAMBER], layer=1))
    for x, y, r in POSTS:
        cell.add(gdstk.ellipse((1e3 * x, 1e3 * y), 1e3 * r, tolerance=5.0, layer=2))
    library.write_gds(path.with_suffix(".gds"))
    layout = klayout.db.Layout()
    layout.read(str(path.with_suffix(".gds")))
    options = klayout.db.SaveLayoutOptions()
    options.format = "DXF"
    layout.write(str(path), options)
    path.with_suffix(".gds").unlink()


def main(folder):
    """Writes all."""
    chip, line = {"fill": "#404040"}, {"fill": "none", "stroke": "black", "stroke_width": 0.02}
    rectangle, polygon = svgwrite.shapes.Rect, svgwrite.shapes.Polygon
    page = (-4, -2, 20, 12)
    marks = [("MARKS", -3, -1), ("MARKS", 14, 9)]
    dxf(folder / "wafer.dxf", [("WAFER", WAFER), ("CHAMBER", CHAMBER)], marks=marks)
    dxf(folder / "one-layer.dxf", [("0", WAFER), ("0", CHAMBER)], posts="0", marks=[("0", -3, -1)])
    dxf(folder / "chamber.dxf", [("CHANNEL", CHAMBER)])
    dxf(folder / "chamber-in-parts.dxf", [("CHANNEL", part) for part in IN_PARTS])
    dxf(folder / "title-block.dxf", [("FRAME", BOX), ("TITLE", TITLE)])
    dxf(folder / "rounded-frame.dxf", [("FRAME", ROUNDED)], squares=True)
    svg(folder / "white.svg", page, [rectangle((-4, -2), (20, 12), **chip), polygon(CHAMBER, fill="white")], chip)
    svg(folder / "colors.svg", page, [rectangle((-4, -2), (20, 12), **chip), polygon(CHAMBER, fill="#4080ff")], chip)
    svg(folder / "lines.svg", (0, 0, 12, 8), [rectangle((0.05, 0.05), (11.9, 7.9), **line)], line)
    gds(folder / "gds.dxf")
    right = {
        "wafer.dxf": {"porosity": IN_CHAMBER},
        "one-layer.dxf": {"porosity": IN_CHAMBER},
        "chamber.dxf": {"porosity": IN_CHAMBER},
        "chamber-in-parts.dxf": {"porosity": IN_CHAMBER},
        "title-block.dxf": {"porosity": 1 - (POST_AREA + 0.9) / 96},
        "rounded-frame.dxf": {"porosity": 1 - sum(4 * r * r for _, _, r in POSTS) / 96},
        "white.svg": {"porosity": ON_PAGE},
        "colors.svg": {"porosity": ON_PAGE, "options": {"nested": "pore"}},
        "lines.svg": {"porosity": 1 - POST_AREA / 96, "options": {"frame": "pore"}},
        "gds.dxf": {"porosity": IN_CHAMBER, "unit": "um", "options": {"nested": "pore"}},
    }
    (folder / "chips.json").write_text(json.dumps(right, indent=1) + "\n")


if __name__ == "__main__":
    main(Path(sys.argv[1]))
