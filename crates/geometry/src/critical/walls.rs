//! The walls of the pore space as chains of linked pieces, with periodic images.
//!
//! Each wall of the pore space is stored once, as a base piece; [`Shift`]s lead to its periodic images. At sides that are neither walls nor periodic the
//! walls may be cut: within the domain the distance to the cut walls equals that to walls that continue straight beyond such a side, since the nearest point
//! of such a continuation is the cut itself.

use crate::boundary::{Boundary, Piece};
use crate::critical::joints::{clipped, turn};
use crate::critical::shift::{Shift, minus, period_of, plus};
use crate::curve::{Curve, cross};
use crate::solid::Geometry;
use meniscus_core::math::{Bounds, Vec2, perpendicular};

/// Ends within this many tolerances are joined: intersections are computed once on each curve.
const JOINED: f64 = 10.0;

/// The piece that begins where another ends.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Link {
    /// Index of the piece.
    pub wall: usize,
    /// The image of it that joins the base piece.
    pub shift: Shift,
}

/// A piece of wall with its neighbors along the wall.
#[derive(Debug, Clone, Copy)]
pub struct Wall {
    /// Its curve, solid on the left.
    pub curve: Curve,
    /// Index of the specified shape.
    pub shape: u32,
    /// The piece that begins where this one ends.
    pub next: Option<Link>,
    /// The piece that ends where this one begins.
    pub before: Option<Link>,
    /// The angle in rad by which the wall rotates at the start of this piece, above 0 if the solid is convex; ±π at a cusp.
    pub(crate) turn: f64,
}

/// A point of a wall.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Contact {
    /// Index of the piece; a vertex is the start of the piece that leaves it.
    pub wall: usize,
    /// Image of the piece.
    pub shift: Shift,
    /// Parameter on the piece.
    pub u: f64,
    /// Position in m.
    pub point: Vec2,
}

/// Treatment of walls that extend beyond the domain.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Sides {
    /// They are cut at each side that is neither wall nor periodic.
    Cut,
    /// They continue beyond it.
    Beyond,
}

/// The walls of a geometry.
pub struct Walls {
    pub domain: Bounds,
    /// Whether it is periodic along x and y.
    pub periodic: [bool; 2],
    /// Treatment of walls at sides that are neither walls nor periodic.
    pub(crate) sides: Sides,
    /// Lengths in m below this count as zero.
    pub tolerance: f64,
    /// The base pieces.
    pub walls: Vec<Wall>,
    /// Base piece and shift of each piece of `index`.
    images: Vec<(usize, Shift)>,
    index: Boundary,
}

impl Walls {
    /// The walls of `geometry`.
    pub fn new(geometry: &Geometry, sides: Sides) -> Self {
        let (domain, periodic, tolerance) = (geometry.bounds(), geometry.periodic(), geometry.tolerance());
        let reach = if sides == Sides::Cut { 0.0 } else { domain.size().norm() };
        let mut frame = domain.grown(reach);
        for i in (0..2).filter(|&i| periodic[i]) {
            // What continues along a periodic axis is its own image.
            (frame.min[i], frame.max[i]) = (domain.min[i], domain.max[i]);
        }
        let mut pieces = Vec::new();
        for (k, piece) in geometry.boundary.pieces.iter().enumerate() {
            // A circle that touches another wall starts at the contact point, and has ends.
            let touches = |x: Vec2| geometry.boundary.within(x, JOINED * tolerance).any(|near| near.piece != k);
            let parts = if piece.curve.is_closed() && touches(piece.curve.point(0.0)) {
                vec![piece.curve.part(0.0, 0.5), piece.curve.part(0.5, 1.0)]
            } else {
                vec![piece.curve]
            };
            for curve in parts.iter().flat_map(|part| clipped(part, frame, periodic, tolerance)) {
                pieces.push(Piece { curve, shape: piece.shape });
            }
        }
        let cell = |curve: &Curve| -> Shift {
            let at = (curve.point(0.5) - domain.min).component_div(&domain.size());
            period_of(at, periodic)
        };
        // Of each wall the image whose midpoint lies in the half-open cell.
        let walls: Vec<Wall> = pieces
            .iter()
            .filter(|piece| cell(&piece.curve) == [0, 0])
            .map(|piece| Wall { curve: piece.curve, shape: piece.shape, next: None, before: None, turn: 0.0 })
            .collect();
        let mut all = Self {
            domain,
            periodic,
            sides,
            tolerance,
            walls,
            images: Vec::new(),
            index: Boundary::of_pieces(Vec::new()),
        };
        // Along a periodic axis the nearest point of a wall is at most half a period away.
        const MORE: f64 = 0.51;
        all.images = all.images_within(domain.size() * MORE);
        let image =
            |&(wall, shift): &(usize, Shift)| Piece { curve: all.curve(wall, shift), shape: all.walls[wall].shape };
        all.index = Boundary::of_pieces(all.images.iter().map(image).collect());
        all.join();
        all
    }

