//! The sets of outputs that may depart alike.

use crate::data::Data;
use gumption_engine::number::largest_first;

/// With at most so many outputs every set of them is looked at.
const MOST_FOR_ALL: usize = 3;

/// Observed outputs that may depart alike.
#[derive(Clone, Debug, PartialEq)]
pub struct OutputSet {
    /// Their places, ascending.
    pub outputs: Vec<usize>,
    /// The prior weight of the set, over that of a single output.
    pub weight: f64,
}

impl OutputSet {
    /// All sets of a few outputs. Of more each alone, all together, and of every size between the set of
    /// those outputs that depart most from the model, where the uncertainties of all are stated.
    pub fn all(data: &Data) -> Vec<Self> {
        let count = data.outputs.len();
        let of = |outputs: Vec<usize>| Self { outputs, weight: 1.0 };
        if count <= MOST_FOR_ALL {
            let has = |set: usize| (0..count).filter(|output| set >> output & 1 == 1).collect();
            let mut sets: Vec<Vec<usize>> = (1..1usize << count).map(has).collect();
            sets.sort_by_key(|set| (set.len(), set.clone()));
            return sets.into_iter().map(of).collect();
        }
        let mut sets: Vec<Self> = (0..count).map(|output| of(vec![output])).collect();
        if let Some(ranked) = by_departure(data) {
            let mut ways = count as f64;
            for size in 2..count {
                ways *= (count + 1 - size) as f64 / size as f64;
                let mut outputs = ranked[..size].to_vec();
                outputs.sort_unstable();
                // the data chose one of so many sets, which have the weight of all single outputs together
                sets.push(Self { outputs, weight: count as f64 / ways });
            }
        }
        sets.push(of((0..count).collect()));
        sets
    }
}

/// The outputs by the sum of their squared residuals over their squared standard uncertainties, largest
/// first; `None` where an uncertainty is not stated.
fn by_departure(data: &Data) -> Option<Vec<usize>> {
    let sums = data.nominal_residuals().into_iter().zip(&data.uncertainties);
    let sums = sums.map(|(residuals, uncertainties)| {
        let pairs = residuals.iter().zip(uncertainties.as_ref()?);
        Some(pairs.map(|(residual, u)| (residual / u) * (residual / u)).sum())
    });
    let sums: Vec<f64> = sums.collect::<Option<_>>()?;
    let mut ranked: Vec<usize> = (0..sums.len()).collect();
    largest_first(&mut ranked, |&output| sums[output]);
    Some(ranked)
}
