//! The dimensionless numbers of a case and the limits of its time step, each with its formula.
//!
//! With rho, mu of the wetting phase, sigma the tension, L the length that the case gives, else the shorter of the width of the narrowest throat and the square
//! root of the area of a drop or bubble, else the shorter side of the domain, and U a speed: Re = rho U L/mu, Ca = mu U/sigma, We = rho U² L/sigma,
//! Bo = |rho_w - rho_n| g L²/sigma (rho_w alone in single-phase flow), La = sigma rho L/mu², Oh = La^(-1/2). A displacement has its viscosity ratio M and the
//! capillary number of its inflow, in a network also a Bond number with the distance between pores.

use serde::Serialize;

use super::setup;
use meniscus_case::film::{FilmDroplet, FilmEquation, Geometric, Precursor, Slip, ThinFilm};
use meniscus_case::network::{Drive as InTime, PoreNetwork, Process};
use meniscus_case::{Case, Drive, InitialVelocity, Model, Side, Sph};
use meniscus_core::math::Vec2;

/// A dimensionless number.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Number {
    /// Its usual symbol, such as `Re`.
    pub symbol: &'static str,
    /// Its value, in a report as reached.
    pub value: f64,
    /// What the case asks for, if it prescribes it.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub asked: Option<f64>,
    /// Its formula.
    pub formula: &'static str,
}

/// The characteristic length L.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Length {
    /// In m.
    pub value: f64,
    /// Its meaning.
    pub name: &'static str,
}

impl Length {
    /// The characteristic length of a case: see the head of this file.
    pub(crate) fn of(case: &Case) -> Self {
        if let Model::Sph(sph) = &case.model
            && let Some(value) = sph.reference_length
        {
            return Self { value, name: "given by the case" };
        }
        let throat = setup::throat(case).map(|value| Self { value, name: "width of the narrowest throat" });
        let drop = setup::drop_area(case).map(f64::sqrt);
        let drop = drop.map(|value| Self { value, name: "square root of the area of the drop" });
        if let Some(shorter) = [throat, drop].into_iter().flatten().min_by(|a, b| a.value.total_cmp(&b.value)) {
            return shorter;
        }
        let size = Vec2::from(case.geometry.max) - Vec2::from(case.geometry.min);
        Self { value: size.min(), name: "shorter side of the domain" }
    }
}

/// An estimated speed in m/s, with its formula, from what is known before a run.
pub(crate) fn expected_speed(case: &Case, length: Length) -> (f64, &'static str) {
    let sph = match &case.model {
        Model::Sph(sph) => sph,
        Model::ThinFilm(film) => return (spreading_speed(film), "sigma (H / r)^3 / 3 mu"),
        Model::Network(_) => return (0.0, "quasi-static"),
    };
    let (rho, mu, g, l) = (sph.wetting.density, sph.wetting.viscosity, sph.gravity.norm(), length.value);
    let initial = match sph.initial.velocity {
        InitialVelocity::Rest => 0.0,
        InitialVelocity::Uniform(v) => v.norm(),
        InitialVelocity::TaylorGreen(speed) => speed,
    };
    let driven = sph.wall_speeds.iter().map(|speed| speed.abs()).chain(given_speeds(case, sph)).fold(0.0, f64::max);
    if driven > 0.0 {
        (driven, "fastest wall or inflow")
    } else if initial > 0.0 {
        (initial, "initial speed")
    } else if sph.acting_tension() > 0.0 {
        ((sph.tension / (rho * l)).sqrt(), "sqrt(sigma / rho L)")
    } else {
        // At the center of a gap of width L; a body force cannot accelerate more than free fall through L.
        let (viscous, free) = (rho * g * l * l / (8.0 * mu), (2.0 * g * l).sqrt());
        if viscous < free { (viscous, "rho g L^2 / 8 mu") } else { (free, "sqrt(2 g L)") }
    }
}