    /// The images of walls that reach into the domain grown by `margin` (m) along periodic axes.
    pub(crate) fn images_within(&self, margin: Vec2) -> Vec<(usize, Shift)> {
        let size = self.domain.size();
        let mut images = Vec::new();
        for (k, wall) in self.walls.iter().enumerate() {
            let bounds = wall.curve.bounds();
            let span = |i: usize| {
                if !self.periodic[i] {
                    return 0..=0;
                }
                let first = ((self.domain.min[i] - margin[i] - bounds.max[i]) / size[i]).ceil() as i32;
                let last = ((self.domain.max[i] + margin[i] - bounds.min[i]) / size[i]).floor() as i32;
                first..=last
            };
            for dx in span(0) {
                images.extend(span(1).map(|dy| (k, [dx, dy])));
            }
        }
        images
    }

    /// A shift in m.
    pub fn offset(&self, shift: Shift) -> Vec2 {
        self.domain.size().component_mul(&Vec2::new(f64::from(shift[0]), f64::from(shift[1])))
    }

    /// An image of a piece.
    pub fn curve(&self, wall: usize, shift: Shift) -> Curve {
        let curve = self.walls[wall].curve;
        if shift == [0, 0] { curve } else { curve.shifted(self.offset(shift)) }
    }

    /// `x` wrapped into the half-open cell, and the shift that leads back.
    pub fn wrapped(&self, x: Vec2) -> (Vec2, Shift) {
        let at = (x - self.domain.min).component_div(&self.domain.size());
        let shift = period_of(at, self.periodic);
        (x - self.offset(shift), shift)
    }

    /// `x` in the cell; along periodic axes points next to the upper side are moved next to the lower one, so that images of one point are neighbors.
    pub(crate) fn folded(&self, x: Vec2) -> Vec2 {
        // Fraction of a period: more than the difference between coincident points.
        const NEXT: f64 = 1e-5;
        let (mut y, size) = (self.wrapped(x).0, self.domain.size());
        for i in (0..2).filter(|&i| self.periodic[i]) {
            if y[i] > self.domain.max[i] - NEXT * size[i] {
                y[i] -= size[i];
            }
        }
        y
    }

    /// Whether `x` lies in the domain, including its sides.
    pub(crate) fn is_within(&self, x: Vec2) -> bool {
        self.domain.grown(self.tolerance).contains(self.wrapped(x).0)
    }

    /// The wall point nearest to `x` and its distance in m.
    pub fn nearest(&self, x: Vec2) -> Option<(f64, Contact)> {
        let (y, shift) = self.wrapped(x);
        let found = self.index.nearest(y)?;
        let contact = self.contact(found.piece, found.closest.u, found.closest.point, shift);
        Some(((contact.point - x).norm(), contact))
    }

    /// The distance of the nearest wall from `x` in m; infinite without walls.
    pub fn distance(&self, x: Vec2) -> f64 {
        let y = self.wrapped(x).0;
        self.index.nearest(y).map_or(f64::INFINITY, |found| (found.closest.point - y).norm())
    }

    /// The nearest points of all pieces within `reach` (m) of `x`, both ends of a concave arc, in the order of the pieces; each vertex once.
    pub(crate) fn contacts(&self, x: Vec2, reach: f64) -> Vec<Contact> {
        let (y, shift) = self.wrapped(x);
        let within = self.index.within(y, reach).flat_map(|near| {
            let (wall, own) = self.images[near.piece];
            let u = self.snapped(&self.walls[wall].curve, near.closest.u);
            let end = self.end_of_concave_arc(wall, u);
            let other = end.map(|u| 1.0 - u).map(|u| (u, self.curve(wall, own).point(u)));
            let is_near = |at: &(usize, f64, Vec2)| (at.2 - y).norm() <= reach;
            let other = other.map(|(u, point)| (near.piece, u, point)).filter(is_near);
            std::iter::once((near.piece, u, near.closest.point)).chain(other)
        });
        let mut found: Vec<Contact> = within.map(|(piece, u, point)| self.contact(piece, u, point, shift)).collect();
        found.sort_by(|a, b| (a.wall, a.shift).cmp(&(b.wall, b.shift)).then(a.u.total_cmp(&b.u)));
        found.dedup_by(|a, b| (a.wall, a.shift, a.u) == (b.wall, b.shift, b.u));
        found
    }

