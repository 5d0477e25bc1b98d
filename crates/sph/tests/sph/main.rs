//! Direct simulation: equations, steps, walls and open sides.

#[allow(dead_code, reason = "other test programs use the rest")]
#[path = "../../../../tests/support"]
mod support {
    pub mod boxes;
    pub mod cloud;
    pub mod dice;
    pub mod flow;
}

mod analysis;
mod counted_work;
mod curvature_of_waves;
mod depth;
mod equal_fluids;
mod fitted_interface;
mod fitted_walls;
mod open_sides;
mod poisson;
mod steady_flows;
mod step;
mod stream;
mod terms;
mod viscosity;
mod walls;
mod warnings;
