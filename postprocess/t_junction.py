"""Share of the water that a crevice at the side of a channel takes.

Usage: t_junction.py [DIR]

Measured, and by a balance: the same capillary pressure in both menisci, their walls at the angles of the molecular
kinetic theory, floor and lid at rest or at these angles too. In a run of cases/t-junction.toml, DIR, both menisci from
when that in the channel has passed the crevice.
"""

import argparse
import math

# Measured velocities (m/s) before the crevice, behind it in the channel, and in the crevice, of 0.4 mm with edges of
# 0.1 mm (Zhang et al. 2024, repository boschresearch/sepMultiphaseFoam, Plots/Data/Data_interface_velocity.csv).
MEASURED = [
    (1.28435e-2, 1.10485e-2, 3.3955e-3),
    (9.0104e-3, 7.6965e-3, 3.1795e-3),
    (6.543e-3, 5.5975e-3, 2.107e-3),
    (4.41e-3, 3.6029999e-3, 1.678e-3),
    (8.715e-4, 7.235e-4, 3.755e-4),
    (4.28e-4, 3.239999e-4, 2.53e-4),
]
# Channel, crevice, depth (m), tension (N/m) and the law of the angles.
CHANNEL, CREVICE, DEPTH, TENSION = 1.0e-3, 4.0e-4, 4.0e-4, 0.07274
ANGLE_DEG, FREQUENCY, JUMP, TEMPERATURE = 93.0, 5.0e4, 1.48e-9, 295.15
BOLTZMANN = 1.380649e-23


def cosine(speed: float) -> float:
    """Of the dynamic contact angle of a line of this speed (m/s)."""
    work = 2 * BOLTZMANN * TEMPERATURE / (TENSION * JUMP**2)
    return math.cos(math.radians(ANGLE_DEG)) - work * math.asinh(speed / (2 * FREQUENCY * JUMP))


def balance(inflow: float, plates_move: bool) -> float:
    """Share of the crevice at a velocity (m/s) in the channel before it."""

    def excess(speed: float) -> float:
        def pressure(speed: float, width: float) -> float:
            return -2 * TENSION * (cosine(speed) / width + cosine(speed if plates_move else 0.0) / DEPTH)

        return pressure(speed, CREVICE) - pressure(inflow - speed * CREVICE / CHANNEL, CHANNEL)

    low, high = 0.0, inflow
    for _ in range(60):
        middle = 0.5 * (low + high)
        low, high = (middle, high) if excess(middle) < 0 else (low, middle)
    return low * CREVICE / CHANNEL / inflow


def measure(path: str) -> dict:
    """Growth of the water in the crevice (m2/s), speed in the channel (m/s), scatter of the capillary pressure (Pa)."""
    import numpy as np
    import pyvista as pv

    reader = pv.get_reader(f"{path}/particles.pvd")
    times, areas, fronts = [], [], []
    for time in reader.time_values:
        reader.set_active_time_value(time)
        block = reader.read()[0]
        water = block["phase"] == 0
        above = block.points[:, 1] > CHANNEL
        times.append(time)
        areas.append(float(block["volume"][water & above].sum()))
        fronts.append(float(block.points[water & ~above, 0].max()))
    times, areas, fronts = np.array(times), np.array(areas), np.array(fronts)
    passed = fronts > 2.2e-3
    growth = np.polyfit(times[passed], areas[passed], 1)[0] if passed.sum() > 2 else math.nan
    speed = np.polyfit(times[passed], fronts[passed], 1)[0] if passed.sum() > 2 else math.nan
    series = np.genfromtxt(f"{path}/series.csv", delimiter=",", names=True)
    late = series["capillary_pressure_Pa"][series["time_s"] > 0.05]
    return {"growth": float(growth), "speed": float(speed), "scatter": float(np.std(late))}


def main() -> None:
    """Print the shares."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("path", nargs="?")
    arguments = parser.parse_args()
    print("speed in mm/s, angle of the law in degrees")
    for speed in [4.3e-4, 4.4e-3, 6.4e-3, 1.28e-2]:
        print(f"{speed * 1e3:7.3f} {math.degrees(math.acos(cosine(speed))):7.1f}")
    print("before in mm/s, share of the crevice: measured, with floor and lid at rest, with all walls in motion")
    for before, _, crevice in MEASURED:
        share = crevice * CREVICE / CHANNEL / before
        print(f"{before * 1e3:7.3f} {share:7.3f} {balance(before, False):7.3f} {balance(before, True):7.3f}")
    if arguments.path:
        found = measure(arguments.path)
        print(f"crevice {found['growth'] / CREVICE * 1e3:.3f} mm/s, channel {found['speed'] * 1e3:.3f} mm/s")
        print(f"capillary pressure after 0.05 s: scatter of {found['scatter']:.0f} Pa")


if __name__ == "__main__":
    main()