    /// The pieces within `reach` (m) of `x` and their images.
    pub(crate) fn within(&self, x: Vec2, reach: f64) -> Vec<(usize, Shift)> {
        let (y, shift) = self.wrapped(x);
        let mut found: Vec<(usize, Shift)> = self
            .index
            .within(y, reach)
            .map(|near| self.images[near.piece])
            .map(|(wall, own)| (wall, plus(own, shift)))
            .collect();
        found.sort_unstable();
        found
    }

    /// Whether `counts` holds for a piece within `reach` (m) of `x`, given its image and its point nearest to `x`.
    pub(crate) fn any_within(&self, x: Vec2, reach: f64, counts: impl Fn((usize, Shift), Vec2) -> bool) -> bool {
        let (y, shift) = self.wrapped(x);
        let back = self.offset(shift);
        self.index.within(y, reach).any(|near| {
            let (wall, own) = self.images[near.piece];
            counts((wall, plus(own, shift)), near.closest.point + back)
        })
    }

    /// An upper bound in m of the wall distance within a periodic domain, at most half a period.
    pub(crate) fn largest_distance(&self) -> f64 {
        let size = self.domain.size();
        if self.periodic == [false; 2] {
            return 0.0;
        }
        // The gradient of the distance is at most 1: a few nodes per piece give a tight bound.
        let step = (self.domain.area() / (1.0 + 0.5 * self.walls.len() as f64)).sqrt();
        let counts = size.map(|side| (side / step).ceil().clamp(4.0, 4096.0));
        let cell = size.component_div(&counts);
        let mut largest = 0.0_f64;
        for i in 0..counts.x as usize {
            for j in 0..counts.y as usize {
                let at = Vec2::new(i as f64 + 0.5, j as f64 + 0.5).component_mul(&cell);
                largest = largest.max(self.distance(self.domain.min + at));
            }
        }
        (largest + 0.5 * cell.norm()).min(0.51 * size.max())
    }

    /// A parameter rounded to that of an end if it is that up to rounding.
    pub(crate) fn snapped(&self, curve: &Curve, u: f64) -> f64 {
        // Rounding of positions over the tolerance.
        const ROUNDING: f64 = 1e-3;
        let near = ROUNDING * self.tolerance / curve.length();
        match u {
            _ if curve.is_closed() => u,
            _ if u < near => 0.0,
            _ if u > 1.0 - near => 1.0,
            _ => u,
        }
    }

    fn contact(&self, image: usize, u: f64, point: Vec2, shift: Shift) -> Contact {
        let (wall, own) = self.images[image];
        let u = self.snapped(&self.walls[wall].curve, u);
        self.at_vertex(Contact { wall, shift: plus(own, shift), u, point: point + self.offset(shift) })
    }

    /// The same point; a vertex is assigned to the piece that starts there.
    pub(crate) fn at_vertex(&self, contact: Contact) -> Contact {
        match self.walls[contact.wall].next {
            Some(next) if contact.u == 1.0 => {
                Contact { wall: next.wall, shift: plus(contact.shift, next.shift), u: 0.0, ..contact }
            }
            _ => contact,
        }
    }

    /// The parameter `u` of a piece if it is an end of the piece where a concave arc ends or starts.
    pub(crate) fn end_of_concave_arc(&self, wall: usize, u: f64) -> Option<f64> {
        let is_concave = |wall: usize| matches!(self.walls[wall].curve, Curve::Arc { sweep, .. } if sweep < 0.0);
        let is_end = !self.walls[wall].curve.is_closed() && (u == 0.0 || u == 1.0);
        let before = self.walls[wall].before.filter(|_| u == 0.0);
        (is_end && (is_concave(wall) || before.is_some_and(|link| is_concave(link.wall)))).then_some(u)
    }

