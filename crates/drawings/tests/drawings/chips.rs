//! Ten chips as labs draw them, by ezdxf, svgwrite, gdstk and KLayout: each from file to porosity with at most one question. `chips.py` drew them, with the
//! area of each in closed form.

use meniscus_drawings::import::Options;
use meniscus_drawings::load;
use serde_json::{Value, json};

use crate::contents::porosity;
use crate::files::file;

#[test]
fn chips_as_labs_draw_them_are_read_with_one_question_at_most() {
    let right: Value = serde_json::from_slice(&std::fs::read(file("chips/chips.json")).unwrap()).unwrap();
    for (name, chip) in right.as_object().unwrap() {
        let path = file(&format!("chips/{name}"));
        let with = |answer: Value| {
            let mut options = answer;
            options["unit"] = chip["unit"].clone();
            load(&path, &serde_json::from_value::<Options>(options).unwrap())
        };
        let answer = &chip["options"];
        if !answer.is_null() {
            let asked = with(json!({})).unwrap_err().to_string();
            let key = answer.as_object().unwrap().keys().next().unwrap();
            assert!(asked.contains("two ways") && asked.contains(&format!("--{key} ")), "{name}: {asked}");
        }
        let answer = if answer.is_null() { json!({}) } else { answer.clone() };
        let found = porosity(&with(answer).unwrap_or_else(|error| panic!("{name}: {error}")).spec);
        // GDS has circles as polygons, on a grid of a nanometer; SVG has seven digits.
        let slack = if name.starts_with("gds") { 2e-4 } else { 1e-6 };
        println!("{name:22} {found:.6} {:.6}", chip["porosity"]);
        assert!((found - chip["porosity"].as_f64().unwrap()).abs() < slack, "{name}: {found} {}", chip["porosity"]);
    }
}
