//! Cholesky roots of large matrices, in square tiles.
//!
//! The matrix alone fixes the order of the operations on every entry, whatever the number of
//! threads and the width of their vectors: each tile is computed by one thread, and within it every
//! entry has its products subtracted one after the other.
//!
//! A covariance matrix whose correlations decay has a root whose far entries decay too, down to
//! numbers below the smallest normal one, on which processors work a hundred times more slowly.
//! Such an entry is zero here (see [`NEGLIGIBLE`]), and tiles of zeros are skipped.

use crate::parallel;

use crate::number::{CodePath, Kernel};

/// Rows and columns of a tile: two of them fit a second-level cache.
const TILE: usize = 128;

/// Rows and columns of the part of a tile that stays in registers, including those of AVX2.
const ROWS: usize = 4;
const COLUMNS: usize = 8;

/// Entries of a panel: some columns of a transposed tile, row after row, so that a product reads
/// them one after the other. A panel stays in a first-level cache while a whole tile passes it.
const PANEL: usize = COLUMNS * TILE;

/// An entry of the root is zero below this fraction of its row's length (the square root of the
/// diagonal entry of the matrix): its contribution to an entry (i, j) of L L' is below 1e-40 of the
/// square root of the product of the diagonal entries i and j, 24 digits below the rounding of that
/// entry itself.
const NEGLIGIBLE: f64 = 1e-40;

/// The Cholesky root of a symmetric matrix.
#[derive(Clone, Debug)]
pub struct BlockedRoot {
    order: usize,
    /// Tiles (i, j), j <= i, at `triangle(i) + j`, each row by row; a tile of zeros is empty. Beyond
    /// the matrix there is the identity.
    tiles: Vec<Vec<f64>>,
}

impl BlockedRoot {
    /// The root L, with L L' the symmetric matrix of this order whose entries (i, j), j <= i, are
    /// given.
    ///
    /// # Errors
    /// The first row (counted from 0) whose pivot is not above `least` times its diagonal entry:
    /// the matrix is positive definite only up to there.
    pub fn of(
        order: usize,
        least: f64,
        entry: impl Fn(usize, usize) -> f64 + Sync,
    ) -> Result<Self, usize> {
        let count = order.div_ceil(TILE);
        let path = CodePath::best();
        let mut tiles: Vec<Vec<f64>> = Vec::with_capacity(count * (count + 1) / 2);
        tiles.resize(count * (count + 1) / 2, Vec::new());
        let at = |i: usize, j: usize| i * (i + 1) / 2 + j;
        let negligible: Vec<f64> = (0..count * TILE)
            .map(|row| if row < order { NEGLIGIBLE * entry(row, row).sqrt() } else { 0.0 })
            .collect();
        for j in 0..count {
            // the row of tiles left of the diagonal, turned so that its columns lie side by side
            let turned: Vec<Vec<f64>> = (0..j).map(|k| panels(&tiles[at(j, k)])).collect();
            let done = &tiles;
            let column: Vec<Vec<f64>> = parallel::map(j..count, |i| {
                let mut tile = filled(order, i, j, &entry);
                for (k, right) in turned.iter().enumerate() {
                    let left = &done[at(i, k)];
                    if !left.is_empty() && !right.is_empty() {
                        path.run(Subtract { from: &mut tile, left, right });
                    }
                }
                tile
            });
            let mut column = column.into_iter();
            let Some(mut diagonal) = column.next() else { break };
            factor(&mut diagonal, &negligible[j * TILE..], |row| {
                let row = j * TILE + row;
                if row < order { least * entry(row, row) } else { 0.0 }
            })
            .map_err(|row| j * TILE + row)?;
            let right = transposed(&diagonal);
            tiles[at(j, j)] = diagonal;
            let below = column.zip(negligible[(j + 1) * TILE..].chunks_exact(TILE));
            let below: Vec<Vec<f64>> = parallel::map(below, |(mut tile, negligible)| {
                path.run(Divide { tile: &mut tile, root: &right, negligible });
                if tile.iter().any(|x| *x != 0.0) { tile } else { Vec::new() }
            });
            for (i, tile) in below.into_iter().enumerate() {
                tiles[at(j + 1 + i, j)] = tile;
            }
        }
        Ok(Self { order, tiles })
    }

    /// Replaces y by inv(L) y.
    pub fn solve(&self, y: &mut [f64]) {
        for i in 0..self.order {
            let mut rest = y[i];
            for j in 0..=i / TILE {
                let row = self.row(i, j);
                let first = j * TILE;
                let last = (first + TILE).min(i);
                for (entry, known) in row.iter().zip(&y[first..last]) {
                    rest -= entry * known;
                }
            }
            y[i] = rest / self.row(i, i / TILE)[i % TILE];
        }
    }

