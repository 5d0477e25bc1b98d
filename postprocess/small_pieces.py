"""Counts, phase by phase, the pieces of fewer particles than a drop needs, and how many of them lie at a wall.

Usage: small_pieces.py DIR [--time 0.005]

A piece is a set of particles of one phase linked by distances of up to 1.6 spacings, as in the measure `small-pieces`;
links across periodic sides are not seen. It lies at a wall where a particle of it is nearer to one than a spacing.
"""

import argparse
from pathlib import Path

import numpy as np
import pyvista as pv
from vtkmodules.vtkFiltersPoints import vtkEuclideanClusterExtraction

import results

LINK = 1.6
SMALL = 20
PHASES = {"wetting": 0, "non-wetting": 1}


def pieces(points: np.ndarray, link: float) -> np.ndarray:
    """The number of the piece of each point; `link` in m."""
    clusters = vtkEuclideanClusterExtraction()
    clusters.SetInputData(pv.PolyData(points))
    clusters.SetRadius(link)
    clusters.SetExtractionModeToAllClusters()
    clusters.ColorClustersOn()
    clusters.Update()
    # The points come out in another order, and their places tell which is which.
    found = pv.wrap(clusters.GetOutput())
    order = {tuple(place): number for place, number in zip(found.points, found.point_data["ClusterId"], strict=True)}
    return np.array([order[tuple(place)] for place in pv.PolyData(points).points])


def measure(path: str | Path, time: float | None = None) -> dict:
    """Time of the particles next to `time` (s; the last ones where none is given) and the counts of each phase."""
    directory = Path(path)
    spacing = results.models(directory)["sph"]["spacing"]
    frame = results.frame_at(directory / "particles.pvd", time)
    particles = pv.read(frame.file)
    found = {"frame": frame}
    for name, phase in PHASES.items():
        of_phase = particles.point_data["phase"] == phase
        piece = pieces(particles.points[of_phase], LINK * spacing) if of_phase.any() else np.zeros(0, dtype=int)
        distance = particles.point_data["wall-distance"][of_phase]
        sizes = np.bincount(piece)
        small = [number for number, size in enumerate(sizes) if 0 < size < SMALL]
        found[name] = {
            "small": len(small),
            "single": sum(int(sizes[number]) == 1 for number in small),
            "at a wall": sum(bool(distance[piece == number].min() < spacing) for number in small),
        }
    return found


def main() -> None:
    """Prints the counts."""
    parser = argparse.ArgumentParser(description="count pieces below the resolution")
    parser.add_argument("directory", type=Path, help="output folder of `meniscus run` with [sph]")
    parser.add_argument("--time", type=float, help="time in s, the last one by default")
    asked = parser.parse_args()
    found = measure(asked.directory, asked.time)
    print(f"t = {found['frame'].time:.4g} s")
    for name in PHASES:
        print(f"{name}: " + ", ".join(f"{kind} {count}" for kind, count in found[name].items()))


if __name__ == "__main__":
    main()
