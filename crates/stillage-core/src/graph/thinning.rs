//! Thinning of ground to the lines with the most room.
//!
//! Method: cells are taken away in the order of their room, the least first, as long as what is connected stays connected
//! and what goes around something still does (a cell is simple where its Yokoi number for eight neighbours is one: S. Yokoi,
//! J. Toriwaki, T. Fukumura, *An analysis of topological properties of digitized binary pictures*, 1975, doi
//! 10.1016/0146-664X(75)90012-X). What remains joins all anchors and goes around every obstacle, in the middle. Cost:
//! O(cells).

/// Offsets of the eight neighbours of a cell, counterclockwise, in a picture of a width.
pub(super) fn around(width: usize) -> [isize; 8] {
    let row = width as isize;
    [1, row + 1, row, row - 1, -1, -row - 1, -row, -row + 1]
}

/// Which cells of a picture remain. `room` is 0 where there is no ground; no cell on the border of the picture is ground.
/// Anchors on the ground always remain.
pub(super) fn thinned(width: usize, room: &[u16], anchors: &[usize]) -> Vec<bool> {
    let mut remains: Vec<bool> = room.iter().map(|&room| room > 0).collect();
    let mut is_anchor = vec![false; room.len()];
    for &anchor in anchors {
        is_anchor[anchor] = true;
    }
    let most = room.iter().copied().max().unwrap_or(0);
    let mut levels: Vec<Vec<u32>> = vec![Vec::new(); usize::from(most) + 1];
    for (cell, &room) in room.iter().enumerate().filter(|&(_, &room)| room > 0) {
        levels[usize::from(room)].push(cell as u32);
    }
    let around = around(width);
    for (mut queue, level) in levels.into_iter().zip(0..=most) {
        let mut next = 0;
        while let Some(&cell) = queue.get(next) {
            let cell = cell as usize;
            next += 1;
            if remains[cell] && !is_anchor[cell] && is_simple(around.map(|by| remains[cell.wrapping_add_signed(by)])) {
                remains[cell] = false;
                // A cell that had to stay may be simple now.
                let beside = around.iter().map(|&by| cell.wrapping_add_signed(by));
                let again = beside.filter(|&cell| remains[cell] && room[cell] <= level);
                queue.extend(again.map(|cell| cell as u32));
            }
        }
    }
    remains
}

/// Whether a cell can be taken away from between its eight neighbours without dividing or opening anything.
fn is_simple(is_ground: [bool; 8]) -> bool {
    let ends = [0, 2, 4, 6].into_iter().filter(|&side| {
        let all_bare = !is_ground[side + 1] && !is_ground[(side + 2) % 8];
        !is_ground[side] && !all_bare
    });
    ends.count() == 1
}

#[cfg(test)]
mod tests {
    use super::*;
    use expect_test::expect;

    /// Thins a picture whose ground is drawn as digits of room and whose anchors are drawn as `A`, with the room of 1.
    fn drawn(picture: &str) -> String {
        let rows: Vec<&str> = picture.split_whitespace().collect();
        let width = rows[0].len();
        let room: Vec<u16> = rows
            .concat()
            .bytes()
            .map(|cell| if cell == b'A' { 1 } else { u16::from(cell.saturating_sub(b'0')) })
            .collect();
        let anchors: Vec<usize> = rows.concat().match_indices('A').map(|(index, _)| index).collect();
        let shown: Vec<u8> =
            thinned(width, &room, &anchors).iter().map(|&remains| if remains { b'#' } else { b'.' }).collect();
        shown.chunks(width).map(|row| String::from_utf8_lossy(row).into_owned() + "\n").collect()
    }

    #[test]
    fn anchors_are_joined_where_there_is_most_room() {
        let thin = drawn(
            "
            ..........
            .11111111.
            .12222221.
            .A2333321.
            .1222222A.
            .11111111.
            ..........
            ",
        );
        expect![[r"
            ..........
            ..........
            ..........
            .#.####...
            ..#....##.
            ..........
            ..........
        "]]
        .assert_eq(&thin);
    }

    #[test]
    fn ground_without_anchors_becomes_one_cell_or_a_ring_around_what_stands_on_it() {
        let open = drawn("..... .111. .121. .111. .....");
        assert_eq!(open, ".....\n.....\n..#..\n.....\n.....\n");
        let ring = drawn(".......  .11111. .12221. .12.21. .12221. .11111. .......");
        assert_eq!(ring.matches('#').count(), 4, "{ring}");
    }
}
