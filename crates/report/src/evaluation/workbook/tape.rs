//! The operations of a model as formulas of a spreadsheet: values forward, sensitivity coefficients
//! backward from each output, so that a workbook follows when an estimate is changed.

use gumption_engine::model::{Node, Program};
use gumption_engine::number::{Binary, Dual, Number, Unary};

/// Terms of a formula, at most.
const MOST_TERMS: usize = 200;

/// Larger numbers are left to the program.
const LARGEST: f64 = 1e150;

/// One operation at some values of the variables.
#[derive(Clone, Debug)]
pub(super) struct TapeStep {
    pub(super) node: Node,
    pub(super) value: f64,
    /// What the result changes by with each operand; `None` where an operand does not vary.
    pub(super) slopes: [Option<f64>; 2],
    /// What each output changes by with the result; 0 where it does not depend on it.
    pub(super) adjoints: Vec<f64>,
    /// For each output whether it depends on the result.
    pub(super) reach: Vec<bool>,
    /// The later steps that this one enters, and as which operand.
    pub(super) users: Vec<(usize, usize)>,
    /// Whether it depends on a variable.
    pub(super) varies: bool,
}

/// All operations.
#[derive(Clone, Debug)]
pub(super) struct Tape {
    pub(super) steps: Vec<TapeStep>,
    /// For each output its step.
    pub outputs: Vec<usize>,
    /// For each variable its step, if the model uses it.
    pub variables: Vec<Option<usize>>,
}

impl Tape {
    /// The tape at some values; `None` where a spreadsheet could not follow: a number that is not
    /// finite or very large, or a quantity that enters hundreds of operations.
    pub(super) fn of(program: &Program, variables: &[f64]) -> Option<Self> {
        let mut steps: Vec<TapeStep> = Vec::with_capacity(program.nodes.len());
        let mut places = vec![None; program.variables];
        for (place, &node) in program.nodes.iter().enumerate() {
            let (value, slopes, varies) = match node {
                Node::Variable(v) => {
                    *places.get_mut(v)? = Some(place);
                    (variables.get(v).copied().unwrap_or(0.0), [None; 2], true)
                }
                Node::Constant(c) => (c, [None; 2], false),
                // a spreadsheet has neither interpolation nor roots of equations
                Node::Routine(_) => return None,
                Node::Unary(operation, x) => {
                    let operand = steps.get(x)?;
                    if operation == Unary::Gamma && operand.value <= 0.0 {
                        return None;
                    }
                    let found = Dual::<1>::variable(operand.value, 0).unary(operation);
                    let slope = operand.varies.then_some(found.gradient[0]);
                    (found.value, [slope, None], operand.varies)
                }
                Node::Binary(operation, x, y) => {
                    let (a, b) = (steps.get(x)?, steps.get(y)?);
                    let first = Dual::<2>::variable(a.value, 0);
                    let found = first.binary(operation, Dual::variable(b.value, 1));
                    let slope =
                        |of: &TapeStep, which: usize| of.varies.then_some(found.gradient[which]);
                    (found.value, [slope(a, 0), slope(b, 1)], a.varies || b.varies)
                }
            };
            let all = slopes.iter().flatten().chain([&value]);
            if !all.into_iter().all(|number| number.abs() < LARGEST) {
                return None;
            }
            let outputs = program.outputs.len();
            let (adjoints, reach, users) = (vec![0.0; outputs], vec![false; outputs], Vec::new());
            steps.push(TapeStep { node, value, slopes, adjoints, reach, users, varies });
        }
        let mut tape = Self { steps, outputs: program.outputs.clone(), variables: places };
        tape.backward()?;
        Some(tape)
    }

