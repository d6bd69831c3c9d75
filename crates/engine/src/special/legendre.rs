//! The Gauss-Legendre rule of twenty points, for integrals over a short range.

/// The positive nodes on \[-1, 1\] and their weights, found with 40 digits.
const RULE: [(f64, f64); 10] = [
    (0.076_526_521_133_497_333_755, 0.152_753_387_130_725_850_7),
    (0.227_785_851_141_645_078_08, 0.149_172_986_472_603_746_79),
    (0.373_706_088_715_419_560_67, 0.142_096_109_318_382_051_33),
    (0.510_867_001_950_827_098, 0.131_688_638_449_176_626_9),
    (0.636_053_680_726_515_025_45, 0.118_194_531_961_518_417_31),
    (0.746_331_906_460_150_792_61, 0.101_930_119_817_240_435_04),
    (0.839_116_971_822_218_823_39, 0.083_276_741_576_704_748_725),
    (0.912_234_428_251_325_905_87, 0.062_672_048_334_109_063_57),
    (0.963_971_927_277_913_791_27, 0.040_601_429_800_386_941_331),
    (0.993_128_599_185_094_924_79, 0.017_614_007_139_152_118_312),
];

/// Number of nodes of the rule.
pub(crate) const COUNT: usize = 20;

/// The nodes and weights on \[0, 1\], in ascending order.
pub(crate) fn nodes() -> [[f64; 2]; COUNT] {
    let mut nodes = [[0.0; 2]; COUNT];
    for (i, (node, weight)) in RULE.iter().enumerate() {
        nodes[COUNT / 2 - 1 - i] = [0.5 * (1.0 - node), 0.5 * weight];
        nodes[COUNT / 2 + i] = [0.5 * (1.0 + node), 0.5 * weight];
    }
    nodes
}

/// The integral of a function over a range with the given start and width: exact to rounding if a
/// polynomial of degree 39 approximates the function, such as eight periods of a sine.
pub(crate) fn integrate(start: f64, width: f64, f: impl Fn(f64) -> f64) -> f64 {
    let mut sum = 0.0;
    for (node, weight) in RULE.iter().rev() {
        let (near, far) = (0.5 * (1.0 - node), 0.5 * (1.0 + node));
        sum += weight * (f(start + width * near) + f(start + width * far));
    }
    0.5 * width * sum
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Exact up to degree 39; 1e-14 is rounding.
    #[test]
    fn polynomials_are_integrated() {
        for degree in [0, 1, 7, 20, 39] {
            let found = integrate(0.0, 1.0, |x| x.powi(degree));
            assert!((found * f64::from(degree + 1) - 1.0).abs() < 1e-14, "{degree}: {found}");
            let nodes: f64 = nodes().iter().map(|[x, w]| w * x.powi(degree)).sum();
            assert!((nodes * f64::from(degree + 1) - 1.0).abs() < 1e-14, "{degree}: {nodes}");
        }
    }
}
