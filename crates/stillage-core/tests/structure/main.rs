//! The structure that `ARCHITECTURE.md` promises: no circles between files, and no two types of one name in a crate.
//!
//! Reads the sources of the core and of the service. A file refers to another when a `use` or a path in it leads to
//! something that the other defines; re-exports are followed, `mod` lines and calls of methods do not count. What only
//! tests see is exempt.

mod circles;
mod files;
mod tokens;

use std::collections::BTreeMap;
use std::path::Path;

use circles::circle_through;
use files::{Files, Sources};

/// The sources below a folder of this package.
fn sources(folder: &str) -> Sources {
    fn add(folder: &Path, root: &Path, found: &mut Sources) {
        for entry in std::fs::read_dir(folder).expect("the folder can be read") {
            let path = entry.expect("its entries can be read").path();
            if path.is_dir() {
                add(&path, root, found);
            } else if path.extension().is_some_and(|extension| extension == "rs") {
                let name = path.strip_prefix(root).expect("it lies below the root").to_string_lossy().into_owned();
                found.insert(name, std::fs::read_to_string(&path).expect("sources are text"));
            }
        }
    }
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join(folder);
    let mut found = Sources::new();
    add(&root, &root, &mut found);
    assert!(found.contains_key("lib.rs"), "{} holds no crate", root.display());
    // The crate of a binary is another one, and nothing refers to it.
    found.remove("main.rs");
    found
}

/// The files of the core and of the service, each with the folder that it lies in.
fn all_files() -> [(&'static str, Files); 2] {
    [("crates/stillage-core/src/", "src"), ("src/", "../../src")]
        .map(|(name, folder)| (name, Files::read(&sources(folder))))
}

/// One line for every file on a circle.
fn complaints(prefix: &str, files: &Files) -> Vec<String> {
    let references = files.references();
    let circles = references.keys().filter_map(|file| circle_through(&references, file));
    circles.map(|circle| format!("{prefix}{}", circle.join(" -> "))).collect()
}

#[test]
fn no_files_refer_to_one_another_in_a_circle() {
    let complaints: Vec<String> = all_files().iter().flat_map(|(prefix, files)| complaints(prefix, files)).collect();
    assert!(complaints.is_empty(), "circles between files:\n{}", complaints.join("\n"));
}

#[test]
fn no_two_types_share_a_name() {
    let files = all_files();
    let mut shared = BTreeMap::new();
    for (prefix, files) in &files {
        let mut places: BTreeMap<&str, Vec<String>> = BTreeMap::new();
        for (name, path) in files.types() {
            places.entry(name).or_default().push(format!("{prefix}{path}"));
        }
        shared.extend(places.into_iter().filter(|(_, places)| places.len() > 1));
    }
    let complaints: Vec<String> =
        shared.iter().map(|(name, places)| format!("{name}: {}", places.join(", "))).collect();
    assert!(complaints.is_empty(), "types that share a name:\n{}", complaints.join("\n"));
}

/// Made-up sources.
fn tree(files: &[(&str, &str)]) -> Files {
    Files::read(&files.iter().map(|&(path, text)| (path.to_owned(), text.to_owned())).collect())
}

#[test]
fn a_child_that_uses_the_types_of_a_parent_that_calls_it_is_a_circle() {
    let files = tree(&[
        ("lib.rs", "pub mod rooms;"),
        ("rooms/mod.rs", "mod doors; pub struct Door; pub fn all() -> Vec<Door> { doors::find() }"),
        ("rooms/doors.rs", "use super::Door; pub fn find() -> Vec<Door> { vec![] }"),
    ]);
    assert_eq!(
        complaints("", &files),
        ["rooms/doors.rs -> rooms/mod.rs -> rooms/doors.rs", "rooms/mod.rs -> rooms/doors.rs -> rooms/mod.rs"]
    );
}

#[test]
fn a_circle_may_lead_through_re_exports_and_long_paths() {
    let files = tree(&[
        ("lib.rs", "pub mod a; pub mod b; pub use a::first;"),
        ("a/mod.rs", "mod inner; pub use inner::{first, Other as Renamed};"),
        ("a/inner.rs", "use crate::b::{self, Thing}; pub struct Other; pub fn first() { b::second() }"),
        ("b.rs", "pub struct Thing; pub fn second() { let _ = (crate::first(), '\"', crate::a::Renamed); }"),
    ]);
    assert_eq!(complaints("", &files), ["a/inner.rs -> b.rs -> a/inner.rs", "b.rs -> a/inner.rs -> b.rs"]);
}

#[test]
fn a_function_may_have_the_name_of_its_module() {
    let files = tree(&[
        ("lib.rs", "pub mod plan; mod halls;"),
        ("plan/mod.rs", "mod plan; pub use plan::plan;"),
        ("plan/plan.rs", "pub fn plan() { crate::halls::find() }"),
        ("halls.rs", "use crate::plan; pub fn find() { plan::plan() }"),
    ]);
    assert_eq!(
        complaints("", &files),
        ["halls.rs -> plan/plan.rs -> halls.rs", "plan/plan.rs -> halls.rs -> plan/plan.rs"]
    );
}

#[test]
fn re_exports_comments_texts_and_tests_make_no_circle() {
    let files = tree(&[
        ("lib.rs", "pub mod rooms;"),
        (
            "rooms/mod.rs",
            "mod door; mod doors; #[cfg(test)] mod tests; pub use door::Door; pub fn all() -> Vec<Door> { doors::find() }",
        ),
        ("rooms/door.rs", "//! See super::all.\npub struct Door; const HINT: &str = r#\"super::all \"super::all\"#;"),
        (
            "rooms/doors.rs",
            "use super::Door; pub fn find<'a>() -> Vec<Door> { vec![] }
             #[cfg(test)] mod tests { #[test] fn all() { super::super::all(); } }",
        ),
        ("rooms/tests.rs", "use super::all; pub struct Door;"),
    ]);
    assert_eq!(complaints("", &files), [""; 0]);
    assert_eq!(files.types().collect::<Vec<_>>(), [("Door", "rooms/door.rs")]);
}
