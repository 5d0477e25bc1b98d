//! The cases of a subdomain, as files that a user can open and change.

use std::fmt::Write;

use super::fluids::Fluids;
use super::subdomain::Subdomain;
use super::whole_pore::WholePore;
use crate::case::Fluid;
use crate::geometry::spec::{CurvedPolygon, GeometrySpec, ShapeSpec};
use crate::network::cycles::FluidPhase as Phase;
use crate::network::displacement::EventKind;

/// Reynolds number ρQ/μ of the flow with which conductances are measured.
const REYNOLDS: f64 = 0.01;
/// Latest end of a run with a meniscus, in units of √(density · length³/tension) or density · length²/viscosity, whichever is longer.
const CAPILLARY_TIMES: f64 = 12.0;
/// The same in viscous times of the throat; an oscillation decays in one.
const VISCOUS_TIMES: f64 = 6.0;
/// End of a single-phase run in units of density · height²/viscosity; the slowest mode between plates decays in a tenth of it.
const FLOW_TIMES: f64 = 1.0;
/// Height of the pressure steps up to an overlap over tension/width, per spacing over width.
const RISE_PER_SPACING: f64 = 0.16;
/// Number of steps below the overlap, and of those above it.
const OVERLAP_STEPS: f64 = 5.0;
/// Duration of such a step in units of √(density · length³/tension) of the box or viscous times of the throat, whichever is longer.
const OVERLAP_TIMES: f64 = 3.0;
/// Height of the steps up to a touch over tension/width: fewer and longer steps, as the defending phase between meniscus and wall drains slowly.
const TOUCH_RISE: f64 = 0.02;
/// As of an overlap.
const TOUCH_STEPS: f64 = 2.0;
/// As of an overlap.
const TOUCH_TIMES: f64 = 9.0;
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

/// Inlet pressures of a whole pore, rising in steps.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Steps {
    /// Curvature in 1/m of the menisci at the first step.
    pub(crate) first: f64,
    /// Height of a step in 1/m.
    pub(crate) rise: f64,
    /// Number of steps.
    pub(crate) count: f64,
    /// Duration of each step in capillary or viscous times.
    pub(crate) times: f64,
}

impl Steps {
    /// Steps at a spacing (m) from below to above an event, which lies midway between two of them; `None` if the branch before the event is
    /// shorter than one step.
    pub(crate) fn of(subdomain: &WholePore, spacing: f64) -> Option<Self> {
        let scale = 1.0 / subdomain.width;
        let (rise, steps, times) = match subdomain.kind {
            EventKind::Touch => (TOUCH_RISE * scale, TOUCH_STEPS, TOUCH_TIMES),
            _ => (RISE_PER_SPACING * scale * scale * spacing, OVERLAP_STEPS, OVERLAP_TIMES),
        };
        let below = ((subdomain.curvature - subdomain.lowest) / rise + 0.5).floor().min(steps);
        let first = subdomain.curvature + (0.5 - below) * rise;
        (below >= 1.0).then_some(Self { first, rise, count: below + steps, times })
    }
}

/// The case of a touch or an overlap: the pressure of the invading phase rises in steps until the menisci jump. `None` if there are no menisci below the event.
pub(crate) fn pore(subdomain: &WholePore, fluids: &Fluids, named: &Named) -> Option<String> {
    let (width, tension, frame) = (subdomain.width, fluids.tension, &subdomain.frame);
    let spacing = subdomain.narrowest / f64::from(named.across);
    let steps = Steps::of(subdomain, spacing)?;
    let behind = subdomain.invading_shape(steps.first)?;
    let [wetting, other] = fluids.of(width);
    let (density, viscosity) = (wetting.density.max(other.density), wetting.viscosity.max(other.viscosity));
    let size = crate::math::Vec2::from(subdomain.geometry.max) - crate::math::Vec2::from(subdomain.geometry.min);
    let capillary = (density * size.min().powi(3) / tension).sqrt();
    let friction = fluids.friction_time(size.min(), width);
    let hold = steps.times * capillary.max(density * width * width / viscosity).max(friction);
    let (first, rise) = fluids.steps(subdomain.curvature, steps.first, steps.rise);
    let background = fluids.invading.other().name();
    let (what, kind) = match subdomain.kind {
        EventKind::Overlap => ("Two menisci meet on the wall between them", "overlap"),
        _ => ("A meniscus touches a third wall", "touch"),
    };
    let mut text = format!(
        "# {what}: the pressure of the invading phase rises in steps from below the event to above it.\n# Event {} of {}, at ({:.4e}, {:.4e}) m; x is \
         the flow direction of the invading phase, {:.2} degrees counter-clockwise from that of the network.\n# The formula: {:.4} Pa.\nformat = 1\n\
         title = \"Event {}: {kind}, {} spacings across\"\n\n",
        named.number,
        named.network,
        frame.middle.x,
        frame.middle.y,
        frame.angle.to_degrees(),
        fluids.pressure(subdomain.curvature),
        named.number,
        named.across
    );
    text += &shapes(&subdomain.geometry, fluids);
    let _ = write!(text, "\n[sph]\nspacing = {spacing:e} # m\n\n");
    text += &phase("wetting", wetting);
    text += &phase("non-wetting", other);
    let _ = write!(
        text,
        "[sph.interface]\ntension = {tension:e} # N/m\n\n{}[sph.sides]\nleft = \"inlet\"\nright = \"outlet\" # at 0 Pa\n\n[sph.sides.open.left]\npressure = {:e} # Pa\n\
         pressure-steps = {{ rise = {:e}, every-time = {hold:e} }} # Pa, s\n\n\
         [sph.initial]\nbackground = \"{background}\"\n\n[[sph.initial.wetting]] # the invading phase: its arcs are those of the menisci\n\
         [sph.initial.wetting.curved-polygon] # x and y in m, bulge\n{}\n\n\
         [time]\nend = {:e} # s\n\n[output.vtk]\nevery-time = {hold:e} # s\n",
        fluids.wetting(subdomain.angle),
        first,
        rise,
        polygon(&behind),
        hold * steps.count
    );
    Some(text)
}
