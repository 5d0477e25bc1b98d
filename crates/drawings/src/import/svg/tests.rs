use std::f64::consts::PI;

use proptest::prelude::*;

use super::*;
use crate::import::drawing::seen::{area, counts, discs, only};
use crate::import::drawing::{FillRule, Outline, Paint};
use meniscus_core::math::Vec2;

fn page(attributes: &str, content: &str) -> String {
    format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" xmlns:xlink=\"http://www.w3.org/1999/xlink\" \
         xmlns:inkscape=\"http://www.inkscape.org/namespaces/inkscape\" {attributes}>\n{content}\n</svg>"
    )
}

fn drawn(content: &str) -> Drawing {
    read(&page("viewBox=\"0 0 100 50\"", content), None).unwrap()
}

fn disc(drawing: &Drawing) -> (Vec2, f64) {
    let [disc] = discs(drawing)[..] else { panic!("{drawing:?}") };
    disc
}

fn radii(drawing: &Drawing) -> Vec<f64> {
    discs(drawing).iter().map(|disc| disc.1).collect()
}

#[test]
fn a_circle_in_any_notation_is_the_same_disc() {
    for content in [
        "<circle cx='10' cy='20' r='5'/>",
        "<ellipse cx='10' cy='20' rx='5' ry='5'/>",
        "<ellipse cx='10' cy='20' rx='5'/>",
        "<rect x='5' y='15' width='10' height='10' rx='5'/>",
        "<rect x='5' y='15' width='10' height='10' rx='9' ry='7'/>",
        "<path d='M5 20a5 5 0 0 1 10 0a5 5 0 0 1 -10 0z'/>",
        "<path d='M 5,20 A 5 5 0 1 0 15,20 5 5 0 1 0 5 20'/>",
        // A quarter and three quarters.
        "<path d='M15 20A5 5 0 0 1 10 25A5 5 0 1 1 15 20z'/>",
        // Radii too small for the distance are enlarged.
        "<path d='M5 20a1 1 0 0 1 10 0a1 1 0 0 1 -10 0z'/>",
        "<g transform='translate(10 20)'><g transform='rotate(33)'><circle r='2.5' transform='scale(-2,2)'/></g></g>",
        "<g transform='scale(5)'><circle cx='2' cy='4' r='1'/></g>",
        "<circle cx='10' cy='20' r='50' transform='translate(10 20) scale(.1) translate(-10 -20)'/>",
        "<g transform='skewX(30) scale(1 2)'><g transform='scale(1 .5)'><circle transform='skewX(-30)' cx='10%' cy='40%' r='5'/></g></g>",
    ] {
        let (center, radius) = disc(&drawn(content));
        assert!((center - Vec2::new(10.0, 30.0)).norm() < 1e-7, "{content}: {center}");
        assert!((radius - 5.0).abs() < 1e-13, "{content}: {radius}");
    }
}

#[test]
fn small_and_large_numbers_keep_their_arcs() {
    // kurbo 0.13 and others treat radii below 1e-5 as lines.
    for scale in [1e-9, 1.0, 1e9] {
        let [a, b] = [scale, 2.0 * scale];
        let drawing = drawn(&format!("<path d='M0 0a{a} {a} 0 0 1 {b} 0a{a} {a} 0 0 1 -{b} 0z'/>"));
        assert!((disc(&drawing).1 / scale - 1.0).abs() < 1e-13);
    }
}

