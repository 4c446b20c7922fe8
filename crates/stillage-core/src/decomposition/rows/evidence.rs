//! Evidence for the borders between the places of a row, along the row.
//!
//! Peaks of a projection lie on goods, not between them: the nine blocks of a pallet are three peaks. The border between
//! two places is a *gap* in the middle of the depth, often with a *post* at the front and at the back. Both are measured
//! against their surroundings, so that the evidence of a full row and that of a nearly empty one are on one scale.
//!
//! Source: the accuracy study behind this project, whose largest single gain this was. Cost: O(cells of the row x widths).

use std::ops::Range;

use crate::decomposition::ground::{self, Cell, Patch, UNKNOWN_CONTENT};

/// Depth of the front and of the back of a row, metres: posts are 0.09 deep, pallets stand 0.05 off.
const FACE_M: f64 = 0.15;
/// Share of the depth at either side that is not the middle.
const RIM_SHARE: f64 = 0.25;
/// Smoothing of content and posts, standard deviation in metres (accuracy study).
const CONTENT_SIGMA_M: f64 = 0.04;
const POST_SIGMA_M: f64 = 0.03;
const MIDDLE_SIGMA_M: f64 = 0.05;
/// Occupied share of the middle above which something at the front is goods, not a post (accuracy study).
const MIDDLE_CONTENT: f64 = 0.04;
/// Windows of the local mean and of the local spread, metres: a place, and two of them (accuracy study).
const MEAN_WINDOW_M: f64 = 1.2;
const SPREAD_WINDOW_M: f64 = 2.5;
/// Added to the spread of content, a share, so that an even row has no gaps.
const LEAST_SPREAD: f64 = 0.03;
/// Least and greatest number of deviations that count for a gap: content counts against it, missing content for it.
const GAP_LIMITS: [f64; 2] = [-2.5, 1.5];
/// Weight of gaps, per deviation (accuracy study).
const GAP_WEIGHT: f64 = 0.5;
/// Weight of posts where one sees through the goods, and where goods hide what is behind them: gaps between the blocks of
/// pallets are everywhere, while gaps between boxes are seen well and boxes have corners like posts.
const POST_WEIGHTS: [f64; 2] = [2.5, 1.5];
/// Unknown share of the middle from which on goods hide what is behind them.
const HIDDEN_SHARE: f64 = 0.2;
/// Smoothing of content before its two halves are compared, standard deviation in metres: goods stand askew by as much.
const MIRROR_SIGMA_M: f64 = 0.06;
/// Window in which content is levelled, metres: two places; added to the level, so that a single cell of a row counts as
/// nothing.
const LEVEL_WINDOW_M: f64 = 2.0;
const LEVEL_FLOOR: f64 = 0.05;
/// Width of a place in which the usual content is counted, metres.
const USUAL_PLACE_M: f64 = 1.2;
/// Content below which a place holds nothing, cells.
const LEAST_CONTENT: f64 = 0.5;
/// Free share of a column of cells that is clear.
const CLEAR_SHARE: f64 = 0.9;

/// Smoothing of content before its variation is measured, standard deviation in metres: about a gap between goods.
const VARIATION_SIGMA_M: f64 = 0.1;
/// Standard deviation over mean below which a row is even: solid racks have 0.08 at most, hatched ones 0.22 to 0.28, 98 % of
/// the rows of the zoo 0.26 and more.
const EVEN_VARIATION: f64 = 0.25;
/// Gaps between goods take more than this share of a row: a cell for each place of 1.6 m.
const GAPS_SHARE: f64 = 0.02;
/// Content beside which no gap shows, as a share of the mean. No measurement is recorded for this value.
const EVEN_LEAST: f64 = 0.4;

