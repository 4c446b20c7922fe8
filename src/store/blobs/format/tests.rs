//! Bytes of every format that was ever written. `UPDATE_EXPECT=1` writes those of the newest format anew: only right
//! while no release has written it.

use std::path::{Path, PathBuf};

use stillage_core::spec::VehicleWidth;
use stillage_core::{AnalysisOptions, OccupancyGrid, Watch};

use super::*;

/// The plain postcard bytes of a blob with a format byte.
fn plain(blob: &[u8]) -> Vec<u8> {
    zstd::decode_all(&blob[1..]).expect("a frame follows the format byte")
}

fn repository() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

/// A blob of the folder that release 0.1 wrote, by the first digits of its name.
fn of_release_0_1(digits: &str) -> Vec<u8> {
    let folder = repository().join("tests/upgrade/data-0.1/blobs").join(&digits[..2]);
    let files = std::fs::read_dir(folder).expect("the folder is there").map(|entry| entry.expect("a file").path());
    let found: Vec<PathBuf> = files.filter(|path| path.file_name().is_some_and(|name| name == digits)).collect();
    std::fs::read(&found[0]).expect("the blob is there")
}

/// The newest format of a value is that of the bytes in the repository, which can be read.
#[track_caller]
fn check_newest<T: Stored>(name: &str, value: &T) {
    let file = repository().join("tests/upgrade/formats").join(format!("{name}-{}", T::FORMAT));
    if std::env::var_os("UPDATE_EXPECT").is_some() {
        std::fs::write(&file, encode(value)).expect("it can be written");
    }
    let golden = std::fs::read(&file).expect("golden bytes of every format are in the repository");
    assert_eq!(golden[0], T::FORMAT);
    let read: T = decode(&golden).expect("it can be read");
    let same = plain(&encode(&read)) == plain(&golden);
    assert!(same, "the layout of {name} has changed: raise its FORMAT, and read the format before");
}

fn small_grid() -> OccupancyGrid {
    OccupancyGrid::from_ascii(
        "
        ##########
        #........#
        #..####..#
        #........#
        ##########
        ",
        0.5,
    )
}

const UPLOAD_0_1: &str = "060426686cae4f737e027952301b93a040adc6bfbb224e199140e0424683398b";
const ANALYSIS_0_1: &str = "b0771edaf9ae6a4ca4a14d1fd910ab1ed4dcee54b2943a085062bb7d845861e5";

#[test]
fn uploads_of_every_format_are_read() {
    let image = MapSource::Image { image: b"P5 1 1 255 \0".to_vec(), metadata: b"resolution: 0.5".to_vec() };
    check_newest("map-source", &image);
    let bytes = of_release_0_1(UPLOAD_0_1);
    assert_eq!(bytes[..4], [0x28, 0xb5, 0x2f, 0xfd], "no format byte");
    let MapSource::Message(message) = decode(&bytes).expect("it can be read") else { panic!("it is a message") };
    assert!(message.starts_with(br#"{"info": {"resolution": 0.5, "width": 20, "height": 12,"#));
}

/// The options that releases up to 0.1 had where none were given.
fn defaults_of_0_1() -> AnalysisOptions {
    let mut options = AnalysisOptions::default();
    options.decomposition.vehicle_width_m = VehicleWidth::Fixed(1.7);
    options
}

#[test]
fn analyses_of_every_format_are_read() {
    let spec = AnalysisOptions::default().check().expect("the defaults are in range");
    let analysis = stillage_core::analyze(&small_grid(), &spec, &Watch::unwatched()).expect("nothing stops it");
    check_newest("analysis", &analysis);
    let first = std::fs::read(repository().join("tests/upgrade/formats/analysis-1")).expect("it is in the repository");
    assert_eq!(decode::<Analysis>(&first).expect("it can be read").options, defaults_of_0_1());
    let old: Analysis = decode(&of_release_0_1(ANALYSIS_0_1)).expect("it can be read");
    assert_eq!((old.width, old.height, old.options), (20, 12, defaults_of_0_1()));
    assert_eq!(old.faces.len(), old.subdivision.faces().len() + 1, "face 0 is the unbounded one");
}

#[test]
fn what_cannot_be_read_says_why() {
    let refusal = |bytes: &[u8]| decode::<MapSource>(bytes).expect_err("it cannot be read");
    assert_eq!(refusal(&[]), FormatError::Damaged("it is empty".into()));
    let newer = [&[9], &encode(&MapSource::Message(Vec::new()))[1..]].concat();
    let expected = "it was stored by a newer release (format 9, this one reads up to 1): run the newer release";
    assert_eq!(refusal(&newer), FormatError::Unreadable(expected.into()));
    let longer = zstd::encode_all(&[1, 0, 7][..], 3).expect("memory can be written");
    let current = [&[MapSource::FORMAT], longer.as_slice()].concat();
    assert_eq!(refusal(&current), FormatError::Damaged("1 bytes are left over".into()));
    let FormatError::Unreadable(reason) = refusal(&longer) else { panic!("an earlier release may have written it") };
    assert!(reason.ends_with("cannot be read any more: analyse the map again"), "{reason}");
}
