//! The borders of the places of a row, by dynamic programming.
//!
//! A row is read as a sequence of places about a pitch wide, slips (an upright between bays, a building column: the phase
//! starts anew) and clear gaps (a passage through the row). Each border earns what the cells say for it, each place pays
//! for its deviation from the pitch, slips and gaps pay a fee, and a gap earns by its length. The best sequence is found
//! exactly: a segmental model in the manner of a comb filter with springs. What is not seen is bridged by the pitch, what
//! is seen moves the borders. A place with its goods on one side costs, whatever its borders earn: goods are not cut in
//! two, and where goods end, a place ends.
//!
//! Several hypotheses of what places earn are cut side by side, one in each lane of a vector, and only the best score is
//! kept at each cell; which piece led there is found again on the way back, for the few borders that are taken.
//!
//! Source: the accuracy study behind this project for evidence and springs; slips and gaps are new. Cost: O(cells x
//! widths) per row and pitch.

use std::ops::Range;

use super::evidence::Evidence;

/// How much narrower and wider than the pitch a place may be, metres: drift, and an upright now and then.
pub(super) const NARROWER_M: f64 = 0.08;
pub(super) const WIDER_M: f64 = 0.16;
/// Deviation from the pitch that costs 1, metres (accuracy study).
const SPRING_M: f64 = 0.10;
/// Cost of a place whose goods all stand on one side, and the unevenness that places have anyway.
const UNEVEN_COST: f64 = 1.0;
const USUAL_UNEVENNESS: f64 = 0.25;
/// Cost of a place's width of ground beyond the first and last border (accuracy study).
const LOOSE_END: f64 = 0.15;
/// Shortest slip, metres, and its cost.
const SLIP_M: f64 = 0.1;
const SLIP_COST: f64 = 3.0;
/// Shortest gap, metres, its cost, what a clear metre earns and what one that is not clear costs.
const GAP_M: f64 = 1.2;
const GAP_COST: f64 = 6.0;
const CLEAR_GAIN: f64 = 1.6;
const CONTENT_LOSS: f64 = 12.0;

/// What lies between two borders.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Tooth {
    /// A place.
    Place,
    /// Too narrow for a place.
    Slip,
    /// A passage.
    Gap,
    /// Beyond the first or last border.
    End,
}

/// A row cut into pieces.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Comb {
    /// What the pieces are, and where each ends, cells, ascending to the end of the row.
    pub pieces: Vec<(Tooth, usize)>,
    /// What the borders earned after all costs.
    pub score: f64,
    /// Number of borders.
    pub borders: usize,
}

/// One number for each hypothesis that is cut side by side with others.
pub(super) type Lanes<const N: usize> = [f32; N];

/// What even goods earn.
pub(super) fn even(evidence: &Evidence) -> impl Fn(usize, usize) -> Lanes<1> {
    |start, width| [(UNEVEN_COST * (USUAL_UNEVENNESS - evidence.unevenness(start, width))) as f32]
}

impl Comb {
    /// The places, as ranges of cells.
    pub(super) fn places(&self) -> impl Iterator<Item = Range<usize>> {
        let starts = std::iter::once(0).chain(self.pieces.iter().map(|&(_, end)| end));
        let ranges = starts.zip(&self.pieces).map(|(start, &(tooth, end))| (tooth, start..end));
        ranges.filter(|(tooth, range)| *tooth == Tooth::Place && !range.is_empty()).map(|(_, range)| range)
    }
}

/// Cuts a row at a pitch, metres; `place` says what a place earns by its first cell and its width, cells.
pub(super) fn cut<const N: usize>(
    evidence: &Evidence,
    pitch: f64,
    place: impl Fn(usize, usize) -> Lanes<N>,
) -> [Comb; N] {
    let cutter = Cutter::new(evidence, pitch, place);
    let table = cutter.forward();
    std::array::from_fn(|lane| cutter.backward(&table, lane))
}

