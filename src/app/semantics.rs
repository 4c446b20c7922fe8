//! The human decision on a map.
//!
//! Until somebody decides, the suggestion is in force, as version 0. A decision is a new immutable version; it keeps the
//! rule set as it was. An earlier version, 0 too, is restored as a new one (`history`). It belongs to the analysis whose categories it
//! names: when another analysis comes into force, its own newest decision is, or what is carried over to it (`carrying`).
//! Versions of decisions count on over all analyses of a map. A decision holds how locations are cut and numbered, too; the
//! suggestion has the layout of the newest decision on the map, or on an earlier map of the site.

use std::sync::Arc;

use stillage_core::Point;
use stillage_core::SiteMap;
use stillage_core::graph::{NODE_REACH_M, navigation_graph};
use stillage_core::lane_rule::LaneRule;
use stillage_core::layout::{self, CodeTemplate, LONGEST_CODE, LayoutOptions, LayoutSpec};
use stillage_core::routing::Router;
use stillage_core::semantics::{self, Assignment};
use uuid::Uuid;

use super::context::read_rule_set;
use super::corrections;
use super::geometric_level::GeometricLevel;
use super::registries::site_to_grid;
use super::{App, AppError, Caller, MapContext, RuleSetChoice, SemanticsChange, SemanticsOrigin, SemanticsRecord};
use crate::blocking::off_the_runtime;
use crate::records::LostDecision;
use crate::store::{NewCorrections, NewSemanticsRow, now};

impl App {
    /// The semantics in force: the newest assigned version, or the suggestion (version 0).
    pub async fn semantics(&self, caller: &Caller, map: Uuid) -> Result<SemanticsRecord, AppError> {
        Ok(self.context(caller, map).await?.semantics.clone())
    }

    /// Makes a new version; needs `if_match`, the version in force. Answers it, and the labels of single faces that were lost
    /// because other corrections cut their ground otherwise.
    pub async fn change_semantics(
        &self,
        caller: &Caller,
        map: Uuid,
        change: SemanticsChange,
        if_match: Option<u64>,
    ) -> Result<(SemanticsRecord, Vec<LostDecision>), AppError> {
        if matches!(change.rule_set, Some(RuleSetChoice::Unsaved(_))) {
            let detail = "must be the id of a stored rule set: POST /v1/rule-sets stores one";
            return Err(AppError::invalid("/ruleSet", detail));
        }
        let context = self.context_at(caller, map, if_match).await?;
        let CheckedSemantics { row, level, lost } = self.checked_semantics(caller, &context, change, false).await?;
        if matches!(row.corrections, NewCorrections::Changed(_)) {
            self.last_corrected.keep(context.analysis_id, level);
        }
        Ok((self.decide(caller, &context, row).await?, lost))
    }

    /// The map, when the version in force is the one that a decision was made on.
    pub(super) async fn context_at(
        &self,
        caller: &Caller,
        map: Uuid,
        if_match: Option<u64>,
    ) -> Result<Arc<MapContext>, AppError> {
        let context = self.context(caller, map).await?;
        let replaces = if_match.ok_or(AppError::PreconditionRequired)?;
        if replaces != context.semantics.version {
            return Err(AppError::PreconditionFailed { current: context.semantics.version });
        }
        Ok(context)
    }

    /// Stores a decision.
    pub(super) async fn decide(
        &self,
        caller: &Caller,
        context: &MapContext,
        row: NewSemanticsRow,
    ) -> Result<SemanticsRecord, AppError> {
        let is_other_layout = row.layout != context.semantics.layout;
        match self.store.insert_semantics(caller.tenant(), &row, now()).await? {
            None => Err(AppError::not_found("map", row.map)),
            Some(Err(current)) => Err(AppError::PreconditionFailed { current }),
            Some(Ok(record)) => {
                if is_other_layout {
                    // Writes the new codes, which raises the version of the map: not under the first who asks for it.
                    self.context(caller, row.map).await?;
                }
                Ok(record)
            }
        }
    }

    /// All assigned versions, newest first.
    pub async fn semantics_versions(&self, caller: &Caller, map: Uuid) -> Result<Vec<SemanticsRecord>, AppError> {
        self.map(caller, map).await?;
        Ok(self.store.semantics_versions(caller.tenant(), map).await?)
    }

    /// One version; 0 is the suggestion for the analysis in force.
    pub async fn semantics_version(
        &self,
        caller: &Caller,
        map: Uuid,
        version: u64,
    ) -> Result<SemanticsRecord, AppError> {
        if version == 0 {
            let context = self.context(caller, map).await?;
            return off_the_runtime(move || Ok(context.suggested())).await;
        }
        let found = self.semantics_versions(caller, map).await?.into_iter().find(|record| record.version == version);
        found.ok_or_else(|| AppError::not_found("version", version.to_string()))
    }

