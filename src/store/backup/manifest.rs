//! What a backup says about itself.

use std::collections::BTreeMap;
use std::fs::{self, File};
use std::io::{self, Write as _};
use std::path::Path;

use jiff::Timestamp;
use serde::{Deserialize, Serialize};

use super::error::BackupError;

/// The file that says what the backup is.
const CONTENTS: &str = "backup.json";

/// The list of the other files.
const CHECKSUMS: &str = "checksums.txt";

/// The layout that this program writes and reads.
const FORMAT: u32 = 1;

/// What a backup is.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "camelCase")]
pub struct BackupContents {
    /// Its layout.
    format: u32,
    /// Version of the program that made it.
    pub program: String,
    /// Schema version of its rows.
    pub schema: i64,
    /// The time of the state of its rows: what came later is not in it.
    pub made: Timestamp,
    /// Maps in it.
    pub maps: u64,
    /// Blobs in it.
    pub blobs: u64,
    /// Bytes of its files, these two lists aside.
    pub bytes: u64,
    /// Blobs that rows name and that were missing or damaged when it was made.
    pub damaged: Vec<String>,
    /// Hash of the list of files.
    checksums: String,
}

/// What [`write()`] is told beside the files.
#[derive(Debug)]
pub(super) struct CopiedRows {
    pub schema: i64,
    pub made: Timestamp,
    pub maps: u64,
    pub damaged: Vec<String>,
}

/// Hash and length of a file.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct Checksum {
    pub hash: String,
    pub bytes: u64,
}

/// Writes both lists; `files` are by their names in the backup, with slashes.
pub(super) fn write(
    folder: &Path,
    rows: CopiedRows,
    blobs: u64,
    files: &BTreeMap<String, Checksum>,
) -> Result<BackupContents, BackupError> {
    let list: String = files.iter().map(|(name, checksum)| format!("{}  {name}\n", checksum.hash)).collect();
    let CopiedRows { schema, made, maps, damaged } = rows;
    let contents = BackupContents {
        format: FORMAT,
        program: env!("CARGO_PKG_VERSION").to_owned(),
        schema,
        made,
        maps,
        blobs,
        bytes: files.values().map(|checksum| checksum.bytes).sum(),
        damaged,
        checksums: blake3::hash(list.as_bytes()).to_hex().to_string(),
    };
    let json = serde_json::to_string_pretty(&contents).expect("has plain members") + "\n";
    for (name, text) in [(CHECKSUMS, &list), (CONTENTS, &json)] {
        write_whole(folder, name, text.as_bytes()).map_err(BackupError::file(&folder.join(name)))?;
    }
    Ok(contents)
}

/// Reads both lists: what the backup is, and the hashes of its files by their names.
pub(super) fn read(folder: &Path) -> Result<(BackupContents, BTreeMap<String, String>), BackupError> {
    let text = |name: &'static str| {
        let path = folder.join(name);
        fs::read_to_string(&path).map_err(|error| match error.kind() {
            io::ErrorKind::NotFound => BackupError::Incomplete { folder: folder.to_owned(), file: name },
            io::ErrorKind::InvalidData => damaged(&path, "it is not text"),
            _ => BackupError::File { path, source: error },
        })
    };
    let damaged_contents = || damaged(&folder.join(CONTENTS), "it is not what was written");
    let json: serde_json::Value = serde_json::from_str(&text(CONTENTS)?).map_err(|_| damaged_contents())?;
    let format = json["format"].as_u64().and_then(|format| u32::try_from(format).ok()).ok_or_else(damaged_contents)?;
    if format > FORMAT {
        return Err(BackupError::Newer { folder: folder.to_owned(), found: format, known: FORMAT });
    }
    let contents: BackupContents = serde_json::from_value(json).map_err(|_| damaged_contents())?;
    let list = text(CHECKSUMS)?;
    let damaged_list = || damaged(&folder.join(CHECKSUMS), "it is not what was written");
    if blake3::hash(list.as_bytes()).to_hex().as_str() != contents.checksums {
        return Err(damaged_list());
    }
    let line = |line: &str| line.split_once("  ").map(|(hash, name)| (name.to_owned(), hash.to_owned()));
    let files: Option<BTreeMap<_, _>> = list.lines().map(line).collect();
    Ok((contents, files.ok_or_else(damaged_list)?))
}

/// The hash of a file.
pub(super) fn checksum(path: &Path) -> io::Result<Checksum> {
    let mut hasher = blake3::Hasher::new();
    let bytes = io::copy(&mut File::open(path)?, &mut hasher)?;
    Ok(Checksum { hash: hasher.finalize().to_hex().to_string(), bytes })
}

pub(super) fn damaged(path: &Path, reason: &str) -> BackupError {
    BackupError::Damaged { file: path.to_owned(), reason: reason.to_owned() }
}

/// Writes a file that gets its name when all of it is on disk.
fn write_whole(folder: &Path, name: &str, bytes: &[u8]) -> io::Result<()> {
    let mut file = tempfile::NamedTempFile::new_in(folder)?;
    file.write_all(bytes)?;
    file.as_file().sync_all()?;
    file.persist(folder.join(name))?;
    Ok(())
}
