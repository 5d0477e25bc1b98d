//! Gas drains a random pack of discs from the left: capillary pressure over the saturation of the liquid, event by event.
//! `cargo run --release --package meniscus-network --example drainage`
use meniscus_geometry::Geometry;
use meniscus_geometry::spec::{GeometrySpec, PackAxes, RandomPack, ShapeSpec, SolidSide};
use meniscus_network::displacement::{Conditions, Displacement, Phase};
use meniscus_network::{extract, graph::Pores};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let (min, max, periodic) = ([0.0; 2], [4e-3, 3e-3], PackAxes::None); // m
    let pack = RandomPack {
        seed: 1,
        porosity: 0.5,
        radius: 2e-4,
        radius_deviation: 0.2,
        gap: 2e-5,
        region: [min, max],
        periodic,
    };
    let shapes = ShapeSpec::RandomPack(pack).expanded()?;
    let mut conditions = Conditions::new(vec![40f64.to_radians(); shapes.len() + 4]); // of the shapes, then of the sides
    (conditions.inlet[0], conditions.outlet[1]) = (true, true);
    let geometry = Geometry::new(&GeometrySpec { min, max, solid: SolidSide::Inside, shapes })?;
    let network = extract(&geometry, [true, true, false, false])?;
    let mut events = Displacement::new(&network, &Pores::merged(&network, 1.0), conditions);
    while let Some(event) = events.next() {
        let area = |all: bool| -> f64 {
            let is_counted = |i: &usize| all || events.phase(*i) == Phase::Defending;
            (0..events.elements().len()).filter(is_counted).map(|i| events.elements()[i].area).sum()
        };
        println!("{:7.1} Pa {:5.3}", 0.03 * event.curvature, area(false) / area(true));
    }
    Ok(())
}
