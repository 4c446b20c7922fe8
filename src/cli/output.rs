//! Where a command puts what it made.

use std::io::{self, Write as _};
use std::path::Path;

use super::failure::Failure;

/// In place of a file: standard output.
pub(super) const STDOUT: &str = "-";

/// Writes to a file, or to standard output where none is named.
pub(super) fn put(out: Option<&Path>, bytes: &[u8]) -> Result<(), Failure> {
    match out.filter(|file| *file != Path::new(STDOUT)) {
        None => match io::stdout().write_all(bytes) {
            // Who reads may have seen enough.
            Err(error) if error.kind() != io::ErrorKind::BrokenPipe => Err(Failure::internal(error)),
            _ => Ok(()),
        },
        Some(file) => write(file, bytes),
    }
}

/// Writes a file, with the folders that it needs, and prints where it is.
pub(super) fn write(file: &Path, bytes: &[u8]) -> Result<(), Failure> {
    let parent = file.parent().filter(|parent| !parent.as_os_str().is_empty()).unwrap_or(Path::new("."));
    let written = std::fs::create_dir_all(parent).and_then(|()| std::fs::write(file, bytes));
    written.map_err(|error| {
        Failure::Input(format!("{} cannot be written ({error}): name another place with --out", file.display()))
    })?;
    println!("{}", file.display());
    Ok(())
}
