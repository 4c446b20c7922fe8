//! How one map lies on another.

use serde::Serialize;
use stillage_core::alignment::SiteAlignment;
use stillage_core::geometry::RigidMotion;
use utoipa::ToSchema;

use super::id::Id;
use crate::app::PairAlignment;
use crate::features::rounded;
use crate::records::AlignmentRecord;

/// How surely two maps were aligned.
#[derive(Debug, Serialize, ToSchema)]
#[schema(as = AlignmentQuality)]
#[serde(rename_all = "camelCase")]
pub struct AlignmentQualityView {
    /// Root mean square distance of the walls and racks that agree, metres.
    residual_m: f64,
    /// Share of the walls and racks on ground known to both which agree, 0 to 1. Walls count as much as all else.
    agreement: f64,
    /// Share of the walls and racks that lie on ground known to both, 0 to 1.
    overlap: f64,
    /// Whether another way fits nearly as well, so that a person should look.
    ambiguous: bool,
}

/// How a map lies on the earlier one that it was uploaded with.
#[derive(Debug, Serialize, ToSchema)]
#[schema(as = MapAlignment)]
#[serde(rename_all = "camelCase")]
pub struct MapAlignmentView {
    /// The earlier map.
    previous: Id,
    #[serde(flatten)]
    motion: MotionView,
    #[serde(flatten)]
    quality: AlignmentQualityView,
}

/// A turn about the origin of the map frame, then a shift.
#[derive(Debug, Serialize, ToSchema)]
#[schema(as = Motion)]
#[serde(rename_all = "camelCase")]
pub struct MotionView {
    /// x and y, metres, in the map frame of the earlier map.
    shift_m: [f64; 2],
    /// Counter-clockwise, degrees.
    turn_deg: f64,
}

/// How the second of two maps lies on the first.
#[derive(Debug, Serialize, ToSchema)]
#[schema(as = PairAlignment)]
#[serde(rename_all = "camelCase")]
pub struct PairAlignmentView {
    #[serde(flatten)]
    motion: MotionView,
    /// How surely; absent where the two maps are aligned by way of others of their site.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schema(value_type = AlignmentQualityView, required = false)]
    quality: Option<AlignmentQualityView>,
}

impl From<SiteAlignment> for AlignmentQualityView {
    fn from(found: SiteAlignment) -> Self {
        Self {
            residual_m: rounded(found.residual),
            agreement: rounded(found.agreement),
            overlap: rounded(found.overlap),
            ambiguous: found.ambiguous,
        }
    }
}

impl From<RigidMotion> for MotionView {
    fn from(motion: RigidMotion) -> Self {
        let shift_m = [rounded(motion.shift.x), rounded(motion.shift.y)];
        Self { shift_m, turn_deg: rounded(motion.turn.to_degrees()) }
    }
}

impl From<AlignmentRecord> for MapAlignmentView {
    fn from(record: AlignmentRecord) -> Self {
        Self { previous: Id(record.previous), motion: record.found.motion.into(), quality: record.found.into() }
    }
}

impl From<PairAlignment> for PairAlignmentView {
    fn from(alignment: PairAlignment) -> Self {
        Self { motion: alignment.motion.into(), quality: alignment.found.map(Into::into) }
    }
}
