//! Reads a drawing of another program, and tells its domain, porosity and throats. `cargo run --release --example drawing`
use meniscus::{Geometry, extract};
use meniscus_drawings::{import::Options, load};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let drawing = load("geometries/chip.svg".as_ref(), &Options::default())?;
    let geometry = Geometry::new(&drawing.spec)?;
    let network = extract(&geometry, [true, true, false, false])?;
    let pore: f64 = network.regions.iter().map(|region| region.area).sum();
    let narrowest = network.throats.iter().map(|throat| throat.width).fold(f64::INFINITY, f64::min);
    println!("{:.2} mm wide, porosity {:.4}", geometry.bounds().size().x * 1e3, pore / geometry.bounds().area());
    println!(
        "{} pores, {} throats, the narrowest {:.2} um",
        network.regions.len(),
        network.throats.len(),
        narrowest * 1e6
    );
    Ok(())
}
