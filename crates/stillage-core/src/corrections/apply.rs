//! An analysis with a list of corrections.

use std::collections::BTreeMap;

use super::check::{CorrectionProblem, MOST_FACES};
use super::correction::Correction;
use super::outcome::{Corrected, Outcome};
use crate::analysis::Analysis;
use crate::arrangement::{CellFaces, FaceId};
use crate::geometry::Point;
use crate::grid::OccupancyGrid;

/// Applies corrections to an analysis, in order.
///
/// `cells` are the faces of the cells of the analysis. Corrections are points of the map frame; the frame of the
/// analysis leads from there to the grid. One that does not fit changes nothing and is told in the outcomes.
#[must_use]
pub fn apply(grid: &OccupancyGrid, analysis: &Analysis, cells: &CellFaces, corrections: &[Correction]) -> Corrected {
    let mut corrected = Corrected {
        analysis: analysis.clone(),
        faces: cells.clone(),
        labels: BTreeMap::new(),
        names: BTreeMap::new(),
        outcomes: Vec::new(),
    };
    let back = analysis.frame.motion().inverse();
    for correction in corrections {
        let outcome = correction.check(MOST_FACES).and_then(|()| {
            let correction = correction.clone().moved(&back);
            match &correction {
                Correction::Label { at, label } => {
                    let face = face_at(grid, cells, *at)?;
                    corrected.labels.insert(face, label.clone());
                    Ok(vec![face])
                }
                _ => Err(CorrectionProblem::new("", "this kind of correction is not applied yet")),
            }
        });
        corrected.outcomes.push(match outcome {
            Ok(faces) => Outcome::Applied { faces },
            Err(problem) => Outcome::Unfit(problem),
        });
    }
    corrected
}

fn face_at(grid: &OccupancyGrid, cells: &CellFaces, at: Point) -> Result<FaceId, CorrectionProblem> {
    let Some((column, row)) = grid.cell_at(at) else {
        return Err(CorrectionProblem::new("/at", "the point lies outside the map"));
    };
    match cells.at(column, row) {
        FaceId::OUTER => Err(CorrectionProblem::new("/at", "no face lies at this point")),
        face => Ok(face),
    }
}
