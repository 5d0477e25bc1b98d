//! `[network]`: a pore network. The checks of its parts together, and the table of a checked network.

use super::displacement::{NetworkDisplacement, displacement, refuse_other_sides, refuse_without_inlet};
use super::measured::Measured;
use super::region::{Region, region};
use super::state::Start;
use super::table::{InletDisc, NetworkResults, RawNetwork, RawNetworkSide, RawNetworkSides, RawOutlet, RawRegion};
use crate::fluid::{Fluid, RawPhases, fluid, tension};
use crate::side::{SIDES, Side, SideName, Sides};
use crate::wetting::{self, WettingPatch};
use meniscus_core::input::Checker;
use meniscus_core::input::tables::Key;
use meniscus_geometry::spec::GeometrySpec;
use meniscus_wetting::Wetting;

/// A pore network and the displacement in it.
#[derive(Debug, Clone, PartialEq, serde::Serialize)]
pub struct PoreNetwork {
    /// The four sides: walls, periodic sides, the inlet and the outlet.
    pub sides: Sides,
    /// The wetting phase, if given.
    pub wetting: Option<Fluid>,
    /// The non-wetting phase, if given.
    pub non_wetting: Option<Fluid>,
    /// Interface and walls; `None`: no entry pressures.
    pub interface: Option<NetworkInterface>,
    /// Persistence ratio above which two maxima of the wall distance are one pore.
    pub persistence: f64,
    /// Measured entry pressures, which replace those of the formula.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub measured: Option<Measured>,
    /// The displacement; `None` without an inlet.
    pub displacement: Option<NetworkDisplacement>,
    /// The disc that is the inlet in place of a side.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub inlet_disc: Option<InletDisc>,
    /// Acceleration of gravity along x and y in m/s²; `None` without gravity.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub gravity: Option<[f64; 2]>,
    /// Where saturations and the porosity are taken; `None`: in the whole domain.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub region: Option<Region>,
    /// What is found besides events, curve and measures of the displacement.
    pub results: NetworkResults,
}

impl PoreNetwork {
    /// Whether the displacement is in time, so that its clock is the time in s.
    pub fn is_dynamic(&self) -> bool {
        self.displacement.as_ref().is_some_and(|displacement| displacement.dynamic.is_some())
    }
}

/// The interface between two fluids and its contact angles on walls.
#[derive(Debug, Clone, PartialEq, serde::Serialize)]
pub struct NetworkInterface {
    /// Interfacial tension in N/m.
    pub tension: f64,
    /// Static angles through the wetting phase: Young, Tadmor or hysteresis.
    pub wetting_model: Wetting,
    /// Walls with their own angles, without stripes.
    pub patches: Vec<WettingPatch>,
}

/// Default persistence ratio.
pub(crate) const DEFAULT_PERSISTENCE: f64 = 0.95;

/// Checks `[network]` and sets its defaults; `geometry` is missing if it was wrong.
pub(crate) fn network(
    checker: &mut Checker,
    raw: &mut RawNetwork,
    geometry: Option<&GeometrySpec>,
    start: Option<Start>,
) -> Option<PoreNetwork> {
    let sides = sides(checker, raw);
    let none = &mut RawPhases::default();
    let matters = raw.has_inlet() || raw.interface.is_some() || raw.wetting.is_some();
    let phases = raw.phases.as_mut().unwrap_or(none);
    let given = raw.interface.as_ref().and_then(|interface| interface.tension);
    if matters && let Some(tension) = tension(checker, "network.interface", phases, given) {
        raw.interface.get_or_insert_default().tension = Some(tension);
    }
    let [wetting, non_wetting] =
        [("wetting", &mut phases.wetting), ("non-wetting", &mut phases.non_wetting)].map(|(name, raw)| match raw {
            Some(raw) => fluid(checker, &format!("network.phases.{name}"), raw).map(Some),
            None => Some(None),
        });
    let interface = interface(checker, raw, sides.as_ref(), geometry);
    if raw.dynamic.is_some() && raw.measured_throats.is_some() {
        checker.refuse(
            "network.measured",
            "a displacement in time uses the entry pressures of the formula, not measured ones",
            "leave it out, or leave out [network.dynamic]",
        );
    }
    let inlet_disc = inlet_disc(checker, raw, sides.as_ref(), geometry);
    let displacement = if raw.has_inlet() {
        if let (Some(start), Some(sides)) = (&start, &sides) {
            refuse_other_sides(checker, start, sides);
        }
        Some(displacement(checker, raw, start))
    } else {
        refuse_without_inlet(checker, raw);
        None
    };
    let gravity = gravity(checker, raw, sides.as_ref());
    let region = region(checker, raw, sides.as_ref(), geometry);
    if let Some(Region { min, max, .. }) = region.filter(|region| !region.is_pack) {
        raw.region = Some(RawRegion { min: Some(min), max: Some(max), extent: None });
    }
    if raw.dynamic.is_some() && displacement.as_ref().is_some_and(|displacement| displacement.dynamic.is_none()) {
        return None;
    }
    Some(PoreNetwork {
        sides: sides?,
        wetting: wetting?,
        non_wetting: non_wetting?,
        interface: interface?,
        persistence: *raw.persistence.get_or_insert(DEFAULT_PERSISTENCE),
        measured: raw.measured_throats.clone(),
        displacement,
        inlet_disc: inlet_disc?,
        gravity,
        region,
        results: *raw.results.get_or_insert(NetworkResults::All),
    })
}

