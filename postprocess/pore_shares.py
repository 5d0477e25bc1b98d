"""Holds the pores of a network against a direct simulation: what share of each the invading phase has.

Usage: pore_shares.py NETWORK DIRECT [--time 0.0088]

Both are output folders of one geometry, of `meniscus run` with [network] and with [sph]. Pores that are open at the outlet count on their own; of
the others those with more than half of the invading phase count as invaded. All is over the area of the pore space.
"""

import argparse
from pathlib import Path

import numpy as np
import pyvista as pv
from matplotlib.path import Path as Polygon

import results


def elements(network: Path) -> tuple[list[np.ndarray], np.ndarray, float]:
    """The elements of a network as polygons, their areas in m2, and where its domain ends on the right in m."""
    mesh = pv.read(results.frame_at(network / "regions.pvd", 0.0).file)
    polygons = [mesh.get_cell(cell).points[:, :2] for cell in range(mesh.n_cells)]
    return polygons, np.array([area(polygon) for polygon in polygons]), float(mesh.bounds[1])


def area(polygon: np.ndarray) -> float:
    """Area of a polygon."""
    x, y = polygon.T
    return 0.5 * abs(np.dot(x, np.roll(y, -1)) - np.dot(y, np.roll(x, -1)))


def measure(network: str | Path, direct: str | Path, time: float | None = None) -> dict:
    """The shares of the pore space next to `time` (s; the last ones where none is given)."""
    polygons, areas, end = elements(Path(network))
    frame = results.frame_at(Path(direct) / "particles.pvd", time)
    particles = pv.read(frame.file)
    phase = particles.point_data["phase"]
    points = particles.points[:, :2]
    first = pv.read(results.frame_at(Path(direct) / "particles.pvd", 0.0).file)
    # The phase that comes in stands at the left side at the beginning.
    invading = first.point_data["phase"][np.argmin(np.where(first.point_data["phase"] < 2, first.points[:, 0], np.inf))]
    held = np.zeros(len(polygons))
    for number, polygon in enumerate(polygons):
        inside = phase[Polygon(polygon).contains_points(points)]
        fluid = inside[inside < 2]
        held[number] = np.mean(fluid == invading) if len(fluid) else 0.0
    at_outlet = np.array([polygon[:, 0].max() > end * (1 - 1e-9) for polygon in polygons])
    invaded = (held > 0.5) & ~at_outlet
    share = lambda chosen, values: float((values * areas)[chosen].sum() / areas.sum())  # noqa: E731
    return {
        "frame": frame,
        "invading phase": share(areas > 0, held),
        "in pores at the outlet": share(at_outlet, held),
        "displaced phase left in invaded pores": share(invaded, 1 - held),
        "invaded pores": share(invaded, np.ones(len(areas))),
    }


def main() -> None:
    """Prints the shares."""
    parser = argparse.ArgumentParser(description="shares of the pores of a network in a direct simulation")
    parser.add_argument("network", type=Path, help="output folder of `meniscus run` with [network]")
    parser.add_argument("direct", type=Path, help="output folder of `meniscus run` with [sph]")
    parser.add_argument("--time", type=float, help="time in s, the last one by default")
    asked = parser.parse_args()
    found = measure(asked.network, asked.direct, asked.time)
    print(f"t = {found.pop('frame').time:.4g} s")
    for name, value in found.items():
        print(f"{name}: {value:.3f}")


if __name__ == "__main__":
    main()
