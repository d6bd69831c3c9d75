//! How formulas are read: ranks, tokens, limits.

use super::super::syntax::{NodeKind, Tree};
use super::*;

/// The tree with parentheses around everything that has parts.
fn grouped(text: &str) -> String {
    let formula = Formula::parse(text).unwrap_or_else(|error| panic!("{text}: {error}"));
    show(&formula.tree, &formula.text, formula.tree.nodes.len() - 1)
}

fn show(tree: &Tree, text: &str, place: usize) -> String {
    let node = &tree.nodes[place];
    let written = &text[node.span.clone()];
    match &node.kind {
        NodeKind::Number(value) => value.to_string(),
        NodeKind::Pi => "pi".to_owned(),
        NodeKind::Name | NodeKind::Unit(_) | NodeKind::Constant(_) => written.to_owned(),
        NodeKind::InUnit { number, unit } => format!("({} {unit})", show(tree, text, *number)),
        NodeKind::Negate(x) => format!("(-{})", show(tree, text, *x)),
        NodeKind::Infix { operator, left, right, .. } => {
            let (left, right) = (show(tree, text, *left), show(tree, text, *right));
            format!("({left}{}{right})", operator.name())
        }
        NodeKind::Joined { joint, left, right, .. } => {
            let (left, right) = (show(tree, text, *left), show(tree, text, *right));
            format!("({left} {} {right})", joint.name())
        }
        NodeKind::Not { of, .. } => format!("(not {})", show(tree, text, *of)),
        NodeKind::Table { x, call } => format!("table({},{})", show(tree, text, *x), call.file),
        NodeKind::Solve { body, unknown, from, to } => {
            let whole = show(body, text, body.nodes.len() - 1);
            let [from, to] = [from, to].map(|end| show(tree, text, *end));
            format!("solve({whole},{},{from},{to})", &text[unknown.clone()])
        }
        NodeKind::Curve { curve, argument, .. } => {
            format!("{}({})", curve.fit.name, show(tree, text, *argument))
        }
        NodeKind::Call { name_span, arguments, .. } => {
            let arguments: Vec<_> = arguments.iter().map(|a| show(tree, text, *a)).collect();
            format!("{}({})", &text[name_span.clone()], arguments.join(","))
        }
    }
}

