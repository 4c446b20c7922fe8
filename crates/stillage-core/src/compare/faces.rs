//! Faces that are different in two readings of one grid.

use crate::arrangement::{CellFaces, CellOverlap, FaceId};

/// The faces of a reading, with their labels.
#[derive(Debug, Clone, Copy)]
pub struct LabelledFaces<'a> {
    /// The face of every cell.
    pub cells: &'a CellFaces,
    /// Id of the label of every face, by its number; that of the unbounded one, number 0, says nothing.
    pub labels: &'a [&'a str],
}

/// A face with its label.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct LabelledFace {
    /// Its number.
    pub face: FaceId,
    /// Id of its label.
    pub label: String,
}

/// What is different about a face.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct FaceDifference {
    /// The face before; `None` where it is new.
    pub before: Option<LabelledFace>,
    /// The face now; `None` where it is gone.
    pub now: Option<LabelledFace>,
    /// Whether it has other cells than before. False where it is new or gone.
    pub is_reshaped: bool,
}

/// The faces that came, changed or went: those that are there now by number, then those that are gone.
///
/// A face is the same one as before where the two have more than half of the cells of each in common. Readings with one
/// and the same [`CellFaces`] are compared by number. O(cells). Limits: in another arrangement, a face smaller than a cell is
/// not seen.
#[must_use]
pub fn compare_faces(before: LabelledFaces<'_>, now: LabelledFaces<'_>) -> Vec<FaceDifference> {
    let matches = if std::ptr::eq(before.cells, now.cells) {
        Matches::by_number(now.labels.len())
    } else {
        Matches::by_cells(&now.cells.overlaps(before.cells), before.labels.len(), now.labels.len())
    };
    let labelled =
        |faces: LabelledFaces<'_>, face: FaceId| LabelledFace { face, label: faces.labels[face.index()].to_owned() };
    let here = matches.now.iter().enumerate().skip(1).filter_map(|(index, found)| {
        let face = FaceId(index as u32);
        let (was, is_reshaped) = match *found {
            FaceMatch::Unseen => return None,
            FaceMatch::None => (None, false),
            FaceMatch::Face { face, is_whole } => (Some(face), !is_whole),
        };
        let is_relabelled = was.is_none_or(|was| before.labels[was.index()] != now.labels[index]);
        let difference = FaceDifference {
            before: was.map(|was| labelled(before, was)),
            now: Some(labelled(now, face)),
            is_reshaped,
        };
        (is_reshaped || is_relabelled).then_some(difference)
    });
    let gone = matches.is_gone.iter().enumerate().skip(1).filter(|(_, is_gone)| **is_gone).map(|(index, _)| {
        FaceDifference { before: Some(labelled(before, FaceId(index as u32))), now: None, is_reshaped: false }
    });
    here.chain(gone).collect()
}

/// The face before that a face is.
#[derive(Debug, Clone, Copy)]
enum FaceMatch {
    /// It has no cells.
    Unseen,
    /// It is new.
    None,
    Face {
        face: FaceId,
        /// Whether the two have all cells in common.
        is_whole: bool,
    },
}

/// Which faces are the same.
struct Matches {
    /// By the number of the face now.
    now: Vec<FaceMatch>,
    /// By the number of the face before.
    is_gone: Vec<bool>,
}

impl Matches {
    fn by_number(faces: usize) -> Self {
        let same = |face: usize| FaceMatch::Face { face: FaceId(face as u32), is_whole: true };
        Self { now: (0..faces).map(same).collect(), is_gone: Vec::new() }
    }

    fn by_cells(overlaps: &[CellOverlap], before: usize, now: usize) -> Self {
        let (mut cells_before, mut cells_now) = (vec![0; before], vec![0; now]);
        for &CellOverlap { new, old, cells } in overlaps {
            cells_now[new.index()] += cells;
            cells_before[old.index()] += cells;
        }
        let seen = |&cells: &u64| if cells == 0 { FaceMatch::Unseen } else { FaceMatch::None };
        let mut matches = Self {
            now: cells_now.iter().map(seen).collect(),
            is_gone: cells_before.iter().map(|&cells| cells > 0).collect(),
        };
        for &CellOverlap { new, old, cells } in overlaps {
            let (of_new, of_old) = (cells_now[new.index()], cells_before[old.index()]);
            if new != FaceId::OUTER && old != FaceId::OUTER && 2 * cells > of_new && 2 * cells > of_old {
                matches.now[new.index()] = FaceMatch::Face { face: old, is_whole: cells == of_new && cells == of_old };
                matches.is_gone[old.index()] = false;
            }
        }
        matches
    }
}
