//! Numerically admissible sizes and positions of the domain, and of shapes relative to it.
//!
//! At intersections of curves, lengths below a billionth of the domain count as zero. The wall of a shape a million times larger than the domain is accurate
//! to a tenth of that; beyond, it would be lost.

use crate::body::Body;
use crate::spec::{GeometrySpec, RandomPack, ShapeSpec};
use meniscus_core::input::problem::Problem;
use meniscus_core::math::{Bounds, Vec2};

/// Sides of a domain in m: from a thousandth of an atom to the distance that light travels in a month.
const DOMAIN: (f64, f64) = (1e-15, 1e15);

/// Longer side of a domain over the shorter one, and its distance from the origin over its longer side.
const LARGEST_RATIO: f64 = 1e6;

/// Smallest and largest length of a shape over the longer side of the domain.
const SIZES: (f64, f64) = (1e-9, 1e6);

/// Largest rotation in degrees; beyond, digits of the angle are lost.
const LARGEST_TURN: f64 = 3600.0;

/// Problems of the size or the position of a domain whose corners are valid.
pub(crate) fn domain_problems(spec: &GeometrySpec) -> Option<Problem> {
    let (min, max) = (Vec2::from(spec.min), Vec2::from(spec.max));
    let size = max - min;
    let (longer, shorter) = (size.max(), size.min());
    if !(shorter >= DOMAIN.0 && longer <= DOMAIN.1) {
        let message = format!(
            "the domain is {:e} m by {:e} m, expected sides from {:e} to {:e} m",
            size.x, size.y, DOMAIN.0, DOMAIN.1
        );
        return Some(Problem::new("max", message, "give both corners in m"));
    }
    if longer > LARGEST_RATIO * shorter {
        let message = format!(
            "the domain is {:e} m by {:e} m, expected sides of a ratio of at most {LARGEST_RATIO:e}",
            size.x, size.y
        );
        return Some(Problem::new("max", message, "are both corners in m?"));
    }
    let farthest = min.abs().sup(&max.abs()).max();
    (farthest > LARGEST_RATIO * longer).then(|| {
        let message =
            format!("the domain of {longer:e} m lies {farthest:e} m from the origin, where its digits are lost");
        Problem::new("max", message, "move the domain and the shapes nearer to (0, 0)")
    })
}

/// Largest shape over a period of the domain: beyond, too many of its images would overlap.
const MOST_PERIODS: f64 = 20.0;

/// Maximum number of shapes with their periodic images.
const MOST_IMAGES: f64 = 4e6;

impl GeometrySpec {
    /// Problems of the shapes in a domain periodic along x and y; paths as in a shape file.
    pub fn periodic_problems(&self, periodic: [bool; 2]) -> Vec<Problem> {
        let domain = Bounds { min: Vec2::from(self.min), max: Vec2::from(self.max) };
        let (mut found, mut images) = (Vec::new(), 0.0);
        for (i, shape) in self.shapes.iter().enumerate().filter(|_| periodic != [false; 2]) {
            let bodies = Body::of(shape, 0, domain);
            let sizes = bodies.iter().filter(|body| !body.is_endless()).map(|body| body.bounds.size());
            let periods = sizes.map(|size| size.component_div(&domain.size()));
            let periods = periods.map(|periods| [0, 1].map(|axis| if periodic[axis] { periods[axis] } else { 0.0 }));
            for [x, y] in periods {
                if x.max(y) > MOST_PERIODS {
                    let message = format!(
                        "the shape is {:.3e} periods of the domain long, expected at most {MOST_PERIODS}",
                        x.max(y)
                    );
                    let help = "make it smaller, or the domain larger; a `half-plane` is an infinite flat wall";
                    found.push(Problem::new(format!("shapes[{i}].{}", shape.key()), message, help));
                    break;
                }
                images += [x, y]
                    .iter()
                    .zip(periodic)
                    .map(|(n, is_periodic)| if is_periodic { n + 3.0 } else { 1.0 })
                    .product::<f64>();
            }
        }
        if images > MOST_IMAGES {
            let message = format!(
                "the shapes and their images beyond periodic sides are {images:.1e}, expected at most {MOST_IMAGES:e}"
            );
            found.push(Problem::new("shapes", message, "use fewer shapes, or walls at the sides"));
        }
        found
    }
}

/// Meanings of the numbers of a shape.
pub(crate) enum Numbers<'s> {
    /// Lengths in m.
    Sizes(&'static str, &'s [f64]),
    /// Points in m.
    Points(&'static str, Vec<[f64; 2]>),
    /// A rotation in degrees.
    Turn(f64),
}