#[test]
fn ranks_of_operators() {
    let table = [
        ("a+b*c", "(a+(b*c))"),
        ("a*b+c", "((a*b)+c)"),
        ("a-b-c", "((a-b)-c)"),
        ("a-b+c", "((a-b)+c)"),
        ("a/b/c", "((a/b)/c)"),
        ("a/b*c", "((a/b)*c)"),
        ("a*b/c", "((a*b)/c)"),
        ("2^3^2", "(2^(3^2))"),
        ("a<b and c or not d<e and -f", "(((a<b) and c) or ((not (d<e)) and (-f)))"),
        ("not a and b", "((not a) and b)"),
        ("and*or + not", "((and*or)+not)"),
        ("1 + solve(2*x - 3, x, 0, 1+1)^2", "(1+(solve(((2*x)-3),x,0,(1+1))^2))"),
        ("table(a+b, 'f.csv', \"x\", 'y')/2", "(table((a+b),f.csv)/2)"),
        ("-2^2", "(-(2^2))"),
        ("2^-1", "(2^(-1))"),
        ("2^-1*3", "((2^(-1))*3)"),
        ("2^-3^2", "(2^(-(3^2)))"),
        ("2^--3", "(2^(-(-3)))"),
        ("-a*b", "((-a)*b)"),
        ("a*-b", "(a*(-b))"),
        ("a*-b^2*c", "((a*(-(b^2)))*c)"),
        ("a--b", "(a-(-b))"),
        ("a - - b", "(a-(-b))"),
        ("a+-b*c", "(a+((-b)*c))"),
        ("--a", "(-(-a))"),
        ("+a", "a"),
        ("a++b", "(a+b)"),
        ("a^+2", "(a^2)"),
        ("(-x)^2", "((-x)^2)"),
        ("a*b^c*d", "((a*(b^c))*d)"),
        ("a^b/c", "((a^b)/c)"),
        ("a<b+c", "(a<(b+c))"),
        ("a+b>=c*d", "((a+b)>=(c*d))"),
        ("(a<b)*c", "((a<b)*c)"),
        ("(a<b)<c", "((a<b)<c)"),
        ("-a<b", "((-a)<b)"),
        ("a==b", "(a==b)"),
        ("a!=b", "(a!=b)"),
        ("a ≤ b", "(a<=b)"),
        ("a ≥ b", "(a>=b)"),
        ("a ≠ b", "(a!=b)"),
        ("a**b**c", "(a^(b^c))"),
        ("a·b×c⋅d", "(((a*b)*c)*d)"),
        ("a − b", "(a-b)"),
        ("1e−3", "0.001"),
        ("sin(x)^2", "(sin(x)^2)"),
        ("-sin(x)", "(-sin(x))"),
        ("max(1,5)", "max(1,5)"),
        ("max(a, b < c, -d)", "max(a,(b<c),(-d))"),
        ("hypot(a,b,c)", "hypot(a,b,c)"),
        ("atan2(im, re)", "atan2(im,re)"),
        ("f()", "f()"),
        ("((a))", "a"),
        ("π + pi", "(pi+pi)"),
        ("pi_2 + pint", "(pi_2+pint)"),
        ("_x + θ_0*Δé", "(_x+(θ_0*Δé))"),
        ("1 + 1.5 + .5 + 2.", "(((1+1.5)+0.5)+2)"),
        ("1e3 + 1E-3 + 2.e2 + .5e+1", "(((1000+0.001)+200)+5)"),
        ("  a\n\t+ b ", "(a+b)"),
        ("a\u{a0}+\u{2009}b", "(a+b)"),
        ("e*exp1*exp(1)", "((e*exp1)*exp(1))"),
        ("2*e-3", "((2*e)-3)"),
    ];
    for (text, expected) in table {
        assert_eq!(grouped(text), expected, "{text}");
    }
}

#[test]
fn places_of_nodes() {
    let formula = Formula::parse(" (a + b) * sin( c ) ").unwrap();
    let spans: Vec<_> =
        formula.tree.nodes.iter().map(|node| &formula.text[node.span.clone()]).collect();
    assert_eq!(spans, ["a", "b", "a + b", "c", "sin( c )", "(a + b) * sin( c )"]);
}

#[test]
fn names_in_order_with_places() {
    let formula = Formula::parse("θ*cos(x1) + x1 - pi").unwrap();
    let names: Vec<_> = formula.names().collect();
    assert_eq!(names, [("θ", 0..2), ("x1", 7..9), ("x1", 13..15)]);
    assert_eq!(formula.text(), "θ*cos(x1) + x1 - pi");
}

#[test]
fn limits() {
    let nested = |depth: usize| format!("{}x{}", "(".repeat(depth), ")".repeat(depth));
    assert!(Formula::parse(&nested(Formula::MAX_DEPTH)).is_ok());
    let one_more = Formula::parse(&nested(Formula::MAX_DEPTH + 1));
    assert_eq!(one_more, Err(FormulaError::TooDeep { span: 100..101, limit: 100 }));
    for unit in ["(", "-", "2^", "sin(", "max(1,", "-(", "1+(", "2^-", "+"] {
        let error = Formula::parse(&unit.repeat(10_000)).unwrap_err();
        assert!(matches!(error, FormulaError::TooDeep { .. }), "{unit}: {error}");
    }
    // the longest sums, products and differences are not deep
    for operator in ["+", "*", "-", "/"] {
        let long = format!("x{}", format!("{operator}x").repeat(49_999));
        let formula = Formula::parse(&long).unwrap();
        assert_eq!(formula.names().count(), 50_000);
        assert!(formula.check(&Scope::from_iter([("x", Typing::NUMBER)])).is_ok());
        let longer = format!("{long} +");
        let error = Formula::parse(&longer).unwrap_err();
        assert_eq!(error, FormulaError::TooLong { length: 100_001, limit: 100_000 });
    }
    // depth counts what is open, not what has been closed again
    let many = vec!["(x)"; 1000].join("+");
    assert!(Formula::parse(&many).is_ok());
}