/// Evidence along a row, one number per cell.
#[derive(Debug, Clone, Default, PartialEq)]
pub(super) struct RowEvidence {
    /// Evidence for a border: about 1 at a gap with posts, below 0 within goods.
    pub border: Vec<f64>,
    /// Whether nothing stands there in the whole depth.
    pub is_clear: Vec<bool>,
    /// Share of the depth that is occupied or unknown, divided by its usual size nearby; 0 where nothing is known. Of each
    /// row of a bundle in turn.
    pub content: Vec<f64>,
    /// How far the content of a place differs from its mirror image: by first cell, then by width from `least_width`.
    mirror: Vec<f32>,
    least_width: usize,
    widths: usize,
    /// Side of a cell, metres.
    pub cell: f64,
    /// Whether no border shows in it: a solid or hatched rack.
    pub is_even: bool,
}

impl RowEvidence {
    /// Measures a row; `cell` is the side of its cells and `widths` the range of widths of places that are compared with
    /// their mirror image, metres.
    pub(super) fn of(row: &Patch, cell: f64, widths: [f64; 2]) -> Self {
        let Depth { front, middle, back } = Depth::of(row.height, cell);
        let occupied = column_shares(row, &middle, Cell::is_occupied);
        let unknown = column_shares(row, &middle, Cell::is_unknown);
        let content: Vec<f64> =
            occupied.iter().zip(&unknown).map(|(occupied, unknown)| occupied + UNKNOWN_CONTENT * unknown).collect();
        let content = gaussian(&content, CONTENT_SIGMA_M / cell);
        let posts = posts([front, back].map(|face| column_shares(row, &face, Cell::is_occupied)), &occupied, cell);
        let hidden = unknown.iter().sum::<f64>() / row.width.max(1) as f64;
        let free = column_shares(row, &(0..row.height), Cell::is_free);
        let occupied = column_shares(row, &(0..row.height), Cell::is_occupied);
        let shares = || free.iter().zip(&occupied).map(|(&free, &occupied)| (free, occupied));
        let is_clear = shares().map(|(free, occupied)| occupied == 0.0 && free >= CLEAR_SHARE).collect();
        let whole: Vec<f64> = shares()
            .map(|(free, occupied)| ground::content(occupied, 1.0 - (free + occupied), free + occupied))
            .collect();
        let least_width = (widths[0] / cell).floor().max(1.0) as usize;
        let widths = ((widths[1] / cell).ceil() as usize).saturating_sub(least_width) + 1;
        Self {
            border: border(&content, &posts, hidden, cell),
            is_clear,
            content: levelled(&gaussian(&whole, CONTENT_SIGMA_M / cell), cell),
            mirror: mirror_differences(&content, least_width, widths, cell),
            least_width,
            widths,
            cell,
            is_even: shows_no_border(&whole, cell),
        }
    }

    /// From the first to the last cell along it that is not clear.
    pub(super) fn filled(&self) -> Range<usize> {
        let is_filled = |is_clear: &bool| !is_clear;
        let first = self.is_clear.iter().position(is_filled).unwrap_or(0);
        first..self.is_clear.iter().rposition(is_filled).map_or(first, |last| last + 1)
    }

    /// Rows of one length that are cut alike, as one row: the mean of their evidence for borders, and the content of each.
    pub(super) fn bundle(rows: impl IntoIterator<Item = Self>) -> Self {
        let mut rows = rows.into_iter();
        let mut bundle = rows.next().unwrap_or_default();
        let mut count = 1.0;
        for row in rows {
            bundle.border.iter_mut().zip(&row.border).for_each(|(sum, value)| *sum += value);
            bundle.mirror.iter_mut().zip(&row.mirror).for_each(|(sum, value)| *sum += value);
            bundle.is_clear.iter_mut().zip(&row.is_clear).for_each(|(all, is_clear)| *all &= is_clear);
            bundle.content.extend(row.content);
            bundle.is_even &= row.is_even;
            count += 1.0;
        }
        for value in &mut bundle.border {
            *value /= count;
        }
        for value in &mut bundle.mirror {
            *value /= count as f32;
        }
        bundle
    }

