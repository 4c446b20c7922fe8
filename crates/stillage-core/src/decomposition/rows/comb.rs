//! The borders of the places of a row, by dynamic programming.
//!
//! A row is a sequence of places about one pitch wide, of phase slips (an upright between bays, a building column: the
//! places begin anew) and of passages through the row, which are clear. A border gains the evidence at its cell. A place
//! costs the square of its deviation from the pitch, so that borders move to evidence where there is some, and follow the
//! pitch where there is none; and it costs if its goods stand on one side, for goods are not cut in two. Phase slips and
//! passages have fixed costs, and a passage gains by its length. The best sequence is found exactly: a segmental model, in
//! the manner of a comb filter whose teeth may move.
//!
//! Several hypotheses of what places gain are cut side by side in a vector register ([`Simd`]). Only the best score is kept
//! for each cell; the piece that led to it is found again on the way back, for the few borders of the best sequence.
//!
//! Source: the accuracy study behind this project for evidence and deviations; phase slips and passages are new. Cost:
//! O(cells x widths) per row and pitch.

use std::cell::LazyCell;
use std::ops::Range;

use super::evidence::RowEvidence;

/// How much narrower and wider than the pitch a place may be, metres: drift, and an upright now and then.
pub(super) const NARROWER_M: f64 = 0.08;
pub(super) const WIDER_M: f64 = 0.16;
/// Deviation from the pitch that costs 1, metres (accuracy study).
const DEVIATION_M: f64 = 0.10;
/// Cost of a place whose goods all stand on one side, and the unevenness of the usual place, which costs nothing.
const UNEVEN_COST: f64 = 1.0;
const USUAL_UNEVENNESS: f64 = 0.25;
/// Cost of ground as wide as a place beyond the first and last border (accuracy study).
const LOOSE_END_COST: f64 = 0.15;
/// Shortest phase slip, metres, and its cost.
const SLIP_M: f64 = 0.1;
const SLIP_COST: f64 = 3.0;
/// Shortest passage, metres, and its cost; gain of a metre of it that is clear, and loss of one that is not.
const PASSAGE_M: f64 = 1.2;
const PASSAGE_COST: f64 = 6.0;
const CLEAR_GAIN: f64 = 1.6;
const CONTENT_LOSS: f64 = 12.0;

/// What lies between two borders.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum PieceKind {
    /// A place.
    Place,
    /// Something too narrow for a place, after which the places begin anew.
    PhaseSlip,
    /// A passage through the row.
    Passage,
    /// What is beyond the first or last border.
    End,
}

/// A row cut into pieces.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Comb {
    /// What the pieces are, and where each ends, cells, ascending to the end of the row.
    pub pieces: Vec<(PieceKind, usize)>,
    /// Gains of its borders less all costs.
    pub score: f64,
}

/// One number for each of the hypotheses that are evaluated side by side.
pub(super) type Simd<const N: usize> = [f32; N];

/// What a place gains by the evenness of its goods, by first cell and width.
pub(super) fn even(evidence: &RowEvidence) -> impl Fn(usize, usize) -> Simd<1> {
    |start, width| [(UNEVEN_COST * (USUAL_UNEVENNESS - evidence.unevenness(start, width))) as f32]
}

impl Comb {
    /// The places, as ranges of cells.
    pub(super) fn places(&self) -> impl Iterator<Item = Range<usize>> {
        let starts = std::iter::once(0).chain(self.pieces.iter().map(|&(_, end)| end));
        let ranges = starts.zip(&self.pieces).map(|(start, &(kind, end))| (kind, start..end));
        ranges.filter(|(kind, range)| *kind == PieceKind::Place && !range.is_empty()).map(|(_, range)| range)
    }
}

/// Cuts a row at a pitch, metres, once for each hypothesis; `place` is what a place gains by its first cell and its width,
/// cells.
pub(super) fn cut<const N: usize>(
    evidence: &RowEvidence,
    pitch: f64,
    place: impl Fn(usize, usize) -> Simd<N>,
) -> [Comb; N] {
    let cutter = CombSearch::new(evidence, pitch, place);
    let table = cutter.forward();
    std::array::from_fn(|hypothesis| cutter.backward(&table, hypothesis))
}

