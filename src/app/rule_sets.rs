//! Rule sets: those that are built in, and those that people write.

use stillage_core::semantics::{RuleSet, RuleSetDraft};

use super::{App, AppError, Caller, RuleSetRecord};

/// Longest id of a rule set.
const MAX_ID: usize = 64;

impl App {
    /// All rule sets, the built-in ones first.
    pub async fn rule_sets(&self, caller: &Caller) -> Result<Vec<RuleSetRecord>, AppError> {
        let mut all: Vec<RuleSetRecord> = built_in().collect();
        all.extend(self.store.rule_sets(caller.tenant()).await?);
        Ok(all)
    }

    /// A rule set.
    pub async fn rule_set(&self, caller: &Caller, id: &str) -> Result<RuleSetRecord, AppError> {
        if let Some(record) = find_built_in(id) {
            return Ok(record);
        }
        self.store.rule_set(caller.tenant(), id).await?.ok_or_else(|| AppError::not_found("rule set", id))
    }

    /// Creates; an id in use is a conflict.
    pub async fn create_rule_set(
        &self,
        caller: &Caller,
        id: &str,
        draft: RuleSetDraft,
    ) -> Result<RuleSetRecord, AppError> {
        check_id(id)?;
        let checked = checked(draft)?;
        let in_use = || AppError::Conflict(format!("there is a rule set {id} already"));
        if find_built_in(id).is_some() {
            return Err(in_use());
        }
        self.store.create_rule_set(caller.tenant(), id, checked.draft()).await?.ok_or_else(in_use)
    }

    /// Replaces; needs `if_match`. Maps keep the rule set they were assigned with.
    pub async fn put_rule_set(
        &self,
        caller: &Caller,
        id: &str,
        draft: RuleSetDraft,
        if_match: Option<u64>,
    ) -> Result<RuleSetRecord, AppError> {
        let version = self.writable(caller, id, if_match).await?;
        let checked = checked(draft)?;
        match self.store.put_rule_set(caller.tenant(), id, checked.draft(), version).await? {
            None => Err(AppError::not_found("rule set", id)),
            Some(Err(current)) => Err(AppError::PreconditionFailed { current }),
            Some(Ok(record)) => Ok(record),
        }
    }

    /// Deletes; needs `if_match`. Maps keep the rule set they were assigned with.
    pub async fn delete_rule_set(&self, caller: &Caller, id: &str, if_match: Option<u64>) -> Result<(), AppError> {
        let version = self.writable(caller, id, if_match).await?;
        match self.store.delete_rule_set(caller.tenant(), id, version).await? {
            None => Err(AppError::not_found("rule set", id)),
            Some(Err(current)) => Err(AppError::PreconditionFailed { current }),
            Some(Ok(())) => Ok(()),
        }
    }

    /// The version that a write expects, when the rule set is there and not built in.
    async fn writable(&self, caller: &Caller, id: &str, if_match: Option<u64>) -> Result<u64, AppError> {
        if self.rule_set(caller, id).await?.built_in {
            return Err(AppError::Conflict(format!("the rule set {id} is built in: create one under another id")));
        }
        if_match.ok_or(AppError::PreconditionRequired)
    }
}

/// A rule set that somebody writes: valid, and without rules that never apply. Those that were stored before rules were
/// looked at stay readable.
fn checked(draft: RuleSetDraft) -> Result<RuleSet, AppError> {
    let unreachable = draft.unreachable_rules();
    let problems = match draft.check() {
        Ok(rule_set) if unreachable.is_empty() => return Ok(rule_set),
        Ok(_) => unreachable,
        Err(problems) => problems.into_iter().chain(unreachable).collect(),
    };
    Err(problems.into())
}

fn built_in() -> impl Iterator<Item = RuleSetRecord> {
    let record = |(id, rule_set): (&str, RuleSet)| RuleSetRecord {
        id: id.to_owned(),
        draft: rule_set.draft().clone(),
        built_in: true,
        version: 1,
    };
    RuleSet::all_built_in().into_iter().map(record)
}

fn find_built_in(id: &str) -> Option<RuleSetRecord> {
    built_in().find(|record| record.id == id)
}

/// Ids stand in URLs: lower-case letters, digits and inner hyphens.
fn check_id(id: &str) -> Result<(), AppError> {
    let is_plain = |byte: u8| byte.is_ascii_lowercase() || byte.is_ascii_digit() || byte == b'-';
    let fits = (1..=MAX_ID).contains(&id.len()) && id.bytes().all(is_plain);
    if !fits || id.starts_with('-') || id.ends_with('-') {
        let detail = format!("an id has 1 to {MAX_ID} lower-case letters, digits and inner hyphens");
        return Err(AppError::invalid("/id", detail));
    }
    Ok(())
}
