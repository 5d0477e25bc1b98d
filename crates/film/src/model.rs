//! The thin-film equations available in cells: mobility, disjoining pressure and its energy. Scaled.
//!
//! - geometric: M = h h̄² [Pang2022, Eq. 40];
//! - slip: M = h³ + 3λh², λ the slip length over the scale of heights [Pang2022, Eq. 16];
//! - precursor film: M = h³ + 3λh²; Π is 0 in complete wetting, else (1/h*) ((h*/h)³ − (h*/h)²) with the film thickness h*: a droplet of slope 1 is in
//!   equilibrium with the film (Schwartz and Eley 1998). With slip the film determines only the angle, and the slip length the speed of the contact line.

/// Equations.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Model {
    /// Geometric Thin-Film Equation of complete wetting.
    Geometric {
        /// Filter length α.
        alpha: f64,
    },
    /// Navier slip, complete wetting.
    Slip {
        /// Slip length λ.
        length: f64,
        /// Thickness of the film on the wall that counts as dry.
        film: f64,
    },
    /// Precursor film.
    Precursor {
        /// Thickness h* of the film.
        film: f64,
        /// Equilibrium slope of droplets; 0 in complete wetting.
        slope: f64,
        /// Slip length λ; 0 for a no-slip wall.
        slip: f64,
    },
}

impl Model {
    /// Disjoining pressure of a precursor film and its derivative \[Schwartz1998\].
    pub(super) fn disjoining(self, h: f64) -> (f64, f64) {
        match self {
            Self::Precursor { film, slope, .. } if slope > 0.0 => {
                let (scale, ratio) = (slope * slope / film, film / h);
                (scale * (ratio.powi(3) - ratio.powi(2)), scale * (2.0 * ratio.powi(2) - 3.0 * ratio.powi(3)) / h)
            }
            _ => (0.0, 0.0),
        }
    }

    /// The sum of the magnitudes of the two terms of the disjoining pressure.
    pub(super) fn disjoining_terms(self, h: f64) -> f64 {
        match self {
            Self::Precursor { film, slope, .. } if slope > 0.0 => {
                let ratio = (film / h).abs();
                slope * slope / film * (ratio.powi(3) + ratio.powi(2))
            }
            _ => 0.0,
        }
    }

    /// Energy per area W of the disjoining pressure, W' = −Π and W = 0 far above the film.
    pub(super) fn attraction(self, h: f64) -> f64 {
        match self {
            Self::Precursor { film, slope, .. } if slope > 0.0 => {
                let ratio = film / h;
                slope * slope * (0.5 * ratio * ratio - ratio)
            }
            _ => 0.0,
        }
    }

    /// The mobility on a face between cells of heights a and b and sharp heights g and h, with its four derivatives [Pang2022, Eqs. 16, 40].
    pub(super) fn mobility(self, [a, b]: [f64; 2], [g, h]: [f64; 2]) -> (f64, [f64; 2], [f64; 2]) {
        match self {
            Self::Geometric { .. } => {
                let (v, s) = (0.5 * (a + b), 0.5 * (g + h));
                (s * v * v, [s * v; 2], [0.5 * v * v; 2])
            }
            Self::Slip { length, .. } | Self::Precursor { slip: length, .. } => {
                let (cube, [ca, cb]) = cubic(a, b);
                let slip = 3.0 * length;
                (cube + slip * a * b, [ca + slip * b, cb + slip * a], [0.0; 2])
            }
        }
    }
}

/// The factor h³ of the mobility on a face, 2a²b²/(a + b), and its derivatives \[Zhornitskaya2000\].
fn cubic(a: f64, b: f64) -> (f64, [f64; 2]) {
    let sum = a + b;
    let value = 2.0 * (a * b).powi(2) / sum;
    let by = |x: f64, y: f64| 2.0 * x * y * y * (x + 2.0 * y) / (sum * sum);
    (value, [by(a, b), by(b, a)])
}
