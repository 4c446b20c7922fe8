//! Faces with other labels in two readings of one analysis.

use std::collections::BTreeMap;

/// What happened to the label of a face.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct LabelChange {
    /// Number of the face.
    pub face: u32,
    /// Its label before; `None` where the face is new.
    pub before: Option<String>,
    /// Its label now; `None` where the face is gone.
    pub now: Option<String>,
}

/// The faces whose label changed, came or went, by number. O(n log n).
#[must_use]
pub fn compare_labels<'a>(
    before: impl IntoIterator<Item = (u32, &'a str)>,
    now: impl IntoIterator<Item = (u32, &'a str)>,
) -> Vec<LabelChange> {
    let mut labels: BTreeMap<u32, [Option<&str>; 2]> = BTreeMap::new();
    for (face, label) in before {
        labels.entry(face).or_default()[0] = Some(label);
    }
    for (face, label) in now {
        labels.entry(face).or_default()[1] = Some(label);
    }
    let owned = |label: Option<&str>| label.map(str::to_owned);
    let changed = labels.into_iter().filter(|(_, [before, now])| before != now);
    changed.map(|(face, [before, now])| LabelChange { face, before: owned(before), now: owned(now) }).collect()
}
