//! What holds for every subdivision, in one place: tests, property tests and fuzz targets all call it.

use super::ids::{FaceId, HalfEdgeId, VertexId};
use super::subdivision::Subdivision;
use crate::geometry::{DisjointSets, Point};

/// Answers with an error unless a condition holds.
macro_rules! ensure {
    ($condition:expr, $($message:tt)+) => {
        if !$condition {
            return Err(format!($($message)+));
        }
    };
}

impl Subdivision {
    /// Checks the structure: links, cycles, faces, areas, canonical order and Euler's formula. O(V + E).
    ///
    /// # Errors
    /// Says what is wrong with which half-edge, face or number.
    pub fn check_invariants(&self) -> Result<(), String> {
        ensure!(self.half_edges.len() == 2 * self.sources.len(), "an edge has two half-edges");
        ensure!(self.cycles.first().is_none_or(|first| self.area_of_cycles(first) <= 0), "face 0 has an outer cycle");
        self.check_half_edges()?;
        self.check_order()?;
        self.check_cycles()?;
        self.check_areas()?;
        self.check_euler()
    }

    fn check_half_edges(&self) -> Result<(), String> {
        for index in 0..self.half_edges.len() as u32 {
            let half = HalfEdgeId(index);
            let record = self.half_edge(half);
            let ids_exist = record.origin.index() < self.vertex_count()
                && record.face.index() < self.face_count()
                && record.next.index() < self.half_edges.len()
                && record.previous.index() < self.half_edges.len();
            ensure!(ids_exist, "half-edge {half} refers to what does not exist");
            ensure!(half.twin() != half && half.twin().twin() == half, "half-edge {half}: twin of twin");
            ensure!(self.half_edge(record.next).previous == half, "half-edge {half}: previous of next");
            ensure!(self.half_edge(record.previous).next == half, "half-edge {half}: next of previous");
            ensure!(self.half_edge(record.next).origin == self.target(half), "half-edge {half}: next begins elsewhere");
            ensure!(self.half_edge(record.next).face == record.face, "half-edge {half}: next has another face");
            ensure!(self.half_edge(half.twin()).face != record.face, "half-edge {half}: one face on both sides");
        }
        Ok(())
    }

    /// Vertices ascend by (y, x), edges by their vertices; no two are at one place.
    fn check_order(&self) -> Result<(), String> {
        let key = |point: &Point| (point.y, point.x);
        ensure!(self.positions.windows(2).all(|pair| key(&pair[0]) < key(&pair[1])), "vertices do not ascend");
        let ends: Vec<[VertexId; 2]> = self.edges().map(|edge| self.ends(edge)).collect();
        ensure!(ends.iter().all(|[low, high]| low < high), "an edge does not begin at its lower vertex");
        ensure!(ends.is_sorted() && ends.windows(2).all(|pair| pair[0] != pair[1]), "edges do not ascend");
        let firsts: Vec<HalfEdgeId> = self.faces().filter_map(|face| self.cycles(face).first().copied()).collect();
        ensure!(firsts.is_sorted(), "faces do not ascend");
        Ok(())
    }

    /// Every half-edge lies on exactly one cycle of its face, and every cycle begins with its least half-edge.
    fn check_cycles(&self) -> Result<(), String> {
        let mut visits = vec![0_u32; self.half_edges.len()];
        for (number, starts) in (0..).zip(&self.cycles) {
            let face = FaceId(number);
            ensure!(starts.iter().skip(1).is_sorted(), "the holes of face {face} do not ascend");
            for &start in starts {
                // `check_half_edges` came first: next is a permutation, so this ends.
                for half in self.cycle(start) {
                    visits[half.index()] += 1;
                    ensure!(self.half_edge(half).face == face, "half-edge {half} on a cycle of face {face}");
                    ensure!(half >= start, "a cycle of face {face} does not begin with its least half-edge");
                }
            }
        }
        ensure!(visits.iter().all(|&count| count == 1), "a half-edge lies on no cycle, or on several");
        Ok(())
    }

    /// Outer cycles turn left, holes right; the bounded faces fill what the outlines enclose, exactly.
    fn check_areas(&self) -> Result<(), String> {
        let mut total = 0;
        for face in self.faces() {
            let Some((outer, holes)) = self.cycles(face).split_first() else {
                return Err(format!("face {face} has no outer cycle"));
            };
            let area = self.area_of_cycles(std::slice::from_ref(outer));
            ensure!(area > 0, "the outer cycle of face {face} does not turn left");
            for hole in holes {
                let hole_area = self.area_of_cycles(std::slice::from_ref(hole));
                ensure!(hole_area < 0, "a hole of face {face} does not turn right");
            }
            let net = self.area_of_cycles(self.cycles(face));
            ensure!(net > 0, "face {face} has no area left beside its holes");
            total += net;
        }
        let outlines = self.cycles.first().map_or(0, |outlines| -self.area_of_cycles(outlines));
        ensure!(total == outlines, "the faces cover {total}, the outlines enclose {outlines} (doubled lattice units)");
        Ok(())
    }

    /// Twice the signed area of some cycles in lattice units, exact.
    fn area_of_cycles(&self, starts: &[HalfEdgeId]) -> i128 {
        let lattice = |vertex: VertexId| {
            let position = self.position(vertex) / self.step;
            (position.x as i64, position.y as i64)
        };
        let half_edges = starts.iter().flat_map(|&start| self.cycle(start));
        let term = |half: HalfEdgeId| {
            let (from, to) = (lattice(self.half_edge(half).origin), lattice(self.target(half)));
            i128::from(from.0 * to.1 - from.1 * to.0)
        };
        half_edges.map(term).sum()
    }

    /// V - E + F = 1 + C, the unbounded face included.
    fn check_euler(&self) -> Result<(), String> {
        let (vertices, edges, faces) = (self.vertex_count(), self.edge_count(), self.face_count());
        let components = self.component_count();
        let holds = self.cycles.is_empty() || vertices + faces == edges + 1 + components;
        ensure!(holds, "Euler: {vertices} - {edges} + {faces} != 1 + {components}");
        Ok(())
    }

    /// Number of connected components of the edges, by merging sets of vertices.
    fn component_count(&self) -> usize {
        let mut sets = DisjointSets::new(self.vertex_count());
        let joins = |edge| {
            let [first, second] = self.ends(edge).map(VertexId::index);
            sets.join(first, second)
        };
        self.vertex_count() - self.edges().map(joins).filter(|&is_new| is_new).count()
    }
}
