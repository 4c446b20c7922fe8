//! An analysis read under a rule set and an assignment: labels, cogency, connectivity, places.
//!
//! Source: the paper, section II-C and Fig. 7: C(e) from the labels of N(e), C(l) from C(D(l)).
//! Departures: edges on the outer boundary are cogent and have no link; edges that people said vehicles may pass, or may
//! not, are what they said; edges whose cogency contradicts the cells along them are flagged; rooms, and faces of one
//! label that are mutually open, are merged into places.
//! Cost: O(faces + edges), a few milliseconds for 7,000 faces. Limits: none beyond those of the analysis.

use super::assignment::{Assignment, AssignmentProblem};
use super::cogency::{Cogency, Connectivity};
use super::label::LabelId;
use super::rule_set::RuleSet;
use super::semantic_map::{Place, SemanticMap};
use crate::analysis::Analysis;
use crate::annotation::{EdgeAnnotation, FaceAnnotation};
use crate::arrangement::FaceId;
use crate::excerpt::excerpt;
use crate::geometry::DisjointSets;

/// Share of the length of an edge above which the cells along it count for the whole edge: the majority, as in the
/// paper's annotation ("winner takes all").
const MAJORITY: f64 = 0.5;

/// Reads an analysis under a rule set and an assignment. Pure; milliseconds.
///
/// # Errors
/// A problem for every category, face or label of the assignment that does not exist.
pub fn apply(
    analysis: &Analysis,
    rule_set: &RuleSet,
    assignment: &Assignment,
) -> Result<SemanticMap, Vec<AssignmentProblem>> {
    let decision = Decision::read(analysis, rule_set, assignment)?;
    let labels: Vec<LabelId> =
        (0..analysis.faces.len()).map(|face| decision.label(face, &analysis.faces[face])).collect();
    let confidences = (0..labels.len()).map(|face| decision.confidence(face, &analysis.faces[face])).collect();

    let sides = |edge| analysis.subdivision.sides(edge);
    let is_outer = |edge| sides(edge).contains(&FaceId::OUTER);
    let edges = || analysis.subdivision.edges();
    let cogency: Vec<Cogency> = edges()
        .map(|edge| {
            let [left, right] = sides(edge);
            match analysis.rooms.passages.get(&edge) {
                _ if is_outer(edge) => Cogency::Cogent,
                Some(true) => Cogency::Invalid,
                Some(false) => Cogency::Cogent,
                None => rule_set.cogency(labels[left.index()], labels[right.index()]),
            }
        })
        .collect();
    let connectivity: Vec<Option<Connectivity>> =
        edges().map(|edge| (!is_outer(edge)).then(|| cogency[edge.index()].into())).collect();
    let is_storage = |face: FaceId| rule_set.label(labels[face.index()]).is_storage();
    let disagreements = edges()
        .map(|edge| {
            // Between two storage faces the obstacles along the edge are the goods: no contradiction. Where a person
            // said what an edge is, the cells do not matter.
            !sides(edge).into_iter().all(is_storage)
                && !analysis.rooms.passages.contains_key(&edge)
                && contradicts(cogency[edge.index()], &analysis.edges[edge.index()])
        })
        .collect();
    let (face_places, places) = merge_places(analysis, rule_set, &labels, &connectivity);
    Ok(SemanticMap {
        rule_set: rule_set.clone(),
        labels,
        confidences,
        cogency,
        connectivity,
        disagreements,
        face_places,
        places,
    })
}

/// Whether the cells along an edge contradict its cogency.
///
/// A storage-access edge is never contradicted: the goods behind it are obstacles along it.
fn contradicts(cogency: Cogency, edge: &EdgeAnnotation) -> bool {
    match cogency {
        Cogency::Invalid => edge.support > MAJORITY,
        Cogency::Cogent => edge.open > MAJORITY,
        Cogency::StorageAccess => false,
    }
}

/// An assignment with its label ids resolved.
struct Decision {
    /// Label by category.
    by_category: Vec<LabelId>,
    /// Label by face, where the assignment overrides the category's.
    by_face: Vec<Option<LabelId>>,
}