#[test]
fn areas_of_all_commands_are_those_of_closed_formulas() {
    for (data, expected, tolerance) in [
        ("M1 2h4v3h-4z", 12.0, 1e-14),
        ("M1 2H5V5H1", 12.0, 1e-14),
        ("m1,2l4,0 0,3L1 5Z", 12.0, 1e-14),
        ("M1 2 5 2 5 5 1 5z", 12.0, 1e-14),
        // Between a parabola and its chord: two thirds of base times height.
        ("M0 0Q2 4 4 0z", 2.0 / 3.0 * 4.0 * 2.0, 1e-4),
        ("M0 0q2 4 4 0t4 0T12 0z", 2.0 / 3.0 * 4.0 * 2.0, 1e-4),
        // x = 3t² - 2t³ over 4, y = 6 t (1-t): area 3/5 of 4 times 3... by Green's theorem 14.4/2.
        ("M0 0C0 2 4 2 4 0z", 4.8, 1e-4),
        ("M0 0c0 2 4 2 4 0s4-2 4 0S12 2 12 0z", 4.8, 1e-4),
        // Half an ellipse, rotated; a quarter with a large remainder.
        ("M-2 0A2 1 0 0 1 2 0z", PI, 1e-4),
        ("M0-2A2 1 90 0 1 0 2z", PI, 1e-4),
        ("M2 0A2 1 0 1 0 0 1L0 0z", 1.5 * PI, 1e-4),
        // The large one with positive direction has its center in the far corner.
        ("M2 0A2 1 0 1 1 0 1L0 0z", 1.5 * PI + 2.0, 1e-4),
        ("M2 0A2 1 0 0 0 0-1L0 0z", 0.5 * PI, 1e-4),
    ] {
        let drawing = drawn(&format!("<path d='{data}'/>"));
        let found = area(only(&drawing));
        assert!((found - expected).abs() < tolerance * expected, "{data}: {found} {expected}");
    }
}

#[test]
fn transforms_change_areas_by_their_determinant_and_move_centers() {
    // rotate and scale about a point, skew, all nested: determinant 2 * 3 * 1 * 4.
    let content = "<g transform='translate(3,4) rotate(27 1 2)'><g transform='scale(2 3)'><g transform='skewX(20)'>\
                   <path transform='matrix(2 0 0 2 1 1)' d='M0 0h1v1h-1z'/></g></g></g>";
    let outline = only(&drawn(content)).clone();
    assert!((area(&outline) - 24.0).abs() < 1e-12);
    let Outline::Area { rings, .. } = outline else { panic!() };
    let center = rings[0].vertices.iter().map(|v| Vec2::new(v[0], v[1])).sum::<Vec2>() / 4.0;
    // Manually from the inside out: (1.5, 1.5) here is (2, 2) before the skew.
    let inner = Vec2::new(2.0 + 20f64.to_radians().tan() * 2.0, 2.0).component_mul(&Vec2::new(2.0, 3.0));
    let turned = nalgebra::Rotation2::new(27f64.to_radians()) * (inner - Vec2::new(1.0, 2.0)) + Vec2::new(4.0, 6.0);
    assert!((center - Vec2::new(turned.x, 50.0 - turned.y)).norm() < 1e-12, "{center}");
}

#[test]
fn css_moves_shapes_and_what_it_says_beyond_transforms_is_refused_with_its_line() {
    for content in [
        "<circle r='5' style='transform: translate(10px, 30px)'/>",
        "<style>#a{transform:translate(10px) translateY(30px)}</style><circle id='a' r='5' transform='scale(9)'/>",
        "<g style='transform:scale(.5)'><circle cx='20' cy='60' r='10'/></g>",
        "<circle cx='50' cy='25' r='5' style='transform: translate(-40px, 5px) rotate(1turn); transform-origin: center'/>",
        "<symbol id='s' style='transform:translate(10px,30px)'><circle r='5'/></symbol><use href='#s'/>",
    ] {
        let (center, radius) = disc(&drawn(content));
        assert!((center - Vec2::new(10.0, 20.0)).norm() < 1e-12 && (radius - 5.0).abs() < 1e-12, "{content}: {center}");
    }
    for (style, found) in [
        ("transform: rotateY(20deg)", "`transform: rotateY(20deg)`"),
        ("transform: translate(1em)", "`transform: translate(1em)`"),
        ("transform: rotate(20deg); transform-box: fill-box", "`transform-box: fill-box`"),
        ("rotate: 20deg", "`rotate: 20deg` in its style"),
        ("r: 7px", "`r: 7px` in its style"),
    ] {
        let text = page("viewBox='0 0 100 50'", &format!("<circle r='2' style='{style}'/>"));
        let refusals = read(&text, None).unwrap_err();
        let message = refusals[0].to_string();
        assert!(message.starts_with("line 2: found ") && message.contains(found), "{message}");
    }
}