/// The largest mean speeds in m/s prescribed at open sides.
fn given_speeds<'a>(case: &Case, sph: &'a Sph) -> impl Iterator<Item = f64> + use<'a> {
    let size = Vec2::from(case.geometry.max) - Vec2::from(case.geometry.min);
    let end = case.end;
    let given = sph.open.iter().enumerate().filter_map(move |(number, open)| {
        let open = open.as_ref()?;
        Some((number, open.drive, open.acceleration.unwrap_or(0.0) * end))
    });
    given.map(move |(number, drive, rise)| match drive {
        Drive::Pressure(_) => 0.0,
        Drive::Velocity(speed, _) => speed.abs() + rise,
        Drive::FlowRate(rate, _) => rate.abs() / sph.thickness() / size[1 - number / 2] + rise,
    })
}

/// The numbers of a case at the speed `speed` in m/s; those that need a tension are absent without one.
pub(crate) fn numbers(case: &Case, length: Length, speed: f64) -> Vec<Number> {
    let sph = match &case.model {
        Model::Sph(sph) => sph,
        Model::ThinFilm(film) => return of_thin_film(film, speed),
        // Those of its displacement: see below.
        Model::Network(_) => return Vec::new(),
    };
    let (rho, mu, sigma) = (sph.wetting.density, sph.wetting.viscosity, sph.acting_tension());
    let length = length.value;
    let difference = (rho - sph.non_wetting.map_or(0.0, |fluid| fluid.density)).abs();
    let number = |symbol, value, formula| Number { symbol, value, asked: None, formula };
    let mut all = vec![number("Re", rho * speed * length / mu, "rho U L / mu")];
    if sigma > 0.0 {
        let laplace = sigma * rho * length / (mu * mu);
        all.extend([
            number("Ca", mu * speed / sigma, "mu U / sigma"),
            number("We", rho * speed * speed * length / sigma, "rho U^2 L / sigma"),
            number("Bo", difference * sph.gravity.norm() * length * length / sigma, "|rho_w - rho_n| g L^2 / sigma"),
            number("Oh", laplace.powf(-0.5), "mu / sqrt(rho sigma L)"),
            number("La", laplace, "rho sigma L / mu^2"),
        ]);
    }
    all
}

/// All numbers of a run: those of the case at the largest recorded speed, and those of its displacement as asked and as reached, by the values of its measures.
pub(crate) fn reached(
    case: &Case,
    length: Length,
    fastest: f64,
    measured: impl Fn(&str) -> Option<f64>,
) -> Vec<Number> {
    let mut all = numbers(case, length, fastest);
    match &case.model {
        Model::Sph(sph) => all.extend(of_inflow(case, sph, ["inflow-m2-per-s", "asked-inflow-m2-per-s"].map(measured))),
        Model::Network(network) => all.extend(of_network(case, network, measured)),
        Model::ThinFilm(_) => {}
    }
    all
}

/// The viscosity ratio of two phases, and the capillary number of what enters through a side.
fn of_inflow(case: &Case, sph: &Sph, [inflow, asked]: [Option<f64>; 2]) -> Vec<Number> {
    let Some(other) = sph.non_wetting.filter(|_| sph.acting_tension() > 0.0) else { return Vec::new() };
    let mut all = vec![Number {
        symbol: "M",
        value: sph.wetting.viscosity / other.viscosity,
        asked: None,
        formula: "mu_w / mu_n",
    }];
    let given = sph.open.iter().enumerate().filter_map(|(number, open)| Some((number, (*open)?)));
    let inlet = given.filter(|(_, open)| !matches!(open.drive, Drive::Pressure(_))).collect::<Vec<_>>();
    // Without a given phase, that which the side had at first enters.
    if let ([(number, open)], Some(inflow)) = (&inlet[..], inflow)
        && let Some(is_wetting) = open.enters_wetting
    {
        let size = Vec2::from(case.geometry.max) - Vec2::from(case.geometry.min);
        let (width, tension) = (size[1 - number / 2], sph.tension);
        let viscosity = if is_wetting { sph.wetting.viscosity } else { other.viscosity };
        all.push(Number {
            symbol: "Ca_in",
            value: viscosity * inflow / width / tension,
            asked: asked.map(|rate| viscosity * rate / width / tension),
            formula: "mu U / sigma of the entering phase, U the inflow over the width of its side",
        });
    }
    all
}

