//! One map of a hall as the tools of real people hold it: messages in their envelopes, metadata of scripts, paths of Windows,
//! pictures whose opacity means nothing. However it comes, it has the cells of the hall.

use std::path::Path;

use stillage::ingest::{IngestError, Limits, MapSource, decode, is_message};
use stillage_core::Occupancy;
use stillage_core::spec::GridOptions;

use crate::shared;

/// Free, occupied and unknown cells, counted when the hall was drawn.
const HALL: [usize; 3] = [65_576, 22_008, 32_416];

/// The files below a folder.
fn files(folder: &Path) -> Vec<std::path::PathBuf> {
    let entries = std::fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path());
    entries.flat_map(|path| if path.is_dir() { files(&path) } else { vec![path] }).collect()
}

/// Free, occupied and unknown cells of the map in a folder.
fn cells(folder: &Path) -> Result<[usize; 3], IngestError> {
    let files = files(folder);
    let is_words = |path: &&std::path::PathBuf| path.extension().is_some_and(|it| it == "json" || it == "yaml");
    let words = std::fs::read(files.iter().find(is_words).unwrap()).unwrap();
    let source = if is_message(&words) {
        MapSource::Message(words)
    } else {
        let image = std::fs::read(files.iter().find(|path| !is_words(path)).unwrap()).unwrap();
        MapSource::Image { image, metadata: words }
    };
    let grid = decode(&source, &GridOptions::default(), &Limits::default())?.grid;
    Ok([Occupancy::Free, Occupancy::Occupied, Occupancy::Unknown].map(|occupancy| grid.count(occupancy)))
}

#[test]
fn the_hall_has_its_cells_however_it_comes() {
    let Some(cases) = shared("cases") else { return };
    for case in [
        "01-zero-one-message/m-01",
        "03-rosbridge-frames/m-base64",
        "03-rosbridge-frames/m-envelope",
        "03-rosbridge-frames/m-service",
        "03-rosbridge-frames/m-typedarray",
        "04-topic-echo/m-echo-full",
        "05-nan-in-json/m-nan",
        "06-numpy-yaml/y-anchors",
        "06-numpy-yaml/y-numpy",
        "06-numpy-yaml/y-numpy1",
        "06-numpy-yaml/y-tuple",
        "07-windows-path/y-winplain",
        "07-windows-path/y-winquoted",
        "07-windows-path/y-winrel",
        "07-windows-path/y-winsingle",
        "07-windows-path/y-winsub",
        "10-transparent/alpha-254",
        "10-transparent/alpha-zero",
        "10-transparent/b-32-v3-argb-zero",
        "10-transparent/b-32-zero-alpha",
        "17-turned-180/m-plain",
        "17-turned-180/m-yawpi",
    ] {
        assert_eq!(cells(&cases.join(case)), Ok(HALL), "{case}");
    }
}

#[test]
fn a_message_that_was_cut_is_told_how_to_print_it_whole() {
    let Some(cases) = shared("cases") else { return };
    let refusal = cells(&cases.join("04-topic-echo/m-echo")).unwrap_err();
    assert_eq!(refusal.pointer, "/data");
    assert!(refusal.message.contains("cut after 128 cells"), "{refusal}");
}
