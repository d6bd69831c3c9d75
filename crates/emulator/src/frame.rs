//! Coordinates about the runs that a local layer learns from.

use crate::axis::Coordinate;

/// Standard deviations of the runs to one unit.
const DEVIATIONS: f64 = 2.0;

/// A point with a coordinate beyond this, four standard deviations of the runs, is outside.
const OUTSIDE: f64 = 2.0;

/// One with all coordinates within this is inside.
const INSIDE: f64 = 1.5;

/// What is added to a scale, so that runs at one place have one.
const LEAST: f64 = 1e-6;

/// The middle of some points and twice their standard deviation in each dimension.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Frame {
    centre: Vec<f64>,
    scale: Vec<f64>,
}

impl Frame {
    /// About points, at least one.
    pub(crate) fn about(points: &[&[f64]]) -> Self {
        let count = points.len() as f64;
        let dimensions = 0..points[0].len();
        let centre: Vec<f64> =
            dimensions.map(|j| points.iter().map(|p| p[j]).sum::<f64>() / count).collect();
        let scale = centre
            .iter()
            .enumerate()
            .map(|(j, centre)| {
                let squares: f64 = points.iter().map(|p| (p[j] - centre) * (p[j] - centre)).sum();
                DEVIATIONS * ((squares / count).sqrt() + LEAST)
            })
            .collect();
        Self { centre, scale }
    }

    /// A point in these coordinates, with slopes by whatever the given ones have them by.
    pub(crate) fn of(&self, point: &[Coordinate]) -> Vec<Coordinate> {
        let axes = self.centre.iter().zip(&self.scale);
        let axes = point.iter().zip(axes).map(|(coordinate, (centre, scale))| Coordinate {
            at: (coordinate.at - centre) / scale,
            slope: coordinate.slope / scale,
        });
        axes.collect()
    }

    /// How far a point of these coordinates is inside: 1 inside, 0 outside, and between them a smooth step
    /// along each; with the derivative along each dimension, by what the coordinates' slopes are by.
    pub(crate) fn share(&self, point: &[Coordinate]) -> (f64, Vec<f64>) {
        let steps: Vec<(f64, f64)> = point
            .iter()
            .map(|coordinate| {
                let left = ((OUTSIDE - coordinate.at.abs()) / (OUTSIDE - INSIDE)).clamp(0.0, 1.0);
                let slope = -6.0 * left * (1.0 - left) / (OUTSIDE - INSIDE);
                let slope = slope.copysign(-coordinate.at) * coordinate.slope;
                (left * left * (3.0 - 2.0 * left), slope)
            })
            .collect();
        let product = |without: Option<usize>| -> f64 {
            let others = steps.iter().enumerate().filter(|(place, _)| Some(*place) != without);
            others.map(|(_, (step, _))| step).product()
        };
        let slope = |(place, (_, slope)): (usize, &(f64, f64))| slope * product(Some(place));
        (product(None), steps.iter().enumerate().map(slope).collect())
    }
}
