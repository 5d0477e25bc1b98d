"""Writes `network-openpnm.csv` as OpenPNM does, with openpnm 3.6.4: a cubic network of 6 x 4 pores in the plane of x and z.

Usage: network.py [FOLDER].
"""

import sys
from pathlib import Path

import numpy as np
import openpnm


def main() -> None:
    folder = Path(sys.argv[1] if len(sys.argv) > 1 else Path(__file__).parent)
    random = np.random.default_rng(7)
    network = openpnm.network.Cubic(shape=[6, 1, 4], spacing=1.0e-3)
    network["pore.diameter"] = random.uniform(0.4e-3, 0.8e-3, network.Np)
    smaller = network["pore.diameter"][network.conns].min(axis=1)
    network["throat.diameter"] = smaller * random.uniform(0.3, 0.9, network.Nt)
    openpnm.io.network_to_csv(network, filename=str(folder / "network-openpnm"))


if __name__ == "__main__":
    main()
