"""Writes the drawings of this folder with the programs that users draw with; tests read the files as kept.

Usage: write.py [FOLDER], with the packages of requirements.txt. What each file is stands in README.md.
"""

import itertools
import json
import math
import sys
from pathlib import Path

import ezdxf
import matplotlib
import numpy as np
import shapefile
import shapely
from ezdxf.math import rational_bspline_from_arc
from PIL import Image
from shapely.geometry import Point, mapping

import grains
import inkscape
import pack

matplotlib.use("Agg")
import matplotlib.pyplot as plt
from matplotlib.collections import PatchCollection
from matplotlib.patches import Circle

WIDTH, HEIGHT = pack.BOX[1]
PIXEL = 20e-6
METER_PRJ = (
    'PROJCS["WGS 84 / UTM zone 32N",GEOGCS["WGS 84",DATUM["WGS_1984",SPHEROID["WGS 84",6378137,298.257223563]],'
    'PRIMEM["Greenwich",0],UNIT["degree",0.0174532925199433]],PROJECTION["Transverse_Mercator"],'
    'PARAMETER["latitude_of_origin",0],PARAMETER["central_meridian",9],PARAMETER["scale_factor",0.9996],'
    'PARAMETER["false_easting",500000],PARAMETER["false_northing",0],UNIT["metre",1]]'
)
DEGREE_PRJ = (
    'GEOGCS["WGS 84",DATUM["WGS_1984",SPHEROID["WGS 84",6378137,298.257223563]],'
    'PRIMEM["Greenwich",0],UNIT["degree",0.0174532925199433]]'
)


def polygons(rows: np.ndarray, per_quarter: int, digits: int) -> list:
    """Discs as shapely draws them: polygons with their vertices on the circle, rounded."""
    rounded = [Point(x, y).buffer(r, quad_segs=per_quarter) for x, y, r in rows]
    return [shapely.set_precision(polygon, 10.0**-digits) for polygon in rounded]


def write_lists(folder: Path, rows: np.ndarray) -> None:
    """Disc lists by numpy: one as the program reads it, one with columns of its own."""
    np.savetxt(folder / "pack.xyr", rows, fmt="%.7f", header="x y r")
    table = np.column_stack([np.arange(1, len(rows) + 1), 2e3 * rows[:, 2], 1e3 * rows[:, 0], 1e3 * rows[:, 1]])
    form = ["%d", "%.4f", "%.4f", "%.4f"]
    np.savetxt(folder / "pack-columns.csv", table, fmt=form, delimiter=";", header="id;d_mm;x_mm;y_mm", comments="")


def write_shapely(folder: Path, rows: np.ndarray) -> None:
    """Well-known text in mm and GeoJSON in um."""
    shapes = shapely.MultiPolygon(polygons(1e3 * rows, 12, 6))
    (folder / "pack.wkt").write_text(shapely.to_wkt(shapes, rounding_precision=6) + "\n", encoding="utf-8")
    features = [
        {"type": "Feature", "properties": {"grain": i}, "geometry": mapping(shape)}
        for i, shape in enumerate(polygons(1e6 * rows, 8, 3))
    ]
    text = json.dumps({"type": "FeatureCollection", "features": features}, separators=(",", ":"))
    (folder / "pack.geojson").write_text(
        text.replace('{"type":"Feature"', '\n{"type":"Feature"') + "\n", encoding="utf-8"
    )


def write_shapefile(path: Path, rings: list[list], prj: str) -> None:
    """An ESRI shapefile by pyshp, one record for each list of rings."""
    with shapefile.Writer(str(path), shapeType=shapefile.POLYGON) as writer:
        writer.field("grain", "N")
        for i, parts in enumerate(rings):
            writer.poly(parts)
            writer.record(i)
    path.with_suffix(".prj").write_text(prj, encoding="utf-8")


def write_shapefiles(folder: Path, rows: np.ndarray) -> None:
    """In m, and the same numbers called degrees."""
    rings = [[list(shape.exterior.coords)] for shape in polygons(rows, 16, 10)]
    # Every third ring runs counter-clockwise, which the format keeps for holes: many programs do not care.
    rings = [[part[::-1] for part in parts] if i % 3 == 2 else parts for i, parts in enumerate(rings)]
    write_shapefile(folder / "pack.shp", rings, METER_PRJ)
    write_shapefile(folder / "degrees.shp", rings[:2], DEGREE_PRJ)


