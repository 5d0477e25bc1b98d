"""Writes the table of the gases of reservoirs: pressure and viscosity by equations of state, over temperature and density.

Usage: gas_tables.py [--table crates/case/src/preset/gases.csv]; needs CoolProp (`pip install CoolProp`)

Over density a gas is smooth even near its critical point. `--check` compares what the program makes of the table, cubic in the density and linear in the
temperature, with the equations of state at random states up to 40 MPa.
"""

import argparse
import csv
import random
from pathlib import Path

from CoolProp.CoolProp import PropsSI

KELVIN = 273.15
# Largest pressure in Pa.
LARGEST = 40.0e6
# Names here and in CoolProp, temperatures in °C, number of densities.
GASES = [
    ("carbon-dioxide", "CO2", [32, 35, 40, 50, 60, 70, 80, 100, 120], 16),
    ("hydrogen", "Hydrogen", [20, 40, 60, 80, 100, 120], 6),
    ("methane", "Methane", [20, 30, 40, 60, 80, 100, 120], 8),
    ("nitrogen", "Nitrogen", [20, 40, 60, 80, 100, 120], 6),
]
# Stands for a density of 0 in kg/m³.
THIN = 1e-3


def rows() -> list[tuple[str, float, float, float, float]]:
    """Gas, temperature in °C, density in kg/m³, pressure in Pa, viscosity in Pa s."""
    found = []
    for name, fluid, temperatures, count in GASES:
        densest = 1.002 * PropsSI("D", "T", temperatures[0] + KELVIN, "P", LARGEST, fluid)
        for celsius in temperatures:
            for k in range(count):
                density = float(f"{max(THIN, densest * k / (count - 1)):.6g}")
                of = [PropsSI(what, "T", celsius + KELVIN, "D", density, fluid) for what in ("P", "V")]
                found.append((name, celsius, density, *(float(f"{value:.6g}") for value in of)))
    return found


def at(table: list[tuple], name: str, celsius: float, pascal: float) -> tuple[float, float]:
    """Density and viscosity as the program interpolates them."""
    temperatures = sorted({row[1] for row in table if row[0] == name})
    upper = next((k for k, t in enumerate(temperatures) if t >= celsius and k > 0))
    cold, warm = temperatures[upper - 1], temperatures[upper]
    share = (celsius - cold) / (warm - cold)
    curves = [[row[2:] for row in table if row[:2] == (name, t)] for t in (cold, warm)]
    kelvin = [cold + KELVIN, warm + KELVIN]

    def between(density: float, value) -> float:
        ends = [cubic(density, [row[0] for row in curve], [value(row, t) for row in curve]) for curve, t in zip(curves, kelvin, strict=True)]
        return (1 - share) * ends[0] + share * ends[1]

    def pressure(density: float) -> float:
        return between(density, lambda row, t: row[1] / (row[0] * t)) * density * (celsius + KELVIN)

    low, high = 0.0, curves[0][-1][0]
    for _ in range(60):
        middle = 0.5 * (low + high)
        low, high = (middle, high) if pressure(middle) < pascal else (low, middle)
    return low, between(low, lambda row, t: row[2])


def cubic(x: float, places: list[float], values: list[float]) -> float:
    """The polynomial through the four places about x."""
    after = next((k for k, place in enumerate(places) if place >= x), len(places) - 1)
    first = min(max(after - 2, 0), len(places) - 4)
    total = 0.0
    for a in range(first, first + 4):
        weight = 1.0
        for b in range(first, first + 4):
            if b != a:
                weight *= (x - places[b]) / (places[a] - places[b])
        total += weight * values[a]
    return total


def check(table: list[tuple]) -> None:
    """Prints the largest errors of density and viscosity of each gas."""
    dice = random.Random(1)
    for name, fluid, temperatures, _ in GASES:
        worst = [0.0, 0.0]
        for _ in range(500):
            celsius, pascal = dice.uniform(temperatures[0], temperatures[-1]), dice.uniform(1e5, LARGEST)
            for k, (value, what) in enumerate(zip(at(table, name, celsius, pascal), ("D", "V"), strict=True)):
                worst[k] = max(worst[k], abs(value / PropsSI(what, "T", celsius + KELVIN, "P", pascal, fluid) - 1))
        print(f"{name:<16} density {100 * worst[0]:.2f} %, viscosity {100 * worst[1]:.2f} %")


def main() -> None:
    """Writes the table, and checks it if asked."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--table", type=Path, default=Path("crates/case/src/preset/gases.csv"))
    parser.add_argument("--check", action="store_true")
    arguments = parser.parse_args()
    table = rows()
    with arguments.table.open("w", newline="", encoding="utf-8") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(["gas", "temperature_C", "density_kg_per_m3", "pressure_Pa", "viscosity_Pa_s"])
        writer.writerows(table)
    print(arguments.table)
    if arguments.check:
        check(table)


if __name__ == "__main__":
    main()
