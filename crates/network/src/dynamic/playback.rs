//! A displacement in time as data to play.

use super::measures;
use super::model::DynamicModel;
use crate::cycles::FluidPhase;
use crate::pictures::through;
use crate::playback;
use meniscus_core::playback::{Playback, Stage};

/// A displacement in time: an element counts as filled from the event on by which the invading phase entered it.
pub(crate) fn in_time(model: &DynamicModel) -> Playback {
    let (dynamic, config) = (&model.dynamic, &model.quasi_static.config);
    let wetting_invades = model.invading == FluidPhase::Wetting;
    let open = config.sides.map(through);
    let reached = dynamic.breakthrough().map(|it| dynamic.history().partition_point(|event| event.time <= it.time));
    Playback {
        events: playback::events(measures::events(model)),
        stages: vec![Stage {
            name: model.invading.process().to_owned(),
            first: 0,
            wetting_invades,
            open,
            breakthrough: reached,
        }],
        changes: dynamic.changes(),
        ..playback::drawing(&model.quasi_static, dynamic.displacement())
    }
}
