//! The same sites, turned in the map.

use std::fmt::Write as _;

use rayon::prelude::*;
use stillage_core::AnalysisSpec;
use stillage_zoo::{Kind, Options};

use crate::Outcome;
use crate::sites;

/// Turns of the hall, degrees: with the cells, almost, and anywhere in between.
const TURNS: [f64; 6] = [0.0, 2.15, 13.0, 27.5, 45.0, 71.0];
/// Kinds that are measured: regular ones, so that differences are those of the turn.
const KINDS: [Kind; 4] = [Kind::EuroLong, Kind::Selective, Kind::Mixed, Kind::Columns];

/// F1 with one decision per category and the largest error of an orientation, by turn.
pub fn table(seed: u64) -> Outcome<String> {
    let jobs: Vec<(Kind, f64)> = KINDS.iter().flat_map(|&kind| TURNS.map(|turn| (kind, turn))).collect();
    let one = |&(kind, turn): &(Kind, f64)| -> Outcome<(f64, Option<f64>)> {
        let site = sites::of_zoo(kind, seed, &Options { rotation_deg: Some(turn), ..Options::default() })?;
        let evaluation = sites::scored(&site, &AnalysisSpec::default())?;
        Ok((evaluation.decided.f1, evaluation.geometry.orientation_error))
    };
    let figures: Vec<(f64, Option<f64>)> = jobs.par_iter().map(one).collect::<Outcome<_>>()?;
    let mut text = format!("| F1 (orientation error) | {} |\n", TURNS.map(|turn| format!("{turn}°")).join(" | "));
    let _ = writeln!(text, "| --- | {} |", TURNS.map(|_| "---").join(" | "));
    for (kind, row) in KINDS.iter().zip(figures.chunks(TURNS.len())) {
        let cells: Vec<String> = row
            .iter()
            .map(|(f1, error)| {
                let error = error.map_or_else(|| "-".to_owned(), |error| format!("{:.3}°", error.to_degrees()));
                format!("{:.1} ({error})", 100.0 * f1)
            })
            .collect();
        let _ = writeln!(text, "| {kind} | {} |", cells.join(" | "));
    }
    Ok(text)
}
