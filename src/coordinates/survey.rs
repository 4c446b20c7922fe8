//! A georeference from pairs of points: where each lies in the map, and where on Earth.
//!
//! Method: least squares of a turn and a shift on the plane that touches the ellipsoid at the map's origin (B. K. P. Horn
//! 1987, doi 10.1364/JOSAA.4.000629, in the plane). The origin is found on the way, so the plane is moved to it and the
//! fit is made again. The scale stays 1, because a map is in metres: what scale would fit better is told as an error.
//! Cost: O(pairs). Limits: no bend; the points must not lie on one line, where a mistake across it would not show.

use nalgebra::{Matrix2, SymmetricEigen};
use serde::{Deserialize, Serialize};
use stillage_core::{Point, Vector};

use super::georeference::Georeference;
use super::transform::Anchor;

/// Fewest pairs: two fix a turn and a shift, and a third shows whether they are right.
const FEWEST: usize = 3;
/// Points of the map nearer than this are one, metres: what a robot's own position is worth.
const SAME_POINT_M: f64 = 0.05;
/// Points lie on one line when they spread across it by less than this share of their spread along it.
const ON_A_LINE: f64 = 0.02;
/// Largest residual, metres, on small maps: that of a satellite fix in the open.
const LARGEST_RESIDUAL_M: f64 = 5.0;
/// Largest residual as a share of the spread of the points, on large maps.
const LARGEST_SHARE: f64 = 0.05;
/// Positions are kept to this part of a degree, a micrometre, so that they are read as they were written.
const KEPT_PER_DEGREE: f64 = 1e11;
/// How often the plane is moved to the origin: from 100 km away, the third move is below a micrometre.
const MOVES: usize = 5;

/// A point in the map and on Earth.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "camelCase")]
pub struct PointPair {
    /// x and y in the map frame, metres.
    pub map: [f64; 2],
    /// Longitude and latitude, degrees.
    pub lon_lat: [f64; 2],
}

/// A georeference with the pairs it was fitted to; none when it was given by hand.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Survey {
    /// Where the map lies.
    #[serde(flatten)]
    pub georeference: Georeference,
    /// The pairs, in the order they were given.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub pairs: Vec<PointPair>,
}

/// How well pairs fit.
#[derive(Debug, Clone, PartialEq)]
pub struct SurveyFit {
    /// Distance of each pair between where its point lies on Earth and where the georeference puts it, metres.
    pub residuals: Vec<f64>,
    /// Their root mean square, metres.
    pub rms: f64,
    /// How much longer distances on Earth are than in the map, as a share; 0 for a perfect map.
    pub scale_error: f64,
}

/// Why pairs give no georeference.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum SurveyProblem {
    /// Not enough of them.
    #[error("{0} pairs are too few: give 3 or more, far apart and not on one line")]
    TooFew(usize),
    /// A number that is none, or no place on Earth.
    #[error(
        "pair {0} holds a number that is no position: map is x, y in metres, lonLat is longitude, latitude in degrees"
    )]
    NoPosition(usize),
    /// Two pairs have one point of the map.
    #[error("pairs {0} and {1} are at the same point of the map: give points that are far apart")]
    Same(usize, usize),
    /// All points lie on one line.
    #[error("all points lie on one line, where mistakes would not show: add one beside it")]
    OnOneLine,
    /// They contradict one another.
    #[error(
        "the pairs contradict one another: pair {worst} is {residual:.1} m off. Are longitude and latitude, or x and y, \
         exchanged, or is it another point?"
    )]
    Contradiction {
        /// Index of the pair that is furthest off.
        worst: usize,
        /// How far, metres.
        residual: f64,
    },
}

impl SurveyProblem {
    /// Index of the pair that is wrong, where it is one.
    #[must_use]
    pub const fn pair(&self) -> Option<usize> {
        match self {
            Self::NoPosition(pair) | Self::Same(_, pair) | Self::Contradiction { worst: pair, .. } => Some(*pair),
            Self::TooFew(_) | Self::OnOneLine => None,
        }
    }
}

impl From<Georeference> for Survey {
    fn from(georeference: Georeference) -> Self {
        Self { georeference, pairs: Vec::new() }
    }
}

