//! Questions to the collections of a whole map.

use super::*;
use crate::features::tests::hall_view;
use crate::features::{Collection, CollectionSchema, Value, features};

fn ids(page: &Page<'_>) -> Vec<String> {
    page.features.iter().map(|feature| feature.id.to_string()).collect()
}

fn sorted_by(keys: &[&str]) -> Vec<SortKey> {
    keys.iter().map(|key| SortKey::read(key, CollectionSchema::of(Collection::Faces)).unwrap()).collect()
}

#[test]
fn pages_follow_one_another_without_gap_or_repetition() {
    let faces = features(&hall_view(), Collection::Faces);
    for sort in [sorted_by(&[]), sorted_by(&["label", "-areaM2"]), sorted_by(&["-location"])] {
        let whole =
            FeatureQuery { sort: sort.clone(), limit: usize::MAX, ..FeatureQuery::default() }.select(&faces).unwrap();
        assert_eq!(whole.features.len(), faces.len());
        let mut found = Vec::new();
        let mut after = None;
        loop {
            let query = FeatureQuery { sort: sort.clone(), after, limit: 7, ..FeatureQuery::default() };
            let page = query.select(&faces).unwrap();
            assert_eq!(page.matched, faces.len());
            found.extend(ids(&page));
            after = page.features.last().map(|feature| feature.id.clone());
            if !page.has_more {
                break;
            }
        }
        assert_eq!(found, ids(&whole));
    }
}

#[test]
fn features_are_sorted_by_one_property_and_then_the_next() {
    let faces = features(&hall_view(), Collection::Faces);
    let query = FeatureQuery { sort: sorted_by(&["label", "-areaM2"]), limit: usize::MAX, ..FeatureQuery::default() };
    let page = query.select(&faces).unwrap();
    for pair in page.features.windows(2) {
        let value = |name| [pair[0].property(name).unwrap(), pair[1].property(name).unwrap()];
        let ([first, second], [larger, smaller]) = (value("label"), value("areaM2"));
        assert!(first.compare(&second).is_lt() || first == second && larger.compare(&smaller).is_ge());
    }
}

#[test]
fn what_has_no_value_comes_last_both_ways() {
    let faces = features(&hall_view(), Collection::Faces);
    for key in ["location", "-location"] {
        let query = FeatureQuery { sort: sorted_by(&[key]), limit: usize::MAX, ..FeatureQuery::default() };
        let page = query.select(&faces).unwrap();
        assert_eq!(page.features.last().unwrap().property("location"), Some(Value::Null), "{key}");
        assert_ne!(page.features[0].property("location"), Some(Value::Null), "{key}");
    }
}

#[test]
fn only_the_wanted_ids_are_selected() {
    let faces = features(&hall_view(), Collection::Faces);
    let wanted = [3, 1, 999_999].map(FeatureId::Number).into_iter().collect();
    let page = FeatureQuery { ids: Some(wanted), limit: 10, ..FeatureQuery::default() }.select(&faces).unwrap();
    assert_eq!((ids(&page), page.matched), (vec!["1".to_owned(), "3".to_owned()], 2));
}

#[test]
fn a_sorted_list_does_not_go_on_after_what_has_vanished() {
    let faces = features(&hall_view(), Collection::Faces);
    let after = Some(FeatureId::Number(999_999));
    let by_id = FeatureQuery { after: after.clone(), limit: 1, ..FeatureQuery::default() };
    assert!(by_id.select(&faces).unwrap().features.is_empty());
    let by_area = FeatureQuery { after, sort: sorted_by(&["areaM2"]), limit: 1, ..FeatureQuery::default() };
    assert_eq!(by_area.select(&faces).unwrap_err(), VanishedFeature);
}

#[test]
fn a_key_that_cannot_sort_is_refused_with_those_that_can() {
    let refused = |key| SortKey::read(key, CollectionSchema::of(Collection::Vertices)).unwrap_err();
    assert_eq!(refused("edges"), "\"edges\" is none of the properties that can be sorted by: id");
    assert_eq!(refused("-"), "\"\" is none of the properties that can be sorted by: id");
}
