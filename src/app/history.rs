//! Back and forth in the versions of the semantics.
//!
//! A version that restores another one equals it. The history is the versions that restore none, each with the one before it
//! in force as its parent; the first one has the suggestion (0), and one that was carried over to its analysis has none.
//! Where a client is in it follows from the versions alone.

use uuid::Uuid;

use super::{App, AppError, Caller, MapContext, SemanticsOrigin, SemanticsRecord};
use crate::store::{NewCorrections, NewSemanticsRow};

/// What a version equals that a person made by going back or forth; else the version itself.
fn root(version: &SemanticsRecord) -> u64 {
    version.restores.unwrap_or(version.version)
}

/// The version that was in force before a version of the history was made; `None` before the first that there is.
/// `versions` are those of one analysis, newest first.
fn parent(versions: &[SemanticsRecord], of: u64) -> Option<u64> {
    let index = versions.iter().position(|version| version.version == of)?;
    if versions[index].carried.is_some() {
        return None;
    }
    Some(versions.get(index + 1).map_or(0, root))
}

/// The version that undoing leads to.
fn undone(versions: &[SemanticsRecord]) -> Option<u64> {
    parent(versions, root(versions.first()?))
}

/// The version that redoing leads to.
fn redone(versions: &[SemanticsRecord]) -> Option<u64> {
    let in_force = root(versions.first()?);
    let newest = versions.iter().find(|version| version.restores.is_none())?.version;
    let mut steps = std::iter::successors(Some(newest), |&version| parent(versions, version));
    steps.find(|&version| parent(versions, version) == Some(in_force))
}

impl App {
    /// Undoes the newest change that is in force: makes a new version that is equal to the one before it; needs `if_match`,
    /// the version in force.
    pub async fn undo_semantics(
        &self,
        caller: &Caller,
        map: Uuid,
        if_match: Option<u64>,
    ) -> Result<SemanticsRecord, AppError> {
        let nothing = "there is nothing to undo: nobody has changed anything on this analysis of the map";
        self.step(caller, map, if_match, undone, nothing).await
    }

    /// Redoes what was undone last; needs `if_match`, the version in force.
    pub async fn redo_semantics(
        &self,
        caller: &Caller,
        map: Uuid,
        if_match: Option<u64>,
    ) -> Result<SemanticsRecord, AppError> {
        let nothing = "there is nothing to redo: nothing was undone since the newest change";
        self.step(caller, map, if_match, redone, nothing).await
    }

    async fn step(
        &self,
        caller: &Caller,
        map: Uuid,
        if_match: Option<u64>,
        target: fn(&[SemanticsRecord]) -> Option<u64>,
        nothing: &str,
    ) -> Result<SemanticsRecord, AppError> {
        let context = self.context_at(caller, map, if_match).await?;
        let mut versions = self.store.semantics_versions(caller.tenant(), map).await?;
        versions.retain(|version| version.analysis == context.analysis_id);
        let target = target(&versions).ok_or_else(|| AppError::Conflict(nothing.to_owned()))?;
        let wanted = if target == 0 {
            let first = versions.last().map_or(0, |version| version.version);
            let layout = self.store.layout_before(caller.tenant(), map, first).await?;
            SemanticsRecord { layout, ..self.semantics_version(caller, map, 0).await? }
        } else {
            let found = versions.into_iter().find(|version| version.version == target);
            found.ok_or_else(|| AppError::not_found("version", target.to_string()))?
        };
        self.put_in_force(caller, &context, wanted).await
    }

    /// Makes a new version that is equal to an earlier one, or to the suggestion (version 0), which then is in force in
    /// the layout that is; needs `if_match`, the version in force.
    pub async fn restore_semantics(
        &self,
        caller: &Caller,
        map: Uuid,
        version: u64,
        if_match: Option<u64>,
    ) -> Result<SemanticsRecord, AppError> {
        let context = self.context_at(caller, map, if_match).await?;
        let wanted = self.semantics_version(caller, map, version).await?;
        if wanted.analysis != context.analysis_id {
            return Err(AppError::Conflict(format!(
                "version {version} names the categories of analysis {}, which is not in force: activate that one first",
                wanted.analysis
            )));
        }
        self.put_in_force(caller, &context, wanted).await
    }