#[test]
fn holes_follow_the_fill_rule_and_the_direction() {
    let rings = "M0 0h9v9h-9zM3 3v3h3v-3z";
    let Outline::Area { rings: nonzero, rule } = only(&drawn(&format!("<path d='{rings}'/>"))).clone() else {
        panic!()
    };
    assert_eq!((nonzero.len(), rule), (2, FillRule::NonZero));
    assert!((nonzero[0].area() + nonzero[1].area()).abs() - 72.0 < 1e-12, "opposite directions");
    for style in ["fill-rule='evenodd'", "style='fill-rule: evenodd'", "class='odd'"] {
        let sheet =
            "<style>/* .odd {fill: none} */ path.even {fill-rule: nonzero} .odd, g path {fill-rule:evenodd}</style>";
        let drawing = drawn(&format!("{sheet}<path d='{rings}' {style}/>"));
        assert!(matches!(only(&drawing), Outline::Area { rule: FillRule::EvenOdd, .. }), "{style}");
    }
    // A ring of two circles in one path keeps both directions.
    let annulus = "<path d='M0 5a5 5 0 0 1 10 0a5 5 0 0 1 -10 0zM2 5a3 3 0 0 0 6 0a3 3 0 0 0 -6 0z'/>";
    assert!((area(only(&drawn(annulus))) - 16.0 * PI).abs() < 1e-12);
}

#[test]
fn copies_stand_where_use_puts_them() {
    let content = "<defs><g id='pair'><circle id='one' cx='1' cy='1' r='1'/><use href='#one' x='5'/></g>\
        <symbol id='page' viewBox='0 0 10 10'><circle cx='5' cy='5' r='5'/></symbol></defs>\
        <use xlink:href='#pair' transform='translate(10 10)' y='2'/>\
        <use href='#page' x='30' y='10' width='20' height='40'/>";
    let drawing = drawn(content);
    let expected = [([11.0, 37.0], 1.0), ([16.0, 37.0], 1.0), ([40.0, 20.0], 10.0)];
    assert_eq!(drawing.entities.len(), 3);
    for ((center, radius), (at, size)) in discs(&drawing).into_iter().zip(expected) {
        assert!((center - Vec2::from(at)).norm() < 1e-13 && (radius - size).abs() < 1e-13, "{center} {radius}");
    }
}

#[test]
fn the_page_gives_unit_scale_and_frame() {
    let circle = "<circle cx='10' cy='10' r='5'/>";
    let wide = "width='4in' height='1in' viewBox='0 0 100 50'";
    let [right, slice] = ["xMaxYMid", "xMidYMin slice"].map(|how| format!("{wide} preserveAspectRatio='{how}'"));
    let inkscape = [2.6458333333333335, 45.354166666666664];
    for (attributes, unit, radius, center, size) in [
        ("width='50mm' height='25mm' viewBox='0 0 100 50'", Some("mm"), 2.5, [5.0, 20.0], Some([50.0, 25.0])),
        ("width='50mm' viewBox='0 0 100 50'", Some("mm"), 2.5, [5.0, 20.0], Some([50.0, 25.0])),
        ("width='5cm' height='25mm' viewBox='0 0 100 50'", Some("cm"), 0.25, [0.5, 2.0], Some([5.0, 2.5])),
        // Old Inkscape: no view box, user units are px.
        ("width='96mm' height='48mm'", Some("mm"), 5.0 * 25.4 / 96.0, inkscape, Some([96.0, 48.0])),
        ("width='200px' height='100px' viewBox='0 0 100 50'", Some("px"), 10.0, [20.0, 80.0], Some([200.0, 100.0])),
        ("viewBox='5 5 100 50'", None, 5.0, [5.0, 45.0], Some([100.0, 50.0])),
        ("width='100%' viewBox='0 0 100 50'", None, 5.0, [10.0, 40.0], Some([100.0, 50.0])),
        ("", None, 5.0, [10.0, -10.0], None),
        // Centered in a page twice as wide as its view box; stretched to it.
        (wide, Some("in"), 0.1, [1.2, 0.8], Some([4.0, 1.0])),
        (&right, Some("in"), 0.1, [2.2, 0.8], Some([4.0, 1.0])),
        (&slice, Some("in"), 0.2, [0.4, 0.6], Some([4.0, 1.0])),
    ] {
        let drawing = read(&page(attributes, circle), None).unwrap();
        let (found, found_radius) = disc(&drawing);
        assert_eq!(drawing.unit.as_ref().map(|unit| unit.name.as_str()), unit, "{attributes}");
        assert!((found - Vec2::from(center)).norm() < 1e-12, "{attributes}: {found}");
        assert!((found_radius - radius).abs() < 1e-13, "{attributes}: {found_radius}");
        assert_eq!(drawing.frame.is_some(), size.is_some(), "{attributes}");
        if let Some((frame, size)) = drawing.frame.zip(size) {
            assert!((frame.size() - Vec2::from(size)).norm() < 1e-12 && frame.min == Vec2::zeros());
        }
    }
    let stretched = read(&page(&format!("{wide} preserveAspectRatio='none'"), circle), None);
    assert!((area(only(&stretched.unwrap())) - 25.0 * PI * 0.04 * 0.02).abs() < 1e-6);
}