    /// Fills in users and adjoints.
    fn backward(&mut self) -> Option<()> {
        for place in 0..self.steps.len() {
            let operands = match self.steps.get(place)?.node {
                Node::Variable(_) | Node::Constant(_) | Node::Routine(_) => continue,
                Node::Unary(_, x) => vec![(x, 0)],
                Node::Binary(_, x, y) => vec![(x, 0), (y, 1)],
            };
            for (operand, which) in operands {
                let operand = self.steps.get_mut(operand)?;
                if operand.varies {
                    operand.users.push((place, which));
                    if operand.users.len() > MOST_TERMS {
                        return None;
                    }
                }
            }
        }
        for output in 0..self.outputs.len() {
            for place in (0..self.steps.len()).rev() {
                let own = f64::from(u8::from(self.outputs.get(output) == Some(&place)));
                let step = self.steps.get(place)?;
                let sum = step.users.iter().try_fold(own, |sum, &(user, which)| {
                    let user = self.steps.get(user)?;
                    Some(sum + user.adjoints.get(output)? * user.slopes.get(which)?.unwrap_or(0.0))
                })?;
                if sum.abs() >= LARGEST || sum.is_nan() {
                    return None;
                }
                let used = step.users.iter().any(|&(user, _)| self.reaches(user, output));
                let step = self.steps.get_mut(place)?;
                *step.adjoints.get_mut(output)? = sum;
                *step.reach.get_mut(output)? = used || own > 0.0;
            }
        }
        Some(())
    }

    /// Whether an output depends on a step.
    pub(super) fn reaches(&self, step: usize, output: usize) -> bool {
        self.steps.get(step).and_then(|step| step.reach.get(output)).copied().unwrap_or(false)
    }
}

/// The value of an operation, from the cells of its operands.
pub(super) fn value(node: Node, cell: &dyn Fn(usize) -> String) -> Option<String> {
    Some(match node {
        Node::Variable(_) | Node::Constant(_) | Node::Routine(_) => return None,
        Node::Unary(operation, x) => {
            let x = cell(x);
            match operation {
                Unary::Negate => format!("-{x}"),
                Unary::Abs => format!("ABS({x})"),
                Unary::Sqrt => format!("SQRT({x})"),
                Unary::Cbrt => format!("SIGN({x})*ABS({x})^(1/3)"),
                Unary::Exp => format!("EXP({x})"),
                Unary::Ln => format!("LN({x})"),
                Unary::Log10 => format!("LOG10({x})"),
                Unary::Sin => format!("SIN({x})"),
                Unary::Cos => format!("COS({x})"),
                Unary::Tan => format!("TAN({x})"),
                Unary::Asin => format!("ASIN({x})"),
                Unary::Acos => format!("ACOS({x})"),
                Unary::Atan => format!("ATAN({x})"),
                Unary::Sinh => format!("SINH({x})"),
                Unary::Cosh => format!("COSH({x})"),
                Unary::Tanh => format!("TANH({x})"),
                Unary::Asinh => format!("ASINH({x})"),
                Unary::Acosh => format!("ACOSH({x})"),
                Unary::Atanh => format!("ATANH({x})"),
                // in forms that lose no digits near 0
                Unary::ExpMinusOne => format!("2*EXP({x}/2)*SINH({x}/2)"),
                Unary::LnOnePlus => format!("2*ATANH({x}/(2+{x}))"),
                Unary::Floor => format!("INT({x})"),
                Unary::Ceil => format!("-INT(-{x})"),
                Unary::Round => format!("ROUND({x},0)"),
                Unary::Erf => format!("ERF({x})"),
                Unary::Gamma => format!("_xlfn.GAMMA({x})"),
            }
        }
        Node::Binary(operation, x, y) => {
            let (x, y) = (cell(x), cell(y));
            match operation {
                Binary::Add => format!("{x}+{y}"),
                Binary::Subtract => format!("{x}-{y}"),
                Binary::Multiply => format!("{x}*{y}"),
                Binary::Divide => format!("{x}/{y}"),
                Binary::Power => format!("IF({y}=0,1,POWER({x},{y}))"),
                // the spreadsheet's takes the abscissa first
                Binary::Atan2 => format!("IF(AND({x}=0,{y}=0),0,ATAN2({y},{x}))"),
                Binary::Hypot => format!("SQRT(SUMSQ({x},{y}))"),
                Binary::Min => format!("IF({y}<{x},{y},{x})"),
                Binary::Max => format!("IF({y}>{x},{y},{x})"),
                Binary::Less => format!("IF({x}<{y},1,0)"),
                Binary::LessOrEqual => format!("IF({x}<={y},1,0)"),
                Binary::Equal => format!("IF({x}={y},1,0)"),
                Binary::NotEqual => format!("IF({x}<>{y},1,0)"),
                Binary::Modulo => format!("MOD({x},{y})"),
                Binary::When => format!("IF({x}<>0,{y},0)"),
                Binary::Unless => format!("IF({x}=0,{y},0)"),
            }
        }
    })
}

