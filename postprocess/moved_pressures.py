"""Events of two runs of one network: whether they are the same, and how far their capillary pressures have moved.

Usage: moved_pressures.py DIR DIR
"""

import argparse
import csv
from pathlib import Path

SAME = ["half_cycle", "event", "throat", "saturation"]


def measure(paths: list[str]) -> dict:
    """Number of events, whether all are the same in order, place and saturation, smallest and largest move (Pa)."""
    rows = (csv.DictReader((Path(path) / "events.csv").open()) for path in paths)
    # Nothing is applied at the beginning.
    one, other = ([row for row in events if row["capillary_pressure_Pa"]] for events in rows)
    same = len(one) == len(other) and all(a[name] == b[name] for a, b in zip(one, other, strict=True) for name in SAME)
    column = "capillary_pressure_Pa"
    moves = [float(b[column]) - float(a[column]) for a, b in zip(one, other, strict=False)]
    return {"events": len(one), "same": same, "least": min(moves), "most": max(moves)}


def main() -> None:
    """Print what has moved."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("paths", nargs=2)
    found = measure(parser.parse_args().paths)
    print(f"{found['events']} events, {'the same' if found['same'] else 'not the same'}")
    print(f"pressures moved by {found['least']:.13g} to {found['most']:.13g} Pa")


if __name__ == "__main__":
    main()
