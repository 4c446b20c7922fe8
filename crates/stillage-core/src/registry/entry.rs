//! The places of a site with their codes and names.

use serde::{Deserialize, Serialize};

use super::named_area::NamedArea;
use crate::compare::Footprint;
use crate::geometry::Point;

/// How surely a place is where its code says.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum PlaceState {
    /// It was found in the newest map.
    Current,
    /// Something was found that may be it; a person has to confirm.
    Stale,
    /// It was not found in the newest map. Its code stays its own.
    Lost,
}

/// A place of a site.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct RegistryEntry {
    /// Number that never changes and is never given again.
    pub key: u32,
    /// Its code, unique in the registry.
    pub code: String,
    /// Whether a person gave the code: no numbering changes it.
    #[serde(default)]
    pub is_code_given: bool,
    /// The name that people gave it.
    pub name: Option<String>,
    /// The groups that people put it in.
    pub groups: Vec<String>,
    /// Its border in the frame of the site, metres, counter-clockwise.
    pub outline: Vec<Point>,
    /// Its middle in the frame of the site, metres.
    pub center: Point,
    /// How surely it is there.
    pub state: PlaceState,
    /// Where it was seen last, when that is not confirmed yet: border and middle.
    pub seen: Option<(Vec<Point>, Point)>,
    /// The scan in which a person confirmed it: a doubtful alignment of that scan is no doubt about this place.
    pub confirmed_in: Option<String>,
}

impl RegistryEntry {
    pub(super) fn footprint(&self) -> Footprint {
        Footprint { outline: self.outline.clone(), center: self.center }
    }
}

/// All storage places that ever had a code at a site, by key, and the areas that have names.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct Registry {
    /// The places, by key, from 1 without a gap.
    pub entries: Vec<RegistryEntry>,
    /// The numbering that its codes follow ([`LayoutOptions::numbering`](crate::layout::LayoutOptions::numbering)).
    #[serde(default)]
    pub numbering: String,
    /// The places (in the sense of the semantic map), aisles and rows that have names.
    #[serde(default)]
    pub areas: Vec<NamedArea>,
}

/// Codes that a registry does not have.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error("no place has the code {}", .0.join(", "))]
pub struct UnknownCodes(pub Vec<String>);

impl Registry {
    /// Adds a place; its index.
    pub(super) fn add(&mut self, code: String, footprint: &Footprint, state: PlaceState) -> usize {
        let index = self.entries.len();
        let Footprint { outline, center } = footprint.clone();
        let seen = (state == PlaceState::Stale).then(|| (outline.clone(), center));
        self.entries.push(RegistryEntry {
            key: index as u32 + 1,
            code,
            is_code_given: false,
            name: None,
            groups: Vec::new(),
            outline,
            center,
            state,
            seen,
            confirmed_in: None,
        });
        index
    }

    /// The place with a code.
    #[must_use]
    pub fn find(&self, code: &str) -> Option<&RegistryEntry> {
        self.entries.iter().find(|entry| entry.code == code)
    }

    /// Confirms the stale places with these codes, or all: they are where they were seen last, in the scan with this id.
    /// Answers how many that were; places that are current or lost stay as they are.
    ///
    /// # Errors
    /// [`UnknownCodes`] where the registry has no place with one of them; nothing is confirmed then.
    pub fn confirm(&mut self, codes: Option<&[String]>, scan: &str) -> Result<usize, UnknownCodes> {
        let unknown = codes.into_iter().flatten().filter(|code| self.find(code).is_none());
        let unknown: Vec<String> = unknown.cloned().collect();
        if !unknown.is_empty() {
            return Err(UnknownCodes(unknown));
        }
        let is_meant = |entry: &RegistryEntry| codes.is_none_or(|codes| codes.contains(&entry.code));
        let mut count = 0;
        for entry in &mut self.entries {
            if entry.state == PlaceState::Stale && is_meant(entry) {
                entry.state = PlaceState::Current;
                entry.confirmed_in = Some(scan.to_owned());
                if let Some((outline, center)) = entry.seen.take() {
                    (entry.outline, entry.center) = (outline, center);
                }
                count += 1;
            }
        }
        Ok(count)
    }
}
