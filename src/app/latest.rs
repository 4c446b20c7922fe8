//! The things of a map that were asked for last, by what they were made for.

use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

/// The `KEPT` things that were asked for last, the latest at the end.
#[derive(Debug)]
pub(super) struct Latest<K, V, const KEPT: usize>(Mutex<Vec<(K, Arc<V>)>>);

impl<K, V, const KEPT: usize> Default for Latest<K, V, KEPT> {
    fn default() -> Self {
        Self(Mutex::default())
    }
}

impl<K: PartialEq, V, const KEPT: usize> Latest<K, V, KEPT> {
    /// The thing for a key; it is made where it is not there. Two that ask at once make it twice.
    pub fn get_or_make(&self, key: K, make: impl FnOnce(&K) -> V) -> Arc<V> {
        if let Some(found) = self.find(&key) {
            return found;
        }
        let made = Arc::new(make(&key));
        let mut kept = self.kept();
        kept.push((key, Arc::clone(&made)));
        if kept.len() > KEPT {
            kept.remove(0);
        }
        made
    }

    fn find(&self, key: &K) -> Option<Arc<V>> {
        let mut kept = self.kept();
        let place = kept.iter().position(|(other, _)| other == key)?;
        let found = kept.remove(place);
        let value = Arc::clone(&found.1);
        kept.push(found);
        Some(value)
    }

    /// A panic elsewhere leaves whole entries.
    fn kept(&self) -> MutexGuard<'_, Vec<(K, Arc<V>)>> {
        self.0.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_was_asked_for_longest_ago_is_forgotten() {
        let squares: Latest<u32, u32, 2> = Latest::default();
        let mut made = Vec::new();
        for number in [2, 3, 2, 4, 2, 3] {
            let square = squares.get_or_make(number, |&number| {
                made.push(number);
                number * number
            });
            assert_eq!(*square, number * number);
        }
        assert_eq!(made, [2, 3, 4, 3]);
    }
}
