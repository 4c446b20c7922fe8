//! Routes on a map of the paper's size: how long they take, how long they are, and whether they touch anything.
//! `cargo run --release --example routes -- [radius in metres]`.
//!
//! The map is the one of the example `paper_scale`. A thousand pairs of points are drawn at random from all free cells on
//! which the vehicle fits. Beside each route stands the shortest path over the eight neighbours of cells with the same
//! clearance over drivable faces (Dijkstra over all cells): lengths are told as ratios to it.

#![allow(clippy::print_stdout, reason = "an example prints what it measured")]

mod cells;
#[path = "../paper_scale/clock.rs"]
#[allow(dead_code, reason = "only its costs are used here")]
mod clock;
#[path = "../paper_scale/labelled.rs"]
mod labelled;
#[path = "../paper_scale/site.rs"]
mod site;

use std::time::Instant;

use cells::CellPaths;
use clock::Cost;
use labelled::LabelledSite;
use stillage_core::graph::{NavigationGraph, navigation_graph};
use stillage_core::layout::{LayoutSpec, Location, layout};
use stillage_core::routing::{Preferences, Route, Router, Waypoint};
use stillage_core::{OccupancyGrid, Point, SiteCells, SiteMap};

/// Starts, and goals for each.
const STARTS: usize = 20;
const GOALS: usize = 50;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let radius: f64 = std::env::args().nth(1).map_or(Ok(0.4), |radius| radius.parse())?;
    let LabelledSite { grid, analysis, semantic } = LabelledSite::new()?;
    let (cells, read) = Cost::of(|| SiteCells::of(&grid, &analysis));
    let map = cells.map(&grid, &analysis, &semantic);
    print_cost("cells of faces, clearance", &read);
    let (storage, laid) = Cost::of(|| layout(&map, &LayoutSpec::of(&analysis.options)));
    print_cost("layout", &laid);
    let count = |is: &dyn Fn(&Location) -> bool| storage.locations.iter().filter(|one| is(one)).count();
    println!(
        "{} faces, {} locations: {} without aisle, {} without approach",
        analysis.faces.len() - 1,
        storage.locations.len(),
        count(&|location| location.aisle == 0),
        count(&|location| location.approach.is_none()),
    );
    let (router, made) = Cost::of(|| Router::new(&map, radius));
    print_cost("router", &made);
    let (graph, built) = Cost::of(|| navigation_graph(&map, &storage, &router));
    print_cost("navigation graph", &built);
    println!("{} nodes, {} lanes", graph.nodes.len(), graph.lanes.len());
    print_reach(&map, &router, &graph);
    pairs(&map, &router, radius);
    matrix(&map, &router, &storage.locations);
    Ok(())
}

/// How many places the lanes join to one another, and how many routes do.
fn print_reach(map: &SiteMap<'_>, router: &Router, graph: &NavigationGraph) {
    let mut part: Vec<usize> = (0..graph.nodes.len()).collect();
    // Lanes lead both ways: the smallest number of a part spreads over it.
    while let Some(lane) = graph.lanes.iter().find(|lane| part[lane.from] < part[lane.to]) {
        let mut open = vec![lane.from];
        let number = part[lane.from];
        while let Some(node) = open.pop() {
            let first = graph.lanes.partition_point(|lane| lane.from < node);
            for lane in graph.lanes[first..].iter().take_while(|lane| lane.from == node) {
                if part[lane.to] > number {
                    part[lane.to] = number;
                    open.push(lane.to);
                }
            }
        }
    }
    let served: Vec<usize> = (0..graph.nodes.len()).filter(|&node| graph.nodes[node].location.is_some()).collect();
    let mut sizes = std::collections::BTreeMap::new();
    for &node in &served {
        *sizes.entry(part[node]).or_insert(0_usize) += 1;
    }
    let (&largest, &joined) = sizes.iter().max_by_key(|(_, size)| **size).expect("the map has locations");
    let ends: Vec<Waypoint<'_>> = served.iter().map(|&node| Waypoint::Point(graph.nodes[node].position)).collect();
    let from = served.iter().position(|&node| part[node] == largest).expect("a part has a node");
    let routes = router.matrix(map, &ends[from..=from], &ends)[0].iter().flatten().count();
    println!("{} places, {joined} on lanes that lead to one another, {routes} by routes", served.len());
}

fn print_cost(name: &str, cost: &Cost) {
    println!("{name:<28}{:>9.2} CPU s{:>9.2} s{:>9.0} MiB", cost.cpu_s, cost.wall_s, cost.peak_mib);
}

/// Pseudo-random numbers (xorshift64*, S. Vigna 2016): the same points on every machine.
struct Numbers(u64);

