use super::*;
use crate::geometry::{RigidMotion, Vector};
use crate::semantics::pictures::DrawnMap;

/// Two racks with a corridor between them, and a corner that is free.
const CELLS: &str = "
    ##.#....
    #.##....
    ........
    ........
    ##.##.##
    .###.##.
";

/// As it was analysed first: places of two columns, and the corner a junction.
const FIRST: &str = "
    ppqqjjjj
    ppqqjjjj
    cccccccc
    cccccccc
    qqppppqq
    qqppppqq
";

fn drawn(faces: &str) -> DrawnMap {
    DrawnMap::new(CELLS, faces)
}

fn decision(categories: &[(u8, &str)], faces: &[(FaceId, &str)]) -> Assignment {
    Assignment {
        assignment: categories.iter().map(|&(category, label)| (category, label.to_owned())).collect(),
        overrides: faces.iter().map(|&(face, label)| (face.0, label.to_owned())).collect(),
    }
}

/// The suggested labels with changes.
fn changed(map: &DrawnMap, changes: &Assignment) -> Assignment {
    let rules = RuleSet::warehouse();
    let mut all = Assignment::suggested(&suggest(&map.analysis, &rules), &rules);
    all.assignment.extend(changes.assignment.clone());
    all.overrides.extend(changes.overrides.clone());
    all
}

fn ground(map: &DrawnMap) -> AnalysisGround<'_> {
    AnalysisGround { analysis: &map.analysis, cells: &map.cells.faces }
}

fn carried(old: &DrawnMap, decision: &Assignment, new: &DrawnMap) -> CarriedLabels {
    carry(ground(old), decision, ground(new), &RuleSet::warehouse())
}

/// The label of every cell, by the first letter of its id.
fn picture(map: &DrawnMap, labels: &Assignment) -> String {
    let semantic = crate::semantics::apply(&map.analysis, &RuleSet::warehouse(), labels).expect("labels that exist");
    map.draw(|column, row| semantic.label(map.cells.faces.at(column, row)).id.chars().next().unwrap_or(' '))
}

/// The corner is a junction, and the rack on the lower left is gone: what a person said of the first drawing.
fn decided() -> (DrawnMap, Assignment) {
    let map = drawn(FIRST);
    let gone = map.face_at(0, 4);
    let labels = changed(&map, &decision(&[(1, "ju")], &[(gone, "co")]));
    (map, labels)
}

#[test]
fn the_same_analysis_keeps_everything() {
    let (map, labels) = decided();
    let carried = carried(&map, &labels, &map);
    assert_eq!(carried, CarriedLabels { assignment: labels, kept: 2, lost: Vec::new() });
}

#[test]
fn labels_follow_the_ground_and_not_the_numbers_of_categories() {
    let (old, labels) = decided();
    let new = drawn(
        "
        jjjjoooo
        jjjjoooo
        pppppppp
        pppppppp
        xxjjjjjj
        xxjjjjjj
        ",
    );
    let carried = carried(&old, &labels, &new);
    let of_category = [1, 2, 3].map(|category| carried.assignment.assignment[&category].as_str());
    assert_eq!(of_category, ["pc", "co", "ju"]);
    assert_eq!(carried.assignment.overrides, decision(&[], &[(new.face_at(0, 4), "co")]).overrides);
    assert_eq!((carried.kept, carried.lost.len()), (2, 0));
    assert_eq!(picture(&new, &carried.assignment), picture(&old, &labels));
}

#[test]
fn a_face_has_the_label_that_was_decided_for_most_of_it() {
    let (old, labels) = decided();
    let new = drawn(
        "
        oooodddc
        oooodddc
        cccccccc
        cccccccc
        oooopppp
        oooopppp
        ",
    );
    let carried = carried(&old, &labels, &new);
    let drawn = picture(&new, &carried.assignment);
    let expected = ["ppppjjjc", "ppppjjjc", "cccccccc", "cccccccc", "pppppppp", "pppppppp"];
    assert_eq!(drawn.lines().collect::<Vec<_>>(), expected);
    // The corner kept most of its ground; the rack that is gone is half of a larger face, which stays a rack.
    let subject = LabelSubject::Face(old.face_at(0, 4).0);
    let lost = LostLabel { subject, label: "co".to_owned(), at: Point::new(0.5, 0.5) };
    assert_eq!((carried.kept, carried.lost), (1, vec![lost]));
}

