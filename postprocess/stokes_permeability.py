"""Permeability of packs of grains by direct solution of the Stokes equations, beside that of their pore networks.

Usage: stokes_permeability.py SHAPES... [--periodic xy] [--open x] [--depth B] [--across 4.5] [--network RUN...]
[--json FILE].
SHAPES are shape files with discs, rectangles and polygons, or lists `x y r` in m with --box. Along an axis that is
neither periodic nor open both sides are walls, and nothing flows. Finite elements: velocities of second, pressures of
first order (Taylor, Hood 1973) on a mesh that follows the walls, and a direct solver. A mean pressure gradient of 1
drives the flow; K is the mean velocity times the viscosity. Its error falls with the third to fourth power of the
edges, with the second one at corners; it is told by a second mesh, coarser by 1.5. With a depth in m these are the
equations averaged between floor and lid, alpha div grad v - 12/b2 v = grad p: alpha is --profile-factor. Left out: grains that touch,
overlap, or cross a side that is not periodic. Needs scipy and numpy, as in requirements-network.txt.
"""

import argparse
import json
import tomllib
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from scipy import sparse
from scipy.sparse import linalg

from network_files import measures
from stokes_mesh import Disc, Domain, Mesh, Polygon, mesh, quadrature

# By how much the second mesh, which tells the error, is coarser.
COARSER = 1.5


@dataclass
class Flow:
    """Flow under a mean pressure gradient of 1 with the viscosity 1: velocity at nodes, pressure at corners."""

    velocity: np.ndarray
    pressure: np.ndarray
    # Integral of the velocity.
    total: np.ndarray


@dataclass
class Plates:
    """What floor and lid do: 12 over the squared depth in 1/m2, and the factor on the viscosity in the plane."""

    friction: float = 0.0
    factor: float = 1.0


def flow(made: Mesh, has_open_sides: bool, axes: list[int], plates: Plates) -> list[Flow]:
    """Flow along each of the axes."""
    stiffness, divergence, load = matrices(made, plates)
    free = np.flatnonzero(~made.is_wall)
    corners = np.unique(made.nodes[:, :3])
    # Without an open side the pressure is known but for a constant.
    unknown = corners if has_open_sides else corners[1:]
    stiffness = stiffness[free][:, free]
    b = [part[unknown][:, free] for part in divergence]
    blocks = [[stiffness, None, b[0].T], [None, stiffness, b[1].T], [b[0], b[1], None]]
    factors = linalg.splu(sparse.bmat(blocks, format="csc"))
    flows = []
    for axis in axes:
        right = np.zeros(2 * len(free) + len(unknown))
        right[axis * len(free) : (axis + 1) * len(free)] = load[free]
        solution = factors.solve(right)
        velocity, pressure = np.zeros((made.count, 2)), np.zeros(made.corners)
        velocity[free] = solution[: 2 * len(free)].reshape(2, -1).T
        pressure[unknown] = solution[2 * len(free) :]
        flows.append(Flow(velocity, pressure, load @ velocity))
    return flows


def matrices(made: Mesh, plates: Plates):
    """Resistance to velocities, products of pressures with divergences along both axes, and integrals of nodes."""
    k = np.zeros((len(made.nodes), 6, 6))
    b = np.zeros((2, len(made.nodes), 3, 6))
    load = np.zeros(made.count)
    for weight, value, corner, gradient in quadrature(made):
        k += plates.factor * weight[:, None, None] * np.einsum("mia,mja->mij", gradient, gradient)
        k += plates.friction * weight[:, None, None] * np.outer(value, value)
        for axis in (0, 1):
            b[axis] -= weight[:, None, None] * corner[:, None] * gradient[:, None, :, axis]
        np.add.at(load, made.nodes, weight[:, None] * value)

    def matrix(local: np.ndarray, rows: np.ndarray, shape: tuple[int, int]) -> sparse.csr_matrix:
        i = np.broadcast_to(rows[:, :, None], local.shape).ravel()
        j = np.broadcast_to(made.nodes[:, None, :], local.shape).ravel()
        return sparse.coo_matrix((local.ravel(), (i, j)), shape=shape).tocsr()

    divergence = [matrix(part, made.nodes[:, :3], (made.corners, made.count)) for part in b]
    return matrix(k, made.nodes, (made.count, made.count)), divergence, load


def permeability(domain: Domain, across: float, plates: Plates | None = None) -> dict[int, np.ndarray]:
    """For each axis along which the domain is periodic or open, the mean velocity in m2 under a gradient along it."""
    axes = [axis for axis in (0, 1) if domain.sides[axis] != "wall"]
    if not axes or domain.sides == ("open", "open"):
        raise ValueError("one axis must be periodic or open, and not both open")
    flows = flow(mesh(domain, across), "open" in domain.sides, axes, plates or Plates())
    return {axis: found.total / np.prod(domain.period) for axis, found in zip(axes, flows, strict=True)}


