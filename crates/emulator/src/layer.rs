//! One layer of an emulator: corrections of all rows as functions of a hypothesis' unknowns.

use gumption_engine::linalg::add_multiple;

use crate::axis::Coordinate;
use crate::conditioned::ValueScatter;
use crate::focus::{Focus, nearest_count};
use crate::frame::Frame;
use crate::joint_sum::JointSum;
use crate::lengths::{likeliest_lengths, scattered_lengths};
use crate::prediction::Prediction;
use crate::process::GaussianProcess;
use crate::scatter::Scatter;
use crate::singular::SingularVectors;
use crate::trend::Trend;

/// Singular vectors are kept until what is left has this norm over all rows, in u: the root mean square over
/// the runs.
const LEFT: f64 = 0.1;

/// Coefficients whose lengths are looked for; those of the last one serve the rest.
const WITH_LENGTHS: usize = 3;

/// What a layer is to know.
#[derive(Clone, Debug)]
pub enum Reach<'f> {
    /// All of the prior, of what is nowhere zero.
    Plain,
    /// All of the prior, of a correction that is zero at these points, which count as runs: scaled
    /// coordinates.
    Zero(Vec<Vec<f64>>),
    /// The surroundings of a posterior: it learns from the six runs nearest to it for each unknown, in their
    /// own scale, so that what it knows shrinks with them.
    Near(&'f Focus),
}

/// Corrections of all rows, in u, as a mean and singular vectors (Higdon et al., J. Am. Stat. Assoc. 103
/// (2008) 570), each with a coefficient that is a Gaussian process of the scaled coordinates.
#[derive(Clone, Debug, PartialEq)]
pub struct Layer {
    frame: Option<Frame>,
    mean: Option<Vec<f64>>,
    vectors: Vec<Vec<f64>>,
    /// Coefficients in the order of the vectors: the first ones one by one, then all that share lengths.
    processes: Vec<GaussianProcess>,
    /// How many runs it learnt from.
    runs: usize,
}

impl Layer {
    /// Learns the corrections of some runs, at least one: `points` are scaled coordinates, each with the
    /// correction of every row. Where the runs scatter it learns their mean: directions that the scatter alone
    /// would show are left out.
    pub fn learn(
        points: &[Vec<f64>],
        corrections: &[Vec<f64>],
        reach: &Reach<'_>,
        scatter: Option<&Scatter>,
    ) -> Self {
        let places = match reach {
            // few runs near a posterior would show little but their scatter
            Reach::Near(focus) if scatter.is_none() => {
                focus.nearest(points, nearest_count(points[0].len()))
            }
            _ => (0..points.len()).collect(),
        };
        let mut rows: Vec<Vec<f64>> = places.iter().map(|&run| corrections[run].clone()).collect();
        let mut points: Vec<Vec<f64>> = places.iter().map(|&run| points[run].clone()).collect();
        let mut frame = None;
        if let Reach::Near(_) = reach {
            let about: Vec<&[f64]> = points.iter().map(Vec::as_slice).collect();
            let about = Frame::about(&about);
            for point in &mut points {
                let given: Vec<Coordinate> =
                    point.iter().map(|&at| Coordinate { at, slope: 0.0 }).collect();
                *point = about.of(&given).iter().map(|c| c.at).collect();
            }
            frame = Some(about);
        }
        let (trend, mean) = match reach {
            Reach::Zero(_) => (Trend::None, None),
            _ => (Trend::Linear, Some(mean(&rows))),
        };
        if let Some(mean) = &mean {
            rows.iter_mut().for_each(|row| add_multiple(row, -1.0, mean));
        }
        let mut directions = SingularVectors::of(&rows, LEFT);
        if let Some(scatter) = scatter {
            directions.above(scatter.edge(rows[0].len(), rows.len()));
        }
        let count = directions.vectors.len();
        let mut coefficients = vec![Vec::with_capacity(rows.len()); count];
        for row in &rows {
            for (of, along) in coefficients.iter_mut().zip(directions.coefficients(row)) {
                of.push(along);
            }
        }
        if let Reach::Zero(free) = reach {
            points.extend(free.iter().cloned());
            coefficients.iter_mut().for_each(|of| of.resize(points.len(), 0.0));
        }
        let mut processes = Vec::new();
        let mut lengths: Option<Vec<f64>> = None;
        let mut next = 0;
        let scattered = directions.vectors.iter().map(|vector| ValueScatter {
            variance: scatter.map_or(0.0, |scatter| scatter.along(vector)),
            count: rows.len(),
        });
        let scattered: Vec<ValueScatter> = scattered.collect();
        while next < count {
            let scatter = scattered[next];
            if scatter.variance > 0.0 {
                let values = &coefficients[next];
                let found = scattered_lengths(&points, values, trend, scatter, lengths.as_deref());
                let process =
                    GaussianProcess::scattered(points.clone(), values, trend, &found, scatter);
                processes.push(process);
                lengths = Some(found.ln_lengths);
                next += 1;
                continue;
            }
            let found = likeliest_lengths(&points, &coefficients[next], trend, lengths.as_deref());
            let end = if next + 1 < WITH_LENGTHS { next + 1 } else { count };
            let values = &coefficients[next..end];
            processes.push(GaussianProcess::new(points.clone(), values, trend, &found));
            lengths = Some(found);
            next = end;
        }
        Self { frame, mean, vectors: directions.vectors, processes, runs: rows.len() }
    }

