"""A drop without gravity by peclet: volume of fluid, curvature by height functions, balanced surface force, contact angle at an immersed wall.

Usage: peclet_drop.py [ANGLE_DEG] [--cells 20] [--capillary-times 20]

With an angle half a disc on the floor of a box periodic along x, as in `cases/sessile-drop.toml`; without one a disc in a periodic box, as in
`cases/laplace-drop.toml`. One cell in depth, equal densities and viscosities, the steps that the program chooses. Threads are those of
`OMP_NUM_THREADS`. Prints a line of JSON: cells, steps, CPU seconds, and records of time in capillary times, CPU seconds and angle in degrees or
pressure jump over tension/radius.
"""

import argparse
import json
import math
import time

import numpy as np
from peclet import flow

# Width and height of the domain over the radius and Ohnesorge number, as in the cases: on a wall, free.
DOMAIN, OHNESORGE = (5.0, 2.0), 0.035
FREE_DOMAIN, FREE_OHNESORGE = (4.0, 4.0), 0.335
# Cells in depth, and distance of the walls from the edges: a quarter off the grid, where contact lines can move.
DEPTH, WALL = 1, 4.25
# The value is looked at so often per capillary time.
LOOKS = 10
# Points per cell and direction of the fractions at the start.
PARTS = 16
# Center of the free drop off the middle of a cell, so that no symmetry hides an error.
OFFSET = (0.13, 0.27)


def fractions(size: tuple[int, int], center: tuple[float, float], radius: float, floor: float) -> np.ndarray:
    """The share of a disc in the part of each cell above the floor."""
    x, y = ((np.arange(count * PARTS) + 0.5) / PARTS for count in size)
    fluid = np.broadcast_to(y[None, :] > floor, (x.size, y.size))
    disc = fluid & (np.hypot(x[:, None] - center[0], y[None, :] - center[1]) < radius)
    shape = (size[0], PARTS, size[1], PARTS)
    part, whole = (field.reshape(shape).mean(axis=(1, 3)) for field in (disc, fluid))
    plane = np.where(whole > 0.0, part / np.maximum(whole, 1e-9), 0.0)
    return np.asfortranarray(np.repeat(plane[:, :, None], DEPTH, axis=2))


def drop(radius: int, angle: float | None) -> flow.Solver:
    """The drop at the start, without walls if there is no angle. Density and tension are 1, a cell is as wide as 1."""
    free = angle is None
    wide, high = (round(part * radius) for part in (FREE_DOMAIN if free else DOMAIN))
    floor = 0.0 if free else WALL
    size = (wide, high + math.ceil(2.0 * floor))
    solver = flow.Solver(*size, DEPTH)
    solver.set_rho(1.0)
    solver.set_mu((FREE_OHNESORGE if free else OHNESORGE) * math.sqrt(radius))
    y = np.arange(size[1]) + 0.5
    # Without walls any distance beyond their reach will do.
    away = np.full(size[1], 10.0) if free else np.minimum(y - floor, size[1] - floor - y)
    distance = np.asfortranarray(np.broadcast_to(away[None, :, None], (*size, DEPTH)))
    if free:
        solver.set_pressure_geometry(distance)
    else:
        solver.set_solid(distance, cutcell_pressure=True)
    solver.enable_vof()
    center = (0.5 * wide + OFFSET[0], 0.5 * high + OFFSET[1]) if free else (0.5 * wide, floor)
    solver.set_vof(fractions(size, center, radius, floor))
    solver.set_surface_tension(1.0)
    if not free:
        solver.set_contact_angle(angle)
    return solver


def angle_of(solver: flow.Solver) -> float:
    """Contact angle in degrees of the circular segment with the area and the height of the drop."""
    columns = (solver.get_vof() * solver.diagnostics.vof_geometry(0))[:, :, 0].sum(axis=1)
    area, height = columns.sum(), columns.max()
    low, high = 1e-3, math.pi - 1e-3
    for _ in range(60):
        middle = 0.5 * (low + high)
        # Area over height squared falls with the angle.
        wide = (middle - math.sin(middle) * math.cos(middle)) / (1.0 - math.cos(middle)) ** 2 > area / height**2
        low, high = (middle, high) if wide else (low, middle)
    return math.degrees(low)


def jump_of(solver: flow.Solver) -> float:
    """Mean pressure in the drop less that around it, three cells off the interface, over tension/radius with the radius of its area."""
    color, pressure = solver.get_vof()[:, :, 0], solver.get_p()[:, :, 0]
    x, y = np.meshgrid(*(np.arange(count) + 0.5 for count in color.shape), indexing="ij")
    area = color.sum()
    radius = math.sqrt(area / math.pi)
    away = np.hypot(x - (color * x).sum() / area, y - (color * y).sum() / area)
    return float(radius * (pressure[away < radius - 3.0].mean() - pressure[away > radius + 3.0].mean()))


def main() -> None:
    """Runs the drop and prints what came out."""
    parser = argparse.ArgumentParser(description="a drop by peclet")
    parser.add_argument("angle", type=float, nargs="?", help="contact angle in degrees; a free drop if not given")
    parser.add_argument("--cells", type=int, default=20, help="cells per radius of the disc at the start")
    parser.add_argument("--capillary-times", type=float, default=20.0, help="how long it runs")
    asked = parser.parse_args()
    solver = drop(asked.cells, asked.angle)
    measure = jump_of if asked.angle is None else angle_of
    capillary_time = math.sqrt(asked.cells**3)
    records, now, steps, begun = [], 0.0, 0, time.process_time()
    for look in range(1, round(asked.capillary_times * LOOKS) + 1):
        while now < look * capillary_time / LOOKS:
            now, steps = now + solver.step_adaptive(), steps + 1
        seconds = time.process_time() - begun
        records.append((now / capillary_time, seconds, measure(solver)))
    print(json.dumps({"unknowns": math.prod(solver.cells), "steps": steps, "cpu_s": records[-1][1], "records": records}))


if __name__ == "__main__":
    main()
