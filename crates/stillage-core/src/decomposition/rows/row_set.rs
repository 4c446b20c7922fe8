//! The models of the rows of one direction: one that all have in common, and others for the rows that it fits badly.
//!
//! Every pitch is tried. Rows that a model of their own explains much better leave the common one, and these rows are
//! given a common model in turn: one direction may hold racks and a staging area, or rows with another pitch.
//!
//! Cost: O(pitches x cells x widths of places).

use rayon::prelude::*;

use super::evidence::RowEvidence;
use super::row_model::{self, FitSummary, RowModel, STRIDE};
use crate::decomposition::likelihood::LOAD_COST;
use crate::watch::{Stopped, Watch};

/// Description length of the choice of a later model, and of a pitch of a row's own.
const MODEL_COST: f64 = 5.0;
pub(super) const PITCH_COST: f64 = 10.0;
/// Models of a direction at most: no direction of a region holds more sorts of storage.
const MOST_MODELS: usize = 6;
/// Rows of this length together are enough to learn from, metres: some 300 places.
const ENOUGH_M: f64 = 400.0;
/// The pitch of a single row is known to this, metres.
const NEAR_M: f64 = 0.03;
/// Rows shorter than this many places do not determine their pitch.
const LEAST_PLACES: f64 = 2.2;

/// Rows of one direction.
pub(super) struct RowSet<'a> {
    pub rows: Vec<&'a RowEvidence>,
    /// The pitches that are tried, metres, ascending.
    pub pitches: Vec<f64>,
}

/// A model with the number of its pitch and what it explains of the rows that it was learnt from.
type Learnt = (usize, RowModel, FitSummary);

impl RowSet<'_> {
    /// The model that explains all rows best; `None` where they are too short.
    pub fn common_model(&self, watch: &Watch<'_>) -> Result<Option<RowModel>, Stopped> {
        let all: Vec<usize> = (0..self.rows.len()).collect();
        self.best(&self.sample(&all), watch)
    }

    /// A model for each row, `common` being that of all together; `None` for rows that show nothing.
    pub fn models(&self, common: RowModel, watch: &Watch<'_>) -> Result<Vec<Option<RowModel>>, Stopped> {
        let all: Vec<usize> = (0..self.rows.len()).collect();
        let noise = common.noise;
        let own: Vec<Option<RowModel>> =
            all.par_iter().map(|&row| self.best(&[row], watch)).collect::<Result<_, _>>()?;
        let mut models = vec![common];
        let mut group = all.clone();
        while models.len() < MOST_MODELS {
            let current = &models[models.len() - 1];
            let leaves = |&row: &usize| {
                watch.check()?;
                let score = |model: &RowModel| model.score(self.rows[row], noise);
                let is_better = own[row].as_ref().is_some_and(|own| score(own) > score(current) + LOAD_COST);
                Ok(is_better.then_some(row))
            };
            let leaving: Vec<Option<usize>> = group.par_iter().map(leaves).collect::<Result<_, _>>()?;
            let leaving: Vec<usize> = leaving.into_iter().flatten().collect();
            if leaving.len() == group.len() && models.len() > 1 {
                break;
            }
            let Some(next) = self.best(&self.sample(&leaving), watch)? else { break };
            models.push(next);
            group = leaving;
        }
        let choose = |(&row, own): (&usize, &Option<RowModel>)| {
            watch.check().map(|()| self.choose(row, own.as_ref(), &models, noise))
        };
        all.par_iter().zip(&own).map(choose).collect()
    }

    /// Rows enough to learn from, evenly spread.
    fn sample(&self, of: &[usize]) -> Vec<usize> {
        let length: f64 = of.iter().map(|&row| self.rows[row].len() as f64 * self.rows[row].cell).sum();
        of.iter().copied().step_by(((length / ENOUGH_M) as usize).max(1)).collect()
    }

    /// The model that explains some rows best: the best of every [`STRIDE`]th pitch, or of the pitches beside it.
    fn best(&self, of: &[usize], watch: &Watch<'_>) -> Result<Option<RowModel>, Stopped> {
        let count = self.pitches.len();
        let tried: Vec<usize> = (0..count).step_by(STRIDE).collect();
        let coarse: Vec<Vec<Learnt>> =
            tried.into_par_iter().map(|at| self.learnt(of, at, watch)).collect::<Result<_, _>>()?;
        let coarse: Vec<Learnt> = coarse.into_iter().flatten().collect();
        let noise = coarse.iter().map(|(_, _, summary)| summary.noise()).fold(f64::INFINITY, f64::min);
        let better = |one: Learnt, other: Learnt| if other.2.score(noise) > one.2.score(noise) { other } else { one };
        let Some(mut best) = coarse.into_iter().reduce(better) else { return Ok(None) };
        let near = [best.0.checked_sub(1), Some(best.0 + 1).filter(|&next| next < count)];
        for at in near.into_iter().flatten() {
            best = self.learnt(of, at, watch)?.into_iter().fold(best, better);
        }
        Ok(Some(best.1))
    }

    /// The models of those of some rows that are long enough for a pitch.
    fn learnt(&self, of: &[usize], at: usize, watch: &Watch<'_>) -> Result<Vec<Learnt>, Stopped> {
        let pitch = self.pitches[at];
        let is_long = |row: &&RowEvidence| row.length() >= LEAST_PLACES * pitch;
        let rows: Vec<&RowEvidence> = of.iter().map(|&row| self.rows[row]).filter(is_long).collect();
        let models = row_model::models_at(&rows, pitch, watch)?;
        Ok(models.into_iter().map(|(model, summary)| (at, model, summary)).collect())
    }

    /// The model for a row: one of those found, at its pitch or about that of the row's own model.
    fn choose(&self, row: usize, own: Option<&RowModel>, models: &[RowModel], noise: f64) -> Option<RowModel> {
        let row = self.rows[row];
        if row.content.iter().all(|&content| content <= 0.0) {
            return None;
        }
        let scored = |model: RowModel, cost: f64| (model.score(row, noise) - cost, model);
        let better = |one: (f64, RowModel), other: (f64, RowModel)| if other.0 > one.0 { other } else { one };
        let cost = |rank: usize| if rank == 0 { 0.0 } else { MODEL_COST };
        let of_group =
            models.iter().enumerate().map(|(rank, model)| scored(model.clone(), cost(rank))).reduce(better)?;
        let model = of_group.1.clone();
        let is_near = |pitch: &&f64| own.is_some_and(|own| (own.pitch - **pitch).abs() <= NEAR_M);
        let near = self.pitches.iter().filter(is_near);
        let others = near.map(|&pitch| scored(model.at(pitch, row.cell), cost(1) + PITCH_COST));
        Some(others.fold(of_group, better).1)
    }
}

