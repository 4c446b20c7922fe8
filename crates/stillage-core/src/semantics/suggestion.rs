//! A first label for every category, so that a map has a meaning before anyone has looked at it.
//!
//! Source: the paper assigns labels by hand and says that they could be learned "from characteristics of labels and
//! the occupancy values" (section II-C). This is the plain version of that: a fuzzy reading of what the faces of a
//! category are like, after Zadeh (doi 10.1016/S0019-9958(65)90241-X): *and* is the minimum, *or* the maximum. A
//! label is as likely as the least likely of its functionalities, in any rule set.
//! Cost: O(faces + edges + categories x labels). Limits: categories are judged one by one and as a whole, so a
//! category that mixes places gets the label of most of its area, and a low confidence.

use super::{CategoryEvidence, Functionality, Label, LabelId, RuleSet, Suggestion};
use crate::analysis::Analysis;
use crate::arrangement::FaceId;
use crate::categorization::CategoryMap;
use crate::plot::PlotKind;

/// Below this likelihood a category is better left unidentified: the wrong label closes or opens ways.
const LEAST_LIKELIHOOD: f64 = 0.35;
/// A label that is drivable and nothing else suits every free place, and so says less than one that says more.
const PLAIN_DRIVABLE: f64 = 0.75;
/// A face is lined by an edge, or unexplored, by the majority of its length or cells.
const MAJORITY: f64 = 0.5;

/// Proposes a label for every category of an analysis (clusters, `occupied`, `unknown`, `outside`), ascending.
#[must_use]
pub fn suggest(analysis: &Analysis, rule_set: &RuleSet) -> Vec<Suggestion> {
    let evidence = category_evidence(analysis);
    let mean_beam = mean_beam_of_map(&analysis.categories);
    let propose = |(category, evidence): (usize, CategoryEvidence)| {
        let sight = Sight::of(&analysis.categories, category, mean_beam);
        let category = category as u8;
        if category == analysis.face_categories.outside() {
            return propose_outside(category, evidence, rule_set);
        }
        propose(category, evidence, sight, rule_set)
    };
    evidence.into_iter().enumerate().map(propose).collect()
}

fn propose(category: u8, evidence: CategoryEvidence, sight: Sight, rule_set: &RuleSet) -> Suggestion {
    let nothing = (rule_set.unidentified(), 0.0);
    if evidence.faces == 0 {
        let reason = "No face has this category.".to_owned();
        return Suggestion { category, label: nothing.0, confidence: 0.0, reason, evidence };
    }
    let reading = Reading::new(&evidence, sight);
    let (mut best, mut second) = (nothing, nothing);
    for (index, label) in rule_set.labels().iter().enumerate() {
        let candidate = (LabelId(index as u8), reading.likelihood(label));
        if candidate.1 > best.1 {
            (best, second) = (candidate, best);
        } else if candidate.1 > second.1 {
            second = candidate;
        }
    }
    let name = |id: LabelId| &rule_set.label(id).name;
    let looks = describe(&evidence, sight);
    let (label, confidence, reason) = if best.1 < LEAST_LIKELIHOOD {
        let nearest =
            if best.1 > 0.0 { format!(" (the nearest: {}, {:.2})", name(best.0), best.1) } else { String::new() };
        (nothing.0, 1.0 - best.1, format!("{looks}: no label fits{nearest}."))
    } else {
        // A close second halves the trust in the first.
        let confidence = best.1 - second.1 / 2.0;
        let rival = if second.1 > 0.0 { format!("; next {}, {:.2}", name(second.0), second.1) } else { String::new() };
        (best.0, confidence, format!("{looks}: reads as {} ({:.2}{rival}).", name(best.0), best.1))
    };
    Suggestion { category, label, confidence: confidence.clamp(0.0, 1.0), reason, evidence }
}

/// Nothing is known of the ground outside, whatever it looks like.
fn propose_outside(category: u8, evidence: CategoryEvidence, rule_set: &RuleSet) -> Suggestion {
    let reason = "Unexplored ground around the site.".to_owned();
    Suggestion { category, label: rule_set.unidentified(), confidence: 1.0, reason, evidence }
}