    /// Replaces y by inv(L') y.
    pub fn solve_transposed(&self, y: &mut [f64]) {
        for i in (0..self.order).rev() {
            let known = y[i] / self.row(i, i / TILE)[i % TILE];
            y[i] = known;
            for j in 0..=i / TILE {
                let first = j * TILE;
                let last = (first + TILE).min(i);
                let row = self.row(i, j);
                for (rest, entry) in y[first..last].iter_mut().zip(row) {
                    *rest -= entry * known;
                }
            }
        }
    }

    /// Replaces z by L z.
    pub fn multiply(&self, z: &mut [f64]) {
        for i in (0..self.order).rev() {
            let mut sum = 0.0;
            for j in 0..=i / TILE {
                let first = j * TILE;
                let last = (first + TILE).min(i + 1);
                for (entry, z) in self.row(i, j).iter().zip(&z[first..last]) {
                    sum += entry * z;
                }
            }
            z[i] = sum;
        }
    }

    /// The part of row i in the tile of column j; empty if that tile is zero.
    fn row(&self, i: usize, j: usize) -> &[f64] {
        let block = i / TILE;
        let tile = &self.tiles[block * (block + 1) / 2 + j];
        tile.get((i % TILE) * TILE..(i % TILE + 1) * TILE).unwrap_or_default()
    }
}

/// The tile (i, j) of a matrix, or of the identity beyond it.
fn filled(order: usize, i: usize, j: usize, entry: &impl Fn(usize, usize) -> f64) -> Vec<f64> {
    let mut tile = vec![0.0; TILE * TILE];
    for (r, row) in tile.chunks_exact_mut(TILE).enumerate() {
        let r = i * TILE + r;
        for (c, place) in row.iter_mut().enumerate() {
            let c = j * TILE + c;
            *place = match () {
                () if r < order && c <= r => entry(r, c),
                () if r == c => 1.0,
                () => 0.0,
            };
        }
    }
    tile
}

fn transposed(tile: &[f64]) -> Vec<f64> {
    let mut turned = vec![0.0; TILE * TILE];
    for (r, row) in tile.chunks_exact(TILE).enumerate() {
        for (c, entry) in row.iter().enumerate() {
            turned[c * TILE + r] = *entry;
        }
    }
    turned
}

/// A tile transposed, in panels; empty for a tile of zeros.
fn panels(tile: &[f64]) -> Vec<f64> {
    if tile.is_empty() {
        return Vec::new();
    }
    let mut turned = vec![0.0; TILE * TILE];
    for (r, row) in tile.chunks_exact(TILE).enumerate() {
        let panel = &mut turned[r / COLUMNS * PANEL..][..PANEL];
        for (c, entry) in row.iter().enumerate() {
            panel[c * COLUMNS + r % COLUMNS] = *entry;
        }
    }
    turned
}

/// The root of a tile on the diagonal; the first row whose pivot is not above `least`.
fn factor(tile: &mut [f64], negligible: &[f64], least: impl Fn(usize) -> f64) -> Result<(), usize> {
    for i in 0..TILE {
        let (above, rest) = tile.split_at_mut(i * TILE);
        let row = &mut rest[..TILE];
        for j in 0..i {
            let other = &above[j * TILE..j * TILE + TILE];
            let mut sum = row[j];
            for (x, y) in row[..j].iter().zip(other) {
                sum -= x * y;
            }
            row[j] = unless_negligible(sum / other[j], negligible[i]);
        }
        let pivot = row[..i].iter().fold(row[i], |pivot, x| pivot - x * x);
        if pivot <= least(i) || pivot.is_nan() {
            return Err(i);
        }
        row[i] = pivot.sqrt();
        row[i + 1..].fill(0.0);
    }
    Ok(())
}

#[inline(always)]
fn unless_negligible(x: f64, negligible: f64) -> f64 {
    if x.abs() < negligible { 0.0 } else { x }
}

/// Subtracts the product of two tiles, the second of which is already transposed, in panels.
struct Subtract<'a> {
    from: &'a mut [f64],
    left: &'a [f64],
    right: &'a [f64],
}

