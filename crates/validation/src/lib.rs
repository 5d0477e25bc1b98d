//! Benchmarks: named cases, one file for each table `[sph.measure.NAME]` of a case file except those of the permeabilities, which are not benchmarks.
//!
//! A benchmark is a [`Group`] of measures: further columns of the time series, and measures at the end. Its input is the flow and the observation of it; the
//! solver receives the groups of a case as a list and does not depend on them (`src/run/setup.rs`).
//!
//! An exact solution is in the file of its benchmark; those between two discs, used by two benchmarks, in [`disc_pair`], and the drop on a flat wall, used by
//! the solver too, in [`cap`](meniscus_geometry::interface::cap). Angles are in rad through the wetting phase, lengths in m.
//!
//! Tools: `series` reads the time series, `moments` describes the shape of a drop, `damped` fits an oscillation, `waves` has the common parts of the
//! solutions for waves and drops, `force_balance` is that of a drop on a wall.
#![warn(unreachable_pub)]

mod capillary_bridge;
mod capillary_rise;
mod capillary_wave;
mod cavity;
mod cylinder_array;
mod damped;
pub mod disc_pair;
mod drop_on_disc;
mod force_balance;
mod four_discs;
mod jurin;
mod laplace_drop;
mod layered_poiseuille;
mod moments;
mod moving_drop;
mod oscillating_drop;
mod parasitic_currents;
mod poiseuille;
mod rising_bubble;
mod series;
mod sessile_drop;
mod shear_drop;
mod slit_filling;
mod spreading;
mod taylor_green;
mod throat_entry;
mod waves;

use meniscus_case::MeasureSet;
use meniscus_sph::measures::Group;

/// The groups of measures that a case asks for.
pub fn requested_groups(set: &MeasureSet) -> Vec<Group> {
    let all = [
        (set.sessile_drop, Group::with_columns(sessile_drop::columns, sessile_drop::measures)),
        (set.laplace_drop, Group::of(laplace_drop::measures)),
        (set.parasitic_currents, Group::of(parasitic_currents::measures)),
        (set.poiseuille, Group::of(poiseuille::measures)),
        (set.taylor_green, Group::of(taylor_green::measures)),
        (set.capillary_bridge, Group::of(capillary_bridge::measures)),
        (set.four_discs, Group::of(four_discs::measures)),
        (set.drop_on_disc, Group::of(drop_on_disc::measures)),
        (set.oscillating_drop, Group::with_columns(oscillating_drop::columns, oscillating_drop::measures)),
        (set.shear_drop, Group::with_columns(oscillating_drop::columns, shear_drop::measures)),
        (set.capillary_wave, Group::with_columns(capillary_wave::columns, capillary_wave::measures)),
        (set.rising_bubble, Group::with_columns(rising_bubble::columns, rising_bubble::measures)),
        (set.layered_poiseuille, Group::of(layered_poiseuille::measures)),
        (set.cavity, Group::of(cavity::measures)),
        (set.cylinder_array, Group::of(cylinder_array::measures)),
        (set.throat_entry, Group::of(throat_entry::measures)),
        (set.jurin, Group::of(jurin::measures)),
        (
            set.moving_drop,
            Group {
                warnings: force_balance::warnings,
                ..Group::with_columns(moving_drop::columns, moving_drop::measures)
            },
        ),
        (set.spreading, Group::with_columns(spreading::columns, spreading::measures)),
        (set.slit_filling, Group::with_columns(slit_filling::columns, slit_filling::measures)),
        (set.capillary_rise, Group::with_columns(capillary_rise::columns, capillary_rise::measures)),
    ];
    all.into_iter().filter(|(is_requested, _)| *is_requested).map(|(_, group)| group).collect()
}
