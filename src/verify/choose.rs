//! The selection of throats to verify.

use std::str::FromStr;

use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::{Rng, SeedableRng};

use super::subject::Subject;
use meniscus_core::math::Vec2;
use meniscus_geometry::curve::Curve;
use meniscus_geometry::interface::menisci::{Meniscus, Passage};

/// Relative difference below which pressures are close to each other.
const CLOSE: f64 = 0.05;
/// Points along a curve at which its distance is evaluated.
const POINTS: usize = 33;

/// A criterion for throats.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Choice {
    /// Those that burst within 5 % of the pressure at breakthrough, the one that determines it first.
    Critical,
    /// Those whose formula is least certain.
    Unsure,
    /// This number at random.
    Random(usize),
    /// Those with these numbers.
    Numbers(Vec<usize>),
}

impl FromStr for Choice {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let wanted = || {
            format!(
                "expected critical, unsure, random:N, or numbers of throats.csv with commas between them, found `{text}`"
            )
        };
        match text {
            "critical" => Ok(Self::Critical),
            "unsure" => Ok(Self::Unsure),
            _ => match text.strip_prefix("random:") {
                Some(count) => count.parse().map(Self::Random).map_err(|_| wanted()),
                None => {
                    let numbers = text.split(',').map(|number| number.trim().parse());
                    numbers.collect::<Result<_, _>>().map(Self::Numbers).map_err(|_| wanted())
                }
            },
        }
    }
}

/// A throat that is verified.
#[derive(Debug, Clone, PartialEq)]
pub struct Chosen {
    /// Its number in `throats.csv`.
    pub number: usize,
    /// Its index in the network.
    pub throat: usize,
    /// The region that the meniscus enters, 0 or 1.
    pub to: usize,
    /// Why it was selected.
    pub reason: String,
}

/// A criterion that the network cannot meet.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub enum ChoiceError {
    /// No displacement that breaks through.
    #[error(
        "`critical` selects throats near the pressure at breakthrough, and there is none: the network needs an inlet and an outlet that is reached; take unsure, random:N or numbers"
    )]
    NoBreakthrough,
    /// A number that no throat has.
    #[error("there is no throat {number}; the numbers of throats.csv run from 0 to {last}")]
    NoThroat {
        /// The number.
        number: usize,
        /// The largest valid number.
        last: usize,
    },
    /// No throats at all.
    #[error("the network has no throats")]
    NoThroats,
}

/// The throats of all criteria, each once, in the order of the criteria.
pub fn choose(subject: &Subject, choices: &[Choice], seed: u64) -> Result<Vec<Chosen>, ChoiceError> {
    if subject.kept().is_empty() {
        return Err(ChoiceError::NoThroats);
    }
    let mut all: Vec<Chosen> = Vec::new();
    for choice in choices {
        let found = match choice {
            Choice::Critical => critical(subject)?,
            Choice::Unsure => unsure(subject),
            Choice::Random(count) => random(subject, *count, seed),
            Choice::Numbers(numbers) => {
                let last = subject.kept().len() - 1;
                if let Some(&number) = numbers.iter().find(|&&number| number > last) {
                    return Err(ChoiceError::NoThroat { number, last });
                }
                numbers.iter().map(|&number| chosen(subject, number, "by number")).collect()
            }
        };
        for one in found {
            if all.iter().all(|other| other.number != one.number) {
                all.push(one);
            }
        }
    }
    Ok(all)
}

fn chosen(subject: &Subject, number: usize, reason: &str) -> Chosen {
    let throat = subject.kept()[number];
    let to = subject.entry(throat).map_or(1, |(to, _)| to);
    Chosen { number, throat, to, reason: reason.to_owned() }
}

fn critical(subject: &Subject) -> Result<Vec<Chosen>, ChoiceError> {
    let (history, applied) = subject.to_breakthrough.as_ref().ok_or(ChoiceError::NoBreakthrough)?;
    // The first event at the pressure of breakthrough.
    let bottleneck = history.iter().find(|entry| entry.applied.abs() >= applied.abs() && entry.throat.is_some());
    let bottleneck = bottleneck.and_then(|entry| entry.throat);
    let mut near: Vec<(f64, usize)> = Vec::new();
    for (number, &throat) in subject.kept().iter().enumerate() {
        let Some((_, entry)) = subject.entry(throat) else { continue };
        let away = (entry / applied - 1.0).abs();
        if bottleneck == Some(throat) {
            near.push((-1.0, number));
        } else if away <= CLOSE {
            near.push((away, number));
        }
    }
    near.sort_by(|a, b| a.0.total_cmp(&b.0));
    let with_reason = |(away, number): (f64, usize)| {
        let reason = if away < 0.0 {
            "critical: sets the pressure at breakthrough".to_owned()
        } else {
            format!("critical: {:.1} % from the pressure at breakthrough", 100.0 * away)
        };
        chosen(subject, number, &reason)
    };
    Ok(near.into_iter().map(with_reason).collect())
}

