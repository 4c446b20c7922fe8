//! A place among the words of a filter.

use super::token::{self, Token, Word};
use crate::cql2::error::FilterError;

/// The words that are still to be read.
#[derive(Debug)]
pub struct Cursor<'a> {
    text: &'a str,
    tokens: Vec<Token>,
    position: usize,
}

impl<'a> Cursor<'a> {
    /// At the first word.
    ///
    /// # Errors
    /// Where the text has no words.
    pub fn new(text: &'a str) -> Result<Self, FilterError> {
        Ok(Self { text, tokens: token::read(text)?, position: 0 })
    }

    /// The word that comes next.
    pub fn peek(&self) -> &Word {
        self.peek_after(0)
    }

    /// The word that comes after so many others; the end goes on forever.
    pub fn peek_after(&self, others: usize) -> &Word {
        let last = self.tokens.len() - 1;
        &self.tokens[(self.position + others).min(last)].word
    }

    /// Takes the word that comes next.
    pub fn next(&mut self) -> Word {
        let word = self.peek().clone();
        self.position = (self.position + 1).min(self.tokens.len() - 1);
        word
    }

    /// Takes a sign if it comes next.
    pub fn take_sign(&mut self, sign: &str) -> bool {
        self.take_if(|word| matches!(word, Word::Sign(found) if *found == sign))
    }

    /// Takes a keyword if it comes next.
    pub fn take_keyword(&mut self, keyword: &str) -> bool {
        self.take_if(|word| word.is_keyword(keyword))
    }

    fn take_if(&mut self, is_wanted: impl Fn(&Word) -> bool) -> bool {
        let found = is_wanted(self.peek());
        if found {
            self.next();
        }
        found
    }

    /// Takes a sign, which must come next.
    ///
    /// # Errors
    /// When something else comes.
    pub fn expect_sign(&mut self, sign: &str) -> Result<(), FilterError> {
        if self.take_sign(sign) { Ok(()) } else { Err(self.expected(sign)) }
    }

    /// Takes a keyword, which must come next.
    ///
    /// # Errors
    /// When something else comes.
    pub fn expect_keyword(&mut self, keyword: &str) -> Result<(), FilterError> {
        if self.take_keyword(keyword) { Ok(()) } else { Err(self.expected(keyword)) }
    }

    /// Takes a number with its sign, which must come next.
    ///
    /// # Errors
    /// When something else comes.
    pub fn expect_number(&mut self) -> Result<f64, FilterError> {
        let is_negative = self.take_sign("-");
        if !is_negative {
            self.take_sign("+");
        }
        let Word::Number(number) = *self.peek() else { return Err(self.expected("a number")) };
        self.next();
        Ok(if is_negative { -number } else { number })
    }

    /// The next word is not what must come.
    pub fn expected(&self, what: &str) -> FilterError {
        self.wrong(format!("expected {what}, found {}", self.peek()))
    }

    /// Something is wrong with the next word.
    pub fn wrong(&self, detail: impl Into<String>) -> FilterError {
        self.wrong_at(self.start(), detail)
    }

    /// Something is wrong with the word that begins at a byte.
    pub fn wrong_at(&self, start: usize, detail: impl Into<String>) -> FilterError {
        FilterError::in_text(self.text, start, detail)
    }

    /// The byte at which the next word begins.
    pub fn start(&self) -> usize {
        self.tokens[self.position].start
    }
}
