//! Small sites and options that nobody would draw by hand.
//!
//! A site is a floor and things on it, painted one over the other: rooms with walls, rows of pallets, solid blocks, posts,
//! ground that nobody saw, speckle. So racks meet walls, rows run off the map, and rooms overlap, which is what random
//! cells alone never do. Cells may be as coarse as half a metre.

use proptest::prelude::*;
use stillage_core::spec::{
    AnnotationMethod, CategoryCount, ClusteringMethod, DecompositionMethod, FeatureProfile, OrientationMethod,
    RegionMethod, RelaxationOptions, VehicleWidth,
};
use stillage_core::{AnalysisOptions, AnalysisSpec, GridFrame, Occupancy, OccupancyGrid, Point};

/// Something on the floor: an oriented rectangle, metres, with what it is made of.
#[derive(Debug, Clone)]
struct Thing {
    center: [f64; 2],
    half: [f64; 2],
    angle: f64,
    kind: Kind,
}

#[derive(Debug, Clone, Copy)]
enum Kind {
    /// Walls around a floor.
    Room,
    /// Pallets of a pitch, three blocks each.
    Row(f64),
    /// Occupied, with the inside unseen.
    Block,
    Unseen,
    Floor,
}

impl Thing {
    /// What it makes of a point; nothing beside it.
    fn at(&self, [x, y]: [f64; 2]) -> Option<Occupancy> {
        const WALL: f64 = 0.15;
        let (sine, cosine) = self.angle.sin_cos();
        let offset = [x - self.center[0], y - self.center[1]];
        let along = cosine * offset[0] + sine * offset[1];
        let across = cosine * offset[1] - sine * offset[0];
        let rim = (self.half[0] - along.abs()).min(self.half[1] - across.abs());
        let seen = match self.kind {
            _ if rim < 0.0 => return None,
            Kind::Room | Kind::Block if rim < WALL => Occupancy::Occupied,
            Kind::Row(pitch) if (along.rem_euclid(pitch) * 3.0).rem_euclid(pitch) < 0.3 => Occupancy::Occupied,
            Kind::Room | Kind::Row(_) | Kind::Floor => Occupancy::Free,
            Kind::Block | Kind::Unseen => Occupancy::Unknown,
        };
        Some(seen)
    }
}

fn thing() -> impl Strategy<Value = Thing> {
    let kind = prop_oneof![
        Just(Kind::Room),
        (0.8..1.4).prop_map(Kind::Row),
        (0.8..1.4).prop_map(Kind::Row),
        Just(Kind::Block),
        Just(Kind::Unseen),
        Just(Kind::Floor),
    ];
    // Most sites are square, or nearly.
    let angle = prop_oneof![3 => Just(0.0), 1 => Just(0.02), 1 => -1.6..1.6];
    let half = [0.1_f64..6.0, 0.1_f64..2.5];
    (prop::array::uniform2(0.0..14.0), half, angle, kind).prop_map(|(center, half, angle, kind)| Thing {
        center,
        half,
        angle,
        kind,
    })
}

/// A small site.
#[derive(Debug, Clone)]
pub struct Site {
    /// Columns and rows.
    size: [usize; 2],
    resolution: f64,
    yaw: f64,
    ground: Occupancy,
    /// The last one lies on top.
    things: Vec<Thing>,
    /// Share of cells, per mille.
    speckle: u64,
}

impl Site {
    pub fn grid(&self) -> OccupancyGrid {
        let [width, height] = self.size;
        let cell = |index: usize| {
            let hash = (index as u64 + 1).wrapping_mul(0x9E37_79B9_7F4A_7C15) >> 32;
            if hash % 1000 < self.speckle {
                return if hash & 1024 == 0 { Occupancy::Occupied } else { Occupancy::Unknown };
            }
            let point = [index % width, index / width].map(|place| (place as f64 + 0.5) * self.resolution);
            self.things.iter().rev().find_map(|thing| thing.at(point)).unwrap_or(self.ground)
        };
        let frame = GridFrame { resolution: self.resolution, origin: Point::new(-3.0, 40.0), yaw: self.yaw };
        OccupancyGrid::new(width, height, frame, (0..width * height).map(cell).collect())
    }
}

