"""A sessile or free drop without gravity by lbmpy: lattice Boltzmann, conservative Allen-Cahn, contact angle at the wall.

Usage: lbmpy_drop.py [ANGLE_DEG] [--cells 20] [--width 5] [--capillary-times 20]

The drop starts at 90 degrees on the floor of a box periodic along x. Domain over radius, equal densities and
viscosities and the Ohnesorge number are those of `cases/sessile-drop.toml`; without an angle the drop is that of
`cases/laplace-drop.toml`, free in a periodic box. One thread. Prints a line of JSON: cells, steps, CPU seconds of the
steps alone (kernels are compiled before), and records of time in capillary times, CPU seconds and angle in degrees or
pressure jump over tension/radius.
"""

import argparse
import json
import math
import time

import numpy as np
import pystencils as ps
import sympy as sp
from lbmpy import LBMConfig, LBMOptimisation, LBStencil, Method, Stencil, create_lb_update_rule
from lbmpy.boundaries import NoSlip
from lbmpy.boundaries.boundaryhandling import LatticeBoltzmannBoundaryHandling
from lbmpy.creationfunctions import create_lb_method
from lbmpy.phasefield_allen_cahn.contact_angle import ContactAngle
from lbmpy.phasefield_allen_cahn.kernel_equations import (
    add_hydrodynamic_force,
    add_interface_tracking_force,
    hydrodynamic_force_assignments,
    initializer_kernel_hydro_lb,
    initializer_kernel_phase_field_lb,
    interface_tracking_force,
)
from lbmpy.phasefield_allen_cahn.parameter_calculation import AllenCahnParameters
from pystencils.boundaries.boundaryhandling import BoundaryHandling
from pystencils.simp import sympy_cse

# Width and height of the domain over the radius and Ohnesorge number, as in the cases: on a wall, free.
DOMAIN, OHNESORGE = (5.0, 2.0), 0.035
FREE_DOMAIN, FREE_OHNESORGE = (4.0, 4.0), 0.335
# Speeds stay below a tenth of the speed of sound: interfacial tension in lattice units, densities being 1.
TENSION = 1.0e-3
# Width of the interface in cells if not given, and mobility: usual settings of the model.
WIDTH, MOBILITY = 5, 0.05
# Height of the wall in cells: half a cell below the centers of the first row of fluid, above a row of wall.
WALL = 1.0
# The angle is looked at so often per capillary time.
LOOKS = 10


def kernels(radius: float, angle: float | None, width: int):
    """The data of the drop and a function that does a step; without an angle there are no walls."""
    free = angle is None
    size = tuple(round(part * radius) for part in (FREE_DOMAIN if free else DOMAIN))
    viscosity = (FREE_OHNESORGE if free else OHNESORGE) * math.sqrt(TENSION * radius)
    parameters = AllenCahnParameters(1.0, 1.0, viscosity, viscosity, TENSION, MOBILITY, 0.0, width)
    numbers = parameters.parameter_map()
    stencil = LBStencil(Stencil.D2Q9)
    data = ps.create_data_handling(domain_size=size, periodicity=(True, free), default_target=ps.Target.CPU)
    config = ps.CreateKernelConfig(target=ps.Target.CPU, cpu_openmp=False)
    names = [("g", 9), ("g_tmp", 9), ("h", 9), ("h_tmp", 9), ("u", 2), ("c", 1), ("c_tmp", 1)]
    g, g_tmp, h, h_tmp, u, c, c_tmp = (data.add_array(name, values_per_cell=count) for name, count in names)
    data.fill("u", 0.0, ghost_layers=True)
    columns, rows = np.meshgrid(np.arange(-0.5, size[0] + 1.5), np.arange(-0.5, size[1] + 1.5), indexing="ij")
    away = np.hypot(columns - 0.5 * size[0], rows - (0.5 * size[1] if free else WALL))
    profile = 0.5 - 0.5 * np.tanh(2.0 * (away - radius) / width)
    for name in ("c", "c_tmp"):
        data.cpu_arrays[name][:, :] = profile

    forces = sp.symbols("F_:2")
    rates = [0.0, parameters.omega_phi, parameters.omega_phi] + [1.0] * 6
    phase = LBMConfig(
        stencil=stencil, method=Method.MRT, compressible=True, delta_equilibrium=False, zero_centered=False,
        force=forces, velocity_input=u, weighted=True, relaxation_rates=rates,
        output={"density": c_tmp}, kernel_type="stream_pull_collide",
    )  # fmt: skip
    hydro = LBMConfig(
        stencil=stencil, method=Method.MRT, compressible=False, weighted=True,
        relaxation_rates=[parameters.omega(c).subs(numbers), 1.0, 1.0, 1.0, 1.0, 1.0],
        force=forces, output={"velocity": u}, kernel_type="collide_stream_push",
    )  # fmt: skip
    of_phase, of_hydro = create_lb_method(lbm_config=phase), create_lb_method(lbm_config=hydro)

    def compiled(rule):
        return ps.create_kernel(sympy_cse(rule.new_with_substitutions(numbers)), config=config).compile()

    first = [
        compiled(initializer_kernel_phase_field_lb(of_phase, c, u, h, parameters)),
        compiled(initializer_kernel_hydro_lb(of_hydro, 1, u, g)),
    ]
    rule = create_lb_update_rule(
        lbm_config=phase, lbm_optimisation=LBMOptimisation(symbolic_field=h, symbolic_temporary_field=h_tmp)
    )
    track = compiled(add_interface_tracking_force(rule, interface_tracking_force(c, stencil, parameters)))
    rule = create_lb_update_rule(
        lbm_config=hydro, lbm_optimisation=LBMOptimisation(symbolic_field=g, symbolic_temporary_field=g_tmp)
    )
    force = hydrodynamic_force_assignments(u, c, of_hydro, parameters, [0, 0])
    flow = compiled(add_hydrodynamic_force(rule, force, c, g, parameters, hydro))

    walls = () if free else (ps.make_slice[:, 0], ps.make_slice[:, -1])
    wall_of_phase = LatticeBoltzmannBoundaryHandling(
        of_phase, data, "h", name="walls_of_phase", streaming_pattern="pull"
    )
    wall_of_flow = LatticeBoltzmannBoundaryHandling(of_hydro, data, "g", name="walls_of_flow", streaming_pattern="push")
    wetting = BoundaryHandling(data, "c", stencil, name="wetting", target=ps.Target.CPU)
    wall, touched = NoSlip("wall"), None if free else ContactAngle(angle, width)
    for place in walls:
        wall_of_phase.set_boundary(wall, place)
        wall_of_flow.set_boundary(wall, place)
        wetting.set_boundary(touched, place)
    for handling in (wall_of_phase, wall_of_flow, wetting):
        handling.prepare()
    sync_h, sync_g, sync_c = (data.synchronization_function([name]) for name in ("h", "g", "c"))
    sync_c()
    wetting()
    for kernel in first:
        data.run_kernel(kernel)

    def step() -> None:
        sync_h()
        wall_of_phase()
        data.run_kernel(track)
        data.swap("c", "c_tmp")
        data.swap("h", "h_tmp")
        wetting()
        sync_c()
        data.run_kernel(flow)
        wall_of_flow()
        sync_g()
        data.swap("g", "g_tmp")

    return data, size, step


