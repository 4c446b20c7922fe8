//! The exports there are, and each of them as bytes.

use serde::Serialize;

use super::archive::{NamedFile, zip};
use super::location_sheet::InventoryOptions;
use super::locations_csv::Profile;
use super::nav2_masks::{KeepoutOptions, SpeedOptions};
use super::source::{ExportError, ExportSource};
use super::vda5050_download_map::MapDownload;
use super::vda5050_zone_set::ZoneSetOptions;
use super::{
    bundle, graph_ml, lif_1, lif_2, locations_csv, locations_xlsx, moving_ai, nav2_masks, nav2_route, rmf_building,
    rmf_nav_graph, vda5050_download_map, vda5050_zone_set,
};

/// An export of a map.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "camelCase")]
pub struct Export {
    /// Name of its file.
    pub name: &'static str,
    /// Media type of its file.
    pub media_type: &'static str,
    /// What it is for.
    pub purpose: &'static str,
    /// Names of its options.
    pub options: &'static [&'static str],
    /// Which one it is.
    #[serde(skip)]
    pub kind: ExportKind,
}

/// Which export it is.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ExportKind {
    /// LIF 1.0.
    Lif1,
    /// LIF 2.0.
    Lif2,
    /// VDA 5050 zone set.
    ZoneSet,
    /// Nav2 route graph.
    Nav2Route,
    /// Nav2 keepout mask.
    Nav2Keepout,
    /// Nav2 speed mask.
    Nav2Speed,
    /// Open-RMF navigation graph.
    RmfNavGraph,
    /// Open-RMF building.
    RmfBuilding,
    /// `MovingAI` grid map.
    MovingAi,
    /// Locations as CSV.
    LocationsCsv,
    /// Locations as a spreadsheet.
    LocationsXlsx,
    /// `GraphML`.
    GraphMl,
    /// All others in one archive.
    Bundle,
    /// The order to fetch the archive.
    DownloadMap,
}

/// What exports cannot read off a map.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct ExportOptions {
    /// Of the VDA 5050 zone set.
    pub zone_set: ZoneSetOptions,
    /// Of the Nav2 keepout mask.
    pub keepout: KeepoutOptions,
    /// Of the Nav2 speed mask.
    pub speed: SpeedOptions,
    /// Of the VDA 5050 order to fetch the bundle.
    pub download: MapDownload,
    /// Columns of the CSV.
    pub profile: Profile,
    /// Of the CSV.
    pub inventory: InventoryOptions,
}

const JSON: &str = "application/json";
const YAML: &str = "application/yaml";
const ZIP: &str = "application/zip";
const XLSX: &str = "application/vnd.openxmlformats-officedocument.spreadsheetml.sheet";

