use proptest::prelude::*;

use super::*;
use crate::compare::Footprint;
use crate::geometry::Point;

/// A place of 1 m x 1.2 m with its lower left corner at (x, 0).
fn location(code: &str, x: f64) -> NumberedLocation {
    let outline = [(0.0, 0.0), (1.0, 0.0), (1.0, 1.2), (0.0, 1.2)].map(|(dx, dy)| Point::new(x + dx, dy)).to_vec();
    NumberedLocation { code: code.into(), footprint: Footprint { outline, center: Point::new(x + 0.5, 0.6) } }
}

/// Places in a row, numbered from the left.
fn row(places: &[f64]) -> Vec<NumberedLocation> {
    places.iter().enumerate().map(|(index, &x)| location(&format!("01-{:03}", 2 * index + 1), x)).collect()
}

fn codes(carried: &Carried) -> Vec<&str> {
    carried.codes.iter().map(|given| given.code.as_str()).collect()
}

fn states(registry: &Registry) -> Vec<(&str, PlaceState)> {
    registry.entries.iter().map(|entry| (entry.code.as_str(), entry.state)).collect()
}

use PlaceState::{Current, Lost, Stale};

#[test]
fn the_first_numbering_makes_the_registry() {
    let carried = Registry::default().carry(&row(&[0.0, 1.0]), Trust::Newest, "scan");
    assert_eq!(codes(&carried), ["01-001", "01-003"]);
    assert_eq!(states(&carried.registry), [("01-001", Current), ("01-003", Current)]);
}

#[test]
fn codes_stay_with_their_places_when_one_is_gone_and_one_is_new() {
    let first = Registry::default().carry(&row(&[0.0, 1.0, 2.0]), Trust::Newest, "scan").registry;
    // The numbering begins anew: without the registry, every place would have another code.
    let second = first.carry(&row(&[1.02, 2.0, 3.0]), Trust::Newest, "scan");
    assert_eq!(codes(&second), ["01-003", "01-005", "01-007"]);
    assert_eq!(
        states(&second.registry),
        [("01-001", Lost), ("01-003", Current), ("01-005", Current), ("01-007", Current)]
    );
    let third = second.registry.carry(&row(&[0.0, 1.0]), Trust::Newest, "scan");
    assert_eq!(codes(&third), ["01-001", "01-003"], "what comes back has its code again");
}

#[test]
fn what_may_be_another_place_is_stale_until_it_is_confirmed() {
    let first = Registry::default().carry(&row(&[0.0, 10.0]), Trust::Newest, "scan").registry;
    let moved = row(&[0.5, 10.0]);
    let mut second = first.carry(&moved, Trust::Newest, "scan");
    assert_eq!(states(&second.registry), [("01-001", Stale), ("01-003", Current)]);
    assert!(second.codes[0].is_stale && !second.codes[1].is_stale);
    let again = second.registry.carry(&row(&[0.0, 10.0]), Trust::Newest, "scan");
    assert_eq!(states(&again.registry)[0], ("01-001", Stale), "nobody confirmed it");
    assert_eq!(second.registry.confirm(None, "scan"), Ok(1));
    assert_eq!(states(&second.registry.carry(&moved, Trust::Newest, "scan").registry)[0], ("01-001", Current));
}

#[test]
fn a_map_whose_alignment_is_in_doubt_makes_every_code_stale() {
    let first = Registry::default().carry(&row(&[0.0]), Trust::Newest, "scan").registry;
    let shown = row(&[0.0, 5.0]);
    let mut second = first.carry(&shown, Trust::Doubtful, "scan");
    assert_eq!(states(&second.registry), [("01-001", Stale), ("01-003", Stale)]);
    second.registry.confirm(Some(&["01-001".to_owned()]), "scan").expect("it has this code");
    let confirmed = [("01-001", Current), ("01-003", Stale)];
    assert_eq!(states(&second.registry.carry(&shown, Trust::Doubtful, "scan").registry), confirmed);
    let another = second.registry.carry(&shown, Trust::Doubtful, "another scan");
    assert_eq!(states(&another.registry), [("01-001", Stale), ("01-003", Stale)]);
}

