"""Writes reference.json: pores, throats and entry pressures of the pack by brute force, as an oracle for the program.

Usage: reference.py [FILE]. Every triple of bodies is tried for a local maximum of the wall distance and every pair for
a saddle, without a triangulation. Which pores a throat joins is found by climbing the distance in small steps, and
entry pressures by meniscus.py. Lengths in m; walls of the closed box are endless lines.
"""

import itertools
import json
import math
import sys
from dataclasses import dataclass
from pathlib import Path

import numpy as np

import grains
import meniscus
import pack

# Distances that agree to this, in m, are equal: far below the width of any throat, far above rounding.
EQUAL = 1e-12
RATIOS = [1.0, 0.95, 0.9, 0.85, 0.8]
ANGLES = [40.0, 120.0]
WINDOWS = [((2e-3, 1.5e-3), (12e-3, 7.5e-3)), ((-1e-3, 4e-3), (7e-3, 10e-3)), ((6.5e-3, 1e-3), (7.5e-3, 2.5e-3))]


@dataclass
class Bodies:
    """Discs, with their images where the box is periodic, and the four walls where it is closed."""

    discs: np.ndarray
    names: list[str]
    # Rows n_x, n_y, q: the wall is where n.x = q, the pore where it is larger.
    walls: np.ndarray
    base: int
    period: np.ndarray | None

    def distances(self, point: np.ndarray) -> np.ndarray:
        """Distance of a point from each body, discs first."""
        from_discs = np.hypot(self.discs[:, 0] - point[0], self.discs[:, 1] - point[1]) - self.discs[:, 2]
        return np.concatenate([from_discs, self.walls[:, :2] @ point - self.walls[:, 2]])

    def normals(self, point: np.ndarray, found: np.ndarray) -> np.ndarray:
        """Unit vectors from bodies to a point."""
        return np.array([self.normal(point, k) for k in found])

    def normal(self, point: np.ndarray, k: int) -> np.ndarray:
        """Unit vector from the body k to a point."""
        if k >= len(self.discs):
            return self.walls[k - len(self.discs), :2]
        away = point - self.discs[k, :2]
        return away / np.hypot(*away)

    def in_base(self, point: np.ndarray) -> bool:
        """Whether a point belongs to the box and not to one of its images."""
        return self.period is None or bool(np.all(point >= 0) and np.all(point < self.period))


def closed(rows: np.ndarray) -> Bodies:
    """The box with four walls."""
    (x0, y0), (x1, y1) = pack.BOX
    walls = np.array([[1, 0, x0], [-1, 0, -x1], [0, 1, y0], [0, -1, -y1]], dtype=float)
    names = [f"disc-{i}" for i in range(len(rows))] + ["left", "right", "bottom", "top"]
    return Bodies(rows, names, walls, len(rows), None)


def periodic(rows: np.ndarray) -> Bodies:
    """The box without walls, both directions periodic: the base discs first, then eight images of each."""
    size = np.subtract(pack.BOX[1], pack.BOX[0])
    shifts = [(0, 0)] + [(i, j) for i in (-1, 0, 1) for j in (-1, 0, 1) if (i, j) != (0, 0)]
    discs = np.vstack([rows + np.array([i * size[0], j * size[1], 0]) for i, j in shifts])
    # Images farther than a quarter of the box are never contacts of a point in the box.
    near = np.all((discs[:, :2] > -0.25 * size) & (discs[:, :2] < 1.25 * size), axis=1)
    names = [f"disc-{i}" for _ in shifts for i in range(len(rows))]
    names = [name for name, kept in zip(names, near, strict=True) if kept]
    return Bodies(discs[near], names, np.empty((0, 3)), len(rows), size)


