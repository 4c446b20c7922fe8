//! The rows of one direction of a region: found, judged periodic or not, and cut into places.

use super::body_rows::BodyRows;
use super::dividers::{self, DividedRow};
use super::evidence::RowEvidence;
use super::periodicity::{Periodicity, Threshold};
use super::pieces;
use super::rack_row::RackRow;
use super::reading::Reading;
use super::row_model::{self, Fit, RowModel};
use super::row_set::RowSet;
use super::size_hints::SizeHints;
use super::storage_lanes;
use crate::decomposition::bodies::{Body, layers};
use crate::decomposition::ground::{Axis, Rect, RectIndex, RegionFrame};
use crate::decomposition::parcel::Parcel;
use crate::plot::PlotKind;
use crate::watch::{Stopped, Watch};

/// Cells above this are too coarse for the gaps and posts between places, metres.
const COARSEST_CELL_M: f64 = 0.1;

/// The rows of one direction.
pub(super) struct DirectionRows<'a> {
    frame: &'a RegionFrame,
    hints: &'a SizeHints,
    watch: &'a Watch<'a>,
    axis: Axis,
    bodies: Vec<&'a Body>,
    rows: Vec<RackRow>,
    /// The evidence of each row.
    evidence: Vec<RowEvidence>,
    /// The rows that show dividers between their places; `rows` are the others.
    divided: Vec<DividedRow>,
    /// What is left beside the rows.
    others: Vec<Parcel>,
    /// Rectangles of the rows that reach into the aisles before their body.
    reaching: Vec<Rect>,
    /// The model that all rows have in common; `None` where they are too short or their cells too coarse.
    model: Option<RowModel>,
    periodicity: Periodicity,
}

impl<'a> DirectionRows<'a> {
    /// The rows of those of some bodies that have this direction; their places are about `depth` deep, metres.
    pub fn of(
        frame: &'a RegionFrame,
        bodies: &'a [Body],
        axis: Axis,
        depth: f64,
        hints: &'a SizeHints,
        reading: Reading,
        watch: &'a Watch<'a>,
    ) -> Result<Self, Stopped> {
        let bodies: Vec<&Body> = bodies.iter().filter(|body| body.axis == axis).collect();
        let layers = layers::cut(frame, &bodies, depth, hints.depth, watch)?;
        let BodyRows { rows, others, reaching } = BodyRows::of(frame, &bodies, layers, watch)?;
        let (rows, evidence) = with_shared_lanes(frame, rows, hints, watch)?;
        let (divided, rows, evidence) = dividers::parted(frame, rows, evidence, reading);
        let (model, periodicity) = (None, Periodicity::default());
        let mut found =
            Self { frame, hints, watch, axis, bodies, rows, evidence, divided, others, reaching, model, periodicity };
        if reading == Reading::Dividers {
            return Ok(found);
        }
        found.model = found.row_set().common_model(watch)?;
        if let Some(model) = &found.model {
            let pitches = row_model::pitches(hints.pitch);
            let fit = |row: &RowEvidence| model.best_fit(row, &pitches, watch);
            found.periodicity = found.judged(fit, Threshold::COMMON_MODEL)?;
        }
        Ok(found)
    }

    /// Whether its rows are periodic, with the model that all have in common or each with its own.
    pub fn is_periodic(&self) -> bool {
        self.has_repeating_goods() || !self.divided.is_empty()
    }

    /// Whether the goods in its rows repeat.
    pub fn has_repeating_goods(&self) -> bool {
        self.periodicity.is_certain()
    }

    /// Whether its rows are more clearly periodic than any furniture, so that the building is a storage.
    pub fn is_storage(&self) -> bool {
        self.periodicity.is_sure()
    }

    /// Judges the rows again, each with a model of its own: one direction may hold several sorts of storage.
    pub fn judge_each_alone(&mut self) -> Result<(), Stopped> {
        if self.model.is_none() {
            return Ok(());
        }
        let pitches = row_model::pitches(self.hints.pitch);
        let fit = |row: &RowEvidence| {
            let own = RowSet { rows: vec![row], pitches: pitches.clone() }.common_model(self.watch)?;
            Ok(own.map_or(Fit::default(), |own| own.fit(row)))
        };
        let periodicity = self.judged(fit, Threshold::OWN_MODELS)?;
        if periodicity.is_certain() {
            self.periodicity = periodicity;
        }
        Ok(())
    }

