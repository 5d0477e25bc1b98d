//! GeoJSON: polygons, multipolygons and collections of these; points with a property `radius` are discs.
//!
//! RFC 7946 gives coordinates in degrees of longitude and latitude, which are meaningless for a pore: the unit must be given by the key or a member `unit` of
//! the file; a member `domain` sets the domain, and another coordinate reference system is mentioned in a note.

use geojson::{Feature, GeoJson, Geometry, GeometryValue, Position};

use crate::import::drawing::{Drawing, Nesting, Outline, Refusal};
use crate::import::text::quoted;
use crate::import::units;
use meniscus_core::math::{Bounds, Vec2};

const EXPECTED: &str = "a FeatureCollection, a Feature or a geometry with polygons, or points with a property `radius`";

/// Reads GeoJSON.
pub(crate) fn read(text: &str) -> Result<Drawing, Vec<Refusal>> {
    let mut reader = Reader::default();
    reader.drawing.nesting = Nesting::FirstIsOuter;
    match text.parse::<GeoJson>() {
        Err(reason) => reader.refuse("file", quoted(text.trim()), format!("{EXPECTED} ({reason})")),
        Ok(GeoJson::Geometry(geometry)) => reader.geometry(&geometry, "geometry", None),
        Ok(GeoJson::Feature(feature)) => reader.feature(&feature, 1),
        Ok(GeoJson::FeatureCollection(collection)) => {
            for (feature, number) in collection.features.iter().zip(1..) {
                reader.feature(feature, number);
            }
        }
    }
    reader.members(text);
    if reader.bad.is_empty() && reader.drawing.entities.is_empty() {
        reader.refuse("file", "no polygon at all".into(), EXPECTED.into());
    }
    if reader.bad.is_empty() { Ok(reader.drawing) } else { Err(reader.bad) }
}

#[derive(Default)]
struct Reader {
    drawing: Drawing,
    bad: Vec<Refusal>,
}

/// Members besides the geometry: `crs` of the former standard, `unit` and `domain` as written by this program.
#[derive(serde::Deserialize, Default)]
struct Members {
    crs: Option<serde_json::Value>,
    unit: Option<serde_json::Value>,
    domain: Option<serde_json::Value>,
}

impl Reader {
    fn members(&mut self, text: &str) {
        let Members { crs, unit, domain } = serde_json::from_str(text).unwrap_or_default();
        if let Some(system) = crs {
            let name = system.pointer("/properties/name").and_then(|name| name.as_str()).unwrap_or("without name");
            self.drawing.notes.push(format!("the file names the coordinate reference system {name}"));
        }
        if let Some(value) = unit {
            match value.as_str().and_then(units::by_name) {
                Some(unit) => self.drawing.unit = Some(unit),
                None => self.refuse("member `unit`", value.to_string(), units::known_units()),
            }
        }
        if let Some(value) = domain {
            match serde_json::from_value::<[f64; 4]>(value.clone()) {
                Ok([x0, y0, x1, y1]) => {
                    self.drawing.frame = Some(Bounds { min: Vec2::new(x0, y0), max: Vec2::new(x1, y1) });
                }
                Err(_) => self.refuse("member `domain`", value.to_string(), "[xmin, ymin, xmax, ymax]".into()),
            }
        }
    }

    fn refuse(&mut self, location: &str, found: String, expected: String) {
        self.bad.push(Refusal { location: location.into(), found, expected });
    }

    fn feature(&mut self, feature: &Feature, number: usize) {
        let location = format!("feature {number}");
        match &feature.geometry {
            Some(geometry) => self.geometry(geometry, &location, feature.property("radius")),
            None => self.drawing.count("features without geometry", 1),
        }
    }

    fn geometry(&mut self, geometry: &Geometry, location: &str, radius: Option<&serde_json::Value>) {
        match &geometry.value {
            GeometryValue::Polygon { coordinates } => self.polygon(coordinates, location),
            GeometryValue::MultiPolygon { coordinates } => {
                for polygon in coordinates {
                    self.polygon(polygon, location);
                }
            }
            GeometryValue::GeometryCollection { geometries } => {
                for one in geometries {
                    self.geometry(one, location, radius);
                }
            }
            GeometryValue::Point { coordinates } => self.points(std::slice::from_ref(coordinates), location, radius),
            GeometryValue::MultiPoint { coordinates } => self.points(coordinates, location, radius),
            GeometryValue::LineString { .. } => self.drawing.count("lines", 1),
            GeometryValue::MultiLineString { coordinates } => self.drawing.count("lines", coordinates.len()),
        }
    }