    /// How many singular vectors it has.
    pub fn vectors(&self) -> usize {
        self.vectors.len()
    }

    /// The singular vectors.
    pub(crate) fn directions(&self) -> &[Vec<f64>] {
        &self.vectors
    }

    /// How many runs it learnt from.
    pub(crate) fn runs(&self) -> usize {
        self.runs
    }

    /// What the scatter of the runs leaves at a point: along each singular vector a standard deviation, with a
    /// share.
    pub(crate) fn scattered(&self, point: &[Coordinate], share: f64) -> Vec<Vec<f64>> {
        let (_, at) = self.framed(point);
        let deviations =
            self.processes.iter().flat_map(|process| process.scattered_deviations(&at));
        let of = |(deviation, vector): (f64, &Vec<f64>)| {
            vector.iter().map(|entry| share * deviation * entry).collect()
        };
        deviations.zip(&self.vectors).map(of).collect()
    }

    /// How far a point is among the runs that a local layer learnt from, from 0 to 1, and the derivatives of
    /// that; 1 everywhere of any other.
    pub(crate) fn share(&self, point: &[Coordinate]) -> (f64, Vec<f64>) {
        match &self.frame {
            Some(frame) => frame.share(&frame.of(point)),
            None => (1.0, vec![0.0; point.len()]),
        }
    }

    fn framed(&self, point: &[Coordinate]) -> (Vec<Coordinate>, Vec<f64>) {
        let own = match &self.frame {
            Some(frame) => frame.of(point),
            None => point.to_vec(),
        };
        let at = own.iter().map(|coordinate| coordinate.at).collect();
        (own, at)
    }

    /// Adds a share of the corrections at a point to values of all rows.
    pub(crate) fn add_values(&self, point: &[Coordinate], share: f64, values: &mut [f64]) {
        let (_, at) = self.framed(point);
        if let Some(mean) = &self.mean {
            add_multiple(values, share, mean);
        }
        let coefficients = self.processes.iter().flat_map(|process| process.values(&at));
        for (coefficient, vector) in coefficients.zip(&self.vectors) {
            add_multiple(values, share * coefficient, vector);
        }
    }

    /// Adds shares of the corrections at points to a sum.
    pub(crate) fn add_jointly<'v>(
        &'v self,
        points: &[Vec<Coordinate>],
        shares: &[f64],
        sum: &mut JointSum<'v>,
    ) {
        let first = sum.len();
        let vectors = self.mean.iter().chain(&self.vectors);
        vectors.for_each(|vector| sum.push(vector));
        let serving = points.iter().zip(shares).enumerate().filter(|(_, (_, share))| **share > 0.0);
        for (place, (point, &share)) in serving {
            let (_, at) = self.framed(point);
            let mean = self.mean.iter().map(|_| 1.0);
            let coefficients = self.processes.iter().flat_map(|process| process.values(&at));
            for (vector, coefficient) in mean.chain(coefficients).enumerate() {
                *sum.factor(first + vector, place) = share * coefficient;
            }
        }
    }

    /// Adds a share of the corrections at a point to a prediction, of their gradient along the unknowns that
    /// have these places in it and of their variances.
    pub(crate) fn add(
        &self,
        point: &[Coordinate],
        places: &[usize],
        share: f64,
        to: &mut Prediction,
    ) {
        let (own, at) = self.framed(point);
        if let Some(mean) = &self.mean {
            add_multiple(&mut to.values, share, mean);
        }
        let coefficients = self.processes.iter().flat_map(|process| process.predict(&at));
        for (coefficient, vector) in coefficients.zip(&self.vectors) {
            add_multiple(&mut to.values, share * coefficient.value, vector);
            for ((place, slope), axis) in places.iter().zip(coefficient.gradient).zip(&own) {
                add_multiple(&mut to.gradient[*place], share * slope * axis.slope, vector);
            }
            let variance = share * coefficient.deviation * coefficient.deviation;
            for (sum, entry) in to.deviations.iter_mut().zip(vector) {
                *sum += variance * entry * entry;
            }
        }
    }
}

fn mean(rows: &[Vec<f64>]) -> Vec<f64> {
    let mut mean = vec![0.0; rows[0].len()];
    for row in rows {
        add_multiple(&mut mean, 1.0 / rows.len() as f64, row);
    }
    mean
}
