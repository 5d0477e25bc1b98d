//! `[time]`, `[output]` and `[[expect]]`: the duration of a run, its output, and its expected results. `records` has their checks.

use super::steady::RawSteady;
use meniscus_core::input::tables::{Key, tables, words};

tables! {
    /// How long the simulation runs.
    pub(crate) struct RawTime {
        /// End of the simulation in s; with `steady` the latest end.
        pub end: f64 => Key::within("an end time in s", 1.0e-15, 1.0e9).example("end = 0.01 # s"),
        /// Ends a run of `[sph]` when it is steady.
        pub steady: RawSteady,
    }

    /// What is written and when.
    pub(crate) struct RawOutput {
        /// Particles, grid and interface; of a network, menisci and regions (default: 50 records).
        pub vtk: RawVtk,
        /// Rows of `series.csv` (default: 200 records).
        pub series: RawEvery,
        /// Regular grid of the output.
        pub grid: RawGrid,
        /// Saved states; also written on an interrupt or a failure (default: 10 records).
        pub restart: RawEvery,
    }

    /// Files for ParaView.
    pub(crate) struct RawVtk {
        /// Time between records in s.
        pub every_time: f64 => Key::positive("a time in s"),
        /// Displaced pore volumes between records.
        pub every_pore_volume: f64 => Key::positive("a number of displaced pore volumes"),
        /// Compression of arrays; meshio does not read `lz4` (default `zlib`).
        pub compression: Compression,
    }

    /// A schedule.
    pub(crate) struct RawEvery {
        /// Time between records in s.
        pub every_time: f64 => Key::positive("a time in s"),
        /// Displaced pore volumes between records.
        pub every_pore_volume: f64 => Key::positive("a number of displaced pore volumes"),
    }

    /// The regular grid of the output.
    pub(crate) struct RawGrid {
        /// Distance of grid nodes over particle spacing; at most the shorter side of the domain, and 2e7 nodes (default 1).
        pub ratio: f64 => Key::within("grid distance over particle spacing", 0.25, 100.0),
    }

    /// An expected measure.
    pub(crate) struct RawExpectation {
        /// Name of a measure, such as `contact-angle-deg`.
        pub measure: String => Key::required("measure = \"contact-angle-deg\""),
        /// Expected value in the unit of the measure.
        pub value: f64 => Key::required("value = 40.0"),
        /// Largest accepted deviation in the same unit.
        pub tolerance: f64 => Key::positive("a tolerance").example("tolerance = 3.0"),
    }
}

words! {
    /// How arrays in VTK files are compressed.
    pub enum Compression {
        /// None: read by every program, the largest files.
        None,
        /// By zlib: read by every program.
        Zlib,
        /// By LZ4: read by VTK, ParaView and pyvista, not by meshio.
        Lz4,
    }
}

/// What is written and when.
#[derive(Debug, Clone, Copy, PartialEq, serde::Serialize)]
pub struct Output {
    /// Time between records of the series in s; for a network, displaced pore volumes, as in the other intervals.
    pub series_every: f64,
    /// Time between VTK files in s, independent of the records of the series.
    pub vtk_every: f64,
    /// How arrays in VTK files are compressed.
    pub vtk_compression: Compression,
    /// Distance of grid nodes relative to dx.
    pub grid_ratio: f64,
    /// Time between restart files in s.
    pub restart_every: f64,
}

/// An expected measure.
#[derive(Debug, Clone, PartialEq, serde::Serialize)]
pub struct Expectation {
    /// Name of a measure.
    pub measure: String,
    /// Expected value in the measure's unit.
    pub value: f64,
    /// Largest accepted deviation, same unit.
    pub tolerance: f64,
}
