//! The pitch that most lines of marks have in common.
//!
//! The distances between near marks of a line are votes. The pitches with most votes are tried: the best one explains most
//! marks by the fewest places. Distances of marks that are several pitches apart then make it exact.
//! Cost: O(marks x pitches tried).

use super::mark_lattice::Pitch;
use super::mark_line::MarkLine;
use super::mark_run;
use super::range::middle;
use crate::watch::{Stopped, Watch};

/// Pitches, metres: from half a pallet to a bay of three.
const PITCHES_M: [f64; 2] = [0.55, 3.3];
/// Marks so far apart vote: four legs of two pods lie between the same leg of both.
const APART: usize = 4;
/// Pitches that differ by less than this share are one.
const STEP: f64 = 0.015;
/// Pitches tried at most.
const MOST_TRIED: usize = 40;
/// So many marks are enough to learn from: those of a hall with five hundred places.
const ENOUGH_MARKS: usize = 1_500;
/// Places between two marks that make the pitch exact, in turn, and how far their distance is from a multiple of the pitch at
/// most, in pitches.
const REACHES: [(usize, f64); 3] = [(2, 0.1), (4, 0.05), (12, 0.04)];

/// The pitch; `cell` is the side of a cell, metres; `None` where no line has enough equal distances.
pub(super) fn common(all: &[MarkLine], cell: f64, watch: &Watch<'_>) -> Result<Option<Pitch>, Stopped> {
    let lines = &sample(all)[..];
    let [shortest, longest] = PITCHES_M;
    let bin = |pitch: f64| ((pitch / shortest).ln() / STEP) as usize;
    let mut votes = vec![(0.0, 0_usize); bin(longest) + 2];
    for line in lines {
        for (index, one) in line.marks.iter().enumerate() {
            for other in line.marks[index + 1..].iter().take(APART) {
                let distance = middle(*other) - middle(*one);
                if (shortest..=longest).contains(&distance) {
                    let vote = &mut votes[bin(distance)];
                    *vote = (vote.0 + distance, vote.1 + 1);
                }
            }
        }
    }
    let mut tried: Vec<(usize, f64)> =
        votes.iter().filter(|vote| vote.1 > 0).map(|&(sum, count)| (count, sum / count as f64)).collect();
    tried.sort_by(|one, other| other.0.cmp(&one.0).then(one.1.total_cmp(&other.1)));
    tried.truncate(MOST_TRIED);
    let mut best: Option<(f64, f64)> = None;
    for (_, pitch) in tried {
        watch.check()?;
        let pitch = refined(lines, pitch);
        if !(shortest..=longest).contains(&pitch) {
            continue;
        }
        let score = mark_run::score(lines, Pitch::new(pitch, cell));
        if score > best.map_or(0.0, |best| best.0) {
            best = Some((score, pitch));
        }
    }
    Ok(best.map(|best| Pitch::new(best.1, cell)))
}

/// Lines with marks enough to learn from, evenly spread.
fn sample(lines: &[MarkLine]) -> Vec<MarkLine> {
    let marks: usize = lines.iter().map(|line| line.marks.len()).sum();
    lines.iter().step_by(marks.div_ceil(ENOUGH_MARKS).max(1)).cloned().collect()
}

/// A pitch made exact by marks that are further and further apart.
fn refined(lines: &[MarkLine], mut pitch: f64) -> f64 {
    for (reach, off) in REACHES {
        let (mut distances, mut places) = (0.0, 0.0);
        for line in lines {
            for (index, one) in line.marks.iter().enumerate() {
                for other in &line.marks[index + 1..] {
                    let distance = middle(*other) - middle(*one);
                    let number = (distance / pitch).round();
                    if number > reach as f64 {
                        break;
                    }
                    if number > 0.0 && (distance - number * pitch).abs() <= off * pitch {
                        distances += distance * number;
                        places += number * number;
                    }
                }
            }
        }
        if places > 0.0 {
            pitch = distances / places;
        }
    }
    pitch
}