    /// A decision that can be applied to the analysis in force. What only `is_tried` may have corrections that do not fit.
    pub(super) async fn checked_semantics(
        &self,
        caller: &Caller,
        context: &Arc<MapContext>,
        change: SemanticsChange,
        is_tried: bool,
    ) -> Result<CheckedSemantics, AppError> {
        let (rule_set, draft) = match change.rule_set.clone() {
            None => (context.semantics.rule_set.clone(), context.semantics.draft.clone()),
            Some(RuleSetChoice::Unsaved(draft)) => (context.semantics.rule_set.clone(), draft),
            Some(RuleSetChoice::Stored(id)) => match self.rule_set(caller, &id).await {
                Ok(record) => (record.id, record.draft),
                Err(AppError::NotFound { .. }) => {
                    return Err(AppError::invalid("/ruleSet", format!("there is no rule set {id}")));
                }
                Err(error) => return Err(error),
            },
        };
        let checked = read_rule_set(&draft).map_err(|error| error.below("/ruleSet"))?;
        let (on, limits) = (Arc::clone(context), self.correction_limits());
        off_the_runtime(move || {
            let suggested = Assignment::suggested(&semantics::suggest(&on.analysed, &checked), &checked);
            let mut assignment = change.labels(&on.semantics, &checked, &suggested)?;
            let (mut level, mut lost) = (on.geometric_level(), Vec::new());
            if let Some(wanted) = &change.corrections {
                // A request names faces as it sees them, before its corrections.
                semantics::apply(&on.analysis, &checked, &assignment)?;
                let made = corrections::correct(&on, &checked, wanted, &assignment.overrides, limits, is_tried)?;
                (level, assignment.overrides, lost) = (made.level, made.overrides, made.lost);
            }
            corrections::check_labels(&level.corrections, &checked)?;
            let layout = change.layout.unwrap_or_else(|| on.semantics.layout.clone());
            let semantic = semantics::apply(&level.analysis, &checked, &level.corrections.labelled(&assignment))?;
            let map = level.cells.map(&level.grid, &level.analysis, &semantic);
            check_layout(&on, &map, &layout)?;
            check_lane_rules(&on, &map, &layout)?;
            let row = NewSemanticsRow {
                map: on.record.id,
                analysis: on.analysis_id,
                replaces: on.semantics.version,
                rule_set,
                draft,
                assignment,
                layout,
                corrections: match change.corrections {
                    None => NewCorrections::Stored(on.semantics.corrections),
                    Some(wanted) => NewCorrections::Changed(wanted),
                },
                origin: SemanticsOrigin::Assigned,
                carried: None,
                restores: None,
            };
            Ok(CheckedSemantics { row, level, lost })
        })
        .await
    }
}

/// A decision that can be applied.
#[derive(Debug)]
pub(super) struct CheckedSemantics {
    /// The decision.
    pub(super) row: NewSemanticsRow,
    /// The analysis under its corrections.
    pub(super) level: GeometricLevel,
    /// Labels of single faces that were in force and are lost, because other corrections cut their ground otherwise.
    pub(super) lost: Vec<LostDecision>,
}

/// Refuses new rules about the navigation graph that no node or lane of it fits.
fn check_lane_rules(context: &MapContext, map: &SiteMap<'_>, wish: &LayoutOptions) -> Result<(), AppError> {
    let known = &context.semantics.layout.lane_rules;
    if wish.lane_rules.iter().all(|rule| known.contains(rule)) {
        return Ok(());
    }
    let to_grid = site_to_grid(&context.record, *context.grid.frame());
    let spec = LayoutSpec::wished(wish, &context.analysis.options, &to_grid);
    let router = Router::new(map, spec.vehicle_radius);
    let graph = navigation_graph(map, &layout::layout(map, &spec), &router);
    let unmatched = graph.clone().ruled(&spec.lane_rules).unmatched_rules;
    let Some(index) = unmatched.into_iter().find(|&index| !known.contains(&wish.lane_rules[index])) else {
        return Ok(());
    };
    let near = |place: Point| {
        let node = &graph.nodes[graph.nearest_node(place)?];
        let at = context.analysis.frame.to_map(node.position);
        Some(format!("{} at {:.2},{:.2}", node.name, at.x, at.y))
    };
    let detail = match spec.lane_rules[index] {
        _ if graph.nodes.is_empty() => "the map has no navigation graph: label its corridors first".to_owned(),
        LaneRule::NoNode { at } => {
            format!("no node lies within {NODE_REACH_M} m; the nearest is {}", near(at).unwrap_or_default())
        }
        LaneRule::NoLane { from, to } | LaneRule::OneWay { from, to } => format!(
            "no lane leads past both places; the nearest nodes are {} and {}",
            near(from).unwrap_or_default(),
            near(to).unwrap_or_default()
        ),
    };
    Err(AppError::invalid(&format!("/layout/laneRules/{index}"), detail))
}

/// Refuses a layout whose codes would be too long.
fn check_layout(context: &MapContext, map: &SiteMap<'_>, wish: &LayoutOptions) -> Result<(), AppError> {
    /// How many codes are told.
    const TOLD: usize = 3;
    if wish.code_template == CodeTemplate::default() {
        return Ok(());
    }
    let to_grid = site_to_grid(&context.record, *context.grid.frame());
    let spec = LayoutSpec::wished(wish, &context.analysis.options, &to_grid);
    let long = layout::layout(map, &spec).long_codes;
    if long.is_empty() {
        return Ok(());
    }
    let first = long.iter().take(TOLD).map(|code| format!("`{code}`")).collect::<Vec<_>>().join(", ");
    let detail = format!(
        "{} codes would be longer than {LONGEST_CODE} characters, like {first}: shorten the template, for example to \
         `{}`",
        long.len(),
        CodeTemplate::default().as_str()
    );
    Err(AppError::invalid("/layout/codeTemplate", detail))
}
