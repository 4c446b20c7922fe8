//! What must hold for every kind and seed.

use expect_test::expect;
use proptest::prelude::*;

use crate::compose::compose;
use crate::kind::Kind;
use crate::random::{Purpose, Random};
use crate::shape::Convex;
use crate::site::{About, Site};
use crate::{Options, Properties, Sample, generate};

fn site(kind: Kind, seed: u64) -> Site {
    compose(kind, None, &mut Random::new(kind, seed, Purpose::Site)).site
}

fn places(site: &Site) -> Vec<Convex> {
    site.shapes(|about| matches!(about, About::Place(_))).map(|place| place.grown(-1e-6)).collect()
}

/// Cells of 0.2 m are enough to see that a map comes out, and fast.
fn coarse(kind: Kind, seed: u64) -> Sample {
    generate(kind, seed, &Options { resolution: 0.2, ..Options::default() })
}

fn any_kind() -> impl Strategy<Value = Kind> {
    (0..Kind::ALL.len()).prop_map(|index| Kind::ALL[index])
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(24))]

    #[test]
    fn places_lie_on_the_floor_apart_from_each_other_and_from_columns(kind in any_kind(), seed in 0_u64..1_000_000) {
        let site = site(kind, seed);
        let places = places(&site);
        prop_assert!(places.len() >= 10, "{kind} {seed}: {} places", places.len());
        let columns: Vec<&Convex> = site.shapes(|about| matches!(about, About::Pillar { .. })).collect();
        for (index, place) in places.iter().enumerate() {
            prop_assert!(site.floor.iter().any(|floor| floor.covers(place)), "{kind} {seed}: {place:?} is off the floor");
            prop_assert!(columns.iter().all(|column| column.overlap(place) == 0.0), "{kind} {seed}: {place:?} has a column");
            let other = places[..index].iter().find(|other| other.overlap(place) > 0.0);
            prop_assert!(other.is_none(), "{kind} {seed}: {place:?} lies on {other:?}");
        }
    }

    #[test]
    fn the_truth_of_the_floor_does_not_overlap(kind in any_kind(), seed in 0_u64..1_000_000) {
        let site = site(kind, seed);
        let shapes: Vec<Convex> = site
            .shapes(|about| matches!(about, About::Place(_) | About::Corridor { .. } | About::Junction | About::Room))
            .cloned()
            .collect();
        for (index, shape) in shapes.iter().enumerate() {
            let common: f64 = shapes[..index].iter().map(|other| other.overlap(shape)).sum();
            prop_assert!(common < 0.01, "{kind} {seed}: {common} square metres of {shape:?} are taken");
        }
    }

    #[test]
    fn halls_have_plausible_sizes(kind in any_kind(), seed in 0_u64..1_000_000) {
        for floor in &site(kind, seed).floor {
            let (low, high) = floor.bounds();
            prop_assert!((high.x - low.x).max(high.y - low.y) < 65.0, "{kind} {seed}: {floor:?}");
        }
    }
}

#[test]
fn every_kind_generates_with_its_truth_inside_the_map() {
    let summary: Vec<String> = Kind::ALL.into_iter().map(|kind| {
        let sample = coarse(kind, 1);
        let (width, height) = sample.size();
        let origin = sample.origin();
        for feature in &sample.truth.features {
            for [x, y] in &feature.geometry.coordinates[0] {
                let inside = (0.0..=width as f64 * 0.2).contains(&(x - origin.x))
                    && (0.0..=height as f64 * 0.2).contains(&(y - origin.y));
                assert!(inside, "{kind}: {x} {y}");
            }
        }
        let observed = |feature: &&crate::Feature| matches!(feature.properties, Properties::Pallet { observed, .. } if observed >= 0.5);
        let observed = sample.truth.features.iter().filter(observed).count();
        format!("{kind}: {} places, {observed} observed, {}", sample.meta.pallets, sample.meta.sensor)
    }).collect();
    expect![[r#"
        selective: 219 places, 219 observed, footprints
        euro-long: 132 places, 132 observed, footprints
        inch: 80 places, 80 observed, footprints
        flues: 180 places, 180 observed, footprints
        tunnels: 144 places, 144 observed, footprints
        guards: 168 places, 168 observed, footprints
        double-deep: 320 places, 204 observed, articles
        two-directions: 172 places, 172 observed, footprints
        columns: 160 places, 160 observed, footprints
        l-shape: 104 places, 104 observed, footprints
        staging: 196 places, 196 observed, footprints
        block-storage: 240 places, 240 observed, footprints
        diagonal: 126 places, 126 observed, footprints
        offices: 134 places, 134 observed, footprints
        mixed: 150 places, 150 observed, both
        unexplored: 160 places, 122 observed, footprints"#]]
    .assert_eq(&summary.join("\n"));
}

#[test]
fn the_same_seed_gives_the_same_bytes_on_any_number_of_threads() {
    let on = |threads| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        let sample = pool.install(|| coarse(Kind::Mixed, 7));
        (sample.pgm(), sample.yaml(), serde_json::to_string(&(&sample.truth, &sample.meta)).unwrap())
    };
    assert_eq!(on(1), on(3));
}

#[test]
fn speckle_turns_its_share_of_the_cells_and_leaves_the_truth() {
    let plain = coarse(Kind::Inch, 3);
    let options = Options { resolution: 0.2, speckle: 0.01, ..Options::default() };
    let speckled = generate(Kind::Inch, 3, &options);
    assert_eq!(plain.truth, speckled.truth);
    let turned = plain.greys().iter().zip(speckled.greys()).filter(|(before, after)| before != after).count();
    let share = turned as f64 / plain.greys().len() as f64;
    // Half of the free cells that are struck stay free.
    assert!((0.004..0.011).contains(&share), "{share}");
}

#[test]
fn options_are_obeyed() {
    let (rotation_deg, field_of_view, boxes) = (Some(0.0), Some(270), Some(1.0));
    let options = Options { resolution: 0.2, rotation_deg, field_of_view, boxes, ..Options::default() };
    let sample = generate(Kind::Mixed, 2, &options);
    assert_eq!((sample.meta.fov, sample.meta.sensor, sample.meta.rotation_deg), (270, "articles", 0.0));
    let angle = sample.truth.features.iter().find_map(|feature| match feature.properties {
        Properties::Region { angle_deg, .. } => Some(angle_deg),
        _ => None,
    });
    assert_eq!(angle, Some(0.0));
}