/// A row with the costs of its pieces, widths in cells.
struct Cutter<'a, P> {
    border: &'a [f64],
    /// What clear ground earns from the start of the row to each cell.
    gain: Vec<f32>,
    narrowest: usize,
    widest: usize,
    /// What the widths of a place cost, from the narrowest.
    stretches: Vec<f32>,
    slip: usize,
    gap: usize,
    /// What a cell beyond the first and last border costs.
    loose_end: f32,
    place: P,
}

/// The best scores of a row by cell.
struct Table<const N: usize> {
    /// With a border here.
    best: Vec<Lanes<N>>,
    /// With a border here or before and clear ground, whose gain is to be added, since then.
    cleared: Vec<Lanes<N>>,
}

impl<'a, const N: usize, P: Fn(usize, usize) -> Lanes<N>> Cutter<'a, P> {
    fn new(evidence: &'a Evidence, pitch: f64, place: P) -> Self {
        let cell = evidence.cell;
        let cells = |metres: f64| (metres / cell).round() as usize;
        let narrowest = cells(pitch - NARROWER_M).max(2);
        let widest = cells(pitch + WIDER_M).max(2);
        let stretch = |width: usize| ((width as f64 * cell - pitch) / SPRING_M).powi(2) as f32;
        let gains = evidence.is_clear.iter().scan(0.0, |sum, &is_clear| {
            *sum += cell * if is_clear { CLEAR_GAIN } else { -CONTENT_LOSS };
            Some(*sum as f32)
        });
        Self {
            border: &evidence.border,
            gain: std::iter::once(0.0).chain(gains).collect(),
            narrowest,
            widest,
            stretches: (narrowest..=widest).map(stretch).collect(),
            slip: cells(SLIP_M).max(1),
            gap: cells(GAP_M).max(1),
            loose_end: (LOOSE_END * cell / pitch) as f32,
            place,
        }
    }

