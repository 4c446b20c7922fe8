//! Backups of a service that works, and what becomes of damaged and interrupted ones.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Output, Stdio};
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Duration;

use stillage::config::Config;

use crate::server::{Server, body, hall, status, stillage};

/// `stillage backup` of a data folder.
fn back_up(data: &Path, to: &Path) -> Output {
    stillage(&["backup", "--data"]).arg(data).arg("--to").arg(to).output().expect("it runs")
}

/// `stillage restore` of a backup.
fn restore(from: &Path, data: &Path) -> Output {
    stillage(&["restore", "--from"]).arg(from).arg("--data").arg(data).output().expect("it runs")
}

/// `stillage restore --check`: what it says where it refuses, nothing where all is well.
fn fault_of(backup: &Path) -> Option<String> {
    let output = stillage(&["restore", "--check", "--from"]).arg(backup).output().expect("it runs");
    (!output.status.success()).then(|| String::from_utf8_lossy(&output.stderr).into_owned())
}

#[track_caller]
fn succeeds(output: &Output) {
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
}

/// A backup of so many analysed maps, in a folder of its own.
fn a_backup(maps: u64) -> (tempfile::TempDir, PathBuf) {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let (data, backup) = (folder.path().join("data"), folder.path().join("backup"));
    let server = Server::start_in(&data, &[]);
    (0..maps).for_each(|index| assert_eq!(status(&server.upload(&hall(index))), 202));
    server.wait_until_idle();
    succeeds(&back_up(&data, &backup));
    (folder, backup)
}

/// All that a service answers about its maps.
fn answers(server: &Server) -> Vec<String> {
    let of_map = |map: String| {
        let parts =
            ["", "/analyses", "/semantics", "/categories", "/collections/faces/items", "/collections/locations/items"];
        parts.map(|part| format!("/v1/maps/{map}{part}"))
    };
    let paths = ["/v1/maps", "/v1/jobs?limit=1000"].map(str::to_owned);
    let paths = paths.into_iter().chain(server.maps().into_iter().flat_map(of_map));
    paths.map(|path| format!("{path}: {}", body(&server.get(&path)))).collect()
}

#[test]
fn backups_of_a_service_that_works_are_whole_and_answer_the_same() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let data = folder.path().join("data");
    let backup = |index: usize| folder.path().join(format!("backup-{index}"));
    let server = Server::start_in(&data, &["--keep-deleted-minutes", "0"]);
    let is_over = AtomicBool::new(false);
    std::thread::scope(|scope| {
        // Maps come and go, and are analysed, while backups are made.
        scope.spawn(|| {
            for index in 0.. {
                assert_eq!(status(&server.upload(&hall(index % 500))), 202);
                if index % 3 == 2 {
                    delete(&server, &server.maps().pop().expect("some are there"));
                }
                if is_over.load(Ordering::Relaxed) {
                    return;
                }
                std::thread::sleep(Duration::from_millis(50));
            }
        });
        for index in 0..5 {
            std::thread::sleep(Duration::from_millis(400));
            succeeds(&back_up(&data, &backup(index)));
        }
        is_over.store(true, Ordering::Relaxed);
    });
    server.wait_until_idle();
    succeeds(&back_up(&data, &backup(5)));
    let before = answers(&server);
    drop(server);
    for index in 0..6 {
        let restored = folder.path().join(format!("restored-{index}"));
        succeeds(&restore(&backup(index), &restored));
        let server = Server::start_in(&restored, &[]);
        server.wait_until_idle();
        for map in server.maps() {
            assert_eq!(
                status(&server.get(&format!("/v1/maps/{map}/collections/faces/items"))),
                200,
                "{map} has all of it"
            );
        }
        if index == 5 {
            assert_eq!(answers(&server), before);
        }
    }
}

/// A map goes for good.
fn delete(server: &Server, map: &str) {
    let request = format!("DELETE /v1/maps/{map} HTTP/1.1\r\nHost: localhost\r\nConnection: close\r\n\r\n");
    assert!([200, 204].contains(&status(&server.answer(request.as_bytes()))));
}

