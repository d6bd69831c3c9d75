//! Sums of vectors over all rows, with factors for many points side by side.

use gumption_engine::number::{CodePath, Kernel};

/// Rows and points that are summed at once, in registers.
const ROWS: usize = 16;
const POINTS: usize = 4;

/// Vectors over all rows, each with its factor at every point.
pub(crate) struct JointSum<'v> {
    points: usize,
    vectors: Vec<&'v [f64]>,
    /// Vector after vector, those of all points.
    factors: Vec<f64>,
}

impl<'v> JointSum<'v> {
    /// Of no vectors yet, at so many points.
    pub(crate) fn new(points: usize) -> Self {
        Self { points, vectors: Vec::new(), factors: Vec::new() }
    }

    /// Adds a vector with factors of 0; they are in [`JointSum::factor`] by its place.
    pub(crate) fn push(&mut self, vector: &'v [f64]) {
        self.vectors.push(vector);
        self.factors.resize(self.factors.len() + self.points, 0.0);
    }

    /// Number of vectors.
    pub(crate) fn len(&self) -> usize {
        self.vectors.len()
    }

    /// The factor of a vector at a point.
    pub(crate) fn factor(&mut self, place: usize, point: usize) -> &mut f64 {
        &mut self.factors[place * self.points + point]
    }

    /// For each point the sum of factor times vector in so many rows, in the order of the vectors.
    pub(crate) fn values(self, rows: usize) -> Vec<Vec<f64>> {
        let mut sums = vec![vec![0.0; rows]; self.points];
        CodePath::best().run(InRows { sum: &self, out: &mut sums });
        sums
    }

    /// The sums at four points in some rows, from these on.
    #[inline(always)]
    fn of_four(&self, point: usize, row: usize, out: &mut [Vec<f64>]) {
        let [mut a, mut b, mut c, mut d] = [[0.0; ROWS]; POINTS];
        for (place, vector) in self.vectors.iter().enumerate() {
            let factors = &self.factors[place * self.points + point..][..POINTS];
            let (e, f, g, h) = (factors[0], factors[1], factors[2], factors[3]);
            // one loop over the rows, whose registers are those of four sums
            let sums = a.iter_mut().zip(&mut b).zip(&mut c).zip(&mut d);
            for ((((a, b), c), d), entry) in sums.zip(&vector[row..row + ROWS]) {
                *a += e * entry;
                *b += f * entry;
                *c += g * entry;
                *d += h * entry;
            }
        }
        for (out, sums) in out[point..point + POINTS].iter_mut().zip([a, b, c, d]) {
            out[row..row + ROWS].copy_from_slice(&sums);
        }
    }

    /// The sum at one point in all rows from these on.
    #[inline(always)]
    fn of_one(&self, point: usize, row: usize, out: &mut [f64]) {
        for (place, vector) in self.vectors.iter().enumerate() {
            let factor = self.factors[place * self.points + point];
            for (sum, entry) in out[row..].iter_mut().zip(&vector[row..]) {
                *sum += factor * entry;
            }
        }
    }
}

struct InRows<'s, 'v> {
    sum: &'s JointSum<'v>,
    out: &'s mut [Vec<f64>],
}

impl Kernel for InRows<'_, '_> {
    type Output = ();

    #[inline(always)]
    fn run(self) {
        let Self { sum, out } = self;
        let rows = out.first().map_or(0, Vec::len);
        let whole_rows = rows - rows % ROWS;
        let whole_points = sum.points - sum.points % POINTS;
        for row in (0..whole_rows).step_by(ROWS) {
            for point in (0..whole_points).step_by(POINTS) {
                sum.of_four(point, row, out);
            }
        }
        for (point, out) in out.iter_mut().enumerate() {
            sum.of_one(point, if point < whole_points { whole_rows } else { 0 }, out);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// 19 rows at 6 points are a block, and rows and points that are left; whole numbers have no rounding.
    #[test]
    fn sums_are_those_of_each_row() {
        let vectors: [Vec<f64>; 2] = [(0..19).map(f64::from).collect(), vec![0.5; 19]];
        let mut sum = JointSum::new(6);
        vectors.iter().for_each(|vector| sum.push(vector));
        for point in 0..6 {
            *sum.factor(0, point) = point as f64;
            *sum.factor(1, point) = 4.0;
        }
        for (point, values) in sum.values(19).into_iter().enumerate() {
            let expected = (0..19).map(|row| (point * row) as f64 + 2.0);
            assert_eq!(values, expected.collect::<Vec<_>>());
        }
    }
}
