//! Gas drains the pores between discs from the left: capillary pressure of each event. `cargo run --release -p meniscus-network --example drainage`
use meniscus_geometry::Geometry;
use meniscus_geometry::spec::{Disc, GeometrySpec, ShapeSpec, SolidSide};
use meniscus_network::displacement::{Conditions, Displacement};
use meniscus_network::{extract, graph::Pores};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let discs =
        [(0.5, 0.4, 0.30), (0.6, 1.3, 0.38), (1.4, 0.8, 0.42), (1.3, 1.8, 0.31), (2.2, 0.3, 0.35), (2.1, 1.5, 0.40)]; // mm
    let disc = |(x, y, r): (f64, f64, f64)| ShapeSpec::Disc(Disc { center: [x * 1e-3, y * 1e-3], radius: r * 1e-3 });
    let shapes: Vec<_> = discs.map(disc).to_vec();
    let mut conditions = Conditions::new(vec![40f64.to_radians(); shapes.len() + 4]); // of the shapes, then of the sides
    (conditions.inlet[0], conditions.outlet[1]) = (true, true);
    let geometry =
        Geometry::new(&GeometrySpec { min: [0.0; 2], max: [2.7e-3, 2.2e-3], solid: SolidSide::Inside, shapes })?;
    let network = extract(&geometry, [true, true, false, false])?;
    for event in Displacement::new(&network, &Pores::merged(&network, 1.0), conditions) {
        println!("{:6.1} Pa: {:?}, throat {:?}", 0.03 * event.curvature, event.kind, event.throat);
    }
    Ok(())
}
