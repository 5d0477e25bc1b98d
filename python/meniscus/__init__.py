"""Two-phase flow with partial wetting in pores.

The three models of the program ``meniscus`` as functions: direct simulation by smoothed particle hydrodynamics (SPH), thin films and pore networks.
All numbers are in SI units; angles are in degrees where a name ends in ``deg``.

>>> import meniscus
>>> result = meniscus.network("chip.svg", inlet="left", outlet="right", angle_deg=40, tension=0.0728)
>>> result.measures["breakthrough-pressure-Pa"]
>>> result.throats["width_m"]
"""

from ._check import Check, check
from ._meniscus import __version__
from ._run import network, run
from ._study import Sample, Study, study
from .errors import CaseError, FolderError, MeniscusError, MeniscusWarning, Mistake, SolverError
from .measures import Measure, Measures
from .results import Diagram, Fields, Frame, Result, Trace

__all__ = [
    "CaseError",
    "Check",
    "Diagram",
    "Fields",
    "FolderError",
    "Frame",
    "Measure",
    "Measures",
    "MeniscusError",
    "MeniscusWarning",
    "Mistake",
    "Result",
    "Sample",
    "SolverError",
    "Study",
    "Trace",
    "__version__",
    "check",
    "network",
    "run",
    "study",
]
