use super::*;
use crate::test_maps::{self};

#[test]
fn zz_report() {
    let mut names: Vec<(String, f64)> = vec![];
    for (n, r) in [("office__halmstad_F5_05", 0.02), ("warehouse__aws_small_005_rotated", 0.05), ("office__pal_office", 0.05), ("warehouse__svl_warehouse_dt_pallets", 0.05)] {
        names.push((n.into(), r));
    }
    if let Ok(dir) = std::env::var("GEN") {
        for e in std::fs::read_dir(dir).unwrap() {
            names.push((e.unwrap().path().to_string_lossy().into_owned(), 0.05));
        }
    }
    names.sort_by(|a, b| a.0.cmp(&b.0));
    for (n, r) in names {
        let Some(grid) = test_maps::real(&n, r) else { return };
        let t = std::time::Instant::now();
        for refine in [false, true] {
            let o = dominant_orientations(&grid, &OrientationOptions { refine, ..Default::default() }, &Watch::unwatched()).unwrap();
            println!("{n} refine {refine}: {:?} {:?}", o.angles.iter().map(|a| (a.to_degrees() * 1000.).round() / 1000.).collect::<Vec<_>>(), t.elapsed());
        }
        let truth = std::path::Path::new(&n).join("truth.geojson");
        if let Ok(text) = std::fs::read_to_string(truth) {
            let mut angs: Vec<&str> = text.split("\"angle_deg\": ").skip(1).map(|s| s.split([',', '}']).next().unwrap()).collect();
            angs.dedup();
            println!("   truth {angs:?}");
        }
    }
}

