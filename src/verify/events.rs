//! The selection of touches and overlaps of the first displacement to verify.

use std::str::FromStr;

use super::choose::drawn;
use super::subdomain::Impossible;
use super::subject::Subject;
use super::whole_pore::WholePore;
use crate::network::displacement::{Event, EventKind};

/// A criterion for events.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum EventChoice {
    /// The one that determines the pressure at breakthrough.
    Critical,
    /// This number of a kind at random.
    Random(EventKind, usize),
    /// Those with these numbers.
    Numbers(Vec<usize>),
}

impl FromStr for EventChoice {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let wanted = || {
            format!(
                "expected critical, touch:N, overlap:N, or numbers of the first half cycle in events.csv with commas between them, found `{text}`"
            )
        };
        let count = |count: &str, kind| count.parse().map(|count| Self::Random(kind, count)).map_err(|_| wanted());
        match text.split_once(':') {
            _ if text == "critical" => Ok(Self::Critical),
            Some(("touch", number)) => count(number, EventKind::Touch),
            Some(("overlap", number)) => count(number, EventKind::Overlap),
            _ => {
                let numbers = text.split(',').map(|number| number.trim().parse());
                numbers.collect::<Result<_, _>>().map(Self::Numbers).map_err(|_| wanted())
            }
        }
    }
}

/// A criterion that the displacement cannot meet.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub enum EventError {
    /// Nothing is displaced.
    #[error("the network displaces nothing, so that it has no events; it needs an inlet")]
    NoEvents,
    /// No displacement that breaks through.
    #[error(
        "`critical` is the event that sets the pressure at breakthrough, and there is none; take touch:N, overlap:N or numbers"
    )]
    NoBreakthrough,
    /// A number that no event has.
    #[error("there is no event {number}; those of the first half cycle in events.csv run from 1 to {last}")]
    NoEvent {
        /// The number.
        number: usize,
        /// The largest valid number.
        last: usize,
    },
}

/// An event to verify, with its subdomain.
#[derive(Debug)]
pub struct PlannedEvent {
    /// Its number in `events.csv`, from 1 on.
    pub number: usize,
    /// Kind of the event.
    pub kind: EventKind,
    /// Number in `throats.csv` of the throat that was passed.
    pub throat: Option<usize>,
    /// Curvature of the meniscus in 1/m by the formula.
    pub curvature: f64,
    /// Why it was selected.
    pub reason: String,
    /// The subdomain.
    pub subdomain: Result<WholePore, Impossible>,
}

/// The events of all criteria, each once, in the order of the criteria.
pub fn choose_events(subject: &Subject, choices: &[EventChoice], seed: u64) -> Result<Vec<PlannedEvent>, EventError> {
    let last = subject.events.len();
    if last == 0 && !choices.is_empty() {
        return Err(EventError::NoEvents);
    }
    let mut all: Vec<PlannedEvent> = Vec::new();
    for choice in choices {
        let (numbers, reason) = match choice {
            EventChoice::Critical => (vec![critical(subject)?], "critical: sets the pressure at breakthrough"),
            EventChoice::Random(kind, count) => (random(subject, *kind, *count, seed), "random"),
            EventChoice::Numbers(numbers) => (numbers.clone(), "by number"),
        };
        for number in numbers {
            let event = number.checked_sub(1).and_then(|index| subject.events.get(index));
            let event = event.ok_or(EventError::NoEvent { number, last })?;
            if all.iter().all(|other| other.number != number) {
                all.push(PlannedEvent::new(subject, event, number, reason));
            }
        }
    }
    Ok(all)
}

impl PlannedEvent {
    fn new(subject: &Subject, event: &Event, number: usize, reason: &str) -> Self {
        let subdomain = WholePore::new(
            event.kind,
            &subject.scene(event),
            event.curvature,
            subject.filled_area(event),
            &subject.conditions.angle,
        )
        .and_then(|subdomain| match subject.has_network_films(subdomain.angle) {
            true => Ok(subdomain),
            false => Err(Impossible::Films),
        });
        Self {
            number,
            kind: event.kind,
            throat: event.throat.and_then(|throat| subject.kept().iter().position(|&kept| kept == throat)),
            curvature: event.curvature,
            reason: reason.to_owned(),
            subdomain,
        }
    }
}

/// The first event at the pressure of breakthrough.
fn critical(subject: &Subject) -> Result<usize, EventError> {
    let applied = subject.to_breakthrough.as_ref().map(|(history, _)| history.len());
    let reached = applied.and_then(|count| subject.events.get(..count)).and_then(|events| events.last());
    let applied = reached.ok_or(EventError::NoBreakthrough)?.applied;
    let first = subject.events.iter().position(|event| event.applied >= applied);
    first.map(|index| index + 1).ok_or(EventError::NoBreakthrough)
}

/// Events of a kind at random, each at most once.
fn random(subject: &Subject, kind: EventKind, count: usize, seed: u64) -> Vec<usize> {
    let of_kind = subject.events.iter().enumerate().filter(|(_, event)| event.kind == kind);
    drawn(of_kind.map(|(index, _)| index + 1).collect(), count, seed)
}
