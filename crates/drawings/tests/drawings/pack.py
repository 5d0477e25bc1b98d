"""The pack of discs that most drawings of this folder show, and its porosity in closed form. Lengths in m.

The pack is made by random sequential addition, the largest disc first, from a fixed seed. All discs lie within the box.
"""

import math

import numpy as np

MM = 1e-3
BOX = ((0.0, 0.0), (14e-3, 9e-3))
COUNT = 60
SEED = 2026
MEAN_RADIUS, SPREAD = 0.5 * MM, 0.15 * MM
# Smallest distance of two discs, and twice the smallest distance of a disc and a side: periodic neighbors keep it too.
GAP = 0.12 * MM


def discs() -> np.ndarray:
    """Rows x, y, r. All values are multiples of 0.1 um, so that every format can hold them exactly enough."""
    generator = np.random.default_rng(SEED)
    radii = np.sort(np.round(generator.uniform(MEAN_RADIUS - SPREAD, MEAN_RADIUS + SPREAD, COUNT), 7))[::-1]
    placed = np.empty((0, 3))
    for radius in radii:
        margin = radius + GAP / 2
        for _ in range(100_000):
            low, high = np.add(BOX[0], margin), np.subtract(BOX[1], margin)
            x, y = np.round(generator.uniform(low, high), 7)
            if np.all(np.hypot(placed[:, 0] - x, placed[:, 1] - y) - placed[:, 2] - radius >= GAP):
                placed = np.vstack([placed, [x, y, radius]])
                break
        else:
            raise SystemExit("the pack is too dense for this seed")
    return placed


def box_area(box=BOX) -> float:
    """Area of a box in m2."""
    return (box[1][0] - box[0][0]) * (box[1][1] - box[0][1])


def porosity(rows: np.ndarray, box=BOX) -> float:
    """Share of a box outside of discs that do not overlap; discs that cross its sides count with what lies inside."""
    (x_min, y_min), (x_max, y_max) = box
    inside = sum(disc_in_box(r, x_min - x, x_max - x, y_min - y, y_max - y) for x, y, r in rows)
    return 1.0 - inside / box_area(box)


def disc_in_box(radius: float, left: float, right: float, bottom: float, top: float) -> float:
    """Area of the part of a disc about the origin that lies in a box, by inclusion and exclusion of quadrants."""

    def quadrant(a: float, b: float) -> float:
        """Area of the part of the disc with x < a and y < b."""
        a, b = (min(max(value / radius, -1.0), 1.0) for value in (a, b))

        def below(t: float) -> float:
            """Integral of sqrt(1 - x2) from -1 to t."""
            return 0.5 * (t * math.sqrt(1.0 - t * t) + math.asin(t) + math.pi / 2)

        edge = math.sqrt(1.0 - b * b)
        if b >= 0.0:
            # Full height outside of |x| < edge, up to b between.
            low, high = min(a, -edge), min(max(a, -edge), edge)
            area = 2 * below(low) + (below(high) - below(-edge)) + b * (high + edge)
            area += 2 * (below(a) - below(edge)) if a > edge else 0.0
        else:
            high = min(max(a, -edge), edge)
            area = below(high) - below(-edge) + b * (high + edge)
        return area * radius * radius

    return quadrant(right, top) - quadrant(left, top) - quadrant(right, bottom) + quadrant(left, bottom)
