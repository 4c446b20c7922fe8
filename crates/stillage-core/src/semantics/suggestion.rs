//! Suggested labels: one for every category, before a person assigns any.
//!
//! Source: the paper assigns labels by hand and says that they could be learned "from characteristics of labels and
//! the occupancy values" (section II-C). Here they follow from rules of fuzzy logic over the evidence of each category
//! (L. Zadeh, *Fuzzy sets*, 1965, doi 10.1016/S0019-9958(65)90241-X): *and* is the minimum, *or* the maximum. A label is as
//! likely as the least likely of its functionalities, in any rule set.
//! Cost: O(faces + edges + categories x labels). Limits: a category is judged as a whole, so one that mixes kinds of
//! places gets the label of most of its area, with a low confidence.

use serde::{Deserialize, Serialize};

use super::evidence::{CategoryEvidence, category_evidence};
use super::label::{Functionality, Label, LabelId};
use super::rule_set::RuleSet;
use crate::analysis::Analysis;
use crate::categorization::CategoryMap;

/// Least likelihood of a suggested label; below it the category stays unidentified, since a wrong label opens or closes
/// ways. No measurement is recorded for this value.
const LEAST_LIKELIHOOD: f64 = 0.35;
/// Factor on the likelihood of a label that is drivable and nothing else: it fits every free place, so a more specific
/// label is preferred. No measurement is recorded for this value.
const PLAIN_DRIVABLE: f64 = 0.75;
/// Share of a category's area that was cut out as plots above which their kinds decide: the majority.
const MAJORITY: f64 = 0.5;

// Ramps: a statement is false below the first value, true above the second, and in between by degrees. No
// measurement is recorded for their values; where a comment gives a reason, that is their origin.

/// Median face area, square metres: a place for one EUR pallet has about 1, a bay of three 4.
const LARGER_THAN_ONE_PLACE: [f64; 2] = [2.0, 4.0];
/// Median face area, square metres: a bay of three pallets has 4, a free-standing block 16.
const LARGER_THAN_STORAGE: [f64; 2] = [4.0, 16.0];
/// Share of occupied cells: the nine blocks of a pallet cover about a tenth of its place, a misplaced line leaves a
/// twentieth in a corridor.
const HAS_GOODS: [f64; 2] = [0.05, 0.15];
/// Share of unknown cells: beams do not enter a stack of goods.
const UNSEEN: [f64; 2] = [0.4, 0.8];
/// Share of free cells.
const FREE: [f64; 2] = [0.5, 0.85];
/// Share of the border lined by structure: an empty place has neighbours on three sides.
const ENCLOSED: [f64; 2] = [0.5, 0.75];
/// Share of the border that is open: an empty place is open on one side at most.
const OPEN: [f64; 2] = [0.25, 0.5];
/// Share of the border lined by structure: something stands along it.
const LINED: [f64; 2] = [0.2, 0.5];
/// Ratio of the principal axes of what is seen.
const LONG_VIEW: [f64; 2] = [1.5, 3.5];
/// Long over short side of a face.
const LONG_FACE: [f64; 2] = [1.5, 4.0];
/// Mean beam length over that of the map.
const FAR_VIEW: [f64; 2] = [0.7, 1.2];
/// Median face area, square metres: a person can work there.
const ROOMY: [f64; 2] = [2.0, 8.0];

/// A proposed label for a category.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Suggestion {
    /// Category.
    pub category: u8,
    /// Proposed label.
    pub label: LabelId,
    /// Confidence, 0 to 1.
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
        (nothing.0, 1.0 - best.1, format!("{description}: no label fits{nearest}."))
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

/// What is seen from the cells of a cluster; unknown for the other categories.
#[derive(Debug, Clone, Copy, Default)]
struct View {
    /// Mean beam length over that of the whole map.
    relative_beam: Option<f64>,
    /// Long over short principal axis of the end points of the beams.
    elongation: Option<f64>,
}

impl View {
    fn of(categories: &CategoryMap, category: usize, mean_beam: Option<f64>) -> Self {
        let feature = |name| mean_feature(categories, category, name);
        Self {
            relative_beam: feature(MEAN_BEAM).zip(mean_beam).map(|(beam, mean)| beam / mean),
            elongation: feature(AXIS_RATIO),
        }
    }
}

/// Feature of both profiles: the mean beam length.
const MEAN_BEAM: &str = "meanBeamLength";
/// Feature of both profiles: the ratio of the principal axes of the end points of the beams.
const AXIS_RATIO: &str = "pcRatio";

fn mean_feature(categories: &CategoryMap, category: usize, name: &str) -> Option<f64> {
    let index = categories.feature_names.iter().position(|feature| feature == name)?;
    let value = *categories.categories.get(category)?.mean_features.get(index)?;
    value.is_finite().then_some(value)
}

/// Mean beam length over all categorized cells; `None` where it is unknown or zero.
fn mean_beam_of_map(categories: &CategoryMap) -> Option<f64> {
    let cells: usize = categories.categories.iter().map(|category| category.cells).sum();
    let weighted = (0..categories.categories.len())
        .filter(|&index| categories.categories[index].cells > 0)
        .map(|index| Some(mean_feature(categories, index, MEAN_BEAM)? * categories.categories[index].cells as f64))
        .sum::<Option<f64>>()?;
    let mean = weighted / cells as f64;
    (mean > 0.0).then_some(mean)
}