impl Survey {
    /// Fits a georeference to pairs.
    ///
    /// # Errors
    /// [`SurveyProblem`] for fewer than three pairs, for points that coincide or lie on one line, for numbers that are no
    /// positions, and for pairs of which one is further off than 5 m and a twentieth of the spread of the points.
    pub fn fitted(pairs: Vec<PointPair>) -> Result<Self, SurveyProblem> {
        check(&pairs)?;
        let [lon, lat] = pairs[0].lon_lat;
        let mut georeference = Georeference { lon, lat, heading: 0.0 };
        for _ in 0..MOVES {
            let plane = Anchor::new(Georeference { heading: 0.0, ..georeference });
            let fit = PlaneFit::of(&pairs, plane);
            let [lon, lat] = plane.to_degrees(Point::from(fit.shift));
            // A compass turns clockwise.
            georeference = Georeference { lon, lat, heading: -fit.turn.to_degrees() };
        }
        let kept = |value: f64, per_degree: f64| (value * per_degree).round() / per_degree + 0.0;
        let georeference = Georeference {
            lon: kept(georeference.lon, KEPT_PER_DEGREE),
            lat: kept(georeference.lat, KEPT_PER_DEGREE),
            heading: kept(georeference.heading, KEPT_PER_DEGREE),
        };
        let survey = Self { georeference, pairs };
        let fit = survey.fit();
        let worst = (0..fit.residuals.len()).max_by(|&one, &other| fit.residuals[one].total_cmp(&fit.residuals[other]));
        let allowed = LARGEST_RESIDUAL_M.max(LARGEST_SHARE * spread(&survey.pairs)[1]);
        match worst.map(|worst| (worst, fit.residuals[worst])) {
            Some((worst, residual)) if residual > allowed || survey.georeference.check().is_err() => {
                Err(SurveyProblem::Contradiction { worst, residual })
            }
            _ => Ok(survey),
        }
    }

    /// How well the pairs fit; without any, nothing is off.
    #[must_use]
    pub fn fit(&self) -> SurveyFit {
        let plane = Anchor::new(self.georeference);
        let residual = |pair: &PointPair| (plane.to_metres(pair.lon_lat) - Point::from(pair.map)).norm();
        let residuals: Vec<f64> = self.pairs.iter().map(residual).collect();
        let squares = residuals.iter().map(|residual| residual * residual).sum::<f64>();
        let rms = (squares / residuals.len().max(1) as f64).sqrt();
        let scale_error = if self.pairs.is_empty() { 0.0 } else { PlaneFit::of(&self.pairs, plane).scale - 1.0 };
        SurveyFit { residuals, rms, scale_error }
    }
}

/// A turn and a shift from the map frame to metres eastwards and northwards.
struct PlaneFit {
    /// Counter-clockwise, radians.
    turn: f64,
    /// Where the map's origin comes to lie, metres.
    shift: Vector,
    /// The scale that would fit best with this turn.
    scale: f64,
}

impl PlaneFit {
    fn of(pairs: &[PointPair], plane: Anchor) -> Self {
        let map: Vec<Vector> = pairs.iter().map(|pair| Vector::from(pair.map)).collect();
        let earth: Vec<Vector> = pairs.iter().map(|pair| plane.to_metres(pair.lon_lat).coords).collect();
        let (from, to) = (mean(&map), mean(&earth));
        let about = || map.iter().zip(&earth).map(|(map, earth)| (map - from, earth - to));
        let cosine: f64 = about().map(|(map, earth)| map.dot(&earth)).sum();
        let sine: f64 = about().map(|(map, earth)| map.perp(&earth)).sum();
        let turn = sine.atan2(cosine);
        let (sine_of_turn, cosine_of_turn) = turn.sin_cos();
        let turned = Matrix2::new(cosine_of_turn, -sine_of_turn, sine_of_turn, cosine_of_turn) * from;
        let squares: f64 = about().map(|(map, _)| map.norm_squared()).sum();
        Self { turn, shift: to - turned, scale: cosine.hypot(sine) / squares.max(f64::MIN_POSITIVE) }
    }
}

fn mean(points: &[Vector]) -> Vector {
    points.iter().sum::<Vector>() / points.len().max(1) as f64
}

/// Standard deviation of the points of the map across and along their main direction, metres.
fn spread(pairs: &[PointPair]) -> [f64; 2] {
    let points: Vec<Vector> = pairs.iter().map(|pair| Vector::from(pair.map)).collect();
    let middle = mean(&points);
    let scatter: Matrix2<f64> = points.iter().map(|point| (point - middle) * (point - middle).transpose()).sum();
    let values = SymmetricEigen::new(scatter / points.len().max(1) as f64).eigenvalues;
    let [one, other] = [values[0], values[1]].map(|value| value.max(0.0).sqrt());
    [one.min(other), one.max(other)]
}

