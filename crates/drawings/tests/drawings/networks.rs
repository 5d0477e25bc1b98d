//! Tables of pores and throats as drawings: every pore a disc, every throat a channel of its width, labeled pores open at their sides.

use std::path::Path;

use meniscus_drawings::import::{Imported, Options};
use meniscus_drawings::load;
use meniscus_geometry::Geometry;
use meniscus_geometry::spec::{ShapeSpec, SolidSide};

use crate::contents::*;
use crate::files::file;

/// Two pores joined by a throat, which passes a place beside their line, and a third one behind the second.
const PORES: &str = "pore,x_m,y_m,inscribed_radius_m,inlet,outlet\n0,0,0,4e-4,True,False\n1,2e-3,0,3e-4,False,False\n2,4e-3,2e-4,5e-4,False,True\n";
const THROATS: &str = "throat,pore_1,pore_2,x_m,y_m,width_m\n0,0,1,1e-3,2e-4,1e-4\n1,1,2,,,2e-4\n";

fn in_folder(files: &[(&str, &str)], read: &str) -> Result<Imported, String> {
    let folder = tempfile::tempdir().unwrap();
    for (name, text) in files {
        std::fs::write(folder.path().join(name), text).unwrap();
    }
    load(&folder.path().join(read), &Options::default()).map_err(|error| error.to_string())
}

/// Widths of the channels of throats, which come first, each beginning across its first pore: from the last vertex to the first.
fn widths(found: &Imported) -> Vec<f64> {
    let width = |shape: &ShapeSpec| {
        let points: Vec<[f64; 2]> = match shape {
            ShapeSpec::Polygon(polygon) => polygon.outer.clone(),
            ShapeSpec::CurvedPolygon(polygon) => polygon.outer.iter().map(|v| [v[0], v[1]]).collect(),
            _ => return None,
        };
        let (a, b) = (points[points.len() - 1], points[0]);
        Some((a[0] - b[0]).hypot(a[1] - b[1]))
    };
    found.spec.shapes.iter().filter_map(width).collect()
}

#[test]
fn a_network_of_openpnm_has_all_its_pores_throats_and_labeled_sides() {
    let found = imported("network-openpnm.csv", &Options::default());
    let text = std::fs::read_to_string(file("network-openpnm.csv")).unwrap();
    let rows: Vec<Vec<&str>> = text.lines().map(|line| line.split(',').collect()).collect();
    let column = |name: &str| rows[0].iter().position(|known| *known == name).unwrap();
    let numbers = |name: &str| {
        let column = column(name);
        rows[1..].iter().filter_map(move |row| row[column].parse::<f64>().ok()).collect::<Vec<f64>>()
    };
    assert_eq!(found.spec.solid, SolidSide::Outside);
    // The plane is that of x and z.
    let pores = numbers("pore.coords[0]").into_iter().zip(numbers("pore.coords[2]")).zip(numbers("pore.diameter"));
    let geometry = Geometry::new(&found.spec).unwrap();
    for ((x, z), d) in pores {
        let room = geometry.signed_distance([x, z].into()) / (0.5 * d);
        assert!(room > 1.0 - 1e-9, "{room}");
        // Those at sides are one outline with their openings, and may have no wall of their own.
        let is_inner = x > 1e-3 && x < 5e-3 && z > 1e-3 && z < 3e-3;
        let is_disc =
            discs(&found.spec).iter().any(|disc| disc.center == [x, z] && (2.0 * disc.radius / d - 1.0).abs() < 1e-15);
        assert_eq!(is_inner, is_disc, "{x} {z}");
    }
    let widths = widths(&found);
    let throats = numbers("throat.diameter");
    assert!(throats.len() == 38 && widths.len() > 38, "{} {}", throats.len(), widths.len());
    for (width, expected) in widths.iter().zip(&throats) {
        assert!((width / expected - 1.0).abs() < 1e-9, "{width} {expected}");
    }
    let notes = found.notes.join("\n");
    assert!(notes.contains("24 pores as discs, 38 throats and 20 openings") && !notes.contains("overlap"), "{notes}");
    // The first pores of the file lie at the left side.
    for z in &numbers("pore.coords[2]")[..4] {
        assert!(!geometry.is_solid([found.spec.min[0] + 1e-7, *z].into()));
    }
}

