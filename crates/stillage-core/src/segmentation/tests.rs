use super::*;
use crate::test_maps;

#[test]
fn zz_report() {
    let mut names: Vec<(String, f64)> = vec![];
    for (n, r) in [("office__halmstad_F5_05", 0.02), ("warehouse__aws_small_005_rotated", 0.05), ("office__pal_office", 0.05), ("warehouse__svl_warehouse_dt_pallets", 0.05)] {
        names.push((n.into(), r));
    }
    if let Ok(list) = std::env::var("NAMES") {
        for e in list.split(',') { names.push((e.into(), 0.05)); }
    }
    if let Ok(dir) = std::env::var("GEN") {
        for e in std::fs::read_dir(dir).unwrap() {
            names.push((e.unwrap().path().to_string_lossy().into_owned(), 0.05));
        }
    }
    names.sort_by(|a, b| a.0.cmp(&b.0));
    for (n, r) in names {
        let Some(grid) = test_maps::real(&n, r) else { return };
        let options = AnalysisOptions::default();
        let t = std::time::Instant::now();
        let map = segment(&grid, &Orientations::default(), &options, &Watch::unwatched()).unwrap();
        println!("{n}: {} regions {:?}", map.regions.len(), t.elapsed());
        for region in &map.regions {
            println!("    {:.3} {:?} {:?}", region.share, region.orientations.iter().map(|a| (a.to_degrees() * 1000.).round() / 1000.).collect::<Vec<_>>(), region.bounds);
        }
        if let Ok(dump) = std::env::var("DUMP") {
            let mut text = format!("{} {} {}\n", map.tile_cells, map.columns, map.rows);
            for row in map.tiles.chunks(map.columns.max(1)) {
                text += &row.iter().map(|t| t.to_string()).collect::<Vec<_>>().join(" ");
                text.push('\n');
            }
            std::fs::write(std::path::Path::new(&dump).join(std::path::Path::new(&n).file_name().unwrap()), text).unwrap();
        }
    }
}
