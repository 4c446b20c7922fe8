//! How long each export of a map of the paper's size takes: `cargo run --release --example exports -- [folder]`.
//!
//! The map is the one of the example `paper_scale` of the core. With a folder, the files are left there.

#![allow(clippy::print_stdout, reason = "an example prints what it measured")]

#[path = "../../crates/stillage-core/examples/paper_scale/clock.rs"]
#[allow(dead_code, reason = "only its costs are used here")]
mod clock;
#[path = "../../crates/stillage-core/examples/paper_scale/labelled.rs"]
mod labelled;
#[path = "../../crates/stillage-core/examples/paper_scale/site.rs"]
mod site;

use std::path::PathBuf;

use clock::Cost;
use jiff::Timestamp;
use labelled::LabelledSite;
use stillage::exports::{ExportOptions, ExportSource, list, write};
use stillage::features::MapNames;
use stillage_core::SiteCells;
use stillage_core::graph::navigation_graph;
use stillage_core::layout::{LayoutSpec, layout};
use stillage_core::routing::Router;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let folder = std::env::args().nth(1).map(PathBuf::from);
    let LabelledSite { grid, analysis, semantic } = LabelledSite::new()?;
    let cells = SiteCells::of(&grid, &analysis);
    let map = cells.map(&grid, &analysis, &semantic);
    let spec = LayoutSpec::of(&analysis.options);
    let storage = layout(&map, &spec);
    let (router, made) = Cost::of(|| Router::new(&map, spec.vehicle_radius));
    let (graph, built) = Cost::of(|| navigation_graph(&map, &storage, &router));
    let faces = analysis.faces.len() - 1;
    let bends: usize = graph.lanes.iter().map(|lane| lane.path.len() - 2).sum();
    let [locations, nodes, lanes] = [storage.locations.len(), graph.nodes.len(), graph.lanes.len()];
    println!("{faces} faces, {locations} locations, {nodes} nodes, {lanes} lanes with {bends} bends");
    line("(router, kept)", &made, 0);
    line("(navigation graph, kept)", &built, 0);
    let source = ExportSource {
        name: "Warehouse",
        map_id: "warehouse",
        version: "1",
        created: Timestamp::UNIX_EPOCH,
        grid: &grid,
        analysis: &analysis,
        semantic: &semantic,
        cells: &cells.faces,
        layout: &storage,
        graph: &graph,
        names: MapNames::none(),
        georeference: None,
    };
    let link = Some("https://maps.example/bundle.zip".to_owned());
    let options = ExportOptions { link, ..ExportOptions::default() };
    for export in list() {
        let (written, cost) = Cost::of(|| write(export, &source, &options));
        let bytes = written?;
        line(export.name, &cost, bytes.len());
        if let Some(folder) = &folder {
            std::fs::create_dir_all(folder)?;
            std::fs::write(folder.join(export.name), bytes)?;
        }
    }
    Ok(())
}

fn line(name: &str, cost: &Cost, bytes: usize) {
    println!("{name:<28}{:>8.3} CPU s{:>8.3} s{:>9.2} MB", cost.cpu_s, cost.wall_s, bytes as f64 / 1e6);
}
