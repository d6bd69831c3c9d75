//! What a hypothesis adds to those with fewer effects.

use gumption_engine::linalg::add_multiple;

use crate::axis::Coordinate;
use crate::focus::Focus;
use crate::joint_sum::JointSum;
use crate::layer::{Layer, Reach};
use crate::prediction::Prediction;
use crate::scatter::Scatter;

/// The corrections of a hypothesis: a layer that knows them everywhere, and where the posterior is narrow one
/// that knows them there. The local one serves among its runs, the other far from them: hypotheses with more
/// effects may have their posteriors there. Between them one passes into the other smoothly.
#[derive(Clone, Debug, PartialEq)]
pub struct Correction {
    everywhere: Layer,
    near: Option<Layer>,
}

impl Correction {
    /// Learns the corrections of some runs, at least one: `points` are scaled coordinates, each with the
    /// correction of every row. Where runs scatter there is no local layer, as runs near each other show little but
    /// their scatter; `reach` is that of the layer that knows all of the prior.
    pub fn learn(
        points: &[Vec<f64>],
        corrections: &[Vec<f64>],
        reach: &Reach<'_>,
        focus: Option<&Focus>,
        scatter: Option<&Scatter>,
    ) -> Self {
        let focus = focus.filter(|focus| focus.is_narrow() && scatter.is_none());
        let learn = |reach: &Reach<'_>| Layer::learn(points, corrections, reach, scatter);
        let near = focus.map(|focus| learn(&Reach::Near(focus)));
        Self { everywhere: learn(reach), near }
    }

    /// The layer that knows all of the prior.
    pub fn everywhere(&self) -> &Layer {
        &self.everywhere
    }

    /// The layer that knows the surroundings of a narrow posterior.
    pub fn near(&self) -> Option<&Layer> {
        self.near.as_ref()
    }

    /// The layers that serve at a point, with their shares.
    pub(crate) fn serving(&self, point: &[Coordinate]) -> impl Iterator<Item = (f64, &Layer)> {
        let layers = self.shares(point).into_iter().zip([Some(&self.everywhere), self.near()]);
        let serves = |(share, layer): (f64, Option<_>)| Some((share, layer?));
        layers.filter(|(share, _)| *share > 0.0).filter_map(serves)
    }

    /// The shares of the layer that knows all of the prior and of the local one.
    fn shares(&self, point: &[Coordinate]) -> [f64; 2] {
        let near = self.near.as_ref().map_or(0.0, |near| near.share(point).0);
        [1.0 - near, near]
    }

    /// Adds the corrections at points to a sum, with their factors.
    pub(crate) fn add_jointly<'v>(&'v self, points: &[Vec<Coordinate>], sum: &mut JointSum<'v>) {
        let shares: Vec<[f64; 2]> = points.iter().map(|point| self.shares(point)).collect();
        for (which, layer) in [Some(&self.everywhere), self.near()].into_iter().enumerate() {
            let shares: Vec<f64> = shares.iter().map(|shares| shares[which]).collect();
            if let Some(layer) = layer.filter(|_| shares.iter().any(|share| *share > 0.0)) {
                layer.add_jointly(points, &shares, sum);
            }
        }
    }

    /// Adds the corrections at a point to values of all rows.
    pub(crate) fn add_values(&self, point: &[Coordinate], values: &mut [f64]) {
        for (share, layer) in self.serving(point) {
            layer.add_values(point, share, values);
        }
    }

    /// Adds the corrections at a point to a prediction, with their gradient along the unknowns that have
    /// these places in it and their variances.
    pub(crate) fn add(&self, point: &[Coordinate], places: &[usize], to: &mut Prediction) {
        for (share, layer) in self.serving(point) {
            layer.add(point, places, share, to);
        }
        let Some(near) = &self.near else { return };
        let (share, slopes) = near.share(point);
        if share > 0.0 && share < 1.0 {
            let mut change = vec![0.0; to.values.len()];
            near.add_values(point, 1.0, &mut change);
            self.everywhere.add_values(point, -1.0, &mut change);
            for (place, slope) in places.iter().zip(slopes) {
                add_multiple(&mut to.gradient[*place], slope, &change);
            }
        }
    }
}
