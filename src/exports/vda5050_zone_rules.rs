//! Which zone of VDA 5050 the faces of a label become.
//!
//! Source: VDA 5050 3.0.0, topic `zoneSet`, field `zoneType`. What is not said otherwise follows from what a label is for:
//!
//! | label | zone |
//! | --- | --- |
//! | drivable, connects ways (junction) | `SPEED_LIMIT` of 1 m/s |
//! | drivable (corridor, room) | `BIDIRECTED`, `SOFT`, along the long side of the face |
//! | work place (office) | `PENALTY` of 0.9 |
//! | storage, unidentified | `BLOCKED` |
//!
//! Limits: a rule set that tells junctions from corridors by their name alone, like that for offices, has no speed limits;
//! `DIRECTED` is missing, because no face knows which way round it is driven.

use serde::Serialize;
use stillage_core::semantics::{LabelId, RuleSet};

use super::source::ExportError;
use super::zones::Ground;

/// Greatest speed where ways meet, metres per second: a slow walk.
const JUNCTION_SPEED: f64 = 1.0;
/// Greatest speed that a rule may set, metres per second: faster than every vehicle.
const GREATEST_SPEED: f64 = 20.0;
/// Penalty of work places: 1 is the last resort.
const WORK_PLACE_PENALTY: f64 = 0.9;
/// Vehicles may leave the direction, to pass one another or to turn to a location, but should not.
const LIMITATION: &str = "SOFT";
/// What a rule may be.
const KNOWN: &str = "NONE, BLOCKED, LINE_GUIDED, COORDINATED_REPLANNING, RELEASE:STOP|CONTINUE|EVACUATE, SPEED_LIMIT:M_PER_S, \
                     ACTION:TYPE, PRIORITY:0..1, PENALTY:0..1 or BIDIRECTED:SOFT|RESTRICTED";

/// What holds in a zone.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[serde(tag = "zoneType", rename_all = "SCREAMING_SNAKE_CASE", rename_all_fields = "camelCase")]
pub enum ZoneRule {
    /// No vehicle enters.
    Blocked,
    /// Vehicles follow a line.
    LineGuided,
    /// The fleet manager has to agree to every new path.
    CoordinatedReplanning,
    /// Vehicles enter when the fleet manager lets them.
    Release {
        /// What a vehicle does that loses its release.
        release_loss_behavior: String,
    },
    /// No vehicle is faster.
    SpeedLimit {
        /// Metres per second.
        maximum_speed: f64,
    },
    /// Vehicles do something when they enter.
    Action {
        /// When they enter.
        entry_actions: Vec<ZoneAction>,
        /// While they are there.
        during_actions: Vec<ZoneAction>,
        /// When they leave.
        exit_actions: Vec<ZoneAction>,
    },
    /// Vehicles like to drive there.
    Priority {
        /// 0 to 1.
        priority_factor: f64,
    },
    /// Vehicles avoid it.
    Penalty {
        /// 0 to 1: only if there is no other way.
        penalty_factor: f64,
    },
    /// Vehicles drive along a direction or against it.
    Bidirected {
        /// Radians.
        direction: f64,
        /// Its name in the branch `main`.
        bidirected_limitation: String,
        /// Its name in the release.
        limitation: String,
    },
}

/// Something that a vehicle does.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
#[serde(rename_all = "camelCase")]
pub struct ZoneAction {
    action_type: String,
    blocking_type: &'static str,
}

/// What a client says of the zones of some labels: id of the label and its rule; `None` for no zone.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct ZoneRules(Vec<(String, Option<ZoneRule>)>);

impl ZoneRules {
    /// Reads `LABEL:RULE` with commas between them.
    ///
    /// # Errors
    /// What is wrong, and what would be right.
    pub fn read(text: &str) -> Result<Self, String> {
        let rule = |part: &str| {
            let (label, rule) = part.trim().split_once(':').ok_or_else(|| format!("{part} is no LABEL:RULE"))?;
            Ok((label.to_owned(), read_rule(rule)?))
        };
        text.split(',').map(rule).collect::<Result<_, String>>().map(Self)
    }

    /// The rules of all labels of a rule set.
    pub(super) fn by_label(&self, rule_set: &RuleSet) -> Result<LabelRules, ExportError> {
        let usual = rule_set.labels().iter().map(|label| Some(usual_rule(Ground::of(label))));
        let mut rules: Vec<Option<ZoneRule>> = usual.collect();
        for (id, rule) in &self.0 {
            let label = rule_set.find(id).ok_or_else(|| ExportError::UnknownLabel {
                option: "zones",
                label: id.clone(),
                known: rule_set.labels().iter().map(|label| label.id.as_str()).collect::<Vec<_>>().join(", "),
            })?;
            rules[usize::from(label.0)].clone_from(rule);
        }
        Ok(LabelRules(rules))
    }
}

