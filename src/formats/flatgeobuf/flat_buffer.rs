//! Tables of `FlatBuffers` -> bytes.
//!
//! Source: *`FlatBuffer` Internals*, flatbuffers.dev/internals. Method: a table is written before what it refers to, so that
//! every offset leads forwards and is filled in when its target is there; each table has a list of its fields (`vtable`)
//! just before it. Alignment counts from the size that stands before the buffer, as other writers do it. Cost: O(bytes).
//! Limits: a table has less than 64 KiB of fields, a buffer less than 2 GiB.

/// A table: number and value of each field. Fields that are left out have the value that the schema gives them.
#[derive(Debug, Clone, Default)]
pub(super) struct FlatTable<'a>(pub Vec<(usize, Field<'a>)>);

/// The value of a field.
#[derive(Debug, Clone)]
pub(super) enum Field<'a> {
    Byte(u8),
    Short(u16),
    Int(i32),
    Long(u64),
    Text(&'a str),
    Bytes(Vec<u8>),
    Uints(Vec<u32>),
    Doubles(Vec<f64>),
    Table(FlatTable<'a>),
    Tables(Vec<FlatTable<'a>>),
}

impl Field<'_> {
    /// Bytes that it takes within its table: itself, or the offset to it.
    const fn size(&self) -> usize {
        match self {
            Self::Byte(_) => 1,
            Self::Short(_) => 2,
            Self::Long(_) => 8,
            _ => 4,
        }
    }
}

/// A buffer that begins with its size.
pub(super) fn buffer(root: &FlatTable<'_>) -> Vec<u8> {
    // Size of the buffer, then offset of the root.
    let mut out = vec![0; 8];
    refer(&mut out, 4, |out| table(out, root));
    align(&mut out, 8, 0);
    let size = out.len() as u32 - 4;
    out[..4].copy_from_slice(&size.to_le_bytes());
    out
}

/// Writes a target and puts the offset to it at a place.
fn refer(out: &mut Vec<u8>, place: usize, write: impl FnOnce(&mut Vec<u8>) -> usize) {
    let offset = (write(out) - place) as u32;
    out[place..place + 4].copy_from_slice(&offset.to_le_bytes());
}

/// Appends zeros until what follows after `ahead` bytes is aligned.
fn align(out: &mut Vec<u8>, to: usize, ahead: usize) {
    let end = (out.len() + ahead).next_multiple_of(to) - ahead;
    out.resize(end, 0);
}

/// Appends a table and what it refers to; where it begins.
fn table(out: &mut Vec<u8>, table: &FlatTable<'_>) -> usize {
    // The largest first, so that little is lost between them.
    let mut fields: Vec<&(usize, Field<'_>)> = table.0.iter().collect();
    fields.sort_by_key(|(_, field)| std::cmp::Reverse(field.size()));
    let slots = table.0.iter().map(|(number, _)| number + 1).max().unwrap_or(0);
    let mut offsets = vec![0_u16; slots];
    let mut end = 4_usize;
    for (number, field) in &fields {
        end = end.next_multiple_of(field.size());
        offsets[*number] = end as u16;
        end += field.size();
    }
    align(out, 2, 0);
    let list = out.len();
    let head = [4 + 2 * slots as u16, end as u16];
    out.extend(head.iter().chain(&offsets).flat_map(|number| number.to_le_bytes()));
    align(out, 8, 0);
    let start = out.len();
    out.extend(((start - list) as i32).to_le_bytes());
    out.resize(start + end, 0);
    for (number, field) in &table.0 {
        let place = start + usize::from(offsets[*number]);
        match field {
            Field::Byte(value) => out[place] = *value,
            Field::Short(value) => out[place..place + 2].copy_from_slice(&value.to_le_bytes()),
            Field::Int(value) => out[place..place + 4].copy_from_slice(&value.to_le_bytes()),
            Field::Long(value) => out[place..place + 8].copy_from_slice(&value.to_le_bytes()),
            target => refer(out, place, |out| referred(out, target)),
        }
    }
    start
}

/// Appends what a field refers to; where it begins.
fn referred(out: &mut Vec<u8>, field: &Field<'_>) -> usize {
    match field {
        Field::Text(text) => {
            let start = vector(out, text.len(), 1, text.bytes().map(|byte| [byte]));
            out.push(0);
            start
        }
        Field::Bytes(bytes) => vector(out, bytes.len(), 1, bytes.iter().map(|&byte| [byte])),
        Field::Uints(numbers) => vector(out, numbers.len(), 4, numbers.iter().map(|number| number.to_le_bytes())),
        Field::Doubles(numbers) => vector(out, numbers.len(), 8, numbers.iter().map(|number| number.to_le_bytes())),
        Field::Table(inner) => table(out, inner),
        Field::Tables(tables) => {
            let start = vector(out, tables.len(), 4, tables.iter().map(|_| [0; 4]));
            for (index, inner) in tables.iter().enumerate() {
                refer(out, start + 4 * (index + 1), |out| table(out, inner));
            }
            start
        }
        Field::Byte(_) | Field::Short(_) | Field::Int(_) | Field::Long(_) => {
            unreachable!("numbers stand in their table")
        }
    }
}

/// Appends a count and its items, the items aligned; where the count stands.
fn vector<const N: usize>(
    out: &mut Vec<u8>,
    count: usize,
    alignment: usize,
    items: impl Iterator<Item = [u8; N]>,
) -> usize {
    align(out, 4, 0);
    align(out, alignment, 4);
    let start = out.len();
    out.extend((count as u32).to_le_bytes());
    out.extend(items.flatten());
    start
}
