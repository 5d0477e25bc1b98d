//! A displacement as data to play: what each area of a drawing holds after every event.

use crate::diagram::{Frame, Through};
use crate::table::Table;

/// A piece of the boundary of an area: from its start to that of the next piece.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Edge {
    /// Its start in m.
    pub start: [f64; 2],
    /// Signed angle of a circular arc in rad, counter-clockwise above 0, at most π in magnitude; 0 for a segment.
    pub sweep: f64,
    /// Whether it is a wall.
    pub is_wall: bool,
}

/// A part of the pore space that is filled at once.
#[derive(Debug, Clone, PartialEq)]
pub struct PlayedArea {
    /// Its closed boundary.
    pub boundary: Vec<Edge>,
    /// Its area in m².
    pub area: f64,
    /// Index of its pore.
    pub pore: usize,
}

/// A straight passage between two areas.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Passage {
    /// The indices of both areas.
    pub areas: [usize; 2],
    /// Both ends in m.
    pub ends: [[f64; 2]; 2],
    /// Index of the throat, if it is one.
    pub throat: Option<usize>,
}

/// What an area holds.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Holding {
    /// The displaced phase.
    Defending,
    /// The displaced phase without a path to the outlet.
    Trapped,
    /// The invading phase since before this half cycle.
    Before,
    /// The invading phase, which came with this event.
    Invaded,
}

/// From an event on, an area holds something else.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Change {
    /// Row of the event.
    pub row: u32,
    /// Index of the area.
    pub area: u32,
    /// What it holds.
    pub holding: Holding,
}

/// One drainage or imbibition. At its first row each area without a change there holds the displaced phase.
#[derive(Debug, Clone, PartialEq)]
pub struct Stage {
    /// Its name.
    pub name: String,
    /// Its first row.
    pub first: usize,
    /// Whether the wetting phase invades.
    pub wetting_invades: bool,
    /// Direction of flow through the left, right, bottom and top side.
    pub open: [Option<Through>; 4],
    /// The row after which the invading phase is at the outlet, if it gets there.
    pub breakthrough: Option<usize>,
}

/// From a row on, films of an area keep the thickness at a capillary pressure, or follow it again.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct KeptFilm {
    /// Row of the event.
    pub row: u32,
    /// Index of the area.
    pub area: u32,
    /// Number of the films in the area.
    pub part: u32,
    /// (p_n - p_w)/σ in 1/m; NaN if they follow the applied one.
    pub curvature: f64,
}

/// The corner films along the walls of areas of the non-wetting phase. Seen from above they are r times a width wide, with r = 1/(κ + head), κ = (p_n - p_w)/σ.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct PlayedFilms {
    /// By edge of all areas in order: the width over r, 0 where there is none.
    pub widths: Vec<f64>,
    /// By edge: the number of the films in the area.
    pub parts: Vec<usize>,
    /// By area: the largest r in m.
    pub largest: Vec<f64>,
    /// By area: what gravity adds to κ in 1/m.
    pub heads: Vec<f64>,
    /// By row: the applied κ in 1/m.
    pub curvatures: Vec<f64>,
    /// Films that do not follow it, in the order of rows.
    pub kept: Vec<KeptFilm>,
}

/// A displacement in a network.
#[derive(Debug, Clone, PartialEq)]
pub struct Playback {
    /// The domain.
    pub frame: Frame,
    /// The areas; they tile the pore space.
    pub areas: Vec<PlayedArea>,
    /// The passages between areas.
    pub passages: Vec<Passage>,
    /// Pores, with a row each.
    pub pores: Table,
    /// Throats, with a row each.
    pub throats: Table,
    /// The events in order, with a row each and a row at the beginning of each stage.
    pub events: Table,
    /// The curve, if it has more points than events.
    pub curve: Option<Table>,
    /// Half cycles.
    pub stages: Vec<Stage>,
    /// What happened, in the order of rows.
    pub changes: Vec<Change>,
    /// Corner films, if there are any.
    pub films: Option<PlayedFilms>,
    /// What the numbers are of: per meter of depth in the plane, or of a chip of a depth in m.
    pub depth: Option<f64>,
}
