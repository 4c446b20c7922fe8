//! Options of the place categorization (paper, II-A).

use serde::de::{self, Deserializer, Unexpected, Visitor};
use serde::{Deserialize, Serialize, Serializer};

/// Options of the place categorization (paper, II-A).
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields, rename_all = "camelCase")]
pub struct CategorizationOptions {
    /// Which features.
    pub profile: FeatureProfile,
    /// Beams per cell, evenly around, the first along x.
    pub beams: usize,
    /// Longest beam, metres; unlimited when absent.
    pub max_range_m: Option<f64>,
    /// Whether unknown cells stop beams.
    pub unknown_blocks: bool,
    /// Step between measured columns and rows; the free cells in between take the category of the nearest measured one.
    pub stride: usize,
    /// Smallest difference of consecutive beams that counts as a gap, metres.
    pub gap_m: f64,
    /// Number of categories.
    pub k: CategoryCount,
    /// Most categories when their number is found.
    pub max_k: usize,
    /// How features are made comparable.
    pub scaling: Scaling,
    /// What kind of clusters categories are.
    pub clustering: ClusteringMethod,
    /// Covariances of the components of a Gaussian mixture.
    pub covariance: Covariance,
    /// Restarts of k-means; the best one is kept.
    pub restarts: usize,
    /// Most iterations of one run of k-means or of expectation-maximization.
    pub max_iterations: usize,
    /// Probabilistic relaxation of the cells; none when absent.
    pub relaxation: Option<RelaxationOptions>,
}

/// A number of categories: in JSON a number or `"auto"`.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum CategoryCount {
    /// As many as are found reliably, by prediction strength.
    Auto,
    /// This many.
    Fixed(usize),
}

/// What kind of clusters categories are.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "camelCase")]
pub enum ClusteringMethod {
    /// The nearest of k centroids, as in the paper.
    KMeans,
    /// The likeliest of k normal distributions.
    GaussianMixture,
}

/// The shape of the components of a Gaussian mixture.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "camelCase")]
pub enum Covariance {
    /// Features are independent within a component: ellipsoids along the axes.
    Diagonal,
    /// Any ellipsoid.
    Full,
}

/// Options of a probabilistic relaxation: neighbours move towards categories that go together.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields, rename_all = "camelCase")]
pub struct RelaxationOptions {
    /// Most iterations; it ends earlier when no share changes any more.
    pub iterations: usize,
}

/// A set of features.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum FeatureProfile {
    /// The thirteen features of the paper's Table I, in metres, over closed scans.
    Paper13,
    /// The seventeen features of the author's published code of 2017, in pixels, with its beams.
    Halmstad2017,
}

/// How features are made comparable before clustering.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "camelCase")]
pub enum Scaling {
    /// As they are.
    None,
    /// Divided by their mean, as the author did.
    DivideByMean,
    /// Zero mean, unit variance.
    ZScore,
    /// `sign(x) ln(1 + |x|)`, then zero mean and unit variance.
    LogZScore,
}

impl Default for CategorizationOptions {
    fn default() -> Self {
        Self {
            profile: FeatureProfile::Paper13,
            beams: 360,
            max_range_m: None,
            unknown_blocks: true,
            stride: 1,
            gap_m: 0.5,
            k: CategoryCount::Fixed(5),
            max_k: 8,
            scaling: Scaling::ZScore,
            clustering: ClusteringMethod::KMeans,
            covariance: Covariance::Full,
            restarts: 16,
            max_iterations: 300,
            relaxation: None,
        }
    }
}

impl Default for RelaxationOptions {
    fn default() -> Self {
        Self { iterations: 10 }
    }
}

impl Serialize for CategoryCount {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        // Binary formats cannot tell a number from a word: there `Auto` is `None`.
        match (*self, serializer.is_human_readable()) {
            (Self::Auto, true) => serializer.serialize_str(AUTO),
            (Self::Fixed(count), true) => serializer.serialize_u64(count as u64),
            (Self::Auto, false) => None::<u64>.serialize(serializer),
            (Self::Fixed(count), false) => Some(count as u64).serialize(serializer),
        }
    }
}

impl<'de> Deserialize<'de> for CategoryCount {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        if deserializer.is_human_readable() {
            return deserializer.deserialize_any(NumberOrAuto);
        }
        let count = Option::<u64>::deserialize(deserializer)?;
        Ok(count.map_or(Self::Auto, |count| Self::Fixed(count as usize)))
    }
}

/// The word for [`CategoryCount::Auto`].
const AUTO: &str = "auto";

/// Reads a [`CategoryCount`].
struct NumberOrAuto;

impl Visitor<'_> for NumberOrAuto {
    type Value = CategoryCount;

    fn expecting(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(formatter, "a whole number or \"{AUTO}\"")
    }

    fn visit_u64<E: de::Error>(self, count: u64) -> Result<Self::Value, E> {
        Ok(CategoryCount::Fixed(usize::try_from(count).unwrap_or(usize::MAX)))
    }

    fn visit_i64<E: de::Error>(self, count: i64) -> Result<Self::Value, E> {
        match u64::try_from(count) {
            Ok(count) => self.visit_u64(count),
            Err(_) => Err(E::invalid_value(Unexpected::Signed(count), &self)),
        }
    }

    fn visit_str<E: de::Error>(self, word: &str) -> Result<Self::Value, E> {
        if word == AUTO { Ok(CategoryCount::Auto) } else { Err(E::invalid_value(Unexpected::Str(word), &self)) }
    }
}
