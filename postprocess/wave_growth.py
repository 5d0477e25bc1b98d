"""Growth of a wave of an interface that goes across the box, from the amplitude of its first Fourier mode along y.

Beside it two linear theories of a thin liquid that pushes a thick one between two plates: that of Darcy's law (Saffman
and Taylor 1958), and that of the equations averaged over the depth, which the program solves. In these the velocity
along the interface and the shear stress are continuous, within b sqrt(alpha/12) of it the liquids drag each other
along, and waves grow more slowly.

Usage: wave_growth.py DIR [--from SECONDS] [--until SHARE] (of the height of the box)
"""

import argparse
import json
import tomllib
from pathlib import Path

import numpy as np
import pyvista as pv

# The factor of a parabolic profile on inertia and on the viscous stress in the plane, where there are no walls.
PARABOLIC = 1.2
# Passes of the fixed point n = u/eta: inertia, through which n enters, is less than a percent of the friction.
PASSES = 50


def measure(path: str, start: float = 0.002, until: float = 0.1) -> dict:
    """Find times (s), amplitudes (m) and the slope of their logarithm (1/s) from a time on, up to a largest one."""
    reader = pv.get_reader(f"{path}/interface.pvd")
    times, amplitudes = [], []
    for index, time in enumerate(reader.time_values):
        reader.set_active_time_point(index)
        block = reader.read()[0]
        line = max(block.split_bodies(), key=lambda body: body.n_points)
        x, y = line.points[:, 0], line.points[:, 1]
        phase = 2 * np.pi * (y - y.min()) / np.ptp(y)
        parts = np.linalg.lstsq(np.column_stack([np.ones_like(y), np.cos(phase), np.sin(phase)]), x, rcond=None)[0]
        times.append(time)
        amplitudes.append(float(np.hypot(parts[1], parts[2])))
    times, amplitudes, height = np.array(times), np.array(amplitudes), float(np.ptp(y))
    fitted = (times > start) & (amplitudes < until * height)
    rate = float(np.polyfit(times[fitted], np.log(amplitudes[fitted]), 1)[0])
    return {"times": times, "amplitudes": amplitudes, "rate": rate}


def darcy(case: dict, k: float) -> float:
    """Growth rate in 1/s of a wave of the wavenumber k (1/m) by Darcy's law."""
    thin, thick, speed, tension, depth = parameters(case)
    push = (thick["viscosity"] - thin["viscosity"]) * speed - tension * k**2 * depth**2 / 12
    return k * push / (thin["viscosity"] + thick["viscosity"])


def depth_averaged(case: dict, k: float) -> float:
    """Growth rate in 1/s of a wave of the wavenumber k (1/m) by the equations averaged over the depth.

    Beside the interface x = 0 the velocity across is A e^(kx) + B e^(qx) in the thin liquid and C e^(-kx) + D e^(-qx)
    in the thick one, with q^2 = k^2 + R/(alpha mu) and the resistance R = alpha rho n + 12 mu/b^2; the pressure is
    -R/k A e^(kx) and R/k C e^(-kx). Both velocities and the shear stress are continuous; the normal stress jumps by the
    tension and by what the pressure of the steady flow differs by at the displaced interface.
    """
    thin, thick, speed, tension, depth = parameters(case)
    alpha = case["sph"].get("profile-factor", PARABOLIC)
    mu = np.array([thin["viscosity"], thick["viscosity"]])
    rho = np.array([thin["density"], thick["density"]])
    jump = tension * k**2 - 12 * (mu[1] - mu[0]) * speed / depth**2
    rate = darcy(case, k)
    for _ in range(PASSES):
        resistance = alpha * rho * rate + 12 * mu / depth**2
        q = np.sqrt(k**2 + resistance / (alpha * mu))
        shear, normal = alpha * mu, resistance / k + 2 * alpha * mu * k
        system = [
            [1, 1, -1, -1],
            [k, q[0], k, q[1]],
            [2 * k**2 * shear[0], (q[0] ** 2 + k**2) * shear[0], -2 * k**2 * shear[1], -(q[1] ** 2 + k**2) * shear[1]],
            [-normal[0], -2 * shear[0] * q[0], -normal[1], -2 * shear[1] * q[1]],
        ]
        found = np.linalg.solve(np.array(system), [0, 0, 0, jump])
        rate = float(found[0] + found[1])
    return rate


def parameters(case: dict) -> tuple[dict, dict, float, float, float]:
    """Thin and thick liquid, mean velocity (m/s), tension (N/m) and depth (m) of a case."""
    sph = case["sph"]
    phases = sph["phases"]
    speed = sph["sides"]["open"]["left"]["velocity"]
    return phases["wetting"], phases["non-wetting"], speed, sph["interface"]["tension"], case["geometry"]["depth"]


def main() -> None:
    """Print amplitudes, growth rate and what theories say."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("path")
    parser.add_argument("--from", dest="start", type=float, default=0.002)
    parser.add_argument("--until", type=float, default=0.1)
    arguments = parser.parse_args()
    found = measure(arguments.path, arguments.start, arguments.until)
    case = tomllib.loads(json.loads((Path(arguments.path) / "report.json").read_text())["resolved-case"])
    bottom, top = (case["geometry"][corner][1] for corner in ("min", "max"))
    k = 2 * np.pi / (top - bottom)
    for time, amplitude in zip(found["times"], found["amplitudes"], strict=True):
        print(f"{time:.4e} s  {amplitude:.4e} m")
    print(f"growth rate {found['rate']:.2f} per s")
    for name, theory in (("Darcy's law", darcy(case, k)), ("depth-averaged equations", depth_averaged(case, k))):
        print(f"{name}: {theory:.2f} per s, ratio {found['rate'] / theory:.3f}")


if __name__ == "__main__":
    main()
