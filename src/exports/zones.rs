//! What vehicles may do on each face, as zones and masks tell it.

use stillage_core::arrangement::FaceId;
use stillage_core::semantics::{Functionality, Label};

use super::source::ExportSource;

/// What vehicles may do on a face.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Ground {
    /// Drive along it: a corridor.
    Way,
    /// Drive slowly: ways meet there.
    Junction,
    /// Drive there only if no other way leads to the goal: people work there.
    WorkPlace,
    /// Not drive: goods stand there, or nobody knows what it is.
    Blocked,
}

impl Ground {
    /// What a label says of its faces.
    pub fn of(label: &Label) -> Self {
        match label {
            label if label.is_storage() => Self::Blocked,
            label if label.is_drivable() && label.has(Functionality::Connection) => Self::Junction,
            label if label.is_drivable() => Self::Way,
            label if label.has(Functionality::WorkPlace) => Self::WorkPlace,
            _ => Self::Blocked,
        }
    }

    /// The ground of each face; `None` for the unbounded face.
    pub fn of_faces(source: &ExportSource<'_>) -> Vec<Option<Self>> {
        let face = |face: u32| (face > 0).then(|| Self::of(source.semantic.label(FaceId(face))));
        (0..source.analysis.subdivision.face_count() as u32).map(face).collect()
    }
}
