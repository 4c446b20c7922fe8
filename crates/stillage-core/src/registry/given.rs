//! Codes, names and groups that people give to locations.

use std::collections::{BTreeMap, BTreeSet};

use super::entry::{PlaceState, Registry};
use super::next_code::unused;

/// What a person says of one location. What is absent stays.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Given {
    /// Its code.
    pub code: Option<String>,
    /// Its name; `Some(None)` takes it away.
    pub name: Option<Option<String>>,
    /// Its groups.
    pub groups: Option<Vec<String>>,
}

/// A code that cannot be given.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct CodeConflict {
    /// Index of the gift.
    pub gift: usize,
    /// The code.
    pub code: String,
    /// Who has it.
    pub taken_by: CodeOwner,
}

/// Who has a code.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum CodeOwner {
    /// The place with this key, which is there.
    Place(u32),
    /// The place with this key, which the newest map does not show; a person gave it the code.
    LostPlace(u32),
    /// An earlier gift.
    Gift(usize),
}

impl Registry {
    /// Gives all of it or, where codes are taken, nothing: `gifts` are keys of places and what is said of them.
    ///
    /// Codes may be exchanged in one call. A place that the newest map does not show, and whose code nobody gave, makes way:
    /// it gets another.
    ///
    /// # Errors
    /// Every code that another place or an earlier gift has.
    ///
    /// # Panics
    /// Where a key is none of the registry.
    pub fn give(&mut self, gifts: &[(u32, Given)]) -> Result<(), Vec<CodeConflict>> {
        let mut wished: BTreeMap<&str, usize> = BTreeMap::new();
        let mut conflicts = Vec::new();
        let codes = gifts.iter().enumerate().filter_map(|(gift, (_, given))| Some((gift, given.code.as_deref()?)));
        for (gift, code) in codes.clone() {
            if let Some(&earlier) = wished.get(code) {
                conflicts.push(CodeConflict { gift, code: code.to_owned(), taken_by: CodeOwner::Gift(earlier) });
            } else {
                wished.insert(code, gift);
            }
        }
        let recoded: BTreeSet<u32> = codes.map(|(gift, _)| gifts[gift].0).collect();
        let mut ways: Vec<usize> = Vec::new();
        for (index, entry) in self.entries.iter().enumerate().filter(|(_, entry)| !recoded.contains(&entry.key)) {
            let Some(&gift) = wished.get(entry.code.as_str()) else { continue };
            let taken_by = match (entry.state, entry.is_code_given) {
                (PlaceState::Lost, false) => {
                    ways.push(index);
                    continue;
                }
                (PlaceState::Lost, true) => CodeOwner::LostPlace(entry.key),
                _ => CodeOwner::Place(entry.key),
            };
            conflicts.push(CodeConflict { gift, code: entry.code.clone(), taken_by });
        }
        if !conflicts.is_empty() {
            conflicts.sort_by_key(|conflict| conflict.gift);
            return Err(conflicts);
        }
        for (key, given) in gifts {
            let entry = &mut self.entries[*key as usize - 1];
            if let Some(code) = &given.code {
                (entry.code, entry.is_code_given) = (code.clone(), true);
            }
            if let Some(name) = &given.name {
                entry.name.clone_from(name);
            }
            if let Some(groups) = &given.groups {
                entry.groups.clone_from(groups);
            }
        }
        self.make_way(&ways);
        Ok(())
    }

    /// Gives entries other codes where theirs is that of another.
    pub(super) fn make_way(&mut self, entries: &[usize]) {
        let ways: BTreeSet<usize> = entries.iter().copied().collect();
        let others = self.entries.iter().enumerate().filter(|(index, _)| !ways.contains(index));
        let mut used: BTreeSet<String> = others.map(|(_, entry)| entry.code.clone()).collect();
        for index in ways {
            let code = unused(&self.entries[index].code, &used);
            used.insert(code.clone());
            self.entries[index].code = code;
        }
    }
}