#[cfg(test)]
mod tests {
    use super::super::comb::Comb;
    use super::*;
    use crate::decomposition::ground::{Axis, RegionFrame};

    /// Borders of the places that a row drawn in cells of 5 cm is cut into.
    fn check(row: &str, wanted: &expect_test::Expect) {
        let (frame, rect) = RegionFrame::of_picture(&format!("{row}\n").repeat(20), 0.05);
        let evidence = RowEvidence::of(&frame.patch(&rect, Axis::U), frame.cell, [0.7, 1.8]);
        let rows = RowSet { rows: vec![&evidence], pitches: row_model::pitches([0.8, 1.6]) };
        let watch = Watch::unwatched();
        let common = rows.common_model(&watch).expect("nobody stops it");
        let model = common.and_then(|common| rows.models(common, &watch).expect("nobody stops it").remove(0));
        let cut = model.map(|model| model.cut(&evidence));
        let places = cut.iter().flat_map(Comb::places).map(|place| format!("{}..{}", place.start, place.end));
        wanted.assert_eq(&places.collect::<Vec<_>>().join(" "));
    }

    /// Three stringers on a place of 1.1 m; the gap within a pallet is wider than that between two.
    const FULL: &str = ".#.......##.......##..";
    const EMPTY: &str = "......................";

    #[test]
    fn places_end_where_goods_end() {
        let row = [FULL, FULL, EMPTY, FULL, FULL, FULL, EMPTY, FULL].concat();
        check(&row, &expect_test::expect!["0..20 20..44 44..65 65..87 87..109 109..131 131..153 153..175"]);
    }

    #[test]
    fn floor_that_nobody_saw_is_not_cut() {
        check(&"?".repeat(100), &expect_test::expect![""]);
        check("..", &expect_test::expect![""]);
    }
}