/// Problems of the sizes and positions of a shape relative to its domain; `at` is its path, such as `shapes[2]`.
pub(crate) fn shape_problems(domain: Bounds, shape: &ShapeSpec, at: &str) -> Vec<Problem> {
    let side = domain.size().max();
    let (least, most) = (SIZES.0 * side, SIZES.1 * side);
    let mut found = Vec::new();
    for numbers in numbers(shape) {
        let (key, message, help) = match numbers {
            Numbers::Sizes(key, sizes) => {
                let Some(bad) = sizes.iter().find(|size| !(least..=most).contains(*size)) else { continue };
                let help = if *bad < least {
                    "a length below a billionth of the domain is rounding; are all lengths in m?"
                } else {
                    "a `half-plane` is a flat wall of any size; are all lengths in m?"
                };
                let expected = format!("a length from {least:.1e} to {most:.1e} m beside a domain of {side:e} m");
                (key, format!("expected {expected}, found {bad:e} m"), help)
            }
            Numbers::Points(key, points) => {
                let center = domain.center();
                // If one of two numbers is NaN, `max` returns the other one.
                let is_near = |[x, y]: [f64; 2]| (x - center.x).abs() <= most && (y - center.y).abs() <= most;
                let Some([x, y]) = points.iter().find(|point| !is_near(**point)) else { continue };
                let expected = format!("a point within {most:.1e} m of a domain of {side:e} m");
                (key, format!("expected {expected}, found ({x:e}, {y:e})"), "are all lengths in m?")
            }
            Numbers::Turn(turn) => {
                if turn.abs() <= LARGEST_TURN {
                    continue;
                }
                let message =
                    format!("expected an angle in degrees from -{LARGEST_TURN} to {LARGEST_TURN}, found {turn:e}");
                ("rotation-deg", message, "a full turn has 360 degrees")
            }
        };
        found.push(Problem::new(format!("{at}.{}.{key}", shape.key()), message, help));
    }
    found
}

/// The numbers of a shape in the order of its keys.
pub(crate) fn numbers(shape: &ShapeSpec) -> Vec<Numbers<'_>> {
    use Numbers::{Points, Sizes, Turn};
    use std::slice::from_ref;
    match shape {
        ShapeSpec::HalfPlane(s) => vec![Points("point", vec![s.point]), Turn(s.rotation_deg)],
        ShapeSpec::Disc(s) => vec![Points("center", vec![s.center]), Sizes("radius", from_ref(&s.radius))],
        ShapeSpec::Rectangle(s) => {
            vec![Points("center", vec![s.center]), Sizes("size", &s.size), Turn(s.rotation_deg)]
        }
        ShapeSpec::Capsule(s) => vec![Points("ends", s.ends.to_vec()), Sizes("radius", from_ref(&s.radius))],
        ShapeSpec::Polygon(s) => vec![
            Points("outer", s.outer.clone()),
            Points("holes", s.holes.concat()),
            Points("position", vec![s.position]),
            Turn(s.rotation_deg),
        ],
        ShapeSpec::CurvedPolygon(s) => {
            let points = |ring: &[[f64; 3]]| ring.iter().map(|&[x, y, _]| [x, y]).collect::<Vec<_>>();
            vec![
                Points("outer", points(&s.outer)),
                Points("holes", points(&s.holes.concat())),
                Points("position", vec![s.position]),
                Turn(s.rotation_deg),
            ]
        }
        ShapeSpec::Channel(s) => {
            vec![Points("center", vec![s.center]), Sizes("width", from_ref(&s.width)), Turn(s.rotation_deg)]
        }
        ShapeSpec::ThroatDiscs(s) => vec![
            Points("center", vec![s.center]),
            Sizes("radii", &s.radii),
            Sizes("gap", from_ref(&s.gap)),
            Turn(s.rotation_deg),
        ],
        ShapeSpec::ThroatCosine(s) => vec![
            Points("center", vec![s.center]),
            Sizes("width", from_ref(&s.width)),
            Sizes("throat", from_ref(&s.throat)),
            Sizes("length", from_ref(&s.length)),
            Turn(s.rotation_deg),
        ],
        ShapeSpec::RandomPack(RandomPack { region, radius, gap, .. }) => {
            vec![Points("region", region.to_vec()), Sizes("radius", from_ref(radius)), Sizes("gap", from_ref(gap))]
        }
        ShapeSpec::Array(s) => vec![
            Points("region", s.region.to_vec()),
            Sizes("radius", from_ref(&s.radius)),
            Sizes("gap", from_ref(&s.gap)),
        ],
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::spec::{Disc, SolidSide};

    const DOMAIN: Bounds = Bounds { min: Vec2::new(0.0, 0.0), max: Vec2::new(1e-3, 1e-3) };

    fn disc(x: f64, radius: f64) -> usize {
        shape_problems(DOMAIN, &ShapeSpec::Disc(Disc { center: [x, 0.0], radius }), "shapes[0]").len()
    }

    #[test]
    fn lengths_that_are_rounding_beside_the_domain_are_refused() {
        assert_eq!([disc(0.0, 1e-11), disc(0.0, 9e2), disc(9e2, 1.0)], [0; 3]);
        assert_eq!([disc(0.0, 5e-324), disc(0.0, 1e300), disc(-1e4, 1.0), disc(f64::NAN, 1.0)], [1; 4]);
    }

    #[test]
    fn domains_out_of_all_sizes_are_refused() {
        let problem = |min: [f64; 2], max: [f64; 2]| {
            domain_problems(&GeometrySpec { min, max, solid: SolidSide::Inside, shapes: Vec::new() })
        };
        assert_eq!(problem([5e5, 5e6], [5e5 + 10.0, 5e6 + 10.0]), None);
        for (min, max) in [
            ([0.0; 2], [1e300; 2]),
            ([-1e308; 2], [1e308; 2]),
            ([0.0; 2], [5e-324; 2]),
            ([0.0; 2], [1.0, 1e-7]),
            ([1e9, 0.0], [1e9 + 1.0, 1.0]),
        ] {
            assert!(problem(min, max).is_some(), "{min:?} {max:?}");
        }
    }
}
