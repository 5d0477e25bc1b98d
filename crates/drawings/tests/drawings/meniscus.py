"""Entry pressure of a throat by shooting: arcs leave one wall at the contact angle and are to meet the other one at it.

No closed formula for menisci is used: the arc is followed to where it meets the other wall, the angle there is
compared with the one wanted, and the largest curvature for which both agree anywhere along the wall is the entry
curvature.
"""

import math

import numpy as np


def angle_error(s, k, radius: float, opposite: float, width: float, theta: float):
    """Angle at the opposite wall less the one wanted, NaN where the arc does not reach it.

    The first wall is a disc of `radius` about the origin, the opposite one above it a disc of radius `opposite` or a
    line, `width` away. The meniscus advances along +x; it leaves the first wall at the angle `s` from the line of
    centers, with curvature `k` > 0, its center in the phase that invades; `theta` is measured through the phase ahead.
    """
    normal = np.array([np.sin(s), np.cos(s)])
    tangent = np.array([np.cos(s), -np.sin(s)])
    towards = math.cos(theta) * normal - math.sin(theta) * tangent
    leaving = math.cos(theta) * tangent + math.sin(theta) * normal
    center = radius * normal + towards / k
    if math.isinf(opposite):
        # The two points of the circle on the line y = radius + width.
        height = radius + width - center[1]
        half = np.sqrt(1 / k**2 - height**2)
        meets = [np.array([center[0] + sign * half, center[1] + height]) for sign in (-1, 1)]
        walls = [np.array([0 * half, -1 + 0 * half])] * 2
    else:
        other = np.array([0.0, radius + width + opposite])
        across = np.array([other[0] - center[0], other[1] - center[1]])
        length = np.hypot(*across)
        along = (length**2 + 1 / k**2 - opposite**2) / (2 * length)
        half = np.sqrt(1 / k**2 - along**2)
        unit = across / length
        meets = [center + along * unit + sign * half * np.array([-unit[1], unit[0]]) for sign in (-1, 1)]
        walls = [(point - np.array([0 * half, other[1] + 0 * half])) / opposite for point in meets]

    def turn(point):
        """Angle along the arc from the first wall to a point, between 0 and 2 pi."""
        from_center = (point - center) * k
        return np.arctan2(np.sum(from_center * leaving, axis=0), -np.sum(from_center * towards, axis=0)) % (2 * np.pi)

    # The first of both points that the arc comes to.
    turns = [turn(point) for point in meets]
    first = turns[0] < turns[1]
    angle = np.where(first, *turns)
    wall = np.where(first, *walls)
    arriving = leaving * np.cos(angle) + towards * np.sin(angle)
    ahead = np.array([-wall[1], wall[0]])
    return np.arccos(np.clip(-np.sum(arriving * ahead, axis=0), -1, 1)) - theta


def entry_curvature(first: float, second: float, width: float, theta: float) -> float:
    """Largest curvature in 1/m of a meniscus between two discs, one of which may have an infinite radius.

    It is the entry pressure over the tension. For angles from 20 to 160 degrees: at the ends arcs graze the wall and
    the table below misses them.
    """
    radius, opposite = sorted((first, second))
    s, k = np.linspace(-0.5 * math.pi, 0.9 * math.pi, 241), np.linspace(0.005, 1.005, 401) * 2 / width
    found = 0.0
    # Finer and finer tables around the best entry, until the curvature is known to 1e-12 of itself.
    for _ in range(12):
        with np.errstate(invalid="ignore"):
            error = angle_error(*np.meshgrid(s, k, indexing="ij"), radius, opposite, width, theta)
        # A jump from one branch of the arc to another is no root.
        change = (error[:, :-1] * error[:, 1:] <= 0) & (np.abs(np.diff(error, axis=1)) < 0.2)
        rows, columns = np.nonzero(change)
        if not len(rows):
            raise ValueError("no meniscus was found")
        share = error[rows, columns] / (error[rows, columns] - error[rows, columns + 1])
        roots = k[columns] + share * (k[1] - k[0])
        best, before = roots.argmax(), found
        found = float(roots[best])
        if abs(found - before) < 1e-12 * found:
            return found
        place, s_step, k_step = s[rows[best]], s[1] - s[0], k[1] - k[0]
        s, k = place + s_step * np.linspace(-2, 2, 41), found + k_step * np.linspace(-4, 4, 81)
    raise ValueError("the curvature does not converge")