#[test]
fn an_earlier_map_changes_no_state() {
    let first = Registry::default().carry(&row(&[0.0, 1.0]), Trust::Newest, "scan").registry;
    let second = first.carry(&row(&[1.0, 7.0]), Trust::Earlier, "scan");
    assert_eq!(codes(&second), ["01-003", "01-005"]);
    assert_eq!(states(&second.registry), [("01-001", Current), ("01-003", Current), ("01-005", Lost)]);
}

#[test]
fn unknown_codes_are_not_confirmed() {
    let mut registry = Registry::default().carry(&row(&[0.0]), Trust::Doubtful, "scan").registry;
    let wished = ["01-001".to_owned(), "99-999".to_owned()];
    assert_eq!(registry.confirm(Some(&wished), "scan"), Err(UnknownCodes(vec!["99-999".into()])));
    assert_eq!(states(&registry), [("01-001", Stale)]);
    assert_eq!(registry.confirm(Some(&wished[..1]), "scan"), Ok(1));
}

/// Rows of places with gaps, the codes counted from the left.
fn rows() -> impl Strategy<Value = Vec<NumberedLocation>> {
    prop::collection::vec(1.0..2.5, 0..12).prop_map(|gaps| {
        let mut x = 0.0;
        let places: Vec<f64> = gaps
            .iter()
            .map(|gap| {
                x += gap;
                x
            })
            .collect();
        row(&places)
    })
}

#[test]
fn a_new_numbering_gives_new_codes_but_where_people_gave_one() {
    let mut registry = Registry::default().carry(&row(&[0.0, 1.0, 2.0]), Trust::Newest, "scan").registry;
    let gifts = [
        (1, Given { code: Some("dock".into()), ..Given::default() }),
        (2, Given { name: Some(Some("by the door".into())), ..Given::default() }),
    ];
    registry.give(&gifts).expect("nobody has this code");
    // The middle one is gone, the others are numbered in another way.
    let shown = [location("A-1", 0.0), location("A-2", 2.02), location("01-003", 7.0)];
    let renumbered = registry.renumbered(&shown, "A".into());
    let carried = renumbered.carry(&shown, Trust::Newest, "scan");
    assert_eq!(codes(&carried), ["dock", "A-2", "01-003"]);
    assert_eq!(
        states(&carried.registry),
        [("dock", Current), ("01-005", Lost), ("A-2", Current), ("01-003", Current)],
        "a lost place makes way"
    );
    assert_eq!(carried.registry.entries[1].name.as_deref(), Some("by the door"));
    assert_eq!(carried.registry.carry(&shown, Trust::Newest, "scan"), carried);
}

#[test]
fn places_that_are_cut_are_new_places_with_new_codes() {
    let whole = NumberedLocation {
        footprint: Footprint {
            outline: [(0.0, 0.0), (3.0, 0.0), (3.0, 1.2), (0.0, 1.2)].map(|(x, y)| Point::new(x, y)).to_vec(),
            center: Point::new(1.5, 0.6),
        },
        code: "01-001".into(),
    };
    let registry = Registry::default().carry(&[whole], Trust::Newest, "scan").registry;
    let cut = row(&[0.0, 1.0, 2.0]);
    let carried = registry.renumbered(&cut, "each 1".into()).carry(&cut, Trust::Newest, "scan");
    assert_eq!(codes(&carried), ["01-001", "01-003", "01-005"]);
    assert!(carried.codes.iter().all(|given| !given.is_stale));
    assert_eq!(carried.registry.entries[0].state, Lost);
}

#[test]
fn codes_are_exchanged_in_one_call_and_taken_ones_are_told() {
    let mut registry = Registry::default().carry(&row(&[0.0, 1.0, 2.0]), Trust::Newest, "scan").registry;
    let code = |key, code: &str| (key, Given { code: Some(code.into()), ..Given::default() });
    registry.give(&[code(1, "01-003"), code(2, "01-001")]).expect("they are exchanged");
    let before = registry.clone();
    let conflicts = registry.give(&[code(1, "01-005"), code(2, "X"), code(3, "X")]).expect_err("two are taken");
    let told: Vec<(usize, CodeOwner)> = conflicts.iter().map(|conflict| (conflict.gift, conflict.taken_by)).collect();
    assert_eq!(told, [(2, CodeOwner::Gift(1))], "the third place gives its code away");
    assert_eq!(registry, before);
    let conflicts = registry.give(&[code(1, "01-005")]).expect_err("it is taken");
    assert_eq!(conflicts[0].taken_by, CodeOwner::Place(3));
    // Lost places make way, unless a person gave them their code.
    let mut later = registry.carry(&row(&[0.0, 9.0]), Trust::Newest, "scan").registry;
    later.give(&[code(4, "01-005")]).expect("a lost place makes way");
    let conflicts = later.give(&[code(4, "01-001")]).expect_err("a person gave it to a lost place");
    assert_eq!(conflicts[0].taken_by, CodeOwner::LostPlace(2));
}

