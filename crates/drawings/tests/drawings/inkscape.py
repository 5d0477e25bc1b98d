"""SVG files as Inkscape writes them: layers, nested transforms, `use`, units in mm. Written as text."""

import math
from pathlib import Path

import numpy as np

import grains
import pack

HEAD = """<?xml version="1.0" encoding="UTF-8" standalone="no"?>
<!-- Created with Inkscape (http://www.inkscape.org/) -->
<svg width="{width}mm" height="{height}mm" viewBox="{box}" version="1.1" id="svg1" sodipodi:docname="{name}"
   xmlns:inkscape="http://www.inkscape.org/namespaces/inkscape"
   xmlns:sodipodi="http://sodipodi.sourceforge.net/DTD/sodipodi-0.dtd"
   xmlns:xlink="http://www.w3.org/1999/xlink" xmlns="http://www.w3.org/2000/svg" xmlns:svg="http://www.w3.org/2000/svg">
  <sodipodi:namedview id="namedview1" pagecolor="#ffffff" inkscape:document-units="mm" />
"""
# A user unit of the pack is 10 um; y runs downwards.
UNIT = 1e-5
HEIGHT = pack.BOX[1][1] / UNIT
SHIFT = (130.0, -70.0)


def number(value: float) -> str:
    """A number with the precision of 0.1 nm."""
    return f"{value:.5f}".rstrip("0").rstrip(".")


def text(template: str, **values: float) -> str:
    """A template with numbers put in."""
    return template.format(**{name: number(value) for name, value in values.items()})


def circle(x: float, y: float, r: float) -> str:
    """A circle."""
    return text('<circle cx="{x}" cy="{y}" r="{r}" />', x=x, y=y, r=r)


def arc_path(x: float, y: float, r: float) -> str:
    """What Inkscape makes of a circle: a path of two arcs with the shape beside it."""
    return text(
        '<path sodipodi:type="arc" sodipodi:cx="{x}" sodipodi:cy="{y}" sodipodi:rx="{r}" sodipodi:ry="{r}"'
        ' d="M {right},{y} A {r},{r} 0 0 1 {x},{bottom} {r},{r} 0 1 1 {right},{y} Z" />',
        x=x, y=y, r=r, right=x + r, bottom=y + r,
    )  # fmt: skip


def relative_path(x: float, y: float, r: float) -> str:
    """Relative quarter arcs, counter-clockwise on the page, with flags run together."""
    return text(
        '<path d="m{x} {top}a{r} {r} 0 00-{r} {r} {r} {r} 0 00{r} {r} {r} {r} 0 00{r}-{r} {r} {r} 0 00-{r}-{r}z" />',
        x=x, top=y - r, r=r,
    )  # fmt: skip


def used(x: float, y: float, r: float) -> str:
    """A post of radius 100 from the definitions."""
    return text('<use xlink:href="#post" transform="matrix({s},0,0,{s},{x},{y})" />', x=x, y=y, s=r / 100)


def used_at(x: float, y: float, r: float) -> str:
    """The same, placed by x and y inside of a scale, through a second `use`."""
    s = r / 100
    return text('<use href="#alias" x="{x}" y="{y}" transform="scale({s})" />', x=x / s, y=y / s, s=s)


def stretched(x: float, y: float, r: float) -> str:
    """An ellipse that a scale makes round."""
    template = '<g transform="scale(2,0.5)"><ellipse cx="{x}" cy="{y}" rx="{rx}" ry="{ry}" /></g>'
    return text(template, x=x / 2, y=2 * y, rx=r / 2, ry=2 * r)


def turned(x: float, y: float, r: float) -> str:
    """Two turns about different points, and a skew that the next one undoes."""
    a = math.radians(-35.0)
    dx, dy = x - 300.0, y - 200.0
    x, y = 300.0 + dx * math.cos(a) - dy * math.sin(a), 200.0 + dx * math.sin(a) + dy * math.cos(a)
    skews = "skewX(20) skewX(-20)"
    return f'<g transform="rotate(35,300,200)"><g transform="translate(5) {skews}">{circle(x - 5, y, r)}</g></g>'


def nested(x: float, y: float, r: float) -> str:
    """A drawing within the drawing, with a viewBox of its own that does not have its proportions."""
    return text(
        '<svg x="{left}" y="{top}" width="{width}" height="{height}" viewBox="-1 -1 2 2"><circle r="1" /></svg>',
        left=x - 2 * r, top=y - r, width=4 * r, height=2 * r,
    )  # fmt: skip


