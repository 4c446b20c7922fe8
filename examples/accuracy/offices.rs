//! Offices: where a person sees no storage, there is none; doors are counted.

use std::path::PathBuf;

use rayon::prelude::*;
use stillage_core::geometry::polygon;
use stillage_core::{AnalysisSpec, Occupancy};

use crate::tables::{mean, percent, table};
use crate::{Arguments, Outcome, sites};

/// Maps of offices, by the beginnings of their names.
const OFFICES: [&str; 2] = ["bormann__", "office__"];

struct Office {
    name: String,
    /// Area of storage by that of the known ground.
    storage: f64,
    doors: usize,
    places: usize,
    faces: usize,
}

/// The table of the offices whose names hold a text.
pub fn offices(arguments: &Arguments) -> Outcome<String> {
    let folder = arguments.shared.join("maps/dev");
    let names = sites::names(&folder, "")?;
    let is_office =
        |name: &&String| OFFICES.iter().any(|sort| name.starts_with(sort)) && name.contains(&arguments.only);
    let mut paths = Vec::new();
    for name in names.iter().filter(is_office) {
        let folder = folder.join(name);
        paths.push((name.clone(), None));
        if folder.join("map_furnished.png").is_file() {
            paths.push((format!("{name}, furnished"), Some(folder.join("map_furnished.png"))));
        }
    }
    let read = |(name, image): &(String, Option<PathBuf>)| -> Outcome<Office> {
        let metadata = folder.join(name.trim_end_matches(", furnished")).join("map.yaml");
        let site = match image {
            Some(image) => sites::read_image(image, &metadata)?,
            None => sites::read(&metadata)?,
        };
        let analysis = sites::analyzed(&site.grid, &AnalysisSpec::default())?;
        arguments.draw(name, &site.grid, &analysis)?;
        let semantic = sites::suggested(&analysis);
        let storage = analysis.subdivision.faces().filter(|&face| semantic.label(face).is_storage());
        let storage: f64 = storage.map(|face| polygon::area(&analysis.subdivision.rings(face))).sum();
        let known = site.grid.cells().len() - site.grid.count(Occupancy::Unknown);
        let known = known as f64 * site.grid.resolution().powi(2);
        let office = Office {
            name: name.replace("__", ": "),
            storage: storage / known.max(f64::MIN_POSITIVE),
            doors: analysis.rooms.doors.len(),
            places: semantic.places.len(),
            faces: analysis.subdivision.faces().count(),
        };
        eprintln!("{:<40} storage {:.3} doors {}", office.name, office.storage, office.doors);
        Ok(office)
    };
    let offices: Vec<Office> = paths.par_iter().map(read).collect::<Outcome<_>>()?;
    let rows = offices.iter().map(|office| {
        let counts = [office.doors, office.places, office.faces].map(|count| count.to_string());
        [&[office.name.clone(), percent(office.storage)][..], &counts].concat()
    });
    let all = vec![
        format!("**all {}**: mean, and how many above 1 %", offices.len()),
        percent(mean(offices.iter().map(|office| office.storage))),
        offices.iter().filter(|office| office.storage > 0.01).count().to_string(),
        String::new(),
        String::new(),
    ];
    Ok(table(&["map", "storage, % of the known ground", "doors", "places", "faces"], rows.chain([all])))
}
