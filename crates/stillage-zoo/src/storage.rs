//! A block of storage in a frame of its own: rows along x, stacked along y, cut by cross aisles.
//!
//! A plan says which rows and aisles there are and therefore how large the block is; [`build`](StoragePlan::build)
//! fills it. Between the two, the hall is made to measure.

use std::ops::Range;

use stillage_core::geometry::Point;

use crate::random::Random;
use crate::shape::Convex;
use crate::site::{About, Content, Place, Site};
use crate::style::{Fill, Style};

/// One stripe of a block, from low to high y.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Band {
    /// An aisle of a width, metres.
    Aisle(f64),
    /// Rows back to back: whether there is one that faces down, and one that faces up.
    Rows { down: bool, up: bool },
}

/// Rows, aisles and cross aisles of one region.
#[derive(Debug, Clone)]
pub(crate) struct StoragePlan {
    pub(crate) region: char,
    pub(crate) style: Style,
    bands: Vec<Band>,
    /// Bays between cross aisles.
    segments: Vec<usize>,
}

/// Which borders of a block rows may stand against: low and high y.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Walls(pub(crate) bool, pub(crate) bool);

/// What limits a block, in its own frame.
#[derive(Debug, Clone, Default)]
pub(crate) struct Limits {
    /// Columns of the building: no place where they stand.
    pub(crate) columns: Vec<Convex>,
    /// The block ends here.
    pub(crate) outline: Option<Convex>,
}

/// Between a row and the wall behind it, metres.
const BEHIND: Range<f64> = 0.1..0.35;
/// How far a guard reaches beyond its row, and how thick it is, metres.
const GUARD: [f64; 2] = [0.25, 0.08];
/// Depth of a post into the row, metres.
const POST_DEPTH: f64 = 0.09;
/// Least width of a tunnel, metres.
const TUNNEL: f64 = 2.4;
/// How far aside of the middle the robot drives, there and back, metres.
const KEEP_RIGHT: f64 = 0.25;

impl StoragePlan {
    /// Plans a block of about a length and depth, metres; never larger, unless it would hold nothing.
    pub(crate) fn new(region: char, style: Style, size: [f64; 2], walls: Walls, random: &mut Random) -> Self {
        let [length, depth] = size;
        let count = ((length / style.cross_every).round() as usize).max(1);
        let segment = (length - (count - 1) as f64 * style.cross_aisle) / count as f64;
        let bays = (((segment - style.gap) / style.bay()) as usize).max(1);
        let bands = bands(&style, depth, walls, random);
        Self { region, style, bands, segments: vec![bays; count] }
    }

    /// A single row of lanes between two aisles.
    pub(crate) fn single(region: char, style: Style, length: f64, random: &mut Random) -> Self {
        let aisle = Band::Aisle(style.aisle);
        let mut plan = Self::new(region, style, [length, 0.0], Walls(false, false), random);
        plan.bands = vec![aisle, Band::Rows { down: true, up: false }, Band::Aisle(random.within(2.0..3.0))];
        plan
    }

    fn segment_length(&self, bays: usize) -> f64 {
        bays as f64 * self.style.bay() + self.style.gap
    }

    /// Room to leave to the walls below and above: some behind a row, none beside an aisle. Metres.
    pub(crate) fn behind(&self, random: &mut Random) -> [f64; 2] {
        let gap = random.within(BEHIND);
        [self.bands.first(), self.bands.last()].map(|band| match band {
            Some(Band::Rows { .. }) => gap,
            _ => 0.0,
        })
    }

    /// Length along the rows, metres.
    pub(crate) fn length(&self) -> f64 {
        self.segment_ranges().last().map_or(0.0, |range| range.end)
    }

    /// Depth across the rows, metres.
    pub(crate) fn depth(&self) -> f64 {
        self.bands.iter().map(|&band| band_depth(band, &self.style)).sum()
    }

    /// Where the segments lie along the rows.
    fn segment_ranges(&self) -> Vec<Range<f64>> {
        let start_next = |start: &mut f64, &bays: &usize| {
            let range = *start..*start + self.segment_length(bays);
            *start = range.end + self.style.cross_aisle;
            Some(range)
        };
        self.segments.iter().scan(0.0, start_next).collect()
    }

