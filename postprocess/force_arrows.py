"""Draws the volume forces of interface and contact lines as arrows at particles, beside each other.

Usage: force_arrows.py DIR [--time 0.002] [--share 0.5] [--picture forces.png]

The arrays `surface-force` and `line-force` of the particles: with the continuum surface force the forces that act, with
the pressure jump those that it stands for. Arrows stand at a random part of the particles that feel the force, always
the same one.
"""

import argparse
from pathlib import Path

import matplotlib
import numpy as np

import colors
import results

matplotlib.use("Agg")
import matplotlib.pyplot as plt

# Array, title, color of the arrows.
FORCES = [
    ("surface-force", "surface force", colors.MENISCUS),
    ("line-force", "contact line force", colors.MARK),
]
# Numbers of the phases in the output, with the colors of their particles.
PHASES = {0: colors.WETTING, 1: colors.NON_WETTING, 2: colors.SOLID}
# Particles are pale, so that arrows stand out.
PALE = 0.5
# A particle feels a force that is this share of the largest one.
FELT = 0.02
# The longest arrow over the width of the picture.
LONGEST = 0.12
# What is shown above and below the wetting phase, and beside it, over its width: the longest arrow at its edge is not cut.
MARGIN, BESIDE = 0.15, 0.3
# The same arrows in every picture.
SEED = 1


def measure(path: str | Path, time: float | None = None) -> dict:
    """Time in s, places in m, phases of the particles, forces in N/m³, and their sums in N per m of depth."""
    frame = results.frame_at(Path(path) / "particles.pvd", time)
    particles = results.read(frame.file)
    data = particles.point_data
    volume = np.asarray(data["volume"])
    forces = {name: np.asarray(data[name])[:, :2] for name, *_ in FORCES}
    fluid = np.asarray(data["phase"]) < 2
    return {
        "time": frame.time,
        "points": np.asarray(particles.points)[:, :2],
        "phase": np.asarray(data["phase"]),
        "forces": forces,
        "sums": {name: (volume[fluid, None] * force[fluid]).sum(axis=0) for name, force in forces.items()},
    }


def felt(force: np.ndarray, share: float) -> np.ndarray:
    """The particles that get an arrow: a random share of those that feel the force."""
    size = np.linalg.norm(force, axis=1)
    feels = np.flatnonzero(size > FELT * size.max()) if size.max() > 0.0 else np.array([], dtype=int)
    chosen = np.random.default_rng(SEED).random(len(feels)) < share
    return feels[chosen]


def draw(found: dict, picture: Path, share: float) -> None:
    """Writes the figure, the wetting phase in its middle."""
    points = 1e3 * found["points"]
    wetting = points[found["phase"] == 0]
    margin = (wetting[:, 0].max() - wetting[:, 0].min()) * np.array([BESIDE, MARGIN])
    (x0, y0), (x1, y1) = wetting.min(axis=0) - margin, wetting.max(axis=0) + margin
    height = 0.7 + 6.0 * (y1 - y0) / (x1 - x0)
    figure, axes = plt.subplots(1, len(FORCES), figsize=(12.0, height), sharey=True, layout="constrained")
    inside = (points[:, 0] > x0) & (points[:, 0] < x1) & (points[:, 1] > y0) & (points[:, 1] < y1)
    for axis, (name, title, color) in zip(axes, FORCES, strict=True):
        for phase, shade in PHASES.items():
            of_phase = inside & (found["phase"] == phase)
            axis.scatter(*points[of_phase].T, s=14, color=shade, alpha=PALE, linewidths=0.0)
        force = found["forces"][name]
        # The line force acts on few particles: all of them get their arrow.
        at = felt(force, share if name == "surface-force" else 1.0)
        largest = np.linalg.norm(force, axis=1).max()
        if len(at):
            length = LONGEST * (x1 - x0) / largest
            axis.quiver(
                *points[at].T,
                *(length * force[at]).T,
                angles="xy",
                scale_units="xy",
                scale=1.0,
                color=color,
                width=0.004,
                zorder=3,
            )
        axis.set(xlim=(x0, x1), ylim=(y0, y1), aspect="equal", xlabel="x (mm)")
        axis.set_title(f"{title}, longest {largest:.2g} N/m³", fontsize=10)
    axes[0].set_ylabel("y (mm)")
    figure.suptitle(f"t = {found['time']:.4g} s", fontsize=10)
    figure.savefig(picture, dpi=110)
    plt.close(figure)


def main() -> None:
    """Writes the figure and prints its name and the sums of the forces."""
    parser = argparse.ArgumentParser(description="draw the forces of interface and contact lines as arrows")
    parser.add_argument("directory", type=Path, help="output folder of `meniscus run`")
    parser.add_argument("--time", type=float, help="time in s, the last one by default")
    parser.add_argument("--share", type=float, default=0.5, help="share of the arrows of the surface force")
    parser.add_argument("--picture", type=Path, default=Path("forces.png"))
    asked = parser.parse_args()
    found = measure(asked.directory, asked.time)
    draw(found, asked.picture, asked.share)
    print(asked.picture)
    for name, total in found["sums"].items():
        print(f"sum of {name}: {total[0]:.3g}, {total[1]:.3g} N/m")


if __name__ == "__main__":
    main()
