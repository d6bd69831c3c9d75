//! The functions that a formula may call.

use crate::number::{Binary, Unary};

/// A function.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Function {
    /// Of one argument.
    One(Unary),
    /// Of two arguments.
    Two(Binary),
    /// Of two or more arguments, which are taken together from left to right.
    Fold(Binary),
    /// The sum of its arguments; read as one with `+`.
    Sum,
    /// The mean of its arguments; read as a sum over their number.
    Mean,
    /// One of two branches, by a condition.
    If,
    /// A value between the points of a table; read apart, for its texts.
    Table,
    /// The root of a formula; read apart, for the unknown.
    Solve,
    /// The thermodynamic temperature of a Celsius temperature.
    Kelvin,
    /// The Celsius temperature of a thermodynamic one.
    Celsius,
    /// A part of a complex number.
    Part(ComplexPart),
}

/// What is taken of a complex number.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum ComplexPart {
    Real,
    Imaginary,
    Argument,
    Conjugate,
}

/// All functions, in the order in which messages list them.
const FUNCTIONS: [Function; 41] = [
    Function::One(Unary::Sin),
    Function::One(Unary::Cos),
    Function::One(Unary::Tan),
    Function::One(Unary::Asin),
    Function::One(Unary::Acos),
    Function::One(Unary::Atan),
    Function::Two(Binary::Atan2),
    Function::One(Unary::Sinh),
    Function::One(Unary::Cosh),
    Function::One(Unary::Tanh),
    Function::One(Unary::Exp),
    Function::One(Unary::Ln),
    Function::One(Unary::Log10),
    Function::One(Unary::Sqrt),
    Function::One(Unary::Cbrt),
    Function::One(Unary::Abs),
    Function::Fold(Binary::Min),
    Function::Fold(Binary::Max),
    Function::Fold(Binary::Hypot),
    Function::Sum,
    Function::Mean,
    Function::Kelvin,
    Function::Celsius,
    Function::Part(ComplexPart::Real),
    Function::Part(ComplexPart::Imaginary),
    Function::Part(ComplexPart::Argument),
    Function::Part(ComplexPart::Conjugate),
    Function::One(Unary::Floor),
    Function::One(Unary::Ceil),
    Function::One(Unary::Round),
    Function::Two(Binary::Modulo),
    Function::One(Unary::ExpMinusOne),
    Function::One(Unary::LnOnePlus),
    Function::One(Unary::Asinh),
    Function::One(Unary::Acosh),
    Function::One(Unary::Atanh),
    Function::One(Unary::Erf),
    Function::One(Unary::Gamma),
    Function::If,
    Function::Table,
    Function::Solve,
];

/// How many arguments a function takes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Arity {
    /// One.
    One,
    /// Two.
    Two,
    /// Two or more.
    TwoOrMore,
    /// Three.
    Three,
    /// Two to five.
    TwoToFive,
    /// Four.
    Four,
}

impl Arity {
    /// Whether that many arguments are right.
    pub fn admits(self, count: usize) -> bool {
        match self {
            Self::One => count == 1,
            Self::Two => count == 2,
            Self::TwoOrMore => count >= 2,
            Self::Three => count == 3,
            Self::TwoToFive => (2..=5).contains(&count),
            Self::Four => count == 4,
        }
    }

    /// Words such as `two arguments`.
    pub fn describe(self) -> &'static str {
        match self {
            Self::One => "one argument",
            Self::Two => "two arguments",
            Self::TwoOrMore => "two or more arguments",
            Self::Three => "three arguments",
            Self::TwoToFive => "two to five arguments",
            Self::Four => "four arguments",
        }
    }
}

impl Function {
    /// All functions.
    pub(super) fn all() -> impl Iterator<Item = Self> {
        FUNCTIONS.into_iter()
    }

    /// The function of that name.
    pub(super) fn named(name: &str) -> Option<Self> {
        Self::all().find(|function| function.name() == name)
    }

    /// The name.
    pub(super) fn name(self) -> &'static str {
        match self {
            Self::One(operation) => operation.name(),
            Self::Two(operation) | Self::Fold(operation) => operation.name(),
            Self::Sum => "sum",
            Self::Mean => "mean",
            Self::If => "if",
            Self::Table => "table",
            Self::Solve => "solve",
            Self::Kelvin => "kelvin",
            Self::Celsius => "celsius",
            Self::Part(ComplexPart::Real) => "re",
            Self::Part(ComplexPart::Imaginary) => "im",
            Self::Part(ComplexPart::Argument) => "arg",
            Self::Part(ComplexPart::Conjugate) => "conj",
        }
    }

    /// Whether its argument is an angle.
    pub(super) fn takes_angle(self) -> bool {
        matches!(self, Self::One(Unary::Sin | Unary::Cos | Unary::Tan))
    }

    /// Whether no quantity may be called so. A coefficient of expansion is called gamma, and the parts
    /// of complex numbers and a mean have names that results have: those name a quantity where no
    /// parenthesis follows.
    pub(super) fn is_reserved(self) -> bool {
        !matches!(self, Self::One(Unary::Gamma) | Self::Mean | Self::Part(_))
    }

    /// How many arguments it takes.
    pub(super) fn arity(self) -> Arity {
        match self {
            Self::One(_) | Self::Kelvin | Self::Celsius | Self::Part(_) => Arity::One,
            Self::Two(_) => Arity::Two,
            Self::Fold(_) | Self::Sum | Self::Mean => Arity::TwoOrMore,
            Self::If => Arity::Three,
            Self::Table => Arity::TwoToFive,
            Self::Solve => Arity::Four,
        }
    }
}

/// The names of the functions that a formula may call, and how many arguments each takes.
pub fn functions() -> impl Iterator<Item = (&'static str, Arity)> {
    Function::all().map(|function| (function.name(), function.arity()))
}
