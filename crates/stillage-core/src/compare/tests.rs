use proptest::prelude::*;

use super::PlaceChange::{Emptied, Filled, Moved, Relabelled};
use super::*;
use crate::geometry::Point;

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

#[test]
fn faces_are_compared_by_number() {
    let changes = compare_labels([(1, "co"), (2, "ju"), (3, "pc")], [(2, "co"), (3, "pc"), (4, "un")]);
    let change = |face, before: Option<&str>, now: Option<&str>| LabelChange {
        face,
        before: before.map(Into::into),
        now: now.map(Into::into),
    };
    assert_eq!(changes, [change(1, Some("co"), None), change(2, Some("ju"), Some("co")), change(4, None, Some("un"))]);
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
