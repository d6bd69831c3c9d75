//! The functions that a composed departure may be of a condition or of a quantity's own value.
//!
//! Each is written twice: as numbers, which the search needs a hundred thousand times, and as the text
//! of a formula, which the answer hands over. A test holds the two together.

use gumption_engine::number::{ascending, elementary};

/// The form of a composed departure, by the words that answers have.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum ComposedForm {
    /// The same everywhere.
    Constant,
    /// Proportional to it, or a straight line.
    Slope,
    /// A power, among them parabolas about any place.
    Power,
    /// The square root.
    Root,
    /// The logarithm.
    Logarithm,
    /// One over it, or over its square.
    Reciprocal,
    /// An exponential rise or decay.
    Exponential,
    /// A jump at one place, sharp or smooth.
    Step,
    /// A maximum or minimum of some width.
    Bump,
    /// A sine.
    Wave,
    /// Growth that levels off, or that sets in at one place.
    Saturation,
    /// Amplitude, phase or step response of a first-order system.
    FirstOrder,
    /// Amplitude response of a second-order system.
    SecondOrder,
}

impl ComposedForm {
    /// The word that answers have.
    pub fn name(self) -> &'static str {
        match self {
            Self::Constant => "constant",
            Self::Slope => "slope",
            Self::Power => "power",
            Self::Root => "root",
            Self::Logarithm => "logarithm",
            Self::Reciprocal => "reciprocal",
            Self::Exponential => "exponential",
            Self::Step => "step",
            Self::Bump => "bump",
            Self::Wave => "wave",
            Self::Saturation => "saturation",
            Self::FirstOrder => "first-order",
            Self::SecondOrder => "second-order",
        }
    }
}

/// A function with none, one or two parameters.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Function {
    /// 1.
    One,
    /// x.
    Linear,
    /// x^2.
    Square,
    /// x^3.
    Cube,
    /// x^p.
    Power,
    /// (x - a)^2.
    Parabola,
    /// Square root.
    Root,
    /// Logarithm.
    Logarithm,
    /// 1/x.
    Reciprocal,
    /// 1/x^2.
    ReciprocalSquare,
    /// exp(-x/s).
    Decay,
    /// exp(x/s).
    Growth,
    /// 0 below a threshold and 1 above.
    Step,
    /// A step of some width.
    SmoothStep,
    /// A Gaussian.
    Bump,
    /// A Gaussian of the logarithm.
    LogarithmicBump,
    /// A sine with a phase of its own.
    Wave,
    /// x/(x + s).
    Saturation,
    /// What is beyond a threshold.
    Onset,
    /// Gain of a first-order low pass, less 1.
    LowPass,
    /// Gain of a first-order high pass, less 1.
    HighPass,
    /// A first-order answer to a step.
    StepResponse,
    /// Phase of a first-order system.
    Lag,
    /// Gain of a second-order system, less 1.
    Resonance,
}

/// All functions of something.
const ALL: [Function; 23] = [
    Function::Linear,
    Function::Square,
    Function::Cube,
    Function::Power,
    Function::Parabola,
    Function::Root,
    Function::Logarithm,
    Function::Reciprocal,
    Function::ReciprocalSquare,
    Function::Decay,
    Function::Growth,
    Function::Step,
    Function::SmoothStep,
    Function::Bump,
    Function::LogarithmicBump,
    Function::Wave,
    Function::Saturation,
    Function::Onset,
    Function::LowPass,
    Function::HighPass,
    Function::StepResponse,
    Function::Lag,
    Function::Resonance,
];

/// What a parameter of a function is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Range {
    /// The first letters of its name.
    pub name: &'static str,
    /// What it is a share of.
    pub of: RangeOf,
    /// Its ends; those of a log-uniform one are positive.
    pub ends: [f64; 2],
    /// Whether it is log-uniform.
    pub logarithmic: bool,
    /// Values of the first grid.
    pub(crate) grid: usize,
}

/// What a parameter counts.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum RangeOf {
    /// A value of what the function is of.
    Place,
    /// A difference of two of them.
    Width,
    /// A plain number.
    Number,
}