#[test]
fn blobs_that_are_deleted_while_they_are_copied_are_not_missed() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let (data, backup) = (folder.path().join("data"), folder.path().join("backup"));
    let server = Server::start_in(&data, &["--keep-deleted-minutes", "0"]);
    (0..3).for_each(|index| assert_eq!(status(&server.upload(&hall(index))), 202));
    server.wait_until_idle();
    let is_first = AtomicBool::new(true);
    let config = Config::new(&data);
    let copy = stillage::store::back_up(&config, &backup, |_| {
        // The rows are copied and no blob is.
        if is_first.swap(false, Ordering::Relaxed) {
            delete(&server, &server.maps()[1]);
            assert_eq!(status(&server.upload(&hall(9))), 202);
        }
    });
    let runtime = tokio::runtime::Builder::new_current_thread().enable_all().build().expect("a runtime");
    let contents = runtime.block_on(copy).expect("it succeeds");
    assert_eq!((contents.maps, contents.damaged.as_slice()), (3, [].as_slice()), "two are left, one came");
    assert_eq!(fault_of(&backup), None);
}

#[test]
fn a_blob_that_is_damaged_in_the_store_is_told_and_left_out() {
    let (folder, _) = a_backup(1);
    let (data, backup) = (folder.path().join("data"), folder.path().join("second"));
    let mut blobs = Vec::new();
    list(&data.join("blobs"), &mut blobs);
    let analysis = blobs.iter().max_by_key(|blob| fs::metadata(blob).expect("is there").len()).expect("there are two");
    fs::write(analysis, "half of").expect("can be changed");
    let output = back_up(&data, &backup);
    succeeds(&output);
    let warning = String::from_utf8_lossy(&output.stderr).into_owned();
    let name = analysis.file_name().expect("has one").to_string_lossy();
    assert!(warning.contains(&format!("warning: the blob {name} is missing or damaged")), "{warning}");
    let restored = folder.path().join("restored");
    succeeds(&restore(&backup, &restored));
    let server = Server::start_in(&restored, &[]);
    let faces = format!("/v1/maps/{}/collections/faces/items", server.maps()[0]);
    assert_eq!(status(&server.get(&faces)), 503, "it is made again");
    let begun = std::time::Instant::now();
    while status(&server.get(&faces)) != 200 {
        assert!(begun.elapsed() < Duration::from_mins(1), "its upload is there");
        std::thread::sleep(Duration::from_millis(50));
    }
}

#[test]
fn a_damaged_backup_is_refused_by_the_name_of_the_damaged_file() {
    let (folder, backup) = a_backup(1);
    assert_eq!(fault_of(&backup), None);
    let mut files = Vec::new();
    list(&backup, &mut files);
    assert_eq!(files.len(), 5, "two lists, the rows, an upload and an analysis: {files:?}");
    for file in files {
        let name = file.file_name().expect("has one").to_string_lossy().into_owned();
        let whole = fs::read(&file).expect("is there");
        let mut flipped = whole.clone();
        // In the list of files, a digit of a hash; in that of the backup, the bracket at its beginning.
        flipped[0] ^= 1;
        for damaged in [Some(&flipped[..]), Some(&whole[..whole.len() / 2]), None] {
            match damaged {
                Some(bytes) => fs::write(&file, bytes),
                None => fs::remove_file(&file),
            }
            .expect("can be changed");
            let data = folder.path().join("restored");
            let output = restore(&backup, &data);
            let refusal = String::from_utf8_lossy(&output.stderr).into_owned();
            assert!(output.status.code() == Some(2) && refusal.contains(&name), "{name}: {refusal}");
            assert!(!data.exists(), "nothing was written");
        }
        fs::write(&file, whole).expect("can be changed");
    }
    assert_eq!(fault_of(&backup), None);
}