fn describe(evidence: &CategoryEvidence, sight: Sight) -> String {
    let percent = |share: f64| (share * 100.0).round();
    let beams = sight.relative_beam.map(|beam| format!(", beams {beam:.1} times the mean of the map"));
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

/// How far and how unevenly one sees from the cells of a cluster; nothing is known of the other categories.
#[derive(Debug, Clone, Copy, Default)]
struct Sight {
    /// Mean beam length over that of the whole map.
    relative_beam: Option<f64>,
    /// Long over short principal axis of what is seen.
    elongation: Option<f64>,
}

impl Sight {
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

/// Mean beam length over all categorized cells; `None` where it is not known or zero.
fn mean_beam_of_map(categories: &CategoryMap) -> Option<f64> {
    let cells: usize = categories.categories.iter().map(|category| category.cells).sum();
    let weighted = (0..categories.categories.len())
        .filter(|&index| categories.categories[index].cells > 0)
        .map(|index| Some(mean_feature(categories, index, MEAN_BEAM)? * categories.categories[index].cells as f64))
        .sum::<Option<f64>>()?;
    let mean = weighted / cells as f64;
    (mean > 0.0).then_some(mean)
}

/// How true each statement about a category is, 0 to 1.
struct Reading {
    /// Most cells are free.
    free: f64,
    /// Something stands, or could stand, there.
    goods: f64,
    /// It leads along.
    long: f64,
    /// It leads to all sides.
    wide: f64,
    /// Structure runs along it.
    lined: f64,
    /// People could work there.
    roomy: f64,
    /// What its faces were cut out for, where the decomposition says it.
    cut: Option<Cut>,
}

/// What the faces of a category were cut out for: stronger than what they look like.
#[derive(Debug, Clone, Copy)]
struct Cut {
    place: f64,
    aisle: f64,
    floor: f64,
    room: f64,
}

impl Cut {
    /// `None` for faces that were cut out for nothing, as all are in the paper's decomposition.
    fn of(evidence: &CategoryEvidence) -> Option<Self> {
        let (place, aisle, floor) = (evidence.place_fraction, evidence.aisle_fraction, evidence.floor_fraction);
        let (room, rest) = (evidence.room_fraction, evidence.rest_fraction);
        (place + aisle + floor + room + rest > MAJORITY).then_some(Self { place, aisle, floor, room })
    }

    fn suits(self, functionality: Functionality) -> f64 {
        match functionality {
            Functionality::Drivable => self.aisle + self.floor,
            Functionality::StorageAccess | Functionality::Access => self.aisle,
            Functionality::Connection => self.floor,
            Functionality::Storage => self.place,
            Functionality::WorkPlace => self.room,
        }
    }
}

/// 0 up to `low`, 1 from `high` on, straight between.
fn ramp(value: f64, low: f64, high: f64) -> f64 {
    ((value - low) / (high - low)).clamp(0.0, 1.0)
}

impl Reading {
    fn new(evidence: &CategoryEvidence, sight: Sight) -> Self {
        // A place for one EUR pallet has about 1 m2, a bay of three 4 m2; 16 m2 is a block that stands free.
        let (tiny, small) = (1.0 - ramp(evidence.median_area, 2.0, 4.0), 1.0 - ramp(evidence.median_area, 4.0, 16.0));
        // Nine blocks of a pallet cover about a tenth of its place, a misplaced line leaves a twentieth in a corridor.
        let seen_goods = ramp(evidence.occupied_fraction, 0.05, 0.15);
        // Beams do not enter a stack of goods: what stays unknown among known places holds something.
        let unseen = ramp(evidence.unknown_fraction, 0.4, 0.8);
        let free = ramp(evidence.free_fraction, 0.5, 0.85);
        // An empty place has its neighbours on three sides and is open to the fourth at most.
        let closed_in = ramp(evidence.lined_fraction, 0.5, 0.75).min(1.0 - ramp(evidence.open_fraction, 0.25, 0.5));
        let nook = free.min(tiny).min(closed_in);
        let goods = seen_goods.max(small.min(unseen)).max(nook);
        let lined = ramp(evidence.lined_fraction, 0.2, 0.5);
        // Faces may be cut anywhere by the lines of the racks, so beams tell better what is long, and what is wide.
        let long = match sight.elongation {
            Some(ratio) => ramp(ratio, 1.5, 3.5),
            None => ramp(evidence.elongation, 1.5, 4.0),
        };
        let far = sight.relative_beam.map_or(1.0 - lined, |beam| ramp(beam, 0.7, 1.2));
        Self {
            free,
            goods,
            long,
            wide: far.min(1.0 - long),
            lined,
            roomy: ramp(evidence.median_area, 2.0, 8.0),
            cut: Cut::of(evidence),
        }
    }

    /// A label is as likely as the least likely of its functionalities.
    fn likelihood(&self, label: &Label) -> f64 {
        let least = label.functionality.iter().map(|&function| self.suits(function)).fold(1.0, f64::min);
        match label.functionality.as_slice() {
            [] => 0.0,
            [Functionality::Drivable] => least * PLAIN_DRIVABLE,
            _ => least,
        }
    }

    fn suits(&self, functionality: Functionality) -> f64 {
        if let Some(cut) = self.cut {
            return cut.suits(functionality);
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

/// Aggregates the faces and edges of each category.
pub(super) fn category_evidence(analysis: &Analysis) -> Vec<CategoryEvidence> {
    let count = analysis.face_categories.count();
    let borders = Borders::measure(analysis);
    let mut sums = vec![CategoryEvidence::default(); count];
    let mut areas: Vec<Vec<f64>> = vec![Vec::new(); count];
    let mut lengths = vec![0.0; count];
    for face in analysis.subdivision.faces().map(FaceId::index) {
        let annotation = &analysis.faces[face];
        let category = usize::from(annotation.category);
        let (sum, weight) = (&mut sums[category], annotation.area);
        sum.faces += 1;
        sum.area += weight;
        sum.free_fraction += weight * annotation.free_fraction;
        sum.occupied_fraction += weight * annotation.occupied_fraction;
        sum.unknown_fraction += weight * annotation.unknown_fraction;
        sum.elongation += weight * annotation.elongation;
        match annotation.kind {
            Some(PlotKind::Place) => sum.place_fraction += weight,
            Some(PlotKind::Aisle) => sum.aisle_fraction += weight,
            Some(PlotKind::OpenFloor | PlotKind::Passage) => sum.floor_fraction += weight,
            Some(PlotKind::Room) => sum.room_fraction += weight,
            Some(PlotKind::Other) => sum.rest_fraction += weight,
            None => {}
        }
        sum.open_fraction += borders.open[face];
        sum.lined_fraction += borders.lined[face];
        lengths[category] += borders.length[face];
        areas[category].push(annotation.area);
    }
    for ((sum, areas), length) in sums.iter_mut().zip(&mut areas).zip(lengths) {
        let share = |value: f64, whole: f64| if whole > 0.0 { value / whole } else { 0.0 };
        let area = sum.area;
        for mean in [
            &mut sum.free_fraction,
            &mut sum.occupied_fraction,
            &mut sum.unknown_fraction,
            &mut sum.elongation,
            &mut sum.place_fraction,
            &mut sum.aisle_fraction,
            &mut sum.floor_fraction,
            &mut sum.room_fraction,
            &mut sum.rest_fraction,
        ] {
            *mean = share(*mean, area);
        }
        sum.open_fraction = share(sum.open_fraction, length);
        sum.lined_fraction = share(sum.lined_fraction, length);
        sum.median_area = median(areas);
    }
    sums
}

/// Lower median; 0 without values.
fn median(values: &mut [f64]) -> f64 {
    values.sort_by(f64::total_cmp);
    values.get(values.len().saturating_sub(1) / 2).copied().unwrap_or(0.0)
}

/// Lengths along the boundary of each face, metres.
struct Borders {
    length: Vec<f64>,
    open: Vec<f64>,
    /// With an obstacle on the edge, or no free face behind it.
    lined: Vec<f64>,
}

impl Borders {
    fn measure(analysis: &Analysis) -> Self {
        let faces = analysis.faces.len();
        let mut borders = Self { length: vec![0.0; faces], open: vec![0.0; faces], lined: vec![0.0; faces] };
        for edge in analysis.subdivision.edges() {
            let length = analysis.subdivision.length(edge);
            let annotation = &analysis.edges[edge.index()];
            let [left, right] = analysis.subdivision.sides(edge).map(FaceId::index);
            for (face, behind) in [(left, right), (right, left)] {
                let is_lined = annotation.support > MAJORITY || analysis.faces[behind].free_fraction < MAJORITY;
                borders.length[face] += length;
                borders.open[face] += length * annotation.open;
                borders.lined[face] += if is_lined { length } else { 0.0 };
            }
        }
        borders
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

    /// Gives the drawn categories the mean beam lengths and axis ratios that beams would measure.
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
