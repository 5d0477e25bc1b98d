//! The displacement in a network: the invading phase, the events, the initial state and the end.

use super::dynamic::{DynamicDrive, drive};
use super::state::Start;
use super::table::{Events, FilmModel, RawNetwork, RawProcess};
use crate::side::Sides;
use meniscus_core::input::{Checker, Problem};

/// A displacement.
#[derive(Debug, Clone, PartialEq, serde::Serialize)]
pub struct NetworkDisplacement {
    /// The half cycles in their order.
    pub process: Process,
    /// What is trapped.
    pub trapping: Trapping,
    /// How films of the wetting phase in the corners of a chip are connected; `None`: there are none.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub films: Option<FilmModel>,
    /// Which events move menisci.
    pub events: Events,
    /// Criteria for an early end.
    pub stop: Stop,
    /// Its initial state; `None`: the pore space is full of the defending phase.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub initial: Option<Start>,
    /// What drives it in time; `None` if it is quasi-static.
    pub dynamic: Option<DynamicDrive>,
}

impl NetworkDisplacement {
    /// Whether there are films in corners.
    pub fn has_films(&self) -> bool {
        self.films.is_some_and(|films| films != FilmModel::None)
    }
}

/// Which parts of the defending phase are trapped.
#[derive(Debug, Clone, Copy, PartialEq, Eq, serde::Serialize)]
#[serde(into = "bool")]
pub enum Trapping {
    /// Parts without a path to an outlet; the invading phase advances from parts connected to an inlet.
    Disconnected,
    /// None: films drain all.
    None,
}

impl From<bool> for Trapping {
    fn from(is_trapped: bool) -> Self {
        if is_trapped { Self::Disconnected } else { Self::None }
    }
}

impl From<Trapping> for bool {
    fn from(rule: Trapping) -> Self {
        rule == Trapping::Disconnected
    }
}

/// The invading phase.
#[derive(Debug, Clone, Copy, PartialEq, Eq, serde::Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Process {
    /// The non-wetting phase.
    Drainage,
    /// The wetting phase.
    Imbibition,
    /// Both in turn, for this number of cycles, drainage first.
    Cycle(u32),
}

impl Process {
    /// Number of half cycles.
    pub(crate) fn half_cycles(self) -> u32 {
        match self {
            Self::Drainage | Self::Imbibition => 1,
            Self::Cycle(cycles) => 2 * cycles,
        }
    }
}

/// Criteria for an early end of a displacement, or of each drainage of a cycle.
#[derive(Debug, Clone, Copy, PartialEq, Default, serde::Serialize)]
pub struct Stop {
    /// At breakthrough: when the invading phase reaches the outlet.
    pub breakthrough: bool,
    /// At this wetting saturation.
    pub saturation: Option<f64>,
    /// At this capillary pressure p_n - p_w in Pa; quasi-static only.
    pub capillary_pressure: Option<f64>,
    /// When this number of pore volumes has passed the inlet; in time only.
    pub injected: Option<f64>,
}

/// Checks the keys of `[network]` for the displacement.
pub(super) fn displacement(checker: &mut Checker, raw: &mut RawNetwork, initial: Option<Start>) -> NetworkDisplacement {
    let process = match *raw.process.get_or_insert(RawProcess::Drainage) {
        RawProcess::Drainage => Process::Drainage,
        RawProcess::Imbibition => Process::Imbibition,
        RawProcess::Cycle => Process::Cycle(raw.cycles.unwrap_or(1)),
    };
    if checker.is_given("network.cycles", raw.cycles.as_ref()) && !matches!(process, Process::Cycle(_)) {
        checker.refuse(
            "network.cycles",
            "only cycles are counted, and the process is not a cycle",
            "set process = \"cycle\", or leave this out",
        );
    }
    if matches!(process, Process::Cycle(_)) && raw.outlet.is_none() {
        checker.refuse(
            "network.process",
            "a cycle needs an outlet: the wetting phase returns through it",
            "add outlet = \"right\", say",
        );
    }
    if let Process::Cycle(cycles) = process {
        raw.cycles = Some(cycles);
    }
    let stop = stop(checker, raw);
    let dynamic = drive(checker, raw, matches!(process, Process::Cycle(_)));
    if raw.dynamic.is_none() {
        raw.trapping.get_or_insert(true);
    }
    raw.initial = initial.as_ref().map(|start: &Start| start.file.clone());
    NetworkDisplacement {
        process,
        trapping: raw.trapping.unwrap_or(true).into(),
        films: raw.films,
        events: *raw.events.get_or_insert(Events::All),
        stop,
        dynamic,
        initial,
    }
}

/// Refuses a state with other walls and periodic sides; open sides may change.
pub(super) fn refuse_other_sides(checker: &mut Checker, start: &Start, sides: &Sides) {
    if let Some((_, misfit)) = start.state.misfit_of_sides(sides) {
        let message = format!("{} was written for other sides: {misfit}", start.file.display());
        checker.refuse("network.initial", message, "give this case the sides of the state");
    }
}

fn stop(checker: &mut Checker, raw: &mut RawNetwork) -> Stop {
    let given = raw.stop.get_or_insert_default();
    if given.breakthrough == Some(true) && raw.outlet.is_none() {
        let help = "add outlet = \"right\", say, or leave this out";
        let problem = Problem::new("network.stop.breakthrough", "breakthrough needs an outlet", help);
        checker.problems.push(problem.caused_by("network.outlet"));
    }
    if checker.is_given("network.stop.injected", given.injected.as_ref()) && raw.dynamic.is_none() {
        checker.refuse(
            "network.stop.injected",
            "injected volumes need a displacement in time, and this one is quasi-static",
            "end at a saturation, or add [network.dynamic]",
        );
    }
    Stop {
        breakthrough: *given.breakthrough.get_or_insert_default(),
        saturation: given.saturation,
        capillary_pressure: given.capillary_pressure,
        injected: given.injected,
    }
}

/// Refuses keys of a displacement without an inlet.
pub(super) fn refuse_without_inlet(checker: &mut Checker, raw: &RawNetwork) {
    let given = [
        ("outlet", raw.outlet.is_some()),
        ("process", raw.process.is_some()),
        ("cycles", checker.is_given("network.cycles", raw.cycles.as_ref())),
        ("trapping", raw.trapping.is_some()),
        ("films", raw.films.is_some()),
        ("events", raw.events.is_some()),
        ("stop", raw.stop.is_some()),
        ("initial", raw.initial.is_some()),
        ("dynamic", raw.dynamic.is_some()),
        ("gravity", raw.gravity.is_some()),
    ];
    for (key, _) in given.into_iter().filter(|(_, given)| *given) {
        let message = format!("`{key}` belongs to a displacement, and there is no inlet");
        let help = "add inlet = \"left\", say; without an inlet the network is extracted and nothing is displaced";
        checker.problems.push(Problem::new(format!("network.{key}"), message, help).caused_by("network.inlet"));
    }
}
