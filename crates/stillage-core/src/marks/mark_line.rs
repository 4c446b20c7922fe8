//! Equal marks in one line.

use super::mark::Mark;
use super::range::{length, median, middle};

/// Both sides of equal marks differ by at most this: metres, and a share of their depth.
const TOLERANCE_M: f64 = 0.12;
const TOLERANCE_SHARE: f64 = 0.3;
/// Marks are shorter than most of their line by at most this: metres, and a share of the length.
const LENGTH_M: f64 = 0.15;
const LENGTH_SHARE: f64 = 0.35;
/// Least number of marks of a line.
const LEAST_MARKS: usize = 2;

/// Equal marks that lie at the same place across a direction, metres.
#[derive(Debug, Clone)]
pub(super) struct MarkLine {
    pub across: [f64; 2],
    /// Where each mark lies along the direction, ascending; none is shorter than most.
    pub marks: Vec<[f64; 2]>,
    /// Number of things in each mark.
    pub things: Vec<usize>,
    /// Length of most of them.
    pub usual: f64,
}

impl MarkLine {
    /// The lines of some marks along one side of their frame.
    pub fn all(marks: &[Mark], axis: usize) -> Vec<Self> {
        let across = |mark: &Mark| mark.sides[1 - axis];
        let mut order: Vec<Mark> = marks.to_vec();
        order.sort_by(|one, other| {
            middle(across(one))
                .total_cmp(&middle(across(other)))
                .then(one.sides[axis][0].total_cmp(&other.sides[axis][0]))
        });
        let tolerance = |first: [f64; 2]| TOLERANCE_M.max(TOLERANCE_SHARE * length(first));
        let mut lines: Vec<Vec<Mark>> = Vec::new();
        let mut open: Vec<usize> = Vec::new();
        for mark in order {
            let range = across(&mark);
            let first = |line: usize| across(&lines[line][0]);
            open.retain(|&line| middle(range) <= middle(first(line)) + tolerance(first(line)));
            let is_equal = |&&line: &&usize| {
                let (first, most) = (first(line), tolerance(first(line)));
                (first[0] - range[0]).abs() <= most && (first[1] - range[1]).abs() <= most
            };
            if let Some(&line) = open.iter().find(is_equal) {
                lines[line].push(mark);
            } else {
                open.push(lines.len());
                lines.push(vec![mark]);
            }
        }
        lines.iter().filter_map(|marks| Self::of(marks, axis)).collect()
    }

    /// The marks of a line that are as long as most, or longer.
    fn of(marks: &[Mark], axis: usize) -> Option<Self> {
        let usual = median(marks.iter().map(|mark| length(mark.sides[axis])))?;
        let most = LENGTH_M.max(LENGTH_SHARE * usual);
        let mut equal: Vec<&Mark> = marks.iter().filter(|mark| length(mark.sides[axis]) >= usual - most).collect();
        equal.sort_by(|one, other| one.sides[axis][0].total_cmp(&other.sides[axis][0]));
        let [low, high] = [0, 1].map(|side| median(marks.iter().map(|mark| mark.sides[1 - axis][side])));
        (equal.len() >= LEAST_MARKS).then_some(Self {
            across: [low?, high?],
            marks: equal.iter().map(|mark| mark.sides[axis]).collect(),
            things: equal.iter().map(|mark| mark.things).collect(),
            usual,
        })
    }
}
