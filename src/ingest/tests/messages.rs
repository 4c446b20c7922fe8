//! Messages, as robots and their clients hold them.

use super::*;

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
            no JSON: Invalid : this is no OccupancyGrid message: expected an object with `info` and `data`, as JSON or as the YAML of `topic echo`
            a list: Invalid : this is no OccupancyGrid message: expected an object with `info` and `data`, as JSON or as the YAML of `topic echo`
            empty: Invalid : there is no OccupancyGrid message: send the object that has `info` and `data`, alone or as the member `msg`, `map` or `values` of the answer it came in
            no data: Invalid /data: `data` is missing
            too few cells: Invalid /data: `data` has 5 cells, but width x height is 3 x 2 = 6
            a cell of 101: Invalid /data: data[5] is 101, it must be a whole number from -1 to 100
            a cell of 1.5: Invalid /data: data[5] is 1.5, it must be a whole number from -1 to 100
            a cell of null: Invalid /data: data[5] is empty, it must be a whole number from -1 to 100
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

/// The message with another member `data`.
fn with_data(data: &str) -> Result<DecodedMap, IngestError> {
    read_message(&MESSAGE.replace("[0, 25, 65, 100, -1, 50]", data))
}

#[test]
fn messages_are_read_in_what_clients_wrap_around_them() {
    for envelope in [
        r#"{"op": "publish", "topic": "/map", "msg": MESSAGE}"#,
        r#"{"op": "service_response", "service": "/static_map", "values": {"map": MESSAGE}, "result": true}"#,
        r#"{"map": MESSAGE}"#,
    ] {
        let map = read_message(&envelope.replace("MESSAGE", MESSAGE)).unwrap();
        assert_eq!(picture(&map.grid), "#??\n..#\n", "{envelope}");
    }
    let broken = MESSAGE.replace("0.1", "0");
    check(
        [
            ("wrong inside", read_message(&format!(r#"{{"op": "publish", "msg": {broken}}}"#))),
            (
                "a failed service",
                read_message(r#"{"op": "service_response", "values": "no map yet", "result": false}"#),
            ),
            ("another message", read_message(r#"{"op": "publish", "topic": "/pose", "msg": {"pose": {"x": 1}}}"#)),
        ],
        &expect![[r#"
            wrong inside: Invalid /msg/info/resolution: the resolution is 0 m per cell, it must lie between 0.0001 and 100: give the side of a cell in metres
            a failed service: Invalid : there is no OccupancyGrid message: send the object that has `info` and `data`, alone or as the member `msg`, `map` or `values` of the answer it came in
            another message: Invalid : there is no OccupancyGrid message: send the object that has `info` and `data`, alone or as the member `msg`, `map` or `values` of the answer it came in
        "#]],
    );
}

#[test]
fn cells_are_read_in_every_form_that_clients_hold_them_in() {
    for data in [
        "[0, 25.0, 65, 1e2, -1, 50]",
        "[0, 25, 65, 100, 255, 50]",
        r#"{"0": 0, "1": 25, "2": 65, "3": 100, "4": -1, "5": 50}"#,
        r#"{"type": "Buffer", "data": [0, 25, 65, 100, 255, 50]}"#,
        r#""ABlBZP8y""#,
    ] {
        assert_eq!(picture(&with_data(data).unwrap().grid), "#??\n..#\n", "{data}");
    }
    check(
        [
            ("a gap", with_data(r#"{"0": 0, "2": 65}"#)),
            ("base64 of other values", with_data(r#""ABlBZH8y""#)),
            ("no base64", with_data(r#""many cells""#)),
            ("a long text among cells", with_data(&format!("[0, \"{}\"]", "x".repeat(1_000)))),
            ("a list of lists", with_data("[[0, 25, 65], [100, -1, 50]]")),
            ("true", with_data("true")),
        ],
        &expect![[r#"
            a gap: Invalid /data: data[1] is missing: an object in place of the list needs every index
            base64 of other values: Invalid /data: data[4] is 127, it must be a whole number from -1 to 100
            no base64: Invalid /data: data[0] is missing: `data` is a text, and not the base64 of the cells' bytes
            a long text among cells: Invalid /data: data[1] is "xxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxx...", it must be a whole number from -1 to 100
            a list of lists: Invalid /data: data[0] is a list, it must be a whole number from -1 to 100
            true: Invalid /data: `data` must be a list of whole numbers from -1 to 100, or their bytes as base64
        "#]],
    );
}

#[test]
fn numbers_that_are_none_do_no_harm_where_nothing_needs_them() {
    let with = |from: &str, to: &str| read_message(&MESSAGE.replace(from, to));
    check(
        [
            ("NaN in z", with("\"z\": 0}", "\"z\": NaN}")),
            ("-Infinity in the header", with("\"sec\": 1,", "\"sec\": -Infinity,")),
            ("NaN in a text", with("\"map\"", "\"NaN \\\" NaN\"")),
            ("NaN in x", with("\"x\": -1.5", "\"x\": NaN")),
            ("NaN in the resolution", with("0.1", "nan")),
            ("NaN in a cell", with("100,", "NaN,")),
            ("another word", with("0.1", "null_resolution")),
        ],
        &expect![[r#"
            NaN in z: read
            -Infinity in the header: read
            NaN in a text: read
            NaN in x: Invalid /info/origin/position/x: x must be a finite number, found "NaN"
            NaN in the resolution: Invalid /info/resolution: resolution must be a finite number, found "nan"
            NaN in a cell: Invalid /data: data[3] is "NaN", it must be a whole number from -1 to 100
            another word: Invalid : this is no JSON from line 4, column 70 on: send the message as JSON
        "#]],
    );
}

#[test]
fn ones_are_occupied_where_no_value_is_above() {
    let data = "[0, 1, 0, -1, 1, 0]";
    let map = with_data(data).unwrap();
    assert_eq!((picture(&map.grid).as_str(), map.warnings[0].code.as_str()), ("?#.\n.#.\n", "ones-occupied"));
    let source = MapSource::Message(MESSAGE.replace("[0, 25, 65, 100, -1, 50]", data).into_bytes());
    let per_cent = GridOptions { semantics: GridSemantics::Nav2, ..GridOptions::default() };
    let map = decode(&source, &per_cent, &Limits::default()).unwrap();
    assert_eq!((picture(&map.grid).as_str(), map.warnings.len()), ("?..\n...\n", 0));
}

/// What `ros2 topic echo --full-length --once` prints; `DATA` stands for the cells.
const ECHO: &str = "header:
  stamp:
    sec: 1
    nanosec: 2
  frame_id: map
info:
  resolution: 0.1
  width: 3
  height: 2
  origin:
    position:
      x: -1.5
      y: 2.0
      z: .nan
    orientation: {x: 0.0, y: 0.0, z: 0.0, w: 1.0}
data:DATA
---
";

#[test]
fn what_topic_echo_prints_is_read() {
    let echo = |data: &str| ECHO.replace("DATA", data);
    for text in [
        echo(" [0, 25, 65, 100, -1, 50]"),
        echo("\n- 0\n- 25\n- 65\n- 100\n- -1\n- 50"),
        echo("\n  - 0\n  - 25\n  - 65\n  - 100\n  - -1\n  - 50").replace('\n', "\r\n"),
        echo(" [0, 25, 65,\n  100, -1, 50]") + &echo(" [0]"),
        format!("data: [0, 25, 65, 100, -1, 50]\n{}", echo("").replace("data:\n", "")),
    ] {
        let map = read_message(&text).unwrap_or_else(|error| panic!("{error}: {text}"));
        assert_eq!((picture(&map.grid).as_str(), map.grid.frame().origin.x), ("#??\n..#\n", -1.5), "{text}");
    }
    check(
        [
            ("cut", read_message(&echo("\n- 0\n- 25\n- '...'"))),
            ("cut in brackets", read_message(&echo(" [0, 25, ...]"))),
            ("without cells", read_message(&echo(" '<array type: int8[6]>'"))),
            ("interrupted", read_message(&echo(" [0, 25, 6").replace("---\n", ""))),
            ("a word", read_message(&echo("\n- 0\n- many"))),
            ("no width", read_message(&echo(" [0]").replace("  width: 3\n", ""))),
            ("metadata of an image", read_message(USUAL)),
        ],
        &expect![[r#"
            cut: Invalid /data: the message is cut after 2 cells, as `topic echo` does: print it whole, with `ros2 topic echo --full-length --once`
            cut in brackets: Invalid /data: the message is cut after 2 cells, as `topic echo` does: print it whole, with `ros2 topic echo --full-length --once`
            without cells: Invalid /data: the message was printed without its cells: leave out --no-arr
            interrupted: Invalid /data: `data` has 3 cells, but width x height is 3 x 2 = 6
            a word: Invalid /data: data[1] is "many", it must be a whole number from -1 to 100
            no width: Invalid /info/width: `width` is missing
            metadata of an image: Invalid : this is no OccupancyGrid message: expected an object with `info` and `data`, as JSON or as the YAML of `topic echo`
        "#]],
    );
}
