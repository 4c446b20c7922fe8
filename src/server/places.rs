//! Which connections are open, and which one makes room for another.

use std::collections::HashMap;
use std::net::IpAddr;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use std::time::Duration;

use tokio::sync::Notify;

use super::waiting::Waiting;

/// How long a connection must have waited for its client before it makes room for another.
const LEAST_WAIT: Duration = Duration::from_secs(1);

/// How many connections there may be.
#[derive(Debug, Clone, Copy)]
pub struct ConnectionLimits {
    /// In all.
    pub in_all: usize,
    /// From one address.
    pub of_address: usize,
}

/// The open connections.
///
/// There is always room for a newcomer: where there are as many as may be, the one that has been waiting for its client longest
/// is closed. It is nobody's loss, or that of somebody who is slow. Only where all are at work the newcomer is refused.
#[derive(Debug)]
pub(super) struct ConnectionPlaces {
    limits: ConnectionLimits,
    open: Mutex<OpenConnections>,
}

#[derive(Debug, Default)]
struct OpenConnections {
    connections: HashMap<u64, OpenConnection>,
    of_address: HashMap<IpAddr, usize>,
    next: u64,
}

#[derive(Debug)]
struct OpenConnection {
    address: IpAddr,
    waiting: Arc<Waiting>,
    close: Arc<Notify>,
}

/// The place of a connection, free again when this is dropped.
#[derive(Debug)]
pub(super) struct ConnectionPlace {
    places: Arc<ConnectionPlaces>,
    id: u64,
    /// What the connection waits for.
    pub(super) waiting: Arc<Waiting>,
    /// Told when the connection has to make room.
    pub(super) close: Arc<Notify>,
}

impl ConnectionPlaces {
    pub(super) fn new(limits: ConnectionLimits) -> Arc<Self> {
        Arc::new(Self { limits, open: Mutex::default() })
    }

    /// A place for a connection from an address; `None` where all others are at work.
    pub(super) fn take(self: &Arc<Self>, address: IpAddr) -> Option<ConnectionPlace> {
        let mut open = self.open();
        let of_address = open.of_address.get(&address).copied().unwrap_or_default();
        if of_address >= self.limits.of_address {
            open.close_one(|connection| connection.address == address)?;
        } else if open.connections.len() >= self.limits.in_all {
            open.close_one(|_| true)?;
        }
        let (waiting, close) = (Arc::new(Waiting::new()), Arc::new(Notify::new()));
        let id = open.next;
        open.next += 1;
        *open.of_address.entry(address).or_default() += 1;
        let connection = OpenConnection { address, waiting: Arc::clone(&waiting), close: Arc::clone(&close) };
        open.connections.insert(id, connection);
        drop(open);
        Some(ConnectionPlace { places: Arc::clone(self), id, waiting, close })
    }

    fn open(&self) -> MutexGuard<'_, OpenConnections> {
        // Every call below leaves the counts whole.
        self.open.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

impl OpenConnections {
    /// Closes the connection of a kind that has been waiting for its client longest.
    fn close_one(&mut self, kind: impl Fn(&OpenConnection) -> bool) -> Option<()> {
        let waits = self.connections.iter().filter(|(_, connection)| kind(connection));
        let waits = waits.filter_map(|(&id, connection)| Some((connection.waiting.time()?, id)));
        let (_, id) = waits.max().filter(|(time, _)| *time >= LEAST_WAIT)?;
        let connection = self.remove(id)?;
        connection.close.notify_one();
        Some(())
    }

    fn remove(&mut self, id: u64) -> Option<OpenConnection> {
        let connection = self.connections.remove(&id)?;
        if let Some(count) = self.of_address.get_mut(&connection.address) {
            *count -= 1;
            if *count == 0 {
                self.of_address.remove(&connection.address);
            }
        }
        Some(connection)
    }
}

impl Drop for ConnectionPlace {
    fn drop(&mut self) {
        self.places.open().remove(self.id);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn address(last: u8) -> IpAddr {
        IpAddr::from([192, 0, 2, last])
    }

    #[test]
    fn a_newcomer_takes_the_place_that_waited_longest_and_none_that_works() {
        let places = ConnectionPlaces::new(ConnectionLimits { in_all: 3, of_address: 3 });
        let [slow, working, late] = [1, 2, 3].map(|last| places.take(address(last)).expect("there is room"));
        assert!(places.take(address(4)).is_none(), "nobody has been waiting for long");
        working.waiting.work();
        std::thread::sleep(LEAST_WAIT);
        late.waiting.begin();
        let newcomer = places.take(address(4)).expect("the first one makes room");
        assert_eq!(Arc::strong_count(&slow.close), 1, "it is told, and forgotten");
        assert!(places.take(address(5)).is_none(), "the others are at work or have just begun");
        drop(newcomer);
        assert!(places.take(address(5)).is_some());
    }

    #[test]
    fn an_address_makes_room_among_its_own_connections() {
        let places = ConnectionPlaces::new(ConnectionLimits { in_all: 3, of_address: 2 });
        let others = places.take(address(1)).expect("there is room");
        let first = places.take(address(2)).expect("there is room");
        // Longer than it takes to look at all of them.
        std::thread::sleep(LEAST_WAIT / 10);
        let _second = places.take(address(2)).expect("there is room");
        assert!(places.take(address(2)).is_none());
        std::thread::sleep(LEAST_WAIT);
        let _third = places.take(address(2)).expect("its own first one makes room");
        assert_eq!((Arc::strong_count(&others.close), Arc::strong_count(&first.close)), (2, 1));
    }
}
