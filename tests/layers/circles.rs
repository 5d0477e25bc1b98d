//! Circles of imports: files and folders of one folder that import each other, directly or through further ones.
//!
//! Each folder of the source is a graph of its own, with its files and subfolders as nodes. `mod` is what the folder itself defines or shows.

use std::collections::{BTreeMap, BTreeSet};

use crate::{Source, heads_behind, is_word, sources};

/// For each node those that it imports outside of its tests.
pub type Imports = BTreeMap<String, BTreeSet<String>>;

/// A folder of the source: its package, and its path in there, empty for all of the package.
type Folder<'s> = (&'s str, &'s str);

/// The folders of the source, from the paths of their files.
fn folders(sources: &[Source]) -> BTreeSet<Folder<'_>> {
    let of_file = |source| {
        let (package, inner): Folder<'_> = Source::place(source);
        let ends = inner.match_indices('/').map(|(at, _)| at);
        ends.chain([0]).map(move |end| (package, &inner[..end]))
    };
    sources.iter().flat_map(of_file).collect()
}

/// Whether a node is what the folder itself defines.
fn is_root(name: &str) -> bool {
    matches!(name, "mod" | "lib" | "main")
}

/// The first parts of the paths that begin with exactly `n` times `super::`.
fn heads_above(code: &str, n: usize) -> Vec<String> {
    let prefix = "super::".repeat(n);
    // Each longer chain ends with the same prefix, behind another `super::`.
    let marked = code.replace(&format!("super::{prefix}"), "longer::");
    heads_behind(&marked, &prefix).into_iter().map(|(_, head)| head).collect()
}

/// The imports between the files and subfolders of a folder.
pub fn imports_within((package, folder): Folder<'_>, sources: &[Source]) -> Imports {
    let inside: Vec<(&Source, &str)> = sources
        .iter()
        .filter(|source| !source.is_of_tests())
        .filter(|source| source.place().0 == package)
        .filter_map(|source| {
            let inner = source.place().1.strip_prefix(folder)?;
            Some((source, if folder.is_empty() { inner } else { inner.strip_prefix('/')? }))
        })
        .collect();
    let name = |inner: &str| {
        let name = inner.split('/').next().unwrap_or_default().trim_end_matches(".rs");
        if is_root(name) { "mod".to_owned() } else { name.to_owned() }
    };
    let names: BTreeSet<String> = inside.iter().map(|(_, inner)| name(inner)).collect();
    let mut found = Imports::new();
    for (source, inner) in inside {
        let (code, importer) = (source.code(), name(inner));
        let imported = if importer == "mod" {
            let leads_to = |child: &&String| {
                let path = format!("{child}::");
                code.match_indices(&path).any(|(at, _)| !code[..at].ends_with(is_word))
            };
            names.iter().filter(leads_to).cloned().collect()
        } else {
            let within = if folder.is_empty() { String::new() } else { format!("{}::", folder.replace('/', "::")) };
            let mut heads = heads_behind(&code, &format!("crate::{within}"));
            let depth = inner.matches('/').count() + usize::from(!inner.ends_with("mod.rs"));
            heads.extend(heads_above(&code, depth).into_iter().map(|head| (0, head)));
            let node = |head: String| if names.contains(&head) { head } else { "mod".to_owned() };
            heads.into_iter().map(|(_, head)| node(head)).collect::<BTreeSet<_>>()
        };
        let of_importer = found.entry(importer.clone()).or_default();
        of_importer.extend(imported);
        of_importer.remove(&importer);
    }
    found
}

/// All that a node leads to.
fn reached(from: &str, imports: &Imports) -> BTreeSet<String> {
    let (mut found, mut left) = (BTreeSet::new(), vec![from.to_owned()]);
    while let Some(node) = left.pop() {
        let next = imports.get(&node).into_iter().flatten().filter(|&next| found.insert(next.clone()));
        left.extend(next.cloned().collect::<Vec<_>>());
    }
    found
}

/// The circles of a graph: the nodes that lead to each other.
fn circles(imports: &Imports) -> BTreeSet<String> {
    let reach: BTreeMap<&String, BTreeSet<String>> =
        imports.keys().map(|node| (node, reached(node, imports))).collect();
    let leads = |a: &String, b: &String| reach.get(a).is_some_and(|of_a| of_a.contains(b));
    let in_a_circle = imports.keys().filter(|node| leads(node, node));
    in_a_circle
        .map(|node| {
            imports
                .keys()
                .filter(|other| leads(node, other) && leads(other, node))
                .cloned()
                .collect::<Vec<_>>()
                .join(" ")
        })
        .collect()
}

#[test]
fn no_folder_has_a_circle_of_imports() {
    let sources = sources();
    let found = folders(&sources).into_iter().flat_map(|folder| {
        let found = circles(&imports_within(folder, &sources));
        found.into_iter().map(move |files| format!("{}, {}: {files}", folder.0, folder.1))
    });
    let found: Vec<String> = found.collect();
    assert!(found.is_empty(), "circles of imports:\n{}", found.join("\n"));
}

#[test]
fn a_circle_is_found_through_further_files_and_folders() {
    let source = |path: &str, code: &str| Source { path: path.to_owned(), lines: vec![code.to_owned()] };
    let sources = [
        source("crates/sph/src/lib.rs", "pub mod a;"),
        source("crates/sph/src/a.rs", "use super::b::B;"),
        source("crates/sph/src/b.rs", "use crate::c::{C, D};"),
        source("crates/sph/src/c/mod.rs", "mod inner;"),
        source("crates/sph/src/c/inner.rs", "use super::super::a::A; use super::other::O;"),
        source("crates/sph/src/d.rs", "use super::a::A;"),
    ];
    assert_eq!(circles(&imports_within(("sph", ""), &sources)), BTreeSet::from(["a b c".to_owned()]));
    assert_eq!(folders(&sources), BTreeSet::from([("sph", ""), ("sph", "c")]));
}
