//! The folder that `stillage analyze` writes.
//!
//! Everything is written into a temporary folder beside the target first; then the folder takes its name, or its
//! files replace those of an earlier run one by one. Nobody ever sees half a file.

use std::io;
use std::path::{Path, PathBuf};

use serde_json::{Value, json};
use stillage_core::Occupancy;
use stillage_core::analysis::ALGORITHM_VERSION;
use stillage_core::semantics::Suggestion;

use crate::app::{MapContext, StageReport};
use crate::cli::failure::Failure;
use crate::cli::findings::Findings;
use crate::coordinates::Transform;
use crate::features::Collection;
use crate::features::query::PropertySelection;
use crate::formats::{csv, geojson};
use crate::measures::peak_rss_mib;
use crate::render;
use crate::views::correction::ListedCorrection;

/// Checks that the folder can be written, before the long work.
pub(super) fn check(folder: &Path) -> Result<(), Failure> {
    if folder.exists() && !folder.is_dir() {
        return Err(Failure::Input(format!("{} is a file: name a folder with --out", folder.display())));
    }
    std::fs::create_dir_all(parent(folder)).map_err(|error| {
        Failure::Input(format!("{} cannot be made ({error}): name another folder with --out", folder.display()))
    })
}

/// Writes everything that was found.
pub(super) fn write(folder: &Path, findings: &Findings, stages: &[StageReport]) -> Result<(), Failure> {
    let failed = |error: io::Error| Failure::Internal(format!("{} cannot be written: {error}", folder.display()));
    let temporary = tempfile::Builder::new().prefix(".stillage-").tempdir_in(parent(folder)).map_err(failed)?;
    for (name, bytes) in files(findings, stages) {
        std::fs::write(temporary.path().join(name), bytes).map_err(failed)?;
    }
    publish(temporary, folder).map_err(failed)
}

/// Gives the temporary folder its name, or moves its files into the folder that has it.
fn publish(temporary: tempfile::TempDir, folder: &Path) -> io::Result<()> {
    if !folder.exists() {
        // Temporary folders are private; results are as open as any other file.
        open_to_others(temporary.path())?;
        return std::fs::rename(temporary.keep(), folder);
    }
    for entry in std::fs::read_dir(temporary.path())? {
        let entry = entry?;
        std::fs::rename(entry.path(), folder.join(entry.file_name()))?;
    }
    temporary.close()
}

#[cfg(unix)]
fn open_to_others(folder: &Path) -> io::Result<()> {
    use std::os::unix::fs::PermissionsExt;
    std::fs::set_permissions(folder, std::fs::Permissions::from_mode(0o755))
}

#[cfg(not(unix))]
fn open_to_others(_: &Path) -> io::Result<()> {
    Ok(())
}

fn parent(folder: &Path) -> &Path {
    folder.parent().filter(|parent| !parent.as_os_str().is_empty()).unwrap_or(Path::new("."))
}

/// Name and content of each file.
fn files(findings: &Findings, stages: &[StageReport]) -> Vec<(PathBuf, Vec<u8>)> {
    let MapContext { grid, analysis, semantic, layout, .. } = &findings.context;
    let layer = |collection: Collection| {
        let members: geojson::Members<'_> = &[("crs", &geojson::EPSG_3857)];
        let all = PropertySelection::all(collection);
        let features = findings.context.features(collection);
        let bytes = geojson::feature_collection(features, &all, &Transform::map_frame(), members);
        (PathBuf::from(format!("{}.geojson", collection.id())), bytes)
    };
    let mut files: Vec<(PathBuf, Vec<u8>)> = Collection::ALL.into_iter().map(layer).collect();
    files.push(("image.png".into(), render::image(grid)));
    files.push(("categories.png".into(), render::categories(analysis)));
    files.push(("regions.png".into(), render::regions(analysis, grid)));
    let locations = &layout.locations;
    files.push(("semantic.png".into(), render::semantic_png(grid, analysis, semantic, locations)));
    files.push(("semantic.svg".into(), render::semantic_svg(grid, analysis, semantic, locations)));
    files.push(("locations.csv".into(), csv::locations(findings.context.features(Collection::Locations))));
    files.push(("report.json".into(), format!("{:#}\n", report(findings, stages)).into_bytes()));
    files
}

/// What was done, what it cost and what came out.
fn report(findings: &Findings, stages: &[StageReport]) -> Value {
    let Findings { context, diagnostics } = findings;
    let MapContext { grid, analysis, semantic, .. } = context;
    let frame = grid.frame();
    let rule_set = &semantic.rule_set;
    let suggestion = |suggestion: &Suggestion| {
        json!({
            "category": suggestion.category,
            "label": rule_set.label(suggestion.label).id,
            "confidence": suggestion.confidence,
            "reason": suggestion.reason,
        })
    };
    json!({
        "map": {
            "name": context.record.name,
            "width": grid.width(),
            "height": grid.height(),
            "resolution": frame.resolution,
            "origin": [frame.origin.x, frame.origin.y, frame.yaw],
        },
        "algorithmVersion": ALGORITHM_VERSION,
        "options": analysis.options,
        "stages": stages,
        "peakRssMiB": peak_rss_mib(),
        "cells": grid.cells().len(),
        "freeCells": grid.count(Occupancy::Free),
        "occupiedCells": grid.count(Occupancy::Occupied),
        "unknownCells": grid.count(Occupancy::Unknown),
        "counts": {
            "lines": analysis.lines.len(),
            "faces": analysis.subdivision.faces().len(),
            "edges": analysis.subdivision.edge_count(),
            "vertices": analysis.subdivision.vertex_count(),
            "regions": analysis.regions.regions.len(),
            "places": semantic.places.len(),
            "locations": context.layout.locations.len(),
        },
        "clustering": analysis.categories.fit,
        "relaxation": {"cells": analysis.categories.relaxation, "faces": analysis.face_relaxation},
        "diagnostics": diagnostics,
        "corrections": ListedCorrection::of_preview(&vec![None; context.corrections.list.len()], context),
        "ruleSet": rule_set.draft(),
        "assignment": context.semantics.assignment,
        "suggestions": context.suggestions.iter().map(suggestion).collect::<Vec<_>>(),
    })
}
