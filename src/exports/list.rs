//! The exports there are.

use serde::Serialize;

/// An export of a map.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "camelCase")]
pub struct Export {
    /// Name of its format, for the command line.
    pub format: &'static str,
    /// Name of its file.
    pub name: &'static str,
    /// Media type of its file.
    pub media_type: &'static str,
    /// What it is for.
    pub purpose: &'static str,
    /// Names of its options; what they are, says [`super::option`].
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
    /// Nav2 vector objects.
    Nav2VectorObjects,
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
    /// Faces as `FlatGeobuf`.
    Faces,
    /// All collections as a `GeoPackage`.
    GeoPackage,
}

/// The option of the exports that read the graph.
const RADIUS: &str = "footprintRadiusM";
const JSON: &str = "application/json";
const YAML: &str = "application/yaml";
const ZIP: &str = "application/zip";
const XLSX: &str = "application/vnd.openxmlformats-officedocument.spreadsheetml.sheet";

const EXPORTS: &[Export] = &[
    Export {
        format: "lif",
        name: "lif.json",
        media_type: JSON,
        purpose: "Layout Interchange Format 1.0: graph and stations for fleet managers",
        options: &[RADIUS],
        kind: ExportKind::Single(SingleExport::Lif1),
    },
    Export {
        format: "lif-2.0",
        name: "lif-2.0.json",
        media_type: JSON,
        purpose: "Layout Interchange Format 2.0 (draft), with the free ground beside each edge",
        options: &[RADIUS],
        kind: ExportKind::Single(SingleExport::Lif2),
    },
    Export {
        format: "vda5050-zone-set",
        name: "vda5050-zone-set.json",
        media_type: JSON,
        purpose: "VDA 5050 3.0 zone set: what vehicles may do where",
        options: &["zones", "manufacturer", "serialNumber"],
        kind: ExportKind::Single(SingleExport::ZoneSet),
    },
    Export {
        format: "nav2-route",
        name: "nav2-route.geojson",
        media_type: "application/geo+json",
        purpose: "Route graph of Nav2",
        options: &[RADIUS],
        kind: ExportKind::Single(SingleExport::Nav2Route),
    },
    Export {
        format: "nav2-keepout",
        name: "nav2-keepout.zip",
        media_type: ZIP,
        purpose: "Costmap filter mask of Nav2: where vehicles must not drive",
        options: &["workPlaces"],
        kind: ExportKind::Single(SingleExport::Nav2Keepout),
    },
    Export {
        format: "nav2-speed",
        name: "nav2-speed.zip",
        media_type: ZIP,
        purpose: "Costmap filter mask of Nav2: where vehicles must drive slowly",
        options: &["junctionPercent", "workPlacePercent"],
        kind: ExportKind::Single(SingleExport::Nav2Speed),
    },
    Export {
        format: "nav2-vector-objects",
        name: "nav2-vector-objects.yaml",
        media_type: YAML,
        purpose: "Where vehicles must not drive, as polygons for the vector object server of Nav2",
        options: &["workPlaces"],
        kind: ExportKind::Single(SingleExport::Nav2VectorObjects),
    },
    Export {
        format: "rmf-nav-graph",
        name: "rmf-nav-graph.yaml",
        media_type: YAML,
        purpose: "Navigation graph of Open-RMF fleet adapters",
        options: &[RADIUS],
        kind: ExportKind::Single(SingleExport::RmfNavGraph),
    },
    Export {
        format: "rmf-building",
        name: "rmf.building.yaml",
        media_type: YAML,
        purpose: "Building file of the Open-RMF traffic editor",
        options: &[RADIUS],
        kind: ExportKind::Single(SingleExport::RmfBuilding),
    },
    Export {
        format: "moving-ai",
        name: "map.map",
        media_type: "text/plain; charset=utf-8",
        purpose: "Grid map of the MovingAI benchmarks, for planners of many agents",
        options: &[],
        kind: ExportKind::Single(SingleExport::MovingAi),
    },
    Export {
        format: "csv",
        name: "locations.csv",
        media_type: "text/csv; charset=utf-8",
        purpose: "Storage locations for inventory systems",
        options: &["profile", "warehouse", "storageType", RADIUS],
        kind: ExportKind::Single(SingleExport::LocationsCsv),
    },
    Export {
        format: "xlsx",
        name: "locations.xlsx",
        media_type: XLSX,
        purpose: "Storage locations as a spreadsheet",
        options: &[RADIUS],
        kind: ExportKind::Single(SingleExport::LocationsXlsx),
    },
    Export {
        format: "graphml",
        name: "graph.graphml",
        media_type: "application/graphml+xml",
        purpose: "The graph for tools that study graphs",
        options: &[RADIUS],
        kind: ExportKind::Single(SingleExport::GraphMl),
    },
    Export {
        format: "faces",
        name: "faces.fgb",
        media_type: "application/flatgeobuf",
        purpose: "Faces with their properties as FlatGeobuf, for GIS",
        options: &["crs"],
        kind: ExportKind::Single(SingleExport::Faces),
    },
    Export {
        format: "geopackage",
        name: "map.gpkg",
        media_type: "application/geopackage+sqlite3",
        purpose: "All collections as a GeoPackage, for GIS",
        options: &[],
        kind: ExportKind::Single(SingleExport::GeoPackage),
    },
    Export {
        format: "bundle",
        name: "bundle.zip",
        media_type: ZIP,
        purpose: "All of these with their checksums",
        options: &["zones", "warehouse", "storageType", RADIUS],
        kind: ExportKind::Bundle,
    },
    Export {
        format: "vda5050-download-map",
        name: "vda5050-download-map.json",
        media_type: JSON,
        purpose: "VDA 5050 3.0 instant action that lets a vehicle fetch the bundle",
        options: &["link", "manufacturer", "serialNumber", "zones", "warehouse", "storageType", RADIUS],
        kind: ExportKind::DownloadMap,
    },
];

/// Every export.
#[must_use]
pub const fn list() -> &'static [Export] {
    EXPORTS
}

impl Export {
    /// The export of a file name.
    #[must_use]
    pub fn find(name: &str) -> Option<&'static Self> {
        list().iter().find(|export| export.name == name)
    }

    /// The export of a format, or of a file name.
    #[must_use]
    pub fn of_format(format: &str) -> Option<&'static Self> {
        list().iter().find(|export| export.format == format).or_else(|| Self::find(format))
    }

    /// Whether it reads the graph.
    #[must_use]
    pub fn reads_graph(&self) -> bool {
        self.options.contains(&RADIUS)
    }
}