impl Range {
    /// The value at a share of the range.
    pub fn value(&self, share: f64) -> f64 {
        let [low, high] = self.ends;
        if self.logarithmic {
            low * elementary::pow(high / low, share)
        } else {
            low + (high - low) * share
        }
    }

    /// The derivative of the value by the share.
    pub fn slope(&self, share: f64) -> f64 {
        let [low, high] = self.ends;
        if self.logarithmic { self.value(share) * elementary::ln(high / low) } else { high - low }
    }
}

/// Values of a condition or a quantity at the points of the data.
#[derive(Clone, Debug)]
pub struct Values {
    /// By point.
    pub at: Vec<f64>,
    /// In order, each once.
    levels: Vec<f64>,
    low: f64,
    high: f64,
    size: f64,
}

/// Functions with a place or a width need so many levels.
const LEVELS: usize = 5;

/// Parabolas, powers and the like need so many.
const FEW_LEVELS: usize = 4;

/// Places of a step that are tried, at most.
const MOST_STEPS: usize = 40;

/// Conditions that span this factor are looked at on a logarithmic scale as well.
const LOGARITHMIC: f64 = 5.0;

impl Values {
    /// `None` where they are all the same or not finite.
    pub fn new(at: Vec<f64>) -> Option<Self> {
        let mut levels = at.clone();
        ascending(&mut levels);
        let (low, high) = (*levels.first()?, *levels.last()?);
        let size = low.abs().max(high.abs());
        if !low.is_finite() || !high.is_finite() || high - low <= 1e-9 * size {
            return None;
        }
        levels.dedup_by(|a, b| (*a - *b).abs() <= 1e-9 * size);
        Some(Self { at, levels, low, high, size })
    }

    fn range(&self) -> f64 {
        self.high - self.low
    }
}

/// A function of values, with its parameters' ranges and scales of the data.
#[derive(Clone, Debug)]
pub struct Shape {
    /// The function.
    pub function: Function,
    /// Whether a constant comes with it.
    pub offset: bool,
    /// Of its parameters.
    pub ranges: Vec<Range>,
    low: f64,
    high: f64,
    size: f64,
    /// Places between levels, of steps, and the levels.
    between: Vec<f64>,
    levels: Vec<f64>,
}

impl Shape {
    /// The constant.
    pub fn constant() -> Self {
        let [low, high, size] = [0.0, 1.0, 1.0];
        let (function, offset) = (Function::One, false);
        Self {
            function,
            offset,
            ranges: Vec::new(),
            low,
            high,
            size,
            between: Vec::new(),
            levels: Vec::new(),
        }
    }

    /// All functions of values that these can tell.
    pub fn all(values: &Values) -> Vec<Self> {
        let shapes = ALL.into_iter().filter_map(|function| Self::of(function, values));
        shapes
            .flat_map(|shape| {
                let with_offset =
                    shape.takes_offset().then(|| Self { offset: true, ..shape.clone() });
                std::iter::once(shape).chain(with_offset)
            })
            .collect()
    }

