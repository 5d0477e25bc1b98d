//! The text of a case of two equal fluids.

/// The text of a case up to the initial shapes and what follows: two fluids of the `viscosity` (Pa s) and a tension of 0.02 N/m in a periodic box from
/// −`half` to `half` (m) along both axes.
pub fn equal_fluids(half: f64, spacing: f64, viscosity: f64) -> String {
    let sides = ["left", "right", "bottom", "top"].map(|side| format!("{side} = \"periodic\"\n")).concat();
    let fluid = format!("density = 1000.0\nviscosity = {viscosity:e}\n");
    format!(
        "format = 1\ntitle = \"Two equal fluids\"\n[geometry]\nmin = [{0:e}, {0:e}]\nmax = [{half:e}, {half:e}]\n[time]\nend = 1.0\n\
         [sph]\nspacing = {spacing:e}\n[sph.phases.wetting]\n{fluid}[sph.phases.non-wetting]\n{fluid}\
         [sph.interface]\ntension = 0.02\n[sph.sides]\n{sides}",
        -half
    )
}
