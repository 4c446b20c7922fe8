//! Pictures, read back.

use super::*;

fn read(png: &[u8]) -> ::image::DynamicImage {
    ::image::load_from_memory(png).unwrap()
}

#[test]
fn the_image_is_what_map_saver_writes() {
    let grid = OccupancyGrid::from_ascii("#.\n? \n", 0.05);
    let picture = read(&image(&grid)).into_luma8();
    assert_eq!(picture.dimensions(), (2, 2));
    assert_eq!(picture.into_raw(), [0, 254, 205, 205]);
}

#[test]
fn a_map_without_cells_is_one_pixel() {
    assert_eq!(read(&image(&OccupancyGrid::from_ascii("", 0.05))).into_luma8().dimensions(), (1, 1));
}

#[test]
fn colours_are_all_different() {
    let mut colours: Vec<Colour> = (0..32).map(colour).collect();
    colours.sort_unstable();
    colours.dedup();
    assert_eq!(colours.len(), 32);
}
