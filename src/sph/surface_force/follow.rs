//! The contact lines of a flow, from step to step.

use crate::sph::bulk::BulkFields;
use crate::sph::setting::Setting;
use crate::sph::view::View;
use crate::sph::wetting::lines::{DetectedLine, Following, Line};

impl View<'_, BulkFields> {
    /// The contact lines now, from those of the step before and from what is `seen` of them.
    pub(super) fn followed(&self, seen: &[impl DetectedLine]) -> Vec<Line> {
        let Setting { method, domain, spots, .. } = self.setting;
        let Some(base) = method.wetting else { return Vec::new() };
        let h = method.kernel.h;
        // Nothing happens at a line faster than an interface of the size h moves.
        let mean_over = h / method.capillary_speed() + method.largest_viscosity() * h / method.tension;
        let following = Following {
            domain,
            model: &|x| spots.model(method, x).unwrap_or(base),
            wall_velocity: &|x| spots.velocity(x),
            tension: method.tension,
            viscosity: method.wetting_fluid.viscosity,
            other_viscosity: method.other_fluid.viscosity,
            slip_length: method.no_slip.line_slip_length,
            h,
            mean_over,
        };
        following.follow(&self.state.lines, seen, self.state.last_dt)
    }
}
