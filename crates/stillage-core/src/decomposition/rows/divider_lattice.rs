//! The lattice of the borders of a row: a pitch and a phase that explain where its dividers stand.
//!
//! Every pair of near dividers proposes a lattice; the one with the best score is kept. A border with a divider gains, a
//! border without one costs, and so does a divider off the lattice. Cost: O(dividers^2) for each row.

/// Pitches that dividers may have, metres: narrower are the stringers of pallets.
const PITCHES_M: [f64; 2] = [0.7, 3.2];
/// Tolerance of a place on the lattice: a share of the pitch, and metres for the cells at both ends.
const TOLERANCE_SHARE: f64 = 0.06;
const TOLERANCE_M: f64 = 0.05;
/// What a border of the lattice without a divider costs, and a divider off the lattice; a divider on it gains 1.
const MISSING_COST: f64 = 0.35;
const STRAY_COST: f64 = 0.7;
/// Least share of the borders that show dividers, and of the dividers that are borders.
const SEEN_SHARE: f64 = 0.6;
const EXPLAINED_SHARE: f64 = 0.75;
/// Least number of places that show a pitch of their own, and that show a phase.
const LEAST_PLACES: usize = 3;
const LEAST_PLACES_OF_PITCH: usize = 2;
/// Most dividers that a pair which tells the pitch is apart.
const APART: usize = 3;

/// Borders at regular distances along a row, cells.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct DividerLattice {
    /// The first border that shows a divider.
    pub first: f64,
    pub pitch: f64,
    /// Number of places up to the last border that shows one.
    pub count: usize,
    score: f64,
}

impl DividerLattice {
    /// The lattice that explains the dividers of a row best.
    pub fn of(marks: &[f64], cell: f64) -> Option<Self> {
        let mut best: Option<Self> = None;
        for (index, &mark) in marks.iter().enumerate() {
            for (&next, apart) in marks[index + 1..].iter().zip(0..APART) {
                for places in 1..=apart + 1 {
                    let pitch = (next - mark) / places as f64;
                    if !(PITCHES_M[0]..=PITCHES_M[1]).contains(&(pitch * cell)) {
                        continue;
                    }
                    let found = Self::through(marks, mark, pitch, cell, LEAST_PLACES);
                    best = better(best, found);
                }
            }
        }
        best
    }

    /// The same at a pitch, cells.
    pub fn at(marks: &[f64], pitch: f64, cell: f64) -> Option<Self> {
        let found = marks.iter().map(|&mark| Self::through(marks, mark, pitch, cell, LEAST_PLACES_OF_PITCH));
        found.fold(None, better)
    }

    /// The lattice through a mark, moved and stretched to fit the marks on it.
    fn through(marks: &[f64], mark: f64, pitch: f64, cell: f64, least: usize) -> Option<Self> {
        let tolerance = TOLERANCE_SHARE * pitch + TOLERANCE_M / cell;
        // Number of the border nearest to each mark that lies on the lattice.
        let on = |first: f64, pitch: f64| -> Vec<(f64, f64)> {
            let number = |&place: &f64| (((place - first) / pitch).round(), place);
            let is_near = |&(number, place): &(f64, f64)| (place - first - number * pitch).abs() <= tolerance;
            marks.iter().map(number).filter(is_near).collect()
        };
        let (first, pitch) = fitted(&on(mark, pitch), mark, pitch);
        let met = on(first, pitch);
        let mut numbers: Vec<i64> = met.iter().map(|&(number, _)| number as i64).collect();
        numbers.dedup();
        let (low, high) = (*numbers.first()?, *numbers.last()?);
        let (seen, borders) = (numbers.len() as f64, (high - low + 1) as f64);
        let is_regular = numbers.len() > least
            && seen >= SEEN_SHARE * borders
            && met.len() as f64 >= EXPLAINED_SHARE * marks.len() as f64;
        let score = seen - MISSING_COST * (borders - seen) - STRAY_COST * (marks.len() - met.len()) as f64;
        is_regular.then(|| Self { first: first + low as f64 * pitch, pitch, count: (high - low) as usize, score })
    }

    /// The borders of a row of some length that begins and ends like its neighbours, cells.
    pub fn borders(&self, [low, high]: [f64; 2], length: usize, cell: f64) -> Vec<usize> {
        let tolerance = TOLERANCE_SHARE * self.pitch + TOLERANCE_M / cell;
        let before = ((self.first - low + tolerance) / self.pitch).floor().max(0.0) as i64;
        let after = ((high + tolerance - self.first) / self.pitch).floor().max(self.count as f64) as i64;
        let border = |number: i64| (self.first + number as f64 * self.pitch).round().clamp(0.0, length as f64) as usize;
        let mut borders: Vec<usize> = (-before..=after).map(border).collect();
        borders.dedup();
        borders
    }
}

fn better(one: Option<DividerLattice>, other: Option<DividerLattice>) -> Option<DividerLattice> {
    match (one, other) {
        (Some(one), Some(other)) => Some(if other.score > one.score { other } else { one }),
        (one, other) => one.or(other),
    }
}

/// First border and pitch by least squares from numbered borders; those given where a single one is known.
fn fitted(numbered: &[(f64, f64)], first: f64, pitch: f64) -> (f64, f64) {
    let count = numbered.len() as f64;
    let [numbers, places] =
        [0, 1].map(|part| numbered.iter().map(|pair| if part == 0 { pair.0 } else { pair.1 }).sum::<f64>() / count);
    let square: f64 = numbered.iter().map(|(number, _)| (number - numbers).powi(2)).sum();
    if square <= 0.0 {
        return (first, pitch);
    }
    let product: f64 = numbered.iter().map(|(number, place)| (number - numbers) * (place - places)).sum();
    let pitch = product / square;
    (places - numbers * pitch, pitch)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Cells of 0.05 m.
    const CELL: f64 = 0.05;

    fn borders(marks: &[f64], ends: [f64; 2]) -> Option<Vec<usize>> {
        DividerLattice::of(marks, CELL).map(|lattice| lattice.borders(ends, 400, CELL))
    }

    #[test]
    fn places_without_dividers_are_places_too() {
        // The divider at 84 is missing, a column stands at 99, and the neighbours begin a place sooner.
        let marks = [40.0, 62.0, 99.0, 106.0, 128.0, 150.0];
        assert_eq!(borders(&marks, [18.0, 150.0]), Some(vec![18, 40, 62, 84, 106, 128, 150]));
    }

    #[test]
    fn dividers_at_any_distance_have_no_lattice() {
        assert_eq!(borders(&[10.0, 33.0, 71.0, 88.0, 131.0, 147.0, 190.0], [10.0, 190.0]), None);
        assert_eq!(borders(&[10.0, 32.0], [10.0, 32.0]), None);
        // The stringers of pallets are nearer to one another than any borders.
        assert_eq!(borders(&[10.0, 18.0, 26.0, 34.0, 42.0, 50.0], [10.0, 50.0]), None);
    }
}
