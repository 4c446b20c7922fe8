//! `cql2-text`: words (`token`), the place among them (`cursor`), shapes (`wkt`), and the grammar (`parser`).

mod cursor;
mod parser;
mod token;
mod wkt;

pub use parser::read;
