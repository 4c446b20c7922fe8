//! The model of a row: the pitch of its places and the load template of the goods in them.
//!
//! A model cuts a row and scores the cut: the logarithm of a likelihood, with the energy that the template leaves
//! unexplained as noise, less the description length of the places ([`crate::decomposition::likelihood`]). A model is
//! learnt from rows by turns, as in expectation maximization
//! (A. Dempster et al. 1977, doi 10.1111/j.2517-6161.1977.tb01600.x): the template from the places, the
//! places from the template.
//!
//! Cost: O(cells x widths of places) for each row and pitch. Limits: one template for each model, so a row that mixes
//! whole loads and the legs of pallets is explained by what both have in common.

use super::comb::{self, Comb, Simd};
use super::evidence::RowEvidence;
use super::load_template::{self, LoadTemplate};
use crate::decomposition::likelihood::{self, LEAST_NOISE, PLACE_COST};
use crate::watch::{Stopped, Watch};

/// Noise before anything is explained, as a share of the energy.
const FIRST_NOISE: f64 = 0.4;
/// Turns of learning and cutting; further ones change nothing that matters.
const TURNS: usize = 2;
/// Step of the pitches that are tried, metres; every [`STRIDE`]th one is tried first.
const STEP_M: f64 = 0.025;
pub(super) const STRIDE: usize = 2;

/// The pitches that are tried within `range`, metres.
pub(super) fn pitches(range: [f64; 2]) -> Vec<f64> {
    let count = ((range[1] - range[0]) / STEP_M).round() as usize + 1;
    (0..count).map(|index| range[0] + index as f64 * STEP_M).collect()
}

/// What a row, or several, are cut with.
#[derive(Debug, Clone)]
pub(super) struct RowModel {
    /// Distance from one place to the next, metres.
    pub pitch: f64,
    template: LoadTemplate,
    /// Energy per cell that the template leaves unexplained.
    pub noise: f64,
}

/// How well a model fits a row.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Fit {
    /// Logarithm of a likelihood less the description length of the places.
    pub score: f64,
    /// The part of it that comes from borders and widths of places, before the description length.
    pub structure: f64,
}

impl RowModel {
    /// Cuts a row.
    pub fn cut(&self, row: &RowEvidence) -> Comb {
        self.cut_with_noise(row, self.noise).0
    }

    /// How well the same template fits a row at the best of some pitches.
    pub fn best_fit(&self, row: &RowEvidence, pitches: &[f64], watch: &Watch<'_>) -> Result<Fit, Stopped> {
        Ok(self.fitted(row, pitches, watch)?.fit(row))
    }

    /// How well it fits a row.
    pub fn fit(&self, row: &RowEvidence) -> Fit {
        let (_, summary) = self.cut_with_noise(row, self.noise);
        Fit { score: summary.score(self.noise), structure: summary.structure }
    }

    /// The same template at the pitch, of every [`STRIDE`]th of some, that fits a row best.
    pub fn fitted(&self, row: &RowEvidence, pitches: &[f64], watch: &Watch<'_>) -> Result<Self, Stopped> {
        let mut best: Option<(f64, Self)> = None;
        for &pitch in pitches.iter().step_by(STRIDE) {
            watch.check()?;
            let model = self.at(pitch, row.cell);
            let score = model.score(row, self.noise);
            if best.as_ref().is_none_or(|(most, _)| score > *most) {
                best = Some((score, model));
            }
        }
        Ok(best.map_or_else(|| self.clone(), |(_, model)| model))
    }

    /// Twice the middles of the places of a row that hold goods, cells, ascending.
    pub fn goods_in(&self, row: &RowEvidence) -> Vec<usize> {
        let explained = load_template::explained([&self.template], row);
        load_template::middles(&self.cut(row)).filter(|&twice| explained[twice][0] > 0.0).collect()
    }

    /// Score of a row with another noise, so that models can be compared.
    pub fn score(&self, row: &RowEvidence, noise: f64) -> f64 {
        self.cut_with_noise(row, noise).1.score(noise)
    }

    /// The same template at another pitch, metres.
    pub fn at(&self, pitch: f64, cell: f64) -> Self {
        Self { pitch, template: self.template.at(pitch, cell), noise: self.noise }
    }

    fn cut_with_noise(&self, row: &RowEvidence, noise: f64) -> (Comb, FitSummary) {
        let explained = load_template::explained([&self.template], row);
        let [comb] = cut(row, self.pitch, &explained, [noise]);
        let mut summary = FitSummary::default();
        summary.add(row, &comb, |twice| explained[twice][0], noise);
        (comb, summary)
    }
}

/// What a model explains of rows.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct FitSummary {
    explained: f64,
    energy: f64,
    cells: usize,
    places: usize,
    /// Score of the borders and widths of places.
    structure: f64,
    /// Side of a cell, metres.
    cell: f64,
}