#[test]
fn named_areas_are_found_again_by_their_ground() {
    let square = |x: f64, side: f64| -> AreaRings {
        vec![[(0.0, 0.0), (side, 0.0), (side, side), (0.0, side)].map(|(dx, dy)| Point::new(x + dx, dy)).to_vec()]
    };
    let named = |kind, name: &str, rings| NamedArea { kind, name: Some(name.into()), groups: Vec::new(), rings };
    let mut registry = Registry::default();
    registry.put_area(None, named(AreaKind::Place, "hall", square(0.0, 10.0)));
    registry.put_area(None, named(AreaKind::Place, "office", square(10.0, 4.0)));
    registry.put_area(None, named(AreaKind::Aisle, "main aisle", square(0.0, 10.0)));
    let grounds = [square(10.3, 4.0), square(30.0, 5.0), square(0.4, 9.0)];
    assert_eq!(registry.areas_of(AreaKind::Place, &grounds), [Some(1), None, Some(0)]);
    assert_eq!(registry.areas_of(AreaKind::Aisle, &grounds), [None, None, Some(2)]);
    registry.put_area(Some(0), NamedArea { name: None, ..registry.areas[0].clone() });
    assert_eq!(registry.areas_of(AreaKind::Place, &grounds), [Some(0), None, None], "the hall is forgotten");
}

proptest! {
    #[test]
    fn a_new_numbering_is_that_of_the_map(first in rows(), second in rows()) {
        let registry = Registry::default().carry(&first, Trust::Newest, "scan").registry;
        let proposed: Vec<NumberedLocation> =
            second.iter().map(|place| NumberedLocation { code: place.code.replace("01", "A"), ..place.clone() }).collect();
        let carried = registry.renumbered(&proposed, "A".into()).carry(&proposed, Trust::Newest, "scan");
        let wished: Vec<&str> = proposed.iter().map(|place| place.code.as_str()).collect();
        prop_assert_eq!(codes(&carried), wished);
        prop_assert_eq!(carried.registry.carry(&proposed, Trust::Newest, "scan"), carried);
    }

    #[test]
    fn twice_is_once_and_the_order_changes_nothing(first in rows(), second in rows(), turn in 0_usize..12, doubt in any::<bool>()) {
        let trust = if doubt { Trust::Doubtful } else { Trust::Newest };
        let registry = Registry::default().carry(&first, Trust::Newest, "scan").registry;
        let carried = registry.carry(&second, trust, "scan");
        prop_assert_eq!(&carried.registry.carry(&second, trust, "scan"), &carried);

        let mut turned = second.clone();
        let turn = turn % second.len().max(1);
        turned.rotate_left(turn);
        let mut other = registry.carry(&turned, trust, "scan");
        other.codes.rotate_right(turn);
        prop_assert_eq!(&other, &carried);
    }

    #[test]
    fn codes_are_unique_and_never_given_to_another_place(first in rows(), second in rows(), third in rows()) {
        let mut registry = Registry::default();
        for locations in [&first, &second, &third] {
            let before = registry.clone();
            let carried = registry.carry(locations, Trust::Newest, "scan");
            let given: std::collections::BTreeSet<_> = codes(&carried).into_iter().collect();
            prop_assert_eq!(given.len(), locations.len());
            for (given, location) in carried.codes.iter().zip(locations) {
                if let Some(entry) = before.find(&given.code) {
                    prop_assert!((entry.center - location.footprint.center).norm() < 1.0, "{} moved", given.code);
                }
            }
            registry = carried.registry;
        }
        let all: std::collections::BTreeSet<_> = registry.entries.iter().map(|entry| &entry.code).collect();
        prop_assert_eq!(all.len(), registry.entries.len());
    }
}
