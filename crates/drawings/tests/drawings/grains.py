"""The second drawing: shapes that are no discs, with holes, arcs and an ellipse; areas in closed form. In mm."""

import json
import math
from pathlib import Path

import ezdxf
import numpy as np
import shapely
from ezdxf.math import rational_bspline_from_ellipse
from shapely import affinity
from shapely.geometry import LineString, Point, Polygon, mapping

WIDTH, HEIGHT = 10.0, 6.0
SQUARE = [(0.5, 0.5), (3.5, 0.5), (3.5, 3.5), (0.5, 3.5)]
SQUARE_HOLE = [(1.0, 1.0), (1.0, 3.0), (3.0, 3.0), (3.0, 1.0)]
# Center and radius of a disc in the hole.
ISLAND = (2.0, 2.0, 0.6)
TRIANGLE = [(0.6, 4.2), (3.1, 4.4), (1.7, 5.6)]
ANGLE = [(4.2, 0.6), (6.2, 0.6), (6.2, 1.3), (5.0, 1.3), (5.0, 2.9), (4.2, 2.9)]
# Both ends of the axis and the radius of a stadium whose axis runs along x.
STADIUM = ((4.4, 4.6), (6.4, 4.6), 0.7)
# Center, half axes, turn in degrees.
ELLIPSE = ((8.3, 1.9), (1.3, 0.6), 30.0)
# Two corners and the radius of a rectangle with rounded corners.
ROUNDED = ((7.4, 3.7), (9.6, 5.5), 0.4)


def shoelace(ring: list) -> float:
    """Area of a ring of points."""
    x, y = np.asarray(ring).T
    return 0.5 * abs(float(np.dot(x, np.roll(y, -1)) - np.dot(y, np.roll(x, -1))))


def areas() -> dict[str, float]:
    """Areas in mm2."""
    (x0, _), (x1, _), s = STADIUM
    (left, bottom), (right, top), r = ROUNDED
    return {
        "square with hole": shoelace(SQUARE) - shoelace(SQUARE_HOLE),
        "island in the hole": math.pi * ISLAND[2] ** 2,
        "triangle": shoelace(TRIANGLE),
        "angle": shoelace(ANGLE),
        "stadium": 2 * s * (x1 - x0) + math.pi * s * s,
        "ellipse": math.pi * ELLIPSE[1][0] * ELLIPSE[1][1],
        "rounded rectangle": (right - left) * (top - bottom) - (4 - math.pi) * r * r,
    }


def porosity() -> float:
    """Share of the box that is not solid."""
    return 1.0 - sum(areas().values()) / (WIDTH * HEIGHT)


def sampled() -> list[Polygon]:
    """The shapes as shapely draws them, arcs with 32 segments a quarter."""
    start, end, radius = STADIUM
    (left, bottom), (right, top), corner = ROUNDED
    core = shapely.box(left + corner, bottom + corner, right - corner, top - corner)
    center, axes, turn = ELLIPSE
    ellipse = affinity.rotate(affinity.scale(Point(center).buffer(1.0, quad_segs=32), *axes), turn, origin=center)
    return [
        Polygon(SQUARE, [SQUARE_HOLE]),
        Point(ISLAND[:2]).buffer(ISLAND[2], quad_segs=32),
        Polygon(TRIANGLE),
        Polygon(ANGLE),
        LineString([start, end]).buffer(radius, quad_segs=32),
        ellipse,
        core.buffer(corner, quad_segs=32),
    ]


