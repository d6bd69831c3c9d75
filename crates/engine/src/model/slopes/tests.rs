use super::{Columns, Slopes};
use crate::model::program::{Node, Program};
use crate::number::{Binary, COLUMN, CodePath, Kernel, Operand, Unary};

const VARIABLES: usize = 5;

/// Numbers from a multiplicative congruential generator: the tests want variety, not quality.
struct Numbers(u64);

impl Numbers {
    fn next(&mut self) -> usize {
        self.0 =
            self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 33) as usize
    }

    fn value(&mut self) -> f64 {
        // zero and negative values too, for kinks and for what is not a number
        (self.next() % 41) as f64 / 8.0 - 1.5
    }
}

const UNARY: [Unary; 27] = [
    Unary::Negate,
    Unary::Abs,
    Unary::Sqrt,
    Unary::Cbrt,
    Unary::Exp,
    Unary::Ln,
    Unary::Log10,
    Unary::Sin,
    Unary::Cos,
    Unary::Tan,
    Unary::Asin,
    Unary::Acos,
    Unary::Atan,
    Unary::Sinh,
    Unary::Cosh,
    Unary::Tanh,
    Unary::Sin,
    Unary::Asinh,
    Unary::Acosh,
    Unary::Atanh,
    Unary::ExpMinusOne,
    Unary::LnOnePlus,
    Unary::Floor,
    Unary::Ceil,
    Unary::Round,
    Unary::Erf,
    Unary::Gamma,
];

const BINARY: [Binary; 18] = [
    Binary::Add,
    Binary::Subtract,
    Binary::Multiply,
    Binary::Divide,
    Binary::Power,
    Binary::Atan2,
    Binary::Hypot,
    Binary::Min,
    Binary::Max,
    Binary::Less,
    Binary::Equal,
    Binary::Multiply,
    Binary::Add,
    Binary::Modulo,
    Binary::When,
    Binary::Unless,
    Binary::When,
    Binary::Unless,
];

fn program(numbers: &mut Numbers) -> Program {
    let mut nodes: Vec<Node> = (0..VARIABLES).map(Node::Variable).collect();
    nodes.push(Node::Constant(0.75));
    nodes.push(Node::Constant(0.0));
    for _ in 0..5 + numbers.next() % 40 {
        let mut index = || numbers.next() % nodes.len();
        let (x, y) = (index(), index());
        nodes.push(if numbers.next().is_multiple_of(3) {
            Node::Unary(UNARY[numbers.next() % UNARY.len()], x)
        } else {
            Node::Binary(BINARY[numbers.next() % BINARY.len()], x, y)
        });
    }
    let last = nodes.len() - 1;
    let outputs = vec![last, numbers.next() % nodes.len(), last - 1];
    Program { nodes, variables: VARIABLES, outputs, ..Program::default() }
}

struct Run<'a>(&'a Slopes, &'a mut Columns);

impl Kernel for Run<'_> {
    type Output = ();

    #[inline(always)]
    fn run(self) {
        self.0.run(self.1);
    }
}

/// 400 random programs at values that meet kinks, poles and what is outside a domain: values and
/// derivatives of a column of rows are the bits that each row has on its own, on every code path and
/// whichever variables are the same in all rows. Of derivatives that are not numbers only that is
/// compared.
#[test]
fn rows_in_columns_have_the_bits_of_rows_alone() {
    let mut numbers = Numbers(7);
    for _ in 0..400 {
        let program = program(&mut numbers);
        let rows: Vec<Vec<f64>> =
            (0..COLUMN).map(|_| (0..VARIABLES).map(|_| numbers.value()).collect()).collect();
        let same: Vec<Option<f64>> = (0..VARIABLES)
            .map(|_| numbers.next().is_multiple_of(2).then(|| numbers.value()))
            .collect();
        let wanted = 1 + numbers.next() % VARIABLES;
        let slopes = Slopes::new(&program, &same, wanted).unwrap();
        for path in CodePath::available() {
            let mut columns = slopes.columns();
            // twice: nothing may be left over from the first time
            for _ in 0..2 {
                for &(variable, register) in &slopes.varying {
                    for (value, row) in columns.values[register].0.iter_mut().zip(&rows) {
                        *value = row[variable];
                    }
                }
                path.run(Run(&slopes, &mut columns));
            }
            for (number, row) in rows.iter().enumerate() {
                let row: Vec<f64> =
                    row.iter().zip(&same).map(|(value, same)| same.unwrap_or(*value)).collect();
                let (estimates, gradients) = program.gradients(&row);
                for ((slope, estimate), gradient) in
                    slopes.outputs.iter().zip(estimates).zip(gradients)
                {
                    let at = |operand: Operand, columns: &[crate::number::Column]| match operand {
                        Operand::Register(register) => columns[register].0[number],
                        Operand::Constant(value) => value,
                    };
                    let agree = |ours: f64, alone: f64| {
                        ours.to_bits() == alone.to_bits() || ours.is_nan() && alone.is_nan()
                    };
                    assert!(agree(at(slope.value, &columns.values), estimate), "{program:?}");
                    let mut ours = [0.0; VARIABLES];
                    for &(variable, operand) in &slope.gradient {
                        ours[variable] = at(operand, &columns.gradients);
                    }
                    for v in 0..wanted {
                        assert!(
                            agree(ours[v], gradient[v]),
                            "{program:?} by {v} at {row:?}: {} {}",
                            ours[v],
                            gradient[v]
                        );
                    }
                }
            }
        }
    }
}