    /// Fills the block.
    pub(crate) fn build(&self, limits: &Limits, random: &mut Random) -> Site {
        let mut site = Site::default();
        let mut builder = Builder { plan: self, limits, random, site: &mut site, rows: 0 };
        let extents = builder.all_rows();
        builder.aisles(&extents);
        builder.cross_aisles();
        let whole = Convex::rectangle(0.0..self.length(), 0.0..self.depth());
        let region = limits.outline.as_ref().and_then(|outline| whole.intersection(outline)).unwrap_or(whole);
        let [pitch, depth] = self.style.place;
        site.state(region, About::Region { name: self.region, angle: 0.0, pitch, depth });
        site
    }
}

fn band_depth(band: Band, style: &Style) -> f64 {
    match band {
        Band::Aisle(width) => width,
        Band::Rows { down: true, up: true } => 2.0 * style.side_depth() + style.flue,
        Band::Rows { .. } => style.side_depth(),
    }
}

/// Aisle and rows by turns, as many as fit.
fn bands(style: &Style, depth: f64, walls: Walls, random: &mut Random) -> Vec<Band> {
    let (pair, single) = (Band::Rows { down: true, up: true }, style.side_depth());
    let pair_depth = band_depth(pair, style);
    let (low, high) = (walls.0 && random.chance(0.6), walls.1 && random.chance(0.6));
    let at_walls = f64::from(u8::from(low)) * single + f64::from(u8::from(high)) * single;
    let fits = ((depth - at_walls - style.aisle) / (pair_depth + style.aisle)) as usize;
    let pairs = fits.max(usize::from(!low && !high));
    let mut aisle = || Band::Aisle(style.aisle + random.within(0.0..0.25));
    let mut bands = Vec::new();
    bands.extend(low.then_some(Band::Rows { down: false, up: true }));
    bands.push(aisle());
    for _ in 0..pairs {
        bands.push(pair);
        bands.push(aisle());
    }
    bands.extend(high.then_some(Band::Rows { down: true, up: false }));
    bands
}

/// From where to where the rows of each band reach in each segment; `None` where nothing stands.
type Extents = Vec<Vec<Option<Range<f64>>>>;

fn join(first: Option<Range<f64>>, second: Option<Range<f64>>) -> Option<Range<f64>> {
    match (first, second) {
        (Some(first), Some(second)) => Some(first.start.min(second.start)..first.end.max(second.end)),
        (first, second) => first.or(second),
    }
}

/// One side of a pair of rows within one segment.
struct Side {
    /// Range across the rows, metres.
    y: Range<f64>,
    up: bool,
    /// Floor behind it that nobody reaches: half of a flue, or the gap to a wall, metres.
    behind: f64,
    /// Number of the front row of the side within the region.
    row: usize,
    segment: usize,
    /// Bays that are left free for a tunnel.
    tunnel: Range<usize>,
}

struct Builder<'a> {
    plan: &'a StoragePlan,
    limits: &'a Limits,
    random: &'a mut Random,
    site: &'a mut Site,
    /// Rows numbered so far.
    rows: usize,
}

