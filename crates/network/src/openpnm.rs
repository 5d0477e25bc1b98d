//! `openpnm.csv`: the network in the format of `openpnm.io.network_from_csv` (OpenPNM 3): pore and throat columns side by side, labels
//! True and False, no units in headers, SI units with the depth of the chip, or a depth of 1 m in the plane.
//!
//! Each opening of an open side is a boundary pore of volume zero with a throat to the pore behind it. Throats from a pore to itself are
//! left out, as they connect nothing.

use super::conductance::opening_conductances;
use super::graph::{Opening, Throat};
use super::model::{Configuration, Model};
use super::tables::{center, counts, finite, flags, kept, length, numbers, openings, pores_of, radius, wall_lengths};
use meniscus_case::SIDES;
use meniscus_core::math::Vec2;
use meniscus_core::table::{Column, Table};

/// A connection between two pores: a throat, or an opening where there is none.
struct Connection<'a> {
    ends: [usize; 2],
    throat: Option<&'a Throat>,
    middle: Vec2,
    width: f64,
    length: f64,
    conductance: f64,
    entry_pressure: f64,
}

fn connections(model: &Model) -> Vec<Connection<'_>> {
    let config = &model.config;
    let (conductances, pressures) = (model.conductances(), model.entry_pressures());
    let throats = config.pores.throats.iter().zip(kept(config)).filter_map(|(&index, throat)| {
        let [a, b] = pores_of(config, throat);
        (a != b).then(|| Connection {
            ends: [a.min(b), a.max(b)],
            throat: Some(throat),
            middle: throat.middle(),
            width: throat.width,
            length: length(config, throat),
            conductance: conductances[index],
            entry_pressure: pressures.as_ref().map_or(f64::NAN, |all| all[index]),
        })
    });
    let pores = config.pores.main_region.len();
    let openings = openings(config).zip(opening_conductances(&config.network)).enumerate();
    let openings = openings.map(|(index, ((opening, pore), conductance))| Connection {
        ends: [pore, pores + index],
        throat: None,
        middle: middle(opening),
        width: width(opening),
        length: (center(config, pore) - middle(opening)).norm(),
        conductance,
        // An opening joins a reservoir: it has no entry pressure.
        entry_pressure: 0.0,
    });
    throats.chain(openings).collect()
}

fn width(opening: &Opening) -> f64 {
    (opening.ends[1] - opening.ends[0]).norm()
}

fn middle(opening: &Opening) -> Vec2 {
    0.5 * (opening.ends[0] + opening.ends[1])
}

/// The table.
pub(crate) fn table(model: &Model) -> Table {
    let config = &model.config;
    let mut columns = pore_columns(config);
    columns.extend(throat_columns(model));
    Table { name: "openpnm", columns }
}

/// Number of plates (floor, lid) that bound the flow: 2, or 0 in the plane.
fn plates(config: &Configuration) -> f64 {
    if config.network.depth.is_some() { 2.0 } else { 0.0 }
}

fn pore_columns(config: &Configuration) -> Vec<Column> {
    let inner = || 0..config.pores.main_region.len();
    let outer = || config.network.openings.iter();
    let all = |name, of_pore: &dyn Fn(usize) -> f64, of_opening: &dyn Fn(&Opening) -> f64| {
        numbers(name, inner().map(of_pore).chain(outer().map(of_opening)))
    };
    let area = |pore: usize| config.pores.area[pore];
    let diameter = |pore: usize| 2.0 * radius(config, pore);
    let walls = wall_lengths(config);
    let zero = |_: &Opening| 0.0;
    let (depth, plates) = (config.thickness(), plates(config));
    let volume = |pore: usize| depth * area(pore);
    let surface = |pore: usize| depth * walls[pore] + plates * area(pore);
    let round = |pore: usize| (4.0 * area(pore) / std::f64::consts::PI).sqrt();
    let mut columns = vec![
        all("pore.coords[0]", &|pore| center(config, pore).x, &|opening| middle(opening).x),
        all("pore.coords[1]", &|pore| center(config, pore).y, &|opening| middle(opening).y),
        all("pore.coords[2]", &|_| 0.0, &zero),
        all("pore.diameter", &diameter, &width),
        all("pore.inscribed_diameter", &diameter, &width),
        all("pore.equivalent_diameter", &round, &zero),
        all("pore.region_area", &area, &zero),
        all("pore.region_volume", &volume, &zero),
        all("pore.volume", &volume, &zero),
        all("pore.surface_area", &surface, &zero),
    ];
    let label = |name, holds: &dyn Fn(&Opening) -> bool| flags(name, inner().map(|_| false).chain(outer().map(holds)));
    columns.push(label("pore.boundary", &|_| true));
    columns.push(label("pore.inlet", &|opening| Some(opening.side) == config.inlet));
    columns.push(label("pore.outlet", &|opening| config.outlet[opening.side]));
    for (side, name) in ["pore.left", "pore.right", "pore.bottom", "pore.top"].into_iter().enumerate().take(SIDES.len())
    {
        columns.push(label(name, &|opening| opening.side == side));
    }
    columns
}

fn throat_columns(model: &Model) -> Vec<Column> {
    let config = &model.config;
    let (depth, plates) = (config.thickness(), plates(config));
    let all = connections(model);
    let column = |name, value: &dyn Fn(&Connection<'_>) -> f64| numbers(name, all.iter().map(value));
    let of_throat = |name, value: &dyn Fn(&Throat) -> f64| column(name, &|it| it.throat.map_or(f64::NAN, value));
    let end = |name, side: usize| counts(name, all.iter().map(|it| it.ends[side]));
    let viscosity = config.viscosities[0].unwrap_or(1.0);
    let mut columns = vec![
        end("throat.conns[0]", 0),
        end("throat.conns[1]", 1),
        // The name that PoreSpy gives the place of a throat.
        column("throat.global_peak[0]", &|it| it.middle.x),
        column("throat.global_peak[1]", &|it| it.middle.y),
        column("throat.global_peak[2]", &|_| 0.0),
        column("throat.diameter", &|it| it.width),
        column("throat.inscribed_diameter", &|it| it.width),
        column("throat.equivalent_diameter", &|it| it.width),
        column("throat.length", &|it| it.length),
        column("throat.total_length", &|it| it.length),
        column("throat.spacing", &|it| it.length),
        column("throat.cross_sectional_area", &|it| depth * it.width),
        column("throat.perimeter", &|it| 2.0 * it.width + plates * depth),
        column("throat.volume", &|_| 0.0),
        of_throat("throat.curvature_1", &|throat| finite(throat.curvatures[0])),
        of_throat("throat.curvature_2", &|throat| finite(throat.curvatures[1])),
        of_throat("throat.wall_1", &|throat| f64::from(throat.shapes[0])),
        of_throat("throat.wall_2", &|throat| f64::from(throat.shapes[1])),
        column("throat.hydraulic_conductance", &|it| depth * it.conductance / viscosity),
    ];
    if config.tension.is_some() {
        columns.push(column("throat.entry_pressure", &|it| it.entry_pressure));
    }
    columns.push(flags("throat.boundary", all.iter().map(|it| it.throat.is_none())));
    columns
}