def domain_of(path: Path, sides: tuple[str, str], box: list[float] | None = None) -> Domain:
    """The domain of a shape file, or of a list of discs in a box."""
    if path.suffix != ".toml":
        if box is None:
            raise ValueError(f"{path}: a list of discs needs --box")
        rows = np.loadtxt(path, comments="#", ndmin=2)
        return Domain(np.array(box[:2]), np.array(box[2:]), [Disc(row[:2], row[2]) for row in rows], sides)
    content = tomllib.loads(path.read_text(encoding="utf-8"))
    grains = [grain(path, *pair) for shape in content["shapes"] for pair in shape.items()]
    return Domain(np.array(content["min"]), np.array(content["max"]), grains, sides)


def grain(path: Path, kind: str, keys: dict) -> Disc | Polygon:
    """One shape of a shape file."""
    if kind == "disc":
        return Disc(np.array(keys["center"]), keys["radius"])
    if kind not in ("rectangle", "polygon") or keys.get("holes"):
        raise ValueError(f"{path}: {kind}: expected discs, rectangles and polygons without holes")
    angle = np.radians(keys.get("rotation-deg", 0))
    turn = np.array([[np.cos(angle), np.sin(angle)], [-np.sin(angle), np.cos(angle)]])
    if kind == "polygon":
        return Polygon(np.array(keys["outer"]) @ turn + keys.get("position", [0, 0]))
    corners = np.array([[-0.5, -0.5], [0.5, -0.5], [0.5, 0.5], [-0.5, 0.5]]) * keys["size"]
    return Polygon(corners @ turn + keys["center"])


def measure(domain: Domain, across: float, plates: Plates) -> dict:
    """Permeabilities in m2 with the share by which the coarser mesh differs."""
    found = {"porosity": domain.pore_area() / float(np.prod(domain.period))}
    coarse = permeability(domain, across / COARSER, plates)
    for axis, mean in permeability(domain, across, plates).items():
        found[f"permeability-{'xy'[axis]}-m2"] = float(mean[axis])
        found[f"difference-{'xy'[axis]}"] = float(abs(coarse[axis][axis] / mean[axis] - 1))
    return found


def record(path: Path, domain: Domain) -> dict:
    """The domain as it stands in the file that --json writes; grains of other kinds than discs are left to SHAPES."""
    discs = [[*map(float, one.center), float(one.radius)] for one in domain.grains if isinstance(one, Disc)]
    return {"shapes": path.name, "min": domain.low.tolist(), "max": domain.high.tolist(), "discs": discs}


def main() -> None:
    """Prints permeabilities, and beside them those of networks."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("shapes", nargs="+", type=Path, help="shape files, or lists x y r")
    parser.add_argument("--periodic", default="", choices=["", "x", "y", "xy"], help="axes along which sides are joined")
    parser.add_argument("--open", default="", choices=["", "x", "y"], help="axis along which both sides are open")
    parser.add_argument("--box", type=float, nargs=4, metavar=("X0", "Y0", "X1", "Y1"), help="corners in m of a list")
    parser.add_argument("--depth", type=float, help="distance of floor and lid in m")
    parser.add_argument("--profile-factor", type=float, default=1.2, help="factor on the viscosity in the plane")
    parser.add_argument("--across", type=float, default=4.5, help="edges of elements across a gap")
    parser.add_argument("--network", type=Path, nargs="*", default=[], help="output folders of the networks of SHAPES")
    parser.add_argument("--json", type=Path, help="file to write")
    given = parser.parse_args()
    sides = tuple("periodic" if a in given.periodic else "open" if a in given.open else "wall" for a in "xy")
    plates = Plates(12 / given.depth**2, given.profile_factor) if given.depth else Plates()
    records = []
    print(f"{'shapes':24} {'solid':>6} {'measure':17} {'Stokes in m2':>13} {'+-':>7} {'network in m2':>13} {'off':>7}")
    for index, path in enumerate(given.shapes):
        domain = domain_of(path, sides, given.box)
        found = measure(domain, given.across, plates)
        network = measures(given.network[index]) if index < len(given.network) else {}
        for axis in "xy":
            name = f"permeability-{axis}-m2"
            if name in found:
                row = f"{path.stem:24} {1 - found['porosity']:6.3f} {name:17} {found[name]:13.4e}"
                row += f" {found[f'difference-{axis}']:7.2%}"
                if name in network:
                    row += f" {network[name]:13.4e} {network[name] / found[name] - 1:+7.1%}"
                print(row, flush=True)
        records.append(record(path, domain) | found)
    if given.json:
        lines = ",\n".join(json.dumps(one) for one in records)
        given.json.write_text(f"[\n{lines}\n]\n", encoding="utf-8")


if __name__ == "__main__":
    main()
