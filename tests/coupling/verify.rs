//! Throats by direct simulation, before they run: cut-outs are the throats of the network, and their cases and study load.

use std::path::Path;

use meniscus::study;
use meniscus::verify::choose::{Choice, ChoiceError, choose};
use meniscus::verify::fluids::Fluids;
use meniscus::verify::plan::{Plan, Planned, write};
use meniscus::verify::subdomain::Subdomain;
use meniscus::verify::subject::Subject;
use meniscus_case::load;
use meniscus_core::input::Overrides;
use meniscus_core::math::Vec2;
use meniscus_network::conductance::conductances;
use meniscus_network::displacement::{Conditions, Displacement};
use meniscus_network::extract;
use meniscus_network::graph::Pores;

/// A random pack between walls.
const PACK: &str = "{ random-pack = { seed = 3, porosity = 0.6, radius = 1.0e-4, radius-deviation = 0.2, gap = 2.0e-5, \
                    region = [[0.0, 0.0], [1.6e-3, 1.6e-3]] } }";
/// Posts, turned and not, a hexagon, and a disc near a wall.
const EDGES: &str = "{ rectangle = { center = [4.0e-4, 4.0e-4], size = [3.0e-4, 2.0e-4] } }, \
                     { rectangle = { center = [4.2e-4, 8.0e-4], size = [3.0e-4, 3.0e-4], rotation-deg = 27.0 } }, \
                     { polygon = { outer = [[9.0e-4, 5.0e-4], [1.2e-3, 4.5e-4], [1.3e-3, 7.0e-4], [1.1e-3, 8.0e-4], [8.6e-4, 7.4e-4]] } }, \
                     { disc = { center = [9.0e-4, 1.2e-3], radius = 2.5e-4 } }, \
                     { capsule = { ends = [[1.3e-3, 1.0e-3], [1.35e-3, 1.3e-3]], radius = 1.0e-4 } }";

pub(crate) fn case(shapes: &str, angle: f64, more: &str) -> String {
    format!(
        "format = 1\ntitle = \"Grains\"\n[geometry]\nmin = [0.0, 0.0]\nmax = [1.6e-3, 1.6e-3]\nshapes = [{shapes}]\n\
         [network]\ninlet = \"left\"\noutlet = \"right\"\n{more}\n[network.interface]\ntension = 0.03\n\
         [network.wetting.young]\ncontact-angle-deg = {angle:.1}\n"
    )
}

fn subject(folder: &Path, shapes: &str, angle: f64, set: &[&str]) -> Subject {
    let path = folder.join("grains.toml");
    std::fs::write(&path, case(shapes, angle, "")).unwrap();
    let loaded = load(&path, &Overrides::parse(set).unwrap()).unwrap_or_else(|error| panic!("{}", error.render()));
    Subject::new(&loaded.case).unwrap()
}

/// All throats, each into the region that it is entered into at the larger pressure.
fn planned(subject: &Subject) -> Vec<Planned> {
    let all = Choice::Numbers((0..subject.kept().len()).collect());
    choose(subject, &[all], 1).unwrap().into_iter().map(|chosen| Planned::new(subject, chosen)).collect()
}

/// The throat of the cut-out's own network that stands in the middle: its width, its largest entry curvature.
fn own_throat(subdomain: &Subdomain) -> (f64, f64) {
    let network = extract(&subdomain.solids(false).unwrap(), [false; 4]).unwrap();
    let distance = |throat: usize| {
        let contacts = network.throats[throat].contacts;
        (0.5 * (contacts[0] + contacts[1])).norm()
    };
    let middle = (0..network.throats.len()).min_by(|&a, &b| distance(a).total_cmp(&distance(b))).unwrap();
    let pores = Pores::merged(&network, 1.0);
    let conditions = Conditions::new(vec![subdomain.angle; subdomain.geometry.shapes.len() + 4]);
    let displacement = Displacement::new(&network, &pores, conditions);
    let burst = |to| displacement.passage_through(middle, to).unwrap().0.burst().unwrap().curvature;
    assert!(conductances(&network)[middle] > 0.0);
    (network.throats[middle].width, f64::max(burst(0), burst(1)))
}