    fn of(function: Function, values: &Values) -> Option<Self> {
        let Values { low, high, size, .. } = *values;
        let range = values.range();
        let levels = values.levels.len();
        let (positive, not_negative) = (low > 0.0, low >= 0.0);
        let wide = positive && high / low > LOGARITHMIC;
        let range_of =
            |name, of, ends, logarithmic, grid| Range { name, of, ends, logarithmic, grid };
        let place = |grid| range_of("at", RangeOf::Place, [low, high], false, grid);
        let width = |name, ends: [f64; 2], grid| {
            range_of(name, RangeOf::Width, ends.map(|end| end * range), true, grid)
        };
        let corner = |grid| {
            let ends = [low.max(size / 300.0) / 10.0, 10.0 * high];
            range_of("c", RangeOf::Place, ends, true, grid)
        };
        let exponent = range_of("p", RangeOf::Number, [0.6, 4.0], false, 12);
        let fits = match function {
            Function::One => false,
            Function::Linear => true,
            Function::Square => levels > 2 && low < 0.0,
            Function::Cube => levels >= FEW_LEVELS && low < 0.0,
            Function::Parabola => levels >= FEW_LEVELS,
            Function::Root => levels > 2 && not_negative,
            Function::Power => levels >= FEW_LEVELS && not_negative,
            Function::Logarithm => levels > 2 && positive && high / low > 1.5,
            Function::Reciprocal | Function::ReciprocalSquare => {
                levels > 2 && positive && high / low > 1.5
            }
            Function::Decay | Function::Growth | Function::Onset => levels >= FEW_LEVELS,
            Function::Step => levels > 2,
            Function::Bump | Function::SmoothStep => levels >= LEVELS,
            Function::LogarithmicBump => levels >= LEVELS && wide,
            Function::Wave => levels > LEVELS,
            Function::Saturation => levels >= FEW_LEVELS && not_negative,
            Function::StepResponse | Function::LowPass | Function::Lag => {
                levels >= FEW_LEVELS && not_negative
            }
            Function::HighPass => levels >= FEW_LEVELS && positive,
            Function::Resonance => levels >= LEVELS && not_negative,
        };
        if !fits {
            return None;
        }
        let ranges = match function {
            Function::Power => vec![exponent],
            Function::Parabola => vec![place(16)],
            Function::Decay | Function::Growth => vec![width("L", [0.03, 3.0], 10)],
            Function::Step => vec![place(0)],
            Function::SmoothStep => vec![place(16), width("w", [0.01, 0.15], 5)],
            Function::Bump => vec![place(20), width("w", [0.03, 0.5], 6)],
            Function::LogarithmicBump => {
                let span = elementary::ln(high / low);
                let ends = [0.03 * span, 0.5 * span];
                let at = range_of("at", RangeOf::Place, [low, high], true, 20);
                vec![at, range_of("w", RangeOf::Number, ends, true, 6)]
            }
            Function::Wave => {
                // frequencies are uniform, to a period of four levels
                let most = (0.25 * (levels - 1) as f64).clamp(1.0, 48.0);
                let grid = (8.0 * most) as usize + 4;
                vec![range_of("n", RangeOf::Number, [0.4 / range, most / range], false, grid)]
            }
            Function::Saturation => vec![corner(12)],
            Function::Onset => vec![place(16)],
            Function::LowPass | Function::HighPass | Function::Lag => vec![corner(14)],
            Function::StepResponse => {
                let ends = [0.02 * size, 3.0 * size];
                vec![range_of("L", RangeOf::Width, ends, true, 12)]
            }
            Function::Resonance => {
                let ends = [low.max(size / 300.0) / 1.5, 4.0 * high];
                let at = range_of("c", RangeOf::Place, ends, true, 24);
                vec![at, range_of("Q", RangeOf::Number, [0.5, 30.0], true, 5)]
            }
            _ => Vec::new(),
        };
        let middles = values.levels.windows(2).map(|pair| 0.5 * (pair[0] + pair[1]));
        let mut between: Vec<f64> = match function {
            Function::Step => middles.collect(),
            _ => Vec::new(),
        };
        let step = between.len().div_ceil(MOST_STEPS).max(1);
        between = between.into_iter().step_by(step).collect();
        let levels = if between.is_empty() { Vec::new() } else { values.levels.clone() };
        Some(Self { function, offset: false, ranges, low, high, size, between, levels })
    }

    fn takes_offset(&self) -> bool {
        !matches!(
            self.function,
            Function::One
                | Function::Parabola
                | Function::Step
                | Function::SmoothStep
                | Function::Bump
                | Function::LogarithmicBump
                | Function::Wave
                | Function::StepResponse
                | Function::Lag
                | Function::Cube
        )
    }

