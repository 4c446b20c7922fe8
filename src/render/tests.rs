//! Pictures, read back.

use stillage_core::layout::{self, LayoutSpec};
use stillage_core::semantics::{self, Assignment, RuleSet};
use stillage_core::{AnalysisOptions, SiteCells, Watch};

use super::drawing::Colour;
use super::*;

/// A room with a wall and an unknown corner.
fn room() -> (OccupancyGrid, Analysis) {
    let grid = OccupancyGrid::from_ascii(
        "
        ################
        #......#.......#
        #......#.......#
        #..............#
        #......#.......#
        ##########......
        ",
        0.5,
    );
    let spec = AnalysisOptions::default().check().unwrap();
    let analysis = stillage_core::analyze(&grid, &spec, &Watch::unwatched()).unwrap();
    (grid, analysis)
}

/// The palette indices of a picture.
fn indices(picture: &[u8]) -> Vec<u8> {
    let mut reader = png::Decoder::new(std::io::Cursor::new(picture)).read_info().unwrap();
    let mut pixels = vec![0; reader.output_buffer_size().unwrap()];
    assert_eq!(reader.next_frame(&mut pixels).unwrap().color_type, png::ColorType::Indexed);
    pixels
}

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

#[test]
fn the_index_of_a_pixel_is_its_category_and_one() {
    let (grid, analysis) = room();
    let pixels = indices(&categories(&analysis));
    for (row, pixels) in pixels.chunks(grid.width()).rev().enumerate() {
        for (column, &pixel) in pixels.iter().enumerate() {
            let category = analysis.categories.cells[row * grid.width() + column];
            let is_free = grid.row(row)[column] == Occupancy::Free;
            assert_eq!((pixel > 0, pixel), (is_free, if is_free { category + 1 } else { 0 }));
        }
    }
}

#[test]
fn regions_lie_over_the_map() {
    let (grid, analysis) = room();
    let pixels = indices(&regions(&analysis, &grid));
    // Three shades of each region: free, occupied, unknown.
    let shades: Vec<u8> = pixels.chunks(grid.width()).rev().flatten().map(|pixel| pixel % 3).collect();
    assert_eq!(shades, grid.cells().iter().map(|&cell| cell as u8).collect::<Vec<_>>());
}

#[test]
fn the_semantic_map_is_enlarged_and_has_a_legend() {
    let (grid, analysis) = room();
    let map = semantics::apply(&analysis, &RuleSet::warehouse(), &Assignment::default()).unwrap();
    let cells = SiteCells::of(&grid, &analysis);
    let locations = layout::layout(&cells.map(&grid, &analysis, &map), &LayoutSpec::of(&analysis.options)).locations;
    let picture = semantic_png(&grid, &analysis, &map, &locations);
    assert_eq!(picture, semantic_png(&grid, &analysis, &map, &locations));
    let picture = read(&picture).into_rgb8();
    // 16 x 6 cells, 40 pixels each, and the legend below.
    assert_eq!(picture.width(), 640);
    assert!(picture.height() > 280);
    let wall = picture.get_pixel(100, 20).0;
    assert!(wall.iter().all(|&channel| channel < 60), "walls are dark: {wall:?}");
}

#[test]
fn names_of_labels_are_no_markup() {
    let (grid, analysis) = room();
    let mut draft = RuleSet::warehouse().draft().clone();
    draft.labels[0].name = "</title><script>alert('1 & 2')</script>".to_owned();
    let rule_set = draft.check().unwrap();
    let map = semantics::apply(&analysis, &rule_set, &Assignment::default()).unwrap();
    let svg = String::from_utf8(semantic_svg(&grid, &analysis, &map, &[])).unwrap();
    assert!(svg.contains("&lt;script&gt;"), "{svg}");
    assert!(!svg.contains("<script"), "{svg}");
}

#[test]
fn a_pixel_of_several_cells_shows_their_wall() {
    let grid = OccupancyGrid::from_ascii(
        "
        ??.?#
        ??...
        ....?
        ",
        0.05,
    );
    let rows: Vec<Vec<Occupancy>> = cells::rows(&grid, drawing::Scale::Reduced(2)).collect();
    let [free, wall, unknown] = [Occupancy::Free, Occupancy::Occupied, Occupancy::Unknown];
    assert_eq!(rows, [vec![unknown, free, wall], vec![free, free, unknown]]);
}
