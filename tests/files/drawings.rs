//! Plain drawings, one for each style, from their files to their places: a change that reads one of them worse fails here.
//!
//! The floors are the tenth below what the method reaches; raise them when it reads more. Means over many
//! drawings are in `docs/accuracy.md`.

use stillage::ingest::{self, Limits, MapSource};
use stillage_core::evaluation::{self, LabelScores};
use stillage_core::semantics::RuleSet;
use stillage_core::spec::GridOptions;
use stillage_core::{AnalysisSpec, Watch, analyze};
use stillage_zoo::{DrawingOptions, DrawingStyle, draw};

/// Style, and the least F1 of its places and intersection over union of its corridors; 0 where nothing is read yet.
const FLOORS: [(DrawingStyle, f64, f64); 9] = [
    (DrawingStyle::Solid, 0.9, 0.85),
    (DrawingStyle::Racks, 0.9, 0.8),
    (DrawingStyle::Outlined, 0.9, 0.8),
    (DrawingStyle::Lined, 0.4, 0.4),
    (DrawingStyle::Uprights, 0.9, 0.9),
    (DrawingStyle::Pods, 0.7, 0.8),
    (DrawingStyle::Ticks, 0.85, 0.85),
    (DrawingStyle::Hatched, 0.9, 0.4),
    (DrawingStyle::Dashed, 0.6, 0.8),
];

/// A hall of a size that a test can afford.
fn scores(style: DrawingStyle) -> LabelScores {
    let options = DrawingOptions { resolution: Some(0.07), hall: Some([18.0, 10.0]), ..DrawingOptions::default() };
    let sample = draw(style, 1, &options);
    let source = MapSource::Image { image: sample.pgm(), metadata: sample.yaml().into_bytes() };
    let grid = ingest::decode(&source, &GridOptions::default(), &Limits::default()).unwrap().grid;
    let truth = ingest::ground_truth(&serde_json::to_value(&sample.truth).unwrap()).unwrap();
    let watch = Watch::unwatched();
    let analysis = analyze(&grid, &AnalysisSpec::default(), &watch).unwrap();
    evaluation::evaluate(&analysis, &RuleSet::default(), None, &truth, &watch).unwrap().decided
}

#[test]
fn drawings_are_read_as_well_as_before() {
    let mut fallen = Vec::new();
    for (style, places, corridors) in FLOORS {
        let scores = scores(style);
        let line = format!(
            "{style}: places {:.3} (floor {places}), corridors {:.3} (floor {corridors})",
            scores.f1, scores.overlap.corridor
        );
        println!("{line}");
        if scores.f1 < places || scores.overlap.corridor < corridors {
            fallen.push(line);
        }
    }
    assert!(fallen.is_empty(), "read worse than before:\n{}", fallen.join("\n"));
}
