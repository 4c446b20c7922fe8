//! What must hold for every style and seed.

use expect_test::expect;
use proptest::prelude::*;

use super::plan::Plan;
use super::{DrawingMeta, DrawingOptions, DrawingStyle, Outside, build, draw};
use crate::random::Random;
use crate::sample::Sample;
use crate::scanner::grey;
use crate::shape::Convex;
use crate::site::{About, Content, Site};

fn site(style: DrawingStyle, seed: u64) -> Site {
    let mut random = Random::of_drawing(style, seed);
    let plan = Plan::new(style, &DrawingOptions::default(), &mut random);
    build::build(&plan, &mut random)
}

/// A small hall along the cells, fast to draw.
fn small(style: DrawingStyle, seed: u64) -> Sample<DrawingMeta> {
    let options = DrawingOptions {
        resolution: Some(0.05),
        rotation_deg: Some(0.0),
        hall: Some([20.0, 12.0]),
        ..DrawingOptions::default()
    };
    draw(style, seed, &options)
}

/// The darkest cell of a shape.
fn darkest(sample: &Sample<DrawingMeta>, shape: &Convex) -> u8 {
    let mut darkest = grey::FREE;
    sample.lattice.for_each_cell(shape, |cell| darkest = darkest.min(sample.greys[cell]));
    darkest
}

fn any_style() -> impl Strategy<Value = DrawingStyle> {
    (0..DrawingStyle::ALL.len()).prop_map(|index| DrawingStyle::ALL[index])
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(48))]

    #[test]
    fn the_truth_of_the_floor_covers_the_hall_once(style in any_style(), seed in 0_u64..1_000_000) {
        let site = site(style, seed);
        let of_hall = |about: &About| matches!(about, About::Place(_) | About::Corridor { .. } | About::Junction);
        let shapes: Vec<&Convex> = site.shapes(of_hall).collect();
        let hall = &site.floor[0];
        for (index, shape) in shapes.iter().enumerate() {
            prop_assert!(hall.grown(1e-6).covers(shape), "{style} {seed}: {shape:?} is not in the hall");
            let common: f64 = shapes[..index].iter().map(|other| other.overlap(shape)).sum();
            prop_assert!(common < 1e-6, "{style} {seed}: {common} square metres of {shape:?} are taken");
        }
        // The rest are flues, and gaps between racks and walls.
        let covered = shapes.iter().map(|shape| shape.area()).sum::<f64>() / hall.area();
        prop_assert!(covered > 0.93, "{style} {seed}: {covered} of the hall");
    }

    #[test]
    fn a_full_place_is_drawn_and_an_empty_one_shows_nothing(style in any_style(), seed in 0_u64..1_000_000) {
        let sample = small(style, seed);
        let columns: Vec<&Convex> =
            sample.facts.iter().filter(|fact| matches!(fact.about, About::Pillar { .. })).map(|fact| &fact.shape).collect();
        for fact in &sample.facts {
            let About::Place(place) = &fact.about else { continue };
            if place.content == Content::Nothing {
                // Half a cell of a neighbour's grey edge may reach in.
                let inside = fact.shape.grown(-0.1);
                let has_column = columns.iter().any(|column| column.grown(0.05).overlap(&inside) > 0.0);
                prop_assert!(has_column || darkest(&sample, &inside) == grey::FREE, "{style} {seed}: {place:?}");
            } else {
                // Posts and frames stand on the border.
                let around = fact.shape.grown(0.05);
                prop_assert!(darkest(&sample, &around) < 100, "{style} {seed}: {place:?}");
            }
        }
    }
}

#[test]
fn every_style_draws_with_its_truth_inside_the_picture() {
    let summary: Vec<String> = DrawingStyle::ALL
        .into_iter()
        .map(|style| {
            let sample = draw(style, 2, &DrawingOptions { hall: Some([24.0, 14.0]), ..DrawingOptions::default() });
            let (low, high) = sample.lattice.bounds();
            for feature in &sample.truth.features {
                for &[x, y] in &feature.geometry.coordinates[0] {
                    let inside =
                        (low.x - 0.001..=high.x + 0.001).contains(&x) && (low.y - 0.001..=high.y + 0.001).contains(&y);
                    assert!(inside, "{style}: {x} {y}");
                }
            }
            let meta = &sample.meta;
            format!(
                "{style}: {} places in {} x {} racks, pitch {}, aisle {}, turn {}, outside {:?}",
                meta.places, meta.rows, meta.blocks, meta.pitch, meta.aisle, meta.turn, meta.outside
            )
        })
        .collect();
    expect![[r#"
        solid: 39 places in 3 x 1 racks, pitch 1.115, aisle 3.034, turn -87.743, outside Black
        racks: 3 places in 3 x 1 racks, pitch 2.791, aisle 2.556, turn 45.043, outside Black
        outlined: 50 places in 3 x 2 racks, pitch 1.204, aisle 2.238, turn 56.764, outside Black
        lined: 56 places in 2 x 1 racks, pitch 1.05, aisle 2.854, turn 0, outside White
        uprights: 14 places in 2 x 1 racks, pitch 1.742, aisle 3.675, turn 1.547, outside White
        pods: 48 places in 2 x 1 racks, pitch 1.461, aisle 1.936, turn 0, outside White
        ticks: 20 places in 2 x 1 racks, pitch 1.526, aisle 2.652, turn -1.03, outside White
        hatched: 2 places in 2 x 1 racks, pitch 1.882, aisle 2.562, turn 42.027, outside Black
        dashed: 18 places in 3 x 1 racks, pitch 2.531, aisle 2.397, turn 87.397, outside Black"#]]
    .assert_eq(&summary.join("\n"));
}

#[test]
fn the_same_seed_draws_the_same_bytes() {
    let bytes = || {
        let sample = small(DrawingStyle::Pods, 7);
        (sample.pgm(), sample.yaml(), serde_json::to_string(&(&sample.truth, &sample.meta)).unwrap())
    };
    assert_eq!(bytes(), bytes());
}

#[test]
fn options_change_the_picture_and_leave_the_plan() {
    let plain = small(DrawingStyle::Outlined, 3);
    let with = |options: DrawingOptions| {
        draw(DrawingStyle::Outlined, 3, &DrawingOptions { resolution: Some(0.05), hall: Some([20.0, 12.0]), ..options })
    };
    let turned = with(DrawingOptions { rotation_deg: Some(0.0), turned_deg: 17.0, ..DrawingOptions::default() });
    assert_eq!((plain.meta.turn, turned.meta.turn), (0.0, 17.0));
    assert_eq!((plain.meta.places, plain.meta.pitch), (turned.meta.places, turned.meta.pitch));
    let shifted = with(DrawingOptions { rotation_deg: Some(0.0), shifted_cells: 0.25, ..DrawingOptions::default() });
    assert!((plain.origin().x - shifted.origin().x - 0.25 * 0.05).abs() < 1e-12);
    assert_eq!(plain.truth, shifted.truth);
    for outside in Outside::ALL {
        let sample = with(DrawingOptions { outside: Some(outside), turned_deg: 17.0, ..DrawingOptions::default() });
        // A turned hall leaves the corners of the picture free.
        assert_eq!(sample.greys()[0], outside.grey(), "{outside:?}");
    }
}
