//! What a resumed run needs: everything else follows from the particles.

use serde::{Deserialize, Serialize};

use crate::solver::{StateError, StepInfo};
use crate::sph::open::{GivenFlow, Ledger};
use crate::sph::particles::Particles;
use crate::sph::projection::Flow;
use crate::sph::wetting::lines::Line;

#[derive(Serialize, Deserialize)]
struct State {
    time: f64,
    steps: u64,
    dt: f64,
    particles: Particles,
    wall_depth: Vec<f64>,
    lines: Vec<Line>,
    ledger: Ledger,
    given_flows: Vec<GivenFlow>,
}

/// The state of the flow as bytes.
#[must_use]
pub fn save(flow: &Flow) -> Vec<u8> {
    let state = State {
        time: flow.time,
        steps: flow.steps,
        dt: flow.last.dt,
        particles: flow.particles.clone(),
        wall_depth: flow.wall_depth.clone(),
        lines: flow.lines.clone(),
        ledger: flow.open.ledger,
        given_flows: flow.open.through.iter().map(|through| through.state).collect(),
    };
    // Plain numbers into memory: postcard has no way to fail here, and an empty state is refused by `load`.
    postcard::to_stdvec(&state).unwrap_or_default()
}

/// Takes up a saved state.
///
/// # Errors
/// [`StateError`] where the bytes are no state of a flow with as many particles.
pub fn load(flow: &mut Flow, bytes: &[u8]) -> Result<(), StateError> {
    let state: State = postcard::from_bytes(bytes).map_err(|e| StateError(format!("{e}")))?;
    let (found, expected) = (state.particles.len(), flow.particles.len());
    let is_open = !flow.open.sides.is_empty();
    let same_fluid = found == expected && state.particles.fluids == flow.particles.fluids;
    if state.particles.walls != flow.particles.walls || !(is_open || same_fluid) {
        return Err(StateError(format!("it has {found} particles, the case has {expected}")));
    }
    flow.time = state.time;
    flow.steps = state.steps;
    flow.last = StepInfo { dt: state.dt, limit: "restart" };
    flow.particles = state.particles;
    flow.wall_depth = state.wall_depth;
    flow.face_walls();
    flow.lines = state.lines;
    flow.open.ledger = state.ledger;
    for (through, state) in flow.open.through.iter_mut().zip(state.given_flows) {
        through.state = state;
    }
    flow.prepare();
    Ok(())
}
