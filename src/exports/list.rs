//! The exports there are.

use serde::Serialize;

use super::location_sheet::InventoryOptions;
use super::locations_csv::Profile;
use super::nav2_masks::{KeepoutOptions, SpeedOptions};
use super::vda5050_download_map::MapDownload;
use super::vda5050_zone_set::ZoneSetOptions;

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
    /// One file, read off the map alone.
    Single(SingleExport),
    /// All of those in one archive.
    Bundle,
    /// The order to fetch the archive.
    DownloadMap,
}

/// Which file it is.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum SingleExport {
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
        kind: ExportKind::Single(SingleExport::Lif1),
    },
    Export {
        name: "lif-2.0.json",
        media_type: JSON,
        purpose: "Layout Interchange Format 2.0 (draft), with the free ground beside each edge",
        options: &[],
        kind: ExportKind::Single(SingleExport::Lif2),
    },
    Export {
        name: "vda5050-zone-set.json",
        media_type: JSON,
        purpose: "VDA 5050 3.0 zone set: what vehicles may do where",
        options: &["manufacturer", "serialNumber", "junctionSpeed", "workPlacePenalty"],
        kind: ExportKind::Single(SingleExport::ZoneSet),
    },
    Export {
        name: "nav2-route.geojson",
        media_type: "application/geo+json",
        purpose: "Route graph of Nav2",
        options: &[],
        kind: ExportKind::Single(SingleExport::Nav2Route),
    },
    Export {
        name: "nav2-keepout.zip",
        media_type: ZIP,
        purpose: "Costmap filter mask of Nav2: where vehicles must not drive",
        options: &["workPlaces"],
        kind: ExportKind::Single(SingleExport::Nav2Keepout),
    },
    Export {
        name: "nav2-speed.zip",
        media_type: ZIP,
        purpose: "Costmap filter mask of Nav2: where vehicles must drive slowly",
        options: &["junctionPercent", "workPlacePercent"],
        kind: ExportKind::Single(SingleExport::Nav2Speed),
    },
    Export {
        name: "rmf-nav-graph.yaml",
        media_type: YAML,
        purpose: "Navigation graph of Open-RMF fleet adapters",
        options: &[],
        kind: ExportKind::Single(SingleExport::RmfNavGraph),
    },
    Export {
        name: "rmf.building.yaml",
        media_type: YAML,
        purpose: "Building file of the Open-RMF traffic editor",
        options: &[],
        kind: ExportKind::Single(SingleExport::RmfBuilding),
    },
    Export {
        name: "drivable.map",
        media_type: "text/plain; charset=utf-8",
        purpose: "Grid map of the MovingAI benchmarks, for planners of many agents",
        options: &[],
        kind: ExportKind::Single(SingleExport::MovingAi),
    },
    Export {
        name: "locations.csv",
        media_type: "text/csv; charset=utf-8",
        purpose: "Storage locations for inventory systems",
        options: &["profile", "warehouse", "storageType"],
        kind: ExportKind::Single(SingleExport::LocationsCsv),
    },
    Export {
        name: "locations.xlsx",
        media_type: XLSX,
        purpose: "Storage locations as a spreadsheet",
        options: &[],
        kind: ExportKind::Single(SingleExport::LocationsXlsx),
    },
    Export {
        name: "graph.graphml",
        media_type: "application/graphml+xml",
        purpose: "The graph for tools that study graphs",
        options: &[],
        kind: ExportKind::Single(SingleExport::GraphMl),
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
}