/// What the result changes by with an operand, from the cells of the operands and of the result.
pub(super) fn slope(
    node: Node,
    which: usize,
    cell: &dyn Fn(usize) -> String,
    result: &str,
) -> Option<String> {
    Some(match node {
        Node::Variable(_) | Node::Constant(_) | Node::Routine(_) => return None,
        Node::Unary(operation, x) => {
            let x = cell(x);
            match operation {
                Unary::Negate => "-1".to_owned(),
                Unary::Abs => format!("SIGN({x})"),
                Unary::Sqrt => format!("0.5/{result}"),
                Unary::Cbrt => format!("1/(3*{result}*{result})"),
                Unary::Exp => result.to_owned(),
                Unary::Ln => format!("1/{x}"),
                Unary::Log10 => format!("1/({x}*LN(10))"),
                Unary::Sin => format!("COS({x})"),
                Unary::Cos => format!("-SIN({x})"),
                Unary::Tan => format!("1+{result}*{result}"),
                Unary::Asin => format!("1/SQRT((1-{x})*(1+{x}))"),
                Unary::Acos => format!("-1/SQRT((1-{x})*(1+{x}))"),
                Unary::Atan => format!("1/(1+{x}*{x})"),
                Unary::Sinh => format!("COSH({x})"),
                Unary::Cosh => format!("SINH({x})"),
                Unary::Tanh => format!("1/(COSH({x})*COSH({x}))"),
                Unary::Asinh => format!("1/SQRT(SUMSQ(1,{x}))"),
                Unary::Acosh => format!("1/SQRT(({x}-1)*({x}+1))"),
                Unary::Atanh => format!("1/((1-{x})*(1+{x}))"),
                Unary::ExpMinusOne => format!("EXP({x})"),
                Unary::LnOnePlus => format!("1/(1+{x})"),
                Unary::Floor | Unary::Ceil | Unary::Round => "0".to_owned(),
                Unary::Erf => format!("2/SQRT(PI())*EXP(-{x}*{x})"),
                Unary::Gamma => format!("{result}*{}", digamma(&x)),
            }
        }
        Node::Binary(operation, x, y) => {
            let (x, y) = (cell(x), cell(y));
            match (operation, which) {
                (Binary::Add, _) | (Binary::Subtract, 0) => "1".to_owned(),
                (Binary::Subtract, _) => "-1".to_owned(),
                (Binary::Multiply, 0) => y,
                (Binary::Multiply, _) => x,
                (Binary::Divide, 0) => format!("1/{y}"),
                (Binary::Divide, _) => format!("-{result}/{y}"),
                (Binary::Power, 0) => {
                    format!("IF({y}=0,0,IF({y}=1,1,{y}*POWER({x},{y}-1)))")
                }
                (Binary::Power, _) => format!("{result}*LN({x})"),
                (Binary::Atan2, 0) => format!("{y}/SUMSQ({x},{y})"),
                (Binary::Atan2, _) => format!("-{x}/SUMSQ({x},{y})"),
                (Binary::Hypot, 0) => format!("{x}/{result}"),
                (Binary::Hypot, _) => format!("{y}/{result}"),
                (Binary::Min, 0) => format!("IF({y}<{x},0,1)"),
                (Binary::Min, _) => format!("IF({y}<{x},1,0)"),
                (Binary::Max, 0) => format!("IF({y}>{x},0,1)"),
                (Binary::Max, _) => format!("IF({y}>{x},1,0)"),
                (Binary::Modulo, 0) => "1".to_owned(),
                (Binary::Modulo, _) => format!("-INT({x}/{y})"),
                (Binary::When, 1) => format!("IF({x}<>0,1,0)"),
                (Binary::Unless, 1) => format!("IF({x}=0,1,0)"),
                (
                    Binary::Less
                    | Binary::LessOrEqual
                    | Binary::Equal
                    | Binary::NotEqual
                    | Binary::When
                    | Binary::Unless,
                    _,
                ) => "0".to_owned(),
            }
        }
    })
}

