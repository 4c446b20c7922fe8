//! Storage layouts of generated sites beside their truth.

use std::ops::RangeInclusive;
use std::path::PathBuf;

use rayon::prelude::*;
use stillage_core::evaluation::LayoutScores;
use stillage_core::graph::navigation_graph;
use stillage_core::graph_report::{ReportOptions, graph_report};
use stillage_core::layout::{self, LayoutSpec};
use stillage_core::routing::Router;
use stillage_core::{AnalysisSpec, SiteCells, Watch};
use stillage_zoo::{Kind, Options};

use crate::Outcome;
use crate::sites::{self, Site};
use crate::tables::{percent, table};

/// Kendall's tau is 1 within the rounding of its division.
const IN_ORDER: f64 = 1.0 - 1e-9;

/// The layout of one site, scored.
struct Scored {
    group: String,
    scores: LayoutScores,
    /// Locations that lanes of the navigation graph lead to.
    on_lanes: usize,
}

/// Every kind of the zoo, and the maps `<size>_<sensor>_<difficulty>_<seed>` of some folders.
pub fn layouts(seeds: RangeInclusive<u64>, folders: &[PathBuf]) -> Outcome<String> {
    let kinds = Kind::ALL.iter().flat_map(|&kind| seeds.clone().map(move |seed| (kind, seed)));
    let of_zoo = |(kind, seed): (Kind, u64)| -> Outcome<Scored> {
        scored(kind.to_string(), &sites::of_zoo(kind, seed, &Options::default())?)
    };
    let mut all: Vec<Scored> = kinds.collect::<Vec<_>>().into_par_iter().map(of_zoo).collect::<Outcome<_>>()?;
    for folder in folders {
        let names =
            sites::names(folder, "")?.into_iter().filter(|name| folder.join(name).join("truth.geojson").is_file());
        let of_folder = |name: String| -> Outcome<Scored> {
            let group = name.rsplit_once('_').map_or(name.as_str(), |(group, _)| group).replace('_', " ");
            scored(group, &sites::read(&folder.join(&name).join("map.yaml"))?)
        };
        all.extend(names.collect::<Vec<_>>().into_par_iter().map(of_folder).collect::<Outcome<Vec<_>>>()?);
    }
    Ok(written(&all))
}

fn scored(group: String, site: &Site) -> Outcome<Scored> {
    let truth = site.truth.as_ref().ok_or("a map without truth.geojson cannot be scored")?;
    let analysis = sites::analyzed(&site.grid, &AnalysisSpec::default())?;
    let semantic = sites::suggested(&analysis);
    let cells = SiteCells::of(&site.grid, &analysis);
    let map = cells.map(&site.grid, &analysis, &semantic);
    let spec = LayoutSpec::of(&analysis.options);
    let layout = layout::layout(&map, &spec);
    let router = Router::new(&map, spec.vehicle_radius);
    let scores = LayoutScores::of(&map, &layout, &router, truth, &Watch::unwatched())?;
    let graph = navigation_graph(&map, &layout, &router);
    let options = ReportOptions { samples: 1, ..ReportOptions::for_radius(router.radius()) };
    let report = graph_report(&map, &layout, &router, &graph, &options, &Watch::unwatched())?;
    let on_lanes = layout.locations.len() - report.unreachable.len();
    eprintln!("{group:<24}{:>5} of {:>5} found", scores.found, scores.places);
    Ok(Scored { group, scores, on_lanes })
}

fn written(all: &[Scored]) -> String {
    let mut groups: Vec<&str> = all.iter().map(|one| one.group.as_str()).collect();
    groups.dedup();
    let head = [
        "site",
        "places",
        "found by one location",
        "false locations",
        "aisles in order",
        "least tau",
        "poses drivable",
        "without a pose",
        "reachable from one another",
        "on lanes",
    ];
    let rows = groups.into_iter().map(Some).chain([None]).map(|group| {
        let scores: Vec<&Scored> = all.iter().filter(|one| group.is_none_or(|group| one.group == group)).collect();
        let sum = |value: &dyn Fn(&LayoutScores) -> usize| scores.iter().map(|one| value(&one.scores)).sum::<usize>();
        let orders = || scores.iter().flat_map(|one| &one.scores.orders);
        let locations = sum(&|scores| scores.locations);
        let share = |part: usize, whole: usize| percent(part as f64 / whole.max(1) as f64);
        [
            group.map_or_else(|| "**all**".to_owned(), str::to_owned),
            sum(&|scores| scores.places).to_string(),
            share(sum(&|scores| scores.found), sum(&|scores| scores.places)),
            format!("{} of {locations}", sum(&|scores| scores.false_locations)),
            format!("{} of {}", orders().filter(|order| order.tau >= IN_ORDER).count(), orders().count()),
            format!("{:.2}", orders().map(|order| order.tau).fold(1.0, f64::min)),
            share(sum(&|scores| scores.standing), sum(&|scores| scores.approaches)),
            (locations - sum(&|scores| scores.approaches)).to_string(),
            share(sum(&|scores| scores.reachable), locations),
            share(scores.iter().map(|one| one.on_lanes).sum(), locations),
        ]
        .to_vec()
    });
    table(&head, rows)
}
