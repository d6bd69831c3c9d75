//! Quantities along x, y and z.

use gumption_engine::number::Number;

/// Three quantities along x, y and z.
pub(crate) type Triple<T> = [T; 3];

pub(crate) fn dot<T: Number>(a: Triple<T>, b: Triple<T>) -> T {
    let [a_x, a_y, a_z] = a;
    let [b_x, b_y, b_z] = b;
    a_x * b_x + a_y * b_y + a_z * b_z
}

fn cross<T: Number>(a: Triple<T>, b: Triple<T>) -> Triple<T> {
    let [a_x, a_y, a_z] = a;
    let [b_x, b_y, b_z] = b;
    [a_y * b_z - a_z * b_y, a_z * b_x - a_x * b_z, a_x * b_y - a_y * b_x]
}

/// Sum over the poses of the products of two quantities.
pub(crate) fn sum<T: Number, const POSES: usize>(a: [T; POSES], b: [T; POSES]) -> T {
    a.into_iter().zip(b).fold(T::constant(0.0), |sum, (a, b)| sum + a * b)
}

/// The matrix S of the normal equations S N = M, with the rows of the symmetric matrix N and of M.
pub(crate) fn solve<T: Number>(
    normal: Triple<Triple<T>>,
    moments: Triple<Triple<T>>,
) -> Triple<Triple<T>> {
    // The rows of the inverse of a matrix are the cross products of its columns over the
    // determinant; the matrix is symmetric, so rows and columns are alike.
    let [x, y, z] = normal;
    let (of_x, of_y, of_z) = (cross(y, z), cross(z, x), cross(x, y));
    let determinant = dot(x, of_x);
    moments.map(|moments| [of_x, of_y, of_z].map(|row| dot(moments, row) / determinant))
}
