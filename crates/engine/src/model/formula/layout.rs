//! How a formula stands on paper: fractions one above the other, roots under their sign, and only the
//! parentheses that are needed.

use super::Formula;
use super::function::{ComplexPart, Function};
use super::syntax::{Node, NodeKind, Operator, Tree};
use crate::number::{Binary, Unary};

/// Parts inside each other, at most; a formula that is deeper is shown as it was written.
const DEEPEST: usize = 60;

/// A formula, or a part of it, as it stands on paper.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum Layout {
    /// A number as written.
    Number(String),
    /// The name of a quantity.
    Name(String),
    /// The name of a function, an operator between its operands, or a fence.
    Sign(&'static str),
    /// Anything else as written: a unit, a constant, the call of a table.
    Text(String),
    /// Parts beside each other.
    Row(Vec<Layout>),
    /// A numerator over a denominator.
    Fraction(Box<[Layout; 2]>),
    /// A base with its exponent.
    Power(Box<[Layout; 2]>),
    /// What stands under a root, with the index of the root unless it is the square root.
    Root(Box<Layout>, Option<u32>),
    /// A quantity of two cases: a value, its condition, and the value otherwise.
    Cases(Box<[Layout; 3]>),
}

/// How tightly a part holds together, the loosest first.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
enum Hold {
    Truth,
    Compared,
    Sum,
    Product,
    Power,
    One,
}

/// A part with how tightly it holds together and how many parts lie inside each other.
struct Laid {
    layout: Layout,
    hold: Hold,
    depth: usize,
}

impl Formula {
    /// The formula as it stands on paper; `None` where it has too many parts inside each other.
    ///
    /// ```
    /// use gumption_engine::model::formula::{Formula, Layout};
    ///
    /// let formula = Formula::parse("(a + b)/2").unwrap();
    /// let Some(Layout::Fraction(parts)) = formula.layout() else { panic!() };
    /// assert_eq!(parts[1], Layout::Number("2".to_owned()));
    /// ```
    pub fn layout(&self) -> Option<Layout> {
        let mut laid: Vec<Option<Laid>> = Vec::with_capacity(self.tree.nodes.len());
        for node in &self.tree.nodes {
            let part =
                LaidParts { text: &self.text, tree: &self.tree, laid: &mut laid }.of(node)?;
            if part.depth > DEEPEST {
                return None;
            }
            laid.push(Some(part));
        }
        laid.pop()?.map(|whole| whole.layout)
    }
}

/// What has been laid out so far.
struct LaidParts<'f> {
    text: &'f str,
    tree: &'f Tree,
    laid: &'f mut Vec<Option<Laid>>,
}

impl LaidParts<'_> {
    fn of(&mut self, node: &Node) -> Option<Laid> {
        let written = self.text.get(node.span.clone())?.to_owned();
        Some(match &node.kind {
            NodeKind::Number(_) => one(Layout::Number(written)),
            NodeKind::Pi => one(Layout::Name("pi".to_owned())),
            NodeKind::Name => one(Layout::Name(written)),
            NodeKind::Unit(_) | NodeKind::Constant(_) => {
                one(Layout::Text(within_brackets(&written)))
            }
            NodeKind::InUnit { number, .. } => {
                let number_text = self.text.get(self.tree.span(*number))?.to_owned();
                self.take(*number)?;
                let unit = written.get(number_text.len()..).unwrap_or_default();
                let unit = Layout::Text(format!("\u{202f}{}", within_brackets(unit)));
                row(Hold::Product, vec![Layout::Number(number_text), unit], 0)
            }
            NodeKind::Negate(of) => {
                let of = self.take(*of)?;
                let depth = of.depth;
                row(Hold::Sum, vec![Layout::Sign("\u{2212}"), held(of, Hold::Product)], depth)
            }
            NodeKind::Infix { operator, left, right, .. } => {
                let (left, right) = (self.take(*left)?, self.take(*right)?);
                infix(*operator, left, right)
            }
            NodeKind::Joined { joint, left, right, .. } => {
                let (left, right) = (self.take(*left)?, self.take(*right)?);
                let depth = left.depth.max(right.depth);
                let (left, right) = (held(left, Hold::Compared), held(right, Hold::Compared));
                let sign = match joint.name() {
                    "and" => Layout::Sign("\u{2003}and\u{2003}"),
                    _ => Layout::Sign("\u{2003}or\u{2003}"),
                };
                row(Hold::Truth, vec![left, sign, right], depth)
            }
            NodeKind::Not { of, .. } => {
                let of = self.take(*of)?;
                let depth = of.depth;
                row(Hold::Compared, vec![Layout::Sign("not\u{2002}"), held(of, Hold::One)], depth)
            }
            NodeKind::Call { function: Some(function), arguments, .. } => {
                let arguments: Option<Vec<Laid>> =
                    arguments.iter().map(|argument| self.take(*argument)).collect();
                call(*function, arguments?)?
            }
            // as written: what is in them stands in texts of their own
            NodeKind::Call { .. }
            | NodeKind::Table { .. }
            | NodeKind::Solve { .. }
            | NodeKind::Curve { .. } => one(Layout::Text(written)),
        })
    }

    /// An operand; each is the operand of one part.
    fn take(&mut self, node: usize) -> Option<Laid> {
        self.laid.get_mut(node)?.take()
    }
}