impl Decision {
    fn read(analysis: &Analysis, rule_set: &RuleSet, assignment: &Assignment) -> Result<Self, Vec<AssignmentProblem>> {
        let categories = analysis.face_categories.count();
        let faces = analysis.faces.len();
        let mut problems = Vec::new();
        let mut by_category = vec![rule_set.unidentified(); categories];
        for (&category, id) in &assignment.assignment {
            let pointer = format!("/assignment/{category}");
            if let Some(label) = look_up(rule_set, id, &pointer, &mut problems) {
                match by_category.get_mut(usize::from(category)) {
                    Some(slot) => *slot = label,
                    None => problems.push(no_such("category", category.into(), 0..categories, pointer)),
                }
            }
        }
        let mut by_face = vec![None; faces];
        for (&face, id) in &assignment.overrides {
            let pointer = format!("/overrides/{face}");
            if let Some(label) = look_up(rule_set, id, &pointer, &mut problems) {
                match by_face.get_mut(face as usize) {
                    Some(slot) if face != FaceId::OUTER.0 => *slot = Some(label),
                    _ => problems.push(no_such("face", face, 1..faces, pointer)),
                }
            }
        }
        // The unbounded face is always unidentified.
        if let Some(outer) = by_face.first_mut() {
            *outer = Some(rule_set.unidentified());
        }
        if problems.is_empty() { Ok(Self { by_category, by_face }) } else { Err(problems) }
    }

    fn label(&self, face: usize, annotation: &FaceAnnotation) -> LabelId {
        self.by_face[face].unwrap_or_else(|| self.of_category(annotation.category))
    }

    fn of_category(&self, category: u8) -> LabelId {
        self.by_category[usize::from(category)]
    }

    /// The sum of the face's shares in all clusters that have its label; the annotation's own confidence for the
    /// categories that are not clusters.
    fn confidence(&self, face: usize, annotation: &FaceAnnotation) -> f64 {
        if self.by_face[face].is_some() {
            return 1.0;
        }
        let label = self.of_category(annotation.category);
        let is_cluster = usize::from(annotation.category) < annotation.category_shares.len();
        if !is_cluster {
            return annotation.confidence;
        }
        let shares = annotation.distribution().iter().zip(&self.by_category);
        shares.filter(|&(_, &of)| of == label).map(|(&share, _)| f64::from(share)).sum::<f64>().clamp(0.0, 1.0)
    }
}

fn look_up(rule_set: &RuleSet, id: &str, pointer: &str, problems: &mut Vec<AssignmentProblem>) -> Option<LabelId> {
    let found = rule_set.find(id);
    if found.is_none() {
        let known: Vec<&str> = rule_set.labels().iter().map(|label| label.id.as_str()).collect();
        let message = format!("no label has the id {:?}; there are {}", excerpt(id), known.join(", "));
        problems.push(AssignmentProblem { pointer: pointer.to_owned(), message });
    }
    found
}

fn no_such(what: &str, id: u32, valid: std::ops::Range<usize>, pointer: String) -> AssignmentProblem {
    let message = if valid.is_empty() {
        format!("no {what} {id}: the map has none")
    } else {
        format!("no {what} {id}: they run from {} to {}", valid.start, valid.end - 1)
    };
    AssignmentProblem { pointer, message }
}

/// Joins faces into places, and numbers the results by their smallest face.
///
/// - A room is one place, whatever labels its faces have; its label is that of most of its area.
/// - Elsewhere faces of one label are joined over connected links. Obstacles along an edge divide drivable places.
///   Between two storage faces the obstacles are the goods, so a block of storage stays one place.
/// - Unidentified faces outside rooms belong to no place.
fn merge_places(
    analysis: &Analysis,
    rule_set: &RuleSet,
    labels: &[LabelId],
    connectivity: &[Option<Connectivity>],
) -> (Vec<Option<u32>>, Vec<Place>) {
    let mut sets = DisjointSets::new(labels.len());
    for edge in analysis.subdivision.edges() {
        let [left, right] = analysis.subdivision.sides(edge);
        let rooms = [left, right].map(|face| analysis.rooms.room(face));
        let [left, right] = [left, right].map(FaceId::index);
        let same = labels[left] == labels[right] && labels[left] != rule_set.unidentified();
        let undivided = rule_set.label(labels[left]).is_storage() || analysis.edges[edge.index()].support <= MAJORITY;
        let is_open = same && undivided && connectivity[edge.index()] == Some(Connectivity::Connected);
        if rooms[0] == rooms[1] && (rooms[0].is_some() || is_open) {
            sets.join(left, right);
        }
    }
    let mut face_places = vec![None; labels.len()];
    let mut places: Vec<Place> = Vec::new();
    for face in analysis.subdivision.faces() {
        let (label, room) = (labels[face.index()], analysis.rooms.room(face));
        if label == rule_set.unidentified() && room.is_none() {
            continue;
        }
        // The root of a set is its smallest face, so it comes first.
        let root = sets.find(face.index());
        let place = face_places[root].unwrap_or(places.len() as u32);
        if place as usize == places.len() {
            places.push(Place { label, room, faces: Vec::new(), area: 0.0 });
        }
        face_places[face.index()] = Some(place);
        places[place as usize].faces.push(face);
        places[place as usize].area += analysis.faces[face.index()].area;
    }
    for place in places.iter_mut().filter(|place| place.room.is_some()) {
        place.label = main_label(analysis, labels, &place.faces).unwrap_or(place.label);
    }
    (face_places, places)
}

