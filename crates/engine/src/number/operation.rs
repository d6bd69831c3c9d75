//! The only list of the operations of the arithmetic.

/// An operation of one operand. Angles are in radians.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Unary {
    /// `-x`
    Negate,
    /// modulus
    Abs,
    /// square root
    Sqrt,
    /// cube root
    Cbrt,
    /// exponential
    Exp,
    /// natural logarithm
    Ln,
    /// logarithm to base ten
    Log10,
    /// sine
    Sin,
    /// cosine
    Cos,
    /// tangent
    Tan,
    /// inverse sine
    Asin,
    /// inverse cosine
    Acos,
    /// inverse tangent
    Atan,
    /// hyperbolic sine
    Sinh,
    /// hyperbolic cosine
    Cosh,
    /// hyperbolic tangent
    Tanh,
    /// inverse hyperbolic sine
    Asinh,
    /// inverse hyperbolic cosine, not negative
    Acosh,
    /// inverse hyperbolic tangent
    Atanh,
    /// `exp(x) - 1`, without cancellation near 0
    ExpMinusOne,
    /// `ln(1 + x)`, without cancellation near 0
    LnOnePlus,
    /// the largest whole number that is not above
    Floor,
    /// the smallest whole number that is not below
    Ceil,
    /// the nearest whole number; halves away from 0
    Round,
    /// error function
    Erf,
    /// gamma function
    Gamma,
}

impl Unary {
    /// The name in formulas and messages.
    pub fn name(self) -> &'static str {
        match self {
            Self::Negate => "-",
            Self::Abs => "abs",
            Self::Sqrt => "sqrt",
            Self::Cbrt => "cbrt",
            Self::Exp => "exp",
            Self::Ln => "ln",
            Self::Log10 => "log10",
            Self::Sin => "sin",
            Self::Cos => "cos",
            Self::Tan => "tan",
            Self::Asin => "asin",
            Self::Acos => "acos",
            Self::Atan => "atan",
            Self::Sinh => "sinh",
            Self::Cosh => "cosh",
            Self::Tanh => "tanh",
            Self::Asinh => "asinh",
            Self::Acosh => "acosh",
            Self::Atanh => "atanh",
            Self::ExpMinusOne => "expm1",
            Self::LnOnePlus => "log1p",
            Self::Floor => "floor",
            Self::Ceil => "ceil",
            Self::Round => "round",
            Self::Erf => "erf",
            Self::Gamma => "gamma",
        }
    }
}

/// An operation of two operands.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Binary {
    /// `x + y`
    Add,
    /// `x - y`
    Subtract,
    /// `x * y`
    Multiply,
    /// `x / y`
    Divide,
    /// `x ^ y`
    Power,
    /// angle of the point (y, x) of `atan2(x, y)`
    Atan2,
    /// `sqrt(x^2 + y^2)`
    Hypot,
    /// the smaller
    Min,
    /// the larger
    Max,
    /// 1 if `x < y`, else 0
    Less,
    /// 1 if `x <= y`, else 0
    LessOrEqual,
    /// 1 if `x = y`, else 0
    Equal,
    /// 1 if `x != y`, else 0
    NotEqual,
    /// the remainder of `x` modulo `y`, with the sign of `y`
    Modulo,
    /// `y` if `x` is not 0, else 0 whatever `y` is: the branch of a choice that is taken
    When,
    /// `y` if `x` is 0, else 0 whatever `y` is: the other branch
    Unless,
}

impl Binary {
    /// The name in formulas and messages.
    pub fn name(self) -> &'static str {
        match self {
            Self::Add => "+",
            Self::Subtract => "-",
            Self::Multiply => "*",
            Self::Divide => "/",
            Self::Power => "^",
            Self::Atan2 => "atan2",
            Self::Hypot => "hypot",
            Self::Min => "min",
            Self::Max => "max",
            Self::Less => "<",
            Self::LessOrEqual => "<=",
            Self::Equal => "==",
            Self::NotEqual => "!=",
            Self::Modulo => "mod",
            Self::When => "if",
            Self::Unless => "if not",
        }
    }

    /// Whether the name stands between the operands rather than before them.
    pub fn is_infix(self) -> bool {
        !matches!(
            self,
            Self::Atan2
                | Self::Hypot
                | Self::Min
                | Self::Max
                | Self::Modulo
                | Self::When
                | Self::Unless
        )
    }

    /// Whether the result has zero slope wherever it has one.
    pub fn is_flat(self) -> bool {
        matches!(self, Self::Less | Self::LessOrEqual | Self::Equal | Self::NotEqual)
    }

    /// Whether the result is one of the operands or a number: the operand that is not taken has no
    /// effect, even if it is steep or undefined.
    pub fn chooses(self) -> bool {
        matches!(self, Self::Min | Self::Max | Self::When | Self::Unless)
    }
}