fn infix(operator: Operator, left: Laid, right: Laid) -> Laid {
    let depth = left.depth.max(right.depth);
    let (hold, sign, least) = match operator {
        Operator::Divide => {
            let parts = Box::new([left.layout, right.layout]);
            let layout = Layout::Fraction(parts);
            return Laid { layout, hold: Hold::Product, depth: depth + 1 };
        }
        Operator::Power => {
            let parts = Box::new([held(left, Hold::One), right.layout]);
            return Laid { layout: Layout::Power(parts), hold: Hold::Power, depth: depth + 1 };
        }
        Operator::Add => (Hold::Sum, "+", [Hold::Sum, Hold::Product]),
        Operator::Subtract => (Hold::Sum, "\u{2212}", [Hold::Sum, Hold::Product]),
        Operator::Multiply => (Hold::Product, "\u{22c5}", [Hold::Product; 2]),
        Operator::Less => (Hold::Compared, "<", [Hold::Sum; 2]),
        Operator::LessOrEqual => (Hold::Compared, "\u{2264}", [Hold::Sum; 2]),
        Operator::Greater => (Hold::Compared, ">", [Hold::Sum; 2]),
        Operator::GreaterOrEqual => (Hold::Compared, "\u{2265}", [Hold::Sum; 2]),
        Operator::Equal => (Hold::Compared, "=", [Hold::Sum; 2]),
        Operator::NotEqual => (Hold::Compared, "\u{2260}", [Hold::Sum; 2]),
    };
    row(hold, vec![held(left, least[0]), Layout::Sign(sign), held(right, least[1])], depth)
}

fn call(function: Function, mut arguments: Vec<Laid>) -> Option<Laid> {
    let depth = arguments.iter().map(|argument| argument.depth).max().unwrap_or(0) + 1;
    let of = |layout, hold| Some(Laid { layout, hold, depth });
    match function {
        Function::One(Unary::Sqrt) => {
            of(Layout::Root(Box::new(arguments.pop()?.layout), None), Hold::One)
        }
        Function::One(Unary::Cbrt) => {
            of(Layout::Root(Box::new(arguments.pop()?.layout), Some(3)), Hold::One)
        }
        Function::One(Unary::Abs) => {
            let inside = arguments.pop()?.layout;
            of(Layout::Row(vec![Layout::Sign("|"), inside, Layout::Sign("|")]), Hold::One)
        }
        Function::One(Unary::Exp) => {
            let base = Layout::Name("e".to_owned());
            of(Layout::Power(Box::new([base, arguments.pop()?.layout])), Hold::Power)
        }
        Function::One(Unary::Floor) => fenced("\u{230a}", arguments, "\u{230b}", depth),
        Function::One(Unary::Ceil) => fenced("\u{2308}", arguments, "\u{2309}", depth),
        Function::If => {
            let [condition, one, other] = <[Laid; 3]>::try_from(arguments).ok()?;
            let parts = [one.layout, condition.layout, other.layout];
            of(Layout::Cases(Box::new(parts)), Hold::Sum)
        }
        Function::Two(Binary::Modulo)
        | Function::Part(
            ComplexPart::Real
            | ComplexPart::Imaginary
            | ComplexPart::Argument
            | ComplexPart::Conjugate,
        )
        | Function::One(_)
        | Function::Two(_)
        | Function::Fold(_)
        | Function::Sum
        | Function::Mean
        | Function::Kelvin
        | Function::Celsius
        | Function::Table
        | Function::Solve => {
            let Laid { layout, .. } = fenced("(", arguments, ")", depth)?;
            of(Layout::Row(vec![Layout::Sign(function.name()), layout]), Hold::One)
        }
    }
}

