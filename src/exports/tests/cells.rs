//! Exports that are pictures of the cells.

use stillage_core::spec::GridOptions;
use stillage_core::{Occupancy, OccupancyGrid};

use super::Site;
use crate::exports::nav2_masks::{KeepoutOptions, SpeedOptions, keepout, speed};
use crate::exports::{NamedFile, moving_ai};
use crate::ingest::{Limits, MapSource, decode};

/// The files as our own ingest reads them.
fn read_back([image, metadata]: [NamedFile; 2]) -> OccupancyGrid {
    let source = MapSource::Image { image: image.bytes, metadata: metadata.bytes };
    let decoded = decode(&source, &GridOptions::default(), &Limits::default()).unwrap();
    assert_eq!(decoded.warnings, []);
    decoded.grid
}

#[test]
fn a_keepout_mask_is_read_back_cell_for_cell() {
    let site = Site::whole();
    let source = site.source();
    let mask = read_back(keepout(&source, KeepoutOptions::default()));
    assert_eq!(mask.frame(), site.grid.frame());
    for (cell, face) in mask.cells().iter().zip(site.cells.iter()) {
        let expected = match source.semantic.label(face) {
            _ if face.0 == 0 => Occupancy::Occupied,
            label if label.is_drivable() => Occupancy::Free,
            _ => Occupancy::Occupied,
        };
        assert_eq!(*cell, expected);
    }
    assert!(mask.count(Occupancy::Free) > 1000 && mask.count(Occupancy::Occupied) > 1000);
}

#[test]
fn a_speed_mask_darkens_junctions() {
    let site = Site::whole();
    let source = site.source();
    let [image, metadata] = speed(&source, SpeedOptions::default());
    let text = String::from_utf8(metadata.bytes).unwrap();
    assert!(text.contains("mode: scale") && text.contains("occupied_thresh: 1.0\nfree_thresh: 0.0"), "{text}");
    let cells = &image.bytes[image.bytes.len() - site.grid.cells().len()..];
    let (width, height) = (site.grid.width(), site.grid.height());
    let faces = (0..height).rev().flat_map(|row| (0..width).map(move |column| site.cells.at(column, row)));
    for (&grey, face) in cells.iter().zip(faces) {
        let is_junction = face.0 > 0 && source.semantic.label(face).id == "ju";
        assert_eq!(grey, if is_junction { 128 } else { 255 });
    }
    // What Nav2 reads in mode `scale`: 50 of 100, so 50 % of the greatest speed.
    assert_eq!((100.0 * (255.0 - 128.0) / 255.0_f64).round(), 50.0);
}

#[test]
fn a_grid_map_opens_free_cells_of_drivable_faces() {
    let site = Site::whole();
    let source = site.source();
    let text = String::from_utf8(moving_ai::map(&source)).unwrap();
    let mut lines = text.lines();
    let head: Vec<&str> = lines.by_ref().take(4).collect();
    assert_eq!(head, ["type octile", "height 160", "width 240", "map"]);
    let rows: Vec<&str> = lines.collect();
    assert_eq!(rows.len(), 160);
    for (index, row) in rows.iter().rev().enumerate() {
        for (column, character) in row.bytes().enumerate() {
            let is_open = site.grid.row(index)[column] == Occupancy::Free
                && site.cells.at(column, index).0 > 0
                && source.semantic.label(site.cells.at(column, index)).is_drivable();
            assert_eq!(character == b'.', is_open);
        }
    }
}
