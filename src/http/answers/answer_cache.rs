//! The answers asked for last, within some memory.

use std::collections::HashMap;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

use super::question::Question;
use super::remembered::Remembered;

/// Share of the memory that one answer may take, so that it does not push out all others: a quarter.
const LARGEST_PART: usize = 4;
/// Share of the memory that is freed at a time, so that the oldest are looked for seldom: a quarter.
const FREED_PART: usize = 4;

/// Answers by their questions. What was not asked for longest gives way.
#[derive(Debug)]
pub struct AnswerCache {
    /// Most bytes of questions and answers.
    capacity: usize,
    kept: Mutex<Kept>,
}

#[derive(Debug, Default)]
struct Kept {
    answers: HashMap<Question, (u64, Arc<Remembered>)>,
    bytes: usize,
    /// Looks and answers so far: the time by which the oldest are told.
    looks: u64,
}

impl AnswerCache {
    /// Room for so many bytes.
    pub fn new(capacity: usize) -> Self {
        Self { capacity, kept: Mutex::default() }
    }

    /// The answer that was kept for a question.
    pub fn find(&self, question: &Question) -> Option<Arc<Remembered>> {
        let mut kept = self.kept();
        kept.looks += 1;
        let now = kept.looks;
        let (looked_at, answer) = kept.answers.get_mut(question)?;
        *looked_at = now;
        Some(Arc::clone(answer))
    }

    /// Keeps an answer in place of an earlier one, where it is not too large.
    pub fn keep(&self, question: Question, answer: Remembered) {
        let bytes = bytes(&question, &answer);
        if bytes > self.capacity / LARGEST_PART {
            return;
        }
        let mut kept = self.kept();
        kept.remove(&question);
        if kept.bytes + bytes > self.capacity {
            kept.forget_down_to((self.capacity - self.capacity / FREED_PART).saturating_sub(bytes));
        }
        kept.bytes += bytes;
        kept.looks += 1;
        let now = kept.looks;
        kept.answers.insert(question, (now, Arc::new(answer)));
    }

    /// Bytes of all questions and answers that are kept.
    pub fn bytes(&self) -> usize {
        self.kept().bytes
    }

    fn kept(&self) -> MutexGuard<'_, Kept> {
        // A panic can leave the sum of bytes wrong by one answer, nothing else.
        self.kept.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

impl Kept {
    fn remove(&mut self, question: &Question) {
        if let Some((_, answer)) = self.answers.remove(question) {
            self.bytes -= bytes(question, &answer);
        }
    }

    /// Forgets the oldest until no more than this many bytes are left.
    fn forget_down_to(&mut self, left: usize) {
        let mut by_age: Vec<(u64, Question)> =
            self.answers.iter().map(|(question, (looked_at, _))| (*looked_at, question.clone())).collect();
        by_age.sort_unstable_by_key(|(looked_at, _)| *looked_at);
        for (_, question) in by_age {
            if self.bytes <= left {
                break;
            }
            self.remove(&question);
        }
    }
}

fn bytes(question: &Question, answer: &Remembered) -> usize {
    question.bytes() + answer.bytes()
}

#[cfg(test)]
mod tests {
    use axum::body::{Body, Bytes};
    use axum::extract::Request;
    use axum::response::Response;

    use super::*;
    use crate::http::extract::conditional::EntityTag;

    fn question(number: u32) -> Question {
        let request = Request::builder().uri(format!("/v1/maps/{number}")).body(Body::empty());
        Question::of(&request.expect("a request")).expect("a read")
    }

    fn answer(bytes: usize) -> Remembered {
        let (parts, ()) = Response::new(()).into_parts();
        Remembered::of(EntityTag::of_version(1), &parts, &Bytes::from(vec![0; bytes]))
    }

    #[test]
    fn what_was_not_asked_for_longest_gives_way() {
        let cache = AnswerCache::new(100_000);
        for number in 0..4 {
            cache.keep(question(number), answer(20_000));
        }
        assert!(cache.find(&question(0)).is_some());
        cache.keep(question(4), answer(20_000));
        let found: Vec<u32> = (0..5).filter(|&number| cache.find(&question(number)).is_some()).collect();
        assert_eq!(found, [0, 3, 4]);
        assert!(cache.bytes() <= 100_000);
    }

    #[test]
    fn an_answer_that_would_push_out_the_others_is_not_kept() {
        let cache = AnswerCache::new(100_000);
        cache.keep(question(1), answer(30_000));
        assert!(cache.find(&question(1)).is_none());
    }

    #[test]
    fn a_newer_answer_takes_the_place_of_the_one_before() {
        let cache = AnswerCache::new(100_000);
        for _ in 0..100 {
            cache.keep(question(1), answer(20_000));
        }
        cache.keep(question(2), answer(20_000));
        assert!(cache.find(&question(1)).is_some());
    }
}