def rounded(x: float, y: float, r: float) -> str:
    """A square whose corners are rounded by half its side."""
    template = '<rect x="{left}" y="{top}" width="{d}" height="{d}" ry="{r}" />'
    return text(template, left=x - r, top=y - r, d=2 * r, r=r)


FORMS = [circle, arc_path, relative_path, used, used_at, stretched, turned, nested, rounded]


def write_pack(path: Path, rows: np.ndarray) -> None:
    """The pack: each disc in one of nine forms, in a layer shifted twice; other layers hold nothing solid."""
    size = [1e3 * value for value in pack.BOX[1]]
    box = f"0 0 {number(pack.BOX[1][0] / UNIT)} {number(HEIGHT)}"
    lines = [HEAD.format(width=number(size[0]), height=number(size[1]), box=box, name=path.name)]
    lines.append(
        '  <defs id="defs1">\n    <style>.post { fill: #303030; fill-rule: nonzero } .helper { fill: none }</style>\n'
        '    <clipPath id="clip1"><circle cx="700" cy="450" r="400" /></clipPath>\n'
        '    <circle id="post" r="100" />\n    <use id="alias" href="#post" />\n  </defs>\n'
        f'  <g inkscape:groupmode="layer" inkscape:label="Posts" id="layer1" class="post" '
        f'transform="translate({number(SHIFT[0])},{number(SHIFT[1])})">\n    <g transform="matrix(1 0 0 1 -30 70)">\n'
    )
    for i, (x, y, r) in enumerate(rows / UNIT):
        lines.append(f"      {FORMS[i % len(FORMS)](x - SHIFT[0] + 30.0, HEIGHT - y - SHIFT[1] - 70.0, r)}\n")
    lines.append(
        "    </g>\n  </g>\n"
        '  <g inkscape:groupmode="layer" inkscape:label="Old" id="layer2" style="display:none">\n'
        '    <circle cx="100" cy="100" r="90" />\n  </g>\n'
        '  <g inkscape:groupmode="layer" inkscape:label="Notes" id="layer3">\n'
        '    <text x="20" y="40" style="font-size:30px"><tspan>inlet</tspan></text>\n'
        '    <path class="helper" style="stroke:#ff0000;stroke-width:2" d="M 0,450 H 1400" />\n'
        '    <circle visibility="hidden" cx="1300" cy="100" r="90" />\n  </g>\n</svg>\n'
    )
    path.write_text("".join(lines), encoding="utf-8")


def points(ring: list) -> str:
    """Points of a ring with y downwards, in mm."""
    return " ".join(f"{number(x)},{number(grains.HEIGHT - y)}" for x, y in ring)


def write_grains(path: Path) -> None:
    """The second drawing in a file without viewBox units of its own: user units are mm."""
    box = f"0 0 {number(grains.WIDTH)} {number(grains.HEIGHT)}"
    lines = [HEAD.format(width=number(grains.WIDTH), height=number(grains.HEIGHT), box=box, name=path.name)]
    (x0, y), (x1, _), s = grains.STADIUM
    (left, bottom), (right, top), r = grains.ROUNDED
    (cx, cy), axes, turn = grains.ELLIPSE
    x, island_y, island_r = grains.ISLAND
    stadium = f"M {x0} {grains.HEIGHT - y - s} H {x1} a {s} {s} 0 0 1 0 {2 * s} H {x0} a {s} {s} 0 0 1 0 {-2 * s} z"
    lines.append(
        '  <g inkscape:groupmode="layer" inkscape:label="Grains" id="layer1">\n'
        f'    <path fill-rule="evenodd" d="M {points(grains.SQUARE)} Z M {points(grains.SQUARE_HOLE)} Z" />\n'
        f"    {circle(x, grains.HEIGHT - island_y, island_r)}\n"
        f'    <polygon points="{points(grains.TRIANGLE)}" />\n'
        f'    <path style="fill:#808080;stroke:none" d="M {points(grains.ANGLE)}" />\n'
        f'    <path d="{stadium}" />\n'
        f'    <ellipse transform="rotate({-turn},{cx},{number(grains.HEIGHT - cy)})" cx="{cx}" '
        f'cy="{number(grains.HEIGHT - cy)}" rx="{axes[0]}" ry="{axes[1]}" />\n'
        f'    <rect x="{left}" y="{number(grains.HEIGHT - top)}" width="{number(right - left)}" '
        f'height="{number(top - bottom)}" rx="{r}" />\n'
        "  </g>\n</svg>\n"
    )
    path.write_text("".join(lines), encoding="utf-8")
