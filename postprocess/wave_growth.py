"""Growth of a wave of an interface that goes across the box, from the amplitude of its first Fourier mode along y.

Usage: wave_growth.py DIR [--from SECONDS] [--until SHARE] (of the height of the box)
"""

import argparse

import numpy as np
import pyvista as pv


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


def main() -> None:
    """Print amplitudes and growth rate."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("path")
    parser.add_argument("--from", dest="start", type=float, default=0.002)
    parser.add_argument("--until", type=float, default=0.1)
    arguments = parser.parse_args()
    found = measure(arguments.path, arguments.start, arguments.until)
    for time, amplitude in zip(found["times"], found["amplitudes"], strict=True):
        print(f"{time:.4e} s  {amplitude:.4e} m")
    print(f"growth rate {found['rate']:.2f} per s")


if __name__ == "__main__":
    main()
