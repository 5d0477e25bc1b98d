//! Contact lines tracked from step to step, and the contact line force as a volume force.
//!
//! The division follows the paper (section 3.2): a wetting model (`meniscus_wetting`) gives the contact angle to impose, depending on the
//! motion of the line. With the pressure jump the circle fit meets the wall at that angle θ; with the continuum force the line is driven
//! by σ (cos θ − cos α), which `contact_line` distributes over the particles. `lines` tracks the lines and determines their speeds.

pub mod contact_line;
pub mod lines;
pub(crate) mod wall;
