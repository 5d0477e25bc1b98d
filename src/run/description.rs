//! A case as text, and unusual numbers in it that may be slips: both for a reader before a run.

use super::numbers::{Length, numbers};
use super::slips::rounded;
use meniscus_case::{Case, Fluid, Model, SIDES, Side, Sides, Sph};
use meniscus_core::input::tables::Words;
use meniscus_core::math::Vec2;

/// The parts of a case by name: its phases, its interface and its sides, if it has them.
pub(crate) fn description(case: &Case) -> Vec<(&'static str, String)> {
    let (fluids, interface, sides) = match &case.model {
        Model::Sph(sph) => {
            let law = sph.wetting_model.map(|law| (law.hysteresis_range(), law.table().key));
            let interface = (sph.tension > 0.0).then_some((sph.tension, law, sph.wetting_patches.len()));
            ([Some(sph.wetting), sph.non_wetting], interface, &sph.sides)
        }
        Model::Network(network) => {
            let interface = network.interface.as_ref();
            let law = interface.map(|it| (it.wetting_model.hysteresis_range(), it.wetting_model.table().key));
            let interface = interface.map(|it| (it.tension, law, it.patches.len()));
            ([network.wetting, network.non_wetting], interface, &network.sides)
        }
        Model::ThinFilm(_) => return Vec::new(),
    };
    let [wetting, non_wetting] = fluids.map(|fluid| fluid.map(in_words));
    let phases = match (wetting, non_wetting) {
        (Some(wetting), Some(other)) => Some(format!("wetting {wetting}; non-wetting {other}")),
        (only, other) => only.or(other),
    };
    let interface = interface.map(|(tension, law, patches)| {
        let patches = match patches {
            0 => String::new(),
            1 => ", and one patch of its own".to_owned(),
            count => format!(", and {count} patches of their own"),
        };
        format!(
            "{} mN/m{}{patches}",
            rounded(1e3 * tension),
            law.map_or(String::new(), |(range, name)| angle(range, &name))
        )
    });
    [("phases", phases), ("interface", interface), ("sides", Some(in_order(sides)))]
        .into_iter()
        .filter_map(|(name, text)| Some((name, text?)))
        .collect()
}

/// Numbers that are valid but rarely intended, each with what may have been intended, besides [slips](super::slips) of units.
pub(crate) fn doubts(case: &Case) -> Vec<String> {
    /// Above this Bond number, an interface is flat all over the domain.
    const FLAT: f64 = 1e3;
    let Model::Sph(sph) = &case.model else { return Vec::new() };
    let bond = numbers(case, Length::of(case), 0.0).into_iter().find(|number| number.symbol == "Bo");
    let flat = bond
        .filter(|bond| bond.value > FLAT)
        .map(|bond| format!("Bo is {}: gravity flattens all interfaces; are lengths in m?", rounded(bond.value)));
    flat.into_iter().chain(never_at_rest(sph)).chain(ends_early(case, sph)).collect()
}

/// A slip of contact lines that the spacing does not resolve, and the way out.
pub(crate) fn slip_of_lines(case: &Case) -> Option<String> {
    let Model::Sph(sph) = &case.model else { return None };
    let is_given = sph.has_unresolved_slip()?;
    let [length, spacing] = [sph.walls.line_slip_length, sph.spacing].map(rounded);
    let slip = match is_given {
        true => format!(
            "the slip length of {length:e} m is below the spacing of {spacing:e} m: the speeds of contact lines depend on the spacing"
        ),
        false => "contact lines slip by one spacing, and their speeds depend on it".to_owned(),
    };
    let resolved = if is_given { "give a slip length of at least two spacings" } else { "give sph.walls.slip-length" };
    Some(format!(
        "{slip}: {resolved}, or sph.wetting.cox with the slip length of the wall in nanometers; static states do not depend on it"
    ))
}

