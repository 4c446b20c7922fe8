//! Suggested labels: one for every category, before a person assigns any.
//!
//! Source: the paper assigns labels by hand and says that they could be learned "from characteristics of labels and the
//! occupancy values" (section II-C). Here they follow from rules of fuzzy logic over the evidence of each category (L.
//! Zadeh, *Fuzzy sets*, 1965, doi 10.1016/S0019-9958(65)90241-X): *and* is the minimum, *or* the maximum. A label is as
//! likely as the least likely of its functionalities, in any rule set (of two kinds of access, the likelier counts).
//! Cost: O(faces + edges + categories x labels).
//! Limits: a category is judged as a whole, so one that mixes kinds of places gets the label of most of its area, with
//! a low confidence.

use serde::{Deserialize, Serialize};

use super::evidence::{CategoryEvidence, category_evidence};
use super::label::LabelId;
use super::rule_set::RuleSet;
use super::traits::Traits;
use super::view::{View, mean_beam_of_map};
use crate::analysis::Analysis;

/// Least likelihood of a suggested label; below it the category stays unidentified, since a wrong label opens or closes
/// ways. No measurement is recorded for this value.
const LEAST_LIKELIHOOD: f64 = 0.35;

/// A proposed label for a category.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Suggestion {
    /// Category.
    pub category: u8,
    /// Proposed label.
    pub label: LabelId,
    /// Confidence, 0 to 1; 0 where no label fits.
    pub confidence: f64,
    /// The reason, in words.
    pub reason: String,
    /// What the proposal is based on.
    pub evidence: CategoryEvidence,
}

/// Proposes a label for every category of an analysis (clusters, `occupied`, `unknown`, `outside`), ascending.
#[must_use]
pub fn suggest(analysis: &Analysis, rule_set: &RuleSet) -> Vec<Suggestion> {
    let evidence = category_evidence(analysis);
    let mean_beam = mean_beam_of_map(&analysis.categories);
    let propose = |(category, evidence): (usize, CategoryEvidence)| {
        let view = View::of(&analysis.categories, category, mean_beam);
        let category = category as u8;
        if category == analysis.face_categories.outside() {
            return propose_outside(category, evidence, rule_set);
        }
        propose(category, evidence, view, rule_set)
    };
    evidence.into_iter().enumerate().map(propose).collect()
}

fn propose(category: u8, evidence: CategoryEvidence, view: View, rule_set: &RuleSet) -> Suggestion {
    let nothing = (rule_set.unidentified(), 0.0);
    if evidence.faces == 0 {
        let reason = "No face has this category.".to_owned();
        return Suggestion { category, label: nothing.0, confidence: 0.0, reason, evidence };
    }
    let traits = Traits::new(&evidence, view);
    let (mut best, mut second) = (nothing, nothing);
    for (index, label) in rule_set.labels().iter().enumerate() {
        let candidate = (LabelId(index as u8), traits.likelihood(label));
        if candidate.1 > best.1 {
            (best, second) = (candidate, best);
        } else if candidate.1 > second.1 {
            second = candidate;
        }
    }
    let name = |id: LabelId| &rule_set.label(id).name;
    let description = describe(&evidence, view);
    let (label, confidence, reason) = if best.1 < LEAST_LIKELIHOOD {
        let nearest =
            if best.1 > 0.0 { format!(" (the nearest: {}, {:.2})", name(best.0), best.1) } else { String::new() };
        // Nothing is proposed, so there is nothing to be sure of.
        (nothing.0, 0.0, format!("{description}: no label fits{nearest}."))
    } else {
        // A second label that is as likely halves the confidence.
        let confidence = best.1 - second.1 / 2.0;
        let rival = if second.1 > 0.0 { format!("; next {}, {:.2}", name(second.0), second.1) } else { String::new() };
        (best.0, confidence, format!("{description}: reads as {} ({:.2}{rival}).", name(best.0), best.1))
    };
    Suggestion { category, label, confidence: confidence.clamp(0.0, 1.0), reason, evidence }
}

/// The ground outside the site stays unidentified, whatever its evidence.
fn propose_outside(category: u8, evidence: CategoryEvidence, rule_set: &RuleSet) -> Suggestion {
    let reason = "Unexplored ground around the site.".to_owned();
    Suggestion { category, label: rule_set.unidentified(), confidence: 1.0, reason, evidence }
}