impl Builder<'_> {
    /// Builds the rows of all bands.
    fn all_rows(&mut self) -> Extents {
        let style = &self.plan.style;
        let ranges = self.plan.segment_ranges();
        let tunnels: Vec<Range<usize>> = self.plan.segments.iter().map(|&bays| self.tunnel(bays)).collect();
        let mut y = 0.0;
        let mut extents = Extents::new();
        for &band in &self.plan.bands {
            let depth = band_depth(band, style);
            let mut of_band = vec![None; ranges.len()];
            if let Band::Rows { down, up } = band {
                for (present, faces_up) in [(down, false), (up, true)] {
                    if !present {
                        continue;
                    }
                    let low = if faces_up { y + depth - style.side_depth() } else { y };
                    for (segment, range) in ranges.iter().enumerate() {
                        let side = Side {
                            y: low..low + style.side_depth(),
                            up: faces_up,
                            behind: if down && up { style.flue / 2.0 } else { BEHIND.end },
                            row: self.rows,
                            segment,
                            tunnel: tunnels[segment].clone(),
                        };
                        of_band[segment] = join(of_band[segment].take(), self.side(&side, range));
                    }
                    self.rows += style.layers;
                }
            }
            extents.push(of_band);
            y += depth;
        }
        for (range, tunnel) in ranges.iter().zip(&tunnels) {
            if !tunnel.is_empty() {
                let middle = range.start + style.bay() * (tunnel.start + tunnel.end) as f64 / 2.0 + style.gap / 2.0;
                self.drive(Point::new(middle, 0.0), Point::new(middle, y));
            }
        }
        extents
    }

    /// The bays of a segment that a tunnel takes; none where there is none.
    fn tunnel(&mut self, bays: usize) -> Range<usize> {
        let wide = (TUNNEL / self.plan.style.bay()).ceil() as usize;
        if !self.plan.style.tunnels || bays < wide + 4 {
            return 0..0;
        }
        let start = self.random.count(2..bays - wide - 1);
        start..start + wide
    }

    /// Builds one side of a band in one segment, and says from where to where it reaches.
    fn side(&mut self, side: &Side, range: &Range<f64>) -> Option<Range<f64>> {
        let style = &self.plan.style;
        if self.random.chance(style.missing_rows) {
            return None;
        }
        let bays = self.plan.segments[side.segment];
        let shifted = side.tunnel.is_empty() && self.random.chance(style.shifted_rows);
        let (start, bays) = if shifted {
            (range.start + self.random.within(0.1..style.bay()), bays.saturating_sub(1))
        } else {
            (range.start, bays)
        };
        let bay = |index: usize| start + index as f64 * style.bay();
        let kept = |index: &usize| {
            let shape = Convex::rectangle(bay(*index)..bay(index + 1) + style.gap, side.y.clone());
            !side.tunnel.contains(index) && self.limits.outline.as_ref().is_none_or(|outline| outline.covers(&shape))
        };
        let kept: Vec<usize> = (0..bays).filter(kept).collect();
        let mut reach = None;
        for stretch in kept.chunk_by(|first, second| first + 1 == *second) {
            let (first, end) = (stretch[0], stretch[0] + stretch.len());
            let x = bay(first)..bay(end) + style.gap;
            for &index in stretch {
                self.bay(side, bay(index) + style.gap);
            }
            if style.uprights {
                (first..=end).for_each(|index| self.posts(side, bay(index)));
            }
            if style.guards {
                self.guard(side, &x);
            }
            self.body(side, &x);
            reach = join(reach, Some(x));
        }
        reach
    }

    /// The places of one bay, with what stands on them.
    fn bay(&mut self, side: &Side, start: f64) {
        let style = &self.plan.style;
        let [width, depth] = style.place;
        for index in 0..style.places_per_bay {
            let x = start + index as f64 * width;
            let stored = self.stored();
            for (layer, &full) in stored.iter().enumerate() {
                let y =
                    if side.up { side.y.end - (layer + 1) as f64 * depth } else { side.y.start + layer as f64 * depth };
                let shape = Convex::rectangle(x..x + width, y..y + depth);
                if self.limits.columns.iter().any(|column| column.overlap(&shape) > 0.0) {
                    continue;
                }
                let content = self.content(full);
                self.stand(shape.middle(), content);
                // Number of the row from low to high y.
                let row = side.row + if side.up { style.layers - 1 - layer } else { layer };
                let place = Place {
                    region: self.plan.region,
                    row: format!("{}{row}.{}", self.plan.region, side.segment),
                    content,
                    front: layer,
                    facing: if side.up { 1 } else { -1 },
                    local: [x, y, width, depth],
                };
                self.site.state(shape, About::Place(place));
            }
        }
    }

    /// Which layers of the next lane hold something, front first.
    fn stored(&mut self) -> Vec<bool> {
        let layers = self.plan.style.layers;
        match self.plan.style.fill {
            Fill::Single(empty) => (0..layers).map(|_| !self.random.chance(empty)).collect(),
            Fill::FromBack(empty) => {
                let most = (2.0 * empty * layers as f64).round() as usize + 1;
                let free = self.random.count(0..most).min(layers);
                (0..layers).map(|layer| layer >= free).collect()
            }
        }
    }

    fn content(&mut self, full: bool) -> Content {
        let shows_load = self.random.chance(self.plan.style.boxes);
        match (full, shows_load) {
            (false, _) => Content::Nothing,
            (true, true) => Content::Box,
            (true, false) => Content::Pallet,
        }
    }

    /// Puts a pallet on the middle of a place, as carefully as the style says.
    fn stand(&mut self, middle: Point, content: Content) {
        let [distance, turn] = self.plan.style.careless;
        let [x, y, angle] = [distance, distance, turn].map(|deviation| self.random.normal(deviation));
        let center = Point::new(middle.x + x, middle.y + y);
        let solids = self.plan.style.pallet.solids(center, angle, content, self.random);
        self.site.solids.extend(solids);
    }

    /// The posts of one frame: front and back of each layer.
    fn posts(&mut self, side: &Side, x: f64) {
        let style = &self.plan.style;
        let depth = style.place[1];
        for layer in 0..style.layers {
            let y = side.y.start + layer as f64 * depth;
            for low in [y, y + depth - POST_DEPTH] {
                self.site.solids.push(Convex::rectangle(x..x + style.gap, low..low + POST_DEPTH));
            }
        }
    }

    /// Guards beyond both ends of a stretch, and before its outer posts.
    fn guard(&mut self, side: &Side, x: &Range<f64>) {
        let [reach, thickness] = GUARD;
        let front = if side.up { side.y.end } else { side.y.start - thickness };
        for outer in [x.start - reach, x.end + reach - thickness] {
            self.site.solids.push(Convex::rectangle(outer..outer + thickness, side.y.clone()));
        }
        for post in [x.start - reach..x.start + 0.1, x.end - 0.1..x.end + reach] {
            self.site.solids.push(Convex::rectangle(post, front..front + thickness));
        }
    }

    /// Floor that a stretch of a side takes, with what lies behind it.
    fn body(&mut self, side: &Side, x: &Range<f64>) {
        let (below, above) = if side.up { (side.behind, 0.0) } else { (0.0, side.behind) };
        let y = side.y.start - below..side.y.end + above;
        let beyond = if self.plan.style.guards { GUARD[0] } else { 0.0 };
        self.site.bodies.push(Convex::rectangle(x.start - beyond..x.end + beyond, y));
    }

    /// States and drives the aisles beside rows.
    fn aisles(&mut self, extents: &Extents) {
        let none = Vec::new();
        let mut y = 0.0;
        let mut aisle = 0;
        for (index, &band) in self.plan.bands.iter().enumerate() {
            let depth = band_depth(band, &self.plan.style);
            if let Band::Aisle(width) = band {
                let below = index.checked_sub(1).map_or(&none, |index| &extents[index]);
                let above = extents.get(index + 1).unwrap_or(&none);
                for segment in 0..self.plan.segments.len() {
                    let reach = |band: &Vec<Option<Range<f64>>>| band.get(segment).cloned().flatten();
                    let Some(x) = join(reach(below), reach(above)) else { continue };
                    self.aisle(x, y..y + width, aisle, segment);
                }
                aisle += 1;
            }
            y += depth;
        }
    }

    fn aisle(&mut self, x: Range<f64>, y: Range<f64>, aisle: usize, segment: usize) {
        if !self.random.chance(self.plan.style.unvisited) {
            let middle = f64::midpoint(y.start, y.end);
            let (start, end) = (x.start - 1.0, x.end + 1.0);
            self.drive(Point::new(start, middle - KEEP_RIGHT), Point::new(end, middle - KEEP_RIGHT));
            self.drive(Point::new(end, middle + KEEP_RIGHT), Point::new(start, middle + KEEP_RIGHT));
        }
        let shape = Convex::rectangle(x, y);
        let shape = match &self.limits.outline {
            Some(outline) => shape.intersection(outline),
            None => Some(shape),
        };
        if let Some(shape) = shape {
            self.site.state(shape, About::Corridor { region: self.plan.region, aisle, segment });
        }
    }

    fn cross_aisles(&mut self) {
        let depth = self.plan.depth();
        for pair in self.plan.segment_ranges().windows(2) {
            let middle = f64::midpoint(pair[0].end, pair[1].start);
            let [left, right] = [middle - KEEP_RIGHT, middle + KEEP_RIGHT];
            self.drive(Point::new(right, -1.0), Point::new(right, depth + 1.0));
            self.drive(Point::new(left, depth + 1.0), Point::new(left, -1.0));
        }
    }

    fn drive(&mut self, from: Point, to: Point) {
        self.site.routes.push([from, to]);
    }
}