def equidistant(bodies: Bodies, triple: tuple[int, ...]) -> list[tuple[np.ndarray, float]]:
    """Points at equal distance from three bodies of which the first is a disc."""
    x0, y0, r0 = bodies.discs[triple[0]]
    matrix, right = [], []
    for k in triple[1:]:
        if k < len(bodies.discs):
            x, y, r = bodies.discs[k]
            matrix.append([2 * (x - x0), 2 * (y - y0), 2 * (r - r0)])
            right.append((x - x0) ** 2 + (y - y0) ** 2 - (r * r - r0 * r0))
        else:
            nx, ny, q = bodies.walls[k - len(bodies.discs)]
            matrix.append([nx, ny, -1.0])
            right.append(q - nx * x0 - ny * y0)
    matrix = np.array(matrix)
    if abs(np.linalg.det(matrix[:, :2])) < 1e-9 * np.abs(matrix[:, :2]).max() ** 2:
        return []
    # The point seen from the first center is a + b d; then |a + b d| = r0 + d.
    a, b = (np.linalg.solve(matrix[:, :2], column) for column in (np.array(right), -matrix[:, 2]))
    roots = np.roots([b @ b - 1, 2 * (a @ b - r0), a @ a - r0 * r0])
    return [(a + b * d + (x0, y0), float(d)) for d in roots.real[np.abs(roots.imag) < EQUAL] if d > 0]


def maxima(bodies: Bodies) -> list[dict]:
    """Local maxima of the distance: three bodies at equal distance, none nearer, the point in their hull."""
    count = len(bodies.names)
    found: list[dict] = []
    for first in range(len(bodies.discs)):
        rest = range(first + 1, count)
        if bodies.period is not None:
            # A contact of a point farther than this from both would leave room for a disc of a quarter of the box.
            reach = np.hypot(*(bodies.discs[:, :2] - bodies.discs[first, :2]).T)
            rest = [k for k in rest if reach[k] < 0.25 * bodies.period.max()]
        for pair in itertools.combinations(rest, 2):
            for point, d in equidistant(bodies, (first, *pair)):
                if not bodies.in_base(point) or bodies.distances(point).min() < d - EQUAL:
                    continue
                towards = bodies.normals(point, np.array([first, *pair]))
                weights = np.linalg.solve(np.vstack([towards.T, np.ones(3)]), [0, 0, 1])
                if np.all(weights > 0) and not any(np.hypot(*(point - m["at"])) < 1e-9 for m in found):
                    found.append({"at": point, "radius": d, "bodies": [bodies.names[k] for k in (first, *pair)]})
    return found


def saddles(bodies: Bodies) -> list[dict]:
    """Pairs of bodies whose shortest connection has nothing else in the disc that it spans."""
    found = []
    for first, second in itertools.combinations(range(len(bodies.names)), 2):
        if first >= len(bodies.discs):
            continue
        x, y, r = bodies.discs[first]
        center = np.array([x, y])
        if second < len(bodies.discs):
            across = bodies.discs[second, :2] - center
            length = np.hypot(*across)
            width, direction = length - r - bodies.discs[second, 2], across / length
        else:
            direction = -bodies.walls[second - len(bodies.discs), :2]
            width = -(direction @ center) - bodies.walls[second - len(bodies.discs), 2] - r
        middle = center + direction * (r + width / 2)
        if bodies.in_base(middle) and bodies.distances(middle).min() > width / 2 - EQUAL:
            found.append({"at": middle, "width": width, "across": direction, "pair": (first, second)})
    return found


def steepest(normals: np.ndarray) -> np.ndarray:
    """The shortest vector of the convex hull of unit vectors: the steepest ascent of the distance, 0 at a maximum."""
    best = normals[0]
    for a, b in itertools.combinations(normals, 2):
        share = np.clip(np.dot(b, b - a) / max(np.dot(b - a, b - a), 1e-30), 0, 1)
        best = min(best, share * a + (1 - share) * b, key=np.linalg.norm)
    for triple in itertools.combinations(normals, 3):
        matrix = np.vstack([np.transpose(triple), np.ones(3)])
        if abs(np.linalg.det(matrix)) > 1e-12 and np.all(np.linalg.solve(matrix, [0, 0, 1]) > 0):
            return np.zeros(2)
    return best


def climb(bodies: Bodies, point: np.ndarray, pores: list[dict], step: float) -> int:
    """The maximum that the steepest ascent reaches."""
    centers = np.array([pore["at"] for pore in pores])
    for _ in range(100_000):
        away = centers - point
        if bodies.period is not None:
            point = point % bodies.period
            away = (centers - point + bodies.period / 2) % bodies.period - bodies.period / 2
        gap = np.hypot(*away.T)
        if gap.min() < 2 * step:
            return int(gap.argmin())
        d = bodies.distances(point)
        ascent = steepest(bodies.normals(point, np.flatnonzero(d < d.min() + 2 * step)))
        length = np.linalg.norm(ascent)
        if length < 1e-9:
            return int(gap.argmin())
        point = point + ascent * (step / length)
    raise SystemExit("the ascent does not end: the step is too long")