fn list(folder: &Path, files: &mut Vec<PathBuf>) {
    for entry in fs::read_dir(folder).expect("is there") {
        let path = entry.expect("an entry").path();
        if path.is_dir() { list(&path, files) } else { files.push(path) }
    }
}

#[test]
fn an_interrupted_backup_or_restore_leaves_nothing_that_looks_whole() {
    let (folder, backup) = a_backup(6);
    let data = folder.path().join("data");
    let mut interrupted = [0, 0];
    for round in 0..30 {
        let pause = Duration::from_millis(round * 7);
        let again = folder.path().join(format!("again-{round}"));
        let killed = |arguments: &[&str], from: &Path, flag: &str, to: &Path| {
            let mut command = stillage(arguments);
            command.arg(from).arg(flag).arg(to).stdout(Stdio::null()).stderr(Stdio::null());
            let mut process = command.spawn().expect("it runs");
            std::thread::sleep(pause);
            let _ = process.kill();
            process.wait().expect("it ends").success()
        };
        if !killed(&["backup", "--data"], &data, "--to", &again) && !again.exists() {
            interrupted[0] += 1;
        } else {
            assert_eq!(fault_of(&again), None, "what has the name is whole");
        }
        let restored = folder.path().join(format!("restored-{round}"));
        if !killed(&["restore", "--from"], &backup, "--data", &restored) && restored.exists() {
            interrupted[1] += 1;
            let output = stillage(&["migrate", "--data"]).arg(&restored).output().expect("it runs");
            let said = String::from_utf8_lossy(&output.stderr).into_owned();
            assert!(output.status.success() || said.contains("run the same restore again"), "{said}");
            if !output.status.success() {
                succeeds(&restore(&backup, &restored));
            }
        }
    }
    let unfinished = fs::read_dir(folder.path()).expect("is there").flatten();
    for entry in unfinished.filter(|entry| entry.file_name().to_string_lossy().contains(".unfinished-")) {
        if let Some(fault) = fault_of(&entry.path()) {
            assert!(fault.contains("is not a whole backup"), "not all lists, or all of it: {fault}");
        }
    }
    assert!(interrupted.iter().all(|&count| count > 0), "some were interrupted in their midst: {interrupted:?}");
}

#[test]
fn nothing_is_restored_over_something_and_nothing_backed_up_over_something() {
    let (folder, backup) = a_backup(1);
    let refusal = |output: Output| {
        assert_eq!(output.status.code(), Some(2));
        String::from_utf8_lossy(&output.stderr).into_owned()
    };
    let data = folder.path().join("data");
    assert!(refusal(restore(&backup, &data)).contains("holds something"));
    assert!(refusal(back_up(&data, &backup)).contains("holds something"));
    assert!(refusal(back_up(&folder.path().join("elsewhere"), &folder.path().join("new"))).contains("holds no store"));
    let empty = folder.path().join("empty");
    fs::create_dir(&empty).expect("can be made");
    succeeds(&restore(&backup, &empty));
}

#[test]
fn keys_open_what_was_restored() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let [data, backup, restored] = ["data", "backup", "restored"].map(|name| folder.path().join(name));
    drop(Server::start_in(&data, &[]));
    let created = stillage(&["key", "create", "--tenant", "acme", "--scopes", "read", "--data"]).arg(&data).output();
    let created = created.expect("it runs");
    succeeds(&created);
    let key = String::from_utf8(created.stdout).expect("text").trim().to_owned();
    succeeds(&back_up(&data, &backup));
    succeeds(&restore(&backup, &restored));
    let server = Server::start_in(&restored, &["--keys", "required"]);
    let ask = |key: &str| {
        let request = format!(
            "GET /v1/maps HTTP/1.1\r\nHost: localhost\r\nAuthorization: Bearer {key}\r\nConnection: close\r\n\r\n"
        );
        status(&server.answer(request.as_bytes()))
    };
    assert_eq!([ask(&key), ask(&key.replace(char::is_numeric, "0"))], [200, 401]);
}
