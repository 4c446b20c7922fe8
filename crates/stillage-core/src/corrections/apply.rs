//! An analysis with a list of corrections.

use super::assemble::assemble;
use super::check::{CorrectionProblem, MOST_FACES, open_ring};
use super::correction::Correction;
use super::draft::{FaceClaim, MapDraft, Said};
use super::failure::Failure;
use super::outcome::{Corrected, Outcome};
use super::{cut, erase, paint, passage};
use crate::analysis::Analysis;
use crate::arrangement::CellFaces;
use crate::geometry::{Bounds, Point, ring_area};
use crate::grid::OccupancyGrid;
use crate::watch::{Stopped, Watch};

/// Applies corrections to an analysis, in order.
///
/// `cells` are the faces of the cells of the analysis. Corrections are points of the map frame; the frame of the
/// analysis leads from there to the grid. One that does not fit changes nothing and is told in the outcomes.
///
/// Faces that were redrawn are measured on `grid` without what the analysis took for clutter; hatched areas and painted
/// surroundings count there as they were uploaded. O(cells), once, and O(edges) for each correction.
#[must_use]
pub fn apply(grid: &OccupancyGrid, analysis: &Analysis, cells: &CellFaces, corrections: &[Correction]) -> Corrected {
    let draft = MapDraft::of(grid, analysis, Watch::unwatched());
    finished(go_on(grid, analysis, cells, draft, Vec::new(), corrections))
}

/// A corrected analysis without the faces of its cells, which are not needed to go on with it.
#[derive(Debug, Clone, Copy)]
pub struct CorrectedBefore<'a> {
    /// [`Corrected::analysis`].
    pub analysis: &'a Analysis,
    /// [`Corrected::outcomes`].
    pub outcomes: &'a [Outcome],
    /// [`Corrected::said`].
    pub said: &'a Said,
}

/// Applies more corrections at the end of a list: what [`apply`] gives for the whole list, at the cost of the new ones.
/// `analysis` and `cells` are those that were corrected before.
#[must_use]
pub fn apply_after(
    before: CorrectedBefore<'_>,
    grid: &OccupancyGrid,
    analysis: &Analysis,
    cells: &CellFaces,
    corrections: &[Correction],
) -> Corrected {
    let draft = MapDraft::after(grid, &before.analysis.subdivision, before.said.clone(), Watch::unwatched());
    let problem = |outcome: &Outcome| match outcome {
        Outcome::Applied { .. } => None,
        Outcome::Unfit(problem) => Some(problem.clone()),
    };
    let problems = before.outcomes.iter().map(problem).collect();
    finished(go_on(grid, analysis, cells, draft, problems, corrections))
}

fn finished(result: Result<Corrected, Stopped>) -> Corrected {
    result.expect("nobody stops what is unwatched")
}

impl Corrected {
    /// The same with more corrections at the end of the list, as [`apply_after`] makes it.
    #[must_use]
    pub fn and(
        &self,
        grid: &OccupancyGrid,
        analysis: &Analysis,
        cells: &CellFaces,
        corrections: &[Correction],
    ) -> Self {
        let before = CorrectedBefore { analysis: &self.analysis, outcomes: &self.outcomes, said: &self.said };
        apply_after(before, grid, analysis, cells, corrections)
    }
}

/// Draws corrections after those that have `problems`, or none, already.
fn go_on(
    grid: &OccupancyGrid,
    analysis: &Analysis,
    cells: &CellFaces,
    mut draft: MapDraft<'_>,
    mut problems: Vec<Option<CorrectionProblem>>,
    corrections: &[Correction],
) -> Result<Corrected, Stopped> {
    let to_grid = analysis.frame.motion().inverse();
    for correction in corrections {
        let fits = correction.check(MOST_FACES).map_err(Failure::from);
        let number = problems.len() as u32;
        let outcome = fits.and_then(|()| draw(&mut draft, correction.clone().moved(&to_grid), number));
        problems.push(match outcome {
            Ok(()) => None,
            Err(Failure::Unfit(problem)) => Some(problem),
            Err(Failure::Stopped) => return Err(Stopped),
        });
    }
    draft.settle()?;
    assemble(grid, analysis, cells, draft, problems)
}

/// Draws one correction, points in the grid frame.
fn draw(draft: &mut MapDraft<'_>, mut correction: Correction, number: u32) -> Result<(), Failure> {
    move_onto_map(draft, &mut correction)?;
    let places = correction.places_of_row();
    let claim = || FaceClaim { corrections: vec![number], ..FaceClaim::default() };
    match correction {
        Correction::Draw { ring, label, name } => {
            paint::draw(draft, open_ring(&ring), FaceClaim { label: Some(label), name, ..claim() })?;
        }
        Correction::Row { rectangle, layers, label, .. } => {
            paint::row(draft, &rectangle, [places, layers], FaceClaim { label, ..claim() })?;
        }
        Correction::Split { line } => cut::split(draft, &line, number)?,
        Correction::Merge { at } => cut::merge(draft, &at, number)?,
        Correction::Erase { ring } => erase::erase(draft, &counter_clockwise(open_ring(&ring)), number)?,
        Correction::Door { line, is_open } => passage::door(draft, line, is_open, number)?,
        Correction::Label { at, label } => {
            let face = draft.face_at(at, "/at")?;
            let claim = &mut draft.claims[face.index()];
            claim.label = Some(label);
            claim.touch(number);
        }
        Correction::Name { at, name } => {
            let face = draft.face_at(at, "/at")?;
            let claim = &mut draft.claims[face.index()];
            claim.name = Some(name);
            claim.touch(number);
        }
    }
    Ok(())
}

/// Moves the points of a correction that lie a little outside the map onto its border.
fn move_onto_map(draft: &MapDraft<'_>, correction: &mut Correction) -> Result<(), Failure> {
    let Bounds { low, high } = draft.bounds;
    let on_map = |point: &Point| Point::from(point.coords.sup(&low.coords).inf(&high.coords));
    let distances = correction.points().iter().map(|point| (on_map(point) - point).norm());
    if let Some((number, distance)) = distances.enumerate().find(|(_, distance)| *distance > draft.tolerance) {
        let message = format!("the point lies {distance:.2} m outside the map");
        return Err(Failure::unfit(correction.pointer(number), message));
    }
    correction.points_mut().iter_mut().for_each(|point| *point = on_map(point));
    Ok(())
}

fn counter_clockwise(ring: &[Point]) -> Vec<Point> {
    let mut ring = ring.to_vec();
    if ring_area(&ring) < 0.0 {
        ring.reverse();
    }
    ring
}