/// The disc that is the inlet, if one is given; the outer option is missing if a mistake was found.
fn inlet_disc(
    checker: &mut Checker,
    raw: &RawNetwork,
    sides: Option<&Sides>,
    geometry: Option<&GeometrySpec>,
) -> Option<Option<InletDisc>> {
    const KEY: &str = "network.inlet-disc";
    let Some(given) = raw.inlet_disc.clone() else { return Some(None) };
    if raw.inlet.is_some() {
        checker.refuse(KEY, "both a side and a disc are the inlet", "leave out `inlet` or `inlet-disc`");
    }
    if sides.is_some_and(|sides| sides.periodic().contains(&true)) {
        let message = "a disc is the inlet, and the domain is periodic: the phase would come from all sides at once";
        checker.refuse(KEY, message, "make all sides walls or outlets, or name a side as the inlet");
    }
    let center = checker.require(&format!("{KEY}.center"), given.center, "center = [0.0, 0.0] # m");
    let radius = checker.require(&format!("{KEY}.radius"), given.radius, "radius = 1.0e-3 # m");
    let (disc, geometry) = (InletDisc { center: center?, radius: radius? }, geometry?);
    let is_inside = |axis: usize| {
        let [low, high] = [disc.center[axis] - disc.radius, disc.center[axis] + disc.radius];
        low >= geometry.min[axis] && high <= geometry.max[axis]
    };
    if !(is_inside(0) && is_inside(1)) {
        let message = format!(
            "expected a disc inside of the domain from {:?} to {:?} m, found the center {:?} and the radius {:e} m",
            geometry.min, geometry.max, disc.center, disc.radius
        );
        checker.refuse(KEY, message, "move it, or make it smaller");
        return None;
    }
    Some(Some(disc))
}

/// Gravity, if it acts; it needs the densities of both phases, and sides that are not periodic along it.
fn gravity(checker: &mut Checker, raw: &RawNetwork, sides: Option<&Sides>) -> Option<[f64; 2]> {
    let gravity = raw.gravity.filter(|gravity| *gravity != [0.0; 2])?;
    let phases = raw.phases.clone().unwrap_or_default();
    for (name, is_given) in [("wetting", phases.wetting.is_some()), ("non-wetting", phases.non_wetting.is_some())] {
        // A displacement in time asks for them too.
        if !is_given && raw.dynamic.is_none() {
            checker.refuse(
                format!("network.phases.{name}"),
                format!("gravity acts by the difference of two densities, and that of the {name} phase is not given"),
                format!("add [network.phases.{name}] with preset = \"water\", say, or density and viscosity"),
            );
        }
    }
    let kinds = sides.map(Sides::each);
    let along = |axis: usize| gravity[axis] != 0.0 && kinds.is_some_and(|kinds| kinds[2 * axis] == Side::Periodic);
    if let Some(axis) = (0..2).find(|&axis| along(axis)) {
        let name = ["x", "y"][axis];
        checker.refuse(
            "network.gravity",
            format!("gravity acts along {name}, and the domain is periodic along {name}: a height without an end"),
            format!("make the sides {} and {} walls, or set this component to 0", SIDES[2 * axis], SIDES[2 * axis + 1]),
        );
        return None;
    }
    Some(gravity)
}

