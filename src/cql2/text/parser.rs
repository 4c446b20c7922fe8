//! The grammar of `cql2-text`: OR, AND, NOT, predicates, sums, products, powers, values, each binding tighter than the
//! one before.
//!
//! The grammar of the standard tells conditions from values; here one expression holds both, and what joins which is
//! checked with the types.

use super::cursor::Cursor;
use super::token::Word;
use super::{time, wkt};
use crate::cql2::error::FilterError;
use crate::cql2::expression::Expression;
use crate::cql2::instant::Instant;
use crate::cql2::limits::{MAX_DEPTH, check_length};
use crate::cql2::operator::{Arithmetic, Comparison, Operator};

/// Reads a filter in `cql2-text`. O(length).
///
/// # Errors
/// The column and what was expected there; when the filter is longer or deeper than the limits.
pub fn read(text: &str) -> Result<Expression, FilterError> {
    check_length(text)?;
    let mut parser = Parser { cursor: Cursor::new(text)?, nesting: 0 };
    let tree = parser.any()?;
    if *parser.cursor.peek() == Word::End {
        Ok(tree.expression)
    } else {
        Err(parser.cursor.expected("an operator, AND, OR or the end"))
    }
}

struct Parser<'a> {
    cursor: Cursor<'a>,
    /// Parentheses and NOTs that are open: how deep this parser calls itself.
    nesting: usize,
}

/// An expression with the number of its levels.
struct Tree {
    expression: Expression,
    height: usize,
}