#[test]
fn a_cut_out_has_the_throat_and_the_menisci_of_the_network() {
    let folder = tempfile::tempdir().unwrap();
    for (shapes, angle, set, least) in [
        (PACK, 0.0, &[][..], 1.0),
        (PACK, 40.0, &[], 1.0),
        (PACK, 90.0, &[], 1.0),
        (PACK, 140.0, &[], 1.0),
        (PACK, 60.0, &["network.process=\"imbibition\""], 1.0),
        (EDGES, 30.0, &[], 1.0),
        (EDGES, 120.0, &[], 0.5),
    ] {
        let subject = subject(folder.path(), shapes, angle, set);
        let all = planned(&subject);
        let mut cut = 0;
        for one in &all {
            let Ok(subdomain) = &one.subdomain else {
                // Shown where the test fails.
                println!("{angle} degrees, throat {}: {}", one.chosen.number, one.subdomain.as_ref().unwrap_err());
                continue;
            };
            cut += 1;
            let throat = subject.throat(one.chosen.throat);
            let number = one.chosen.number;
            assert!((subdomain.width - throat.width).abs() < 1e-12 * throat.width, "{number}");
            let contacts = throat.contacts.map(|x| subdomain.frame.point(x));
            assert!((contacts[0] + contacts[1]).norm() < 1e-9 * throat.width, "{number}: {contacts:?}");
            assert!(contacts[0].x.abs() < 1e-9 * throat.width, "{number}: {contacts:?}");
            let (width, curvature) = own_throat(subdomain);
            assert!((width - throat.width).abs() < 1e-9 * throat.width, "{number}: {width} {}", throat.width);
            if shapes == EDGES {
                // Where walls go on straight there are edges that the network has not.
                continue;
            }
            let exact = subject.entry(one.chosen.throat).unwrap().1;
            assert!((curvature - exact).abs() < 1e-7 * exact.abs(), "{angle} {number}: {curvature} {exact}");
        }
        // Above 90 degrees contacts go far around edged bodies, to where their walls are no longer known.
        let share = cut as f64 / all.len() as f64;
        assert!(share >= least, "{angle}: {cut} of {}", all.len());
    }
}

#[test]
fn the_invading_phase_ends_at_the_meniscus() {
    let folder = tempfile::tempdir().unwrap();
    let subject = subject(folder.path(), PACK, 40.0, &[]);
    for one in planned(&subject).iter().take(10) {
        let subdomain = one.subdomain.as_ref().unwrap();
        let (passage, _) = subject.passage(one.chosen.throat, one.chosen.to).unwrap();
        let burst = passage.burst().unwrap();
        // The polygon begins along the arc, from the contact on the right to that on the left.
        let outer = &subdomain.behind.outer;
        let [right, left] = [outer[0], outer[1]].map(|[x, y, _]| Vec2::new(x, y));
        assert!((right - subdomain.frame.point(burst.right.point)).norm() < 1e-9 * subdomain.width);
        assert!((left - subdomain.frame.point(burst.left.point)).norm() < 1e-9 * subdomain.width);
        assert!((outer[0][2].atan() * 2.0 - burst.bend.abs()).abs() < 1e-9, "{outer:?} {}", burst.bend);
    }
}

#[test]
fn cases_and_study_load_and_a_case_changed_by_hand_is_kept() {
    let folder = tempfile::tempdir().unwrap();
    let subject = subject(folder.path(), EDGES, 60.0, &[]);
    let fluids =
        Fluids { given: subject.fluids, tension: subject.tension, invading: subject.invading, chip: subject.chip };
    let all = planned(&subject);
    let out = folder.path().join("out");
    let plan = Plan { throats: &all, fluids: &fluids, spacings: &[6, 8], network: "grains.toml" };
    let written = write(&out, &plan).unwrap();
    let study = study::load::load(&written.study.unwrap()).unwrap_or_else(|error| panic!("{}", error.render()));
    let runs = study::runs::plan(&study).unwrap_or_else(|error| panic!("{}", error.render()));
    assert!(runs.len() >= 4 && written.kept.is_empty());
    let changed = &runs[0].run.case;
    let text = std::fs::read_to_string(changed).unwrap();
    std::fs::write(changed, text.replace("3.0e-4", "2.0e-4")).unwrap();
    assert_eq!(write(&out, &plan).unwrap().kept.len(), 1);
    let other = Fluids { tension: 0.05, ..fluids };
    let message = write(&out, &Plan { fluids: &other, ..plan }).unwrap_err().to_string();
    assert!(message.contains("was changed by hand"), "{message}");
}