    /// The form that it is one of.
    pub fn form(&self) -> ComposedForm {
        match self.function {
            Function::One => ComposedForm::Constant,
            Function::Linear => ComposedForm::Slope,
            Function::Square | Function::Cube | Function::Power | Function::Parabola => {
                ComposedForm::Power
            }
            Function::Root => ComposedForm::Root,
            Function::Logarithm => ComposedForm::Logarithm,
            Function::Reciprocal | Function::ReciprocalSquare => ComposedForm::Reciprocal,
            Function::Decay | Function::Growth => ComposedForm::Exponential,
            Function::Step | Function::SmoothStep => ComposedForm::Step,
            Function::Bump | Function::LogarithmicBump => ComposedForm::Bump,
            Function::Wave => ComposedForm::Wave,
            Function::Saturation | Function::Onset => ComposedForm::Saturation,
            Function::LowPass | Function::HighPass | Function::StepResponse | Function::Lag => {
                ComposedForm::FirstOrder
            }
            Function::Resonance => ComposedForm::SecondOrder,
        }
    }

    /// Shares of the parameters' ranges that are tried first.
    pub fn grid(&self) -> Vec<Vec<f64>> {
        if self.function == Function::Step {
            let [low, high] = [self.low, self.high];
            return self.between.iter().map(|at| vec![(at - low) / (high - low)]).collect();
        }
        let mut grid = vec![Vec::new()];
        for range in &self.ranges {
            let shares = (0..range.grid).map(|n| (n as f64 + 0.5) / range.grid as f64);
            let shares: Vec<f64> = shares.collect();
            grid = grid
                .into_iter()
                .flat_map(|point: Vec<f64>| {
                    shares.iter().map(move |share| {
                        let mut point = point.clone();
                        point.push(*share);
                        point
                    })
                })
                .collect();
        }
        grid
    }

    /// Number of functions with a factor of their own.
    pub fn count(&self) -> usize {
        1 + usize::from(self.function == Function::Wave) + usize::from(self.offset)
    }

    /// The standard deviation of a place that may be anywhere between the two levels about it.
    pub fn gap_about(&self, place: f64) -> f64 {
        let below =
            self.levels.iter().copied().filter(|level| *level <= place).fold(self.low, f64::max);
        let above =
            self.levels.iter().copied().filter(|level| *level > place).fold(self.high, f64::min);
        (above - below) / 12f64.sqrt()
    }

    /// Whether a search between the values of the grid makes sense.
    pub(crate) fn is_smooth(&self) -> bool {
        !self.ranges.is_empty() && self.function != Function::Step
    }

    /// The parameters at shares of their ranges.
    pub fn parameters(&self, shares: &[f64]) -> Vec<f64> {
        self.ranges.iter().zip(shares).map(|(range, share)| range.value(*share)).collect()
    }

    /// The values of the functions that stand with a factor of their own, one list for each.
    pub fn columns(&self, at: &[f64], parameters: &[f64]) -> Vec<Vec<f64>> {
        let parameter = |n: usize| parameters.get(n).copied().unwrap_or(0.0);
        let (a, b) = (parameter(0), parameter(1));
        let Self { low, high, size, .. } = *self;
        let range = high - low;
        let column =
            |function: &dyn Fn(f64) -> f64| at.iter().map(|&x| function(x)).collect::<Vec<f64>>();
        let squared = |x: f64| x * x;
        let first = match self.function {
            Function::One => column(&|_| 1.0),
            Function::Linear => column(&|x| x / size),
            Function::Square => column(&|x| squared(x / size)),
            Function::Cube => column(&|x| squared(x / size) * (x / size)),
            Function::Power => column(&|x| elementary::pow(x.max(0.0) / size, a)),
            Function::Parabola => column(&|x| squared((x - a) / range)),
            Function::Root => column(&|x| (x.max(0.0) / size).sqrt()),
            Function::Logarithm => column(&|x| elementary::ln(x.max(f64::MIN_POSITIVE) / low)),
            Function::Reciprocal => column(&|x| low / x),
            Function::ReciprocalSquare => column(&|x| squared(low / x)),
            Function::Decay => column(&|x| elementary::exp(-(x - low) / a)),
            Function::Growth => column(&|x| elementary::exp((x - high) / a)),
            Function::Step => column(&|x| f64::from(u8::from(x > a))),
            Function::SmoothStep => column(&|x| 1.0 / (1.0 + elementary::exp(-(x - a) / b))),
            Function::Bump => column(&|x| elementary::exp(-squared((x - a) / b))),
            Function::LogarithmicBump => column(&|x| {
                elementary::exp(-squared(elementary::ln(x.max(f64::MIN_POSITIVE) / a) / b))
            }),
            Function::Wave => column(&|x| elementary::sin(std::f64::consts::TAU * a * (x - low))),
            Function::Saturation => column(&|x| x / (x + a)),
            Function::Onset => column(&|x| (x - a).max(0.0) / range),
            Function::LowPass => column(&|x| 1.0 / (1.0 + squared(x / a)).sqrt() - 1.0),
            Function::HighPass => column(&|x| 1.0 / (1.0 + squared(a / x)).sqrt() - 1.0),
            Function::StepResponse => column(&|x| 1.0 - elementary::exp(-x / a)),
            Function::Lag => column(&|x| elementary::atan(x / a)),
            Function::Resonance => {
                column(&|x| 1.0 / elementary::hypot(1.0 - squared(x / a), x / (a * b)) - 1.0)
            }
        };
        let mut columns = vec![first];
        if self.function == Function::Wave {
            columns.push(column(&|x| elementary::cos(std::f64::consts::TAU * a * (x - low))));
        }
        if self.offset {
            columns.push(column(&|_| 1.0));
        }
        columns
    }