/// Sites of up to 100 cells a side; now and then one without cells, or of one row.
pub fn any_site() -> impl Strategy<Value = Site> {
    let size = prop_oneof![
        1 => [0_usize..4, 0_usize..4],
        1 => [1_usize..100, 1_usize..3],
        8 => [20_usize..100, 20_usize..100],
    ];
    let resolution = prop_oneof![4 => Just(0.1), 1 => Just(0.05), 1 => 0.03..0.5];
    let ground = prop_oneof![Just(Occupancy::Free), Just(Occupancy::Unknown)];
    let things = prop::collection::vec(thing(), 0..10);
    let speckle = prop_oneof![Just(0), 0_u64..40];
    (size, resolution, -4.0..4.0, ground, things, speckle).prop_map(
        |(size, resolution, yaw, ground, things, speckle)| Site { size, resolution, yaw, ground, things, speckle },
    )
}

/// Every method at some time, the default ones half of the time.
pub fn any_spec() -> impl Strategy<Value = AnalysisSpec> {
    let of_defaults = any::<u64>().prop_map(|seed| AnalysisOptions { seed, ..AnalysisOptions::default() });
    prop_oneof![of_defaults, any_options()].prop_map(|mut options| {
        options.categorization.restarts = 2;
        options.check().expect("every value is within its range")
    })
}

fn any_options() -> impl Strategy<Value = AnalysisOptions> {
    use prop::option::of;
    use prop::sample::select;
    let relaxations = of((1_usize..4).prop_map(|iterations| RelaxationOptions { iterations }));
    let categorization = (
        select(vec![FeatureProfile::Paper13, FeatureProfile::Halmstad2017]),
        select(vec![ClusteringMethod::KMeans, ClusteringMethod::GaussianMixture]),
        select(vec![CategoryCount::Auto, CategoryCount::Fixed(2), CategoryCount::Fixed(7)]),
        1_usize..5,
        relaxations.clone(),
    );
    let geometry = (
        select(vec![OrientationMethod::Energy, OrientationMethod::Paper]),
        select(vec![RegionMethod::Energy, RegionMethod::Single, RegionMethod::Gabor]),
        select(vec![DecompositionMethod::Adaptive, DecompositionMethod::Paper]),
        of((0.3..3.0, 0.0..2.0).prop_map(|(least, more)| [least, least + more])),
        prop_oneof![Just(VehicleWidth::Auto), (0.2..3.0).prop_map(VehicleWidth::Fixed)],
        0.4..6.0,
    );
    let annotation = (select(vec![AnnotationMethod::Faces, AnnotationMethod::Vote]), 2_usize..24, relaxations);
    (categorization, geometry, annotation).prop_map(|(cells, geometry, faces)| {
        let mut options = AnalysisOptions::default();
        let categorization = &mut options.categorization;
        (categorization.profile, categorization.clustering, categorization.k) = (cells.0, cells.1, cells.2);
        (categorization.stride, categorization.relaxation) = (cells.3, cells.4);
        (options.orientation.method, options.regions.method, options.decomposition.method) =
            (geometry.0, geometry.1, geometry.2);
        options.decomposition.pitch_m = geometry.3;
        options.decomposition.vehicle_width_m = geometry.4;
        options.regions.tile_m = geometry.5;
        (options.annotation.method, options.annotation.categories, options.annotation.relaxation) = faces;
        options
    })
}

/// A block between a room and a row, whose gate was once looked for beyond the end of the map, for ever.
pub fn with_a_bay_that_meets_no_hall() -> Site {
    let thing = |center, half, kind| Thing { center, half, angle: 0.0, kind };
    let things = vec![
        thing([3.67, 2.86], [5.25, 1.62], Kind::Room),
        thing([2.6, 2.64], [2.56, 1.85], Kind::Row(0.97)),
        thing([5.88, 2.65], [5.1, 1.42], Kind::Block),
        thing([9.46, 0.48], [0.52, 0.64], Kind::Block),
        thing([5.84, 5.15], [0.9, 0.68], Kind::Block),
    ];
    Site { size: [82, 79], resolution: 0.1, yaw: 0.0, ground: Occupancy::Unknown, things, speckle: 25 }
}
