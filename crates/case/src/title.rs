//! The title of a case with values of the command line: it tells them, since the one in the file may name others.

use meniscus_core::input::Overrides;

/// Most values that are told, and the longest value, in characters.
const MOST: usize = 4;
const LONGEST: usize = 16;

/// Tables of which no value changes what the case is about.
const OTHER: [&str; 4] = ["format", "expect", "output", "time"];

/// The title of a file, followed by the values that `overrides` change.
pub(super) fn title(of_file: &str, overrides: &Overrides) -> String {
    let changes = overrides.changes();
    let table = |key: &str| key.split(['.', '[']).next().unwrap_or_default().to_owned();
    if changes.iter().any(|(key, _)| key == "title") {
        return of_file.to_owned();
    }
    let told: Vec<&(String, &str)> = changes
        .iter()
        .filter(|(key, value)| !OTHER.contains(&&*table(key)) && value.len() <= LONGEST && !value.starts_with('{'))
        .collect();
    let name = |key: &str| {
        let shortest = (1..).map(|steps| last_steps(key, steps));
        let is_clear = |name: &&str| {
            let ending = format!(".{name}");
            told.iter().all(|(other, _)| other == key || !(other == name || other.ends_with(&ending)))
        };
        shortest.take(key.len()).find(is_clear).unwrap_or(key).to_owned()
    };
    let mut words: Vec<String> =
        told.iter().take(MOST).map(|(key, value)| format!("{} = {}", name(key), value.trim_matches('"'))).collect();
    if told.len() > MOST {
        words.push(format!("{} more", told.len() - MOST));
    }
    if words.is_empty() { of_file.to_owned() } else { format!("{of_file}; {}", words.join(", ")) }
}

/// The last `steps` names of a key path.
fn last_steps(key: &str, steps: usize) -> &str {
    key.rmatch_indices('.').nth(steps - 1).map_or(key, |(end, _)| &key[end + 1..])
}

#[cfg(test)]
mod tests {
    use super::*;

    fn titled(overrides: &[&str]) -> String {
        title("A drop", &Overrides::parse(overrides).unwrap())
    }

    #[test]
    fn the_values_of_the_command_line_follow_the_title() {
        assert_eq!(titled(&[]), "A drop");
        assert_eq!(titled(&["expect=[]", "time.end=2", "geometry.shapes={ a = 1 }"]), "A drop");
        assert_eq!(titled(&["title=Another", "sph.spacing=1"]), "A drop");
        assert_eq!(
            titled(&["sph.wetting.young.contact-angle-deg=90", "sph.wetting.young.contact-angle-deg=120"]),
            "A drop; contact-angle-deg = 120"
        );
    }

    #[test]
    fn keys_of_one_name_are_told_apart_and_many_are_counted() {
        let both = ["sph.phases.wetting.viscosity=1", "sph.phases.non-wetting.viscosity=2"];
        assert_eq!(titled(&both), "A drop; wetting.viscosity = 1, non-wetting.viscosity = 2");
        assert_eq!(titled(&["a=1", "b=2", "c=3", "d=4", "e=5", "f=6"]), "A drop; a = 1, b = 2, c = 3, d = 4, 2 more");
    }
}