    /// The function as a formula of `x`, of the parameters by these texts; `None` of the constant.
    /// `phase` is the text of a wave's phase.
    pub fn text(&self, x: &str, parameters: &[String], phase: &str) -> Option<String> {
        let number = |value: f64| format!("{value}");
        let Self { low, high, size, .. } = *self;
        let (range, size) = (number(high - low), number(size));
        let less = |value: f64| match value {
            value if value < 0.0 => format!("({x} + {})", number(-value)),
            0.0 => x.to_owned(),
            value => format!("({x} - {})", number(value)),
        };
        let parameter = |n: usize| parameters.get(n).map_or("", String::as_str);
        let (a, b) = (parameter(0), parameter(1));
        Some(match self.function {
            Function::One => return None,
            Function::Linear => format!("{x}/{size}"),
            Function::Square => format!("({x}/{size})^2"),
            Function::Cube => format!("({x}/{size})^3"),
            Function::Power => format!("(max({x}, 0)/{size})^{a}"),
            Function::Parabola => format!("(({x} - {a})/{range})^2"),
            Function::Root => format!("sqrt(max({x}, 0)/{size})"),
            Function::Logarithm => format!("ln({x}/{})", number(low)),
            Function::Reciprocal => format!("{}/({x})", number(low)),
            Function::ReciprocalSquare => format!("({}/({x}))^2", number(low)),
            Function::Decay => format!("exp(-{}/({a}))", less(low)),
            Function::Growth => format!("exp({}/({a}))", less(high)),
            Function::Step => format!("({x} > {a})"),
            Function::SmoothStep => format!("(1/(1 + exp(-({x} - {a})/({b}))))"),
            Function::Bump => format!("exp(-(({x} - {a})/({b}))^2)"),
            Function::LogarithmicBump => format!("exp(-(ln({x}/({a}))/({b}))^2)"),
            Function::Wave => format!("sin(2*pi*{a}*{} + {phase})", less(low)),
            Function::Saturation => format!("{x}/({x} + {a})"),
            Function::Onset => format!("max({x} - {a}, 0)/{range}"),
            Function::LowPass => format!("(1/sqrt(1 + ({x}/({a}))^2) - 1)"),
            Function::HighPass => format!("(1/sqrt(1 + ({a}/({x}))^2) - 1)"),
            Function::StepResponse => format!("(1 - exp(-{x}/({a})))"),
            Function::Lag => format!("atan({x}/({a}))"),
            Function::Resonance => {
                format!("(1/hypot(1 - ({x}/({a}))^2, {x}/({a})/({b})) - 1)")
            }
        })
    }
}
