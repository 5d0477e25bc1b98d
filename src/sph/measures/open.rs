//! What runs with open sides report: the balance of what came in, what left and what is inside.

use super::{Subject, measure};
use crate::solver::Measure;
use crate::sph::open::{Drive, Ledger};
use crate::sph::projection::Flow;

fn is_open(flow: &Flow) -> bool {
    !flow.open.sides.is_empty() || !flow.open.through.is_empty()
}

/// Areas in m² that came in and left since time zero, by phase: particles times their area at rest.
pub fn columns(flow: &Flow) -> Vec<(&'static str, f64)> {
    if !is_open(flow) {
        return vec![];
    }
    let (came, left) = flow.open.ledger.totals();
    let area = |count: u64| count as f64 * flow.method.volume;
    vec![
        ("wetting_in_m2", area(came[0])),
        ("wetting_out_m2", area(left[0])),
        ("non_wetting_in_m2", area(came[1])),
        ("non_wetting_out_m2", area(left[1])),
    ]
}

/// Areas in m² of the wetting and the non-wetting phase that came in less those that left.
pub fn net(flow: &Flow) -> [f64; 2] {
    let (came, left) = flow.open.ledger.totals();
    [0, 1].map(|i| (came[i] as f64 - left[i] as f64) * flow.method.volume)
}

pub fn measures(s: &Subject) -> Vec<Measure> {
    let flow = s.flow;
    if !is_open(flow) {
        return vec![];
    }
    let (ledger, fluids) = (&flow.open.ledger, flow.particles.fluids);
    let (came, left) = ledger.totals();
    let inside = Ledger::count(&flow.particles.phase[..fluids]);
    let start: u64 = ledger.at_start.iter().sum();
    let missing = |i: usize| (ledger.at_start[i] as f64 + came[i] as f64 - left[i] as f64 - inside[i] as f64).abs();
    let error = [0, 1].map(missing).into_iter().fold(0.0, f64::max) / start as f64;
    let net: f64 = net(flow).iter().sum();
    let area = |of: &crate::analysis::phases::PhaseAreas| of.wetting + of.non_wetting;
    let drift = (area(&s.seen.areas) - area(&s.start.areas) - net) / area(&s.start.areas);
    let mut found = vec![
        measure(
            "balance-error",
            error,
            "",
            None,
            "mass at time zero and what came in less what left and what is inside, in particles, larger of both phases, over all at \
             time zero",
        ),
        measure(
            "open-area-drift",
            drift,
            "",
            None,
            "change of the area of both phases less that of what passed through the sides, over the area at time zero",
        ),
    ];
    for side in &flow.open.sides {
        if let Drive::Velocity(profile) = &side.drive
            && flow.time > 0.0
        {
            let came: u64 = ledger.came[side.number].iter().sum();
            let ratio = came as f64 * flow.open.cell / (profile.flow_rate() * flow.time);
            found.push(measure(
                "inflow-ratio",
                ratio,
                "",
                None,
                "cells of the lattice that came in over flow rate times time",
            ));
        }
    }
    found
}
