//! Benchmarks: named cases, one file for each table `[sph.measure.NAME]` of a case file except those of the permeabilities, which are not benchmarks.
//!
//! A benchmark is a [`Group`] of measures: further columns of the time series, and measures at the end. Its input is the flow and the observation of it; the
//! solver receives the groups of a case as a list and does not depend on them (`src/run/setup.rs`).
//!
//! An exact solution is in the file of its benchmark; those between two discs, used by two benchmarks, in [`disc_pair`], and the drop on a flat wall, used by
//! the solver too, in [`cap`](crate::interface::cap). Angles are in rad through the wetting phase, lengths in m.
//!
//! Tools: `series` reads the time series, `moments` describes the shape of a drop, `damped` fits an oscillation, `waves` has the common parts of the
//! solutions for waves and drops, `force_balance` is that of a drop on a wall.

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

use crate::case::MeasureSet;
use crate::sph::measures::Group;

/// The groups of measures that a case asks for.
pub fn requested_groups(set: &MeasureSet) -> Vec<Group> {
    let all = [
        (set.sessile_drop, sessile_drop::GROUP),
        (set.laplace_drop, laplace_drop::GROUP),
        (set.poiseuille, poiseuille::GROUP),
        (set.taylor_green, taylor_green::GROUP),
        (set.capillary_bridge, capillary_bridge::GROUP),
        (set.four_discs, four_discs::GROUP),
        (set.drop_on_disc, drop_on_disc::GROUP),
        (set.oscillating_drop, oscillating_drop::GROUP),
        (set.shear_drop, shear_drop::GROUP),
        (set.capillary_wave, capillary_wave::GROUP),
        (set.rising_bubble, rising_bubble::GROUP),
        (set.layered_poiseuille, layered_poiseuille::GROUP),
        (set.cavity, cavity::GROUP),
        (set.cylinder_array, cylinder_array::GROUP),
        (set.throat_entry, throat_entry::GROUP),
        (set.jurin, jurin::GROUP),
        (set.moving_drop, moving_drop::GROUP),
        (set.spreading, spreading::GROUP),
        (set.slit_filling, slit_filling::GROUP),
        (set.capillary_rise, capillary_rise::GROUP),
    ];
    all.into_iter().filter(|(is_requested, _)| *is_requested).map(|(_, group)| group).collect()
}
