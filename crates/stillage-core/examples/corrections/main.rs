//! What corrections cost on a map of the paper's size, beside its analysis:
//! `cargo run --release -p stillage-core --example corrections`.
//!
//! The map is the one of the example `paper_scale`. Each kind is applied alone, as when a person makes one more; then
//! many at once, as a plan of racks is imported or a map is opened again. The beams are those of the default options.

#![allow(clippy::print_stdout, reason = "an example prints what it measured")]

#[path = "../paper_scale/clock.rs"]
#[allow(dead_code, reason = "only its costs are used here")]
mod clock;
#[path = "../paper_scale/site.rs"]
mod site;

use clock::Cost;
use stillage_core::corrections::{self, Corrected, Correction, Outcome};
use stillage_core::{AnalysisOptions, Point, SiteCells, Watch, analyze};

/// Corrections of one kind, one after the other, and how often they are repeated for the least time.
const MANY: usize = 1_000;
const REPEATS: usize = 5;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let grid = site::warehouse([0..site::SIZE[0], 0..site::SIZE[1]]);
    let spec = AnalysisOptions::default().check().expect("the defaults are valid");
    println!("{:<36}{:>9}{:>9}{:>8}{:>8}", "", "CPU s", "wall s", "applied", "faces");
    let (analysis, whole) = Cost::of(|| analyze(&grid, &spec, &Watch::unwatched()));
    let analysis = analysis?;
    print("whole analysis", &whole, "", analysis.faces.len() - 1);
    let cells = SiteCells::of(&grid, &analysis);
    let apply = |list: &[Correction]| corrections::apply(&grid, &analysis, &cells.faces, list);
    let print_list = |name: &str, list: &[Correction], repeats: usize| {
        let runs: Vec<(Corrected, Cost)> = (0..repeats).map(|_| Cost::of(|| apply(list))).collect();
        let Some((corrected, cost)) = runs.iter().min_by(|one, other| one.1.wall_s.total_cmp(&other.1.wall_s)) else {
            return;
        };
        let applied = corrected.outcomes.iter().filter(|outcome| matches!(outcome, Outcome::Applied { .. })).count();
        let count = format!("{applied}/{}", list.len());
        print(name, cost, &count, corrected.analysis.faces.len() - 1);
        if let Some(Outcome::Unfit(problem)) = corrected.outcomes.iter().find(|one| matches!(one, Outcome::Unfit(_))) {
            println!("  unfit: {problem}");
        }
    };

    println!("\none more");
    for (name, correction) in one_of_each() {
        print_list(name, &[correction], REPEATS);
    }
    let before = apply(&one_of_each().map(|(_, correction)| correction));
    let (_, cost) = Cost::of(|| before.and(&grid, &analysis, &cells.faces, &[rack(Point::new(95.0, 131.0))]));
    print("a rack after one of each", &cost, "", before.analysis.faces.len());

    println!("\nmany at once");
    let racks: Vec<Correction> = (0..MANY).map(|number| rack(place(number, 40))).collect();
    print_list("racks of a plan", &racks, 1);
    let splits: Vec<Correction> = (0..MANY / 10).map(|number| split(place(number, 40), 1.0)).collect();
    let drawn_and_split: Vec<Correction> = racks[..MANY / 10].iter().cloned().chain(splits).collect();
    print_list("racks, then each one cut", &drawn_and_split, 1);
    Ok(())
}

fn print(name: &str, cost: &Cost, applied: &str, faces: usize) {
    println!("{name:<36}{:>9.3}{:>9.3}{applied:>8}{faces:>8}", cost.cpu_s, cost.wall_s);
}

/// Corners of racks, in lines of `columns`, on the floor and over the rows of the first field.
fn place(number: usize, columns: usize) -> Point {
    Point::new(12.0 + 4.0 * (number % columns) as f64, 12.0 + 4.0 * (number / columns) as f64)
}

fn corners(low: Point, size: [f64; 2]) -> [Point; 4] {
    [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]]
        .map(|[x, y]: [f64; 2]| Point::new(low.x + x * size[0], low.y + y * size[1]))
}

fn rack(low: Point) -> Correction {
    Correction::Draw { ring: corners(low, [2.7, 1.1]).to_vec(), label: "pc".to_owned(), name: None }
}

/// A line across a rack, some way along it.
fn split(low: Point, along: f64) -> Correction {
    Correction::Split { line: vec![Point::new(low.x + along, low.y - 0.1), Point::new(low.x + along, low.y + 1.2)] }
}

/// One correction of each kind, in the open floor between the fields and in the first field.
fn one_of_each() -> [(&'static str, Correction); 8] {
    let (floor, beside) = (Point::new(95.0, 127.0), Point::new(95.0, 124.0));
    let places = Point::new(40.0, 40.0);
    [
        ("draw a rack", rack(floor)),
        ("split the floor", Correction::Split { line: vec![Point::new(95.0, 8.0), Point::new(95.0, 262.0)] }),
        ("merge two faces", Correction::Merge { at: vec![places, Point::new(places.x + 1.2, places.y)] }),
        (
            "cut a row of 24 places",
            Correction::Row {
                rectangle: corners(floor, [28.8, 1.1]),
                places: Some(24),
                pitch_m: None,
                layers: 1,
                label: Some("pc".to_owned()),
            },
        ),
        ("erase a block", Correction::Erase { ring: corners(places, [8.0, 6.0]).to_vec() }),
        ("label a face", Correction::Label { at: beside, label: "co".to_owned() }),
        ("shut a door", Correction::Door { line: [[91.0, 225.05], [92.2, 225.05]].map(Point::from), is_open: false }),
        ("name a face", Correction::Name { at: beside, name: "Cold store".to_owned() }),
    ]
}
