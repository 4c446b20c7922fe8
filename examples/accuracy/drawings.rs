//! Plain drawings of warehouses (`stillage_zoo::draw`), by style.

use std::fs;

use rayon::prelude::*;
use stillage_core::AnalysisSpec;
use stillage_core::evaluation::{Evaluation, LabelScores};
use stillage_zoo::{DrawingOptions, DrawingStyle};

use crate::location_errors::{self, LocationError};
use crate::tables::{least, mean, percent, table};
use crate::{Arguments, Outcome, sites};

/// Scores drawings of the styles whose names hold a text, and tells each on standard error.
pub fn drawings(arguments: &Arguments) -> Outcome<String> {
    let seeds = arguments.seeds;
    let styles: Vec<DrawingStyle> =
        DrawingStyle::ALL.into_iter().filter(|style| style.name().contains(&arguments.only)).collect();
    let jobs: Vec<(DrawingStyle, u64)> =
        styles.iter().flat_map(|&style| (seeds.0..=seeds.1).map(move |seed| (style, seed))).collect();
    let drawings: Vec<Drawing> =
        jobs.par_iter().map(|&(style, seed)| one(style, seed, arguments)).collect::<Outcome<_>>()?;
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
        "centre error, cm",
        "95 % below",
        "worst heading error, °",
    ];
    let per_style = (seeds.1 - seeds.0 + 1) as usize;
    let groups = styles.iter().map(ToString::to_string).zip(drawings.chunks(per_style));
    let rows = groups.chain([("**all**".to_owned(), &drawings[..])]).map(|(name, drawings)| {
        let decided =
            |figure: fn(&LabelScores) -> f64| drawings.iter().map(move |drawing| figure(&drawing.evaluation.decided));
        let automatic = |figure: fn(&LabelScores) -> f64| {
            percent(mean(drawings.iter().map(|drawing| figure(&drawing.evaluation.automatic))))
        };
        let mut row = vec![
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
        ];
        row.extend(errors(drawings));
        row
    });
    if let Some(folder) = arguments.shown() {
        for (style, drawings) in styles.iter().zip(drawings.chunks(per_style)) {
            let f1 = |index: &usize| drawings[*index].evaluation.decided.f1;
            let worst = (0..drawings.len()).min_by(|one, other| f1(one).total_cmp(&f1(other))).unwrap_or(0);
            let sample = stillage_zoo::draw(*style, seeds.0 + worst as u64, &DrawingOptions::default());
            let grid = sites::of_sample(&sample)?.grid;
            let analysis = sites::analyzed(&grid, &AnalysisSpec::default())?;
            fs::write(folder.join(format!("drawing-{style}.png")), sites::small_picture(&grid, &analysis)?)?;
        }
    }
    Ok(table(&head, rows))
}

/// A drawing, scored.
struct Drawing {
    evaluation: Evaluation,
    errors: Vec<LocationError>,
}

fn one(style: DrawingStyle, seed: u64, arguments: &Arguments) -> Outcome<Drawing> {
    let sample = stillage_zoo::draw(style, seed, &DrawingOptions::default());
    let site = sites::of_sample(&sample)?;
    let analysis = sites::analyzed(&site.grid, &AnalysisSpec::default())?;
    arguments.draw(&format!("{style}_{seed}"), &site.grid, &analysis)?;
    let evaluation = sites::evaluated(&site, &analysis)?;
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
    Ok(Drawing { evaluation, errors: location_errors::of(&site.grid, &analysis, &sample.truth) })
}

/// Mean and 95th percentile of the distances of centres, centimetres, and the largest error of a heading, degrees.
fn errors(drawings: &[Drawing]) -> [String; 3] {
    let errors = || drawings.iter().flat_map(|drawing| &drawing.errors);
    let mut centers: Vec<f64> = errors().map(|error| 100.0 * error.center).collect();
    centers.sort_by(f64::total_cmp);
    let Some(&high) = centers.get(centers.len() * 95 / 100) else { return ["-"; 3].map(str::to_owned) };
    let heading = errors().map(|error| error.heading).fold(0.0, f64::max).to_degrees();
    [format!("{:.1}", mean(centers.iter().copied())), format!("{high:.1}"), format!("{heading:.2}")]
}