#[test]
fn no_case_of_a_cut_out_is_refused() {
    let folder = tempfile::tempdir().unwrap();
    let packs = (1..=5).map(|seed| PACK.replace("seed = 3", &format!("seed = {seed}")));
    let lattices = [("square", 1.0e-4), ("square", 1.3e-4), ("hexagonal", 1.0e-4), ("hexagonal", 0.9e-4)].map(|(kind, radius)| {
        format!("{{ array = {{ arrangement = \"{kind}\", radius = {radius:e}, gap = 3.0e-5, region = [[1.0e-5, 1.0e-5], [1.59e-3, 1.59e-3]] }} }}")
    });
    let (mut cut, mut refused) = (0, Vec::new());
    for (number, shapes) in packs.chain(lattices).enumerate() {
        let angle = [40.0, 0.0, 140.0][number % 3];
        let path = folder.path().join("grains.toml");
        std::fs::write(&path, case(&shapes, angle, "")).unwrap();
        let loaded = load(&path, &Overrides::default()).unwrap_or_else(|error| panic!("{}", error.render()));
        let Ok(subject) = Subject::new(&loaded.case) else { continue };
        let fluids =
            Fluids { given: subject.fluids, tension: subject.tension, invading: subject.invading, chip: subject.chip };
        let all = planned(&subject);
        cut += all.iter().filter(|one| one.subdomain.is_ok()).count();
        let plan = Plan { throats: &all, fluids: &fluids, spacings: &[8], network: "grains.toml" };
        let written = write(&folder.path().join(number.to_string()), &plan).unwrap();
        refused.extend(written.refused.into_iter().map(|(_, why)| (number, why)));
    }
    println!("{cut} cut-outs");
    assert!(cut > 300 && refused.is_empty(), "{cut}: {refused:?}");
}

#[test]
fn throats_are_chosen_by_what_they_are() {
    let folder = tempfile::tempdir().unwrap();
    let subject = subject(folder.path(), PACK, 40.0, &[]);
    let critical = choose(&subject, &[Choice::Critical], 1).unwrap();
    assert!(critical[0].reason.contains("sets the pressure"), "{critical:?}");
    let applied = subject.to_breakthrough.as_ref().unwrap().1;
    for one in &critical {
        let entry = subject.entry(one.throat).unwrap().1;
        assert!((entry / applied - 1.0).abs() <= 0.05, "{one:?}: {entry} {applied}");
    }
    let random = |seed| choose(&subject, &["random:5".parse().unwrap()], seed).unwrap();
    assert_eq!(random(1), random(1));
    assert_ne!(random(1), random(2));
    let both = choose(&subject, &[Choice::Numbers(vec![3, 3, 1]), Choice::Numbers(vec![1, 2])], 1).unwrap();
    assert_eq!(both.iter().map(|one| one.number).collect::<Vec<_>>(), [3, 1, 2]);
    assert!(matches!(choose(&subject, &[Choice::Numbers(vec![9999])], 1), Err(ChoiceError::NoThroat { .. })));
    assert!("random".parse::<Choice>().is_err() && "critical".parse() == Ok(Choice::Critical));
}

/// Two discs and a block, 150 µm and more apart.
pub(crate) const DISCS: &str = "{ disc = { center = [8.0e-4, 2.0e-4], radius = 3.0e-4 } }, { disc = { center = [8.0e-4, 9.0e-4], radius = 2.5e-4 } }, \
                     { rectangle = { center = [8.0e-4, 1.4e-3], size = [6.0e-4, 5.0e-4] } }";

#[test]
fn walls_with_other_films_than_the_network_computes_with_have_no_cut_out() {
    let folder = tempfile::tempdir().unwrap();
    let on_all = "network.wetting.patches=[{shape=0,contact-angle-deg=10.0},{shape=1,contact-angle-deg=10.0},{shape=2,contact-angle-deg=10.0}]";
    let all_planned = |depth: &[&str]| planned(&subject(folder.path(), DISCS, 50.0, &[&[on_all], depth].concat()));
    let made = |all: &[Planned]| all.iter().filter(|one| one.subdomain.is_ok()).count();
    let (plane, chip) = (all_planned(&[]), all_planned(&["geometry.depth=1.5e-4"]));
    assert!(made(&plane) > 0 && made(&chip) < made(&plane));
    assert!(
        chip.iter().any(|one| one
            .subdomain
            .as_ref()
            .is_err_and(|why| why.to_string().contains("corner films of the network")))
    );
}
