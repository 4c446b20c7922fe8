//! A name that somebody gives, and what it is for.

use stillage_core::Point;
use stillage_core::layout::check_code;
use stillage_core::registry::{AreaRings, checked_groups, checked_name};

use crate::ingest::IngestError;

/// A name with the ground it is for.
#[derive(Debug, Clone, PartialEq)]
pub struct NameRow {
    /// JSON pointer: `/rows/7` or `/features/3`.
    pub pointer: String,
    /// The ground.
    pub target: NameTarget,
    /// The code.
    pub code: Option<String>,
    /// The name.
    pub name: Option<String>,
    /// The groups.
    pub groups: Option<Vec<String>>,
}

/// What a name is for. Map frame, metres.
#[derive(Debug, Clone, PartialEq)]
pub enum NameTarget {
    /// The location that holds this point.
    Point(Point),
    /// What this area covers best.
    Area {
        /// Of which collection.
        collection: NamedCollection,
        /// Outlines and holes.
        rings: AreaRings,
    },
}

/// A collection whose features can have names.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum NamedCollection {
    /// Locations.
    Locations,
    /// Places.
    Places,
    /// Aisles.
    Aisles,
    /// Rows.
    Rows,
}

impl NameRow {
    /// What the row is called when people are told about it: `row 7`, `feature 3`.
    #[must_use]
    pub fn words(&self) -> String {
        self.pointer.trim_start_matches('/').replacen("s/", " ", 1)
    }

    /// A problem with one part of the row.
    pub(super) fn problem(&self, part: &str, detail: &str) -> IngestError {
        let slash = if part.is_empty() { "" } else { "/" };
        IngestError::invalid(format!("{}{slash}{part}", self.pointer), format!("{}: {detail}", self.words()))
    }

    pub(super) fn take_code(&mut self, code: &str) -> Result<(), IngestError> {
        check_code(code).map_err(|problem| self.problem("code", &problem.to_string()))?;
        self.code = Some(code.to_owned());
        Ok(())
    }

    pub(super) fn take_name(&mut self, name: &str) -> Result<(), IngestError> {
        let checked = checked_name(name);
        self.name = Some(checked.map_err(|detail| self.problem("name", &format!("the name {detail}")))?);
        Ok(())
    }

    pub(super) fn take_groups<'a>(&mut self, groups: impl Iterator<Item = &'a str>) -> Result<(), IngestError> {
        let checked = checked_groups(groups);
        self.groups = Some(checked.map_err(|detail| self.problem("groups", &format!("the groups {detail}")))?);
        Ok(())
    }
}

/// All rows, or all that is wrong.
pub(super) fn gather(
    rows: impl Iterator<Item = Result<NameRow, IngestError>>,
) -> Result<Vec<NameRow>, Vec<IngestError>> {
    let (mut good, mut wrong) = (Vec::new(), Vec::new());
    for row in rows {
        match row {
            Ok(row) => good.push(row),
            Err(error) => wrong.push(error),
        }
    }
    if good.is_empty() && wrong.is_empty() {
        wrong.push(IngestError::invalid("", "there is nothing in it to name"));
    }
    if wrong.is_empty() { Ok(good) } else { Err(wrong) }
}
