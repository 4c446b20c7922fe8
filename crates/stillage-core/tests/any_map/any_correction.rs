//! Corrections that nobody would draw: across walls, over one another, off the map, along borders that are there.

use proptest::prelude::*;
use stillage_core::corrections::Correction;
use stillage_core::{GridFrame, Point};

/// A point of a site in the map frame, on a raster that makes things touch now and then.
fn point() -> impl Strategy<Value = Point> {
    let raster = prop_oneof![Just(0.01), Just(1.0)];
    (prop::array::uniform2(-0.5..11.0), raster).prop_map(|(place, raster): ([f64; 2], f64)| {
        let [x, y] = place.map(|side| (side / raster).round() * raster);
        Point::new(x, y)
    })
}

/// A polygon around a point, with corners at growing angles so that most do not cross themselves.
fn ring() -> impl Strategy<Value = Vec<Point>> {
    (point(), prop::collection::vec(0.1..4.0, 3..9)).prop_map(|(center, radii)| {
        let step = std::f64::consts::TAU / radii.len() as f64;
        let corner = |(number, radius): (usize, &f64)| {
            let (sine, cosine) = (step * number as f64).sin_cos();
            Point::new(center.x + radius * cosine, center.y + radius * sine)
        };
        radii.iter().enumerate().map(corner).collect()
    })
}

fn rectangle() -> impl Strategy<Value = [Point; 4]> {
    let angle = prop_oneof![Just(0.0), -3.0..3.0];
    (point(), [0.2_f64..8.0, 0.2_f64..4.0], angle).prop_map(|(corner, [length, depth], angle)| {
        let (sine, cosine) = f64::sin_cos(angle);
        let at = |along: f64, across: f64| {
            Point::new(corner.x + along * cosine - across * sine, corner.y + along * sine + across * cosine)
        };
        [at(0.0, 0.0), at(length, 0.0), at(length, depth), at(0.0, depth)]
    })
}

/// Any correction, in the frame of the sites.
pub fn any_correction() -> impl Strategy<Value = Correction> {
    let label = || prop_oneof![Just("pc".to_owned()), Just("co".to_owned())];
    let drawn = (ring(), label(), prop::option::of(Just("Rack 12".to_owned())));
    let row = (rectangle(), 1_u32..9, 1_u32..3, prop::option::of(label()));
    let door = ([point(), point()], any::<bool>());
    prop_oneof![
        3 => drawn.prop_map(|(ring, label, name)| Correction::Draw { ring, label, name }),
        2 => prop::collection::vec(point(), 2..5).prop_map(|line| Correction::Split { line }),
        2 => prop::collection::vec(point(), 2..4).prop_map(|at| Correction::Merge { at }),
        2 => row.prop_map(|(rectangle, places, layers, label)| Correction::Row {
            rectangle,
            places: Some(places),
            pitch_m: None,
            layers,
            label,
        }),
        2 => ring().prop_map(|ring| Correction::Erase { ring }),
        1 => (point(), label()).prop_map(|(at, label)| Correction::Label { at, label }),
        2 => door.prop_map(|(line, is_open)| Correction::Door { line, is_open }),
        1 => point().prop_map(|at| Correction::Name { at, name: "Cold store".to_owned() }),
    ]
}

/// The list in the map frame of a site.
pub fn on_site(list: &[Correction], frame: &GridFrame) -> Vec<Correction> {
    list.iter().map(|correction| correction.clone().moved(&frame.motion())).collect()
}
