//! One-dimensional signals: Hann smoothing, plain peaks, and wavelet peaks.
//!
//! Signals are rows of evenly spaced samples ("bins"), either *open* (nothing outside: zero) or *circular*. The
//! wavelet peaks follow P. Du, W. A. Kibbe and S. M. Lin, *Improved peak detection in mass spectrum by incorporating
//! continuous wavelet transform-based pattern matching* (Bioinformatics 22(17), 2006,
//! doi 10.1093/bioinformatics/btl355), the method behind the paper's "peak detection based on CWT" (II-B).
//! Departures: circular signals wrap around; there is no noise percentile, because the signals here are smooth already.
//!
//! Cost: O(n w) for a kernel of w bins; ridges O(n log n) per scale; peaks O(p k) for p maxima of which k are kept.

/// What lies beyond the ends of a signal.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Boundary {
    /// Zeros.
    Open,
    /// The other end.
    Circular,
}

impl Boundary {
    /// Distance between two positions of a signal of `length` bins.
    #[must_use]
    pub fn distance(self, first: f64, second: f64, length: usize) -> f64 {
        let straight = (first - second).abs();
        match self {
            Self::Open => straight,
            Self::Circular => straight.min((length as f64 - straight).abs()),
        }
    }
}

/// A symmetric Hann window of `width` bins from zero to zero, of odd length and sum 1; `[1]` below two bins.
#[must_use]
pub fn hann_window(width: f64) -> Vec<f64> {
    // Samples at the zeros of the window are left out.
    let reach = ((width / 2.0).ceil() as isize - 1).max(0);
    let weights: Vec<f64> =
        (-reach..=reach).map(|offset| 1.0 + (std::f64::consts::TAU * offset as f64 / width.max(1.0)).cos()).collect();
    let sum: f64 = weights.iter().sum();
    weights.into_iter().map(|weight| weight / sum).collect()
}

/// Smooths a signal with a Hann window of `width` bins; circular and well inside open signals the sum is kept.
#[must_use]
pub fn smooth_hann(values: &[f64], width: f64, boundary: Boundary) -> Vec<f64> {
    convolve(values, &hann_window(width), boundary)
}

/// Convolves a signal with a symmetric kernel of odd length; the result has the length of the signal.
#[must_use]
pub fn convolve(values: &[f64], kernel: &[f64], boundary: Boundary) -> Vec<f64> {
    let count = values.len();
    if count == 0 {
        return Vec::new();
    }
    let reach = kernel.len() / 2;
    let extended: Vec<f64> = (0..count + 2 * reach)
        .map(|index| match boundary {
            Boundary::Open => index.checked_sub(reach).and_then(|inner| values.get(inner)).copied().unwrap_or(0.0),
            // `reach` may exceed the length of the signal.
            Boundary::Circular => values[(index + count - reach % count) % count],
        })
        .collect();
    extended
        .windows(kernel.len())
        .map(|window| window.iter().zip(kernel).map(|(value, weight)| value * weight).sum())
        .collect()
}

/// A local maximum of a signal.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Peak {
    /// Bin of the maximum (the middle one of a plateau).
    pub bin: usize,
    /// Where the parabola through the bin and its neighbours is highest, bins; bin `i` has its centre at `i`.
    pub position: f64,
    /// Value of the signal at the bin.
    pub height: f64,
}

