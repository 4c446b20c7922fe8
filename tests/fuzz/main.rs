//! What the targets of `cargo fuzz` keep, given to the same functions: what was found once is not found again.

#![allow(clippy::panic, reason = "a test is read from top to bottom: no detours")]

use std::fs;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::Path;

#[path = "../../fuzz/src/lib.rs"]
mod inputs;

#[test]
fn what_is_kept_is_read_or_refused_in_few_words() {
    let corpus = Path::new(env!("CARGO_MANIFEST_DIR")).join("fuzz/corpus");
    let mut wrong = Vec::new();
    for (name, read) in inputs::TARGETS {
        let files = fs::read_dir(corpus.join(name)).expect("every target has its folder");
        let files: Vec<_> = files.map(|file| file.expect("can be listed").path()).collect();
        assert!(files.len() > 2, "{name} keeps {} files", files.len());
        for file in files {
            let bytes = fs::read(&file).expect("can be read");
            if catch_unwind(AssertUnwindSafe(|| read(&bytes))).is_err() {
                wrong.push(file);
            }
        }
    }
    assert!(wrong.is_empty(), "{wrong:?}: what each says is above");
}