/// A row with the costs of its pieces; widths are cells.
struct CombSearch<'a, P> {
    border: &'a [f64],
    /// What clear ground gains from the start of the row to each cell.
    gain: Vec<f32>,
    narrowest: usize,
    widest: usize,
    /// Cost of each width of a place, from the narrowest on.
    deviations: Vec<f32>,
    slip: usize,
    passage: usize,
    /// Cost of a cell beyond the first and last border.
    loose_end: f32,
    place: P,
}

/// The best scores of a row by cell.
struct ScoreTable<const N: usize> {
    /// With a border here.
    best: Vec<Simd<N>>,
    /// With a border here or before, and a passage since then; the gain of the clear ground up to here is still to be added.
    cleared: Vec<Simd<N>>,
}

impl<'a, const N: usize, P: Fn(usize, usize) -> Simd<N>> CombSearch<'a, P> {
    fn new(evidence: &'a RowEvidence, pitch: f64, place: P) -> Self {
        let cell = evidence.cell;
        let cells = |metres: f64| (metres / cell).round() as usize;
        let narrowest = cells(pitch - NARROWER_M).max(2);
        let widest = cells(pitch + WIDER_M).max(2);
        let deviation = |width: usize| ((width as f64 * cell - pitch) / DEVIATION_M).powi(2) as f32;
        let gains = evidence.is_clear.iter().scan(0.0, |sum, &is_clear| {
            *sum += cell * if is_clear { CLEAR_GAIN } else { -CONTENT_LOSS };
            Some(*sum as f32)
        });
        Self {
            border: &evidence.border,
            gain: std::iter::once(0.0).chain(gains).collect(),
            narrowest,
            widest,
            deviations: (narrowest..=widest).map(deviation).collect(),
            slip: cells(SLIP_M).max(1),
            passage: cells(PASSAGE_M).max(1),
            loose_end: (LOOSE_END_COST * cell / pitch) as f32,
            place,
        }
    }

    fn forward(&self) -> ScoreTable<N> {
        let length = self.border.len();
        let mut table = ScoreTable { best: Vec::with_capacity(length), cleared: Vec::with_capacity(length) };
        let mut most = [f32::NEG_INFINITY; N];
        let mut slips = SlidingMaximum::new(self.narrowest.saturating_sub(self.slip));
        for at in 0..length {
            let mut best = [self.opening(at); N];
            for (_, score) in self.places_to(&table, at) {
                best = larger(best, score);
            }
            if let Some(latest) = at.checked_sub(self.slip) {
                let before = slips.push(table.best[latest]);
                best = larger(best, before.map(|score| score - SLIP_COST as f32));
            }
            best = larger(best, self.passage_to(&table, at)).map(|score| score + self.border[at] as f32);
            most = larger(most, best.map(|score| score - self.gain[at]));
            table.best.push(best);
            table.cleared.push(most);
        }
        table
    }

    /// Score of the first border at a cell.
    fn opening(&self, at: usize) -> f32 {
        let end = if at <= self.widest { -self.loose_end * at as f32 } else { f32::NEG_INFINITY };
        end.max(self.opening_passage(at))
    }

    fn opening_passage(&self, at: usize) -> f32 {
        if at >= self.passage { self.gain[at] - (PASSAGE_COST / 2.0) as f32 } else { f32::NEG_INFINITY }
    }

    /// Starts and scores of the places that end at a cell.
    fn places_to(&self, table: &ScoreTable<N>, at: usize) -> impl Iterator<Item = (usize, Simd<N>)> {
        let widths = (self.narrowest..=at).zip(&self.deviations);
        widths.map(move |(width, deviation)| {
            let (start, gained) = (at - width, (self.place)(at - width, width));
            let before = &table.best[start];
            (start, std::array::from_fn(|hypothesis| before[hypothesis] + (gained[hypothesis] - deviation)))
        })
    }

    /// Starts and scores of the phase slips that end at a cell.
    fn slips_to(&self, table: &ScoreTable<N>, at: usize) -> impl Iterator<Item = (usize, Simd<N>)> {
        let starts = (at + 1).saturating_sub(self.narrowest)..(at + 1).saturating_sub(self.slip);
        let slips = starts.clone().zip(&table.best[starts]);
        slips.map(|(start, best)| (start, best.map(|score| score - SLIP_COST as f32)))
    }

    /// Score of the best passage that ends at a cell.
    fn passage_to(&self, table: &ScoreTable<N>, at: usize) -> Simd<N> {
        match at.checked_sub(self.passage) {
            Some(start) => table.cleared[start].map(|score| score + self.gain[at] - PASSAGE_COST as f32),
            None => [f32::NEG_INFINITY; N],
        }
    }