/// All local maxima, plateaus included, in the order of their bins. A constant circular signal has none.
#[must_use]
pub fn local_maxima(values: &[f64], boundary: Boundary) -> Vec<Peak> {
    let count = values.len();
    let before = |index: usize| match (index, boundary) {
        (0, Boundary::Open) => None,
        (0, Boundary::Circular) => Some(count - 1),
        _ => Some(index - 1),
    };
    let after = |index: usize| match (index + 1 == count, boundary) {
        (true, Boundary::Open) => None,
        (true, Boundary::Circular) => Some(0),
        _ => Some(index + 1),
    };
    let at = |index: Option<usize>| index.map_or(0.0, |index| values[index]);
    let mut maxima = Vec::new();
    for first in 0..count {
        let height = values[first];
        if at(before(first)) >= height {
            continue;
        }
        // The signal rises to `first`; follow the plateau to where it ends.
        let mut last = first;
        let mut length = 1;
        while let Some(next) = after(last).filter(|&next| values[next].total_cmp(&height).is_eq() && length < count) {
            last = next;
            length += 1;
        }
        if at(after(last)) < height {
            let bin = (first + (length - 1) / 2) % count;
            let middle = bin as f64 + if length % 2 == 0 { 0.5 } else { 0.0 };
            let shift = if length == 1 { parabola_shift(at(before(bin)), height, at(after(bin))) } else { 0.0 };
            maxima.push(Peak { bin, position: middle + shift, height });
        }
    }
    maxima.sort_by_key(|peak| peak.bin);
    maxima
}

/// Offset of the vertex of the parabola through three samples from the middle one, which is the highest.
fn parabola_shift(before: f64, height: f64, after: f64) -> f64 {
    let curvature = before - 2.0 * height + after;
    if curvature < 0.0 { (before - after) / (2.0 * curvature) } else { 0.0 }
}

/// Keeps the peaks that are at least `min_distance` bins from every stronger one; strongest first.
///
/// `length` is that of the signal. Of equals the one of the lower position counts as the stronger.
#[must_use]
pub fn keep_apart(mut peaks: Vec<Peak>, min_distance: f64, length: usize, boundary: Boundary) -> Vec<Peak> {
    peaks.sort_by(|one, other| other.height.total_cmp(&one.height).then(one.position.total_cmp(&other.position)));
    let mut kept: Vec<Peak> = Vec::new();
    for peak in peaks {
        if kept.iter().all(|other| boundary.distance(peak.position, other.position, length) >= min_distance) {
            kept.push(peak);
        }
    }
    kept
}

/// How ridges of the wavelet transform are followed, and which of them count.
#[derive(Debug, Clone, PartialEq)]
pub struct RidgeSpec {
    /// Widths of the wavelets, bins, ascending: the distance from the centre to the zero crossing.
    pub widths: Vec<f64>,
    /// Scales in a row that a ridge may miss.
    pub max_gap: usize,
    /// Fewest scales at which a ridge is found.
    pub min_length: usize,
}

/// The Ricker wavelet ("Mexican hat") of unit energy, cut off at five widths on either side.
#[must_use]
pub fn ricker(width: f64) -> Vec<f64> {
    let reach = (5.0 * width).ceil() as isize;
    let scale = 2.0 / ((3.0 * width).sqrt() * std::f64::consts::PI.powf(0.25));
    (-reach..=reach)
        .map(|offset| {
            let square = (offset as f64 / width).powi(2);
            scale * (1.0 - square) * (-square / 2.0).exp()
        })
        .collect()
}

/// The continuous wavelet transform: one row of coefficients for each width.
#[must_use]
pub fn wavelet_transform(values: &[f64], widths: &[f64], boundary: Boundary) -> Vec<Vec<f64>> {
    widths.iter().map(|&width| convolve(values, &ricker(width), boundary)).collect()
}

/// A chain of maxima over the scales, from the widest wavelet down.
struct Ridge {
    /// Bin at the last scale where it was found.
    bin: usize,
    /// Number of scales where it was found.
    length: usize,
    /// Number of scales since then.
    gap: usize,
}

/// Bins of the ridges: where maxima of the wavelet transform lie near one another over many scales. Ascending.
#[must_use]
pub fn ridge_peaks(values: &[f64], boundary: Boundary, spec: &RidgeSpec) -> Vec<usize> {
    let mut ridges: Vec<Ridge> = Vec::new();
    for &width in spec.widths.iter().rev() {
        let coefficients = convolve(values, &ricker(width), boundary);
        let maxima: Vec<usize> = local_maxima(&coefficients, boundary)
            .iter()
            .filter(|peak| peak.height > 0.0)
            .map(|peak| peak.bin)
            .collect();
        // A maximum moves by less than a quarter of the width from one scale to the next (Du et al., 2006).
        let reach = (width / 4.0).max(1.0);
        follow(&mut ridges, &maxima, reach, values.len(), boundary, spec.max_gap);
    }
    let mut bins: Vec<usize> =
        ridges.iter().filter(|ridge| ridge.length >= spec.min_length).map(|ridge| ridge.bin).collect();
    bins.sort_unstable();
    bins.dedup();
    bins
}