    /// The content of each row of a bundle.
    pub(super) fn contents(&self) -> impl Iterator<Item = &[f64]> {
        self.content.chunks(self.len().max(1))
    }

    /// Number of cells along the row.
    pub(super) fn len(&self) -> usize {
        self.border.len()
    }

    /// Length of the row, metres.
    pub(super) fn length(&self) -> f64 {
        self.len() as f64 * self.cell
    }

    /// How far the content of a place differs from its mirror image: 0 for even goods and for none, 1 where all the
    /// goods of a place stand on one side. Goods that are cut in two are uneven, whatever they are.
    pub(super) fn unevenness(&self, start: usize, width: usize) -> f64 {
        let at = width.saturating_sub(self.least_width).min(self.widths.saturating_sub(1));
        self.mirror.get(start * self.widths + at).copied().map_or(0.0, f64::from)
    }
}

/// Ranges across a row, rows of cells.
struct Depth {
    front: Range<usize>,
    middle: Range<usize>,
    back: Range<usize>,
}

impl Depth {
    fn of(height: usize, cell: f64) -> Self {
        let face = ((FACE_M / cell).round() as usize).max(1);
        let rim = ((height as f64 * RIM_SHARE).round() as usize).max(face + 1);
        Self {
            front: 0..(face + 1).min(height),
            middle: if height >= 2 * rim + 3 { rim..height - rim } else { 0..height },
            back: height.saturating_sub(face + 1)..height,
        }
    }
}

/// Share of the cells of each column, within some rows of cells, for which `is` holds.
fn column_shares(row: &Patch, lines: &Range<usize>, is: fn(Cell) -> bool) -> Vec<f64> {
    let mut counts = vec![0_u32; row.width];
    for line in lines.clone() {
        for (count, &cell) in counts.iter_mut().zip(row.row(line)) {
            *count += u32::from(is(cell));
        }
    }
    counts.iter().map(|&count| f64::from(count) / lines.len().max(1) as f64).collect()
}

/// How much of a post stands at each column, 0 to 1, by the occupied shares of the front, the back and the middle.
fn posts([front, back]: [Vec<f64>; 2], middle: &[f64], cell: f64) -> Vec<f64> {
    let any = |share: &f64| f64::from(u8::from(*share > 0.0));
    let faces: Vec<f64> = front.iter().zip(&back).map(|(front, back)| f64::midpoint(any(front), any(back))).collect();
    let middle = gaussian(middle, MIDDLE_SIGMA_M / cell);
    let posts = gaussian(&faces, POST_SIGMA_M / cell);
    posts.iter().zip(&middle).map(|(post, middle)| if *middle < MIDDLE_CONTENT { *post } else { 0.0 }).collect()
}

/// Evidence for a border at each column; `hidden` is the unknown share of the middle of the row.
fn border(content: &[f64], posts: &[f64], hidden: f64, cell: f64) -> Vec<f64> {
    let mean = mean_filter(content, MEAN_WINDOW_M / cell);
    let above: Vec<f64> = content.iter().zip(&mean).map(|(content, mean)| content - mean).collect();
    let squares: Vec<f64> = above.iter().map(|above| above * above).collect();
    let spread = mean_filter(&squares, SPREAD_WINDOW_M / cell);
    let mean_posts = mean_filter(posts, MEAN_WINDOW_M / cell);
    let gap = |x: usize| {
        let deviations = -above[x] / (spread[x].max(0.0).sqrt() + LEAST_SPREAD);
        GAP_WEIGHT * deviations.clamp(GAP_LIMITS[0], GAP_LIMITS[1])
    };
    let [bare, covered] = POST_WEIGHTS;
    let post_weight = bare + (covered - bare) * (hidden / HIDDEN_SHARE).min(1.0);
    (0..content.len()).map(|x| gap(x) + post_weight * (posts[x] - mean_posts[x])).collect()
}

