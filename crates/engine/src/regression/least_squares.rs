//! Linear least squares by Householder reflections.

use crate::linalg::{add_multiple, dot};

/// Parameters, and the root of the normal equations.
#[derive(Clone, Debug, Default)]
pub(super) struct Solution {
    /// The parameters.
    pub(super) parameters: Vec<f64>,
    /// The upper triangle R with R'R = A'A, row by row over the whole square.
    pub(super) triangle: Vec<f64>,
}

/// The x that minimizes |A x - b|; `columns` are those of A one after the other. A and b are
/// overwritten: b becomes Q'b, whose entries after the first ones are the residual.
///
/// # Errors
/// The first column that depends on the previous ones, to `least` of its length.
pub(super) fn solve(
    columns: &mut [f64],
    b: &mut [f64],
    least: f64,
    solution: &mut Solution,
) -> Result<(), usize> {
    let rows = b.len();
    let count = columns.len().checked_div(rows).unwrap_or(0);
    solution.triangle.clear();
    solution.triangle.resize(count * count, 0.0);
    for k in 0..count {
        let (done, rest) = columns.split_at_mut((k + 1) * rows);
        let column = &mut done[k * rows..];
        let whole = dot(column, column);
        for (j, entry) in column[..k].iter().enumerate() {
            solution.triangle[j * count + k] = *entry;
        }
        let left = if k < rows { dot(&column[k..], &column[k..]) } else { 0.0 };
        let length = left.sqrt();
        if length <= least * whole.sqrt() || !length.is_finite() {
            return Err(k);
        }
        let pivot = if column[k] > 0.0 { -length } else { length };
        solution.triangle[k * count + k] = pivot;
        // the reflection's direction, with |v|^2/2
        column[k] -= pivot;
        let half = -pivot * column[k];
        let direction = &column[k..];
        for other in rest.chunks_exact_mut(rows).chain(std::iter::once(&mut *b)) {
            let factor = dot(direction, &other[k..]) / half;
            add_multiple(&mut other[k..], -factor, direction);
        }
    }
    solution.parameters.clear();
    solution.parameters.extend_from_slice(&b[..count]);
    for k in (0..count).rev() {
        let row = &solution.triangle[k * count..(k + 1) * count];
        let known: f64 = (k + 1..count).map(|j| row[j] * solution.parameters[j]).sum();
        solution.parameters[k] = (solution.parameters[k] - known) / row[k];
    }
    Ok(())
}

/// Replaces b by the solution of R'R x = b.
pub(super) fn solve_normal(triangle: &[f64], b: &mut [f64]) {
    let count = b.len();
    for k in 0..count {
        let known: f64 = (0..k).map(|j| triangle[j * count + k] * b[j]).sum();
        b[k] = (b[k] - known) / triangle[k * count + k];
    }
    for k in (0..count).rev() {
        let row = &triangle[k * count..(k + 1) * count];
        let known: f64 = (k + 1..count).map(|j| row[j] * b[j]).sum();
        b[k] = (b[k] - known) / row[k];
    }
}

/// The inverse of R'R, row by row.
pub(super) fn inverse_of_normal(triangle: &[f64], count: usize) -> Vec<f64> {
    // the inverse of R, also upper triangular
    let mut inverse = vec![0.0; count * count];
    for k in 0..count {
        inverse[k * count + k] = 1.0 / triangle[k * count + k];
        for i in (0..k).rev() {
            let sum: f64 =
                (i + 1..=k).map(|j| triangle[i * count + j] * inverse[j * count + k]).sum();
            inverse[i * count + k] = -sum / triangle[i * count + i];
        }
    }
    let mut product = vec![0.0; count * count];
    for i in 0..count {
        for j in 0..=i {
            let rows = inverse[i * count..(i + 1) * count].iter();
            let sum = rows.zip(&inverse[j * count..(j + 1) * count]).skip(i).map(|(a, b)| a * b);
            let sum: f64 = sum.sum();
            product[i * count + j] = sum;
            product[j * count + i] = sum;
        }
    }
    product
}

#[cfg(test)]
mod tests {
    use super::*;

    /// NIST StRD Longley: six regressors of very different size, nearly dependent; the certified
    /// parameters. Householder's reflections give at least 8 digits.
    #[test]
    fn longley() {
        const DATA: [[f64; 7]; 16] = [
            [60323.0, 83.0, 234_289.0, 2356.0, 1590.0, 107_608.0, 1947.0],
            [61122.0, 88.5, 259_426.0, 2325.0, 1456.0, 108_632.0, 1948.0],
            [60171.0, 88.2, 258_054.0, 3682.0, 1616.0, 109_773.0, 1949.0],
            [61187.0, 89.5, 284_599.0, 3351.0, 1650.0, 110_929.0, 1950.0],
            [63221.0, 96.2, 328_975.0, 2099.0, 3099.0, 112_075.0, 1951.0],
            [63639.0, 98.1, 346_999.0, 1932.0, 3594.0, 113_270.0, 1952.0],
            [64989.0, 99.0, 365_385.0, 1870.0, 3547.0, 115_094.0, 1953.0],
            [63761.0, 100.0, 363_112.0, 3578.0, 3350.0, 116_219.0, 1954.0],
            [66019.0, 101.2, 397_469.0, 2904.0, 3048.0, 117_388.0, 1955.0],
            [67857.0, 104.6, 419_180.0, 2822.0, 2857.0, 118_734.0, 1956.0],
            [68169.0, 108.4, 442_769.0, 2936.0, 2798.0, 120_445.0, 1957.0],
            [66513.0, 110.8, 444_546.0, 4681.0, 2637.0, 121_950.0, 1958.0],
            [68655.0, 112.6, 482_704.0, 3813.0, 2552.0, 123_366.0, 1959.0],
            [69564.0, 114.2, 502_601.0, 3931.0, 2514.0, 125_368.0, 1960.0],
            [69331.0, 115.7, 518_173.0, 4806.0, 2572.0, 127_852.0, 1961.0],
            [70551.0, 116.9, 554_894.0, 4007.0, 2827.0, 130_081.0, 1962.0],
        ];
        let certified = [
            -3_482_258.634_595_82,
            15.061_872_271_373_3,
            -0.358_191_792_925_910e-1,
            -2.020_229_803_816_83,
            -1.033_226_867_173_59,
            -0.511_041_056_535_807e-1,
            1_829.151_464_613_55,
        ];
        let mut columns: Vec<f64> = vec![1.0; 16];
        (1..7).for_each(|k| columns.extend(DATA.iter().map(|row| row[k])));
        let mut y: Vec<f64> = DATA.iter().map(|row| row[0]).collect();
        let mut solution = Solution::default();
        solve(&mut columns, &mut y, 1e-14, &mut solution).unwrap();
        for (found, certified) in solution.parameters.iter().zip(certified) {
            assert!((found / certified - 1.0).abs() < 1e-8, "{found} {certified}");
        }
        let left: f64 = y[7..].iter().map(|r| r * r).sum();
        assert!(((left / 9.0).sqrt() / 304.854_073_561_965 - 1.0).abs() < 1e-9);
    }

    #[test]
    fn a_dependent_column_is_named() {
        let mut columns = vec![1.0, 1.0, 1.0, 1.0, 2.0, 3.0, 3.0, 5.0, 7.0];
        let mut y = vec![1.0, 0.0, 2.0];
        let found = solve(&mut columns, &mut y, 1e-12, &mut Solution::default());
        assert_eq!(found, Err(2));
    }
}
