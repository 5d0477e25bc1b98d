//! A checked network as a table that loads to the same network.

use super::checked::{Driven, NetworkEvents, PoreNetwork, Process};
use super::measured;
use super::raw::{RawDynamic, RawEvents, RawNetwork, RawNetworkSide, RawNetworkSides, RawProcess, RawStop};
use crate::case::checked::Side;
use crate::case::raw::{RawInterface, RawPhases, RawSideName};
use crate::case::{resolve, wetting};

/// The network as a table.
pub(in crate::case) fn raw(network: &PoreNetwork) -> RawNetwork {
    let sides = [network.sides.left, network.sides.right, network.sides.bottom, network.sides.top];
    let names = [RawSideName::Left, RawSideName::Right, RawSideName::Bottom, RawSideName::Top];
    let with = |kind| sides.iter().zip(names).find(|(side, _)| **side == kind).map(|(_, name)| name);
    let [left, right, bottom, top] = sides.map(|side| match side {
        Side::Periodic => Some(RawNetworkSide::Periodic),
        Side::Wall => Some(RawNetworkSide::Wall),
        _ => None,
    });
    let has_phase = network.wetting.is_some() || network.non_wetting.is_some();
    let interface = network.interface.as_ref();
    let none = RawNetwork {
        inlet: with(Side::Inlet),
        outlet: with(Side::Outlet),
        sides: Some(RawNetworkSides { left, right, bottom, top }),
        phases: has_phase.then(|| RawPhases {
            wetting: network.wetting.as_ref().map(resolve::raw_fluid),
            non_wetting: network.non_wetting.as_ref().map(resolve::raw_fluid),
        }),
        interface: interface.map(|interface| RawInterface { tension: Some(interface.tension) }),
        wetting: interface.map(|interface| wetting::raw(&interface.wetting_model, &interface.patches)),
        persistence: Some(network.persistence),
        measured_throats: network.measured.as_ref().map(measured::table),
        ..RawNetwork::default()
    };
    let Some(displacement) = &network.displacement else { return none };
    let (process, cycles) = match displacement.process {
        Process::Drainage => (RawProcess::Drainage, None),
        Process::Imbibition => (RawProcess::Imbibition, None),
        Process::Cycle(cycles) => (RawProcess::Cycle, Some(cycles)),
    };
    let stop = displacement.stop;
    RawNetwork {
        process: Some(process),
        cycles,
        trapping: displacement.dynamic.is_none().then_some(displacement.trapping),
        events: Some(match displacement.events {
            NetworkEvents::All => RawEvents::All,
            NetworkEvents::Burst => RawEvents::Burst,
        }),
        stop: Some(RawStop {
            breakthrough: Some(stop.breakthrough),
            saturation: stop.saturation,
            capillary_pressure: stop.capillary_pressure,
            injected: stop.injected,
        }),
        dynamic: displacement.dynamic.map(|dynamic| {
            let (rate, pressure_drop) = match dynamic.drive {
                Driven::Rate(rate) => (Some(rate), None),
                Driven::PressureDrop(pressure) => (None, Some(pressure)),
            };
            RawDynamic { rate, pressure_drop, largest_step: Some(dynamic.largest_step) }
        }),
        initial: displacement.initial.as_ref().map(|start| start.file.clone()),
        ..none
    }
}
