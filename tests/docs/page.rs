//! The pages of the documentation as text, and what stands in them: links, code, tables, formulas.

use std::path::{Path, PathBuf};

/// A Markdown file.
pub struct Page {
    /// Path below the root of the package.
    pub path: PathBuf,
    /// The whole text.
    pub text: String,
}

/// A block between two lines of three backticks.
pub struct Fence {
    /// What stands behind the opening backticks.
    pub language: String,
    /// The text between.
    pub text: String,
}

/// Root of the package.
pub fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

/// A text file below the root.
pub fn text(path: &str) -> String {
    std::fs::read_to_string(root().join(path)).unwrap_or_else(|error| panic!("{path}: {error}"))
}

/// The files below a folder with one of the endings.
pub fn files(folder: &Path, endings: &[&str]) -> Vec<PathBuf> {
    let mut found = Vec::new();
    for entry in std::fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        if path.is_dir() {
            found.extend(files(&path, endings));
        } else if path.extension().is_some_and(|e| endings.iter().any(|ending| e == *ending)) {
            found.push(path);
        }
    }
    found.sort();
    found
}

/// One page.
pub fn page(path: &str) -> Page {
    Page { path: path.into(), text: text(path) }
}

/// All pages: those of the book, and those at the root.
pub fn pages() -> Vec<Page> {
    let book = root().join("docs/book");
    let below = files(&root().join("docs"), &["md"]).into_iter().filter(|path| !path.starts_with(&book));
    let mut pages: Vec<Page> =
        below.map(|path| page(&path.strip_prefix(root()).unwrap().to_string_lossy().replace('\\', "/"))).collect();
    pages.extend([page("README.md"), page("CHANGELOG.md")]);
    pages
}

impl Page {
    /// The name in messages.
    pub fn name(&self) -> String {
        self.path.display().to_string()
    }

    fn blocks(&self) -> (Vec<Fence>, String) {
        let (mut fences, mut prose, mut open): (Vec<Fence>, String, bool) = (Vec::new(), String::new(), false);
        for line in self.text.lines() {
            if let Some(language) = line.strip_prefix("```") {
                open = !open;
                if open {
                    fences.push(Fence { language: language.trim().to_owned(), text: String::new() });
                }
            } else if let (true, Some(fence)) = (open, fences.last_mut()) {
                fence.text += &format!("{line}\n");
            } else {
                prose += &format!("{line}\n");
            }
        }
        assert!(!open, "{}: a block of code is not closed", self.name());
        (fences, prose)
    }

    /// The blocks of code.
    pub fn fences(&self) -> Vec<Fence> {
        self.blocks().0
    }

    /// All but the blocks of code.
    pub fn prose(&self) -> String {
        self.blocks().1
    }

    /// The targets of links and pictures.
    pub fn links(&self) -> Vec<String> {
        let prose = self.prose();
        prose.split("](").skip(1).filter_map(|rest| rest.split_once(')')).map(|(target, _)| target.to_owned()).collect()
    }

    /// The pieces of code within sentences and tables.
    pub fn code(&self) -> Vec<String> {
        code(&self.prose())
    }

    /// The cells of the rows of all tables, heads and rules left out.
    pub fn rows(&self) -> Vec<Vec<String>> {
        let prose = self.prose();
        let lines: Vec<&str> = prose.lines().collect();
        let is_rule = |i: usize| lines.get(i).is_some_and(|line| line.starts_with("|---"));
        let is_row = |&i: &usize| lines[i].starts_with('|') && !is_rule(i) && !is_rule(i + 1);
        let cells = |line: &str| line.trim().trim_matches('|').split('|').map(|cell| cell.trim().to_owned()).collect();
        (0..lines.len()).filter(is_row).map(|i| cells(lines[i])).collect()
    }

    /// The places that a link can point to: headings in lower case, spaces as hyphens, signs left out.
    pub fn anchors(&self) -> Vec<String> {
        let keep = |c: &char| c.is_alphanumeric() || " -_".contains(*c);
        let slug = |title: &str| title.trim().to_lowercase().chars().filter(keep).collect::<String>().replace(' ', "-");
        self.prose()
            .lines()
            .filter(|line| line.starts_with('#'))
            .map(|line| slug(line.trim_start_matches('#')))
            .collect()
    }

    /// The formulas between two lines of dollars.
    pub fn formulas(&self) -> Vec<String> {
        self.prose().split("$$").skip(1).step_by(2).map(str::to_owned).collect()
    }
}

/// What stands between backticks.
pub fn code(text: &str) -> Vec<String> {
    text.lines().flat_map(|line| line.split('`').skip(1).step_by(2).map(str::to_owned).collect::<Vec<_>>()).collect()
}

/// The words of a command line; quoted words may hold spaces.
pub fn words(line: &str) -> Vec<String> {
    let quoted = line.split('"').enumerate();
    let words = quoted.flat_map(|(i, part)| if i % 2 == 1 { vec![part] } else { part.split_whitespace().collect() });
    words.map(str::to_owned).collect()
}