#[test]
fn nested_pages_have_their_own_view_box() {
    let content = "<svg x='20' y='10' width='20' height='20' viewBox='0 0 10 10'><circle cx='50%' cy='5' r='2'/></svg>";
    let (center, radius) = disc(&drawn(content));
    assert!((center - Vec2::new(30.0, 30.0)).norm() < 1e-13 && (radius - 4.0).abs() < 1e-13);
}

#[test]
fn what_is_not_seen_is_not_read_but_counted() {
    let circle = "<circle r='1'/>";
    let content = format!(
        "<style>.off {{display: none !important}} @media print {{ circle {{display: none}} }}</style>\
         <g display='none'>{circle}</g><g class='a off'>{circle}</g><g visibility='hidden'>{circle}<circle r='2' visibility='visible'/></g>\
         <g fill='none'>{circle}</g><defs>{circle}</defs><clipPath id='c'>{circle}</clipPath><mask>{circle}</mask>\
         <pattern>{circle}</pattern><marker>{circle}</marker><text>x</text><text>y</text><image/>\
         <line x2='5' stroke='red'/><path d='M0 0h5' fill='none' stroke='#000'/><circle r='0'/><g style='opacity:0'>{circle}</g>\
         <switch><foreignObject requiredExtensions='x'/><circle r='3' clip-path='url(#c)'/><circle r='9'/></switch>"
    );
    let drawing = drawn(&content);
    assert_eq!(radii(&drawing), [2.0, 3.0]);
    assert_eq!(counts(&drawing.unused), [("hidden elements", 5), ("image", 1), ("open lines", 2), ("text", 2)]);
    assert_eq!(drawing.notes, ["1 elements have a clip or a mask, which is not applied."]);
}

#[test]
fn closed_outlines_without_fill_are_shapes_and_open_ones_are_not() {
    let drawing = drawn(
        "<g style='fill:none;stroke:black'><path d='M0 0h3v3h-3z'/><path d='M0 0h3v3h-3'/><polygon points='0,0 1,0 1,1'/>\
         <polyline points='0 0 1 0 1 1'/><polyline points='0 0 1 0 1 1 0 0'/></g>",
    );
    assert_eq!(drawing.entities.len(), 3);
    assert_eq!(drawing.unused["open lines"], 2);
    assert_eq!(drawing.notes, ["3 closed outlines without fill are taken for shapes."]);
}

#[test]
fn white_is_white_however_it_is_written() {
    let gradient = "<defs><linearGradient id='g'><stop offset='0' stop-color='#fff'/><stop offset='1' style='stop-color:white'/>\
                    </linearGradient><linearGradient id='h' href='#g'/><linearGradient id='k'><stop stop-color='red'/></linearGradient></defs>";
    for white in ["#FEFEFE", "rgb(255,255,255)", "#fff icc-color(x, 0, 0, 0, 0)", "url(#g)", "url(#h)", "currentColor"]
    {
        let text =
            format!("{gradient}<g color='white'><rect width='10' height='5'/><circle r='3' fill='{white}'/></g>");
        assert_eq!(drawn(&text).entities[1].paint, Paint::White, "{white}");
    }
    for other in ["url(#k)", "#f0f0f0", "currentColor"] {
        let text = format!("{gradient}<rect width='10' height='5'/><circle r='3' fill='{other}'/>");
        assert_eq!(drawn(&text).entities[1].paint, Paint::Filled, "{other}");
    }
}

