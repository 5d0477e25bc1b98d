//! A spreading droplet by the Geometric Thin-Film Equation: its measures at the end. `cargo run --release --example film`
use meniscus::{Overrides, Series, load, solver_of};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let case = load("cases/thin-film/partial-wetting.toml".as_ref(), &Overrides::default())?.case;
    let mut solver = solver_of(&case)?;
    while solver.time() < case.end {
        solver.step(case.end)?;
    }
    for measure in solver.measures(&Series::default()) {
        println!("{}: {:.4e}", measure.name, measure.value);
    }
    Ok(())
}