/// A weight along an unbounded wall, and a contact line that is not pinned.
fn never_at_rest(sph: &Sph) -> Option<String> {
    let other = sph.non_wetting?;
    let along = [(sph.sides.left, sph.gravity.x), (sph.sides.bottom, sph.gravity.y)];
    let slides = along.into_iter().any(|(side, gravity)| side == Side::Periodic && gravity != 0.0);
    let [receding, advancing] = sph.wetting_model?.hysteresis_range();
    let is_light = sph.wetting.density == other.density;
    (slides && !is_light && sph.acting_tension() > 0.0 && receding == advancing).then(|| {
        "gravity acts along a periodic direction, and the wall has a single contact angle: a drop never comes to rest; \
         [sph.wetting.hysteresis] holds one"
            .to_owned()
    })
}

/// A freely oscillating drop whose run ends before the oscillations have decayed: those of the second mode decay as exp(−4 ν t/R²) in the plane, by Lamb's
/// dissipation, with the radius R of the drop (Lamb 1932, §355).
fn ends_early(case: &Case, sph: &Sph) -> Option<String> {
    let is_alone = sph.open.iter().all(Option::is_none) && sph.wall_speeds == [0.0; 4] && sph.gravity == Vec2::zeros();
    let area = super::setup::drop_area(case).filter(|_| is_alone && sph.acting_tension() > 0.0)?;
    let (radius_squared, viscosity) = (area / std::f64::consts::PI, sph.wetting.viscosity / sph.wetting.density);
    let decay = radius_squared / (4.0 * viscosity);
    (case.end < decay).then(|| {
        format!(
            "oscillations of the drop decay by a factor of e in {} s, and the run ends at {} s, before it is at rest",
            rounded(decay),
            rounded(case.end)
        )
    })
}

fn in_words(fluid: Fluid) -> String {
    format!("{} kg/m3, {} mPa s", rounded(fluid.density), rounded(1e3 * fluid.viscosity))
}

/// The range of angles at rest in rad, with the key of their law.
fn angle(range: [f64; 2], name: &str) -> String {
    let [receding, advancing] = range.map(f64::to_degrees);
    if receding == advancing {
        return format!(", {} degrees through the wetting phase ({name})", rounded(receding));
    }
    format!(", {} to {} degrees through the wetting phase ({name})", rounded(receding), rounded(advancing))
}

fn in_order(sides: &Sides) -> String {
    let named = SIDES.iter().zip(sides.each()).map(|(name, side)| format!("{name} {}", side.word()));
    named.collect::<Vec<_>>().join(", ")
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::run::slips::slips;
    use meniscus_case::load_default;
    use meniscus_core::input::Overrides;

    fn case(overrides: &[&str]) -> Case {
        load_default(&Overrides::parse(overrides).unwrap()).unwrap().case
    }

    #[test]
    fn a_case_is_described_in_words() {
        let found = description(&case(&[]));
        assert_eq!(found[0].0, "phases");
        assert!(found[0].1.starts_with("wetting 773") && found[0].1.contains("; non-wetting "), "{}", found[0].1);
        assert!(found[1].1.contains("mN/m, 40 degrees through the wetting phase (young)"), "{}", found[1].1);
        assert!(found[2].1.starts_with("left "), "{}", found[2].1);
    }

    #[test]
    fn slips_of_units_are_noticed_and_usual_cases_are_right() {
        let all = |case: &Case| slips(case).into_iter().chain(doubts(case)).collect::<Vec<_>>();
        assert_eq!(all(&case(&[])), [""; 0]);
        let noticed = |overrides: &[&str], word: &str| {
            let found = all(&case(overrides));
            assert!(found.iter().any(|doubt| doubt.contains(word)), "{word}: {found:?}");
        };
        noticed(&["sph.interface.tension=27.6"], "27.6 N/m");
        noticed(&["sph.wetting.young.contact-angle-deg=0.7"], "not in radians");
    }
}
