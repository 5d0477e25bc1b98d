//! Bad shape files of other programs: `tests/bad-input/drawings.table`, snippets split by `+++` lines. The first line of each is the name
//! of the file and the options that it is read with, the next ones its text with `\xff` for a byte, and those that begin with `#!` the
//! mistakes, `message; way out`. A line `=== NAME` begins a file beside the first. `MENISCUS_BLESS=1 cargo test --test program bad_drawings` writes the mistakes anew: read them.

use std::fmt::Write;
use std::path::Path;

use meniscus_case::load_shapes;
use meniscus_drawings::import::Options;

/// The bytes of a text with `\xff` for a byte.
fn bytes(text: &str) -> Vec<u8> {
    let mut parts = text.split("\\x");
    let mut bytes = parts.next().unwrap().as_bytes().to_vec();
    for part in parts {
        bytes.push(u8::from_str_radix(&part[..2], 16).unwrap());
        bytes.extend(part[2..].bytes());
    }
    bytes
}

fn options(words: &str) -> Options {
    let mut options = Options::default();
    for (key, value) in words.split_whitespace().filter_map(|word| word.split_once('=')) {
        match key {
            "unit" => options.unit = Some(value.to_owned()),
            "pixel-size" => options.pixel_size = Some(value.parse().unwrap()),
            _ => panic!("no option `{key}` in this table"),
        }
    }
    options
}

/// The files of a snippet, each with its lines: a line `=== NAME` begins another one, which lies beside the first.
fn files<'t>(first: &'t str, lines: &'t [&'t str]) -> Vec<(&'t str, Vec<&'t str>)> {
    let mut all = vec![(first, Vec::new())];
    for line in lines {
        match line.strip_prefix("=== ") {
            Some(name) => all.push((name, Vec::new())),
            None => all.last_mut().unwrap().1.push(*line),
        }
    }
    all
}

/// The snippet with the mistakes that it gives.
fn with_mistakes(snippet: &str) -> String {
    let own: Vec<&str> = snippet.lines().filter(|line| !line.starts_with("#!")).collect();
    let (name, words) = own[0].split_once(' ').unwrap_or((own[0], ""));
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join(name);
    for (name, lines) in files(name, &own[1..]) {
        std::fs::write(folder.path().join(name), bytes(&lines.join("\n"))).unwrap();
    }
    let mistakes = load_shapes(&path, &options(words)).err().map_or(Vec::new(), |error| error.mistakes);
    let inside = format!("{}/", folder.path().display());
    let mut written = own.join("\n") + "\n";
    for mistake in mistakes {
        let _ = writeln!(written, "#! {}; {}", mistake.message.replace(&inside, ""), mistake.help_text());
    }
    written
}

const BLESS: &str = "where right is as meant, MENISCUS_BLESS=1 cargo test --test program bad_drawings writes it";

#[test]
fn every_bad_drawing_gives_the_mistakes_it_names() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/bad-input/drawings.table");
    let text = std::fs::read_to_string(&path).unwrap();
    let snippets: Vec<&str> = text.split("+++\n").collect();
    let found: Vec<String> = snippets.iter().map(|snippet| with_mistakes(snippet)).collect();
    if std::env::var_os("MENISCUS_BLESS").is_some() {
        std::fs::write(&path, found.join("+++\n")).unwrap();
        return;
    }
    for (number, (snippet, found)) in snippets.iter().zip(&found).enumerate() {
        assert!(found.contains("\n#!"), "snippet {}: no mistake found", number + 1);
        assert_eq!(snippet, found, "snippet {}; {BLESS}", number + 1);
    }
    assert!(snippets.len() >= 20, "{} bad drawings", snippets.len());
}

#[test]
fn what_is_no_file_is_refused_and_not_read() {
    let folder = tempfile::tempdir().unwrap();
    std::fs::create_dir(folder.path().join("folder.wkt")).unwrap();
    let mut names = vec![("folder.wkt", "it is a folder, expected a file")];
    #[cfg(unix)]
    {
        std::os::unix::fs::symlink("/dev/zero", folder.path().join("zero.xyr")).unwrap();
        names.push(("zero.xyr", "it is a device, a pipe or a socket, expected a file"));
    }
    for (name, expected) in names {
        let error = load_shapes(&folder.path().join(name), &Options::default()).unwrap_err().render();
        assert!(error.contains(expected), "{error}");
    }
}