/// The rule of each label, by [`LabelId`].
#[derive(Debug)]
pub(super) struct LabelRules(Vec<Option<ZoneRule>>);

impl LabelRules {
    /// The rule of a face with a label and a direction, radians.
    pub fn rule(&self, label: LabelId, along: f64) -> Option<ZoneRule> {
        let mut rule = self.0[usize::from(label.0)].clone();
        if let Some(ZoneRule::Bidirected { direction, .. }) = &mut rule {
            *direction = along;
        }
        rule
    }
}

fn usual_rule(ground: Ground) -> ZoneRule {
    match ground {
        Ground::Blocked => ZoneRule::Blocked,
        Ground::Junction => ZoneRule::SpeedLimit { maximum_speed: JUNCTION_SPEED },
        Ground::WorkPlace => ZoneRule::Penalty { penalty_factor: WORK_PLACE_PENALTY },
        Ground::Way => bidirected(LIMITATION),
    }
}

/// A zone whose direction is that of its face.
fn bidirected(limitation: &str) -> ZoneRule {
    let limitation = limitation.to_owned();
    ZoneRule::Bidirected { direction: 0.0, bidirected_limitation: limitation.clone(), limitation }
}

fn read_rule(text: &str) -> Result<Option<ZoneRule>, String> {
    let (kind, value) = text.split_once(':').map_or((text, None), |(kind, value)| (kind, Some(value)));
    let misfit = || format!("{text} is none of {KNOWN}");
    let word = |words: &[&str]| value.filter(|value| words.contains(value)).map(str::to_owned).ok_or_else(misfit);
    let number = |most: f64| {
        let number = value.and_then(|value| value.parse::<f64>().ok());
        number.filter(|number| (0.0..=most).contains(number)).ok_or_else(misfit)
    };
    let alone = |rule: Option<ZoneRule>| if value.is_none() { Ok(rule) } else { Err(misfit()) };
    Ok(Some(match kind {
        "NONE" => return alone(None),
        "BLOCKED" => return alone(Some(ZoneRule::Blocked)),
        "LINE_GUIDED" => return alone(Some(ZoneRule::LineGuided)),
        "COORDINATED_REPLANNING" => return alone(Some(ZoneRule::CoordinatedReplanning)),
        "RELEASE" => ZoneRule::Release { release_loss_behavior: word(&["STOP", "CONTINUE", "EVACUATE"])? },
        "SPEED_LIMIT" => ZoneRule::SpeedLimit { maximum_speed: number(GREATEST_SPEED)? },
        "ACTION" => {
            let action_type = value.filter(|value| !value.is_empty()).ok_or_else(misfit)?.to_owned();
            let entry_actions = vec![ZoneAction { action_type, blocking_type: "NONE" }];
            ZoneRule::Action { entry_actions, during_actions: Vec::new(), exit_actions: Vec::new() }
        }
        "PRIORITY" => ZoneRule::Priority { priority_factor: number(1.0)? },
        "PENALTY" => ZoneRule::Penalty { penalty_factor: number(1.0)? },
        "BIDIRECTED" => bidirected(&word(&["SOFT", "RESTRICTED"])?),
        _ => return Err(misfit()),
    }))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rules_are_read_and_refused_by_the_words_of_the_standard() {
        let rules = ZoneRules::read("ju:SPEED_LIMIT:0.5,pc:NONE,un:ACTION:slowDown").unwrap();
        assert_eq!(rules.0[0], ("ju".to_owned(), Some(ZoneRule::SpeedLimit { maximum_speed: 0.5 })));
        assert_eq!(rules.0[1], ("pc".to_owned(), None));
        for wrong in
            ["ju", "ju:FAST", "ju:SPEED_LIMIT", "ju:SPEED_LIMIT:-1", "ju:PENALTY:2", "ju:BLOCKED:1", "ju:ACTION:", ""]
        {
            assert!(ZoneRules::read(wrong).is_err(), "{wrong}");
        }
    }

    #[test]
    fn a_label_that_is_not_there_is_refused_with_those_that_are() {
        let refused = ZoneRules::read("xx:BLOCKED").unwrap().by_label(&RuleSet::warehouse()).unwrap_err();
        let ExportError::UnknownLabel { label, known, .. } = refused else { panic!("{refused}") };
        assert_eq!((label.as_str(), known.contains("pc")), ("xx", true));
    }
}