/// Those of a displacement in a network: viscosity ratio, capillary and Bond number.
fn of_network(case: &Case, network: &PoreNetwork, measured: impl Fn(&str) -> Option<f64>) -> Vec<Number> {
    let Some((displacement, interface)) = network.displacement.as_ref().zip(network.interface.as_ref()) else {
        return Vec::new();
    };
    let mut all = Vec::new();
    if let (Some(wetting), Some(other)) = (network.wetting, network.non_wetting) {
        let pair = [wetting.viscosity, other.viscosity];
        let [invading, displaced] = if displacement.process == Process::Imbibition { pair } else { [pair[1], pair[0]] };
        let formula = "viscosity of the invading phase / that of the displaced one";
        all.push(Number { symbol: "M", value: invading / displaced, asked: None, formula });
        let size = Vec2::from(case.geometry.max) - Vec2::from(case.geometry.min);
        let side = network.sides.each().iter().position(|&side| side == Side::Inlet);
        let around = network.inlet_disc.map(|disc| std::f64::consts::TAU * disc.radius);
        if let (Some(dynamic), Some(length)) = (displacement.dynamic, side.map(|side| size[1 - side / 2]).or(around)) {
            let section = length * case.depth.unwrap_or(1.0);
            let asked = match dynamic.drive {
                InTime::Rate(rate) => Some(invading * rate / (section * interface.tension)),
                InTime::PressureDrop(_) => None,
            };
            let formula =
                "mu U / sigma of the invading phase, U the inflow over the inlet side, or around the inlet disc";
            all.push(Number { symbol: "Ca", value: measured("capillary-number").unwrap_or(f64::NAN), asked, formula });
        }
    }
    let bond = measured("bond-number");
    let formula = "|rho_n - rho_w| g L^2 / sigma, L the mean distance between pores";
    all.extend(bond.map(|value| Number { symbol: "Bo", value, asked: None, formula }));
    all
}

/// Contact line speed of the steepest droplet, without the logarithm of lengths, in m/s: an upper bound by an order of magnitude.
fn spreading_speed(film: &ThinFilm) -> f64 {
    let slope = film.droplets.iter().map(|droplet| droplet.height / droplet.half_width).fold(0.0, f64::max);
    film.tension * slope.powi(3) / (3.0 * film.viscosity)
}

/// A thin film has no inertia; what matters is how slow, how flat and how well resolved it is. Droplets: the widest and highest.
fn of_thin_film(film: &ThinFilm, speed: f64) -> Vec<Number> {
    let number = |symbol, value, formula| Number { symbol, value, asked: None, formula };
    let largest = |value: fn(&FilmDroplet) -> f64| film.droplets.iter().map(value).fold(0.0, f64::max);
    let (height, width) = (largest(|droplet| droplet.height), 2.0 * largest(|droplet| droplet.half_width));
    let mut all = vec![
        number("Ca", film.viscosity * speed / film.tension, "mu U / sigma"),
        number("H/W", height / width, "initial height / initial width"),
    ];
    if film.gravity != 0.0 {
        let bond = film.density * film.gravity * width * width / film.tension;
        all.push(number("Bo", bond, "rho g W^2 / sigma"));
    }
    all.push(match film.equation {
        FilmEquation::Geometric(Geometric { smoothing_length }) => {
            number("alpha/dx", smoothing_length / film.spacing, "filter length / spacing")
        }
        FilmEquation::Slip(Slip { slip_length, .. }) => number("slip/H", slip_length / height, "slip length / height"),
        FilmEquation::Precursor(Precursor { film_height, .. }) => {
            number("film/H", film_height / height, "precursor film / height")
        }
    });
    all
}