impl Parser<'_> {
    /// Conditions joined by OR.
    fn any(&mut self) -> Result<Tree, FilterError> {
        self.joined("OR", Operator::Or, Self::all)
    }

    /// Conditions joined by AND.
    fn all(&mut self) -> Result<Tree, FilterError> {
        self.joined("AND", Operator::And, Self::negation)
    }

    fn joined(
        &mut self,
        keyword: &str,
        operator: Operator,
        each: fn(&mut Self) -> Result<Tree, FilterError>,
    ) -> Result<Tree, FilterError> {
        let first = each(self)?;
        if !self.cursor.peek().is_keyword(keyword) {
            return Ok(first);
        }
        let mut conditions = vec![first];
        while self.cursor.take_keyword(keyword) {
            conditions.push(each(self)?);
        }
        self.call(operator, conditions)
    }

    fn negation(&mut self) -> Result<Tree, FilterError> {
        if !self.cursor.take_keyword("NOT") {
            return self.predicate();
        }
        let condition = self.nested(Self::negation)?;
        self.call(Operator::Not, vec![condition])
    }

    /// A value, and what is said of it, if anything.
    fn predicate(&mut self) -> Result<Tree, FilterError> {
        let value = self.sum()?;
        if let Some(comparison) = self.comparison() {
            let other = self.sum()?;
            return self.call(Operator::Comparison(comparison), vec![value, other]);
        }
        if self.cursor.take_keyword("IS") {
            let is_negated = self.cursor.take_keyword("NOT");
            self.cursor.expect_keyword("NULL")?;
            let is_null = self.call(Operator::IsNull, vec![value])?;
            return self.negated_if(is_negated, is_null);
        }
        let is_negated = self.cursor.take_keyword("NOT");
        let predicate = if self.cursor.take_keyword("LIKE") {
            let pattern = self.sum()?;
            self.call(Operator::Like, vec![value, pattern])?
        } else if self.cursor.take_keyword("BETWEEN") {
            let low = self.sum()?;
            self.cursor.expect_keyword("AND")?;
            let high = self.sum()?;
            self.call(Operator::Between, vec![value, low, high])?
        } else if self.cursor.take_keyword("IN") {
            let list = self.nested(Self::array)?;
            self.call(Operator::In, vec![value, list])?
        } else if is_negated {
            return Err(self.cursor.expected("LIKE, BETWEEN or IN"));
        } else {
            return Ok(value);
        };
        self.negated_if(is_negated, predicate)
    }

    fn negated_if(&self, is_negated: bool, condition: Tree) -> Result<Tree, FilterError> {
        if is_negated { self.call(Operator::Not, vec![condition]) } else { Ok(condition) }
    }

    fn comparison(&mut self) -> Option<Comparison> {
        let Word::Sign(sign) = *self.cursor.peek() else { return None };
        let Some(Operator::Comparison(comparison)) = Operator::named(sign) else { return None };
        self.cursor.next();
        Some(comparison)
    }

    fn sum(&mut self) -> Result<Tree, FilterError> {
        let mut value = self.product()?;
        loop {
            let operator = match self.cursor.peek() {
                Word::Sign("+") => Arithmetic::Add,
                Word::Sign("-") => Arithmetic::Subtract,
                _ => return Ok(value),
            };
            self.cursor.next();
            let other = self.product()?;
            value = self.call(Operator::Arithmetic(operator), vec![value, other])?;
        }
    }

    fn product(&mut self) -> Result<Tree, FilterError> {
        let mut value = self.power()?;
        loop {
            let operator = match self.cursor.peek() {
                Word::Sign("*") => Arithmetic::Multiply,
                Word::Sign("/") => Arithmetic::Divide,
                Word::Sign("%") => Arithmetic::Remainder,
                word if word.is_keyword("div") => Arithmetic::WholeDivide,
                _ => return Ok(value),
            };
            self.cursor.next();
            let other = self.power()?;
            value = self.call(Operator::Arithmetic(operator), vec![value, other])?;
        }
    }

    fn power(&mut self) -> Result<Tree, FilterError> {
        let base = self.signed()?;
        if !self.cursor.take_sign("^") {
            return Ok(base);
        }
        let exponent = self.signed()?;
        self.call(Operator::Arithmetic(Arithmetic::Power), vec![base, exponent])
    }

    /// A value with its sign. A sign before a number belongs to the number, any other is a factor of -1.
    fn signed(&mut self) -> Result<Tree, FilterError> {
        if matches!(self.cursor.peek(), Word::Sign("+" | "-")) && matches!(self.cursor.peek_after(1), Word::Number(_)) {
            return self.cursor.expect_number().map(|number| Tree::leaf(Expression::Number(number)));
        }
        if !self.cursor.take_sign("-") {
            return self.value();
        }
        let factors = vec![Tree::leaf(Expression::Number(-1.0)), self.value()?];
        self.call(Operator::Arithmetic(Arithmetic::Multiply), factors)
    }

    fn value(&mut self) -> Result<Tree, FilterError> {
        if *self.cursor.peek() == Word::Sign("(") {
            return self.nested(Self::enclosed);
        }
        if let Some(shape) = wkt::read(&mut self.cursor)? {
            return Ok(Tree::leaf(shape));
        }
        let is_call = *self.cursor.peek_after(1) == Word::Sign("(");
        let expression = match self.cursor.peek().clone() {
            Word::Name(name) if is_call => return self.nested(|parser| parser.function(&name)),
            word if word.is_keyword("TRUE") => Expression::Boolean(true),
            word if word.is_keyword("FALSE") => Expression::Boolean(false),
            Word::Name(name) if !is_reserved(&name) => Expression::Property(name),
            Word::Quoted(name) => Expression::Property(name),
            Word::Text(text) => Expression::Text(text),
            Word::Number(number) => Expression::Number(number),
            word if word.is_keyword("NULL") => return Err(self.cursor.wrong("NULL is asked for with IS NULL")),
            _ => return Err(self.cursor.expected("a property, a value or a condition")),
        };
        self.cursor.next();
        Ok(Tree::leaf(expression))
    }

    /// What is between parentheses: an expression, or the values of an array.
    fn enclosed(&mut self) -> Result<Tree, FilterError> {
        let mut array = self.entries()?;
        match array.pop() {
            Some(only) if array.is_empty() => Ok(only),
            last => {
                array.extend(last);
                self.array_of(array)
            }
        }
    }

    /// The values of an array, even if there is only one.
    fn array(&mut self) -> Result<Tree, FilterError> {
        let entries = self.entries()?;
        self.array_of(entries)
    }

    fn array_of(&self, entries: Vec<Tree>) -> Result<Tree, FilterError> {
        self.tree(entries, Expression::Array)
    }

    /// Expressions between parentheses, with commas between them.
    fn entries(&mut self) -> Result<Vec<Tree>, FilterError> {
        self.cursor.expect_sign("(")?;
        let mut entries = Vec::new();
        if self.cursor.take_sign(")") {
            return Ok(entries);
        }
        loop {
            entries.push(self.any()?);
            if self.cursor.take_sign(")") {
                return Ok(entries);
            }
            if !self.cursor.take_sign(",") {
                return Err(self.cursor.expected("an operator, a comma or )"));
            }
        }
    }

    fn function(&mut self, name: &str) -> Result<Tree, FilterError> {
        let start = self.cursor.start();
        match name.to_ascii_uppercase().as_str() {
            "DATE" => return time::instant(&mut self.cursor, Instant::date).map(Tree::leaf),
            "TIMESTAMP" => return time::instant(&mut self.cursor, Instant::timestamp).map(Tree::leaf),
            "INTERVAL" => return time::interval(&mut self.cursor).map(Tree::leaf),
            _ if is_reserved(name) => return Err(self.cursor.expected("a property, a value or a condition")),
            _ => {}
        }
        self.cursor.next();
        let Some(operator) = Operator::named(name).filter(|operator| operator.is_function()) else {
            let arguments = self.entries()?;
            return self.tree(arguments, |arguments| Expression::Function { name: name.to_owned(), arguments });
        };
        let arguments = if let Operator::Array(_) = operator { self.arrays()? } else { self.entries()? };
        if !operator.arguments().contains(&arguments.len()) {
            let count = *operator.arguments().start();
            let detail = format!("{name} takes {count} {}", if count == 1 { "argument" } else { "arguments" });
            return Err(self.cursor.wrong_at(start, detail));
        }
        self.call(operator, arguments)
    }

    /// The arguments of an array function, where even one value between parentheses is an array.
    fn arrays(&mut self) -> Result<Vec<Tree>, FilterError> {
        self.cursor.expect_sign("(")?;
        let mut arrays = Vec::new();
        loop {
            let is_array = *self.cursor.peek() == Word::Sign("(");
            arrays.push(if is_array { self.nested(Self::array)? } else { self.value()? });
            if self.cursor.take_sign(")") {
                return Ok(arrays);
            }
            if !self.cursor.take_sign(",") {
                return Err(self.cursor.expected("a comma or )"));
            }
        }
    }

    /// Reads something one level deeper.
    fn nested(&mut self, read: impl FnOnce(&mut Self) -> Result<Tree, FilterError>) -> Result<Tree, FilterError> {
        if self.nesting == MAX_DEPTH {
            return Err(self.too_deep());
        }
        self.nesting += 1;
        let tree = read(self);
        self.nesting -= 1;
        tree
    }

    fn call(&self, operator: Operator, arguments: Vec<Tree>) -> Result<Tree, FilterError> {
        self.tree(arguments, |arguments| Expression::call(operator, arguments))
    }

    /// Puts an expression over its parts.
    fn tree(&self, parts: Vec<Tree>, join: impl FnOnce(Vec<Expression>) -> Expression) -> Result<Tree, FilterError> {
        let height = 1 + parts.iter().map(|part| part.height).max().unwrap_or(0);
        if height > MAX_DEPTH {
            return Err(self.too_deep());
        }
        Ok(Tree { expression: join(parts.into_iter().map(|part| part.expression).collect()), height })
    }

    fn too_deep(&self) -> FilterError {
        self.cursor.wrong(format!("there are more than {MAX_DEPTH} levels within one another"))
    }
}

impl Tree {
    const fn leaf(expression: Expression) -> Self {
        Self { expression, height: 1 }
    }
}

/// Whether a name without double quotes cannot be that of a property.
fn is_reserved(name: &str) -> bool {
    const KEYWORDS: [&str; 8] = ["AND", "OR", "NOT", "LIKE", "BETWEEN", "IN", "IS", "NULL"];
    KEYWORDS.iter().any(|keyword| keyword.eq_ignore_ascii_case(name))
}
