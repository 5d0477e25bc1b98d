//! A drop on a floor by direct simulation, step by step: its contact angle. `cargo run --release --example droplet`
use meniscus::{Overrides, Series, load, solver_of};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let coarse = Overrides::parse(&["sph.spacing=4e-5", "sph.wetting.young.contact-angle-deg=70"])?;
    let case = load("cases/sessile-drop.toml".as_ref(), &coarse)?.case;
    let mut solver = solver_of(&case)?;
    for record in 1..=4 {
        let time = 0.1 * f64::from(record) * case.end;
        while solver.time() < time {
            solver.step(time)?;
        }
        let measures = solver.measures(&Series::default());
        let angle = measures.iter().find(|measure| measure.name == "contact-angle-deg").map(|measure| measure.value);
        println!("{:.2e} s: {:.2} degrees", solver.time(), angle.unwrap_or(f64::NAN));
    }
    Ok(())
}
