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

proptest! {
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
