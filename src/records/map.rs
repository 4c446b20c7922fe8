//! Maps, and how they lie on one another.

use jiff::Timestamp;
use serde::{Deserialize, Serialize};
use stillage_core::AnalysisOptions;
use stillage_core::alignment::SiteAlignment;
use stillage_core::analysis::Diagnostic;
use stillage_core::geometry::RigidMotion;
use uuid::Uuid;

use crate::coordinates::{Georeference, PointPair, Survey};
use crate::ingest::MapSource;

/// A map to be analysed.
#[derive(Debug, Clone)]
pub struct NewMap {
    /// What was uploaded.
    pub source: MapSource,
    /// Name for people.
    pub name: String,
    /// Options of its first analysis.
    pub options: AnalysisOptions,
    /// Where it lies on Earth.
    pub georeference: Option<Survey>,
    /// An earlier map of the same site, on which it is aligned.
    pub previous: Option<Uuid>,
    /// The client's `Idempotency-Key`: the same key with the same content answers the same job.
    pub idempotency_key: Option<String>,
}

/// A stored map.
#[derive(Debug, Clone, PartialEq)]
pub struct MapRecord {
    /// Its id.
    pub id: Uuid,
    /// Name for people.
    pub name: String,
    /// When it was uploaded.
    pub created: Timestamp,
    /// When it last changed.
    pub updated: Timestamp,
    /// Columns of the grid.
    pub width: u32,
    /// Rows of the grid.
    pub height: u32,
    /// Side of a cell, metres.
    pub resolution: f64,
    /// Where it lies on Earth.
    pub georeference: Option<Georeference>,
    /// The pairs of points that its georeference was fitted to.
    pub point_pairs: Vec<PointPair>,
    /// Its site: the id of the site's first map, which may be deleted since.
    pub site: Uuid,
    /// How it lies on the earlier map that it was uploaded with.
    pub alignment: Option<AlignmentRecord>,
    /// The analysis that answers, when one is finished.
    pub analysis: Option<Uuid>,
    /// Remarks of the ingest.
    pub warnings: Vec<Diagnostic>,
    /// Raised with every change (the strong `ETag` of the record).
    pub version: u64,
}

impl MapRecord {
    /// From its map frame to the frame of its site.
    #[must_use]
    pub fn to_site(&self) -> RigidMotion {
        self.alignment.map_or_else(RigidMotion::identity, |alignment| alignment.to_site)
    }
}

/// How a map lies on an earlier one of its site.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "camelCase")]
pub struct AlignmentRecord {
    /// The earlier map.
    pub previous: Uuid,
    /// From this map to the earlier one.
    pub found: SiteAlignment,
    /// From this map to the frame of the site: that of its first map.
    pub to_site: RigidMotion,
}

/// Changes to a map; absent fields stay.
#[derive(Debug, Clone, Default)]
pub struct MapPatch {
    /// Its new name.
    pub name: Option<String>,
    /// `Some(None)` takes the georeference away.
    pub georeference: Option<Option<Survey>>,
}