/// Arguments between two fences.
fn fenced(
    open: &'static str,
    arguments: Vec<Laid>,
    close: &'static str,
    depth: usize,
) -> Option<Laid> {
    let mut parts = vec![Layout::Sign(open)];
    for (place, argument) in arguments.into_iter().enumerate() {
        if place > 0 {
            parts.push(Layout::Sign(","));
        }
        parts.push(argument.layout);
    }
    parts.push(Layout::Sign(close));
    Some(Laid { layout: Layout::Row(parts), hold: Hold::One, depth })
}

fn one(layout: Layout) -> Laid {
    Laid { layout, hold: Hold::One, depth: 0 }
}

/// Parts beside each other; the first row of a longer one is taken into it, so that a sum of many
/// terms is one row.
fn row(hold: Hold, parts: Vec<Layout>, depth: usize) -> Laid {
    let mut flat: Vec<Layout> = Vec::with_capacity(parts.len());
    for part in parts {
        match (part, flat.is_empty()) {
            (Layout::Row(mut inner), true) => {
                flat.append(&mut inner);
            }
            (part, _) => flat.push(part),
        }
    }
    Laid { layout: Layout::Row(flat), hold, depth }
}

/// A part in parentheses where it holds together less tightly than is wanted.
fn held(part: Laid, least: Hold) -> Layout {
    if part.hold >= least {
        return part.layout;
    }
    Layout::Row(vec![Layout::Sign("("), part.layout, Layout::Sign(")")])
}

/// What stands in brackets.
fn within_brackets(written: &str) -> String {
    written.trim().trim_start_matches('[').trim_end_matches(']').trim().to_owned()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// One line in which fractions and powers are marked by braces.
    fn line(layout: &Layout) -> String {
        match layout {
            Layout::Number(text) | Layout::Name(text) | Layout::Text(text) => text.clone(),
            Layout::Sign(sign) => (*sign).to_owned(),
            Layout::Row(parts) => parts.iter().map(line).collect(),
            Layout::Fraction(parts) => format!("{{{}}}/{{{}}}", line(&parts[0]), line(&parts[1])),
            Layout::Power(parts) => format!("{}^{{{}}}", line(&parts[0]), line(&parts[1])),
            Layout::Root(inside, None) => format!("root{{{}}}", line(inside)),
            Layout::Root(inside, Some(index)) => format!("root{index}{{{}}}", line(inside)),
            Layout::Cases(parts) => {
                let [one, when, other] = &**parts;
                format!("{{{} if {}; {}}}", line(one), line(when), line(other))
            }
        }
    }

    fn laid(text: &str) -> String {
        line(&Formula::parse(text).unwrap().layout().unwrap())
    }

    #[test]
    fn parentheses_stand_where_they_are_needed() {
        assert_eq!(laid("a*(b + c)"), "a⋅(b+c)");
        assert_eq!(laid("(a*b) + c"), "a⋅b+c");
        assert_eq!(laid("a - (b - c)"), "a−(b−c)");
        assert_eq!(laid("(a + b)/(c*d)"), "{a+b}/{c⋅d}");
        assert_eq!(laid("(a/b)^2"), "({a}/{b})^{2}");
        assert_eq!(laid("-x^2"), "−x^{2}");
        assert_eq!(laid("(-x)^2"), "(−x)^{2}");
        assert_eq!(laid("a*(-b)"), "a⋅(−b)");
        assert_eq!(laid("2^(a + 1)"), "2^{a+1}");
        assert_eq!(laid("a/b*c"), "{a}/{b}⋅c");
        assert_eq!(laid("a/(b/c)"), "{a}/{{b}/{c}}");
    }

    #[test]
    fn functions_have_their_signs() {
        assert_eq!(laid("sqrt(a^2 + b^2)"), "root{a^{2}+b^{2}}");
        assert_eq!(laid("abs(a*sin(t))"), "|a⋅sin(t)|");
        assert_eq!(laid("exp(-x)"), "e^{−x}");
        assert_eq!(laid("atan2(y, x)"), "atan2(y,x)");
        assert_eq!(laid("if(x < 1, 2, 3)"), "{2 if x<1; 3}");
        assert_eq!(laid("20 [mm]*a"), "20\u{202f}mm⋅a");
    }

    /// A sum of many terms is one row; a tower of fractions is shown as written.
    #[test]
    fn long_ones_are_flat_and_deep_ones_are_not_laid_out() {
        let sum = vec!["a"; 3000].join(" + ");
        let Some(Layout::Row(parts)) = Formula::parse(&sum).unwrap().layout() else { panic!() };
        assert_eq!(parts.len(), 5999);
        let tower = vec!["a"; 3000].join("/");
        assert_eq!(Formula::parse(&tower).unwrap().layout(), None);
    }
}