#[test]
fn ground_that_is_cut_finer_keeps_its_label_in_all_pieces() {
    let (old, labels) = decided();
    let new = drawn(
        "
        ppqqjjjj
        ppqqjjjj
        cccccccc
        cccccccc
        xoppppqq
        xoppppqq
        ",
    );
    let carried = carried(&old, &labels, &new);
    let pieces = [new.face_at(0, 4), new.face_at(1, 4)].map(|face| (face, "co"));
    assert_eq!(carried.assignment.overrides, decision(&[], &pieces).overrides);
    assert_eq!((carried.kept, carried.lost.len()), (2, 0));
}

#[test]
fn a_category_whose_ground_has_another_label_is_lost() {
    let (old, labels) = decided();
    let new = drawn(
        "
        ppqqcccc
        ppqqcccc
        cccccccc
        cccccccc
        xxppppqq
        xxppppqq
        ",
    );
    let carried = carried(&old, &labels, &new);
    let subjects: Vec<LabelSubject> = carried.lost.iter().map(|lost| lost.subject).collect();
    assert_eq!((carried.kept, subjects), (1, vec![LabelSubject::Category(1)]));
    assert_eq!(carried.lost[0].at, Point::new(3.0, 2.5), "inside the corner");
    assert_eq!(carried.assignment.assignment[&0], "co");
}

#[test]
fn ground_that_nobody_decided_on_brings_no_labels_of_its_own_to_faces() {
    let old = drawn(FIRST);
    let new = drawn(
        "
        cccccccc
        cccccccc
        cccccccc
        cccccccc
        ppppqqqq
        ppppqqqq
        ",
    );
    let carried = carried(&old, &changed(&old, &Assignment::default()), &new);
    assert_eq!((carried.kept, carried.lost.len()), (0, 0));
    assert!(carried.assignment.overrides.is_empty(), "{carried:?}");
}

#[test]
fn labels_come_along_to_a_later_map_that_shows_less_of_the_site() {
    let old = drawn(FIRST);
    let gone = old.face_at(0, 4);
    // The corner and a rack have other labels; the next map shows all but the two columns at the right, turned upside down.
    let labels = changed(&old, &decision(&[(1, "ju")], &[(gone, "co")]));
    let cells = "
        #.##.#
        #.##.#
        ......
        ......
        ..##.#
        ...#.#
    ";
    let new = DrawnMap::new(
        cells,
        "
        ppppqq
        ppppqq
        cccccc
        cccccc
        jjqqpp
        jjqqpp
        ",
    );
    let half_turn = RigidMotion { shift: Vector::new(3.0, 3.0), turn: std::f64::consts::PI };
    let seen = old.cells.faces.seen_on(old.grid.resolution(), &new.grid, &half_turn);
    let carried =
        carry(AnalysisGround { analysis: &old.analysis, cells: &seen }, &labels, ground(&new), &RuleSet::warehouse());
    assert_eq!((carried.kept, carried.lost.len()), (2, 0), "{carried:?}");
    let expected = ["ppppcc", "ppppcc", "cccccc", "cccccc", "jjpppp", "jjpppp"];
    assert_eq!(picture(&new, &carried.assignment).lines().collect::<Vec<_>>(), expected);
}

#[test]
fn a_decision_on_ground_that_a_later_map_does_not_show_is_lost() {
    let old = drawn(FIRST);
    let labels = changed(&old, &decision(&[(1, "ju")], &[(old.face_at(0, 4), "co")]));
    let new = DrawnMap::new("####\n....", "pppp\ncccc");
    let far = RigidMotion { shift: Vector::new(50.0, 0.0), turn: 0.0 };
    let seen = old.cells.faces.seen_on(old.grid.resolution(), &new.grid, &far);
    let carried =
        carry(AnalysisGround { analysis: &old.analysis, cells: &seen }, &labels, ground(&new), &RuleSet::warehouse());
    let subjects: Vec<LabelSubject> = carried.lost.iter().map(|lost| lost.subject).collect();
    assert_eq!((carried.kept, subjects), (0, vec![LabelSubject::Category(1), LabelSubject::Face(old.face_at(0, 4).0)]));
}

#[test]
fn ground_that_had_no_label_is_not_labelled_by_the_little_that_had_one() {
    let old = drawn(
        "
        cccccccc
        cccccccc
        cccccccc
        cccccccc
        ppxxxxxx
        ppxxxxxx
        ",
    );
    // The ground that was outside of all categories and a place beside it share a category now.
    let new = drawn(
        "
        cccccccc
        cccccccc
        cccccccc
        cccccccc
        jjjjjjjj
        jjjjjjjj
        ",
    );
    let labels = changed(&old, &decision(&[(2, "pc")], &[]));
    let rules = RuleSet::warehouse();
    let suggested = Assignment::suggested(&suggest(&new.analysis, &rules), &rules);
    assert_eq!(carried(&old, &labels, &new).assignment.assignment[&1], suggested.assignment[&1]);
}
