"""Saturation functions of a pore network as reservoir simulators read them: the keywords SWOF and SGOF, in METRIC units.

Usage: reservoir_tables.py DIR [--swof swof.inc] [--sgof sgof.inc]

DIR is the output of a quasi-static displacement with an outlet. The states are those of `relative_permeability.csv`, at most nine of the
last half cycle, with the capillary pressure applied after the events that lead to them. With water as the wetting and oil as the
non-wetting phase, SWOF lists S_w, k_rw, k_ro and p_o - p_w by rising S_w; with liquid as the wetting and gas as the non-wetting phase,
SGOF lists S_g, k_rg, k_rl and p_g - p_l by rising S_g.
"""

import argparse
import itertools
from pathlib import Path

import numpy as np

from network_files import description, table

# Pa in a bar, the unit of pressure in METRIC decks.
BAR = 1.0e5
# Resolution of saturations, as written: closer ones share a row.
LEAST_STEP = 1.0e-6


def measure(path: str | Path) -> dict:
    """The process, and rows by rising wetting saturation: it, both relative permeabilities (wetting phase first), p_n - p_w in Pa."""
    folder = Path(path)
    about = description(folder)
    if about.get("outlet") is None:
        raise SystemExit(f"{folder}: relative permeabilities need an outlet, and there is none")
    if not (folder / "relative_permeability.csv").is_file():
        needed = "it needs a quasi-static displacement, and pores from inlet to outlet"
        raise SystemExit(f"{folder}: there is no relative_permeability.csv; {needed}")
    events = table(folder / "events.csv")
    last = events["half_cycle"] == events["half_cycle"].max()
    half, process = int(events["half_cycle"][last][0]), events["process"][last][0]
    # The beginning has no pressure.
    saturation, pressure = events["saturation"][last][1:], events["capillary_pressure_Pa"][last][1:]
    films = events["film_saturation"][last][1:] if "film_saturation" in events else np.zeros_like(saturation)
    if not len(pressure):
        raise SystemExit(f"{folder}: the last half cycle has no event, and so no capillary pressure")
    relative = table(folder / "relative_permeability.csv")
    rows: list[list[float]] = []
    for number, (held, wetting, other) in enumerate(zip(*list(relative.values())[:3], strict=True)):
        # Relative permeabilities count no films; the last event at a saturation is that of the largest pressure.
        same = np.flatnonzero(abs(saturation - films - held) < LEAST_STEP)
        if same.size:
            rows.append([float(saturation[same[-1]]), wetting, other, float(pressure[same[-1]])])
        elif number == 0:
            rows.append([about["half_cycles"][half - 1]["saturation_before"], wetting, other, float(pressure[0])])
    rows.sort()
    rows = [row for k, row in enumerate(rows) if k == 0 or row[0] - rows[k - 1][0] >= LEAST_STEP]
    # The conductance of a phase does not fall with its saturation, except by rounding.
    for before, row in itertools.pairwise(rows):
        row[1], row[2] = max(row[1], before[1]), min(row[2], before[2])
    return {"process": f"{process} {(half + 1) // 2}", "rows": rows}


def unfinished(name: str, value: float, end: str) -> str:
    """A comment if a phase still flows at its end of the table, where simulators expect zero."""
    why = "the displacement ended while this phase still flowed, or began so"
    return f"-- {name} is not 0 at the {end} saturation: {why}.\n" if value > 0.0 else ""


def keyword(name: str, process: str, rows: list[list[float]]) -> str:
    """SWOF from rows of wetting, SGOF from rows of non-wetting saturation; its own relative permeability comes first."""
    fluid = name[1].lower()
    of_fluid, of_oil, capillary = f"kr{fluid}", f"kro{fluid}", f"Pco{fluid}"
    phases, difference = {
        "SWOF": ("Water (wetting) and oil (non-wetting)", "p_o - p_w"),
        "SGOF": ("Gas (non-wetting) and liquid (wetting)", "p_g - p_l"),
    }[name]
    first, last = rows[0], rows[-1]
    lines = "".join(f"{s:10.6f} {a:12.8f} {b:12.8f} {p / BAR:14.6e}\n" for s, a, b, p in rows)
    return (
        f"-- {phases} along {process} of a pore network.\n"
        f"-- METRIC units: {capillary} = {difference} in bar; saturations and relative permeabilities have none.\n"
        f"-- End points: S{fluid} from {first[0]:.6f} to {last[0]:.6f}; {of_oil} = {first[2]:.6f} and {of_fluid} = {first[1]:.6f} "
        f"at the first, {of_fluid} = {last[1]:.6f} and {of_oil} = {last[2]:.6f} at the last.\n"
        + unfinished(of_fluid, first[1], "first")
        + unfinished(of_oil, last[2], "last")
        + f"{name}\n--       S{fluid}          {of_fluid}         {of_oil}         {capillary}\n{lines}/\n"
    )


def swof(found: dict) -> str:
    """The keyword SWOF."""
    return keyword("SWOF", found["process"], found["rows"])


def sgof(found: dict) -> str:
    """The keyword SGOF."""
    rows = [[1.0 - s, other, wetting, p] for s, wetting, other, p in reversed(found["rows"])]
    return keyword("SGOF", found["process"], rows)


def main() -> None:
    """Write the keywords."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("path")
    parser.add_argument("--swof", type=Path)
    parser.add_argument("--sgof", type=Path)
    arguments = parser.parse_args()
    found = measure(arguments.path)
    for path, text in ((arguments.swof, swof(found)), (arguments.sgof, sgof(found))):
        if path:
            path.write_text(text, encoding="utf-8")
    if not (arguments.swof or arguments.sgof):
        print(swof(found) + sgof(found), end="")


if __name__ == "__main__":
    main()
