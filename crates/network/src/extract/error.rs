//! Errors of network extraction.

use meniscus_core::math::Vec2;

/// Why there is no network.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum ExtractError {
    /// A side that cannot be open.
    #[error(
        "the {side} side cannot be open: it is {}; make it neither, or choose another side",
        if *.is_periodic { "periodic" } else { "a wall" }
    )]
    NotOpen {
        /// Name of the side.
        side: &'static str,
        /// Whether it is periodic; otherwise it is a wall.
        is_periodic: bool,
    },
    /// No walls, hence neither pores nor throats.
    #[error(
        "no wall lies within the domain, which is all {}; a network needs solid and pore space: check `window`, or exchange both with `invert`",
        if *.is_solid { "solid" } else { "pore" }
    )]
    NoWalls {
        /// Whether the domain is solid.
        is_solid: bool,
    },
    /// Walls do not close.
    #[error(
        "the wall ends at {}, within the domain; shapes that touch or nearly coincide there may be the cause: let them overlap clearly or leave a gap",
        list(.at)
    )]
    Broken {
        /// Where, in m.
        at: Vec<Vec2>,
    },
    /// Regions and maxima do not correspond one to one.
    #[error(
        "no network was found that has one pore per region, near {}; shapes there may touch or nearly touch: let them overlap clearly or leave a gap above 1e-5 of the domain",
        list(.near)
    )]
    NoCertificate {
        /// Where, in m.
        near: Vec<Vec2>,
    },
}

/// Some positions as text.
fn list(at: &[Vec2]) -> String {
    const SHOWN: usize = 5;
    let shown: Vec<String> = at.iter().take(SHOWN).map(|x| format!("({:.6e}, {:.6e}) m", x.x, x.y)).collect();
    let more = at.len().saturating_sub(SHOWN);
    if more == 0 { shown.join(", ") } else { format!("{} and {more} more", shown.join(", ")) }
}
