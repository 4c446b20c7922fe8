//! A deployment moves to another database and other blobs, and the move is cut off.

use std::io::Read;
use std::process::{Command, Stdio};

use crate::audit::Ledger;
use crate::deployment::Deployment;
use crate::server::{Server, map_message};
use crate::settings::PATIENCE;

/// `stillage migrate` from one deployment to the other.
fn command(from: &Deployment, to: &Deployment) -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_stillage"));
    let blobs = format!("file://{}", to.folder().join("blobs").display());
    command.args(["migrate", "--from", &format!("sqlite:{}", from.folder().display())]);
    command.args(["--to", to.database().expect("a server"), "--to-blobs", &blobs]);
    command
}

/// The number before these words in a text.
fn number_before(words: &str, text: &str) -> u64 {
    let before = text.split(words).next().filter(|before| before.len() < text.len());
    before.and_then(|before| before.rsplit([' ', '\r']).next()?.parse().ok()).expect("a number comes before the words")
}

#[test]
fn a_move_that_is_cut_off_goes_on_and_counts_what_it_moved() {
    let Some(to) = Deployment::shared() else { return };
    let from = Deployment::embedded();
    let mut ledger = Ledger::default();
    let server = Server::start(&from, None, &[]).expect("it starts");
    for index in 0..12 {
        let key = index.to_string();
        ledger.accepted(&key, &server.upload(&map_message(index), &key).expect("accepted"));
    }
    server.wait_until_idle(PATIENCE);
    server.stop();

    let mut cut_off = command(&from, &to).stderr(Stdio::piped()).spawn().expect("it runs");
    let mut told = String::new();
    let mut progress = cut_off.stderr.take().expect("it is piped");
    while !told.contains("\r4 maps moved") {
        let mut part = [0; 64];
        let read = progress.read(&mut part).expect("it can be read");
        assert!(read > 0, "it ended before it was cut off: {told}");
        told.push_str(&String::from_utf8_lossy(&part[..read]));
    }
    cut_off.kill().expect("it runs");
    cut_off.wait().expect("it ends");

    let again = command(&from, &to).output().expect("it runs");
    let text = String::from_utf8_lossy(&again.stdout).into_owned();
    assert!(again.status.success(), "{text}");
    let (moved, were_there) = (number_before(" maps moved", &text), number_before(" were there already", &text));
    assert!(were_there >= 4 && moved + were_there == 12, "{text}");
    let rows: Vec<&str> = text.lines().filter(|line| line.contains(" rows at the source")).collect();
    assert!(rows.len() >= 8, "a line for each table: {text}");
    for row in rows {
        let at_source = number_before(" rows at the source", row);
        assert_eq!(at_source, number_before(" at the destination", row), "{row}");
    }
    ledger.check_exactly(&to);
    let third = command(&from, &to).output().expect("it runs");
    assert!(String::from_utf8_lossy(&third.stdout).contains(" 0 maps moved, 12 were there already, 0 blobs"));
}