#[test]
fn either_table_of_a_pair_gives_the_network_and_a_throat_passes_its_middle() {
    let files = [("pores.csv", PORES), ("throats.csv", THROATS)];
    let found = in_folder(&files, "pores.csv").unwrap();
    assert_eq!(found.spec, in_folder(&files, "throats.csv").unwrap().spec);
    let other = [("chip_pores.csv", PORES), ("chip_throats.csv", THROATS)];
    assert_eq!(found.spec, in_folder(&other, "chip_throats.csv").unwrap().spec);
    let geometry = Geometry::new(&found.spec).unwrap();
    let is_pore = |x: f64, y: f64| !geometry.is_solid([x, y].into());
    assert!(is_pore(1e-3, 2e-4) && !is_pore(1e-3, 0.0) && is_pore(2.9e-3, 0.9e-4));
    // Inlet and outlet are as wide as their pores at the left and right side, all else is closed.
    assert!(is_pore(found.spec.min[0], 3.9e-4) && !is_pore(found.spec.min[0], 4.1e-4));
    assert!(is_pore(found.spec.max[0], 6.9e-4) && !is_pore(found.spec.max[0], -3.1e-4));
    assert_eq!((found.spec.shapes.len(), discs(&found.spec).len()), (5, 1));
}

#[test]
fn a_boundary_pore_is_the_opening_of_the_pore_behind_it_and_sets_the_side() {
    let text = "pore.coords[0],pore.coords[1],pore.diameter,pore.boundary,pore.left,throat.conns[0],throat.conns[1],throat.diameter\n\
                1,1,0.6,False,False,0,1,0.2\n3,1,0.8,False,False,0.0,2.0,0.4\n0.2,1.5,,True,True,,,\n";
    let found = in_folder(&[("a.csv", text)], "a.csv").unwrap();
    let geometry = Geometry::new(&found.spec).unwrap();
    assert_eq!((found.spec.min[0], discs(&found.spec).len()), (0.2, 2));
    // As near to the boundary pore as the disc behind allows: its center line is at 1 + 0.3 - 0.2.
    let open = |y: f64| !geometry.is_solid([0.2, y].into());
    assert!(open(1.29) && open(0.91) && !open(1.31) && !open(0.89));
}

#[test]
fn overlaps_that_change_the_network_are_told_with_their_numbers() {
    let pores = "pore,x_m,y_m,inscribed_radius_m\n0,0,0,0.1\n1,2,2,0.1\n2,0,2,0.1\n3,2,0,0.1\n4,3,0,0.95\n";
    let throats = "pore_1,pore_2,width_m\n0,1,0.1\n2,3,0.1\n3,4,0.05\n";
    let found = in_folder(&[("pores.csv", pores), ("throats.csv", throats)], "pores.csv").unwrap();
    let notes = found.notes.join("\n");
    assert!(notes.contains("overlaps (2)") && notes.contains("throat 0 and throat 1"), "{notes}");
    assert!(notes.contains("pore 3 and throat 2"), "{notes}");
    assert!(notes.contains("no openings"), "{notes}");
}

#[test]
fn a_list_of_discs_in_a_csv_stays_one() {
    let text = "pore,x_m,y_m,inscribed_radius_m\n0,1,1,0.25\n";
    let folder = tempfile::tempdir().unwrap();
    let path = |name: &str| folder.path().join(name);
    std::fs::write(path("pores.csv"), text).unwrap();
    let by_columns = Options { columns: Some([1, 2, 3]), ..Options::default() };
    let radius = |path: &Path, options: &Options| discs(&load(path, options).unwrap().spec)[0].radius;
    assert_eq!(radius(&path("pores.csv"), &by_columns), 0.25);
    std::fs::write(path("list.csv"), "x_m,y_m,r_m\n1,1,0.5\n").unwrap();
    assert_eq!(radius(&path("list.csv"), &Options::default()), 0.5);
}