def circles(space, rows: np.ndarray) -> None:
    """CIRCLE entities."""
    for x, y, r in rows:
        space.add_circle((x, y), r, dxfattribs={"layer": "posts"})


def bulges(space, rows: np.ndarray) -> None:
    """Each disc as a closed LWPOLYLINE of three unequal arcs."""
    for i, (x, y, r) in enumerate(rows):
        angles = np.array([0.0, 1.0, 3.0, 2 * math.pi]) + 0.7 * i
        points = [
            (x + r * math.cos(a), y + r * math.sin(a), math.tan((b - a) / 4)) for a, b in itertools.pairwise(angles)
        ]
        if i % 2:
            # Every second one runs clockwise.
            points = [(*points[k][:2], -points[k - 1][2]) for k in (2, 1, 0)]
        space.add_lwpolyline(points, format="xyb", close=True, dxfattribs={"layer": "posts"})


def arcs(space, rows: np.ndarray) -> None:
    """Each disc as three ARC entities, in no order."""
    found = [(x, y, r, a + 40 * i) for i, (x, y, r) in enumerate(rows) for a in (0, 100, 250)]
    ends = {0: 100, 100: 250, 250: 360}
    for k in np.random.default_rng(1).permutation(len(found)):
        x, y, r, start = found[k]
        first = (start - 40 * (k // 3)) % 360
        space.add_arc((x, y), r, start, start + ends[first] - first)


def splines(space, rows: np.ndarray) -> None:
    """Each disc as a rational SPLINE, which is the circle exactly."""
    for x, y, r in rows:
        curve = rational_bspline_from_arc(center=(x, y), radius=r, start_angle=0, end_angle=360)
        space.add_spline().apply_construction_tool(curve)


def blocks(space, rows: np.ndarray) -> None:
    """Blocks: a post of radius 1 off its origin, scaled, turned and mirrored; a block within a block."""
    document = space.doc
    post = document.blocks.new("POST", base_point=(3.0, 1.0))
    post.add_circle((5.0, 1.0), 1.0)

    def insert(layout, x: float, y: float, r: float, turn: float, mirror: int) -> None:
        """The center of the post stands two radii from the insertion point, in the direction of the turn."""
        angle = math.radians(turn)
        x0, y0 = x - mirror * 2 * r * math.cos(angle), y - mirror * 2 * r * math.sin(angle)
        layout.add_blockref("POST", (x0, y0), dxfattribs={"xscale": mirror * r, "yscale": r, "rotation": turn})

    pair = document.blocks.new("PAIR")
    for k, (x, y, r) in enumerate(rows[:2]):
        insert(pair, x - rows[0][0], y - rows[0][1], r, 25.0 * k, 1)
    # A turn of the pair about its first post by 90 degrees, undone by one of -90 in a block around it.
    outer = document.blocks.new("OUTER")
    outer.add_blockref("PAIR", (0, 0), dxfattribs={"rotation": 90.0})
    space.add_blockref("OUTER", tuple(rows[0][:2]), dxfattribs={"rotation": -90.0})
    for i, (x, y, r) in enumerate(rows[2:]):
        insert(space, x, y, r, 37.0 * i, -1 if i % 3 == 0 else 1)


def write_dxf(folder: Path, rows: np.ndarray) -> None:
    """DXF by ezdxf: versions, units and entities."""
    plain = [
        ("pack-r12.dxf", "R12", 0, 1e-3, circles),
        ("pack-r2000-inch.dxf", "R2000", ezdxf.units.IN, 25.4e-3, circles),
        ("pack-r2010.dxf", "R2010", ezdxf.units.MM, 1e-3, circles),
        ("pack-arcs.dxf", "R12", 0, 1e-3, arcs),
        ("pack-bulges.dxf", "R2000", ezdxf.units.MM, 1e-3, bulges),
        ("pack-blocks.dxf", "R2000", 13, 1e-6, blocks),
        ("pack-splines.dxf", "R2000", ezdxf.units.CM, 1e-2, splines),
    ]
    for name, version, unit, meters, draw in plain:
        document = ezdxf.new(version)
        document.layers.add("posts")
        if version != "R12":
            document.units = unit
        draw(document.modelspace(), rows / meters)
        document.saveas(folder / name)
    document = ezdxf.new("R2018", units=ezdxf.units.M)
    circles(document.modelspace(), rows)
    document.saveas(folder / "pack-r2018-binary.dxf", fmt="bin")


def figure():
    """A figure that is the box, without margins."""
    made = plt.figure(figsize=(WIDTH / 25.4e-3, HEIGHT / 25.4e-3))
    axes = made.add_axes((0, 0, 1, 1))
    axes.set(xlim=(0, WIDTH), ylim=(0, HEIGHT))
    axes.axis("off")
    return made, axes


def write_matplotlib(folder: Path, rows: np.ndarray) -> None:
    """SVG (circles become cubic curves) and PNG as matplotlib draws them."""
    matplotlib.rcParams["svg.hashsalt"] = "pack"
    made, axes = figure()
    for x, y, r in rows:
        axes.add_patch(Circle((x, y), r, facecolor="black", edgecolor="none"))
    made.savefig(folder / "pack-matplotlib.svg", transparent=True, metadata={"Date": None})
    made.savefig(folder / "pack-matplotlib.png", dpi=25.4e-3 / PIXEL, metadata={"Software": None})
    plt.close(made)
    made, axes = figure()
    axes.add_collection(PatchCollection([Circle((x, y), r) for x, y, r in rows], facecolor="gray", edgecolor="none"))
    made.savefig(folder / "pack-collection.svg", transparent=True, metadata={"Date": None})
    plt.close(made)
    # A white page, as matplotlib draws it unless told not to, and one marker used for every post.
    made, axes = figure()
    axes.scatter(rows[:5, 0], rows[:5, 1], s=(2 * 0.5 / 25.4 * 72) ** 2, color="black", linewidths=0)
    made.savefig(folder / "page.svg", metadata={"Date": None})
    plt.close(made)


def coverage(rows: np.ndarray, samples: int) -> np.ndarray:
    """Share of each pixel that is solid, by samples x samples points; the first row is the top."""
    shape = round(HEIGHT / PIXEL), round(WIDTH / PIXEL)
    x = (np.arange(shape[1] * samples) + 0.5) * PIXEL / samples
    y = HEIGHT - (np.arange(shape[0] * samples) + 0.5) * PIXEL / samples
    solid = np.zeros((len(y), len(x)), dtype=bool)
    for cx, cy, r in rows:
        solid |= (x[None, :] - cx) ** 2 + (y[:, None] - cy) ** 2 < r * r
    return solid.reshape(shape[0], samples, shape[1], samples).mean(axis=(1, 3))


def write_masks(folder: Path, rows: np.ndarray) -> None:
    """Masks by Pillow, solids black: 1 bit, and 8 and 16 bit grey."""
    Image.fromarray(coverage(rows, 1) < 0.5).save(folder / "pack-1bit.tif", compression="tiff_deflate")
    pore = 1.0 - coverage(rows, 8)
    Image.fromarray(np.round(255 * pore).astype(np.uint8)).save(folder / "pack-grey.png", optimize=True)
    Image.fromarray(np.round(65535 * pore).astype(np.uint16)).save(folder / "pack-16bit.png", optimize=True)


def main() -> None:
    """Writes all files."""
    folder = Path(sys.argv[1]) if len(sys.argv) > 1 else Path(__file__).parent
    rows = pack.discs()
    write_lists(folder, rows)
    write_shapely(folder, rows)
    write_shapefiles(folder, rows)
    write_dxf(folder, rows)
    write_matplotlib(folder, rows)
    write_masks(folder, rows)
    inkscape.write_pack(folder / "pack-inkscape.svg", rows)
    inkscape.write_grains(folder / "grains.svg")
    grains.write(folder, write_shapefile, METER_PRJ)


if __name__ == "__main__":
    main()