    fn judged(
        &self,
        fit: impl Fn(&RowEvidence) -> Result<Fit, Stopped> + Sync,
        threshold: Threshold,
    ) -> Result<Periodicity, Stopped> {
        let widths = self.hints.widths();
        Periodicity::of(self.frame, (&self.rows, &self.evidence), widths, fit, threshold, self.watch)
    }

    /// The rows as evidence; none of them where cells are too coarse.
    fn row_set(&self) -> RowSet<'_> {
        let evidence = if self.frame.cell > COARSEST_CELL_M { &[] } else { &self.evidence[..] };
        RowSet { rows: evidence.iter().collect(), pitches: row_model::pitches(self.hints.pitch) }
    }

    /// Adds the pieces of the rows, or the whole bodies where these are walls and furniture. In a storage, rows need less
    /// evidence to be cut into places.
    pub fn lay_out(self, parcels: Vec<Parcel>, is_storage: bool) -> Result<Vec<Parcel>, Stopped> {
        let is_cut = self.periodicity.is_certain() || is_storage && self.periodicity.is_likely();
        let common = self.model.as_ref().filter(|_| is_cut);
        if common.is_none() && self.divided.is_empty() {
            let whole = |body: &&Body| Parcel::new(body.rect.clone(), PlotKind::Other, Some(self.axis));
            return Ok(parcels.into_iter().chain(self.bodies.iter().map(whole)).collect());
        }
        let models = match common {
            Some(common) => self.row_set().models(common.clone(), self.watch)?,
            None => vec![None; self.rows.len()],
        };
        let mut parcels = without(parcels, self.reaching, self.axis, self.watch)?;
        parcels.extend(self.others);
        for DividedRow { row, borders } in &self.divided {
            let length = row.rect.range(row.axis).len();
            parcels.extend(pieces::parcels(row, pieces::of_borders(borders, length, self.frame)));
        }
        for ((row, evidence), model) in self.rows.iter().zip(&self.evidence).zip(models) {
            self.watch.check()?;
            match model {
                _ if evidence.is_even => {
                    parcels.extend(pieces::parcels(row, pieces::of_one_place(evidence.filled(), evidence.len())));
                }
                Some(model) => {
                    let pieces = pieces::of_comb(&model.cut(evidence), model.pitch, self.frame);
                    parcels.extend(pieces::parcels(row, pieces));
                }
                None => parcels.push(Parcel::new(row.rect.clone(), PlotKind::Other, Some(row.axis))),
            }
        }
        Ok(parcels)
    }
}

/// Rows with their evidence: layers of a group that share their storage lanes are one row.
fn with_shared_lanes(
    frame: &RegionFrame,
    groups: Vec<RackRow>,
    hints: &SizeHints,
    watch: &Watch<'_>,
) -> Result<(Vec<RackRow>, Vec<RowEvidence>), Stopped> {
    let evidence: Vec<Vec<RowEvidence>> =
        groups.iter().map(|group| group.evidence(frame, hints, watch)).collect::<Result<_, _>>()?;
    let shared = storage_lanes::shared(&evidence, &row_model::pitches(hints.pitch), watch)?;
    let (mut rows, mut of_rows) = (Vec::new(), Vec::new());
    for ((group, evidence), counts) in groups.into_iter().zip(evidence).zip(shared) {
        let mut layers = evidence.into_iter();
        of_rows.extend(counts.iter().map(|&count| RowEvidence::bundle(layers.by_ref().take(count))));
        rows.extend(group.parted(&counts));
    }
    Ok((rows, of_rows))
}

/// Parcels without the ground of rows along `axis`: deep rows may reach into the aisles before them.
///
/// Cost: O(parcels + rows + pairs of both that overlap).
fn without(parcels: Vec<Parcel>, rows: Vec<Rect>, axis: Axis, watch: &Watch<'_>) -> Result<Vec<Parcel>, Stopped> {
    let index = RectIndex::of(rows, watch)?;
    let mut left = Vec::with_capacity(parcels.len());
    for parcel in parcels {
        watch.check()?;
        let mut rects = vec![parcel.rect.clone()];
        for row in index.overlapping(&parcel.rect) {
            let row = &index.rects()[row];
            rects = rects.iter().flat_map(|rect| rect.without(row, axis)).collect();
        }
        left.extend(rects.into_iter().map(|rect| Parcel { rect, ..parcel.clone() }));
    }
    Ok(left)
}