def merged(pores: list[dict], throats: list[dict], ratio: float) -> tuple[int, int]:
    """Numbers of pores and throats left when throats wider than a ratio of a pore are dissolved, the widest first."""
    owner = list(range(len(pores)))
    radius = [pore["radius"] for pore in pores]

    def root(k: int) -> int:
        while owner[k] != k:
            k = owner[k]
        return k

    left = len(throats)
    for throat in sorted(throats, key=lambda throat: -throat["width"]):
        a, b = (root(k) for k in throat["pores"])
        if a != b and throat["width"] / 2 > ratio * min(radius[a], radius[b]):
            small, large = (a, b) if radius[a] < radius[b] else (b, a)
            owner[small] = large
            left -= 1
    return sum(root(k) == k for k in range(len(pores))), left


def network(bodies: Bodies, step: float) -> dict:
    """Pores, throats with what they join and their entry pressures, and the counts after merging."""
    pores, throats = maxima(bodies), saddles(bodies)
    for throat in throats:
        along = np.array([-throat["across"][1], throat["across"][0]])
        throat["pores"] = [climb(bodies, throat["at"] + sign * 2 * step * along, pores, step) for sign in (-1, 1)]
        first, second = throat["pair"]
        throat["bodies"] = [bodies.names[first], bodies.names[second]]
        radii = [bodies.discs[k, 2] if k < len(bodies.discs) else math.inf for k in throat["pair"]]
        throat["entry"] = [meniscus.entry_curvature(*radii, throat["width"], math.radians(a)) for a in ANGLES]
    return {"pores": pores, "throats": throats, "merged": [merged(pores, throats, ratio) for ratio in RATIOS]}


def plain(found: dict) -> dict:
    """The same as rows of numbers and names."""
    pores = [[*map(float, p["at"]), p["radius"], *p["bodies"]] for p in found["pores"]]
    throats = [
        [*map(float, t["at"]), float(t["width"]), *t["pores"], *t["bodies"], *t["entry"]] for t in found["throats"]
    ]
    counts = [[ratio, *numbers] for ratio, numbers in zip(RATIOS, found["merged"], strict=True)]
    return {"merged": counts, "pores": pores, "throats": throats}


def main() -> None:
    """Writes the file, a row a line."""
    file = Path(sys.argv[1]) if len(sys.argv) > 1 else Path(__file__).parent / "reference.json"
    rows = pack.discs()
    step = 2e-6
    networks = {}
    for name, bodies, euler in (("closed", closed(rows), 1 - len(rows)), ("periodic", periodic(rows), -len(rows))):
        found = network(bodies, step)
        if len(found["pores"]) - len(found["throats"]) != euler:
            raise SystemExit(f"{name}: {len(found['pores'])} pores and {len(found['throats'])} throats: one is missing")
        networks[name] = plain(found)
    content = {
        "columns": {
            "discs": ["x_m", "y_m", "radius_m"],
            "windows": ["x_min_m", "y_min_m", "x_max_m", "y_max_m", "porosity"],
            "merged": ["persistence", "pores", "throats"],
            "pores": ["x_m", "y_m", "radius_m", "body", "body", "body"],
            "throats": ["x_m", "y_m", "width_m", "pore", "pore", "body", "body"]
            + [f"entry_curvature_per_m at {angle:g} degrees through the defending phase" for angle in ANGLES],
        },
        "box": [*pack.BOX[0], *pack.BOX[1]],
        "porosity": pack.porosity(rows),
        "grains": {"box": [0.0, 0.0, grains.WIDTH * 1e-3, grains.HEIGHT * 1e-3], "porosity": grains.porosity()},
        "windows": [[*low, *high, pack.porosity(rows, (low, high))] for low, high in WINDOWS],
        "discs": rows.tolist(),
        **networks,
    }
    text = json.dumps(content)
    for split in ("], [", '], "', '}, "'):
        text = text.replace(split, split[0] + ",\n" + split[3:])
    file.write_text(text + "\n", encoding="utf-8")
    for name, found in networks.items():
        print(name, found["merged"])


if __name__ == "__main__":
    main()