#[test]
fn elements_for_other_languages_and_extensions_are_not_drawn() {
    let german = "<rect systemLanguage='de' width='3' height='3'/>";
    let english = "<rect systemLanguage='fr, en-GB' width='2' height='2'/>";
    let plain = "<rect width='1' height='1'/>";
    let switch = format!("<switch>{german}{plain}{english}</switch>");
    let all = format!("{german}{english}{plain}<rect requiredExtensions='http://a' width='9' height='9'/>");
    assert_eq!([switch, all].map(|text| drawn(&text).entities.len()), [1, 2]);
}

#[test]
fn shapes_are_white_only_where_others_are_not() {
    let white = "<rect width='100' height='50' style='fill: #ffffff'/>";
    assert_eq!(drawn(white).entities.len(), 1);
    assert_eq!(drawn(white).entities[0].paint, Paint::Filled);
    let drawing = drawn(&format!("{white}<circle r='3'/><circle r='2' fill='none' stroke='red'/>"));
    let paints: Vec<&Paint> = drawing.entities.iter().map(|entity| &entity.paint).collect();
    assert_eq!(paints, [&Paint::White, &Paint::Filled, &Paint::Unfilled { layer: String::new() }]);
}

#[test]
fn layers_are_chosen_by_label_or_id_and_counted() {
    let text = page(
        "viewBox='0 0 9 9'",
        "<g inkscape:groupmode='layer' inkscape:label='posts' id='layer1'><circle r='1'/><g id='inner'><circle r='2'/></g></g>\
         <g id='frame'><circle r='3'/></g><circle r='4'/>",
    );
    let radii_on = |layers: &[&str]| {
        let layers: Vec<String> = layers.iter().map(|layer| (*layer).to_owned()).collect();
        let drawing = read(&text, Some(&layers)).unwrap();
        assert_eq!(counts(&drawing.layers), [("frame", 1), ("posts", 2)]);
        assert_eq!(drawing.unused["elements on other layers"], 4 - drawing.entities.len());
        radii(&drawing)
    };
    assert_eq!([radii_on(&["posts"]), radii_on(&["layer1"])], [[1.0, 2.0]; 2]);
    assert_eq!(radii_on(&["inner", "frame"]), [2.0, 3.0]);
    let refusals = read(&text, Some(&["pots".to_owned()])).unwrap_err();
    assert_eq!(
        refusals[0].to_string(),
        "layers: found `pots`, which is not in the file, expected the label or id of a group: `frame`, `posts`"
    );
}

#[test]
fn entities_know_their_line() {
    let drawing = drawn("<g>\n<circle r='1'/>\n</g>\n<path\n d='M0 0h3v3z'/>");
    let locations: Vec<_> = drawing.entities.iter().map(|entity| entity.location.as_str()).collect();
    assert_eq!(locations, ["line 3", "line 5"]);
}

#[test]
fn an_ellipse_and_an_rounded_rectangle_keep_their_area() {
    let drawing = drawn("<ellipse cx='30' cy='20' rx='20' ry='10' transform='rotate(20)'/>");
    assert!((area(only(&drawing)) / (200.0 * PI) - 1.0).abs() < 1e-5);
    let drawing = drawn("<rect x='1' y='2' width='30' height='20' rx='4'/>");
    assert!((area(only(&drawing)) - (600.0 - (4.0 - PI) * 16.0)).abs() < 1e-12, "its corners are exact");
}

