//! The graph report of a map of the paper's size: how long it takes, and what it says.
//! `cargo run --release --example graph_report -- [radius in metres]`.
//!
//! The map is the one of the example `paper_scale`.

#![allow(clippy::print_stdout, reason = "an example prints what it measured")]

#[path = "../paper_scale/clock.rs"]
#[allow(dead_code, reason = "only its costs are used here")]
mod clock;
#[path = "../paper_scale/labelled.rs"]
mod labelled;
#[path = "../paper_scale/site.rs"]
mod site;

use clock::Cost;
use labelled::LabelledSite;
use stillage_core::graph::navigation_graph;
use stillage_core::graph_report::{ReportOptions, graph_report};
use stillage_core::layout::{LayoutSpec, layout};
use stillage_core::routing::Router;
use stillage_core::{SiteCells, Watch};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let radius: f64 = std::env::args().nth(1).map_or(Ok(0.4), |radius| radius.parse())?;
    let LabelledSite { grid, analysis, semantic } = LabelledSite::new()?;
    let cells = SiteCells::of(&grid, &analysis);
    let map = cells.map(&grid, &analysis, &semantic);
    let storage = layout(&map, &LayoutSpec::of(&analysis.options));
    let (router, made) = Cost::of(|| Router::new(&map, radius));
    let (graph, built) = Cost::of(|| navigation_graph(&map, &storage, &router));
    let options = ReportOptions::for_radius(radius);
    let (report, told) = Cost::of(|| graph_report(&map, &storage, &router, &graph, &options, &Watch::unwatched()));
    let report = report?;
    for (name, cost) in [("router", &made), ("navigation graph", &built), ("graph report", &told)] {
        println!("{name:<28}{:>9.2} CPU s{:>9.2} s{:>9.0} MiB", cost.cpu_s, cost.wall_s, cost.peak_mib);
    }
    println!("{} faces, {} locations", analysis.faces.len() - 1, storage.locations.len());
    println!(
        "{} components of faces, {} of the graph, {} dead ends, {} narrow passages, {} disagreements",
        report.face_components.len(),
        report.components.len(),
        report.dead_ends.len(),
        report.narrow_passages.len(),
        report.disagreements.len()
    );
    println!("{} locations are not reached", report.unreachable.len());
    println!("{:#?}", report.figures);
    Ok(())
}
