"""How long a call takes for a network of ten grains, and its parts.

Used as: python python/benchmarks/overhead.py [NUMBER]
"""

import sys
import time

import numpy as np

import meniscus

GRAINS = [{"disc": {"center": [x + 0.5e-3 * (row % 2), y], "radius": 0.35e-3}} for row, y in enumerate((0.0, 1e-3)) for x in np.arange(5) * 1e-3]
SHAPES = {"format": 1, "min": [-0.5e-3, -0.5e-3], "max": [5e-3, 1.5e-3], "solid": "inside", "shapes": GRAINS}


def measure(number: int, **parameters: object) -> np.ndarray:
    """Times in ms of so many calls, after one that is not counted: the whole call, and what of it is not the work of the model."""
    times = []
    for _ in range(number + 1):
        begun = time.perf_counter()
        result = meniscus.network(SHAPES, **parameters)
        assert len(result.throats["width_m"]) > 0 and result.measures and result.series
        whole = time.perf_counter() - begun
        told = result.report["wall-time-s"]
        times.append([1e3 * whole, 1e3 * (whole - told["total"] - told["parts"]["network: extraction"])])
    return np.array(times[1:])


def main() -> None:
    """Prints medians."""
    number = int(sys.argv[1]) if len(sys.argv) > 1 else 200
    drainage = {"inlet": "left", "outlet": "right", "angle_deg": 40, "tension": 0.03}
    for name, parameters in (("network alone", {}), ("drainage", drainage), ("drainage, 1 thread", {**drainage, "threads": 1})):
        whole, overhead = np.median(measure(number, **parameters), axis=0)
        print(f"{name}: {whole:.2f} ms, {overhead:.2f} ms of them overhead, medians of {number} calls")


if __name__ == "__main__":
    main()
