//! Plain drawings of warehouses (`stillage_zoo::draw`), by style.

use rayon::prelude::*;
use stillage_core::AnalysisSpec;
use stillage_core::evaluation::{Evaluation, LabelScores};
use stillage_zoo::{DrawingOptions, DrawingStyle};

use crate::tables::{least, mean, percent, table};
use crate::{Outcome, Seeds, sites};

/// Scores drawings of the styles whose names hold a text, and tells each on standard error.
pub fn drawings(seeds: Seeds, wanted: &str) -> Outcome<String> {
    let styles: Vec<DrawingStyle> =
        DrawingStyle::ALL.into_iter().filter(|style| style.name().contains(wanted)).collect();
    let jobs: Vec<(DrawingStyle, u64)> =
        styles.iter().flat_map(|&style| (seeds.0..=seeds.1).map(move |seed| (style, seed))).collect();
    let evaluations: Vec<Evaluation> =
        jobs.par_iter().map(|&(style, seed)| one(style, seed)).collect::<Outcome<_>>()?;
    let head = [
        "style",
        "F1",
        "worst F1",
        "F1 automatic",
        "strict",
        "precision",
        "corridor IoU",
        "worst",
        "automatic",
        "junction IoU",
        "automatic",
        "drivable IoU",
    ];
    let per_style = (seeds.1 - seeds.0 + 1) as usize;
    let groups = styles.iter().map(ToString::to_string).zip(evaluations.chunks(per_style));
    let rows = groups.chain([("**all**".to_owned(), &evaluations[..])]).map(|(name, evaluations)| {
        let decided =
            |figure: fn(&LabelScores) -> f64| evaluations.iter().map(move |evaluation| figure(&evaluation.decided));
        let automatic = |figure: fn(&LabelScores) -> f64| {
            percent(mean(evaluations.iter().map(|evaluation| figure(&evaluation.automatic))))
        };
        vec![
            name,
            percent(mean(decided(|scores| scores.f1))),
            percent(least(decided(|scores| scores.f1))),
            automatic(|scores| scores.f1),
            percent(mean(decided(|scores| scores.places.map_or(0.0, |places| places.strict)))),
            percent(mean(decided(|scores| scores.precision))),
            percent(mean(decided(|scores| scores.overlap.corridor))),
            percent(least(decided(|scores| scores.overlap.corridor))),
            automatic(|scores| scores.overlap.corridor),
            percent(mean(decided(|scores| scores.overlap.junction))),
            automatic(|scores| scores.overlap.junction),
            percent(mean(decided(|scores| scores.overlap.drivable))),
        ]
    });
    Ok(table(&head, rows))
}

fn one(style: DrawingStyle, seed: u64) -> Outcome<Evaluation> {
    let sample = stillage_zoo::draw(style, seed, &DrawingOptions::default());
    let evaluation = sites::scored(&sites::of_sample(&sample)?, &AnalysisSpec::default())?;
    let meta = &sample.meta;
    let LabelScores { f1, overlap, .. } = &evaluation.decided;
    eprintln!(
        "{style:<10}{seed:>4}  F1 {f1:.3} ({:.3}) corridor {:.3} junction {:.3}   cells {:.3} pitch {:.2} depth {:.2} \
         aisle {:.2}{}{} turn {:.1} {:?} {:.1}{} empty {:.1}",
        evaluation.automatic.f1,
        overlap.corridor,
        overlap.junction,
        meta.resolution,
        meta.pitch,
        meta.depth,
        meta.aisle,
        if meta.double { " double" } else { "" },
        if meta.layers > 1 { " deep" } else { "" },
        meta.turn,
        meta.outside,
        meta.margin,
        if meta.soft { " soft" } else { "" },
        meta.empty,
    );
    Ok(evaluation)
}
