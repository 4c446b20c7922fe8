//! Every map of the collection loads with the occupancy that was counted by other means.

use std::path::Path;

use serde_json::Value;
use stillage::ingest::{DecodedMap, Limits, MapSource, decode};
use stillage_core::Occupancy;
use stillage_core::spec::{GridOptions, GridSemantics};

use crate::shared;

fn load(folder: &Path, image: &str, semantics: GridSemantics) -> DecodedMap {
    let read = |name: &str| std::fs::read(folder.join(name)).unwrap();
    let source = MapSource::Image { image: read(image), metadata: read("map.yaml") };
    let options = GridOptions { semantics, ..GridOptions::default() };
    decode(&source, &options, &Limits::default()).unwrap_or_else(|error| panic!("{}: {error}", folder.display()))
}

/// Per cent occupied, free and unknown.
fn shares(map: &DecodedMap) -> [f64; 3] {
    [Occupancy::Occupied, Occupancy::Free, Occupancy::Unknown]
        .map(|occupancy| map.grid.count(occupancy) as f64 * 100.0 / map.grid.cells().len() as f64)
}

/// The three numbers of `occupied 3.0%, free 77.5%, unknown 19.5%`.
fn stated_shares(text: &str) -> Option<[f64; 3]> {
    let mut numbers = text.split(',').map(|part| part.split_whitespace().nth(1)?.strip_suffix('%')?.parse().ok());
    Some([numbers.next()??, numbers.next()??, numbers.next()??])
}

/// The index counted these by the rules of ROS 1 (strict thresholds, opacity ignored); nav2 and we read them otherwise.
const READ_OTHERWISE: [(&str, [f64; 3]); 2] = [
    // Thresholds 1.0 and 0.0: pure black is occupied, as the comparison is inclusive.
    ("format__scale_mode_depot_speed", [2.0, 0.0, 98.0]),
    // Pixels that are not opaque are unknown.
    ("format__alpha_64_255_drawing", [1.4, 95.6, 3.0]),
];

#[test]
fn every_map_reads_with_the_shares_of_the_index() {
    let Some(maps) = shared("maps/dev") else { return };
    let index: Vec<Value> = serde_json::from_slice(&std::fs::read(maps.join("index.json")).unwrap()).unwrap();
    let mut others = Vec::new();
    for entry in index.iter().filter(|entry| entry["set"] == "dev") {
        let text = |key: &str| entry[key].as_str().unwrap_or_default();
        let id = text("id");
        let folder = maps.join(id);
        let map = load(&folder, text("file"), GridSemantics::Nav2);
        let grid = &map.grid;
        assert_eq!(
            (Some(grid.width() as u64), Some(grid.height() as u64)),
            (entry["w"].as_u64(), entry["h"].as_u64()),
            "{id}"
        );
        assert_eq!(Some(grid.resolution()), entry["resolution"].as_f64(), "{id}");
        assert_eq!(Some(grid.frame().yaw), entry["origin"][2].as_f64(), "{id}");
        let otherwise = READ_OTHERWISE.iter().find(|(name, _)| *name == id).map(|(_, shares)| *shares);
        let Some(expected) = otherwise.or_else(|| stated_shares(text("trinary_at_yaml_thresholds"))) else { continue };
        let found = shares(&map);
        let close = found.iter().zip(expected).all(|(found, expected)| (found - expected).abs() <= 0.051);
        if !close {
            others.push(format!("{id}: {found:?} instead of {expected:?}"));
        }
    }
    assert!(others.is_empty(), "{}", others.join("\n"));
}

#[test]
fn maps_whose_threshold_swallows_the_unknown_cells_are_pointed_out() {
    let Some(maps) = shared("maps/dev") else { return };
    let index: Vec<Value> = serde_json::from_slice(&std::fs::read(maps.join("index.json")).unwrap()).unwrap();
    let mut warned = Vec::new();
    for entry in index.iter().filter(|entry| entry["set"] == "dev") {
        let id = entry["id"].as_str().unwrap();
        let map = load(&maps.join(id), entry["file"].as_str().unwrap(), GridSemantics::Intended);
        for warning in &map.warnings {
            warned.push(format!("{id} {}: {}", warning.code, warning.message));
        }
    }
    expect_test::expect![[r#"
        warehouse__hunav_small_warehouse unknown-kept: 16.1 % of the pixels have grey level 205, which map savers write for unknown cells, and were read as unknown, although the free threshold is 0.25; to keep the letter of the file, set options.grid.semantics: "nav2"
        warehouse__nav2_depot unknown-kept: 4.8 % of the pixels have grey level 205, which map savers write for unknown cells, and were read as unknown, although the free threshold is 0.25; to keep the letter of the file, set options.grid.semantics: "nav2"
        warehouse__svl_warehouse_dt_pallets unknown-kept: 8.9 % of the pixels have grey level 205, which map savers write for unknown cells, and were read as unknown, although the free threshold is 0.25; to keep the letter of the file, set options.grid.semantics: "nav2"
        office__pal_office unknown-kept: 34.3 % of the pixels have grey level 205, which map savers write for unknown cells, and were read as unknown, although the free threshold is 0.25; to keep the letter of the file, set options.grid.semantics: "nav2"
        bormann__Freiburg52_scan unknown-lost: 5.1 % of the pixels have grey level 211 and were read as free, because the free threshold is 0.196; if they mean unknown, set options.grid.freeThreshold: 0.172"#]].assert_eq(&warned.join("\n"));
}
