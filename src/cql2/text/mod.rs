//! `cql2-text`: words (`token`), the place among them (`cursor`), shapes (`wkt`), times (`time`), and the grammar
//! (`parser`).

mod cursor;
mod parser;
mod time;
mod token;
mod wkt;

pub use parser::read;
