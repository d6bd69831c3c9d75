//! The density of trials that are nearly normal: a kernel estimate on a mesh.

use super::{MOST_OUTPUTS, TrialPlace};
use crate::number::elementary::exp;
use rayon::prelude::*;

/// Standard deviations of the kernel that it reaches.
const REACH: f64 = 3.0;

/// Cells in a cube about 0.
pub(super) struct Mesh {
    order: usize,
    cells: usize,
    reach: f64,
}

impl Mesh {
    /// So many cells along each of the coordinates, from -reach to reach.
    pub(super) fn new(order: usize, cells: usize, reach: f64) -> Self {
        Self { order, cells, reach }
    }

    pub(super) fn order(&self) -> usize {
        self.order
    }

    /// How far the middles of the outermost cells are from 0.
    pub(super) fn reach(&self) -> f64 {
        self.reach
    }

    /// Length of a cell.
    pub(super) fn step(&self) -> f64 {
        2.0 * self.reach / (self.cells as f64 - 1.0)
    }

    fn size(&self) -> usize {
        (0..self.order).fold(1, |size, _| size * self.cells)
    }
}

/// The estimate at the middles of the cells, and linear between them.
pub(super) struct Density<'m> {
    mesh: &'m Mesh,
    values: Vec<f32>,
}

impl<'m> Density<'m> {
    /// From the trials that lie within the mesh, with a normal kernel of this standard deviation. The
    /// trials are drawn together so that their variance, 1, is that of the estimate as well.
    pub(super) fn of(mesh: &'m Mesh, trials: &[TrialPlace], width: f64) -> Self {
        let together = (1.0 - width * width).max(0.0).sqrt();
        let (inverse, cells) = (1.0 / mesh.step(), mesh.cells as f64);
        let mut values = vec![0.0_f32; mesh.size()];
        'trials: for place in trials {
            let mut cell = 0;
            for x in &place[..mesh.order] {
                let along = (x * together + mesh.reach) * inverse + 0.5;
                if !(0.0..cells).contains(&along) {
                    continue 'trials;
                }
                cell = cell * mesh.cells + along as usize;
            }
            values[cell] += 1.0;
        }
        let side = (REACH * width * inverse).ceil() as usize;
        let kernel: Vec<f32> =
            (0..=side).map(|k| exp(-0.5 * (k as f64 / (width * inverse)).powi(2)) as f32).collect();
        let mut smooth = vec![0.0; values.len()];
        let mut stride = 1;
        for _ in 0..mesh.order {
            along(stride, mesh.cells, &kernel, &values, &mut smooth);
            std::mem::swap(&mut values, &mut smooth);
            stride *= mesh.cells;
        }
        Self { mesh, values }
    }

    /// The estimate, times a factor that is the same everywhere.
    pub(super) fn at(&self, place: &TrialPlace) -> f64 {
        let cells = self.mesh.cells;
        let inverse = 1.0 / self.mesh.step();
        let mut first = 0;
        let mut weights = [0.0; 1 << MOST_OUTPUTS];
        let mut offsets = [0; 1 << MOST_OUTPUTS];
        weights[0] = 1.0;
        let mut corners = 1;
        let mut stride = self.values.len();
        for x in &place[..self.mesh.order] {
            let along = (x + self.mesh.reach) * inverse;
            if !(0.0..cells as f64 - 1.0).contains(&along) {
                return 0.0;
            }
            stride /= cells;
            let cell = along as usize;
            let beyond = along - cell as f64;
            first += cell * stride;
            for corner in 0..corners {
                weights[corners + corner] = weights[corner] * beyond;
                offsets[corners + corner] = offsets[corner] + stride;
                weights[corner] *= 1.0 - beyond;
            }
            corners *= 2;
        }
        let terms = weights[..corners].iter().zip(&offsets);
        terms.map(|(weight, offset)| weight * f64::from(self.values[first + offset])).sum()
    }
}

/// Smooths along one coordinate, whose neighbouring cells are `stride` apart.
fn along(stride: usize, cells: usize, kernel: &[f32], from: &[f32], to: &mut [f32]) {
    let add = |factor: f32, from: &[f32], to: &mut [f32]| {
        to.iter_mut().zip(from).for_each(|(to, from)| *to += factor * from);
    };
    if stride == 1 {
        to.par_chunks_mut(cells).zip(from.par_chunks(cells)).for_each(|(to, from)| {
            to.fill(0.0);
            add(kernel[0], from, to);
            for (shift, factor) in kernel.iter().enumerate().take(cells).skip(1) {
                add(*factor, &from[shift..], to);
                add(*factor, from, &mut to[shift..]);
            }
        });
        return;
    }
    to.par_chunks_mut(stride).enumerate().for_each(|(row, to)| {
        let at = row % cells;
        to.fill(0.0);
        for other in at.saturating_sub(kernel.len() - 1)..(at + kernel.len()).min(cells) {
            let first = (row - at + other) * stride;
            add(kernel[at.abs_diff(other)], &from[first..first + stride], to);
        }
    });
}