/// Content as a share of its root mean square around each cell, so that the three legs of a pallet count as much as the
/// solid box beside it, which has about ten times the content.
fn levelled(content: &[f64], cell: f64) -> Vec<f64> {
    let squares: Vec<f64> = content.iter().map(|content| content * content).collect();
    let level = mean_filter(&squares, LEVEL_WINDOW_M / cell);
    content.iter().zip(level).map(|(content, square)| content / (square.max(0.0).sqrt() + LEVEL_FLOOR)).collect()
}

/// Whether content along a row hardly varies and has no gap from its first to its last cell.
fn shows_no_border(content: &[f64], cell: f64) -> bool {
    let filled = |value: &f64| *value > 0.0;
    let Some(first) = content.iter().position(filled) else { return false };
    let content = &content[first..=content.iter().rposition(filled).unwrap_or(first)];
    let mean = content.iter().sum::<f64>() / content.len() as f64;
    let smooth = gaussian(content, VARIATION_SIGMA_M / cell);
    let variance = smooth.iter().map(|content| (content - mean).powi(2)).sum::<f64>() / content.len() as f64;
    let mut sorted = content.to_vec();
    sorted.sort_by(f64::total_cmp);
    let least = sorted[(GAPS_SHARE * content.len() as f64) as usize];
    variance.sqrt() < EVEN_VARIATION * mean && least >= EVEN_LEAST * mean
}

/// See [`RowEvidence::unevenness`].
fn mirror_differences(content: &[f64], least_width: usize, widths: usize, cell: f64) -> Vec<f32> {
    let smooth: Vec<f32> = gaussian(content, MIRROR_SIGMA_M / cell).into_iter().map(|value| value as f32).collect();
    let mean = content.iter().sum::<f64>() / content.len().max(1) as f64;
    let usual = (mean * USUAL_PLACE_M / cell).max(LEAST_CONTENT) as f32;
    let mut differences = vec![0.0; content.len() * widths];
    for (start, row) in differences.chunks_exact_mut(widths.max(1)).enumerate() {
        for (width, difference) in (least_width..).zip(row) {
            let Some(place) = smooth.get(start..start + width) else { break };
            let (left, right) = place.split_at(width / 2);
            let sum: f32 = left.iter().zip(right.iter().rev()).map(|(a, b)| (a - b).abs()).sum();
            *difference = sum / usual;
        }
    }
    differences
}

/// Gaussian mean, the ends continued; `sigma` in cells.
fn gaussian(values: &[f64], sigma: f64) -> Vec<f64> {
    let reach = (4.0 * sigma + 0.5) as usize;
    let kernel: Vec<f64> = (0..=reach).map(|at| (-0.5 * (at as f64 / sigma).powi(2)).exp()).collect();
    let total = kernel[0] + 2.0 * kernel[1..].iter().sum::<f64>();
    let last = values.len().saturating_sub(1);
    (0..values.len())
        .map(|x| {
            let sides = (1..=reach).map(|at| kernel[at] * (values[x.saturating_sub(at)] + values[(x + at).min(last)]));
            (kernel[0] * values[x] + sides.sum::<f64>()) / total
        })
        .collect()
}

/// Mean over a window, the ends continued; `window` in cells.
fn mean_filter(values: &[f64], window: f64) -> Vec<f64> {
    let Some(last) = values.len().checked_sub(1) else { return Vec::new() };
    let reach = (window / 2.0) as usize;
    let at = |x: isize| values[x.clamp(0, last as isize) as usize];
    let mut sum: f64 = (-(reach as isize)..=reach as isize).map(at).sum();
    let mut means = Vec::with_capacity(values.len());
    for x in 0..values.len() as isize {
        means.push(sum / (2 * reach + 1) as f64);
        sum += at(x + reach as isize + 1) - at(x - reach as isize);
    }
    means
}
