//! Each export that is read off the map alone, as bytes.

use serde::Serialize;

use super::archive::zip;
use super::list::SingleExport;
use super::options::ExportOptions;
use super::source::{ExportError, ExportSource};
use super::{
    faces, geopackage, graph_ml, lif_1, lif_2, locations_csv, locations_xlsx, moving_ai, nav2_masks, nav2_route,
    nav2_vector_objects, rmf_building, rmf_nav_graph, vda5050_zone_set,
};

/// Writes an export.
pub(super) fn single(
    export: SingleExport,
    source: &ExportSource<'_>,
    options: &ExportOptions,
) -> Result<Vec<u8>, ExportError> {
    Ok(match export {
        SingleExport::Lif1 => json(&lif_1::layout(source)),
        SingleExport::Lif2 => json(&lif_2::layout(source)),
        SingleExport::ZoneSet => json(&vda5050_zone_set::zone_set(source, &options.zones, &options.recipient)?),
        SingleExport::Nav2Route => json(&nav2_route::graph(source)?),
        SingleExport::Nav2Keepout => zip(&nav2_masks::keepout(source, options.keepout)),
        SingleExport::Nav2Speed => zip(&nav2_masks::speed(source, options.speed)),
        SingleExport::Nav2VectorObjects => nav2_vector_objects::parameters(source, options.keepout),
        SingleExport::RmfNavGraph => rmf_nav_graph::nav_graph(source),
        SingleExport::RmfBuilding => rmf_building::building(source),
        SingleExport::MovingAi => moving_ai::map(source),
        SingleExport::LocationsCsv => locations_csv::locations(source, options.profile, &options.inventory),
        SingleExport::LocationsXlsx => locations_xlsx::locations(source)?,
        SingleExport::GraphMl => graph_ml::graph(source),
        SingleExport::Faces => faces::faces(source, options.crs),
        SingleExport::GeoPackage => geopackage::map(source),
    })
}

/// A document as JSON, with a line break at its end. Without spaces: indented, the graph of a large site is three times as
/// long.
pub(super) fn json(document: &impl Serialize) -> Vec<u8> {
    let mut bytes = serde_json::to_vec(document).expect("documents are texts and finite numbers");
    bytes.push(b'\n');
    bytes
}