/// The label of most of the area of some faces; of equals the first one.
fn main_label(analysis: &Analysis, labels: &[LabelId], faces: &[FaceId]) -> Option<LabelId> {
    let mut areas: Vec<(LabelId, f64)> = Vec::new();
    for face in faces.iter().map(|face| face.index()) {
        let area = analysis.faces[face].area;
        match areas.iter_mut().find(|(label, _)| *label == labels[face]) {
            Some((_, sum)) => *sum += area,
            None => areas.push((labels[face], area)),
        }
    }
    areas.into_iter().reduce(|most, other| if other.1 > most.1 { other } else { most }).map(|(label, _)| label)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::semantics::pictures::DrawnMap;
    use expect_test::{Expect, expect};

    /// Two rows of two pallet places along a corridor that ends in a junction, a wall beyond it, and an unlabelled
    /// nook.
    fn corner_of_a_warehouse() -> DrawnMap {
        DrawnMap::new(
            "
            ####....#..
            ####....#..
            ........#..
            ........#..
            #.##....#..
            #.##....#..
            ",
            "
            ppqqjjjjwxx
            ppqqjjjjwxx
            ccccjjjjwxx
            ccccjjjjwxx
            ppqqjjjjwxx
            ppqqjjjjwxx
            ",
        )
    }

    fn report(map: &DrawnMap, semantic: &SemanticMap) -> String {
        let mut lines = Vec::new();
        for edge in map.analysis.subdivision.edges() {
            let (index, sides) = (edge.index(), map.analysis.subdivision.sides(edge));
            let cogency = semantic.cogency[index];
            let Some(connectivity) = semantic.connectivity[index] else {
                assert_eq!(cogency, Cogency::Cogent, "on the outer boundary");
                continue;
            };
            let [left, right] = sides.map(|face| format!("{}{face}", map.letter(face)));
            let doubt = if semantic.disagreements[index] { ", but the cells disagree" } else { "" };
            lines.push(format!("{left}|{right} {cogency:?}, {connectivity:?}{doubt}"));
        }
        for (number, place) in semantic.places.iter().enumerate() {
            let faces: Vec<u32> = place.faces.iter().map(|face| face.0).collect();
            let label = &semantic.rule_set.label(place.label).id;
            lines.push(format!("place {number}: {label} {faces:?} {:.2} m2", place.area));
        }
        lines.join("\n") + "\n"
    }

    #[test]
    fn edges_links_and_places_follow_from_the_labels() {
        let map = corner_of_a_warehouse();
        let semantic = map.semantic(&RuleSet::warehouse());
        expect![[r#"
            p1|q2 Invalid, Connected
            q2|j3 Cogent, Disconnected
            j3|w4 Cogent, Disconnected
            w4|x5 Cogent, Disconnected
            c6|p1 StorageAccess, StorageAccess
            c6|q2 StorageAccess, StorageAccess
            c6|j3 Invalid, Connected
            p7|c6 StorageAccess, StorageAccess
            q8|c6 StorageAccess, StorageAccess
            p7|q8 Invalid, Connected
            q8|j3 Cogent, Disconnected
            place 0: pc [1, 2] 2.00 m2
            place 1: ju [3] 6.00 m2
            place 2: pc [4] 1.50 m2
            place 3: co [6] 2.00 m2
            place 4: pc [7, 8] 2.00 m2
        "#]]
        .assert_eq(&report(&map, &semantic));
    }

    #[test]
    fn a_wall_divides_a_corridor_but_goods_do_not_divide_a_block_of_storage() {
        let map = DrawnMap::new(
            "
            ..#...
            ..#...
            ..#.##
            ..#.##
            ",
            "
            ccdddd
            ccdddd
            ccddpq
            ccddpq
            ",
        );
        let semantic = map.semantic(&RuleSet::warehouse());
        expect![[r#"
            c1|d2 Invalid, Connected, but the cells disagree
            d2|p3 StorageAccess, StorageAccess
            p3|q4 Invalid, Connected
            d2|p3 StorageAccess, StorageAccess
            d2|q4 StorageAccess, StorageAccess
            place 0: co [1] 2.00 m2
            place 1: co [2] 3.00 m2
            place 2: pc [3, 4] 1.00 m2
        "#]]
        .assert_eq(&report(&map, &semantic));
    }

    fn check_problems(assignment: &[(u8, &str)], overrides: &[(u32, &str)], expected: &Expect) {
        let map = corner_of_a_warehouse();
        let assignment = Assignment {
            assignment: assignment.iter().map(|&(category, id)| (category, id.to_owned())).collect(),
            overrides: overrides.iter().map(|&(face, id)| (face, id.to_owned())).collect(),
        };
        let problems = apply(&map.analysis, &RuleSet::warehouse(), &assignment).err().unwrap_or_default();
        let lines: Vec<String> = problems.iter().map(ToString::to_string).collect();
        expected.assert_eq(&lines.join("\n"));
    }

    #[test]
    fn every_problem_of_an_assignment_is_named_with_its_pointer() {
        check_problems(&[(0, "co"), (6, "un")], &[(8, "pc")], &expect![""]);
        check_problems(
            &[(1, "shelf"), (7, "co")],
            &[(0, "co"), (9, "co"), (3, "")],
            &expect![[r#"
                /assignment/1: no label has the id "shelf"; there are co, ju, pc, un
                /overrides/0: no face 0: they run from 1 to 8
                /overrides/3: no label has the id ""; there are co, ju, pc, un
                /overrides/9: no face 9: they run from 1 to 8"#]],
        );
    }

    #[test]
    fn categories_without_a_label_are_unidentified_and_overrides_are_stronger() {
        let map = corner_of_a_warehouse();
        let corridor = map.face_at(0, 2);
        let assignment =
            Assignment { assignment: [(1, "ju".to_owned())].into(), overrides: [(corridor.0, "co".to_owned())].into() };
        let semantic = apply(&map.analysis, &RuleSet::warehouse(), &assignment).unwrap();
        let labels: String =
            map.draw(|column, row| semantic.label(map.cells.faces.at(column, row)).id.chars().next().unwrap());
        expect![[r#"
            uuuujjjjuuu
            uuuujjjjuuu
            ccccjjjjuuu
            ccccjjjjuuu
            uuuujjjjuuu
            uuuujjjjuuu
        "#]]
        .assert_eq(&labels);
        assert!(semantic.confidences[corridor.index()] >= 1.0);
    }

    #[test]
    fn clusters_of_one_label_add_their_votes() {
        let mut map = corner_of_a_warehouse();
        let corridor = map.face_at(0, 2);
        map.analysis.faces[corridor.index()].category_shares = vec![0.5, 0.25, 0.25, 0.0, 0.0];
        let confidence = |assignment: &[(u8, &str)]| {
            let assignment = assignment.iter().map(|&(category, id)| (category, id.to_owned())).collect();
            let assignment = Assignment { assignment, ..Assignment::default() };
            apply(&map.analysis, &RuleSet::warehouse(), &assignment).unwrap().confidences[corridor.index()]
        };
        assert!((confidence(&[(0, "co"), (1, "ju")]) - 0.5).abs() < 1e-6);
        assert!((confidence(&[(0, "co"), (1, "co")]) - 0.75).abs() < 1e-6);
    }

    #[test]
    fn a_map_without_faces_has_no_places() {
        let map = DrawnMap::new(".", ".");
        let mut analysis = map.analysis;
        analysis.subdivision = crate::arrangement::Subdivision::default();
        (analysis.faces, analysis.edges) = (Vec::new(), Vec::new());
        let semantic = apply(&analysis, &RuleSet::warehouse(), &Assignment::default()).unwrap();
        assert!(semantic.places.is_empty() && semantic.labels.is_empty());
    }
}