impl FitSummary {
    /// Adds a row; `explained` is the energy that the template explains by twice the middle of a place.
    fn add(&mut self, row: &RowEvidence, comb: &Comb, explained: impl Fn(usize) -> f32, noise: f64) {
        let mut of_row = 0.0;
        for place in comb.places() {
            of_row += f64::from(explained(place.start + place.end));
            let energy = |content: &[f64]| content[place.clone()].iter().map(|value| value * value).sum::<f64>();
            self.energy += row.contents().map(energy).sum::<f64>();
            self.cells += place.len() * row.contents().count();
            self.places += row.contents().count();
        }
        self.explained += of_row;
        self.structure += comb.score - of_row * likelihood::weight(noise, row.cell);
        self.cell = row.cell;
    }

    /// Energy per cell that is left.
    pub fn noise(&self) -> f64 {
        let left = (self.energy - self.explained).max(LEAST_NOISE * self.energy);
        (left / self.cells.max(1) as f64).max(f64::MIN_POSITIVE.sqrt())
    }

    pub fn score(&self, noise: f64) -> f64 {
        self.explained * likelihood::weight(noise, self.cell) + self.structure - PLACE_COST * self.places as f64
    }
}

/// Cuts a row once for each template and its noise.
fn cut<const N: usize>(row: &RowEvidence, pitch: f64, explained: &[Simd<N>], noise: [f64; N]) -> [Comb; N] {
    let weight = noise.map(|noise| likelihood::weight(noise, row.cell) as f32);
    comb::cut(row, pitch, |start, width| {
        let explained = &explained[2 * start + width];
        std::array::from_fn(|hypothesis| explained[hypothesis] * weight[hypothesis])
    })
}

/// Places by twice their middles, cells, each with its weight.
type WeightedPlaces = Vec<(usize, f64)>;

/// Models of rows at a pitch, with what each explains of them, from several first guesses of the places of each row.
fn learn<const N: usize>(
    rows: &[&RowEvidence],
    pitch: f64,
    guesses: [Vec<WeightedPlaces>; N],
    watch: &Watch<'_>,
) -> Result<[(RowModel, FitSummary); N], Stopped> {
    let energy: f64 = rows.iter().flat_map(|row| &row.content).map(|value| value * value).sum();
    let cells: usize = rows.iter().map(|row| row.content.len()).sum();
    let mut noise = [(FIRST_NOISE * energy / cells.max(1) as f64).max(f64::MIN_POSITIVE.sqrt()); N];
    let mut places = guesses;
    let mut turn = 1;
    loop {
        let templates =
            places.map(|places| LoadTemplate::learn(rows.iter().copied().zip(places.iter().map(Vec::as_slice)), pitch));
        let mut summaries = [FitSummary::default(); N];
        places = std::array::from_fn(|_| Vec::with_capacity(rows.len()));
        for row in rows {
            watch.check()?;
            let explained = load_template::explained(templates.each_ref(), row);
            for (hypothesis, comb) in cut(row, pitch, &explained, noise).into_iter().enumerate() {
                let at = |twice: usize| explained[twice][hypothesis];
                summaries[hypothesis].add(row, &comb, at, noise[hypothesis]);
                let amplitude = |twice: usize| (twice, f64::from(at(twice).max(0.0)).sqrt());
                places[hypothesis].push(load_template::middles(&comb).map(amplitude).collect());
            }
        }
        noise = summaries.map(|summary| summary.noise());
        if turn == TURNS {
            let mut learnt = templates.into_iter().zip(noise).zip(summaries);
            return Ok(std::array::from_fn(|_| {
                let ((template, noise), summary) = learnt.next().expect("there are as many templates as guesses");
                (RowModel { pitch, template, noise }, summary)
            }));
        }
        turn += 1;
    }
}

/// Models of rows at a pitch, metres: their first places are those that even goods would have, and these moved by a
/// quarter, a half and three quarters of a place. A row of full places looks the same from all four; where goods end, at
/// posts and at uprights, only one of them fits.
pub(super) fn models_at(
    rows: &[&RowEvidence],
    pitch: f64,
    watch: &Watch<'_>,
) -> Result<Vec<(RowModel, FitSummary)>, Stopped> {
    let Some(cell) = rows.first().map(|row| row.cell) else { return Ok(Vec::new()) };
    let mut guess: Vec<Vec<usize>> = Vec::with_capacity(rows.len());
    for row in rows {
        watch.check()?;
        let [comb] = comb::cut(row, pitch, comb::even(row));
        guess.push(load_template::middles(&comb).collect());
    }
    // Middles are doubled, so half a pitch is a quarter of a place.
    let shifted = [0.0, 0.5, 1.0, 1.5].map(|halves| {
        let shift = (halves * pitch / cell).round() as usize;
        guess.iter().map(|middles| middles.iter().map(|twice| (twice + shift, 1.0)).collect()).collect()
    });
    Ok(learn(rows, pitch, shifted, watch)?.into())
}