/// The logarithmic derivative of the gamma function, which spreadsheets do not have, for x > 0: the
/// asymptotic series at x + 10, brought back by the recurrence (DLMF 5.5.2, 5.11.2).
fn digamma(x: &str) -> String {
    let back: Vec<String> = (0..10).map(|k| format!("1/({x}+{k})")).collect();
    let z = format!("({x}+10)");
    format!(
        "(LN({z})-0.5/{z}-1/12/{z}^2+1/120/{z}^4-1/252/{z}^6+1/240/{z}^8-1/132/{z}^10-({}))",
        back.join("+")
    )
}

/// What a step does, in words: the quantity, the number, or the operation on earlier steps.
pub(super) fn words(node: Node, name: &dyn Fn(usize) -> String) -> String {
    // steps are counted from one
    let step = |place: usize| format!("step {}", place + 1);
    match node {
        Node::Variable(v) => name(v),
        Node::Constant(c) => crate::number::exact(c),
        Node::Unary(operation, x) => format!("{}({})", operation.name(), step(x)),
        Node::Routine(_) => "a function of several numbers".to_owned(),
        Node::Binary(operation, x, y) if operation.is_infix() => {
            format!("{} {} {}", step(x), operation.name(), step(y))
        }
        Node::Binary(operation, x, y) => {
            format!("{}({}, {})", operation.name(), step(x), step(y))
        }
    }
}

#[cfg(test)]
mod tests {
    use std::path::Path;

    use super::*;
    use gumption_files::read_text;

    /// Adjoints against the derivatives of the propagation, which are made the other way round: two
    /// orders of a dozen roundings.
    #[test]
    fn adjoints_are_the_sensitivity_coefficients() {
        let text = r#"{"check_units": false, "inputs": {
            "x": {"distribution": "normal", "mean": 0.7, "std": 0.1},
            "y": {"distribution": "normal", "mean": 1.3, "std": 0.1},
            "n": {"distribution": "constant", "value": 3}},
            "equations": {
              "a": "sin(x)*cos(y) + tan(x)/sqrt(y) - exp(-x)*ln(y) + log10(x)^2",
              "b": "asin(x) + acos(x)*atan(y) + sinh(x) - cosh(y)*tanh(x) + cbrt(y)",
              "c": "atan2(y, x) + hypot(x, y) + min(x, y)*max(x, y) + abs(x - y)",
              "d": "x^n + n^x + (x < y)*x + x^y + a*b",
              "e": "expm1(x) + log1p(y) + asinh(x) + acosh(y) + atanh(x) + erf(y) + gamma(x)*mod(n, y) + if(x < y, x*y, ln(x)) + round(9*x)"},
            "outputs": {"a": {}, "b": {}, "c": {}, "d": {}, "e": {}}}"#;
        let task = read_text("file", text, Path::new(""), &[]).unwrap().task;
        let values = [0.7, 1.3, 3.0];
        let tape = Tape::of(&task.model.program, &values).unwrap();
        let (outputs, gradients) = task.model.program.gradients(&values);
        for (output, gradient) in gradients.iter().enumerate() {
            let step = tape.outputs[output];
            assert_eq!(tape.steps[step].value, outputs[output]);
            for (variable, slope) in gradient.iter().enumerate() {
                let step = tape.variables[variable];
                let adjoint = step.map_or(0.0, |step| tape.steps[step].adjoints[output]);
                let close = (adjoint - slope).abs() <= 1e-13 * (1.0 + slope.abs());
                assert!(close, "output {output}, variable {variable}: {adjoint} {slope}");
                let reached = step.is_some_and(|step| tape.reaches(step, output));
                assert!(reached || *slope == 0.0);
            }
        }
    }

    #[test]
    fn what_a_spreadsheet_cannot_hold_is_refused() {
        let text = r#"{"inputs": {"x": {"distribution": "normal", "mean": 0, "std": 1}},
            "equations": {"y": "sqrt(x)"}, "outputs": {"y": {}}}"#;
        let task = read_text("file", text, Path::new(""), &[]).unwrap().task;
        assert!(Tape::of(&task.model.program, &[0.0]).is_none());
        assert!(Tape::of(&task.model.program, &[1e200]).is_none());
        assert!(Tape::of(&task.model.program, &[4.0]).is_some());
    }
}
