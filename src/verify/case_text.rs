//! The cases of a subdomain, as files that a user can open and change.

use std::fmt::Write;

use super::fluids::Fluids;
use super::subdomain::Subdomain;
use crate::case::Fluid;
use crate::geometry::spec::{CurvedPolygon, GeometrySpec, ShapeSpec};
use crate::network::cycles::FluidPhase as Phase;

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

fn head(named: &Named, subdomain: &Subdomain, what: &str, title: &str) -> String {
    let (middle, width) = (subdomain.frame.middle, subdomain.width);
    format!(
        "# {what}\n# Throat {} of {}, {width:.4e} m wide at ({:.4e}, {:.4e}) m; x is the flow direction of the invading phase, {:.2} degrees \
         counter-clockwise from that of the network.\nformat = 1\ntitle = \"{title}\"\n\n",
        named.number,
        named.network,
        middle.x,
        middle.y,
        subdomain.frame.angle.to_degrees()
    )
}

fn polygon(polygon: &CurvedPolygon) -> String {
    let vertices: String =
        polygon.outer.iter().map(|[x, y, bulge]| format!("    [{x:e}, {y:e}, {bulge:e}],\n")).collect();
    format!("outer = [\n{vertices}]")
}

fn shapes(geometry: &GeometrySpec, fluids: &Fluids) -> String {
    let corner = |x: [f64; 2]| format!("[{:e}, {:e}] # m", x[0], x[1]);
    let mut text = format!("[geometry]\nmin = {}\nmax = {}\n", corner(geometry.min), corner(geometry.max));
    if let Some(chip) = fluids.chip {
        // Writing to a string cannot fail.
        let _ = writeln!(text, "depth = {:e} # m", chip.depth.distance());
    }
    for shape in &geometry.shapes {
        // Writing to a string cannot fail; a subdomain has no other shapes.
        let _ = match shape {
            ShapeSpec::Disc(disc) => writeln!(
                text,
                "\n[[geometry.shapes]]\ndisc = {{ center = [{:e}, {:e}], radius = {:e} }} # m",
                disc.center[0], disc.center[1], disc.radius
            ),
            ShapeSpec::HalfPlane(plane) => writeln!(
                text,
                "\n[[geometry.shapes]]\nhalf-plane = {{ point = [{:e}, {:e}], rotation-deg = {:e} }} # m",
                plane.point[0], plane.point[1], plane.rotation_deg
            ),
            ShapeSpec::CurvedPolygon(shape) => {
                writeln!(
                    text,
                    "\n[[geometry.shapes]]\n[geometry.shapes.curved-polygon] # x and y in m, bulge\n{}",
                    polygon(shape)
                )
            }
            _ => Ok(()),
        };
    }
    text
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
    let size = crate::math::Vec2::from(subdomain.geometry.max) - crate::math::Vec2::from(subdomain.geometry.min);
    let length = size.min().max(width);
    let end = (CAPILLARY_TIMES * (density * length.powi(3) / tension).sqrt())
        .max(VISCOUS_TIMES * density * width * width / viscosity)
        .max(FRICTION_TIMES * fluids.friction_time(length, width));
    let pressure = fluids.invading.towards_wetting(fluids.pressure(subdomain.meniscus.curvature));
    let background = if fluids.invading == Phase::NonWetting { "wetting" } else { "non-wetting" };
    let title = format!("Throat {}: entry pressure, {} spacings across", named.number, named.across);
    let what = "The invading phase fills the closed box up to the meniscus of largest curvature, which rests there.";
    let mut text = head(named, subdomain, what, &title);
    text += &shapes(&subdomain.geometry, fluids);
    let _ = write!(text, "\n[sph]\nspacing = {:e} # m\n\n", width / f64::from(named.across));
    text += &phase("wetting", wetting);
    text += &phase("non-wetting", other);
    let _ = write!(
        text,
        "[sph.interface]\ntension = {tension:e} # N/m\n\n{}[sph.initial]\nbackground = \"{background}\"\n\n[[sph.initial.wetting]] # the invading phase: its arc is that of the meniscus\n\
         [sph.initial.wetting.curved-polygon] # x and y in m, bulge\n{}\n\n[sph.measure.throat-entry]\n\n\
         [time]\nend = {end:e} # s\n\n[time.steady]\ncapillary-number = 3.0e-4\n\n[output.vtk]\nevery-time = {end:e} # s\n\n\
         [[expect]] # the formula\nmeasure = \"entry-pressure-Pa\"\nvalue = {pressure:e}\ntolerance = {:e}\n",
        fluids.wetting(subdomain.angle),
        polygon(&subdomain.behind),
        (EXPECTED * pressure).abs()
    );
    text
}

/// The case of the conductance: one phase flows at a given rate through the box, which is periodic along the throat.
pub(crate) fn flow(subdomain: &Subdomain, fluids: &Fluids, named: &Named) -> String {
    let width = subdomain.width;
    let fluid = fluids.of(width)[0];
    let height = subdomain.geometry.max[1] - subdomain.geometry.min[1];
    let end = FLOW_TIMES * fluid.density * height * height / fluid.viscosity;
    let title = format!("Throat {}: conductance, {} spacings across", named.number, named.across);
    let what = "One phase passes the throat at a given rate; the box is periodic along the throat.";
    let mut text = head(named, subdomain, what, &title);
    text += &shapes(&subdomain.geometry, fluids);
    let _ = write!(text, "\n[sph]\nspacing = {:e} # m\n\n", width / f64::from(named.across));
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