fn unsure(subject: &Subject) -> Vec<Chosen> {
    let mut found = Vec::new();
    for (number, &throat) in subject.kept().iter().enumerate() {
        let mut one = chosen(subject, number, "");
        let Some((passage, ahead)) = subject.passage(throat, one.to) else { continue };
        let Some(meniscus) = passage.burst() else { continue };
        let width = subject.throat(throat).width;
        let mut reasons = Vec::new();
        if passage.touch(&ahead, meniscus.curvature).is_some_and(|k| k >= (1.0 - CLOSE) * meniscus.curvature) {
            reasons.push("touches a wall within 5 % of its burst");
        }
        if has_vertex(&passage, &meniscus, width) {
            reasons.push("an edge within one width of a contact");
        }
        if distance(&meniscus.curve(), &ahead) < width {
            reasons.push("a third wall within one width of the meniscus");
        }
        if subject.overlapped.contains(&throat) {
            reasons.push("passed by an overlap");
        }
        if !reasons.is_empty() {
            one.reason = format!("unsure: {}", reasons.join(", "));
            found.push(one);
        }
    }
    found
}

/// Whether a wall has a sharp edge within one width of a contact.
fn has_vertex(passage: &Passage, meniscus: &Meniscus, width: f64) -> bool {
    /// Turning angle in rad below which a wall is smooth.
    const SMOOTH: f64 = 1e-6;
    let contacts = [meniscus.left.point, meniscus.right.point];
    [passage.left(), passage.right()].into_iter().zip(contacts).any(|(wall, contact)| {
        let ends: Vec<[(Vec2, Vec2); 2]> =
            wall.parts.iter().map(|part| [0.0, 1.0].map(|u| (part.curve.point(u), part.curve.tangent(u)))).collect();
        ends.windows(2).any(|pair| {
            // The pieces of the right wall are in the reverse order of its curves.
            let joints = [(pair[0][1], pair[1][0]), (pair[1][1], pair[0][0])];
            let joint = joints.into_iter().min_by(|a, b| {
                let gap = |joint: &((Vec2, Vec2), (Vec2, Vec2))| (joint.0.0 - joint.1.0).norm();
                gap(a).total_cmp(&gap(b))
            });
            joint.is_some_and(|(one, other)| {
                let turn = one.1.perp(&other.1).atan2(one.1.dot(&other.1)).abs();
                turn > SMOOTH && (one.0 - contact).norm() < width
            })
        })
    })
}

/// Smallest distance in m from an arc to other walls.
fn distance(arc: &Curve, walls: &[Curve]) -> f64 {
    let points = (0..POINTS).map(|k| arc.point(k as f64 / (POINTS - 1) as f64));
    let to_walls =
        |point: Vec2| walls.iter().map(|wall| (wall.project(point).point - point).norm()).fold(f64::INFINITY, f64::min);
    points.map(to_walls).fold(f64::INFINITY, f64::min)
}

/// Throats at random, each at most once.
fn random(subject: &Subject, count: usize, seed: u64) -> Vec<Chosen> {
    let mut left: Vec<usize> = (0..subject.kept().len()).collect();
    let mut bytes = [0; 32];
    bytes[..8].copy_from_slice(&seed.to_le_bytes());
    let mut generator = ChaCha8Rng::from_seed(bytes);
    let mut found = Vec::new();
    while found.len() < count && !left.is_empty() {
        let number = left.swap_remove((generator.next_u64() % left.len() as u64) as usize);
        found.push(chosen(subject, number, "random"));
    }
    found
}

/// The curvature in 1/m at which a meniscus touches another wall before its burst, if it does.
pub(crate) fn touches_first(passage: &Passage, ahead: &[Curve]) -> Option<f64> {
    let burst = passage.burst()?.curvature;
    passage.touch(ahead, burst).filter(|k| *k < burst)
}