    /// Makes a new version that is equal to an earlier one of the analysis in force.
    async fn put_in_force(
        &self,
        caller: &Caller,
        context: &MapContext,
        wanted: SemanticsRecord,
    ) -> Result<SemanticsRecord, AppError> {
        let row = NewSemanticsRow {
            map: context.record.id,
            analysis: context.analysis_id,
            replaces: context.semantics.version,
            restores: Some(root(&wanted)),
            rule_set: wanted.rule_set,
            draft: wanted.draft,
            assignment: wanted.assignment,
            layout: wanted.layout,
            corrections: NewCorrections::Stored(wanted.corrections),
            // What was carried over is decided by whoever restores it.
            origin: match wanted.origin {
                SemanticsOrigin::Suggested => SemanticsOrigin::Suggested,
                SemanticsOrigin::Assigned | SemanticsOrigin::Carried => SemanticsOrigin::Assigned,
            },
            carried: None,
        };
        self.decide(caller, context, row).await
    }
}

#[cfg(test)]
mod tests {
    use jiff::Timestamp;
    use stillage_core::layout::LayoutOptions;
    use stillage_core::semantics::{Assignment, RuleSet};

    use super::*;
    use crate::records::CarryRecord;

    /// Versions counted from 1, newest first. A number is what the version restores.
    fn history(restores: &[Option<u64>]) -> Vec<SemanticsRecord> {
        let version = |(index, &restores): (usize, &Option<u64>)| SemanticsRecord {
            analysis: Uuid::nil(),
            rule_set: String::new(),
            draft: RuleSet::default().draft().clone(),
            assignment: Assignment::default(),
            layout: LayoutOptions::default(),
            corrections: None,
            version: index as u64 + 1,
            origin: SemanticsOrigin::Assigned,
            carried: None,
            restores,
            created: Timestamp::UNIX_EPOCH,
        };
        restores.iter().enumerate().map(version).rev().collect()
    }

    /// Undoes (`u`), redoes (`r`) and makes changes (`c`); answers what each version equals, `-` where nothing was done.
    fn walk(steps: &str) -> String {
        let mut restores = Vec::new();
        let mut told = String::new();
        for step in steps.chars() {
            let versions = history(&restores);
            let made = match step {
                'c' => Some(None),
                'u' => undone(&versions).map(Some),
                _ => redone(&versions).map(Some),
            };
            if let Some(made) = made {
                restores.push(made);
                told += &root(&history(&restores)[0]).to_string();
            } else {
                told.push('-');
            }
        }
        told
    }

    #[test]
    fn undoing_and_redoing_walk_along_the_changes() {
        assert_eq!(walk("u"), "-", "the suggestion is in force");
        assert_eq!(walk("cccuu"), "12321");
        assert_eq!(walk("cccuuu"), "123210", "back to the suggestion");
        assert_eq!(walk("cccuuuu"), "123210-");
        assert_eq!(walk("cccuuurrrr"), "123210123-");
        assert_eq!(walk("cr"), "1-");
    }

    #[test]
    fn a_change_after_undoing_takes_the_place_of_what_was_undone() {
        assert_eq!(walk("ccuc"), "1214");
        assert_eq!(walk("ccucr"), "1214-", "2 is no longer ahead");
        assert_eq!(walk("ccucuu"), "121410");
        assert_eq!(walk("ccucuurr"), "12141014");
    }

    #[test]
    fn what_was_carried_over_is_the_beginning() {
        let mut versions = history(&[None, None]);
        versions[1].carried = Some(CarryRecord { map: None, from: 7, kept: 1, lost: Vec::new() });
        assert_eq!(undone(&versions), Some(1));
        assert_eq!(undone(&versions[1..]), None);
    }
}
