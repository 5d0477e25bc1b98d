//! The page of a displacement in two squares.

use super::*;
use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use meniscus_core::diagram::{Frame, Through};
use meniscus_core::playback::{Change, Edge, Holding, Passage, PlayedArea, Stage};
use meniscus_core::table::{Cells, Column, Table};

fn table(columns: Vec<(&'static str, Cells)>) -> Table {
    Table { name: "", columns: columns.into_iter().map(|(name, cells)| Column { name, cells }).collect() }
}

/// Two squares of 1 m side by side, the left one with a half circle as its left wall; the second is filled by the second event.
fn playback() -> Playback {
    let edge = |x: f64, y: f64, sweep: f64, is_wall| Edge { start: [x, y], sweep, is_wall };
    let square = |x: f64, sweep| {
        vec![
            edge(x, 0.0, sweep, true),
            edge(x, 1.0, 0.0, true),
            edge(x + 1.0, 1.0, 0.0, false),
            edge(x + 1.0, 0.0, 0.0, true),
        ]
    };
    let area = |pore: usize, sweep| PlayedArea { boundary: square(pore as f64, sweep), area: 1.0, pore };
    let open = [Some(Through::In), Some(Through::Out), None, None];
    Playback {
        frame: Frame { bounds: [[0.0, 0.0], [2.0, 1.0]], open, periodic: [false; 2] },
        areas: vec![area(0, std::f64::consts::PI), area(1, 0.0)],
        passages: vec![Passage { areas: [0, 1], ends: [[1.0, 0.0], [1.0, 1.0]], throat: Some(0) }],
        pores: table(vec![("area_m2", Cells::Numbers(vec![1.0, 1.0]))]),
        throats: table(vec![("width_m", Cells::Numbers(vec![1.0]))]),
        events: table(vec![
            ("event", Cells::Words(vec!["beginning", "burst", "burst"])),
            ("throat", Cells::Indices(vec![None, None, Some(0)])),
            ("saturation", Cells::Numbers(vec![1.0, 0.5, 0.0])),
        ]),
        curve: None,
        stages: vec![Stage { name: "drainage".into(), first: 0, wetting_invades: false, open, breakthrough: Some(2) }],
        changes: vec![
            Change { row: 1, area: 0, holding: Holding::Invaded },
            Change { row: 2, area: 1, holding: Holding::Invaded },
        ],
        films: None,
        depth: Some(1.0e-4),
    }
}

fn data_of(page: &str) -> serde_json::Value {
    let (_, rest) = page.split_once("<script type=\"application/json\" id=\"data\">").unwrap();
    serde_json::from_str(rest.split_once("</script>").unwrap().0).unwrap()
}

fn bytes(column: &serde_json::Value, kind: &str) -> Vec<u8> {
    assert_eq!(column["type"], kind);
    STANDARD.decode(column["base64"].as_str().unwrap()).unwrap()
}

#[test]
fn a_page_holds_its_data_as_columns_and_ends_none_of_its_elements_early() {
    let title = "a < b </script> & {{data}}";
    let html = page(title, &[(title, &playback())]).unwrap();
    assert!(html.contains("<title>a &lt; b &lt;/script&gt; &amp; {{data}}</title>"));
    let data = data_of(&html);
    assert_eq!((data["title"].as_str(), &data["runs"][0]["depth"]), (Some(title), &serde_json::json!(1.0e-4)));
    assert_eq!(data["colors"]["wetting"][0], "#56b4e9");
    let run = &data["runs"][0];
    assert_eq!(bytes(&run["events"]["throat"], "u8"), [0, 0, 1]);
    assert_eq!(bytes(&run["events"]["saturation"], "f32"), [1.0_f32, 0.5, 0.0].map(f32::to_le_bytes).concat());
    assert_eq!(run["events"]["event"]["words"], serde_json::json!(["beginning", "burst"]));
    assert_eq!(bytes(&run["changes"]["rows"], "u8"), [1, 1]);
    assert_eq!(bytes(&run["areas"]["edges"], "u8"), [4, 4]);
    // From 0 to 2 m in 65535 steps.
    let x: Vec<u8> = [0_u16, 0, 32768, 32768, 32768, 32768, 65535, 65535].map(u16::to_le_bytes).concat();
    assert_eq!(bytes(&run["areas"]["x"], "u16"), x);
    let sweeps = bytes(&run["areas"]["sweep"], "i16");
    assert_eq!(sweeps[..6], [32000_i16, 0, i16::MIN].map(i16::to_le_bytes).concat());
    assert_eq!(run["stages"][0]["open"], serde_json::json!(["in", "out", "", ""]));
}

#[test]
fn a_page_names_no_other_file_and_no_address() {
    let html = page("Squares", &[("Squares", &playback())]).unwrap();
    for word in ["http:", "https:", "src=", "href=", "@import", "url("] {
        assert!(!html.contains(word), "{word}");
    }
}

#[test]
fn too_many_pores_are_refused() {
    let many = MOST_PORES + 1;
    let pores = table(vec![("area_m2", Cells::Numbers(vec![1.0; many]))]);
    assert_eq!(page("", &[("", &Playback { pores, ..playback() })]), Err(TooMany(many)));
}
