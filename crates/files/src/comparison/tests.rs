//! Tables of results: what is read, and what is a mistake.

use super::*;

fn read(text: &str) -> Result<ComparisonTable, Diagnostics> {
    read_comparison_text("t.csv", text, ComparisonOptions::default())
}

#[test]
fn half_units_of_printed_digits() {
    for (text, half) in
        [("423", 0.5), ("0.010", 0.0005), ("1.50e-3", 5e-6), ("-7.", 0.5), ("2e4", 5e3)]
    {
        assert_eq!(half_unit(text), half, "{text}");
    }
}

#[test]
fn pairs_with_and_without_factors() {
    let text = "label;x1;U1;x2;U2;k2\n\"a; b\";1,50;0,2;1,6;0,3;3\n# note\nc;1;0;2;1;2\n";
    let Ok(ComparisonTable::Pairs(pairs)) = read(text) else { panic!() };
    assert_eq!((pairs.len(), pairs[0].label.as_str()), (2, "a; b"));
    let [a, b] = pairs[0].results;
    assert_eq!((a.value, a.factor, a.rounding), (1.5, 2.0, [0.005, 0.05]));
    assert_eq!((b.factor, b.rounding), (3.0, [0.05, 0.05]));
}

/// 10.012 V and 10 011.5 mV differ by 0.5 mV; the last digits are worth 0.5 mV, 0.05 mV and 5 uV.
#[test]
fn units_stand_in_headings() {
    let text = "label,x1 [V],U1 [mV],x2 [mV],U2 / mV,k1\na,10.012,0.4,10011.5,0.30,2\n";
    let Ok(ComparisonTable::Pairs(pairs)) = read(text) else { panic!() };
    let [a, b] = pairs[0].results;
    let near = |found: f64, wanted: f64| (found / wanted - 1.0).abs() < 1e-12;
    assert!((a.value - b.value - 5e-4).abs() < 1e-14);
    assert!(near(a.expanded, 4e-4) && near(b.expanded, 3e-4));
    assert!(near(a.rounding[0], 5e-4) && near(a.rounding[1], 5e-5));
    assert!(near(b.rounding[0], 5e-5) && near(b.rounding[1], 5e-6));
    // differences of temperatures have no zero
    let text = "label;x (degC);U (K)\na;20,1;0,2\nb;20,3;0,1\n";
    let Ok(ComparisonTable::Laboratories { laboratories, .. }) = read(text) else { panic!() };
    assert_eq!((laboratories[0].result.value, laboratories[0].result.expanded), (20.1, 0.2));
}

/// Rows that are too short or too long hide nothing of the others, and neither does a first bad
/// cell.
#[test]
fn all_mistakes_are_told_at_once() {
    let text =
        "label,x1,U1,x2,U2,k1\na,1,,2,1,2\nb,1,1\nc,x,1,2,-1,0\nd,1,1,2,1,2,9\ne,1,-1,2,1,0\n";
    let said = read(text).unwrap_err().to_string();
    let places: Vec<String> = said
        .lines()
        .filter_map(|line| Some(line.strip_prefix("t.csv:")?.split(": ").next()?.to_owned()))
        .collect();
    assert_eq!(places, ["2:4", "3:1", "4:3", "4:9", "5:1", "6:5", "6:12"], "{said}");
    let said = read("label;x;U\na;z;1\nb;1,5;0.1\nc;1,5;0.1\n").unwrap_err().to_string();
    assert!(said.contains("`z`") && said.matches("one table").count() == 1, "{said}");
    let said = read("label,x,U,K,n\na,1,1,1,1\nb,1,1,1,1\n").unwrap_err().to_string();
    assert!(said.contains("`K` is not known") && said.contains("`n` is not known"), "{said}");
}

#[test]
fn mistakes_have_places() {
    let said = |text: &str| read(text).unwrap_err().to_string();
    let cases = [
        ("label,x1,U1,x2,U2\na,1,,2,1\nb,1,1,x,1\n", "t.csv:2:4:"),
        ("label,x1,U1,x2,U2\na,1,-1,2,1\n", "at least 0"),
        ("label,x1,U1,x2,U2\na,1,0,2,0\n", "no uncertainty"),
        ("label,x1,U1,x2,U2,r\na,1,1,2,1,2\n", "from -1 to 1"),
        ("label,x1,U1,x2\na,1,1,2\n", "no column U2"),
        ("label,x1,U1,x2,U2,K1\na,1,1,2,1,2\n", "`K1` is not known"),
        ("label,x [V],U\na,1,1\nb,1,1\n", "has the unit `V` and `U` none"),
        ("label,x [V],U [%]\na,1,1\nb,1,1\n", "`U [%]` cannot be converted to `V`"),
        ("label,x [V],U [Vv]\na,1,1\nb,1,1\n", "`Vv` is no unit"),
        ("label,x,U (k=2)\na,1,1\nb,1,1\n", "stand in a column of their own, `k`"),
        ("label,x,U\na,1,1\n", "at least two laboratories"),
        ("label,x,U\na,1,1\na,2,1\n", "a second time"),
        ("label,x,U\na,1,0\nb,2,1\n", "t.csv:2:5:"),
        ("label,x,U\na,1\n", "t.csv:2:1:"),
        ("", "the table is empty"),
    ];
    for (text, expected) in cases {
        let found = said(text);
        assert!(found.contains(expected), "{text:?}: {found}");
    }
    assert_eq!(said("label,x1,U1,x2,U2\na,1,,2,1\nb,1,1,x,1\n").lines().count(), 2);
}
