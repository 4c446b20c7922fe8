//! The files of a crate, the names they bring in, and which file a path leads to.

use std::collections::{BTreeMap, BTreeSet};

use crate::tokens::{Token, tokens, without_tests};

/// The sources of a crate: text by path from its `src`, such as `walls.rs` or `rooms/mod.rs`.
pub type Sources = BTreeMap<String, String>;

/// A path as it is written: `super::ground::Ground`.
type Written = Vec<String>;

/// One file, without its tests.
#[derive(Debug, Default)]
struct File {
    /// What `use` brings in, by the name it has here.
    names: BTreeMap<String, Written>,
    /// Paths anywhere else.
    paths: Vec<Written>,
    /// Types that are defined here.
    types: Vec<String>,
}

/// The files of a crate that are not only for tests, by module path.
#[derive(Debug)]
pub struct Files {
    by_module: BTreeMap<Vec<String>, (String, File)>,
}

/// What a path leads to.
enum Target {
    Module(Vec<String>),
    /// Something that a module defines.
    Item(Vec<String>),
}

impl Files {
    /// Reads the sources of a crate.
    pub fn read(sources: &Sources) -> Self {
        let mut by_module = BTreeMap::new();
        let mut only_tests = BTreeSet::new();
        for (path, text) in sources {
            let module = module_of(path);
            let (tokens, tests) = without_tests(&tokens(text));
            only_tests.extend(tests.into_iter().map(|name| [module.clone(), vec![name]].concat()));
            by_module.insert(module, (path.clone(), File::of(&tokens)));
        }
        let is_test = |module: &Vec<String>| (1..=module.len()).any(|depth| only_tests.contains(&module[..depth]));
        by_module.retain(|module, _| !is_test(module));
        Self { by_module }
    }

    /// For every file the files that it refers to, by path.
    pub fn references(&self) -> BTreeMap<String, BTreeSet<String>> {
        let of_file = |(module, (path, file)): (&Vec<String>, &(String, File))| {
            let written = file.names.values().chain(&file.paths);
            let targets = written.filter_map(|written| match self.resolve(module, written, 0)? {
                Target::Item(owner) => Some(self.by_module[&owner].0.clone()),
                Target::Module(_) => None,
            });
            (path.clone(), targets.filter(|target| target != path).collect())
        };
        self.by_module.iter().map(of_file).collect()
    }

    /// Every type with the file that defines it.
    pub fn types(&self) -> impl Iterator<Item = (&str, &str)> {
        self.by_module.values().flat_map(|(path, file)| file.types.iter().map(|name| (name.as_str(), path.as_str())))
    }

    /// Follows a path from a module; `None` where it leads out of the crate, or to something of the file itself.
    fn resolve(&self, from: &[String], written: &[String], depth: usize) -> Option<Target> {
        // Re-exports of re-exports are never this deep: a name would stand for itself.
        if depth > 16 {
            return None;
        }
        let mut module = from.to_vec();
        for (index, name) in written.iter().enumerate() {
            let child = [module.clone(), vec![name.clone()]].concat();
            if name == "crate" {
                module.clear();
            } else if name == "super" {
                module.pop();
            } else if name == "self" {
            } else if self.by_module.contains_key(&child) {
                // A function may have the name of its module, and the end of a path means the function.
                let is_end = index + 1 == written.len();
                if let (true, Some(item @ Target::Item(_))) =
                    (is_end, self.imported(&module, name, (from, written), depth))
                {
                    return Some(item);
                }
                module = child;
            } else if self.by_module[&module].1.names.contains_key(name) {
                match self.imported(&module, name, (from, written), depth)? {
                    Target::Module(found) => module = found,
                    item @ Target::Item(_) => return Some(item),
                }
            } else {
                return (index > 0).then_some(Target::Item(module));
            }
        }
        Some(Target::Module(module))
    }

    /// What a name leads to that a `use` of a module brings in, unless that `use` is the path itself.
    fn imported(
        &self,
        module: &[String],
        name: &str,
        (from, written): (&[String], &[String]),
        depth: usize,
    ) -> Option<Target> {
        let is_other = |path: &&Written| module != from || path.as_slice() != written;
        let path = self.by_module[module].1.names.get(name).filter(is_other)?;
        self.resolve(module, path, depth + 1)
    }
}

/// `rooms/mod.rs` is the module `rooms`, `rooms/doors.rs` is `rooms::doors`.
fn module_of(path: &str) -> Vec<String> {
    let mut module: Vec<String> = path.trim_end_matches(".rs").split('/').map(str::to_owned).collect();
    if module.last().is_some_and(|last| last == "mod" || last == "lib") {
        module.pop();
    }
    module
}

impl File {
    fn of(tokens: &[Token]) -> Self {
        let mut file = Self::default();
        let (mut at, mut braces) = (0, 0_usize);
        while at < tokens.len() {
            match &tokens[at] {
                Token::Sign('{') => braces += 1,
                Token::Sign('}') => braces = braces.saturating_sub(1),
                Token::Word(word) if word == "use" => {
                    at = file.add_use(tokens, at + 1, &[]);
                    continue;
                }
                Token::Word(word) if matches!(word.as_str(), "struct" | "enum" | "union" | "trait" | "type") => {
                    // A type of a trait or of an implementation is no type of the file.
                    let is_own = word != "type" || braces == 0;
                    let name = tokens.get(at + 1).and_then(Token::word);
                    file.types.extend(name.filter(|_| is_own).map(str::to_owned));
                }
                Token::Word(word) => {
                    let mut path = vec![word.clone()];
                    while let [Token::Path, Token::Word(next), ..] = &tokens[at + 1..] {
                        path.push(next.clone());
                        at += 2;
                    }
                    if path.len() > 1 {
                        file.paths.push(path);
                    }
                }
                _ => {}
            }
            at += 1;
        }
        file
    }

    /// Reads one tree of a `use`, which may be a group; answers where it ends.
    fn add_use(&mut self, tokens: &[Token], mut at: usize, prefix: &[String]) -> usize {
        let mut path = prefix.to_vec();
        loop {
            match &tokens[at] {
                Token::Word(word) if word == "as" => {
                    if let Some(name) = tokens[at + 1].word() {
                        self.names.insert(name.to_owned(), path);
                    }
                    return at + 2;
                }
                Token::Word(word) => path.push(word.clone()),
                Token::Path => {}
                Token::Sign('{') => {
                    at += 1;
                    while !tokens[at].is('}') {
                        at = self.add_use(tokens, at, &path);
                        at += usize::from(tokens[at].is(','));
                    }
                    return at + 1;
                }
                Token::Sign('*') => return at + 1,
                Token::Sign(_) => break,
            }
            at += 1;
        }
        // `use signal::{self}` brings in `signal`.
        if path.last().is_some_and(|last| last == "self") {
            path.pop();
        }
        if let Some(name) = path.last().cloned() {
            self.names.insert(name, path);
        }
        at
    }
}