def circle_of(phase: np.ndarray, width: int) -> tuple[float, float, float]:
    """Center and radius of a circle fitted to the contour 0.5 more than half an interface from the floor."""
    points = []
    for row in range(width // 2 + 1, phase.shape[1] - 1):
        values = phase[:, row]
        for i in np.flatnonzero((values[:-1] - 0.5) * (values[1:] - 0.5) < 0.0):
            points.append((i + 0.5 + (0.5 - values[i]) / (values[i + 1] - values[i]), row + 0.5))
    for column in range(phase.shape[0]):
        values = phase[column, width // 2 + 1 :]
        for i in np.flatnonzero((values[:-1] - 0.5) * (values[1:] - 0.5) < 0.0):
            points.append((column + 0.5, width // 2 + 1.5 + i + (0.5 - values[i]) / (values[i + 1] - values[i])))
    if len(points) < 6:
        return math.nan, math.nan, math.nan
    x, y = np.array(points).T
    matrix = np.column_stack((x, y, np.ones_like(x)))
    a, b, k = np.linalg.lstsq(matrix, x * x + y * y, rcond=None)[0]
    return 0.5 * a, 0.5 * b, math.sqrt(max(k + 0.25 * (a * a + b * b), 0.0))


def angle_of(phase: np.ndarray, width: int) -> float:
    """Contact angle of the circle in degrees."""
    _, height, radius = circle_of(phase, width)
    return math.nan if math.isnan(radius) else math.degrees(math.acos(min(1.0, max(-1.0, (WALL - height) / radius))))


def jump_of(phase: np.ndarray, populations: np.ndarray, width: int) -> float:
    """Mean pressure in the drop less that around it, an interface off the contour 0.5, over tension/radius."""
    x, y, radius = circle_of(phase, width)
    columns, rows = np.meshgrid(*(np.arange(count) + 0.5 for count in phase.shape), indexing="ij")
    away, pressure = np.hypot(columns - x, rows - y), populations.sum(axis=-1) / 3.0
    inside, outside = away < radius - width, away > radius + width
    return float((pressure[inside].mean() - pressure[outside].mean()) * radius / TENSION)


def main() -> None:
    """Runs the drop and prints what came out."""
    parser = argparse.ArgumentParser(description="a drop by lbmpy")
    parser.add_argument("angle", type=float, nargs="?", help="contact angle in degrees; a free drop if not given")
    parser.add_argument("--cells", type=int, default=20, help="cells per radius of the disc at the start")
    parser.add_argument("--width", type=int, default=WIDTH, help="width of the interface in cells")
    parser.add_argument("--capillary-times", type=float, default=20.0, help="how long it runs")
    asked = parser.parse_args()
    data, size, step = kernels(asked.cells, asked.angle, asked.width)
    capillary_time = math.sqrt(asked.cells**3 / TENSION)
    every = max(1, round(capillary_time / LOOKS))
    records, begun = [], time.process_time()
    for look in range(1, round(asked.capillary_times * LOOKS) + 1):
        for _ in range(every):
            step()
        seconds = time.process_time() - begun
        phase = data.gather_array("c")
        value = jump_of(phase, data.gather_array("g"), asked.width) if asked.angle is None else angle_of(phase, asked.width)
        records.append((look * every / capillary_time, seconds, value))
    unknowns, steps = size[0] * size[1], len(records) * every
    print(json.dumps({"unknowns": unknowns, "steps": steps, "cpu_s": records[-1][1], "records": records}))


if __name__ == "__main__":
    main()
