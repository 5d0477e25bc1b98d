//! The cases of a subdomain, as files that a user can open and change.

use std::fmt::Write;

use super::fluids::Fluids;
use super::subdomain::Subdomain;
use meniscus_case::Fluid;
use meniscus_geometry::spec::{GeometrySpec, ShapeSpec};
use meniscus_network::cycles::FluidPhase as Phase;

/// Reynolds number ρQ/μ of the flow with which conductances are measured.
const REYNOLDS: f64 = 0.01;
/// Latest end of a run with a meniscus, in units of √(density · length³/tension) or density · length²/viscosity, whichever is longer.
const CAPILLARY_TIMES: f64 = 12.0;
/// The same in viscous times of the throat; an oscillation decays in one.
const VISCOUS_TIMES: f64 = 6.0;
/// End of a single-phase run in units of density · height²/viscosity; the slowest mode between plates decays in a tenth of it.
const FLOW_TIMES: f64 = 1.0;
/// Latest end of a run with a meniscus in relaxation times by the friction of floor and lid.
const FRICTION_TIMES: f64 = 6.0;
/// Largest relative deviation of the entry pressure from the formula that the case expects.
const EXPECTED: f64 = 0.02;

/// A throat for the titles of its cases.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Named<'a> {
    /// Its number in `throats.csv`.
    pub(crate) number: usize,
    /// The case of its network.
    pub(crate) network: &'a str,
    /// Spacings across.
    pub(crate) across: u32,
}

/// A shape as a value of a key.
fn shape(shape: ShapeSpec) -> String {
    // Numbers by name: all of it can be written as TOML.
    toml::Value::try_from(shape).map_or(String::new(), |value| value.to_string())
}

/// The beginning of a case, up to the spacing.
fn beginning(subdomain: &Subdomain, fluids: &Fluids, named: &Named, quantity: &str, what: &str) -> String {
    let Subdomain { frame, width, geometry: GeometrySpec { min, max, shapes, .. }, .. } = subdomain;
    let Named { number, network, across } = named;
    let shapes: String = shapes.iter().map(|one| format!("    {},\n", shape(one.clone()))).collect();
    let depth = fluids.chip.map_or(String::new(), |chip| format!("depth = {:e} # m\n", chip.depth.distance()));
    format!(
        "# {what}\n# Throat {number} of {network}, {width:.4e} m wide at ({:.4e}, {:.4e}) m; x is the flow direction of the invading phase, {:.2} degrees \
         counter-clockwise from that of the network.\nformat = 1\ntitle = \"Throat {number}: {quantity}, {across} spacings across\"\n\n\
         [geometry]\nmin = {min:?} # m\nmax = {max:?} # m\n{depth}shapes = [ # m; x, y and bulge of curved polygons\n{shapes}]\n\n\
         [sph]\nspacing = {:e} # m\n\n",
        frame.middle.x,
        frame.middle.y,
        frame.angle.to_degrees(),
        width / f64::from(*across)
    )
}

fn phase(name: &str, fluid: Fluid) -> String {
    format!("[sph.phases.{name}]\ndensity = {:e} # kg/m3\nviscosity = {:e} # Pa s\n\n", fluid.density, fluid.viscosity)
}

/// The case of the entry pressure: a closed box, filled by the invading phase up to the meniscus of largest curvature.
pub(crate) fn entry(subdomain: &Subdomain, fluids: &Fluids, named: &Named) -> String {
    let (width, tension) = (subdomain.width, fluids.tension);
    let [wetting, other] = fluids.of(width);
    // The more viscous phase damps oscillations most.
    let density = wetting.density.max(other.density);
    let viscosity = wetting.viscosity.max(other.viscosity);
    let size = meniscus_core::math::Vec2::from(subdomain.geometry.max)
        - meniscus_core::math::Vec2::from(subdomain.geometry.min);
    let length = size.min().max(width);
    let end = (CAPILLARY_TIMES * (density * length.powi(3) / tension).sqrt())
        .max(VISCOUS_TIMES * density * width * width / viscosity)
        .max(FRICTION_TIMES * fluids.friction_time(length, width));
    let pressure = fluids.invading.towards_wetting(fluids.pressure(subdomain.meniscus.curvature));
    let background = if fluids.invading == Phase::NonWetting { "wetting" } else { "non-wetting" };
    let what = "The invading phase fills the closed box up to the meniscus of largest curvature, which rests there.";
    let mut text = beginning(subdomain, fluids, named, "entry pressure", what);
    text += &phase("wetting", wetting);
    text += &phase("non-wetting", other);
    let _ = write!(
        text,
        "[sph.interface]\ntension = {tension:e} # N/m\n\n{}[sph.initial]\nbackground = \"{background}\"\n\
         wetting = [{}] # the invading phase, in m: its arc is that of the meniscus\n\n[sph.measure.throat-entry]\n\n\
         [time]\nend = {end:e} # s\n\n[time.steady]\ncapillary-number = 3.0e-4\n\n[output.vtk]\nevery-time = {end:e} # s\n\n\
         [[expect]] # the formula\nmeasure = \"entry-pressure-Pa\"\nvalue = {pressure:e}\ntolerance = {:e}\n",
        fluids.wetting(subdomain.angle),
        shape(ShapeSpec::CurvedPolygon(subdomain.behind.clone())),
        (EXPECTED * pressure).abs()
    );
    text
}

/// The case of the conductance: one phase flows at a given rate through the box, which is periodic along the throat.
pub(crate) fn flow(subdomain: &Subdomain, fluids: &Fluids, named: &Named) -> String {
    let fluid = fluids.of(subdomain.width)[0];
    let height = subdomain.geometry.max[1] - subdomain.geometry.min[1];
    let end = FLOW_TIMES * fluid.density * height * height / fluid.viscosity;
    let what = "One phase passes the throat at a given rate; the box is periodic along the throat.";
    let mut text = beginning(subdomain, fluids, named, "conductance", what);
    text += &phase("wetting", fluid);
    let _ = write!(
        text,
        "[sph.sides]\nleft = \"periodic\"\nright = \"periodic\"\n\n[sph.sides.open.left]\nflow-rate = {:e} # {}, Reynolds number {REYNOLDS}\n\n\
         [time]\nend = {end:e} # s\n\n[output.vtk]\nevery-time = {end:e} # s\n",
        fluids.thickness() * flow_rate(fluid),
        if fluids.chip.is_some() { "m3/s" } else { "m2/s" }
    );
    text
}

/// The flow rate in m²/s of the conductance.
pub(crate) fn flow_rate(fluid: Fluid) -> f64 {
    REYNOLDS * fluid.viscosity / fluid.density
}