/// The kinds of all four sides; `None` if they are incompatible.
fn sides(checker: &mut Checker, raw: &mut RawNetwork) -> Option<Sides> {
    let before = checker.problems.len();
    let table = raw.sides.get_or_insert_default();
    let given = [table.left, table.right, table.bottom, table.top];
    let mut kinds = given.map(|side| match side {
        Some(RawNetworkSide::Periodic) => Side::Periodic,
        Some(RawNetworkSide::Wall) | None => Side::Wall,
    });
    let outlet = raw.outlet.and_then(RawOutlet::number);
    let open = [("inlet", raw.inlet.map(SideName::number), Side::Inlet), ("outlet", outlet, Side::Outlet)];
    for (key, side, kind) in open.into_iter().filter_map(|(key, side, kind)| Some((key, side?, kind))) {
        if given[side].is_some() {
            checker.refuse(
                format!("network.sides.{}", SIDES[side]),
                format!("the side `{}` is the {key}, and a kind of side is given for it too", SIDES[side]),
                format!("leave it out of [network.sides], or choose another {key}"),
            );
        }
        kinds[side] = kind;
    }
    if raw.outlet == Some(RawOutlet::Sides) {
        if raw.inlet.is_some() {
            let message = "the outlet is all sides, and the inlet is one of them";
            checker.refuse("network.outlet", message, "name the opposite side, or give inlet-disc in place of inlet");
        }
        let free: Vec<usize> = (0..4).filter(|&side| given[side].is_none()).collect();
        if free.is_empty() {
            let message = "the outlet is all sides without a kind, and [network.sides] gives each side one";
            checker.refuse("network.outlet", message, "leave a side out of [network.sides], or leave this out");
        }
        free.into_iter().for_each(|side| kinds[side] = Side::Outlet);
    }
    if let (Some(inlet), Some(outlet)) = (raw.inlet.map(SideName::number), outlet) {
        if inlet == outlet {
            let message = format!("`{}` is both inlet and outlet", SIDES[inlet]);
            checker.refuse("network.outlet", message, format!("take the opposite side, `{}`", SIDES[inlet ^ 1]));
        } else if inlet / 2 != outlet / 2 {
            checker.refuse(
                "network.outlet",
                format!("the inlet `{}` and the outlet `{}` meet in a corner", SIDES[inlet], SIDES[outlet]),
                format!("take the opposite side, `{}`", SIDES[inlet ^ 1]),
            );
        }
    }
    for [a, b] in [[0, 1], [2, 3]] {
        for (one, other) in [(a, b), (b, a)] {
            if kinds[one] == Side::Periodic && kinds[other] != Side::Periodic {
                let found = match kinds[other] {
                    Side::Wall => "a wall",
                    Side::Inlet => "the inlet",
                    _ => "the outlet",
                };
                checker.refuse(
                    format!("network.sides.{}", SIDES[one]),
                    format!(
                        "the side `{}` is periodic and the opposite side `{}` is {found}",
                        SIDES[one], SIDES[other]
                    ),
                    "periodic sides come in pairs: make both periodic, or none",
                );
            }
        }
    }
    let closed = |number: usize| match kinds[number] {
        Side::Periodic => Some(RawNetworkSide::Periodic),
        Side::Wall => Some(RawNetworkSide::Wall),
        _ => None,
    };
    *table = RawNetworkSides { left: closed(0), right: closed(1), bottom: closed(2), top: closed(3) };
    let [left, right, bottom, top] = kinds;
    (checker.problems.len() == before).then_some(Sides { left, right, bottom, top })
}

/// Tension and angles: both, or neither without a displacement. The outer option is missing if a mistake was found.
fn interface(
    checker: &mut Checker,
    raw: &mut RawNetwork,
    sides: Option<&Sides>,
    geometry: Option<&GeometrySpec>,
) -> Option<Option<NetworkInterface>> {
    let tension = raw.interface.as_ref().and_then(|interface| interface.tension);
    if !raw.has_inlet() && raw.interface.is_none() && raw.wetting.is_none() {
        return Some(None);
    }
    // That of a direct simulation may be 0.
    let above = Key::positive("a tension in N/m").example("tension = 0.0276 # N/m");
    let tension = above.checked(checker, "network.interface", "tension", tension);
    if raw.wetting.is_none() {
        checker.require::<()>("network.wetting", None, "[network.wetting.young] with contact-angle-deg");
    }
    let model = wetting::model(checker, "network.wetting", raw.wetting.as_mut(), tension)?;
    let model = static_model(checker, model);
    let patches = match model {
        Some(model) => wetting::patches(checker, "network.wetting", raw.wetting.as_mut(), model, sides, geometry),
        None => Vec::new(),
    };
    for (index, patch) in raw.wetting.iter().flat_map(|raw| &raw.patches).flatten().enumerate() {
        if patch.stripes.is_some() {
            checker.refuse(
                format!("network.wetting.patches[{index}].stripes"),
                "menisci of a network lie between walls of one angle each, and stripes divide a wall",
                "give the patch a shape or a side; a striped wall can be written as several shapes side by side",
            );
        }
    }
    Some(Some(NetworkInterface { tension: tension?, wetting_model: model?, patches }))
}

/// The model, if it is one for lines at rest.
fn static_model(checker: &mut Checker, model: Wetting) -> Option<Wetting> {
    if !model.is_dynamic() {
        return Some(model);
    }
    let (name, angle) = (model.table().key, model.static_angle().to_degrees());
    checker.refuse(
        format!("network.wetting.{name}"),
        format!("`{name}` depends on the speed of contact lines, and a quasi-static displacement has none"),
        format!("take [network.wetting.young] with the static angle, contact-angle-deg = {angle:.1}"),
    );
    None
}
