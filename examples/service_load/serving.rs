//! This program again in a process of its own, serving on a free port.

use std::io::{BufRead, BufReader};
use std::net::SocketAddr;
use std::path::Path;
use std::process::{Child, Command, Stdio};
use std::time::Duration;

/// A serving process; it ends with this value.
pub struct Serving {
    pub address: SocketAddr,
    process: Child,
}

impl Serving {
    /// Starts it with these arguments and waits for the address in its first line.
    pub fn start(arguments: &[&str]) -> Self {
        Self::start_program(&std::env::current_exe().expect("this program has a path"), arguments)
    }

    /// [`Self::start`] with another program.
    pub fn start_program(program: &Path, arguments: &[&str]) -> Self {
        let mut command = Command::new(program);
        let mut process =
            command.args(arguments).stdout(Stdio::piped()).stderr(Stdio::null()).spawn().expect("it starts");
        let output = process.stdout.take().expect("its output is piped");
        let mut lines = BufReader::new(output).lines().map_while(Result::ok);
        let address = lines.find_map(|line| line.split("://").nth(1)?.split(['/', ' ']).next()?.parse().ok());
        Self { address: address.expect("it tells its address"), process }
    }

    /// User and system time of all its threads so far, those that ended too.
    pub fn cpu(&self) -> Duration {
        let path = format!("/proc/{}/stat", self.process.id());
        let text = std::fs::read_to_string(path).expect("Linux tells the times of processes");
        let after_name = text.rsplit_once(") ").expect("the name is in parentheses").1;
        let ticks: u64 = after_name.split(' ').skip(11).take(2).filter_map(|ticks| ticks.parse::<u64>().ok()).sum();
        // `USER_HZ` is 100 on every Linux.
        Duration::from_millis(ticks * 10)
    }

    /// Its memory that lies in RAM, mebibytes.
    pub fn memory(&self) -> f64 {
        let path = format!("/proc/{}/status", self.process.id());
        let text = std::fs::read_to_string(path).expect("Linux tells the memory of processes");
        let line = text.lines().find_map(|line| line.strip_prefix("VmRSS:")).expect("it lists what lies in RAM");
        let kibibytes: f64 = line.trim().trim_end_matches(" kB").parse().expect("kibibytes");
        kibibytes / 1_024.0
    }
}

impl Drop for Serving {
    fn drop(&mut self) {
        // It may have ended already.
        let _ = self.process.kill();
        let _ = self.process.wait();
    }
}
