//! Metadata and messages.

use super::*;

// ---- metadata ----

#[test]
fn odd_files_of_the_wild_are_read() {
    let with_image = |path: &str| USUAL.replace("map.png", path);
    check(
        [
            ("plain", read(grey_png(), USUAL)),
            ("CRLF", read(grey_png(), &USUAL.replace('\n', "\r\n"))),
            ("byte order mark", read(grey_png(), &format!("\u{feff}{USUAL}"))),
            ("trailing blanks", read(grey_png(), &USUAL.replace('\n', "  \n"))),
            ("comments", read(grey_png(), &USUAL.replace("0.5]", "0.5]   #The pose\n#origin: [1, 2]"))),
            (
                "as JSON",
                read(
                    grey_png(),
                    r#"{"image": "m", "resolution": 0.05, "origin": [0, 0, 0], "negate": false, "occupied_thresh": 0.65, "free_thresh": 0.196, "mode": "trinary"}"#,
                ),
            ),
            (
                "YAML flow mapping",
                read(
                    grey_png(),
                    "{image: m, resolution: 0.05, origin: [0, 0, 0], negate: no, occupied_thresh: 0.65, free_thresh: 0.196}",
                ),
            ),
            ("origin in block style", read(grey_png(), &USUAL.replace("[-1.0, 2.0, 0.5]", "\n- -1\n- 1.23e+04\n- -0"))),
            ("relative path", read(grey_png(), &with_image("maps/level 1/map.pgm"))),
            ("path of another machine", read(grey_png(), &with_image("/home/giraff/map.pgm"))),
            ("path of the home folder", read(grey_png(), &with_image("~/map.pgm"))),
            ("path upwards", read(grey_png(), &with_image("../../etc/passwd"))),
            ("URL", read(grey_png(), &with_image("http://example.com/map.pgm"))),
            ("resolution in quotes", read(grey_png(), &USUAL.replace("0.05", "\"0.05\""))),
            ("unknown key", read(grey_png(), &format!("{USUAL}map_type: occupancy\n"))),
        ],
        &expect![[r#"
            plain: read
            CRLF: read
            byte order mark: read
            trailing blanks: read
            comments: read
            as JSON: read
            YAML flow mapping: read
            origin in block style: read
            relative path: read
            path of another machine: read, image-path: `image` names a file elsewhere ("/home/giraff/map.pgm"): the image of this upload was used instead
            path of the home folder: read, image-path: `image` names a file elsewhere ("~/map.pgm"): the image of this upload was used instead
            path upwards: read, image-path: `image` names a file elsewhere ("../../etc/passwd"): the image of this upload was used instead
            URL: read, image-path: `image` names a file elsewhere ("http://example.com/map.pgm"): the image of this upload was used instead
            resolution in quotes: read, quoted-number: resolution is a text, "0.05": it was read as the number 0.05; remove the quotes
            unknown key: read, unknown-key: the metadata key `map_type` is not known and was ignored
        "#]],
    );
}

#[test]
fn metadata_that_means_no_map_is_refused_with_a_remedy() {
    let without = |key: &str| {
        USUAL.lines().filter(|line| !line.starts_with(key)).fold(String::new(), |text, line| text + line + "\n")
    };
    let with = |from: &str, to: &str| read(grey_png(), &USUAL.replace(from, to));
    let origin = |origin: &str| with("[-1.0, 2.0, 0.5]", origin);
    let resolution = |resolution: &str| with("0.05", resolution);
    check(
        [
            ("empty", read(grey_png(), "")),
            ("a list", read(grey_png(), "- 1\n- 2\n")),
            ("several maps", read(grey_png(), "maps:\n  level1:\n    origin: [0, 0, 0, 0, 0, 0]\n")),
            ("two documents", read(grey_png(), &format!("{USUAL}---\n{USUAL}"))),
            ("no image", read(grey_png(), &without("image"))),
            ("empty image", with("map.png", "\"\"")),
            ("image is a list", with("map.png", "[a, b]")),
            ("no resolution", read(grey_png(), &without("resolution"))),
            ("resolution 0", resolution("0")),
            ("resolution below 0", resolution("-0.05")),
            ("resolution .nan", resolution(".nan")),
            ("resolution .inf", resolution(".inf")),
            ("resolution 1e999", resolution("1e999")),
            ("resolution in words", resolution("5 cm")),
            ("resolution twice", read(grey_png(), &format!("{USUAL}resolution: 0.1\n"))),
            ("origin of 2", origin("[0, 0]")),
            ("origin of 6", origin("[0, 0, 0, 0, 0, 0]")),
            ("origin a number", origin("0")),
            ("origin with words", origin("[0, here, 0]")),
            ("origin beyond the world", origin("[0, 1e12, 0]")),
            ("yaw -nan", origin("[0, 0, -nan]")),
            ("yaw .nan", origin("[0, 0, .nan]")),
            ("threshold above 1", with("0.65", "65")),
            ("thresholds in reverse", with("0.196", "0.7")),
            ("negate 2", with("negate: 0", "negate: 2")),
            ("no negate", read(grey_png(), &without("negate"))),
            ("mode", read(grey_png(), &format!("{USUAL}mode: costmap\n"))),
            ("alias", read(grey_png(), "image: &a x\nresolution: *a\n")),
            ("broken YAML", read(grey_png(), "image: [a\n")),
            ("broken JSON", read(grey_png(), r#"{"image": "a", "resolution": 1e999}"#)),
        ],
        &expect![[r#"
            empty: Invalid /metadata: the metadata is empty: it needs the keys of a map_server YAML file
            a list: Invalid /metadata: expected keys with values, found a list
            several maps: Invalid /metadata/maps: this file lists several maps: upload each of them on its own, with its own metadata
            two documents: Invalid /metadata: the YAML cannot be read: budget breached: Documents { documents: 2 } at line 7, column 1
            no image: Invalid /metadata/image: `image` is missing
            empty image: Invalid /metadata/image: `image` must name the image file of the map
            image is a list: Invalid /metadata/image: `image` must name the image file of the map
            no resolution: Invalid /metadata/resolution: `resolution` is missing
            resolution 0: Invalid /metadata/resolution: the resolution is 0 m per cell, it must lie between 0.0001 and 100: give the side of a cell in metres
            resolution below 0: Invalid /metadata/resolution: the resolution is -0.05 m per cell, it must lie between 0.0001 and 100: give the side of a cell in metres
            resolution .nan: Invalid /metadata/resolution: resolution must be a finite number, found NaN
            resolution .inf: Invalid /metadata/resolution: resolution must be a finite number, found inf
            resolution 1e999: Invalid /metadata/resolution: resolution must be a finite number, found inf
            resolution in words: Invalid /metadata/resolution: resolution must be a finite number, found "5 cm"
            resolution twice: Invalid /metadata/resolution: `resolution` is given twice: keep one of them
            origin of 2: Invalid /metadata/origin: value of the 'origin' tag should have 3 elements, not 2: write [x, y, yaw] in metres and radians
            origin of 6: Invalid /metadata/origin: value of the 'origin' tag should have 3 elements, not 6: write [x, y, yaw] in metres and radians
            origin a number: Invalid /metadata/origin: `origin` must be a list: [x, y, yaw] in metres and radians
            origin with words: Invalid /metadata/origin/1: the origin's y must be a finite number, found "here"
            origin beyond the world: Invalid /metadata/origin/1: the origin lies 1000000000000 m away, farther than the world is wide: give it in metres of the map frame
            yaw -nan: Invalid /metadata/origin/2: the origin's yaw must be a finite number, found "-nan": map_saver writes `-nan` when the map's orientation was broken; set the third element to the turn of the map in radians, usually 0.0
            yaw .nan: Invalid /metadata/origin/2: the origin's yaw must be a finite number, found NaN: map_saver writes `-nan` when the map's orientation was broken; set the third element to the turn of the map in radians, usually 0.0
            threshold above 1: Invalid /metadata/occupied_thresh: `occupied_thresh` is 65, it must lie between 0 and 1
            thresholds in reverse: Invalid /metadata/free_thresh: the free threshold (0.7) must be below the occupied threshold (0.65)
            negate 2: Invalid /metadata/negate: `negate` must be 0, 1, true or false
            no negate: Invalid /metadata/negate: `negate` is missing
            mode: Invalid /metadata/mode: `mode` must be trinary, scale or raw
            alias: Invalid /metadata: the YAML cannot be read: budget breached: Anchors { anchors: 1 } at line 1, column 11
            broken YAML: Invalid /metadata: the YAML cannot be read: unclosed bracket '[' at line 1, column 8
            broken JSON: Invalid /metadata/resolution: resolution must be a finite number, found inf
        "#]],
    );
}

#[test]
fn documents_made_to_exhaust_are_refused() {
    let keys: String = (0..2_000).fold(String::new(), |text, index| format!("{text}k{index}: 1\n"));
    let deep = |depth: usize| format!("image: {}{}", "[".repeat(depth), "]".repeat(depth));
    let deep_json = format!("{{\"image\": {}{}}}", "[".repeat(20_000), "]".repeat(20_000));
    check(
        [
            ("deep", read(grey_png(), &deep(20))),
            ("very deep", read(grey_png(), &deep(30_000))),
            ("very deep JSON", read(grey_png(), &deep_json)),
            ("many keys", read(grey_png(), &keys)),
            ("long", read(grey_png(), &format!("{USUAL}# {}", "x".repeat(100_000)))),
            ("not UTF-8", {
                let source = MapSource::Image { image: grey_png(), metadata: b"image: \xff".to_vec() };
                decode(&source, &GridOptions::default(), &Limits::default())
            }),
        ],
        &expect![[r#"
            deep: Invalid /metadata: the YAML cannot be read: recursion limit exceeded at line 1, column 24
            very deep: Invalid /metadata: the YAML cannot be read: recursion limit exceeded at line 1, column 24
            very deep JSON: Invalid /metadata: the JSON cannot be read: recursion limit exceeded at line 1 column 137
            many keys: Invalid /metadata: the YAML cannot be read: budget breached: Nodes { nodes: 1001 } at line 500, column 7
            long: Invalid /metadata: the document has 100110 bytes, the most is 65536
            not UTF-8: Invalid /metadata: the document is not UTF-8 text (byte 7): save it as UTF-8
        "#]],
    );
}

// ---- messages ----

#[test]
fn a_message_is_row_major_from_the_lower_left_corner() {
    let map = read_message(MESSAGE).unwrap();
    assert_eq!(picture(&map.grid), "#??\n..#\n");
    let frame = map.grid.frame();
    assert_eq!((frame.resolution, frame.origin.x, frame.origin.y), (0.1, -1.5, 2.0));
    assert!((frame.yaw - std::f64::consts::FRAC_PI_2).abs() < 1e-12);
    assert_eq!(map.warnings, []);
}

#[test]
fn messages_that_contradict_themselves_are_refused() {
    let with = |from: &str, to: &str| {
        assert!(MESSAGE.contains(from));
        read_message(&MESSAGE.replace(from, to))
    };
    check(
        [
            ("no JSON", read_message("nonsense")),
            ("a list", read_message("[]")),
            ("empty", read_message("{}")),
            (
                "no data",
                read_message(&MESSAGE[..MESSAGE.len() - 1].replace(",\n    \"data\": [0, 25, 65, 100, -1, 50]", "}")),
            ),
            ("too few cells", with(", 50]", "]")),
            ("a cell of 101", with("50]", "101]")),
            ("a cell of 1.5", with("50]", "1.5]")),
            ("a cell of null", with("50]", "null]")),
            ("width 0", with("\"width\": 3", "\"width\": 0")),
            ("width -3", with("\"width\": 3", "\"width\": -3")),
            ("width 2.5", with("\"width\": 3", "\"width\": 2.5")),
            ("width 4294967296", with("\"width\": 3", "\"width\": 4294967296")),
            ("width 1e300", with("\"width\": 3", "\"width\": 1e300")),
            (
                "20000 x 20000",
                read_message(&MESSAGE.replace("\"width\": 3, \"height\": 2", "\"width\": 20000, \"height\": 20000")),
            ),
            ("no height", with("\"height\": 2,", "")),
            ("resolution 0", with("0.1", "0")),
            (
                "no orientation",
                with(
                    ",\n            \"orientation\": {\"x\": 0, \"y\": 0, \"z\": 0.7071067811865476, \"w\": 0.7071067811865476}",
                    "",
                ),
            ),
            ("zero quaternion", with("\"z\": 0.7071067811865476, \"w\": 0.7071067811865476", "\"z\": 0, \"w\": 0")),
            ("tilted", with("\"orientation\": {\"x\": 0", "\"orientation\": {\"x\": 0.5")),
            ("a position without y", with("\"y\": 2, ", "")),
        ],
        &expect![[r#"
            no JSON: Invalid : this is no OccupancyGrid message: expected a JSON object with `info` and `data`
            a list: Invalid : this is no OccupancyGrid message: expected a JSON object with `info` and `data`
            empty: Invalid /info: `info` is missing
            no data: Invalid /data: `data` is missing
            too few cells: Invalid /data: `data` has 5 cells, but width x height is 3 x 2 = 6
            a cell of 101: Invalid /data: the OccupancyGrid JSON cannot be read: data[5] is not a whole number from -1 to 100 at line 10 column 37
            a cell of 1.5: Invalid /data: the OccupancyGrid JSON cannot be read: data[5] is not a whole number from -1 to 100 at line 10 column 37
            a cell of null: Invalid /data: the OccupancyGrid JSON cannot be read: invalid type: null, expected a JSON number at line 10 column 37
            width 0: Invalid /info/width: the map is 0 cells wide: a map needs at least one cell
            width -3: Invalid /info/width: `width` is -3, it must be a whole number of cells
            width 2.5: Invalid /info/width: `width` is 2.5, it must be a whole number of cells
            width 4294967296: TooLarge /info/width: the map is 4294967296 cells wide, the most is 32768: crop it, or use a coarser resolution
            width 1e300: TooLarge /info/width: the map is 18446744073709551615 cells wide, the most is 32768: crop it, or use a coarser resolution
            20000 x 20000: TooLarge /info/width: the map has 400000000 cells, the most is 100000000: crop it, or use a coarser resolution
            no height: Invalid /info/height: `height` is missing
            resolution 0: Invalid /info/resolution: the resolution is 0 m per cell, it must lie between 0.0001 and 100: give the side of a cell in metres
            no orientation: read
            zero quaternion: Invalid /info/origin/orientation: the orientation is no rotation (its length is 0): write x 0, y 0, z 0, w 1 for none
            tilted: Invalid /info/origin/orientation: the orientation tilts the map out of the plane: only a turn about z is a map
            a position without y: Invalid /info/origin/position/y: `y` is missing
        "#]],
    );
}
