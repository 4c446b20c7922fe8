//! Circles among files that refer to one another.

use std::collections::{BTreeMap, BTreeSet, VecDeque};

/// For each file the files that it refers to.
pub type References = BTreeMap<String, BTreeSet<String>>;

/// The shortest circle through a file: the file, those that it leads through in order, and the file again.
pub fn circle_through(references: &References, file: &str) -> Option<Vec<String>> {
    let mut came_from: BTreeMap<&str, &str> = BTreeMap::new();
    let mut waiting = VecDeque::from([file]);
    while let Some(at) = waiting.pop_front() {
        for next in references.get(at).into_iter().flatten() {
            if next == file {
                let mut circle = vec![file, at];
                while circle[circle.len() - 1] != file {
                    circle.push(came_from[circle[circle.len() - 1]]);
                }
                circle.reverse();
                return Some(circle.into_iter().map(str::to_owned).collect());
            }
            if !came_from.contains_key(next.as_str()) {
                came_from.insert(next, at);
                waiting.push_back(next);
            }
        }
    }
    None
}
