//! The files that commands read.

use std::fmt::Display;
use std::path::{Path, PathBuf};

use serde::de::DeserializeOwned;
use stillage_core::AnalysisSpec;
use stillage_core::corrections::Correction;
use stillage_core::semantics::{Assignment, AssignmentProblem, RuleSet, RuleSetDraft};

use super::failure::Failure;
use crate::coordinates::Transform;
use crate::http::maps::corrections_body::NewCorrectionsBody;
use crate::ingest::{self, IngestError, MapSource};
use crate::options::RequestedOptions;

/// Reads a map: a metadata file with the image it names, or a message.
pub(super) fn map(path: &Path) -> Result<MapSource, Failure> {
    let bytes = read(path)?;
    if ingest::is_message(&bytes) {
        return Ok(MapSource::Message(bytes));
    }
    if image::guess_format(&bytes).is_ok() {
        let message =
            format!("{} is an image: name the YAML file beside it, which says its resolution", path.display());
        return Err(Failure::Input(message));
    }
    let entry = ingest::image_entry(&bytes).map_err(|error| refused(path, &error))?;
    let image_path = image_path(path, &entry);
    let image = std::fs::read(&image_path).map_err(|error| {
        let (metadata, image) = (path.display(), image_path.display());
        Failure::Input(match error.kind() {
            std::io::ErrorKind::NotFound => {
                format!("the image of {metadata}, {image}, is not there: put it beside the YAML file")
            }
            _ => format!("the image of {metadata}, {image}, cannot be opened ({error}): check who may read it"),
        })
    })?;
    Ok(MapSource::Image { image, metadata: bytes })
}

/// Where the image lies: beside the metadata unless the entry is absolute; `~/` is the home folder. Paths of Windows mean
/// the same ones with slashes. A path of another machine is looked for by its file name beside the metadata.
fn image_path(metadata: &Path, entry: &str) -> PathBuf {
    let folder = metadata.parent().unwrap_or(Path::new(""));
    let home = || std::env::home_dir().unwrap_or_default();
    let stated = entry.strip_prefix("~/").map_or_else(|| folder.join(entry), |rest| home().join(rest));
    let slashed = entry.replace('\\', "/");
    let beside = slashed.rsplit('/').next().unwrap_or_default();
    let candidates = [folder.join(&slashed), folder.join(beside)];
    if stated.is_file() { stated } else { candidates.into_iter().find(|path| path.is_file()).unwrap_or(stated) }
}

/// The name of a map: that of its file.
pub(super) fn map_name(path: &Path) -> String {
    path.file_stem().map_or_else(|| "map".to_owned(), |stem| stem.to_string_lossy().into_owned())
}

/// The options in a file, or the defaults.
pub(super) fn options(path: Option<&Path>) -> Result<AnalysisSpec, Failure> {
    let Some(path) = path else { return Ok(AnalysisSpec::default()) };
    let RequestedOptions(options) = read_json(path)?;
    options.check().map_err(|problems| Failure::Input(format!("{}: {}", path.display(), list(&problems))))
}

/// The rule set with a name, or in a file.
pub(super) fn rule_set(name: &str) -> Result<RuleSet, Failure> {
    if let Some((_, built_in)) = RuleSet::all_built_in().into_iter().find(|(id, _)| *id == name) {
        return Ok(built_in);
    }
    let file = Path::new(name);
    if !file.is_file() {
        let message = format!("there is no rule set {name}: name `site`, `warehouse`, `office`, or a JSON file");
        return Err(Failure::Input(message));
    }
    let draft: RuleSetDraft = read_json(file)?;
    draft.check().map_err(|problems| Failure::Input(format!("{name}: {}", list(&problems))))
}

/// The assignment in a file.
pub(super) fn assignment(path: &Path) -> Result<Assignment, Failure> {
    read_json(path)
}

/// The corrections in a file, for a map whose labels are those of a rule set. GeoJSON is in metres of the map.
pub(super) fn corrections(path: &Path, rule_set: &RuleSet) -> Result<Vec<Correction>, Failure> {
    let read = NewCorrectionsBody::read(&read(path)?, rule_set, &Transform::map_frame());
    let corrections = read.and_then(|body| body.checked(rule_set));
    corrections.map_err(|problem| Failure::Input(format!("{}: {}", path.display(), problem.message())))
}

/// A refusal of the ingest, about a file.
pub(super) fn refused(path: &Path, error: &IngestError) -> Failure {
    let place = if error.pointer.is_empty() { String::new() } else { format!(", at `{}`", error.pointer) };
    Failure::Input(format!("{} cannot be read as a map{place}: {error}", path.display()))
}

/// An assignment that names what a map does not have.
pub(super) fn misfit(problems: &[AssignmentProblem]) -> Failure {
    Failure::Input(format!("the assignment does not fit this map: {}", list(problems)))
}

/// Several problems in one sentence.
fn list(problems: &[impl Display]) -> String {
    let texts: Vec<String> = problems.iter().map(ToString::to_string).collect();
    texts.join("; ")
}

fn read(path: &Path) -> Result<Vec<u8>, Failure> {
    std::fs::read(path)
        .map_err(|error| Failure::Input(format!("{} cannot be opened ({error}): check the path", path.display())))
}

/// Something in a JSON file.
pub(super) fn read_json<T: DeserializeOwned>(path: &Path) -> Result<T, Failure> {
    serde_json::from_slice(&read(path)?)
        .map_err(|error| Failure::Input(format!("{} is not the JSON that is expected: {error}", path.display())))
}

/// Reads `NAME=VALUE`.
pub(super) fn name_and_value(text: &str) -> Result<(String, String), &'static str> {
    let (name, value) = text.split_once('=').ok_or("must be NAME=VALUE")?;
    Ok((name.to_owned(), value.to_owned()))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_image_lies_beside_the_metadata() {
        let folder = tempfile::tempdir().unwrap();
        let metadata = folder.path().join("map.yaml");
        std::fs::write(folder.path().join("map.pgm"), b"P5 1 1 255 a").unwrap();
        let found = |entry: &str| image_path(&metadata, entry);
        assert_eq!(found("map.pgm"), folder.path().join("map.pgm"));
        assert_eq!(found("/home/giraff/maps/map.pgm"), folder.path().join("map.pgm"));
        assert_eq!(found("sub/other.pgm"), folder.path().join("sub/other.pgm"));
        assert_eq!(found("D:\\maps\\map.pgm"), folder.path().join("map.pgm"));
        std::fs::create_dir(folder.path().join("maps")).unwrap();
        std::fs::write(folder.path().join("maps/hall.pgm"), b"P5 1 1 255 a").unwrap();
        assert_eq!(found("maps\\hall.pgm"), folder.path().join("maps/hall.pgm"));
    }
}
