//! Files as their readers take them apart.

use stillage_core::Point;

use super::*;
use crate::features::tests::hall_view;
use crate::features::{Collection, features};

/// The `u32` at a place.
fn number(bytes: &[u8], at: usize) -> usize {
    u32::from_le_bytes(bytes[at..at + 4].try_into().unwrap()) as usize
}

/// Where a field of a table lies; `None` where it is left out.
fn field(bytes: &[u8], table: usize, number_of_field: usize) -> Option<usize> {
    let list = table - number(bytes, table);
    let size = u16::from_le_bytes(bytes[list..list + 2].try_into().unwrap()) as usize;
    let slot = 4 + 2 * number_of_field;
    let offset = |at: usize| u16::from_le_bytes(bytes[at..at + 2].try_into().unwrap()) as usize;
    (slot < size).then(|| offset(list + slot)).filter(|&offset| offset > 0).map(|offset| table + offset)
}

/// What a field refers to.
fn target(bytes: &[u8], table: usize, number_of_field: usize) -> usize {
    let at = field(bytes, table, number_of_field).unwrap();
    at + number(bytes, at)
}

fn text(bytes: &[u8], at: usize) -> &str {
    std::str::from_utf8(&bytes[at + 4..at + 4 + number(bytes, at)]).unwrap()
}

#[test]
fn a_file_has_a_header_and_a_buffer_for_each_feature() {
    for wanted in Collection::ALL {
        let all = features(&hall_view(), wanted);
        let file = collection(&PropertySelection::all(wanted), &all, &Transform::map_frame());
        assert_eq!(file[..8], MAGIC);
        let header = &file[8..];
        let root = 4 + number(header, 4);
        assert_eq!(text(header, target(header, root, 0)), wanted.id());
        let columns = target(header, root, 7);
        assert_eq!(number(header, columns), CollectionSchema::of(wanted).properties.len());
        let crs = target(header, root, 10);
        assert_eq!(text(header, target(header, crs, 0)), "EPSG");
        assert_eq!(number(header, field(header, crs, 1).unwrap()), 3857);
        assert_eq!(number(header, field(header, root, 8).unwrap()), all.len());
        let mut at = 4 + number(header, 0);
        let mut buffers = 0;
        while at < header.len() {
            assert_eq!(at % 8, 0, "readers map buffers into memory");
            at += 4 + number(header, at);
            buffers += 1;
        }
        assert_eq!((at, buffers), (header.len(), all.len()));
    }
}

#[test]
fn every_double_is_aligned_and_rings_are_closed() {
    let ring = vec![Point::new(0.0, 0.0), Point::new(1.0, 0.0), Point::new(1.0, 2.0)];
    let shape = Geometry::Polygon(vec![ring]);
    let table = FlatTable(vec![(0, Field::Table(geometry(&shape, FileShape::MultiPolygon, &Transform::map_frame())))]);
    let bytes = buffer(&table);
    let root = 4 + number(&bytes, 4);
    let parts = target(&bytes, target(&bytes, root, 0), 7);
    assert_eq!(number(&bytes, parts), 1);
    let part = parts + 4 + number(&bytes, parts + 4);
    let positions = target(&bytes, part, 1);
    assert_eq!((number(&bytes, positions), (positions + 4) % 8), (8, 0));
    let double = |index: usize| {
        let at = positions + 4 + 8 * index;
        f64::from_le_bytes(bytes[at..at + 8].try_into().unwrap())
    };
    assert_eq!((0..8).map(double).collect::<Vec<_>>(), [0.0, 0.0, 1.0, 0.0, 1.0, 2.0, 0.0, 0.0]);
}
