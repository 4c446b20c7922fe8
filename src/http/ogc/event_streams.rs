//! How many streams of events are open.

use std::collections::HashMap;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

use crate::config::Config;
use crate::http::ClientAddress;
use crate::http::problem::{Problem, ProblemType};

/// When a client may try again that found as many streams as may be, seconds.
const RETRY_AFTER_S: u32 = 10;
/// The share of all streams that one address may have.
const ADDRESS_SHARE: usize = 4;

/// The open streams of events: each holds a connection for as long as its job takes.
#[derive(Debug)]
pub struct EventStreams {
    in_all: usize,
    of_address: usize,
    open: Mutex<HashMap<ClientAddress, usize>>,
}

/// The place of a stream, free again when this is dropped.
#[derive(Debug)]
pub struct StreamPlace {
    streams: Arc<EventStreams>,
    address: ClientAddress,
}

impl EventStreams {
    /// As many as are configured: of one address a quarter, of a trusted proxy all.
    #[must_use]
    pub fn new(config: &Config) -> Arc<Self> {
        let in_all = config.max_event_streams;
        let of_address = if config.trust_proxy { in_all } else { in_all.div_ceil(ADDRESS_SHARE) };
        Arc::new(Self { in_all, of_address, open: Mutex::default() })
    }

    /// A place for a stream.
    ///
    /// # Errors
    /// 503 where there are as many as may be.
    pub fn take(self: &Arc<Self>, address: ClientAddress) -> Result<StreamPlace, Problem> {
        let mut open = self.open();
        let of_address = open.get(&address).copied().unwrap_or_default();
        if of_address >= self.of_address || open.values().sum::<usize>() >= self.in_all {
            let detail = format!(
                "as many streams of events are open as may be: read the job itself, or try again in {RETRY_AFTER_S} s"
            );
            return Err(Problem::new(ProblemType::Overloaded, detail).retry_after(RETRY_AFTER_S));
        }
        open.insert(address, of_address + 1);
        drop(open);
        Ok(StreamPlace { streams: Arc::clone(self), address })
    }

    fn open(&self) -> MutexGuard<'_, HashMap<ClientAddress, usize>> {
        // Every statement on it leaves it whole.
        self.open.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

impl Drop for StreamPlace {
    fn drop(&mut self) {
        let mut open = self.streams.open();
        match open.get_mut(&self.address) {
            Some(count) if *count > 1 => *count -= 1,
            _ => drop(open.remove(&self.address)),
        }
    }
}

#[cfg(test)]
mod tests {
    use std::net::IpAddr;

    use super::*;

    #[test]
    fn an_address_has_a_quarter_and_all_have_no_more_than_there_are() {
        let streams = EventStreams::new(&Config { max_event_streams: 8, ..Config::new("data") });
        let address = |last: u8| ClientAddress(IpAddr::from([192, 0, 2, last]));
        let mut places: Vec<StreamPlace> = (0..2).map(|_| streams.take(address(0)).expect("has room")).collect();
        assert_eq!(streams.take(address(0)).expect_err("is refused").kind(), ProblemType::Overloaded);
        places.extend((1..4).flat_map(|last| [last, last]).map(|last| streams.take(address(last)).expect("has room")));
        assert!(streams.take(address(9)).is_err());
        places.pop();
        assert!(streams.take(address(9)).is_ok());
    }
}
