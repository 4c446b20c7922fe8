//! Metadata.

use super::*;

/// 0.05 as `PyYAML` 6 writes `numpy.float64(0.05)` of numpy 1.
const NUMPY_SCALAR: &str = "!!python/object/apply:numpy.core.multiarray.scalar
- !!python/object/apply:numpy.dtype
  args: [f8]
- !!binary |
  mpmZmZmZqT8=";

/// (-10, -7.5, 0) as `PyYAML` 6 writes a list of two scalars of numpy 2 and a number.
const NUMPY_ORIGIN: &str = "
- !!python/object/apply:numpy._core.multiarray.scalar
  - &id001 !!python/object/apply:numpy.dtype
    args: [f8, false, true]
    state: !!python/tuple [3, <, null, null, null, -1, -1, 0]
  - !!binary |
    AAAAAAAAJMA=
- !!python/object/apply:numpy._core.multiarray.scalar
  - *id001
  - !!binary |
    AAAAAAAAHsA=
- 0.0";

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
            ("path of Windows", read(grey_png(), &with_image(r"maps\hall.png"))),
            ("path of Windows in double quotes", read(grey_png(), &with_image(r#""C:\maps\new hall\hall.png""#))),
            ("escaped path in double quotes", read(grey_png(), &with_image(r#""maps\\S\u00fcd.png""#))),
            (
                "origin as Python prints a tuple",
                read(grey_png(), &USUAL.replace("[-1.0, 2.0, 0.5]", "(-1.0, 2.0, 0.5)")),
            ),
            ("anchor and merge key", read(grey_png(), &format!("usual: &a {{mode: scale}}\n<<: *a\n{USUAL}"))),
            ("merge key and an override", read(grey_png(), &format!("usual: &a {{negate: 1}}\n<<: *a\n{USUAL}"))),
            ("numpy scalar", read(grey_png(), &USUAL.replace("0.05", NUMPY_SCALAR))),
            ("numpy scalar, aliased type", read(grey_png(), &USUAL.replace("[-1.0, 2.0, 0.5]", NUMPY_ORIGIN))),
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
            path of Windows: read
            path of Windows in double quotes: read
            escaped path in double quotes: read
            origin as Python prints a tuple: read, tuple-origin: `origin` is the text of a Python tuple: it was read as a list; write [x, y, yaw]
            anchor and merge key: read, unknown-key: the metadata key `usual` is not known and was ignored
            merge key and an override: read, unknown-key: the metadata key `usual` is not known and was ignored
            numpy scalar: read, numpy-number: resolution was written as a numpy scalar: it was read as 0.05; write float(value) instead
            numpy scalar, aliased type: read, numpy-number: the origin's x was written as a numpy scalar: it was read as -10; write float(value) instead
            numpy scalar, aliased type: read, numpy-number: the origin's y was written as a numpy scalar: it was read as -7.5; write float(value) instead
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
            ("resolution hexadecimal", resolution("0x10")),
            ("resolution hexadecimal, in a flow mapping", read(grey_png(), "{image: \"a.png\", resolution: 0x1}")),
            ("resolution octal", resolution("010")),
            ("resolution with underscores", resolution("1_0.5")),
            ("resolution sexagesimal", resolution("1:30")),
            ("origin binary", origin("[0b1, 0, 0]")),
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
            ("alias of nothing", read(grey_png(), "image: *a\n")),
            ("a long text", resolution(&"0.05 ".repeat(1_000))),
            ("another numpy object", resolution("!!python/object/apply:numpy.core.multiarray.scalar [x, y]")),
            ("broken YAML", read(grey_png(), "image: [a\n")),
            ("broken JSON", read(grey_png(), r#"{"image": "a", "resolution": 1e999}"#)),
        ],
        &expect![[r#"
            empty: Invalid /metadata: the metadata is empty: it needs the keys of a map_server YAML file
            a list: Invalid /metadata: expected keys with values, found a list
            several maps: Invalid /metadata/maps: this file lists several maps: upload each of them on its own, with its own metadata
            two documents: Invalid /metadata: the YAML cannot be read: it holds more than one document (line 7, column 1): keep one, without a second `---`
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
            resolution hexadecimal: Invalid /metadata/resolution: resolution is written as "0x10" (hexadecimal), which not all readers take for the same number: write it as a decimal number
            resolution hexadecimal, in a flow mapping: Invalid /metadata/resolution: resolution is written as "0x1" (hexadecimal), which not all readers take for the same number: write it as a decimal number
            resolution octal: Invalid /metadata/resolution: resolution is written as "010" (octal, or a leading zero), which not all readers take for the same number: write it as a decimal number
            resolution with underscores: Invalid /metadata/resolution: resolution is written as "1_0.5" (with underscores), which not all readers take for the same number: write it as a decimal number
            resolution sexagesimal: Invalid /metadata/resolution: resolution is written as "1:30" (sexagesimal), which not all readers take for the same number: write it as a decimal number
            origin binary: Invalid /metadata/origin/0: the origin's x is written as "0b1" (binary), which not all readers take for the same number: write it as a decimal number
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
            alias: Invalid /metadata/resolution: resolution must be a finite number, found "x"
            alias of nothing: Invalid /metadata: the YAML cannot be read: `*` names no anchor (`&`) before it (line 1, column 8): write the value out
            a long text: Invalid /metadata/resolution: resolution must be a finite number, found "0.05 0.05 0.05 0.05 0.05 0.05 0.05 0.05 ..."
            another numpy object: Invalid /metadata/resolution: resolution must be a finite number, found a list
            broken YAML: Invalid /metadata: the YAML cannot be read: it is no YAML that can be read (line 1, column 8): check the indentation, brackets and quotes there, and nest less deep than 16
            broken JSON: Invalid /metadata/resolution: resolution must be a finite number, found inf
        "#]],
    );
}

/// Each line repeats the one before nine times.
const LAUGHS: &str = "a: &a [x, x, x, x, x, x, x, x, x]
b: &b [*a, *a, *a, *a, *a, *a, *a, *a, *a]
c: &c [*b, *b, *b, *b, *b, *b, *b, *b, *b]
image: [*c, *c, *c]
";

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
            ("laughs", read(grey_png(), LAUGHS)),
            ("not UTF-8", {
                let source = MapSource::Image { image: grey_png(), metadata: b"image: \xff".to_vec() };
                decode(&source, &GridOptions::default(), &Limits::default())
            }),
        ],
        &expect![[r#"
            deep: Invalid /metadata: the YAML cannot be read: it is no YAML that can be read (line 1, column 24): check the indentation, brackets and quotes there, and nest less deep than 16
            very deep: Invalid /metadata: the YAML cannot be read: it is no YAML that can be read (line 1, column 24): check the indentation, brackets and quotes there, and nest less deep than 16
            very deep JSON: Invalid /metadata: this is neither JSON nor YAML from line 1, column 137 on
            many keys: Invalid /metadata: the YAML cannot be read: it has more than 1000 values (line 500, column 7): a map_server file has seven
            long: Invalid /metadata: the document has 100110 bytes, the most is 65536
            laughs: Invalid /metadata: the YAML cannot be read: it is no YAML that can be read (line 3, column 40): check the indentation, brackets and quotes there, and nest less deep than 16
            not UTF-8: Invalid /metadata: the document is not UTF-8 text (byte 7): save it as UTF-8
        "#]],
    );
}
