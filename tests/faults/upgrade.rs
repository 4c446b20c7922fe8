//! The folder of an earlier release, whose upgrade is cut off again and again; and its backup by this release before that.

use std::fs;
use std::path::Path;
use std::process::Stdio;
use std::time::Duration;

use rusqlite::Connection;
use rusqlite::types::Value;

use crate::server::stillage;

/// What release 0.1 left (`tests/upgrade` tells what is in it).
fn old_folder() -> tempfile::TempDir {
    let folder = tempfile::tempdir().expect("a temporary folder");
    copy(&Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/upgrade/data-0.1"), folder.path());
    folder
}

fn copy(from: &Path, to: &Path) {
    fs::create_dir_all(to).expect("can be made");
    for entry in fs::read_dir(from).expect("is there").flatten() {
        let target = to.join(entry.file_name());
        if entry.path().is_dir() {
            copy(&entry.path(), &target);
        } else {
            fs::copy(entry.path(), target).expect("can be copied");
        }
    }
}

/// `stillage migrate`, which has to succeed: what it says.
fn migrated(folder: &Path) -> String {
    let output = stillage(&["migrate", "--data"]).arg(folder).output().expect("it runs");
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    String::from_utf8(output.stdout).expect("is text")
}

/// All rows of all tables, but for how long the migrations took.
fn rows(folder: &Path) -> Vec<(String, Vec<Vec<Value>>)> {
    let database = Connection::open(folder.join("stillage.sqlite3")).expect("it opens");
    let list = |sql: &str| {
        let mut statement = database.prepare(sql).expect("is SQL");
        let columns = statement.column_count();
        let row =
            |row: &rusqlite::Row<'_>| (0..columns).map(|column| row.get(column)).collect::<Result<Vec<Value>, _>>();
        statement.query_map([], row).expect("runs").collect::<Result<Vec<_>, _>>().expect("has values")
    };
    let tables =
        list("SELECT name FROM sqlite_schema WHERE type = 'table' AND name NOT LIKE '\\_%' ESCAPE '\\' ORDER BY name");
    let name = |row: &Vec<Value>| match &row[0] {
        Value::Text(name) => name.clone(),
        other => panic!("{other:?} is no name"),
    };
    tables
        .iter()
        .map(name)
        .map(|table| (table.clone(), list(&format!("SELECT * FROM {table} ORDER BY 1, 2"))))
        .collect()
}

#[test]
fn an_upgrade_that_is_cut_off_goes_on_and_ends_the_same() {
    let whole = old_folder();
    let said = migrated(whole.path());
    let expected = rows(whole.path());
    assert!(expected.iter().any(|(table, rows)| table == "maps" && rows.len() == 4), "{expected:?}");
    let mut cut_off = 0;
    for round in 0..24_u64 {
        let folder = old_folder();
        for attempt in 0..3 {
            let mut command = stillage(&["migrate", "--data"]);
            let mut process =
                command.arg(folder.path()).stdout(Stdio::null()).stderr(Stdio::null()).spawn().expect("runs");
            std::thread::sleep(Duration::from_millis((round * 5 + attempt * 3) % 120));
            let _ = process.kill();
            cut_off += usize::from(!process.wait().expect("it ends").success());
        }
        assert!(migrated(folder.path()).ends_with(said.rsplit(' ').next().expect("a version")));
        assert_eq!(rows(folder.path()), expected, "round {round}");
    }
    assert!(cut_off > 10, "{cut_off}");
}

#[test]
fn a_folder_of_an_earlier_release_is_backed_up_before_its_upgrade() {
    let (old, new) = (old_folder(), tempfile::tempdir().expect("a temporary folder"));
    let (backup, restored) = (new.path().join("backup"), new.path().join("restored"));
    let before = rows(old.path());
    let output = stillage(&["backup", "--data"]).arg(old.path()).arg("--to").arg(&backup).output().expect("it runs");
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    assert!(String::from_utf8_lossy(&output.stdout).contains("4 maps"));
    assert_eq!(rows(old.path()), before, "it was not upgraded");
    let output = stillage(&["restore", "--from"]).arg(&backup).arg("--data").arg(&restored).output().expect("it runs");
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    assert_eq!(rows(&restored), before);
    migrated(old.path());
    migrated(&restored);
    assert_eq!(rows(&restored), rows(old.path()));
}
