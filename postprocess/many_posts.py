"""Time and memory of a network, from the drawing to its curve, over the number of posts.

Usage: many_posts.py [--program meniscus] [--sizes 1e3,1e4,1e5] [--threads 2] [--results all|curve] [--depth 5e-5]
       [--picture many-posts.webp]

The posts have radii of 25 to 38 um and lie on a triangular lattice of 100 um, each moved by up to 10 um. A drainage goes from left to right until nothing
moves any more. Invasion is the time of the events with trapping; the total contains reading the drawing too, and with all results pictures, tables and
permeabilities. With a depth in m there are films of water in the corners. The picture is that of the last size.
"""

import argparse
import json
import math
import os
import subprocess
import tempfile
import time
from pathlib import Path

import numpy as np
from PIL import Image

STEP = 1.0e-4  # m, of the lattice
MOVED = 1.0e-5  # m
RADII = (2.5e-5, 3.8e-5)  # m


def drawing(posts: int, to: Path) -> int:
    """Writes about so many posts as a list of discs and returns their number."""
    random = np.random.default_rng(1)
    across = round(math.sqrt(posts * math.sqrt(3.0) / 2.0))
    column, row = np.meshgrid(np.arange(across), np.arange(round(posts / across)))
    x = (column + 0.5 * (row % 2) + 0.5) * STEP + random.uniform(-MOVED, MOVED, row.shape)
    y = (row + 0.5) * STEP * math.sqrt(3.0) / 2.0 + random.uniform(-MOVED, MOVED, row.shape)
    # Manifolds at both ends, and walls above and below.
    domain = (-STEP, 0.0, (across + 1.5) * STEP, (row.max() + 1.0) * STEP * math.sqrt(3.0) / 2.0)
    header = "x y r in m\ndomain " + " ".join(f"{end:.8e}" for end in domain)
    np.savetxt(to, np.column_stack([part.ravel() for part in (x, y, random.uniform(*RADII, row.shape))]), fmt="%.8e", header=header)
    return row.size


def measure(program: str, posts: int, more: list[str], picture: Path | None) -> str:
    """A line of the table; the picture of the run is written where one is asked for."""
    with tempfile.TemporaryDirectory() as folder:
        file, out = Path(folder) / "posts.xyr", Path(folder) / "out"
        count = drawing(posts, file)
        start = time.monotonic()
        options = ["--inlet", "left", "--outlet", "right", "--out", str(out), "--quiet", *more]
        process = subprocess.Popen([program, "network", str(file), *options], stdout=subprocess.DEVNULL)
        _, status, used = os.wait4(process.pid, 0)
        wall = time.monotonic() - start
        if status:
            raise SystemExit(f"{program} network ended with {os.waitstatus_to_exitcode(status)} for {count} posts")
        if picture:
            image = Image.open(out / "picture.png").convert("RGB")
            image.thumbnail((700, 700))
            image.save(picture, quality=80)
        report = json.loads((out / "report.json").read_text())
        parts, measures = report["wall-time-s"]["parts"], report["measures"]
        pores, events = (round(measures[name]["value"]) for name in ("pores", "events"))
        extraction, invasion = (parts[f"network: {part}"] for part in ("extraction", "displacement"))
        per_pore, per_post = 1e6 * invasion / pores, 1e6 * (used.ru_utime + used.ru_stime) / count
        return (
            f"| {count} | {pores} | {events} | {extraction:.2f} | {invasion:.2f} | {wall:.1f} | {per_pore:.1f} | {per_post:.0f} | {used.ru_maxrss / 1024:.0f} |"
        )


def main() -> None:
    """Prints the table."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--program", default="meniscus")
    parser.add_argument("--sizes", default="1e3,1e4,1e5")
    parser.add_argument("--threads", type=int, default=2)
    parser.add_argument("--results", default="all", choices=["all", "curve"])
    parser.add_argument("--depth", type=float)
    parser.add_argument("--picture", type=Path)
    arguments = parser.parse_args()
    heads = (
        "posts",
        "pores",
        "events",
        "extraction in s",
        "invasion in s",
        "total in s",
        "invasion per pore in us",
        "processor time per post in us",
        "memory in MiB",
    )
    print("| " + " | ".join(heads) + " |")
    print("|---" * len(heads) + "|")
    more = ["--threads", str(arguments.threads), "--results", arguments.results]
    more += ["--depth", str(arguments.depth)] if arguments.depth else []
    for size in arguments.sizes.split(","):
        print(measure(arguments.program, round(float(size)), more, arguments.picture), flush=True)


if __name__ == "__main__":
    main()