impl Numbers {
    fn below(&mut self, end: usize) -> usize {
        self.0 ^= self.0 >> 12;
        self.0 ^= self.0 << 25;
        self.0 ^= self.0 >> 27;
        (self.0.wrapping_mul(0x2545_F491_4F6C_DD1D) >> 33) as usize % end
    }
}

fn random_point(numbers: &mut Numbers, map: &SiteMap<'_>, radius: f64) -> Point {
    loop {
        let cell = numbers.below(map.grid.cells().len());
        if map.clearance.of_cell(cell) >= radius + 0.01 {
            return map.grid.center(cell % map.grid.width(), cell / map.grid.width());
        }
    }
}

/// Times random pairs and compares them with paths over the cells.
fn pairs(map: &SiteMap<'_>, router: &Router, radius: f64) {
    let mut numbers = Numbers(88_172_645_463_325_252);
    let (mut found, mut failed, mut ratios) = (Vec::new(), Vec::new(), Vec::new());
    let (mut refused, mut touching) = (0, 0);
    for _ in 0..STARTS {
        let start = random_point(&mut numbers, map, radius);
        let paths = CellPaths::from(map, radius, start);
        for goal in (0..GOALS).map(|_| random_point(&mut numbers, map, radius)).collect::<Vec<_>>() {
            let clock = Instant::now();
            let route = router.route(map, &Waypoint::Point(start), &Waypoint::Point(goal), &Preferences::default());
            let seconds = clock.elapsed().as_secs_f64();
            let best = paths.length_to(map, goal);
            let Ok(route) = route else {
                failed.push(seconds);
                refused += usize::from(best.is_some());
                continue;
            };
            found.push(seconds);
            touching += usize::from(touches(map.grid, &route, radius));
            ratios.extend(best.filter(|&best| best > 1.0).map(|best| route.length / best));
        }
    }
    print_times("routes", &mut found);
    print_times("pairs without a route", &mut failed);
    ratios.sort_by(f64::total_cmp);
    println!(
        "lengths over those of {} paths of cells: mean {:.4}, p99 {:.4}, max {:.4}",
        ratios.len(),
        ratios.iter().sum::<f64>() / ratios.len() as f64,
        share(&ratios, 0.99),
        share(&ratios, 1.0)
    );
    println!("{refused} refused that the cells can drive, {touching} touch something");
}

/// The value that a share of sorted values does not exceed.
fn share(values: &[f64], share: f64) -> f64 {
    values.get((values.len().saturating_sub(1) as f64 * share) as usize).copied().unwrap_or(f64::NAN)
}

fn print_times(name: &str, seconds: &mut [f64]) {
    seconds.sort_by(f64::total_cmp);
    let [half, most, all] = [0.5, 0.99, 1.0].map(|part| 1e3 * share(seconds, part));
    println!("{} {name}: p50 {half:.2} ms, p99 {most:.2} ms, max {all:.2} ms", seconds.len());
}

/// Whether a disc of a radius touches an obstacle anywhere along a path: cell by cell, at points a quarter of a cell apart.
fn touches(grid: &OccupancyGrid, route: &Route, radius: f64) -> bool {
    route.path.windows(2).any(|pair| {
        let steps = ((pair[1] - pair[0]).norm() / (grid.resolution() / 4.0)).ceil() as usize;
        (0..=steps).any(|step| {
            cells::disc_touches(grid, pair[0] + (pair[1] - pair[0]) * (step as f64 / steps.max(1) as f64), radius)
        })
    })
}

/// Times a matrix between locations and compares some of it with routes.
fn matrix(map: &SiteMap<'_>, router: &Router, locations: &[Location]) {
    const SIDE: usize = 100;
    let step = (locations.len() / SIDE).max(1);
    let ends: Vec<Waypoint<'_>> = locations.iter().step_by(step).take(SIDE).map(Waypoint::Location).collect();
    let (lengths, cost) = Cost::of(|| router.matrix(map, &ends, &ends));
    print_cost("matrix", &cost);
    let mut ratios: Vec<f64> = Vec::new();
    for (row, from) in lengths.iter().zip(&ends).step_by(10) {
        for (length, to) in row.iter().zip(&ends) {
            let route = router.route(map, from, to, &Preferences::default());
            if let (Some(length), Ok(route)) = (length, route)
                && route.length > 1.0
            {
                ratios.push(length / route.length);
            }
        }
    }
    ratios.sort_by(f64::total_cmp);
    let missing = lengths.iter().flatten().filter(|length| length.is_none()).count();
    println!(
        "{} x {} ends, {missing} without a way; over those of routes: {:.4} to {:.4}",
        ends.len(),
        ends.len(),
        ratios[0],
        ratios[ratios.len() - 1]
    );
}
