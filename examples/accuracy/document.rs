//! A Markdown document with sections between marks, which a program may write anew.

use std::fs;
use std::path::{Path, PathBuf};

use crate::Outcome;

/// A document whose sections stand between `<!-- NAME -->` and `<!-- end -->`.
pub struct Document {
    path: PathBuf,
    text: String,
}

impl Document {
    pub fn read(path: &Path) -> Outcome<Self> {
        let text = fs::read_to_string(path).map_err(|error| format!("{}: {error}", path.display()))?;
        fs::create_dir_all(path.with_extension(""))?;
        Ok(Self { path: path.to_owned(), text })
    }

    /// Replaces a section; a document without it is an error, so that no figure is measured in vain.
    pub fn fill(&mut self, section: &str, content: &str) -> Outcome<()> {
        const END: &str = "<!-- end -->";
        let mark = format!("<!-- {section} -->");
        let missing = || format!("{}: no section between {mark} and {END}", self.path.display());
        let start = self.text.find(&mark).ok_or_else(missing)? + mark.len();
        let length = self.text[start..].find(END).ok_or_else(missing)?;
        self.text.replace_range(start..start + length, &format!("\n{}\n", content.trim_end()));
        Ok(())
    }

    pub fn write(&self) -> Outcome<()> {
        Ok(fs::write(&self.path, &self.text)?)
    }
}