    fn forward(&self) -> Table<N> {
        let length = self.border.len();
        let mut table = Table { best: Vec::with_capacity(length), cleared: Vec::with_capacity(length) };
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
            best = larger(best, self.gap_to(&table, at)).map(|score| score + self.border[at] as f32);
            most = larger(most, best.map(|score| score - self.gain[at]));
            table.best.push(best);
            table.cleared.push(most);
        }
        table
    }

    /// Score of the first border at a cell.
    fn opening(&self, at: usize) -> f32 {
        let end = if at <= self.widest { -self.loose_end * at as f32 } else { f32::NEG_INFINITY };
        end.max(self.opening_gap(at))
    }

    fn opening_gap(&self, at: usize) -> f32 {
        if at >= self.gap { self.gain[at] - (GAP_COST / 2.0) as f32 } else { f32::NEG_INFINITY }
    }

    /// Starts and scores of the places that end at a cell.
    fn places_to(&self, table: &Table<N>, at: usize) -> impl Iterator<Item = (usize, Lanes<N>)> {
        let widths = (self.narrowest..=at).zip(&self.stretches);
        widths.map(move |(width, stretch)| {
            let (start, earned) = (at - width, (self.place)(at - width, width));
            let before = &table.best[start];
            (start, std::array::from_fn(|lane| before[lane] + (earned[lane] - stretch)))
        })
    }

    /// Starts and scores of the slips that end at a cell.
    fn slips_to(&self, table: &Table<N>, at: usize) -> impl Iterator<Item = (usize, Lanes<N>)> {
        let starts = (at + 1).saturating_sub(self.narrowest)..(at + 1).saturating_sub(self.slip);
        let slips = starts.clone().zip(&table.best[starts]);
        slips.map(|(start, best)| (start, best.map(|score| score - SLIP_COST as f32)))
    }

    /// Score of the best gap that ends at a cell.
    fn gap_to(&self, table: &Table<N>, at: usize) -> Lanes<N> {
        match at.checked_sub(self.gap) {
            Some(start) => table.cleared[start].map(|score| score + self.gain[at] - GAP_COST as f32),
            None => [f32::NEG_INFINITY; N],
        }
    }

    /// The piece that leads to a border, and where it starts; nowhere for what is beyond the first border.
    fn piece_to(&self, table: &Table<N>, at: usize, lane: usize) -> (Tooth, Option<usize>) {
        let is_gap = self.opening(at) <= self.opening_gap(at);
        let first = if is_gap { Tooth::Gap } else { Tooth::End };
        let mut best = (self.opening(at), first, None);
        let mut offer = |score: f32, tooth: Tooth, start: usize| {
            if score > best.0 {
                best = (score, tooth, Some(start));
            }
        };
        self.places_to(table, at).for_each(|(start, score)| offer(score[lane], Tooth::Place, start));
        self.slips_to(table, at).for_each(|(start, score)| offer(score[lane], Tooth::Slip, start));
        offer(self.gap_to(table, at)[lane], Tooth::Gap, at.saturating_sub(self.gap));
        let (_, tooth, start) = best;
        let start = start.map(|latest| if tooth == Tooth::Gap { self.gap_start(table, latest, lane) } else { latest });
        (tooth, start)
    }

    /// Where the best gap starts, up to a cell.
    fn gap_start(&self, table: &Table<N>, latest: usize, lane: usize) -> usize {
        let score = |start: usize| table.best[start][lane] - self.gain[start];
        (0..=latest).rev().reduce(|best, start| if score(start) > score(best) { start } else { best }).unwrap_or(latest)
    }

    fn backward(&self, table: &Table<N>, lane: usize) -> Comb {
        let length = self.border.len();
        let (mut last, mut score, mut tooth) = (None, 0.0, Tooth::End);
        let closing_gap = self.gain[length] - (GAP_COST / 2.0) as f32;
        if length > self.gap && closing_gap > 0.0 {
            (score, tooth) = (closing_gap, Tooth::Gap);
        }
        if let Some(latest) = length.checked_sub(self.gap + 1)
            && table.cleared[latest][lane] + closing_gap > score
        {
            (last, score) = (Some(self.gap_start(table, latest, lane)), table.cleared[latest][lane] + closing_gap);
            tooth = Tooth::Gap;
        }
        for left in (0..=self.widest.min(length.saturating_sub(1))).rev() {
            let Some(at) = length.checked_sub(left + 1) else { break };
            let offered = table.best[at][lane] - self.loose_end * left as f32;
            if offered > score || last.is_none() && tooth == Tooth::End {
                (last, score, tooth) = (Some(at), offered, Tooth::End);
            }
        }
        let mut pieces = vec![(tooth, length)];
        while let Some(at) = last {
            let (tooth, start) = self.piece_to(table, at, lane);
            pieces.push((tooth, at));
            last = start;
        }
        pieces.reverse();
        Comb { borders: pieces.len() - 1, pieces, score: f64::from(score) }
    }
}

/// The larger number of each lane; a compare and a blend, where `f32::max` would look for numbers that are none.
fn larger<const N: usize>(one: Lanes<N>, other: Lanes<N>) -> Lanes<N> {
    std::array::from_fn(|lane| if other[lane] > one[lane] { other[lane] } else { one[lane] })
}

/// The largest of the last values, by doubling: maxima of 1, 2, 4, ... values, the last two of which cover the window.
struct SlidingMaximum<const N: usize> {
    window: usize,
    levels: Vec<Vec<Lanes<N>>>,
}

impl<const N: usize> SlidingMaximum<N> {
    /// `window` is at least one.
    fn new(window: usize) -> Self {
        Self { window, levels: vec![Vec::new(); window.max(1).ilog2() as usize + 1] }
    }

    /// Adds a value and gives the largest of the window that ends with it.
    fn push(&mut self, value: Lanes<N>) -> Lanes<N> {
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
