//! Lines of cells in any direction.

use crate::geometry::direction;
use crate::watch::{Stopped, Watch};

/// Calls `found` with the cells of every line in a direction; each cell of the map lies on exactly one line.
pub(crate) fn for_each_line(
    [width, height]: [usize; 2],
    angle: f64,
    watch: &Watch<'_>,
    mut found: impl FnMut(&[usize]),
) -> Result<(), Stopped> {
    let along = direction(angle);
    let is_level = along.x.abs() >= along.y.abs();
    let (slope, steps, tracks) =
        if is_level { (along.y / along.x, width, height) } else { (along.x / along.y, height, width) };
    // How far a line has shifted sideways after each step, cells.
    let aside: Vec<i64> = (0..steps).map(|step| (step as f64 * slope).round() as i64).collect();
    let first = -aside.iter().copied().max().unwrap_or(0);
    let last = tracks as i64 - aside.iter().copied().min().unwrap_or(0);
    let mut line = Vec::with_capacity(steps);
    for start in first..last {
        watch.check()?;
        line.clear();
        line.extend(aside.iter().enumerate().filter_map(|(step, aside)| {
            let track = usize::try_from(start + aside).ok().filter(|&track| track < tracks)?;
            Some(if is_level { track * width + step } else { step * width + track })
        }));
        found(&line);
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    proptest! {
        #[test]
        fn every_cell_lies_on_one_line(width in 0_usize..12, height in 0_usize..12, angle in -4.0..4.0) {
            let mut met = vec![0; width * height];
            let count = |line: &[usize]| line.iter().for_each(|&cell| met[cell] += 1);
            for_each_line([width, height], angle, &Watch::unwatched(), count).expect("nobody stops it");
            prop_assert!(met.iter().all(|&times| times == 1));
        }
    }
}