fn check(pairs: &[PointPair]) -> Result<(), SurveyProblem> {
    if pairs.len() < FEWEST {
        return Err(SurveyProblem::TooFew(pairs.len()));
    }
    for (index, pair) in pairs.iter().enumerate() {
        let [lon, lat] = pair.lon_lat;
        let is_on_earth = Georeference { lon, lat, heading: 0.0 }.check().is_ok();
        if !is_on_earth || pair.map.iter().any(|number| !number.is_finite()) {
            return Err(SurveyProblem::NoPosition(index));
        }
        let is_same = |other: &PointPair| (Point::from(other.map) - Point::from(pair.map)).norm() < SAME_POINT_M;
        if let Some(same) = pairs[..index].iter().position(is_same) {
            return Err(SurveyProblem::Same(same, index));
        }
    }
    let [across, along] = spread(pairs);
    if across < ON_A_LINE * along { Err(SurveyProblem::OnOneLine) } else { Ok(()) }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;
    use crate::coordinates::{Crs, Transform};

    const HALMSTAD: Georeference = Georeference { lon: 12.8572, lat: 56.6745, heading: 30.0 };
    const CORNERS: [[f64; 2]; 4] = [[0.0, 0.0], [80.0, 5.0], [75.0, 60.0], [-3.0, 50.0]];

    fn surveyed(georeference: Georeference, scale: f64) -> Vec<PointPair> {
        let transform = Transform::new(Crs::Crs84, Some(georeference));
        let pair = |[x, y]: [f64; 2]| PointPair { map: [x, y], lon_lat: transform.forward(Point::new(x, y) * scale) };
        CORNERS.map(pair).to_vec()
    }

    #[test]
    fn a_map_that_is_too_small_tells_its_scale_error() {
        let survey = Survey::fitted(surveyed(HALMSTAD, 1.01)).expect("they agree");
        let fit = survey.fit();
        assert!((fit.scale_error - 0.01).abs() < 1e-6 && fit.rms > 0.1 && fit.residuals.len() == 4, "{fit:?}");
    }

    #[test]
    fn pairs_that_fix_nothing_are_refused() {
        let all = surveyed(HALMSTAD, 1.0);
        assert_eq!(Survey::fitted(all[..2].to_vec()), Err(SurveyProblem::TooFew(2)));
        assert_eq!(Survey::fitted(vec![all[0], all[1], all[0]]), Err(SurveyProblem::Same(0, 2)));
        let line = |x: f64| PointPair { map: [x, 2.0 * x], lon_lat: [12.0 + x / 1e5, 56.0] };
        assert_eq!(Survey::fitted(vec![line(0.0), line(5.0), line(30.0)]), Err(SurveyProblem::OnOneLine));
        let nowhere = PointPair { lon_lat: [12.0, 91.0], ..all[2] };
        assert_eq!(Survey::fitted(vec![all[0], all[1], nowhere]), Err(SurveyProblem::NoPosition(2)));
    }

    #[test]
    fn pairs_that_contradict_one_another_name_the_worst() {
        let mut pairs = surveyed(HALMSTAD, 1.0);
        pairs[2].lon_lat[0] += 0.01;
        let problem = Survey::fitted(pairs).expect_err("one is 600 m off");
        assert!(
            matches!(problem, SurveyProblem::Contradiction { worst: 2, residual } if residual > 100.0),
            "{problem}"
        );
        let exchanged =
            surveyed(HALMSTAD, 1.0).into_iter().map(|pair| PointPair { map: [pair.map[1], pair.map[0]], ..pair });
        assert!(Survey::fitted(exchanged.collect()).is_err());
    }

    proptest! {
        #[test]
        fn what_made_the_pairs_is_found(lon in -179.0..179.0, lat in -80.0..80.0, heading in -180.0..180.0) {
            let truth = Georeference { lon, lat, heading };
            let survey = Survey::fitted(surveyed(truth, 1.0)).expect("they agree");
            let found = survey.georeference;
            let turned = (found.heading - heading + 540.0).rem_euclid(360.0) - 180.0;
            prop_assert!(turned.abs() < 1e-6 && survey.fit().rms < 1e-4, "{found:?} {:?}", survey.fit());
            prop_assert!((found.lat - lat).abs() < 1e-9 && (found.lon - lon).abs() < 1e-8);
        }
    }
}