    /// The piece that leads to a border, and the latest border that it may start at; none for what is beyond the first
    /// border.
    fn piece_to(&self, table: &ScoreTable<N>, at: usize, hypothesis: usize) -> (PieceKind, Option<usize>) {
        let is_passage = self.opening(at) <= self.opening_passage(at);
        let first = if is_passage { PieceKind::Passage } else { PieceKind::End };
        let mut best = (self.opening(at), first, None);
        let mut offer = |score: f32, kind: PieceKind, start: usize| {
            if score > best.0 {
                best = (score, kind, Some(start));
            }
        };
        self.places_to(table, at).for_each(|(start, score)| offer(score[hypothesis], PieceKind::Place, start));
        self.slips_to(table, at).for_each(|(start, score)| offer(score[hypothesis], PieceKind::PhaseSlip, start));
        offer(self.passage_to(table, at)[hypothesis], PieceKind::Passage, at.saturating_sub(self.passage));
        (best.1, best.2)
    }

    /// Where the best passage starts up to each cell: at the last of the best borders.
    fn passage_starts(&self, table: &ScoreTable<N>, hypothesis: usize) -> Vec<usize> {
        let score = |start: usize| table.best[start][hypothesis] - self.gain[start];
        let best = (0..table.best.len()).scan(0, |best, start| {
            *best = if score(start) >= score(*best) { start } else { *best };
            Some(*best)
        });
        best.collect()
    }

    fn backward(&self, table: &ScoreTable<N>, hypothesis: usize) -> Comb {
        let length = self.border.len();
        let passage_starts = LazyCell::new(|| self.passage_starts(table, hypothesis));
        let (mut last, mut score, mut kind) = (None, 0.0, PieceKind::End);
        let closing_passage = self.gain[length] - (PASSAGE_COST / 2.0) as f32;
        if length > self.passage && closing_passage > 0.0 {
            (score, kind) = (closing_passage, PieceKind::Passage);
        }
        if let Some(latest) = length.checked_sub(self.passage + 1)
            && table.cleared[latest][hypothesis] + closing_passage > score
        {
            (last, score) = (Some(passage_starts[latest]), table.cleared[latest][hypothesis] + closing_passage);
            kind = PieceKind::Passage;
        }
        for left in (0..=self.widest.min(length.saturating_sub(1))).rev() {
            let Some(at) = length.checked_sub(left + 1) else { break };
            let offered = table.best[at][hypothesis] - self.loose_end * left as f32;
            if offered > score || last.is_none() && kind == PieceKind::End {
                (last, score, kind) = (Some(at), offered, PieceKind::End);
            }
        }
        let mut pieces = vec![(kind, length)];
        while let Some(at) = last {
            let (kind, start) = self.piece_to(table, at, hypothesis);
            pieces.push((kind, at));
            last = if kind == PieceKind::Passage { start.map(|latest| passage_starts[latest]) } else { start };
        }
        pieces.reverse();
        Comb { pieces, score: f64::from(score) }
    }
}

/// The larger number of each hypothesis: a compare and a blend, where `f32::max` would also look for NaN.
fn larger<const N: usize>(one: Simd<N>, other: Simd<N>) -> Simd<N> {
    std::array::from_fn(
        |hypothesis| if other[hypothesis] > one[hypothesis] { other[hypothesis] } else { one[hypothesis] },
    )
}

/// The largest of the last values, by doubling: maxima of 1, 2, 4, ... values, the last two of which cover the window.
struct SlidingMaximum<const N: usize> {
    window: usize,
    levels: Vec<Vec<Simd<N>>>,
}

impl<const N: usize> SlidingMaximum<N> {
    /// `window` is at least one.
    fn new(window: usize) -> Self {
        Self { window, levels: vec![Vec::new(); window.max(1).ilog2() as usize + 1] }
    }

    /// Adds a value and gives the largest of the window that ends with it.
    fn push(&mut self, value: Simd<N>) -> Simd<N> {
        let (mut most, mut span) = (value, 1);
        let at = self.levels[0].len();
        let last = self.levels.len() - 1;
        for level in &mut self.levels[..last] {
            level.push(most);
            if let Some(before) = at.checked_sub(span) {
                most = larger(most, level[before]);
            }
            span *= 2;
        }
        self.levels[last].push(most);
        match (at + span).checked_sub(self.window) {
            Some(before) => larger(most, self.levels[last][before]),
            None => most,
        }
    }
}
