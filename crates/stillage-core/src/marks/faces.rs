//! Runs of thin marks as the front and the back of one row: uprights, legs, dashes.
//!
//! Between two such runs lies a row or an aisle. Rows of one site are equally deep, every run belongs to a row, and rows
//! stand one behind the other, two at most. The depth that leaves fewest runs without a row is taken.
//! Cost: O(depths tried x runs).

use super::mark_run::MarkRun;
use super::range::{length, middle};

/// Depths of rows, metres.
const DEPTHS_M: [f64; 2] = [0.5, 1.9];
/// Rows of one site differ in depth by at most this, metres: two posts of two rows back to back are one mark.
const EQUAL_M: f64 = 0.15;
/// Depths that differ by less are one, metres.
const SAME_M: f64 = 0.01;
/// Least share of the shorter run that lies beside the longer one.
const BESIDE_SHARE: f64 = 0.5;
/// Two neighbouring runs are further apart than this only with something else between them, metres.
const FARTHEST_M: f64 = 8.0;
/// What a row costs, in runs that belong to one.
const ROW_COST: f64 = 0.5;

/// The runs of one row, and its place across the direction.
pub(super) struct FacedRow {
    pub across: [f64; 2],
    pub runs: Vec<MarkRun>,
}

/// Pairs runs; those without a partner are left out.
pub(super) fn paired(mut runs: Vec<MarkRun>) -> Vec<FacedRow> {
    runs.sort_by(|one, other| {
        one.across[0].total_cmp(&other.across[0]).then(one.marks[0][0].total_cmp(&other.marks[0][0]))
    });
    let stacks = stacks(&runs);
    let depth = |stack: &[usize], gap: usize| runs[stack[gap + 1]].across[1] - runs[stack[gap]].across[0];
    let mut tried: Vec<f64> =
        stacks.iter().flat_map(|stack| (1..stack.len()).map(|gap| depth(stack, gap - 1))).collect();
    tried.sort_by(f64::total_cmp);
    tried.dedup_by(|one, other| (*one - *other).abs() < SAME_M);
    let mut best: (f64, Vec<[usize; 2]>) = (0.0, Vec::new());
    for usual in tried {
        if !(DEPTHS_M[0]..=DEPTHS_M[1]).contains(&usual) {
            continue;
        }
        let (mut score, mut pairs) = (0.0, Vec::new());
        for stack in &stacks {
            let is_row: Vec<bool> =
                (1..stack.len()).map(|gap| (depth(stack, gap - 1) - usual).abs() <= EQUAL_M).collect();
            let (found, gaps) = rows_of(&is_row);
            score += found;
            pairs.extend(gaps.into_iter().map(|gap| [stack[gap], stack[gap + 1]]));
        }
        if score > best.0 {
            best = (score, pairs);
        }
    }
    let is_shared = |run: usize, side: usize| best.1.iter().any(|pair| pair[1 - side] == run);
    let faced = |&[low, high]: &[usize; 2]| {
        let start = if is_shared(low, 0) { middle(runs[low].across) } else { runs[low].across[0] };
        let end = if is_shared(high, 1) { middle(runs[high].across) } else { runs[high].across[1] };
        FacedRow { across: [start, end], runs: vec![runs[low].clone(), runs[high].clone()] }
    };
    best.1.iter().map(faced).collect()
}

/// Runs side by side, each the nearest neighbour of the next.
fn stacks(runs: &[MarkRun]) -> Vec<Vec<usize>> {
    let along = |run: &MarkRun| [run.marks[0][0], run.marks[run.marks.len() - 1][1]];
    let is_beside = |one: &MarkRun, other: &MarkRun| {
        let (one, other) = (along(one), along(other));
        one[1].min(other[1]) - one[0].max(other[0]) >= BESIDE_SHARE * length(one).min(length(other))
    };
    let mut next = vec![None; runs.len()];
    let mut before = vec![None; runs.len()];
    for (index, run) in runs.iter().enumerate() {
        let near = (index + 1..runs.len()).take_while(|&other| runs[other].across[0] <= run.across[1] + FARTHEST_M);
        let mut beside = near.filter(|&other| runs[other].across[0] >= run.across[1] && is_beside(run, &runs[other]));
        if let Some(other) = beside.next() {
            next[index] = Some(other);
            // The nearest one below comes last.
            before[other] = Some(index);
        }
    }
    let is_next = |index: usize| next[index].filter(|&other| before[other] == Some(index));
    let firsts = (0..runs.len()).filter(|&index| before[index].is_none_or(|below| is_next(below) != Some(index)));
    firsts.map(|first| std::iter::successors(Some(first), |&index| is_next(index)).collect()).collect()
}

/// The gaps of a stack of runs that are rows, where `is_row` says which may be, and how many runs belong to rows, less the
/// cost of the rows.
fn rows_of(is_row: &[bool]) -> (f64, Vec<usize>) {
    // The best choice up to each run, by the number of rows that end one behind the other there: 0, 1 or 2.
    let mut best: [Option<(f64, Vec<usize>)>; 3] = [Some((0.0, Vec::new())), None, None];
    for (gap, &may_be) in is_row.iter().enumerate() {
        let mut next: [Option<(f64, Vec<usize>)>; 3] = [None, None, None];
        for (count, choice) in best.iter().enumerate() {
            let Some((score, gaps)) = choice else { continue };
            better(&mut next[0], *score, gaps.clone());
            if may_be && count < 2 {
                let gained = if count == 0 { 2.0 } else { 1.0 };
                better(&mut next[count + 1], score + gained - ROW_COST, [gaps.as_slice(), &[gap]].concat());
            }
        }
        best = next;
    }
    best.into_iter().flatten().fold((0.0, Vec::new()), |one, other| if other.0 > one.0 { other } else { one })
}

fn better(best: &mut Option<(f64, Vec<usize>)>, score: f64, gaps: Vec<usize>) {
    if best.as_ref().is_none_or(|best| score > best.0) {
        *best = Some((score, gaps));
    }
}