    /// The pieces that end and start at a contact: the same one within a piece, `None` where a wall is cut.
    pub fn around(&self, contact: &Contact) -> [Option<Link>; 2] {
        let here = Link { wall: contact.wall, shift: contact.shift };
        let along = |link: Link| Link { wall: link.wall, shift: plus(contact.shift, link.shift) };
        let wall = &self.walls[contact.wall];
        if wall.curve.is_closed() || (contact.u > 0.0 && contact.u < 1.0) {
            [Some(here); 2]
        } else if contact.u == 0.0 {
            [wall.before.map(along), Some(here)]
        } else {
            [Some(here), wall.next.map(along)]
        }
    }

    /// The tangents of the wall before and after a vertex; `None` within a piece. Beyond a cut the wall continues straight.
    pub fn tangents(&self, contact: &Contact) -> Option<[Vec2; 2]> {
        let [before, after] = self.around(contact);
        let arriving = before.map(|link| self.curve(link.wall, link.shift).tangent(1.0));
        let leaving = after.map(|link| self.curve(link.wall, link.shift).tangent(0.0));
        match (arriving, leaving) {
            (Some(_), Some(_)) if before == after => None,
            (None, None) => None,
            (arriving, leaving) => {
                let inward = self.inward(contact.point);
                Some([arriving.unwrap_or(inward), leaving.unwrap_or(-inward)])
            }
        }
    }

    /// Whether a point in the direction `v` from a wall point lies on its pore side: along the normal, or within the cone of a vertex.
    pub fn is_visible(&self, contact: &Contact, v: Vec2) -> bool {
        // Tolerance for directions outside the cone by rounding.
        let slack = 1e-6 * v.norm();
        match self.tangents(contact) {
            None => self.curve(contact.wall, contact.shift).normal(contact.u).dot(&v) > 0.0,
            Some([arriving, leaving]) => {
                let is_joined = self.around(contact).iter().all(Option::is_some);
                let turn = if is_joined {
                    self.walls[contact.wall].turn
                } else {
                    cross(arriving, leaving).atan2(arriving.dot(&leaving))
                };
                // A reentrant corner faces no point; the normal lies on the right of the tangent.
                turn * v.norm() > -slack
                    && arriving.dot(&v) >= -slack
                    && leaving.dot(&v) <= slack
                    && (perpendicular(arriving).dot(&v) < 0.0 || perpendicular(leaving).dot(&v) < 0.0)
            }
        }
    }

    /// The inward normal of the nearest non-periodic side of the domain.
    pub(crate) fn inward(&self, x: Vec2) -> Vec2 {
        let mut nearest = (f64::INFINITY, Vec2::zeros());
        for i in (0..2).filter(|&i| !self.periodic[i]) {
            for (gap, sign) in [((x[i] - self.domain.min[i]).abs(), 1.0), ((self.domain.max[i] - x[i]).abs(), -1.0)] {
                if gap < nearest.0 {
                    let mut normal = Vec2::zeros();
                    normal[i] = sign;
                    nearest = (gap, normal);
                }
            }
        }
        nearest.1
    }

    /// Joins the ends of pieces. Where more than two pieces meet, as where solids touch, the wall follows the pore: it takes the sharpest turn to the right.
    fn join(&mut self) {
        let near = JOINED * self.tolerance;
        for k in 0..self.walls.len() {
            let curve = self.walls[k].curve;
            if curve.is_closed() {
                continue;
            }
            let end = curve.point(1.0);
            let (y, shift) = self.wrapped(end);
            let mut starts: Vec<(usize, Shift)> = self
                .index
                .within(y, near)
                .map(|found| self.images[found.piece])
                .map(|(wall, own)| (wall, plus(own, shift)))
                .filter(|&(wall, shift)| {
                    let curve = self.curve(wall, shift);
                    !curve.is_closed() && (curve.point(0.0) - end).norm() <= near
                })
                .collect();
            starts.sort_unstable();
            let turn = |&(wall, shift): &(usize, Shift)| turn(&curve, &self.curve(wall, shift), near);
            let follower = starts.iter().min_by(|a, b| turn(a).total_cmp(&turn(b)));
            let Some((&(wall, shift), angle)) = follower.map(|start| (start, turn(start))) else { continue };
            if self.walls[wall].before.is_none() {
                self.walls[k].next = Some(Link { wall, shift });
                self.walls[wall].before = Some(Link { wall: k, shift: minus([0, 0], shift) });
                self.walls[wall].turn = angle;
            }
        }
    }
}
