//! Rust source as words and signs, without comments, text literals and whatever only tests see.

/// A word or a sign of Rust source.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Token {
    /// An identifier or a keyword.
    Word(String),
    /// `::`
    Path,
    /// Any other sign.
    Sign(char),
}

impl Token {
    /// The word, if it is one.
    pub fn word(&self) -> Option<&str> {
        if let Self::Word(word) = self { Some(word) } else { None }
    }

    pub fn is(&self, sign: char) -> bool {
        *self == Self::Sign(sign)
    }
}

/// The tokens of a source text.
pub fn tokens(text: &str) -> Vec<Token> {
    let text: Vec<char> = text.chars().collect();
    let mut found = Vec::new();
    let mut at = 0;
    while at < text.len() {
        let rest = &text[at..];
        at += match rest {
            ['/', '/', ..] => rest.iter().position(|&sign| sign == '\n').unwrap_or(rest.len()),
            ['/', '*', ..] => block_comment(rest),
            ['"', ..] => quoted(rest, '"'),
            ['\'', ..] => tick(rest),
            [':', ':', ..] => {
                found.push(Token::Path);
                2
            }
            [first, ..] if first.is_alphanumeric() || *first == '_' => word(rest, &mut found),
            [sign, ..] => {
                if !sign.is_whitespace() {
                    found.push(Token::Sign(*sign));
                }
                1
            }
            [] => 1,
        };
    }
    found
}

/// A word, or a literal whose prefix looks like one (`r"..."`, `b'.'`).
fn word(rest: &[char], found: &mut Vec<Token>) -> usize {
    let is_part = |sign: &char| sign.is_alphanumeric() || *sign == '_';
    let length = rest.iter().position(|sign| !is_part(sign)).unwrap_or(rest.len());
    let word: String = rest[..length].iter().collect();
    let is_prefix = ["r", "b", "br", "c", "cr"].contains(&word.as_str());
    match &rest[length..] {
        ['"', ..] | ['#', '"' | '#', ..] if is_prefix && word.ends_with('r') => length + raw(&rest[length..]),
        ['"', ..] if is_prefix => length + quoted(&rest[length..], '"'),
        ['\'', ..] if word == "b" => length + quoted(&rest[length..], '\''),
        _ => {
            found.push(Token::Word(word));
            length
        }
    }
}

/// Length of a comment, which may hold others.
fn block_comment(rest: &[char]) -> usize {
    let (mut depth, mut at) = (0_usize, 0);
    while at < rest.len() {
        match rest[at..] {
            ['/', '*', ..] => (depth, at) = (depth + 1, at + 2),
            ['*', '/', ..] => (depth, at) = (depth - 1, at + 2),
            _ => at += 1,
        }
        if depth == 0 {
            break;
        }
    }
    at
}

/// Length of a literal between two quotes.
fn quoted(rest: &[char], quote: char) -> usize {
    let mut at = 1;
    while at < rest.len() && rest[at] != quote {
        at += if rest[at] == '\\' { 2 } else { 1 };
    }
    at + 1
}

/// Length of `#"..."#` with any number of `#`.
fn raw(rest: &[char]) -> usize {
    let hashes = rest.iter().position(|&sign| sign != '#').unwrap_or(0);
    let is_end =
        |at: &usize| rest[*at] == '"' && rest[at + 1..].iter().take(hashes).filter(|&&s| s == '#').count() == hashes;
    (hashes + 1..rest.len()).find(is_end).map_or(rest.len(), |end| end + 1 + hashes)
}

/// Length of a character literal, or of the tick of a lifetime.
fn tick(rest: &[char]) -> usize {
    match rest {
        ['\'', '\\', ..] => quoted(rest, '\''),
        ['\'', _, '\'', ..] => 3,
        _ => 1,
    }
}

/// Splits off what only tests see: the items after `#[cfg(test)]`. Answers what is left, and the names of modules that
/// lie in files of their own and are only for tests.
pub fn without_tests(tokens: &[Token]) -> (Vec<Token>, Vec<String>) {
    let marker = crate::tokens::tokens("#[cfg(test)]");
    let (mut left, mut modules) = (Vec::new(), Vec::new());
    let mut at = 0;
    while at < tokens.len() {
        if !tokens[at..].starts_with(&marker) {
            left.push(tokens[at].clone());
            at += 1;
            continue;
        }
        let item = &tokens[at + marker.len()..];
        let length = item_length(item);
        if let [.., Token::Word(keyword), Token::Word(name), Token::Sign(';')] = &item[..length]
            && keyword == "mod"
        {
            modules.push(name.clone());
        }
        at += marker.len() + length;
    }
    (left, modules)
}

/// Length of an item: up to its `;`, or to the end of its block.
fn item_length(tokens: &[Token]) -> usize {
    let ends_with_a_sign = |token: &Token| matches!(token.word(), Some("use" | "const" | "static" | "type"));
    let first_word = tokens.iter().find(|token| !matches!(token.word(), Some("pub" | "crate" | "super") | None));
    let is_plain = first_word.is_some_and(ends_with_a_sign);
    let mut depth = 0_usize;
    for (at, token) in tokens.iter().enumerate() {
        match token {
            Token::Sign('(' | '[' | '{') => depth += 1,
            Token::Sign(')' | ']' | '}') => depth = depth.saturating_sub(1),
            _ => {}
        }
        if depth == 0 && (token.is(';') || token.is('}') && !is_plain) {
            return at + 1;
        }
    }
    tokens.len()
}
