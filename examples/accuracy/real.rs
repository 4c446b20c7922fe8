//! Real maps against the truth that a person drew.

use std::path::Path;

use rayon::prelude::*;
use stillage_core::{AnalysisSpec, OccupancyGrid};

use crate::drawn_truth::{DrawnTruth, LabelScore, MapScore};
use crate::tables::{mean, percent, table};
use crate::{Arguments, Outcome, location_errors, sites};

/// Maps that the document shows: their licences allow it.
const SHOWN: [&str; 6] = [
    "warehouse__svl_warehouse_dt_pallets",
    "warehouse__nav2_depot",
    "warehouse__isaac_iw_hub_warehouse",
    "warehouse__aws_small_005_rotated",
    "warehouse__aws_bookstore",
    "warehouse__tuw_warehouse_grid",
];

/// A real map, by name, with what a person drew.
pub struct RealMap {
    pub name: String,
    pub grid: OccupancyGrid,
    pub truth: DrawnTruth,
}

/// The maps with a truth whose names hold a text, in order.
pub fn maps(shared: &Path, wanted: &str) -> Outcome<Vec<RealMap>> {
    let folder = shared.join("truth");
    let read = |name: &String| {
        let grid = sites::read(&shared.join("maps/dev").join(name).join("map.yaml"))?.grid;
        Ok(RealMap { name: name.clone(), grid, truth: DrawnTruth::read(&folder.join(name).with_extension("geojson"))? })
    };
    let names = sites::names(&folder, ".geojson")?;
    names.iter().filter(|name| name.contains(wanted)).map(read).collect()
}

impl RealMap {
    /// Analyses a grid of this map and scores it.
    pub fn score(&self, grid: &OccupancyGrid) -> Outcome<MapScore> {
        let analysis = sites::analyzed(grid, &AnalysisSpec::default())?;
        Ok(self.truth.score(&analysis, &sites::suggested(&analysis)))
    }

    /// Its name without the word for its sort.
    pub fn title(&self) -> &str {
        self.name.trim_start_matches("warehouse__")
    }
}

/// The table of all real maps.
pub fn real(arguments: &Arguments) -> Outcome<String> {
    let maps = maps(&arguments.shared, &arguments.only)?;
    let one = |map: &RealMap| {
        let analysis = sites::analyzed(&map.grid, &AnalysisSpec::default())?;
        arguments.draw(&map.name, &map.grid, &analysis)?;
        if let Some(folder) = arguments.shown().filter(|_| SHOWN.contains(&map.name.as_str())) {
            std::fs::write(folder.join(format!("{}.png", map.name)), sites::small_picture(&map.grid, &analysis)?)?;
        }
        Ok((map.truth.score(&analysis, &sites::suggested(&analysis)), location_errors::aslant(&map.grid, &analysis)))
    };
    let measured: Vec<(MapScore, [usize; 2])> = maps.par_iter().map(one).collect::<Outcome<_>>()?;
    let (scores, aslant): (Vec<MapScore>, Vec<[usize; 2]>) = measured.into_iter().unzip();
    let head = [
        "map",
        "score",
        "storage met",
        "precision",
        "false faces",
        "faces per bay",
        "aisles met",
        "precision",
        "open floor found",
        "precision",
        "drivable IoU",
        "headings aslant",
    ];
    let rows = maps.iter().zip(&scores).zip(&aslant).map(|((map, score), [aslant, locations])| {
        let [storage, aisles, floor] = score.labels;
        let precision = |label: Option<LabelScore>| label.map_or("-".to_owned(), |label| percent(label.precision));
        let met = |label: Option<LabelScore>| {
            label.map_or("-".to_owned(), |label| format!("{} of {}", label.met, label.things))
        };
        vec![
            map.title().to_owned(),
            percent(score.score()),
            met(storage),
            precision(storage),
            format!("{} of {}", score.false_faces, score.storage_faces),
            score.faces_per_bay.map_or("-".to_owned(), |ratio| format!("{ratio:.2}")),
            met(aisles),
            precision(aisles),
            floor.map_or("-".to_owned(), |label| percent(label.recall)),
            precision(floor),
            percent(score.drivable),
            format!("{aslant} of {locations}"),
        ]
    });
    let sum = |index: usize| aslant.iter().map(|counts| counts[index]).sum::<usize>();
    let total = [total(&scores), vec![format!("{} of {}", sum(0), sum(1))]].concat();
    Ok(table(&head, rows.chain([total])))
}

/// All maps together: means of shares, sums of counts; storage, aisles and open floor in the order of the labels.
fn total(scores: &[MapScore]) -> Vec<String> {
    let of = |label: usize, figure: fn(&LabelScore) -> f64| {
        percent(mean(scores.iter().filter_map(|score| score.labels[label].as_ref()).map(figure)))
    };
    let met = |label: usize| {
        let of_label = || scores.iter().filter_map(|score| score.labels[label]);
        let [met, things] =
            [of_label().map(|score| score.met).sum::<usize>(), of_label().map(|score| score.things).sum()];
        format!("{met} of {things}")
    };
    let faces: [usize; 2] =
        [scores.iter().map(|score| score.false_faces).sum(), scores.iter().map(|score| score.storage_faces).sum()];
    vec![
        "**all**".to_owned(),
        percent(mean(scores.iter().map(MapScore::score))),
        met(0),
        of(0, |label| label.precision),
        format!("{} of {}", faces[0], faces[1]),
        String::new(),
        met(1),
        of(1, |label| label.precision),
        of(2, |label| label.recall),
        of(2, |label| label.precision),
        percent(mean(scores.iter().map(|score| score.drivable))),
    ]
}
