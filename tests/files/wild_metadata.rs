//! Metadata files exactly as they were found.

use expect_test::{Expect, expect};
use stillage::ingest::{Limits, MapSource, decode};
use stillage_core::spec::GridOptions;

use crate::shared;

/// A white pixel.
const IMAGE: &[u8] = b"P5 1 1 255 \xff";

fn check(file: &str, expected: Expect) {
    let Some(folder) = shared("maps/dev/wild_yaml") else { return };
    let metadata = std::fs::read(folder.join(file)).unwrap();
    let source = MapSource::Image { image: IMAGE.to_vec(), metadata };
    let answer = match decode(&source, &GridOptions::default(), &Limits::default()) {
        Ok(map) => {
            let frame = map.grid.frame();
            let warnings: Vec<&str> = map.warnings.iter().map(|warning| warning.code.as_str()).collect();
            format!(
                "{} m, origin {} {}, yaw {}, {warnings:?}",
                frame.resolution, frame.origin.x, frame.origin.y, frame.yaw
            )
        }
        Err(error) => format!("{} {error}", error.pointer),
    };
    expected.assert_eq(&answer);
}

#[test]
fn plain() {
    check("00_maze_virtual_walls.yaml", expect!["0.05 m, origin 0 0, yaw 0, []"]);
}

#[test]
fn blank_after_the_image_name() {
    check("01_UMIC_first_floor.yaml", expect!["0.02 m, origin -26.46 -4.04, yaw 0, []"]);
}

#[test]
fn path_of_another_machine() {
    check("02_movecare_map.yaml", expect![[r#"0.05 m, origin -16.2 -5, yaw 0, ["image-path"]"#]]);
}

#[test]
fn comment_after_the_origin() {
    check("03_UMA_236.yaml", expect!["0.05 m, origin -8.325 -46.575, yaw 0, []"]);
}

#[test]
fn commented_alternatives() {
    check("04_map.yaml", expect!["0.05 m, origin -5.5 -5, yaw 0, []"]);
}

#[test]
fn unknown_key() {
    check("05_map_circular.yaml", expect![[r#"0.05 m, origin -10 -10, yaw 0, ["unknown-key"]"#]]);
}

#[test]
fn several_levels() {
    check(
        "06_bwi_test_world.multi_level.yaml",
        expect!["/metadata/maps this file lists several maps: upload each of them on its own, with its own metadata"],
    );
}