    fn points(&mut self, points: &[Position], location: &str, radius: Option<&serde_json::Value>) {
        let Some(value) = radius else { return self.drawing.count("points", points.len()) };
        let Some(radius) = value.as_f64().filter(|radius| radius.is_finite() && *radius > 0.0) else {
            return self.refuse(location, format!("the radius {value}"), "a radius above 0".into());
        };
        for point in points {
            match xy(point) {
                Some([x, y]) => {
                    let outline = Outline::Disc { center: Vec2::new(x, y), radius };
                    self.drawing.add(outline, location.into());
                }
                None => self.refuse(location, "a point without x and y".into(), "[x, y]".into()),
            }
        }
    }

    fn polygon(&mut self, coordinates: &[Vec<Position>], location: &str) {
        let lines = coordinates.iter().map(|ring| ring.iter().map(xy).collect()).collect();
        self.bad.extend(self.drawing.add_polygon(lines, location));
    }
}

fn xy(position: &Position) -> Option<[f64; 2]> {
    match *position.as_slice() {
        [x, y, ..] => Some([x, y]),
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn polygons_points_with_a_radius_and_collections_are_read() {
        let text = r#"{"type": "FeatureCollection", "features": [
            {"type": "Feature", "properties": {"radius": 2}, "geometry": {"type": "Point", "coordinates": [1, 5]}},
            {"type": "Feature", "properties": null, "geometry": {"type": "GeometryCollection", "geometries": [
                {"type": "Polygon", "coordinates": [[[0, 0], [1, 0, 7], [0, 1], [0, 0]]]},
                {"type": "Point", "coordinates": [1, 1]}, {"type": "LineString", "coordinates": [[1, 1], [2, 2]]}]}}]}"#;
        let drawing = read(text).unwrap();
        assert_eq!(drawing.entities[0].outline, Outline::Disc { center: Vec2::new(1.0, 5.0), radius: 2.0 });
        assert_eq!(drawing.entities[1].location, "feature 2");
        assert_eq!((drawing.unused["points"], drawing.unused["lines"]), (1, 1));
    }

    #[test]
    fn unit_and_domain_beside_the_features_are_read_or_refused() {
        let of = |members: &str| {
            read(&format!(r#"{{"type": "Polygon", {members} "coordinates": [[[0, 0], [1, 0], [0, 1], [0, 0]]]}}"#))
        };
        let drawing = of(r#""unit": "mm", "domain": [-1, -2, 3, 4],"#).unwrap();
        assert_eq!(drawing.unit.unwrap().meters, 1e-3);
        assert_eq!(drawing.frame.unwrap().max, Vec2::new(3.0, 4.0));
        assert!(of("").unwrap().unit.is_none());
        assert_eq!(of(r#""unit": "ell","#).unwrap_err()[0].location, "member `unit`");
        assert_eq!(of(r#""domain": [1],"#).unwrap_err()[0].location, "member `domain`");
    }

    #[test]
    fn what_cannot_be_a_shape_is_refused_with_its_feature() {
        let of = |geometry: &str| {
            read(&format!(r#"{{"type": "Feature", "properties": {{"radius": -1}}, "geometry": {geometry}}}"#))
                .unwrap_err()
        };
        let ring = of(r#"{"type": "Polygon", "coordinates": [[[0, 0], [1, 0], [0, 1]]]}"#);
        assert!(ring[0].location == "feature 1" && ring[0].expected.contains("first point"), "{}", ring[0]);
        assert!(of(r#"{"type": "Point", "coordinates": [1, 2]}"#)[0].found.contains("-1"));
        assert!(read("{}").is_err() && read("[1, 2").is_err());
        assert!(read(&format!("{}1", "[".repeat(100_000))).is_err(), "a deep file must not exhaust the stack");
    }
}
