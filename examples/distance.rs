//! The signed distance from two grains between plates, and the direction away from the wall. `cargo run --release --example distance`
use meniscus::{Channel, Disc, Geometry, GeometrySpec, ShapeSpec, SolidSide, Vec2};

fn main() -> Result<(), meniscus::GeometryError> {
    let shapes = vec![
        ShapeSpec::Channel(Channel { center: [0.0; 2], width: 1.8e-3, rotation_deg: 0.0 }),
        ShapeSpec::Disc(Disc { center: [-0.5e-3, 0.0], radius: 0.4e-3 }),
        ShapeSpec::Disc(Disc { center: [0.5e-3, 0.0], radius: 0.4e-3 }),
    ];
    let geometry = Geometry::new(&GeometrySpec { min: [-1e-3; 2], max: [1e-3; 2], solid: SolidSide::Inside, shapes })?;
    for x in [Vec2::zeros(), Vec2::new(0.0, 0.9e-3), Vec2::new(0.6e-3, 0.0)] {
        let wall = geometry.wall(x);
        println!(
            "({:4.1}, {:4.1}) mm: {:7.4} mm, normal ({:5.2}, {:5.2})",
            x.x * 1e3,
            x.y * 1e3,
            wall.distance * 1e3,
            wall.normal.x,
            wall.normal.y
        );
    }
    Ok(())
}
