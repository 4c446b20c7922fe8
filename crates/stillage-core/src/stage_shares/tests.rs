//! The estimate against measured runs.

use super::*;
use crate::spec::Preset;

/// A measured run: milliseconds of each stage on a quiet machine, two threads, in the order of [`Stage::ALL`].
struct Run {
    map: &'static str,
    options: fn() -> AnalysisOptions,
    counts: [usize; 3],
    milliseconds: [f64; Stage::ALL.len()],
}

/// Measured on 2026-11-28 on two cores of an AMD EPYC with AVX-512.
#[rustfmt::skip]
const RUNS: &[Run] = &[
    //       declutter features clustering categorization orientation regions radiography rooms rows site-plan arrangement annotation
    Run { map: "hunav small warehouse", options: AnalysisOptions::default, counts: [117_180, 111_434, 5_746],
          milliseconds: [0.7, 45.7, 89.6, 1.9, 12.2, 1.2, 0.2, 6.6, 25.9, 6.7, 0.4, 0.5] },
    Run { map: "nav2 depot", options: AnalysisOptions::default, counts: [185_428, 179_481, 5_947],
          milliseconds: [4.4, 68.7, 100.7, 3.0, 13.1, 1.2, 0.3, 8.8, 4.4, 13.2, 0.7, 1.2] },
    Run { map: "Freiburg 52", options: AnalysisOptions::default, counts: [227_622, 159_754, 1_539],
          milliseconds: [1.2, 66.4, 68.6, 2.7, 6.8, 1.0, 0.2, 8.1, 26.1, 21.0, 1.3, 1.5] },
    Run { map: "tuw warehouse grid", options: AnalysisOptions::default, counts: [360_000, 148_080, 211_920],
          milliseconds: [1.8, 93.4, 99.6, 2.7, 161.1, 17.7, 2.4, 10.2, 9.8, 23.3, 3.2, 2.1] },
    Run { map: "generated warehouse", options: AnalysisOptions::default, counts: [583_848, 376_499, 23_802],
          milliseconds: [6.0, 183.1, 173.1, 8.2, 56.9, 4.4, 0.7, 29.7, 66.5, 0.0, 1.4, 3.5] },
    Run { map: "zoo, mixed storage", options: AnalysisOptions::default, counts: [630_853, 339_844, 17_907],
          milliseconds: [4.0, 161.6, 188.3, 6.1, 44.7, 4.4, 0.6, 27.6, 40.9, 3.5, 3.8, 3.7] },
    Run { map: "example", options: AnalysisOptions::default, counts: [896_120, 356_867, 16_516],
          milliseconds: [13.1, 254.3, 208.4, 10.4, 50.4, 5.1, 0.7, 33.2, 61.9, 0.0, 1.3, 4.2] },
    Run { map: "paper's size", options: AnalysisOptions::default, counts: [20_520_000, 13_140_161, 1_000_000],
          milliseconds: [200.0, 1940.0, 200.0, 4500.0, 470.0, 360.0, 20.0, 1320.0, 1350.0, 330.0, 210.0, 120.0] },
];

/// How far the progress may be from the truth at a quarter of the run.
const WITHIN: f64 = 0.10;

/// The largest difference between the progress that is shown and the time that has passed, at each quarter of a run.
fn worst_quarter(run: &Run) -> (f64, f64) {
    let [cells, free, occupied] = run.counts;
    let shares = StageShares::estimate(&CellCounts { cells, free, occupied }, &(run.options)());
    let whole: f64 = run.milliseconds.iter().sum();
    let shown = |quarter: f64| {
        let (mut passed, mut shown) = (0.0, 0.0);
        for (stage, time) in Stage::ALL.into_iter().zip(run.milliseconds) {
            let fraction = ((quarter * whole - passed) / time).clamp(0.0, 1.0);
            shown += if time > 0.0 { fraction } else { 1.0 } * shares.of(stage);
            passed += time;
        }
        shown
    };
    let errors = [0.25, 0.5, 0.75].map(|quarter| (quarter, shown(quarter) - quarter));
    errors.into_iter().max_by(|one, other| one.1.abs().total_cmp(&other.1.abs())).expect("there are three quarters")
}

#[test]
fn progress_is_within_ten_points_of_the_time_at_every_quarter() {
    for run in RUNS {
        let (quarter, error) = worst_quarter(run);
        println!("{:<32} {:>4.0} % shown at {:.0} %", run.map, 100.0 * (quarter + error), 100.0 * quarter);
    }
    for run in RUNS {
        let (quarter, error) = worst_quarter(run);
        assert!(error.abs() <= WITHIN, "{}: {error:+.2} at {quarter}", run.map);
    }
}

#[test]
fn the_shares_of_any_map_make_a_whole() {
    for preset in [AnalysisOptions::default(), Preset::Paper.options(), Preset::Halmstad2017.options()] {
        for [cells, free, occupied] in [[0; 3], [1, 1, 0], [1_000_000, 0, 0], [100_000_000, 60_000_000, 1_000_000]] {
            let shares = StageShares::estimate(&CellCounts { cells, free, occupied }, &preset);
            let whole: f64 = Stage::ALL.iter().map(|&stage| shares.of(stage)).sum();
            assert!((whole - 1.0).abs() < 1e-9, "{whole}");
        }
    }
}