#[test]
fn bad_files_are_refused_with_line_and_reason() {
    let deep = format!("{}{}", "<g>".repeat(300), "</g>".repeat(300));
    let copies: String =
        (1..12).map(|i| format!("<g id='g{i}'>{}</g>", format!("<use href='#g{}'/>", i - 1).repeat(9))).collect();
    let nested = "<!DOCTYPE svg [<!ENTITY a \"x\"><!ENTITY b \"&a;&a;\">]>";
    let shapes = r#"
<circle r='-1'/> => line 2: found r="-1", expected numbers
<circle r='1furlong'/> => line 2: found r="1furlong", expected numbers
<circle r='1e999'/> => line 2: found
<circle r='2em'/> => line 2: found r="2em", expected numbers
<circle r='1e30' transform='scale(1e30)'/> => line 2: found a coordinate out of range, expected coordinates below
<circle r='1' transform='turn(3)'/> => line 2: found transform="turn(3)", expected matrix, translate,
<path d='M0 0L1'/> => line 2: found path data, command 2:
<path d='L1 1'/> => line 2: found path data, command 1:
<path d='M0 0 nan 1'/> => line 2: found path data
<polygon points='0 0 1 0 1'/> => line 2: found points="..." with 2 points and something else behind
<use href='#nobody'/> => line 2: found use of `#nobody`, expected `#` and the id of an element of this file
<use href='a.svg#b'/> => line 2: found use of `a.svg#b`
<g id='a'><use href='#a'/></g> => line 2: found `#a` copies itself
<g id='a'><use href='#b'/></g><g id='b'><use href='#a'/></g> => line 2: found `#b` copies itself"#;
    let in_page = |content: &str| page("viewBox='0 0 9 9'", content);
    let shapes = shapes.trim_start().lines().map(|row| row.split_once(" => ").unwrap());
    let texts = [
        (String::new(), "line 1: found "),
        ("<a/>".to_owned(), "line 1: found the element `a`, expected `svg` as the outermost element"),
        ("<svg><circle></svg>".to_owned(), "line 1: found expected 'circle' tag, not 'svg'"),
        (in_page(&deep), "line 2: found an element within 200 others"),
        (in_page(&format!("<circle id='g0' r='1'/>{copies}")), "line 2: found copies that unfold into more than"),
        (format!("{nested}<svg xmlns='http://www.w3.org/2000/svg'/>"), "DOCTYPE: found nested entities"),
    ];
    for (text, expected) in shapes.map(|(content, expected)| (in_page(content), expected)).chain(texts) {
        let refusals = read(&text, None).expect_err(&text);
        assert!(refusals[0].to_string().starts_with(expected), "{}\n{expected}", refusals[0]);
    }
    let bomb = format!("<!DOCTYPE svg [<!ENTITY a \"{}\">]><svg>{}</svg>", "x".repeat(10_000), "&a;".repeat(3_000));
    assert!(read(&bomb, None).unwrap_err()[0].found.contains("ten times the text"));
    let mistakes = in_page("<circle r='a'/>\n<circle r='b'/>");
    assert_eq!(read(&mistakes, None).unwrap_err().len(), 2, "all mistakes at once");
}

#[test]
fn entities_of_drawing_programs_are_read() {
    let text = "<?xml version=\"1.0\"?><!DOCTYPE svg PUBLIC \"-//W3C//DTD SVG 1.1//EN\" \"x.dtd\" [\n\
        <!ENTITY ns_svg \"http://www.w3.org/2000/svg\">\n]>\n<svg xmlns=\"&ns_svg;\" viewBox='0 0 9 9'><circle r='1'/></svg>";
    assert_eq!(read(text, None).unwrap().entities.len(), 1);
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(400))]

    #[test]
    fn damaged_files_are_read_or_refused_without_panic(at in 0usize..900, with in "[ -~]{0,3}", cut in 0usize..6) {
        let whole = page(
            "width='5cm' viewBox='0 0 100 50' preserveAspectRatio='xMinYMax slice'",
            "<style>.a, circle#b {fill: none; stroke: #123} @media x {y{fill:red}}</style><symbol id='s' viewBox='0 0 1 1'><circle r='1'/></symbol>\
             <g id='g' transform='rotate(10 2 3) skewY(5) matrix(1 2 3 4 5 6)'><path class='a' d='M0 0h1v1H2V2l1 1L0 0zm1 1c1 2 3 4 5 6s1 2 3 4\
             q1 2 3 4t5 6a1 2 30 0 1 4 4A1 1 0 1 0 9 9z'/><rect x='1' y='10%' width='3' height='2mm' rx='1'/><polygon points='0 0 1 1 2 0'/></g>\
             <use href='#g' x='3'/><use href='#s' width='30' height='1'/><ellipse rx='3' ry='1' style='fill-rule:evenodd;opacity:.5'/>",
        );
        let mut bytes = whole.into_bytes();
        let at = at.min(bytes.len());
        let end = (at + cut).min(bytes.len());
        bytes.splice(at..end, with.bytes());
        let _ = read(&String::from_utf8_lossy(&bytes), None);
    }
}