impl Kernel for Subtract<'_> {
    type Output = ();

    #[inline(always)]
    fn run(self) {
        for (first, panel) in (0..TILE).step_by(COLUMNS).zip(self.right.chunks_exact(PANEL)) {
            for (rows, left) in
                self.from.chunks_exact_mut(ROWS * TILE).zip(self.left.chunks_exact(ROWS * TILE))
            {
                let mut sums = [[0.0; COLUMNS]; ROWS];
                for (sums, row) in sums.iter_mut().zip(rows.chunks_exact(TILE)) {
                    sums.copy_from_slice(&row[first..first + COLUMNS]);
                }
                for (k, right) in panel.chunks_exact(COLUMNS).enumerate() {
                    for (r, sums) in sums.iter_mut().enumerate() {
                        let factor = left[r * TILE + k];
                        for (sum, right) in sums.iter_mut().zip(right) {
                            *sum -= factor * right;
                        }
                    }
                }
                for (sums, row) in sums.iter().zip(rows.chunks_exact_mut(TILE)) {
                    row[first..first + COLUMNS].copy_from_slice(sums);
                }
            }
        }
    }
}

/// Multiplies a tile by the inverse of a transposed root, which is given transposed.
struct Divide<'a> {
    tile: &'a mut [f64],
    root: &'a [f64],
    /// Of each row.
    negligible: &'a [f64],
}

impl Kernel for Divide<'_> {
    type Output = ();

    #[inline(always)]
    fn run(self) {
        for (row, negligible) in self.tile.chunks_exact_mut(TILE).zip(self.negligible) {
            for (m, column) in self.root.chunks_exact(TILE).enumerate() {
                let known = unless_negligible(row[m] / column[m], *negligible);
                row[m] = known;
                if known == 0.0 {
                    continue;
                }
                for (rest, entry) in row[m + 1..].iter_mut().zip(&column[m + 1..]) {
                    *rest -= known * entry;
                }
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::linalg::packed;

    /// A matrix that is far from diagonal: exp(-|i - j|/50) + 0.1 on the diagonal.
    fn entry(i: usize, j: usize) -> f64 {
        libm::exp(-(i.abs_diff(j) as f64) / 50.0) + if i == j { 0.1 } else { 0.0 }
    }

    // The pivots are above 0.1, so that rounding of n = 300 terms stays below 1e-13.
    #[test]
    fn the_root_is_that_of_the_plain_loop() {
        for n in [1, 2, 127, 128, 129, 300] {
            let root = BlockedRoot::of(n, 0.0, entry).unwrap();
            let mut plain: Vec<f64> =
                (0..n).flat_map(|i| (0..=i).map(move |j| entry(i, j))).collect();
            packed::cholesky(&mut plain, 0.0).unwrap();
            let y: Vec<f64> = (0..n).map(|i| (i % 7) as f64 - 3.0).collect();
            let (mut a, mut b) = (y.clone(), y.clone());
            root.solve(&mut a);
            packed::solve(&plain, &mut b);
            let mut back = a.clone();
            root.multiply(&mut back);
            for i in 0..n {
                assert!((a[i] - b[i]).abs() < 1e-12, "{n} {i}");
                assert!((back[i] - y[i]).abs() < 1e-12, "{n} {i}");
            }
            root.solve_transposed(&mut a);
            packed::solve_transposed(&plain, &mut b);
            assert!(a.iter().zip(&b).all(|(a, b)| (a - b).abs() < 1e-11), "{n}");
        }
    }

    /// An autoregressive process, V(i, j) = r^|i - j|, has the root L(i, 0) = r^i and L(i, j) =
    /// sqrt(1 - r^2) r^(i - j) beyond the first column. Its far entries are negligible below 1e-40
    /// of the root's length, r^875; the other bound is that of rounding.
    #[test]
    fn what_dies_away_ends_in_zeros() {
        let (n, r) = (1200, 0.9_f64);
        let powers: Vec<f64> = (0..n).map(|k| libm::pow(r, f64::from(k))).collect();
        let root = BlockedRoot::of(n as usize, 0.0, |i, j| powers[i - j]).unwrap();
        let length = (1.0 - r * r).sqrt();
        for i in 0..n as usize {
            for j in 0..=i {
                let found = root.row(i, j / TILE).get(j % TILE).map_or(0.0, |entry| *entry);
                let exact = if j == 0 { 1.0 } else { length } * powers[i - j];
                assert!((found - exact).abs() < 1e-12 * exact + 2e-40, "{i} {j} {found:e}");
            }
        }
        assert!(root.tiles[9 * 10 / 2].is_empty() && !root.tiles[6 * 7 / 2].is_empty());
    }

    #[test]
    fn the_first_row_without_a_pivot_is_named() {
        let singular =
            |i: usize, j: usize| entry(i - usize::from(i == 200), j - usize::from(j == 200));
        let found = BlockedRoot::of(300, 1e-12, |i, j| {
            if i == 200 && j == 200 { entry(199, 199) } else { singular(i, j) }
        });
        assert_eq!(found.unwrap_err(), 200);
    }
}
