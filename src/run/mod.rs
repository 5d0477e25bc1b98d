//! The simulation loop, its schedule, sinks and report.
