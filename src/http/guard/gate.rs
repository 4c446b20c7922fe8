//! How many requests are worked on, and how many may wait for that.

use std::sync::{Arc, Mutex, PoisonError};

use tokio::sync::{OwnedSemaphorePermit, Semaphore};

use crate::http::problem::{Problem, ProblemType};

/// When a client may try again that found as many requests as may be, seconds.
const RETRY_AFTER_S: u32 = 1;

/// Bounds the requests of a group of routes: so many are worked on, and so many more wait. Further ones are refused at once: a
/// request that waits longer than its client costs the same and helps nobody.
#[derive(Debug)]
pub struct Gate {
    places: Arc<Semaphore>,
    turns: Arc<Semaphore>,
}

impl Gate {
    /// A gate with `turns` requests that are worked on, of `places` in all.
    pub fn new(turns: usize, places: usize) -> Self {
        Self { places: Arc::new(Semaphore::new(places.max(1))), turns: Arc::new(Semaphore::new(turns.max(1))) }
    }

    /// Waits for the turn of a request.
    ///
    /// # Errors
    /// 503 at once where as many wait as may.
    pub async fn turn(&self) -> Result<Turn, Problem> {
        let overloaded = || {
            let detail = format!("as many requests are under way as may be: try again in {RETRY_AFTER_S} s");
            Problem::new(ProblemType::Overloaded, detail).retry_after(RETRY_AFTER_S)
        };
        let place = Arc::clone(&self.places).try_acquire_owned().map_err(|_| overloaded())?;
        let turn = Arc::clone(&self.turns).acquire_owned().await.map_err(|_| overloaded())?;
        Ok(Turn(Arc::new(Mutex::new(Some([place, turn])))))
    }
}

/// The turn of a request. It travels with the request and its answer, and ends when the answer is written, or earlier.
#[derive(Debug, Clone)]
pub struct Turn(Arc<Mutex<Option<[OwnedSemaphorePermit; 2]>>>);

impl Turn {
    /// Ends the turn: what follows is only waiting.
    pub fn end(&self) {
        self.0.lock().unwrap_or_else(PoisonError::into_inner).take();
    }
}

#[cfg(test)]
mod tests {
    use futures::FutureExt as _;

    use super::*;

    #[tokio::test]
    async fn some_are_worked_on_some_wait_and_the_rest_is_refused_at_once() {
        let gate = Gate::new(1, 2);
        let first = gate.turn().await.expect("nobody is there");
        let mut second = Box::pin(gate.turn());
        assert!(second.as_mut().now_or_never().is_none(), "it waits");
        let refusal = gate.turn().now_or_never().expect("at once").expect_err("is refused");
        assert_eq!(refusal.kind(), ProblemType::Overloaded);
        first.end();
        assert!(second.now_or_never().expect("it is its turn").is_ok());
        assert!(gate.turn().now_or_never().expect("at once").is_ok());
    }
}
