//! Disc lists: `x y r` in m per line, separated by spaces, tabs, commas or semicolons; one header line is allowed.

use crate::geometry::shape_lines::{LineProblem, Notes, around, words};
use crate::geometry::spec::{Disc, GeometrySpec, ShapeSpec};

const EXPECTED: &str =
    "three numbers `x y r` in m, the radius above 0, separated by spaces, tabs, commas or semicolons";

/// Reads the text of a disc list.
pub(crate) fn parse(text: &str) -> Result<GeometrySpec, Vec<LineProblem>> {
    let (mut discs, mut notes) = (Vec::new(), Notes::default());
    let mut may_be_header = true;
    for (line, row) in (1..).zip(text.lines().map(str::trim)) {
        if notes.take_comment(line, row) {
            continue;
        }
        let data = row.split('#').next().unwrap_or_default();
        if words(data).next().is_none() {
            continue;
        }
        let is_header = may_be_header && words(data).all(|word| word.parse::<f64>().is_err());
        may_be_header = false;
        if is_header {
            continue;
        }
        match disc(data) {
            Some(disc) => discs.push(disc),
            None => notes.refuse(line, row, EXPECTED.to_owned()),
        }
    }
    let box_of =
        |d: &Disc| [d.center[0] - d.radius, d.center[1] - d.radius, d.center[0] + d.radius, d.center[1] + d.radius];
    let around = around(discs.iter().map(box_of));
    notes.finish(discs.into_iter().map(ShapeSpec::Disc).collect(), around, ("no disc at all", EXPECTED))
}

fn disc(data: &str) -> Option<Disc> {
    let numbers: Vec<f64> = words(data).map(str::parse).collect::<Result<_, _>>().ok()?;
    let [x, y, radius] = numbers.try_into().ok()?;
    let is_good = [x, y, radius].iter().all(|v: &f64| v.is_finite()) && radius > 0.0;
    is_good.then_some(Disc { center: [x, y], radius })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn all_separators_a_header_and_comments_are_read() {
        let spec = parse("x,y,r\n# a comment\n0 0 1 # first\n3,0,1\n\t0;3;\t1\n").unwrap();
        assert_eq!(spec.shapes.len(), 3);
        // The box around the discs is 5 wide, and a tenth of that is left free around it.
        assert_eq!((spec.min, spec.max), ([-1.5, -1.5], [4.5, 4.5]));
    }

    #[test]
    fn a_domain_comment_sets_the_domain() {
        let spec = parse("# domain -5 -6 7 8\n0 0 1\n").unwrap();
        assert_eq!((spec.min, spec.max), ([-5.0, -6.0], [7.0, 8.0]));
    }

    #[test]
    fn all_bad_lines_are_named_at_once_with_their_text() {
        let bad = parse("0 0 1\n1 2\n1 2 -3\n1 2 x\n").unwrap_err();
        assert_eq!(bad.iter().map(|b| b.line).collect::<Vec<_>>(), [2, 3, 4]);
        assert_eq!(bad[2].text, "1 2 x");
    }

    #[test]
    fn an_empty_list_is_refused() {
        assert_eq!(parse("# nothing\n").unwrap_err().len(), 1);
    }
}
