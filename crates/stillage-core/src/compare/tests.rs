use proptest::prelude::*;

use super::PlaceChange::{Emptied, Filled, Moved, Relabelled};
use super::*;
use crate::arrangement::FaceId;
use crate::geometry::Point;
use crate::semantics::pictures::DrawnMap;

/// A place of 1 m x 1.2 m with its lower left corner at (x, y).
fn footprint(x: f64, y: f64) -> Footprint {
    let outline = [(0.0, 0.0), (1.0, 0.0), (1.0, 1.2), (0.0, 1.2)].map(|(dx, dy)| Point::new(x + dx, y + dy)).to_vec();
    Footprint { outline, center: Point::new(x + 0.5, y + 0.6) }
}

fn place(code: &str, x: f64, y: f64, occupied: bool) -> ComparedPlace {
    ComparedPlace { code: code.into(), footprint: footprint(x, y), label: "pc".into(), occupied: Some(occupied) }
}

#[test]
fn what_came_what_went_and_what_changed_is_told() {
    let old = [
        place("a", 0.0, 0.0, true),
        place("b", 1.0, 0.0, false),
        place("c", 2.0, 0.0, true),
        place("d", 9.0, 0.0, true),
    ];
    let mut new = vec![
        place("b", 1.02, 0.0, true),
        place("a", 0.0, 0.0, false),
        place("e", 5.0, 0.0, true),
        place("d", 9.0, 4.0, true),
    ];
    new[1].label = "un".into();
    let found = compare(&old, &new);
    assert_eq!((found.added, found.removed), (vec![2], vec![2]));
    let changes: Vec<_> = found.matched.iter().map(|pair| (pair.old, pair.new, pair.changes.as_slice())).collect();
    assert_eq!(changes, [(0, 1, &[Relabelled, Emptied][..]), (1, 0, &[Filled]), (3, 3, &[Moved]),]);
}

#[test]
fn a_place_goes_to_the_better_of_two_and_has_a_rival() {
    let found = pairs(&[footprint(0.0, 0.0)], &[footprint(0.3, 0.0), footprint(-0.25, 0.0)]);
    assert_eq!(found.len(), 1);
    assert!(found[0].new == 1 && found[0].has_rival && (found[0].share - 0.6).abs() < 1e-6, "{found:?}");
}

#[test]
fn neighbours_in_a_row_are_no_rivals() {
    let row: Vec<Footprint> = (0..5).map(|index| footprint(f64::from(index), 0.0)).collect();
    let shifted: Vec<Footprint> = (0..5).map(|index| footprint(f64::from(index) + 0.2, 0.0)).collect();
    let found = pairs(&row, &shifted);
    assert!(found.iter().all(|pair| pair.old == pair.new && !pair.has_rival), "{found:?}");
    assert_eq!(found.len(), 5);
}

/// The differences from one drawn map to another: number and label before, number and label now, `*` for another shape.
fn differences(before: (&DrawnMap, &[&str]), now: (&DrawnMap, &[&str])) -> Vec<String> {
    let differences = compare_faces(
        LabelledFaces { cells: &before.0.cells.faces, labels: before.1 },
        LabelledFaces { cells: &now.0.cells.faces, labels: now.1 },
    );
    let side = |side: &Option<LabelledFace>| {
        side.as_ref().map_or_else(|| "-".to_owned(), |face| format!("{}{}", face.face.0, face.label))
    };
    let told = |difference: &FaceDifference| {
        let star = if difference.is_reshaped { "*" } else { "" };
        format!("{} {}{star}", side(&difference.before), side(&difference.now))
    };
    differences.iter().map(told).collect()
}

#[test]
fn faces_of_one_arrangement_are_compared_by_number() {
    let map = DrawnMap::new("....\n....", "aabb\naabb");
    let reading = |labels| LabelledFaces { cells: &map.cells.faces, labels };
    let differences = compare_faces(reading(&["", "co", "ju"]), reading(&["", "co", "pc"]));
    let side = |label: &str| Some(LabelledFace { face: FaceId(2), label: label.to_owned() });
    assert_eq!(differences, [FaceDifference { before: side("ju"), now: side("pc"), is_reshaped: false }]);
}

#[test]
fn faces_of_two_arrangements_are_compared_by_their_cells() {
    let two = DrawnMap::new("......\n......", "aaabbb\naaabbb");
    let labels = ["", "co", "pc"];
    let again = DrawnMap::new("......\n......", "aaabbb\naaabbb");
    assert!(differences((&two, &labels), (&again, &labels)).is_empty());
    let moved = DrawnMap::new("......\n......", "aaaabb\naaaabb");
    assert_eq!(differences((&two, &labels), (&moved, &labels)), ["1co 1co*", "2pc 2pc*"]);
    let cut = DrawnMap::new("......\n......", "aaabcd\naaabcd");
    assert_eq!(
        differences((&two, &labels), (&cut, &["", "co", "pc", "pc", "ju"])),
        ["- 2pc", "- 3pc", "- 4ju", "2pc -"],
        "no third of a face is the face"
    );
    assert_eq!(
        differences((&cut, &["", "co", "pc", "pc", "ju"]), (&two, &labels)),
        ["- 2pc", "2pc -", "3pc -", "4ju -"]
    );
}

fn places() -> impl Strategy<Value = Vec<ComparedPlace>> {
    prop::collection::vec((0.0..8.0, 0.0..8.0, any::<bool>()), 0..12).prop_map(|places| {
        let numbered = places.into_iter().enumerate();
        numbered.map(|(index, (x, y, occupied))| place(&format!("{index}"), x, y, occupied)).collect()
    })
}

proptest! {
    #[test]
    fn every_place_is_told_once_and_the_way_back_is_the_mirror_image(old in places(), new in places()) {
        let (there, back) = (compare(&old, &new), compare(&new, &old));
        prop_assert_eq!(there.matched.len() + there.removed.len(), old.len());
        prop_assert_eq!(there.matched.len() + there.added.len(), new.len());
        prop_assert_eq!((&there.added, &there.removed), (&back.removed, &back.added));
        let mut mirrored: Vec<_> = back.matched.iter().map(|pair| (pair.new, pair.old, pair.changes.contains(&Emptied))).collect();
        mirrored.sort_unstable();
        let told: Vec<_> = there.matched.iter().map(|pair| (pair.old, pair.new, pair.changes.contains(&Filled))).collect();
        prop_assert_eq!(told, mirrored);
    }

    #[test]
    fn a_map_is_like_itself(old in places()) {
        let found = compare(&old, &old);
        prop_assert!(found.matched.iter().all(|pair| pair.changes.is_empty() || pair.old != pair.new));
        prop_assert!(found.added.is_empty() && found.removed.is_empty());
    }
}
