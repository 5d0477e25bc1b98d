//! `openpnm.csv`: the network in the format of `openpnm.io.network_from_csv` (OpenPNM 3): pore and throat columns side by side, labels
//! True and False, no units in headers, SI units with the depth of the chip, or a depth of 1 m in the plane.
//!
//! Each opening of an open side is a boundary pore of volume zero with a throat to the pore behind it. Throats from a pore to itself are
//! left out, as they connect nothing.

use super::conductance::opening_conductances;
use super::graph::{Opening, Throat};
use super::model::{Configuration, Model};
use super::tables::{center, finite, flags, kept, length, numbers, openings, pores_of, radius, wall_lengths};
use crate::case::SIDES;
use crate::math::Vec2;
use crate::table::{Cells, Column, Table};

/// A connection between two pores: a throat or an opening.
enum Link<'a> {
    Throat { index: usize, throat: &'a Throat },
    Opening { index: usize, opening: &'a Opening },
}

struct Connection<'a> {
    ends: [usize; 2],
    link: Link<'a>,
}

fn connections(config: &Configuration) -> Vec<Connection<'_>> {
    let pores = config.pores.main_region.len();
    let throats = config.pores.throats.iter().zip(kept(config)).filter_map(|(&index, throat)| {
        let [a, b] = pores_of(config, throat);
        (a != b).then_some(Connection { ends: [a.min(b), a.max(b)], link: Link::Throat { index, throat } })
    });
    let openings = openings(config).enumerate().map(|(index, (opening, pore))| Connection {
        ends: [pore, pores + index],
        link: Link::Opening { index, opening },
    });
    throats.chain(openings).collect()
}

impl Connection<'_> {
    fn width(&self) -> f64 {
        match &self.link {
            Link::Throat { throat, .. } => throat.width,
            Link::Opening { opening, .. } => (opening.ends[1] - opening.ends[0]).norm(),
        }
    }

    fn length(&self, config: &Configuration) -> f64 {
        match &self.link {
            Link::Throat { throat, .. } => length(config, throat),
            Link::Opening { opening, .. } => (center(config, self.ends[0]) - middle(opening)).norm(),
        }
    }

    fn of_throat(&self, value: impl Fn(&Throat) -> f64, of_opening: f64) -> f64 {
        match &self.link {
            Link::Throat { throat, .. } => value(throat),
            Link::Opening { .. } => of_opening,
        }
    }
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
    let width = |opening: &Opening| (opening.ends[1] - opening.ends[0]).norm();
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
    columns.push(label("pore.outlet", &|opening| Some(opening.side) == config.outlet));
    for (side, name) in ["pore.left", "pore.right", "pore.bottom", "pore.top"].into_iter().enumerate().take(SIDES.len())
    {
        columns.push(label(name, &|opening| opening.side == side));
    }
    columns
}

fn throat_columns(model: &Model) -> Vec<Column> {
    let config = &model.config;
    let (depth, plates) = (config.thickness(), plates(config));
    let all = connections(config);
    let column = |name, value: &dyn Fn(&Connection<'_>) -> f64| numbers(name, all.iter().map(value));
    let end = |name, side: usize| Column { name, cells: Cells::Counts(all.iter().map(|it| it.ends[side]).collect()) };
    let direct = |it: &Connection<'_>| it.length(config);
    let mut columns = vec![
        end("throat.conns[0]", 0),
        end("throat.conns[1]", 1),
        column("throat.diameter", &|it| it.width()),
        column("throat.inscribed_diameter", &|it| it.width()),
        column("throat.equivalent_diameter", &|it| it.width()),
        column("throat.length", &direct),
        column("throat.total_length", &direct),
        column("throat.spacing", &direct),
        column("throat.cross_sectional_area", &|it| depth * it.width()),
        column("throat.perimeter", &|it| 2.0 * it.width() + plates * depth),
        column("throat.volume", &|_| 0.0),
        column("throat.curvature_1", &|it| it.of_throat(|throat| finite(throat.curvatures[0]), f64::NAN)),
        column("throat.curvature_2", &|it| it.of_throat(|throat| finite(throat.curvatures[1]), f64::NAN)),
        column("throat.wall_1", &|it| it.of_throat(|throat| f64::from(throat.shapes[0]), f64::NAN)),
        column("throat.wall_2", &|it| it.of_throat(|throat| f64::from(throat.shapes[1]), f64::NAN)),
    ];
    let (conductances, of_openings) = (model.conductances(), opening_conductances(&config.network));
    let viscosity = config.viscosities[0].unwrap_or(1.0);
    columns.push(column("throat.hydraulic_conductance", &|it| match it.link {
        Link::Throat { index, .. } => depth * conductances[index] / viscosity,
        Link::Opening { index, .. } => depth * of_openings[index] / viscosity,
    }));
    if let Some(pressures) = model.entry_pressures() {
        // An opening joins a reservoir: it has no entry pressure.
        columns.push(column("throat.entry_pressure", &|it| match it.link {
            Link::Throat { index, .. } => pressures[index],
            Link::Opening { .. } => 0.0,
        }));
    }
    columns.push(flags("throat.boundary", all.iter().map(|it| matches!(it.link, Link::Opening { .. }))));
    columns
}