/// Degrees of truth of statements about a category, 0 to 1.
struct Traits {
    /// Most cells are free.
    free: f64,
    /// Goods stand, or could stand, there.
    goods: f64,
    /// It extends along one direction.
    long: f64,
    /// It extends to all sides.
    wide: f64,
    /// Structure runs along its border.
    lined: f64,
    /// People could work there.
    roomy: f64,
    /// What its faces were cut out as; decides alone where it is known.
    plots: Option<PlotShares>,
}

/// Shares of a category's area by what its faces were cut out as.
#[derive(Debug, Clone, Copy)]
struct PlotShares {
    place: f64,
    aisle: f64,
    floor: f64,
    room: f64,
}

impl PlotShares {
    /// `None` where most of the area was cut out as nothing, as all is in the paper's decomposition.
    fn of(evidence: &CategoryEvidence) -> Option<Self> {
        let (place, aisle, floor) = (evidence.place_fraction, evidence.aisle_fraction, evidence.floor_fraction);
        let (room, rest) = (evidence.room_fraction, evidence.rest_fraction);
        (place + aisle + floor + room + rest > MAJORITY).then_some(Self { place, aisle, floor, room })
    }

    fn suit(self, functionality: Functionality) -> f64 {
        match functionality {
            Functionality::Drivable => self.aisle + self.floor,
            Functionality::StorageAccess | Functionality::Access => self.aisle,
            Functionality::Connection => self.floor,
            Functionality::Storage => self.place,
            Functionality::WorkPlace => self.room,
        }
    }
}

/// 0 up to `low`, 1 from `high` on, linear in between.
fn ramp(value: f64, [low, high]: [f64; 2]) -> f64 {
    ((value - low) / (high - low)).clamp(0.0, 1.0)
}

impl Traits {
    fn new(evidence: &CategoryEvidence, view: View) -> Self {
        let is_one_place = 1.0 - ramp(evidence.median_area, LARGER_THAN_ONE_PLACE);
        let is_small = 1.0 - ramp(evidence.median_area, LARGER_THAN_STORAGE);
        let free = ramp(evidence.free_fraction, FREE);
        let enclosed = ramp(evidence.lined_fraction, ENCLOSED).min(1.0 - ramp(evidence.open_fraction, OPEN));
        let empty_place = free.min(is_one_place).min(enclosed);
        let hidden_goods = is_small.min(ramp(evidence.unknown_fraction, UNSEEN));
        let goods = ramp(evidence.occupied_fraction, HAS_GOODS).max(hidden_goods).max(empty_place);
        let lined = ramp(evidence.lined_fraction, LINED);
        // The lines of racks may cut faces anywhere, so beams show better what is long and what is wide.
        let long = match view.elongation {
            Some(ratio) => ramp(ratio, LONG_VIEW),
            None => ramp(evidence.elongation, LONG_FACE),
        };
        let far = view.relative_beam.map_or(1.0 - lined, |beam| ramp(beam, FAR_VIEW));
        Self {
            free,
            goods,
            long,
            wide: far.min(1.0 - long),
            lined,
            roomy: ramp(evidence.median_area, ROOMY),
            plots: PlotShares::of(evidence),
        }
    }

    /// A label is as likely as the least likely of its functionalities.
    fn likelihood(&self, label: &Label) -> f64 {
        let least = label.functionality.iter().map(|&function| self.suit(function)).fold(1.0, f64::min);
        match label.functionality.as_slice() {
            [] => 0.0,
            [Functionality::Drivable] => least * PLAIN_DRIVABLE,
            _ => least,
        }
    }

    fn suit(&self, functionality: Functionality) -> f64 {
        if let Some(plots) = self.plots {
            return plots.suit(functionality);
        }
        let passable = self.free.min(1.0 - self.goods);
        match functionality {
            Functionality::Drivable => passable,
            Functionality::StorageAccess => passable.min(self.long.max(self.lined.min(1.0 - self.wide))),
            Functionality::Access => passable.min(self.long),
            Functionality::Connection => passable.min(self.wide),
            Functionality::Storage => self.goods,
            Functionality::WorkPlace => passable.min(1.0 - self.long).min(self.lined).min(self.roomy),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::semantics::pictures::DrawnMap;
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
                0 co 0.50 100 % free, 0 % occupied, 0 % unknown; 10.0 times as long as wide, 10.0 m2 in the median, 100 % of the border lined by structure: reads as corridor (1.00; next junction, 1.00).
                3 of 0.92 100 % free, 0 % occupied, 0 % unknown; 1.1 times as long as wide, 7.5 m2 in the median, 100 % of the border lined by structure: reads as office (0.92).
                4 un 1.00 9 % free, 91 % occupied, 0 % unknown; 2.5 times as long as wide, 16.0 m2 in the median, 100 % of the border lined by structure: no label fits.
                5 un 1.00 0 % free, 100 % occupied, 0 % unknown; 20.0 times as long as wide, 5.0 m2 in the median, 100 % of the border lined by structure: no label fits.
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