const EXPORTS: &[Export] = &[
    Export {
        name: "lif.json",
        media_type: JSON,
        purpose: "Layout Interchange Format 1.0: graph and stations for fleet managers",
        options: &[],
        kind: ExportKind::Lif1,
    },
    Export {
        name: "lif-2.0.json",
        media_type: JSON,
        purpose: "Layout Interchange Format 2.0 (draft), with the free ground beside each edge",
        options: &[],
        kind: ExportKind::Lif2,
    },
    Export {
        name: "vda5050-zone-set.json",
        media_type: JSON,
        purpose: "VDA 5050 3.0 zone set: what vehicles may do where",
        options: &["manufacturer", "serialNumber", "junctionSpeed", "workPlacePenalty"],
        kind: ExportKind::ZoneSet,
    },
    Export {
        name: "nav2-route.geojson",
        media_type: "application/geo+json",
        purpose: "Route graph of Nav2",
        options: &[],
        kind: ExportKind::Nav2Route,
    },
    Export {
        name: "nav2-keepout.zip",
        media_type: ZIP,
        purpose: "Costmap filter mask of Nav2: where vehicles must not drive",
        options: &["workPlaces"],
        kind: ExportKind::Nav2Keepout,
    },
    Export {
        name: "nav2-speed.zip",
        media_type: ZIP,
        purpose: "Costmap filter mask of Nav2: where vehicles must drive slowly",
        options: &["junctionPercent", "workPlacePercent"],
        kind: ExportKind::Nav2Speed,
    },
    Export {
        name: "rmf-nav-graph.yaml",
        media_type: YAML,
        purpose: "Navigation graph of Open-RMF fleet adapters",
        options: &[],
        kind: ExportKind::RmfNavGraph,
    },
    Export {
        name: "rmf.building.yaml",
        media_type: YAML,
        purpose: "Building file of the Open-RMF traffic editor",
        options: &[],
        kind: ExportKind::RmfBuilding,
    },
    Export {
        name: "drivable.map",
        media_type: "text/plain; charset=utf-8",
        purpose: "Grid map of the MovingAI benchmarks, for planners of many agents",
        options: &[],
        kind: ExportKind::MovingAi,
    },
    Export {
        name: "locations.csv",
        media_type: "text/csv; charset=utf-8",
        purpose: "Storage locations for inventory systems",
        options: &["profile", "warehouse", "storageType"],
        kind: ExportKind::LocationsCsv,
    },
    Export {
        name: "locations.xlsx",
        media_type: XLSX,
        purpose: "Storage locations as a spreadsheet",
        options: &[],
        kind: ExportKind::LocationsXlsx,
    },
    Export {
        name: "graph.graphml",
        media_type: "application/graphml+xml",
        purpose: "The graph for tools that study graphs",
        options: &[],
        kind: ExportKind::GraphMl,
    },
    Export {
        name: "bundle.zip",
        media_type: ZIP,
        purpose: "All of these with their checksums",
        options: &[],
        kind: ExportKind::Bundle,
    },
    Export {
        name: "vda5050-download-map.json",
        media_type: JSON,
        purpose: "VDA 5050 3.0 instant action that lets a vehicle fetch the bundle",
        options: &["manufacturer", "serialNumber", "link"],
        kind: ExportKind::DownloadMap,
    },
];

/// Every export.
#[must_use]
pub const fn list() -> &'static [Export] {
    EXPORTS
}

impl Export {
    /// The export of a name.
    #[must_use]
    pub fn find(name: &str) -> Option<&'static Self> {
        list().iter().find(|export| export.name == name)
    }

    /// Writes the export of a map.
    ///
    /// # Errors
    /// [`ExportError`] when the format has no place for the map.
    pub fn write(&self, source: &ExportSource<'_>, options: &ExportOptions) -> Result<Vec<u8>, ExportError> {
        Ok(match self.kind {
            ExportKind::Lif1 => json(&lif_1::layout(source)),
            ExportKind::Lif2 => json(&lif_2::layout(source)),
            ExportKind::ZoneSet => json(&vda5050_zone_set::zone_set(source, &options.zone_set)),
            ExportKind::Nav2Route => json(&nav2_route::graph(source)?),
            ExportKind::Nav2Keepout => zip(&nav2_masks::keepout(source, options.keepout)),
            ExportKind::Nav2Speed => zip(&nav2_masks::speed(source, options.speed)),
            ExportKind::RmfNavGraph => rmf_nav_graph::nav_graph(source),
            ExportKind::RmfBuilding => rmf_building::building(source),
            ExportKind::MovingAi => moving_ai::map(source),
            ExportKind::LocationsCsv => locations_csv::locations(source, options.profile, &options.inventory),
            ExportKind::LocationsXlsx => locations_xlsx::locations(source)?,
            ExportKind::GraphMl => graph_ml::graph(source),
            ExportKind::Bundle => zip(&bundle::files(source, options)),
            ExportKind::DownloadMap => {
                let hash = bundle::sha256(&zip(&bundle::files(source, options)));
                json(&vda5050_download_map::download_map(source, &options.download, hash))
            }
        })
    }

    /// The file that the export of a map is.
    ///
    /// # Errors
    /// [`ExportError`] when the format has no place for the map.
    pub fn file(&self, source: &ExportSource<'_>, options: &ExportOptions) -> Result<NamedFile, ExportError> {
        Ok(NamedFile { name: self.name.to_owned(), bytes: self.write(source, options)? })
    }
}

fn json(document: &impl Serialize) -> Vec<u8> {
    let mut bytes = serde_json::to_vec_pretty(document).expect("documents are texts and finite numbers");
    bytes.push(b'\n');
    bytes
}
