//! Union-find: which members belong together, given pair by pair.
//!
//! Cost: O(log n) per call, amortized. Members are numbered from 0.

/// Union-find with the smallest member as the root of each set.
#[derive(Debug, Clone, Default)]
pub(crate) struct DisjointSets(Vec<usize>);

impl DisjointSets {
    /// Sets of one member each.
    pub(crate) fn new(count: usize) -> Self {
        Self((0..count).collect())
    }

    /// Adds a member in a set of its own, and gives its number.
    pub(crate) fn add(&mut self) -> usize {
        self.0.push(self.0.len());
        self.0.len() - 1
    }

    /// The root of the set that a member is in.
    pub(crate) fn find(&mut self, mut member: usize) -> usize {
        while self.0[member] != member {
            // Path halving (Tarjan and van Leeuwen 1984) keeps trees flat without a second pass.
            self.0[member] = self.0[self.0[member]];
            member = self.0[member];
        }
        member
    }

    /// Makes one set of those of two members; whether they were two.
    pub(crate) fn join(&mut self, first: usize, second: usize) -> bool {
        let (first, second) = (self.find(first), self.find(second));
        self.0[first.max(second)] = first.min(second);
        first != second
    }
}