def write_dxf(path: Path) -> None:
    """DXF 2007 in mm: chains of LINE and ARC, bulges, ELLIPSE, and much that is no shape, on several layers."""
    document = ezdxf.new("R2007", units=ezdxf.units.MM)
    for name in ("grains", "notes", "construction"):
        document.layers.add(name)
    document.layers.get("construction").freeze()
    space = document.modelspace()
    on = {"layer": "grains"}
    space.add_lwpolyline(SQUARE, close=True, dxfattribs=on)
    # Closed by repeating the first point, without the closed flag.
    space.add_lwpolyline([*SQUARE_HOLE, SQUARE_HOLE[0]], dxfattribs=on)
    space.add_circle(ISLAND[:2], ISLAND[2], dxfattribs=on)
    # Lines in no order and direction.
    for start, end in ((2, 0), (0, 1), (2, 1)):
        space.add_line(TRIANGLE[start], TRIANGLE[end], dxfattribs=on)
    space.add_polyline2d(ANGLE, close=True, dxfattribs=on)
    (x0, y), (x1, _), s = STADIUM
    space.add_line((x0, y - s), (x1, y - s), dxfattribs=on)
    space.add_arc((x0, y), s, 90, 270, dxfattribs=on)
    space.add_line((x0, y + s), (x1, y + s), dxfattribs=on)
    space.add_arc((x1, y), s, -90, 90, dxfattribs=on)
    center, axes, turn = ELLIPSE
    major = (axes[0] * math.cos(math.radians(turn)), axes[0] * math.sin(math.radians(turn)))
    space.add_ellipse(center, major, axes[1] / axes[0], dxfattribs=on)
    (left, bottom), (right, top), r = ROUNDED
    quarter = math.tan(math.pi / 8)
    points = [
        (left + r, bottom, 0), (right - r, bottom, quarter), (right, bottom + r, 0), (right, top - r, quarter),
        (right - r, top, 0), (left + r, top, quarter), (left, top - r, 0), (left, bottom + r, quarter),
    ]  # fmt: skip
    space.add_lwpolyline(points, format="xyb", close=True, dxfattribs=on)
    space.add_text("grain 1", height=0.3, dxfattribs={"layer": "notes"}).set_placement((1.0, 2.0))
    space.add_mtext("seven grains", dxfattribs={"layer": "notes"})
    space.add_hatch(color=2, dxfattribs=on).paths.add_polyline_path(TRIANGLE, is_closed=True)
    space.add_line((0, 0), (WIDTH, HEIGHT), dxfattribs={"layer": "notes"})
    space.add_point((5, 5), dxfattribs={"layer": "notes"})
    space.add_circle((5.5, 2.2), 0.3, dxfattribs={"layer": "construction"})
    document.saveas(path)


def write_spline(path: Path) -> None:
    """The ellipse and the island as SPLINE: one rational, one through fit points only."""
    document = ezdxf.new("R2000", units=ezdxf.units.MM)
    space = document.modelspace()
    center, axes, turn = ELLIPSE
    ellipse = ezdxf.math.ConstructionEllipse(center, (axes[0], 0, 0), ratio=axes[1] / axes[0])
    ellipse.transform(
        ezdxf.math.Matrix44.translate(-center[0], -center[1], 0)
        @ ezdxf.math.Matrix44.z_rotate(math.radians(turn))
        @ ezdxf.math.Matrix44.translate(*center, 0)
    )
    space.add_spline().apply_construction_tool(rational_bspline_from_ellipse(ellipse))
    x, y, r = ISLAND
    angles = np.linspace(0, 2 * math.pi, 17)
    space.add_spline(fit_points=[(x + r * math.cos(a), y + r * math.sin(a), 0) for a in angles])
    document.saveas(path)


def write(folder: Path, write_shapefile, prj: str) -> None:
    """All files of this drawing but the SVG, which inkscape.py writes."""
    write_dxf(folder / "grains.dxf")
    write_spline(folder / "grains-splines.dxf")
    shapes = [shapely.set_precision(shape, 1e-6) for shape in sampled()]
    text = shapely.to_wkt(shapely.MultiPolygon(shapes), rounding_precision=6)
    (folder / "grains.wkt").write_text(text + "\n", encoding="utf-8")
    collection = mapping(shapely.GeometryCollection(shapes))
    (folder / "grains.geojson").write_text(json.dumps(collection) + "\n", encoding="utf-8")
    rings = [[list(s.exterior.coords), *(list(hole.coords) for hole in s.interiors)] for s in shapes]
    write_shapefile(folder / "grains.shp", rings, prj)