fn describe(evidence: &CategoryEvidence, view: View) -> String {
    let percent = |share: f64| (share * 100.0).round();
    let beams = view.relative_beam.map(|beam| format!(", beams {beam:.1} times the mean of the map"));
    format!(
        "{} % free, {} % occupied, {} % unknown; {:.1} times as long as wide, {:.1} m2 in the median, {} % of the \
         border lined by structure{}",
        percent(evidence.free_fraction),
        percent(evidence.occupied_fraction),
        percent(evidence.unknown_fraction),
        evidence.elongation,
        evidence.median_area,
        percent(evidence.lined_fraction),
        beams.unwrap_or_default(),
    )
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::semantics::pictures::DrawnMap;
    use crate::semantics::view::{AXIS_RATIO, MEAN_BEAM};
    use expect_test::{Expect, expect};

    fn check(map: &DrawnMap, rule_set: &RuleSet, expected: &Expect) {
        let suggestions = suggest(&map.analysis, rule_set);
        assert_eq!(suggestions.len(), map.analysis.face_categories.count());
        let line = |suggestion: &Suggestion| {
            let Suggestion { category, label, confidence, reason, .. } = suggestion;
            format!("{category} {} {confidence:.2} {reason}\n", rule_set.label(*label).id)
        };
        expected.assert_eq(&suggestions.iter().filter(|one| one.evidence.faces > 0).map(line).collect::<String>());
    }

    /// Gives the drawn categories mean beam lengths and axis ratios.
    fn with_sight(mut map: DrawnMap, sight: &[[f64; 2]]) -> DrawnMap {
        map.analysis.categories.feature_names = vec![MEAN_BEAM.to_owned(), AXIS_RATIO.to_owned()];
        for (category, sight) in map.analysis.categories.categories.iter_mut().zip(sight) {
            category.mean_features = sight.to_vec();
        }
        map
    }

    /// Racks of which a laser sees the fronts, aisles cut across by the lines of the racks, unexplored ground around.
    fn warehouse() -> DrawnMap {
        DrawnMap::new(
            "
            ????????????????????
            ?########....#######
            ??######?....?#####?
            ?...................
            ?...................
            ?...................
            ?...................
            ??######?....?#####?
            ?########....#######
            ????????????????????
            ",
            "
            uuuuuuuuuuuuuuuuuuuu
            uppqqppqqjjjjppqqppq
            uppqqppqqjjjjppqqppq
            uccddccddjjjjccddccd
            uccddccddjjjjccddccd
            uccddccddjjjjccddccd
            uccddccddjjjjccddccd
            uppqqppqqjjjjppqqppq
            uppqqppqqjjjjppqqppq
            uuuuuuuuuuuuuuuuuuuu
            ",
        )
    }

    #[test]
    fn a_warehouse_is_read_from_its_faces_and_beams() {
        let sight = [[5.0, 6.0], [8.0, 1.5]];
        check(
            &with_sight(warehouse(), &sight),
            &RuleSet::warehouse(),
            &expect![[r#"
                0 co 1.00 100 % free, 0 % occupied, 0 % unknown; 2.1 times as long as wide, 2.0 m2 in the median, 40 % of the border lined by structure, beams 0.8 times the mean of the map: reads as corridor (1.00).
                1 ju 1.00 100 % free, 0 % occupied, 0 % unknown; 2.0 times as long as wide, 8.0 m2 in the median, 67 % of the border lined by structure, beams 1.3 times the mean of the map: reads as junction (1.00).
                5 pc 1.00 0 % free, 87 % occupied, 13 % unknown; 1.1 times as long as wide, 1.0 m2 in the median, 82 % of the border lined by structure: reads as pallet cell (1.00).
                7 un 1.00 Unexplored ground around the site.
            "#]],
        );
    }

    #[test]
    fn a_warehouse_is_read_without_beams_too() {
        check(
            &warehouse(),
            &RuleSet::warehouse(),
            &expect![[r#"
                0 co 0.52 100 % free, 0 % occupied, 0 % unknown; 2.1 times as long as wide, 2.0 m2 in the median, 40 % of the border lined by structure: reads as corridor (0.68; next junction, 0.32).
                1 co 1.00 100 % free, 0 % occupied, 0 % unknown; 2.0 times as long as wide, 8.0 m2 in the median, 67 % of the border lined by structure: reads as corridor (1.00).
                5 pc 1.00 0 % free, 87 % occupied, 13 % unknown; 1.1 times as long as wide, 1.0 m2 in the median, 82 % of the border lined by structure: reads as pallet cell (1.00).
                7 un 1.00 Unexplored ground around the site.
            "#]],
        );
    }

    #[test]
    fn an_office_is_read_as_rooms_along_a_corridor() {
        let map = DrawnMap::new(
            "
            ####################
            #......#.....#.....#
            #......#.....#.....#
            #......#.....#.....#
            #......#.....#.....#
            #......#.....#.....#
            #......#.....#.....#
            ###..####..####..###
            ....................
            ....................
            ####################
            ",
            "
            wwwwwwwwwwwwwwwwwwww
            woooooowooooowooooow
            woooooowooooowooooow
            woooooowooooowooooow
            woooooowooooowooooow
            woooooowooooowooooow
            woooooowooooowooooow
            wwwwwwwwwwwwwwwwwwww
            cccccccccccccccccccc
            cccccccccccccccccccc
            wwwwwwwwwwwwwwwwwwww
            ",
        );
        let sight = [[3.0, 6.0], [1.0, 1.0], [1.0, 1.0], [2.0, 1.4]];
        check(
            &with_sight(map, &sight),
            &RuleSet::office(),
            &expect![[r#"
                0 co 1.00 100 % free, 0 % occupied, 0 % unknown; 10.0 times as long as wide, 10.0 m2 in the median, 100 % of the border lined by structure: reads as corridor (1.00).
                3 of 0.92 100 % free, 0 % occupied, 0 % unknown; 1.1 times as long as wide, 7.5 m2 in the median, 100 % of the border lined by structure: reads as office (0.92).
                4 un 0.00 9 % free, 91 % occupied, 0 % unknown; 2.5 times as long as wide, 16.0 m2 in the median, 100 % of the border lined by structure: no label fits.
                5 un 0.00 0 % free, 100 % occupied, 0 % unknown; 20.0 times as long as wide, 5.0 m2 in the median, 100 % of the border lined by structure: no label fits.
            "#]],
        );
    }

    #[test]
    fn a_rule_set_of_unidentified_places_gets_no_other_label() {
        let mut draft = RuleSet::warehouse().draft().clone();
        draft.labels.drain(..3);
        let suggestions = suggest(&warehouse().analysis, &draft.check().unwrap());
        assert!(suggestions.iter().all(|suggestion| suggestion.label == LabelId(0)));
    }
}