/// Continues each ridge whose gap is not too long with its nearest maximum within reach; the other maxima start new
/// ridges.
fn follow(ridges: &mut Vec<Ridge>, maxima: &[usize], reach: f64, length: usize, boundary: Boundary, max_gap: usize) {
    let mut taken = vec![false; maxima.len()];
    for ridge in ridges.iter_mut().filter(|ridge| ridge.gap <= max_gap) {
        let nearest = maxima
            .iter()
            .enumerate()
            .map(|(index, &bin)| (boundary.distance(bin as f64, ridge.bin as f64, length), index))
            .filter(|&(distance, index)| distance <= reach && !taken[index])
            .min_by(|one, other| one.0.total_cmp(&other.0));
        if let Some((_, index)) = nearest {
            taken[index] = true;
            *ridge = Ridge { bin: maxima[index], length: ridge.length + 1, gap: 0 };
        } else {
            ridge.gap += 1;
        }
    }
    let fresh = maxima.iter().zip(&taken).filter(|&(_, &taken)| !taken);
    ridges.extend(fresh.map(|(&bin, _)| Ridge { bin, length: 1, gap: 0 }));
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn bell(center: f64, width: f64, count: usize) -> Vec<f64> {
        (0..count)
            .map(|bin| {
                let distance = Boundary::Circular.distance(bin as f64, center, count) / width;
                (-distance * distance / 2.0).exp()
            })
            .collect()
    }

    fn sum(first: &[f64], second: &[f64], weight: f64) -> Vec<f64> {
        first.iter().zip(second).map(|(one, other)| one + weight * other).collect()
    }

    #[test]
    fn a_hann_window_is_odd_symmetric_and_sums_to_one() {
        assert_eq!(hann_window(0.0), [1.0]);
        assert_eq!(hann_window(1.9), [1.0]);
        let window = hann_window(4.0);
        assert_eq!(window.len(), 3);
        assert!((window[0] - 0.25).abs() < 1e-12 && (window[1] - 0.5).abs() < 1e-12);
    }

    #[test]
    fn smoothing_wraps_around_a_circle_and_leaks_out_of_an_open_end() {
        let values = [1.0, 0.0, 0.0, 0.0, 0.0];
        let rounded = |values: Vec<f64>| values.iter().map(|value| (value * 100.0).round() / 100.0).collect::<Vec<_>>();
        assert_eq!(rounded(smooth_hann(&values, 4.0, Boundary::Circular)), [0.5, 0.25, 0.0, 0.0, 0.25]);
        assert_eq!(rounded(smooth_hann(&values, 4.0, Boundary::Open)), [0.5, 0.25, 0.0, 0.0, 0.0]);
    }

    #[test]
    fn a_kernel_may_be_longer_than_the_signal() {
        let smooth = convolve(&[1.0, 2.0], &[1.0; 7], Boundary::Circular);
        assert_eq!(smooth, [11.0, 10.0]);
        assert_eq!(convolve(&[1.0, 2.0], &[1.0; 7], Boundary::Open), [3.0, 3.0]);
        assert!(convolve(&[], &[1.0; 7], Boundary::Circular).is_empty());
    }

    #[test]
    fn maxima_are_found_at_ends_and_in_the_middle_of_plateaus() {
        let bins = |values: &[f64], boundary| {
            local_maxima(values, boundary).iter().map(|peak| (peak.bin, peak.position)).collect::<Vec<_>>()
        };
        assert_eq!(bins(&[3.0, 1.0, 1.0, 2.0, 2.0, 2.0, 0.0, 1.0], Boundary::Open), [(0, 0.1), (4, 4.0), (7, 7.0)]);
        assert_eq!(bins(&[2.0, 0.0, 1.0, 0.0, 2.0], Boundary::Circular), [(2, 2.0), (4, 4.5)]);
        assert_eq!(bins(&[1.0; 5], Boundary::Circular), []);
        assert_eq!(bins(&[0.0; 5], Boundary::Open), []);
        assert_eq!(bins(&[], Boundary::Open), []);
        assert_eq!(bins(&[1.0], Boundary::Open), [(0, 0.0)]);
    }

    #[test]
    fn a_peak_lies_between_two_bins_where_its_neighbours_say_so() {
        let values: Vec<f64> = (0..9).map(|bin| 10.0 - (f64::from(bin) - 4.3).powi(2)).collect();
        let peaks = local_maxima(&values, Boundary::Open);
        assert!((peaks[0].position - 4.3).abs() < 1e-9);
    }

    #[test]
    fn the_stronger_of_two_close_peaks_stays() {
        let values = [0.0, 5.0, 0.0, 6.0, 0.0, 0.0, 0.0, 1.0, 0.0, 4.0];
        let kept = |distance, boundary| {
            let peaks = keep_apart(local_maxima(&values, boundary), distance, values.len(), boundary);
            peaks.iter().map(|peak| peak.bin).collect::<Vec<_>>()
        };
        assert_eq!(kept(3.0, Boundary::Open), [3, 9]);
        assert_eq!(kept(3.0, Boundary::Circular), [3, 9]);
        assert_eq!(kept(5.0, Boundary::Circular), [3]);
    }

    #[test]
    fn wavelet_ridges_see_two_bells_and_not_the_ripple_on_them() {
        let bells = sum(&bell(2.0, 8.0, 300), &bell(140.0, 12.0, 300), 0.6);
        let ripple: Vec<f64> = (0..300).map(|bin| f64::from(bin % 3) * 0.05).collect();
        let spec = RidgeSpec { widths: vec![4.0, 6.0, 8.0, 10.0, 12.0], max_gap: 1, min_length: 3 };
        let found = ridge_peaks(&sum(&bells, &ripple, 1.0), Boundary::Circular, &spec);
        // The ripple alone is far below the bells.
        let high: Vec<usize> = found.into_iter().filter(|&bin| bells[bin] > 0.3).collect();
        assert_eq!(high, [2, 140]);
    }

    #[test]
    fn a_constant_signal_has_no_ridge() {
        let spec = RidgeSpec { widths: vec![2.0, 4.0], max_gap: 1, min_length: 1 };
        assert!(ridge_peaks(&[0.0; 50], Boundary::Circular, &spec).is_empty());
        assert!(ridge_peaks(&[], Boundary::Open, &spec).is_empty());
    }

    proptest! {
        #[test]
        fn peaks_turn_with_a_circular_signal(turn in 0usize..90, center in 0.0..90.0) {
            let values = bell(center, 5.0, 90);
            let mut turned = values.clone();
            turned.rotate_right(turn);
            let top = |values: &[f64]| keep_apart(local_maxima(values, Boundary::Circular), 3.0, 90, Boundary::Circular)[0];
            let expected = (top(&values).position + turn as f64).rem_euclid(90.0);
            prop_assert!(Boundary::Circular.distance(top(&turned).position.rem_euclid(90.0), expected, 90) < 1e-6);
        }

        #[test]
        fn kept_peaks_are_apart_and_falling(values in proptest::collection::vec(0.0..1.0, 0..60), distance in 0.5..9.0) {
            let peaks = keep_apart(local_maxima(&values, Boundary::Circular), distance, values.len(), Boundary::Circular);
            for (index, peak) in peaks.iter().enumerate() {
                prop_assert!(index == 0 || peaks[index - 1].height >= peak.height);
                for other in &peaks[..index] {
                    prop_assert!(Boundary::Circular.distance(peak.position, other.position, values.len()) >= distance);
                }
            }
        }
    }
}
