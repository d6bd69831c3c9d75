//! Tables of results: what is read, and what is a mistake.

use super::*;

fn read(text: &str) -> Result<ComparisonTable, Diagnostics> {
    noted(text).map(|read| read.table)
}

fn noted(text: &str) -> Result<ReadComparison, Diagnostics> {
    read_comparison_text("t.csv", text, ComparisonOptions::default())
}

fn laboratories(text: &str) -> Vec<Laboratory> {
    match read(text) {
        Ok(ComparisonTable::Laboratories { laboratories, .. }) => laboratories,
        other => panic!("{text}: {other:?}"),
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
/// 101.325 under German headings may be 101 325; one number that tells is enough.
#[test]
fn marks_that_may_group_are_asked() {
    let table =
        |value: &str| format!("Labor;Messwert [Pa];U (k=2) [Pa]\nA;{value};12\nB;101.330;10\n");
    let message = read(&table("101.325")).unwrap_err().to_string();
    assert!(message.contains("`101.325` can be `101,325` or `101325`"), "{message}");
    assert!(read(&table("101.3251")).is_ok());
    assert!(read(&table("101.325").replace(";12", ";0.12")).is_ok());
    assert!(read("Lab;Value [Pa];U (k=2) [Pa]\nA;101.325;12\nB;101.330;10\n").is_ok());
}

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
    assert_eq!(places, ["2:4", "3:1", "4:3", "4:9", "4:12", "5:1", "6:5", "6:12"], "{said}");
    let said = read("label;x;U\na;z;1\nb;1,5;0.1\nc;1,5;0.1\n").unwrap_err().to_string();
    assert!(said.contains("`z`") && said.matches("one table").count() == 1, "{said}");
    let said = read("label,x,U,kk,u_c\na,1,1,1,1\nb,1,1,1,1\n").unwrap_err().to_string();
    assert!(said.contains("`kk` is not known") && said.contains("`u_c` is not known"), "{said}");
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
        ("label,x1,U1,x2,U2,k3\na,1,1,2,1,2\n", "`k3` is not known"),
        ("label,x [V],U\na,1,1\nb,1,1\n", "has the unit `V` and `U` none"),
        ("label,x [V],U [mA]\na,1,1\nb,1,1\n", "`U [mA]` cannot be converted to `V`"),
        ("label,x [ppm],U [%]\na,1,1\nb,1,1\n", "can be a share of the value, or be counted"),
        ("label,x [%],U [ppm]\na,1,1\nb,1,1\n", "write it in `%`"),
        ("label,x [V],U [%]\na,0,1\nb,1,1\n", "`1 %` of the value 0 is nothing"),
        ("label,x,Uncertainty\na,1,1\nb,1,1\n", "the standard uncertainty or an expanded one"),
        ("label,x,u,k\na,1,1,2\nb,1,1,2\n", "divided by it already or not"),
        ("label,x,U,dof\na,1,1,2\nb,1,1,2\n", "without degrees of freedom"),
        ("label,x,U (k=2),k\na,1,1,3\nb,1,1,2\n", "which factor is it?"),
        ("label,x,U,u\na,1,1,2\nb,1,1,2\n", "both state the uncertainty"),
        ("label,x,U,s\na,1,1,2\nb,1,1,2\n", "`s` is not known"),
        ("label,x,U,r\na,1,1,2\nb,1,1,2\n", "does not belong to a table of laboratories"),
        ("label,x [V],U [V],Unit\na,1,1,V\nb,1,1,V\n", "leave one of them"),
        ("label,x,U\nNPL,,\nb,1,1\n", "`NPL` is alone in its row: remove the row"),
        ("label,x,U,lot\nNPL,-,-,7\nb,1,1,8\n", "`NPL` has no result: remove the row"),
        ("label,x,U\na,1,1\nb,1,1\n* provisional\n", "t.csv:4:1: `* provisional` is alone"),
        ("label,x,U\n,1,1\nb,1,1\n", "every result has a name"),
        ("label,x,U\na,\"10,0012\",1\nb,1,1\n", "with a point, such as `10.0012`"),
        ("label,x,U\na,\"10,001\",1\nb,1,1\n", "can be 10.001 or 10001"),
        ("label,x [V],U [V]\na,10 mV,1\nb,1,1\n", "a column whose heading says `V`"),
        ("label,x,U\na,10 mV,1 mV\nb,1,1\n", "some numbers have a unit and others none"),
        ("label,x [V],U [Vv]\na,1,1\nb,1,1\n", "`Vv` is no unit"),
        ("label,x,U\na,1,1\n", "at least two laboratories"),
        ("label,x,U\na,1,1\na,2,1\n", "a second time"),
        ("label,x,U\na,1,0\nb,2,1\n", "t.csv:2:5:"),
        (
            "label,x,U\na,10.00(5),0.1\nb,2,1\n",
            "`10.00(5)` is an estimate with its standard uncertainty, 0.05: write the estimate alone",
        ),
        (
            "Lab,Value,U\nReference,10,0.02\nB,1,1\nC,1,1\n",
            "t.csv:2:1: `Reference` can be the value",
        ),
        ("Lab,Value,U\nB,1,1\nRef.,10,0.02\nC,1,1\n", "t.csv:3:1: `Ref.` can be the value"),
        ("Lab,Value,U\nB,1,1\nC,1,1\nWeighted mean,1,1\n", "t.csv:4:1: `Weighted mean` can be"),
        ("label,x1,U1,x2,U2,Value\na,1,1,2,1,2\n", "take it out, or write `#` before its words"),
        ("label,x,U\na,1\n", "t.csv:2:1:"),
        ("", "the table is empty"),
    ];
    for (text, expected) in cases {
        let found = said(text);
        assert!(found.contains(expected), "{text:?}: {found}");
    }
    assert_eq!(said("label,x1,U1,x2,U2\na,1,,2,1\nb,1,1,x,1\n").lines().count(), 2);
}

/// By hand: 4 % of 50.2 mg/kg, 3 % of 51.0 and of 60.1 (found as 40000 and 30000 mg/kg).
#[test]
fn uncertainties_in_per_cent_are_shares_of_the_values() {
    let text = "label,x [mg/kg],U [%]\nA,50.2,4\nB,51.0,3\nC,-60.1,3\n";
    let found = laboratories(text);
    for (found, expected) in found.iter().zip([2.008, 1.53, 1.803]) {
        assert!((found.result.expanded / expected - 1.0).abs() < 1e-12, "{found:?}");
    }
    // half a unit of `4` is 0.5 %
    assert!((found[0].result.rounding[1] / 0.251 - 1.0).abs() < 1e-12);
    let said = noted(text).unwrap().warnings;
    let units = fact!("quoted", name = "%");
    assert_eq!(said[0].fact, fact!("relative-uncertainties", units));
    // per cent of per cent are per cent, and words decide what is doubtful
    assert_eq!(laboratories("label,x [%],U [%]\na,50,4\nb,51,3\n")[0].result.expanded, 4.0);
    let found = laboratories("label,x [ppm],U (% of reading)\na,50,4\nb,51,3\n");
    assert!((found[0].result.expanded - 2.0).abs() < 1e-12);
    let found = laboratories("label,x,U\na,50 mV,4%\nb,51 mV,3%\n");
    assert!((found[0].result.expanded - 2.0).abs() < 1e-12);
    let text = "label,x1 [um/m],U1 [%],x2 [um/m],U2 [um/m]\na,50.2,4,51,2\n";
    let Ok(ComparisonTable::Pairs(pairs)) = read(text) else { panic!() };
    assert!((pairs[0].results[0].expanded - 2.008).abs() < 1e-12);
}

/// The same table under the words that laboratories have; the factors of 95 % are those of the normal
/// distribution, 1.959964, and of t with 10 degrees of freedom, 2.228139 (tables).
#[test]
fn headings_are_words_and_symbols() {
    for heading in [
        "Lab,Value,U",
        "Laboratory,Result,Expanded uncertainty",
        "Labor,Messwert,U(k=2)",
        "Participant,X,U",
        "Label,x / mV,U (k = 2) / mV",
        "LABEL,x [mV],\"U, k=2 [mV]\"",
    ] {
        let found = laboratories(&format!("{heading},\nA,10,4,\nB,11,4,\n"));
        let of =
            |of: &Laboratory| (of.label.clone(), of.result.value, of.result.standard_uncertainty());
        assert_eq!(of(&found[0]), ("A".to_owned(), 10.0, 2.0), "{heading}");
    }
    let u = |text: &str| laboratories(text)[0].result.standard_uncertainty();
    assert_eq!(u("Lab,Value,u\nA,10,2\nB,11,2\n"), 2.0);
    assert_eq!(u("Lab,Value,Standard uncertainty\nA,10,2\nB,11,2\n"), 2.0);
    assert_eq!(u("Lab,Value,U,u\nA,10,5,2\nB,11,5,2\n"), 2.0);
    assert_eq!(u("Lab,Value,Uncertainty,k\nA,10,6,3\nB,11,5,2\n"), 2.0);
    assert!((u("Lab,Value,U95\nA,10,4,\nB,11,4\n") - 4.0 / 1.959_964).abs() < 1e-6);
    let of_t = u("Lab,Value,U (95 %),dof\nA,10,4,10\nB,11,4,inf\n");
    assert!((of_t - 4.0 / 2.228_139).abs() < 1e-6);
    let read = noted("label,date,x,U,method\na,2024,1,1,m\nb,2025,1,1,n\n").unwrap();
    let names = ["date", "method"].map(|name| fact!("quoted", name)).into();
    let names = Argument::all_of(names);
    assert_eq!(read.warnings[0].fact, fact!("columns-not-read", names));
}

/// Factors beside probabilities and units in headings: `k=2, 95 %` was 0.0295, and units beside a factor
/// were dropped.
#[test]
fn headings_state_factors_and_units_together() {
    let u = |heading: &str, x: &str| {
        let text = format!("label,\"{x}\",\"{heading}\"\nA,10,4\nB,11,4\n");
        laboratories(&text)[0].result.standard_uncertainty()
    };
    assert_eq!(u("U (k=2, 95 %)", "x"), 2.0);
    assert_eq!(u("U, µV", "x, µV"), 2.0);
    assert!((u("U (1.96 sigma)", "x") - 4.0 / 1.96).abs() < 1e-15);
    assert!((u("U (µV, k=2)", "x (mV)") - 2e-3).abs() < 1e-15);
    let text = "label,x1,\"U1 (k=2, 95 %)\",x2,\"U2 (k=2, 95 %)\"\na,1,0.4,1.1,0.2\n";
    let Ok(ComparisonTable::Pairs(pairs)) = read(text) else { panic!() };
    assert_eq!(pairs[0].results.map(|of| of.standard_uncertainty()), [0.2, 0.1]);
    let said = |x: &str, heading: &str| {
        read(&format!("label,\"{x}\",\"{heading}\"\nA,10,4\nB,11,4\n")).unwrap_err().to_string()
    };
    assert!(said("x", "U (µV, k=2)").contains("has the unit `µV` and `x` none"));
    assert!(said("x, mV", "U").contains("has the unit `mV` and `U` none"));
    assert!(said("x", "U (k=2,95 %)").contains("can say k = 2 and `95 %`"));
    assert!(said("x", "U (mV rms)").contains("`mV rms` in the heading"));
    // a carriage return alone ends a line: three of four laboratories were gone
    let found = laboratories("label,x,U\nA,1,0.1\rB,5,0.2\rC,3,0.1\r");
    assert_eq!(found.len(), 3);
}

#[test]
fn numbers_are_those_of_sheets() {
    let of = |x: &str| laboratories(&format!("label,x,U\na,{x},1\nb,1,1\n"))[0].result.value;
    assert_eq!(of("\u{2212}1.5"), -1.5);
    assert_eq!(of("1 000.6"), 1000.6);
    let text = "label,x,U,Unit\na,10.002 mV,0.1 mV,\nb,10.003,0.2,mV\nc,0.010004,0.1,V\n";
    let found = laboratories(text);
    assert_eq!((found[0].result.value, found[1].result.value), (10.002, 10.003));
    assert!((found[2].result.value - 10.004).abs() < 1e-12);
    assert_eq!(found[0].result.rounding[0], 0.0005);
}

/// A matrix in the order of the laboratories, with names before its rows in another order, and one half
/// of it.
#[test]
fn correlation_matrices_of_every_layout() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("r.csv");
    let read = |matrix: &str| {
        std::fs::write(&path, matrix).unwrap();
        let options = ComparisonOptions { correlations: Some(&path), ..Default::default() };
        let text = "label,x,U\nA,1,1\nB,2,1\nC,3,1\n";
        match read_comparison_text("t.csv", text, options) {
            Ok(ReadComparison {
                table: ComparisonTable::Laboratories { correlations, .. },
                ..
            }) => Ok(correlations),
            Ok(other) => panic!("{other:?}"),
            Err(said) => Err(said.to_string()),
        }
    };
    let expected = vec![vec![1.0, 0.5, 0.0], vec![0.5, 1.0, 0.3], vec![0.0, 0.3, 1.0]];
    for matrix in [
        "A,B,C\n1,0.5,0\n0.5,1,0.3\n0,0.3,1\n",
        "C,A,B\n1,0,0.3\n0,1,0.5\n0.3,0.5,1\n",
        ",A,B,C\nA,1,0.5,0\nB,0.5,1,0.3\nC,0,0.3,1\n",
        "label,A,B,C\nC,0,0.3,1\nA,1,0.5,0\nB,0.5,1,0.3\n",
        ",A,B,C\nA,1,0.5,0\nB,,1,0.3\nC,,,1\n",
        "A;B;C\n1;;\n0,5;;\n0;0,3;\n",
    ] {
        assert_eq!(read(matrix), Ok(expected.clone()), "{matrix}");
    }
    for (matrix, said) in [
        ("A,B,C\n1,0.5,0\n0.4,1,0.3\n0,0.3,1\n", "is 0.4 in the row of `B` and 0.5 in that of `A`"),
        ("A,B,C\n1,0.5,0\n0.5,1,\n0,,1\n", "no coefficient of `C` and `B`"),
        ("A,B,C\n1,0.5,0\n0.5,2,0\n0,0,1\n", "`B` with itself has the coefficient 2"),
        ("A,B,C\n1,1.5,0\n1.5,1,0\n0,0,1\n", "from -1 to 1"),
        ("A,B\n1,0.5\n0.5,1\n", "`C` has no column"),
        ("A,B,D\n1,0,0\n0,1,0\n0,0,1\n", "no laboratory of the table is called `D`"),
        (",A,B,C\nA,1,0,0\nB,0,1,0\nD,0,0,1\n", "no row of the matrix begins with `C`"),
        ("A,B,C\n1,x,0\n0,1,0\n0,0,1\n", "`x` is not a finite number"),
    ] {
        let found = read(matrix).unwrap_err();
        assert!(found.contains(said) && found.contains("r.csv:"), "{matrix}: {found}");
    }
}

/// What `--against` names and is no answer of a run is told as what it is.
#[test]
fn other_files_than_answers_are_told() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("m.json");
    for (text, said) in [
        (r#"{"inputs": {}, "outputs": {"y": {}}, "equations": {"y": "1"}}"#, "a model file"),
        (r#"{"outputs": {"y": {}}, "result": 1}"#, "a saved result"),
    ] {
        std::fs::write(&path, text).unwrap();
        let options = ComparisonOptions { against: Some(&path), ..Default::default() };
        let found = read_comparison_text("t.csv", "label,x1,U1\ny,1,1\n", options).unwrap_err();
        assert!(found.to_string().contains(said), "{found}");
    }
}

/// Cells of workbooks: styles 1 is a date, 2 shows two decimals, 3 is struck through.
mod of_workbooks {
    use super::*;
    use crate::tests::{sheets, styled};

    fn read(rows: &[&[&str]]) -> Result<ReadComparison, String> {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("t.xlsx");
        std::fs::write(&path, styled(rows)).unwrap();
        read_comparison(&path, ComparisonOptions::default()).map_err(|said| said.to_string())
    }

    #[test]
    fn dates_are_no_numbers() {
        let said =
            read(&[&["label", "x", "U"], &["A", "1:45293", "1"], &["B", "10", "1"]]).unwrap_err();
        assert!(said.contains("cell B2 is a date (2024-01-02), not a number"), "{said}");
        let said =
            read(&[&["label", "x", "U"], &["A", "10", "1:0.5"], &["B", "10", "1"]]).unwrap_err();
        assert!(said.contains("cell C2 is a time (12:00:00), not a number"), "{said}");
        let read =
            read(&[&["label", "x", "U"], &["1:45293", "9", "1"], &["B", "10", "1"]]).unwrap();
        let ComparisonTable::Laboratories { laboratories, .. } = read.table else { panic!() };
        assert_eq!(laboratories[0].label, "2024-01-02");
    }

    #[test]
    fn struck_through_rows_are_refused() {
        let said =
            read(&[&["label", "x", "U"], &["A", "10", "1"], &["3:B", "3:11", "3:1"]]).unwrap_err();
        assert!(said.contains("its row 3 is struck through: remove the strikethrough"), "{said}");
    }

    /// 10.016667 with the format `0.00` is printed as 10.02, within 0.005.
    #[test]
    fn printed_digits_are_those_of_the_format() {
        let read = read(&[&["label", "x", "U"], &["A", "2:10.016667", "2:0.1"], &["B", "10", "1"]]);
        let ComparisonTable::Laboratories { laboratories, .. } = read.unwrap().table else {
            panic!()
        };
        let found = laboratories[0].result;
        assert_eq!(
            (found.value, found.printed, found.rounding),
            (10.016667, [10.02, 0.1], [0.005; 2])
        );
    }

    /// The hidden sheet of earlier results is not read, nor the one of remarks; two tables are asked.
    #[test]
    fn the_sheet_is_the_one_that_is_shown() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("t.xlsx");
        let read = |all: &[(&str, bool, &[&[&str]])], sheet: Option<&str>| {
            std::fs::write(&path, sheets(all)).unwrap();
            let options = ComparisonOptions { sheet, ..Default::default() };
            match read_comparison(&path, options) {
                Ok(ReadComparison {
                    table: ComparisonTable::Laboratories { laboratories, .. },
                    warnings,
                    ..
                }) => {
                    let said = warnings.into_iter().map(|warning| warning.fact);
                    Ok((laboratories[0].label.clone(), said.collect::<Vec<_>>()))
                }
                Ok(other) => panic!("{other:?}"),
                Err(said) => Err(said.to_string()),
            }
        };
        let old: &[&[&str]] = &[&["label", "x", "U"], &["OLD1", "5", "1"], &["OLD2", "6", "1"]];
        let new: &[&[&str]] = &[&["Lab", "Value", "u"], &["C", "5", "1"], &["D", "6", "1"]];
        let words: &[&[&str]] = &[&["Read me"]];
        let (label, said) = read(&[("old", true, old), ("final", false, new)], None).unwrap();
        let others = fact!("quoted.hidden", name = "old");
        let chosen = fact!("sheet-chosen", sheet = "final", others);
        assert_eq!((&*label, said), ("C", vec![chosen]));
        let found = read(&[("Read me", false, words), ("final", false, new)], None).unwrap();
        assert_eq!(found.0, "C");
        let two = [("old", false, old), ("final", false, new)];
        let said = read(&two, None).unwrap_err();
        assert!(
            said.contains("the sheets `old` and `final` hold a table of results each"),
            "{said}"
        );
        assert_eq!(read(&two, Some("old")).unwrap().0, "OLD1");
        let said = read(&[("old", true, old), ("a", false, words)], None).unwrap_err();
        assert!(said.contains("the hidden sheet `old` does"), "{said}");
    }
}

/// A table against what a run has found in a row; `units` are those of its conditions.
fn against(table: &str, units: &str, row: &str) -> Result<ComparisonTable, String> {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("run.json");
    let answer = format!(r#"{{"gumption": "0", "inputs": [], {units} "rows": [{row}]}}"#);
    std::fs::write(&path, answer).unwrap();
    let options = ComparisonOptions { against: Some(&path), ..ComparisonOptions::default() };
    let read = read_comparison_text("t.csv", table, options);
    read.map(|read| read.table).map_err(|errors| errors.to_string())
}

fn output(unit: &str, estimate: f64) -> String {
    format!(
        r#""outputs": {{"y": {{"unit": "{unit}", "gum": {{"estimate": {estimate},
        "expanded_uncertainty": 0.2, "coverage_factor": 2}}}}}}"#
    )
}

/// 0.1 kHz is 100 Hz, wherever its unit stands.
#[test]
fn conditions_are_converted_to_the_unit_of_the_run() {
    let units = r#""condition_units": {"f": "kHz"},"#;
    let row = format!(r#"{{"conditions": {{"f": 0.1}}, {}}}"#, output("V", 10.0));
    let read = |table: &str| against(table, units, &row);
    for table in [
        "label,f,x1,U1\ny,0.1,10,0.2\n",
        "label,f [kHz],x1,U1\ny,0.1,10,0.2\n",
        "label,f [Hz],x1,U1\ny,100,10,0.2\n",
        "label,f / Hz,x1,U1\ny,100,10,0.2\n",
        "label,f (nominal),x1,U1\ny,0.1,10,0.2\n",
        "label,f (nominal Hz),x1,U1\ny,100,10,0.2\n",
        "label,f,x1,U1\ny,100 Hz,10,0.2\n",
        "label,f [Hz],x1,U1\ny,100 Hz,10,0.2\n",
    ] {
        let Ok(ComparisonTable::Pairs(pairs)) = read(table) else { panic!("{table}") };
        assert_eq!(pairs[0].results.map(|result| result.value), [10.0, 10.0], "{table}");
    }
    for (table, said) in [
        ("label,f [Hz],x1,U1\ny,0.1,10,0.2\n", "no row of"),
        ("label,f [s],x1,U1\ny,0.1,10,0.2\n", "`f` of the run is in `kHz`, to which `s` cannot"),
        ("label,f [set],x1,U1\ny,0.1,10,0.2\n", "`set` is no unit"),
        ("label,f,x1,U1\ny,0.1 s,10,0.2\n", "row 1, condition `f`"),
        ("label,f [Hz],x1,U1\ny,0.1 kHz,10,0.2\n", "a column whose heading says `Hz`"),
    ] {
        let error = read(table).unwrap_err();
        assert!(error.contains(said), "{table}: {error}");
    }
    let error = read("label,f [Hz],x1,U1\ny,0.1,10,0.2\n").unwrap_err();
    assert!(error.contains("has f = 0.0001 kHz"), "{error}");
    let rows = format!(r#"{row}, {}"#, row.replace("0.1}", "0.2}"));
    let error = against("label,x1,U1\ny,10,0.2\n", units, &rows).unwrap_err();
    assert!(error.contains("a column for each condition, one of f"), "{error}");
    // an answer of an earlier version
    assert!(against("label,f,x1,U1\ny,0.1,10,0.2\n", "", &row).is_ok());
    for table in ["label,f [Hz],x1,U1\ny,100,10,0.2\n", "label,f,x1,U1\ny,100 Hz,10,0.2\n"] {
        let error = against(table, "", &row).unwrap_err();
        assert!(error.contains("does not say that of the condition `f`"), "{error}");
    }
}

/// Results whose cells have units, and none of the headings.
#[test]
fn cells_have_units_against_a_run() {
    let row = format!(r#"{{"conditions": {{}}, {}}}"#, output("V", 10.0));
    let table = "label,x1,U1\ny,10.0 V,200 mV\n";
    let Ok(ComparisonTable::Pairs(pairs)) = against(table, "", &row) else { panic!() };
    assert_eq!(pairs[0].results.map(|of| (of.value, of.expanded)), [(10.0, 0.2); 2]);
    let mixed = [table, "y,10,0.2\n"].concat();
    let error = against(&mixed, "", &row).unwrap_err();
    assert!(error.contains("row 2: some numbers have a unit and others none"), "{error}");
}

/// A temperature, or a difference of temperatures.
#[test]
fn values_from_two_zeros_are_asked() {
    let row = |unit: &str| format!(r#"{{"conditions": {{}}, {}}}"#, output(unit, 0.0));
    let table = "label,x1 [K],U1 [K]\ny,0.1,0.1\n";
    let both = "a temperature or a difference of temperatures; write it in `degC`";
    let error = against(table, "", &row("degC")).unwrap_err();
    assert!(error.contains("row 1") && error.contains(both), "{error}");
    for (table, unit) in [
        (table, "K"),
        ("label,x1 [mK],U1 [mK]\ny,100,100\n", "K"),
        ("label,x1 [degC],U1 [K]\ny,0.1,0.1\n", "degC"),
        ("label,x1,U1\ny,0.1,0.1\n", "degC"),
    ] {
        assert!(against(table, "", &row(unit)).is_ok(), "{table} {unit}");
    }
    for table in [
        "label,x1 [degC],U1 [K],x2 [K],U2 [K]\na,0.1,0.1,0,0.1\n",
        "label,x,U,Unit\na,20,0.1,degC\nb,293.15,0.1,K\n",
    ] {
        let errors = read(table).unwrap_err().to_string();
        assert!(errors.contains(both), "{errors}");
    }
}

/// Nominal values beside results are not read, and a pilot or a reference laboratory is a laboratory.
#[test]
fn nominal_values_and_reference_laboratories() {
    for text in [
        "label,nominal,x1,U1,x2,U2\na,10,1,1,2,1\n",
        "label,nominal,Value,U\na,10,1,1\nb,10,2,1\n",
        "label,Nominal value,x,U\na,10,1,1\nb,10,2,1\n",
    ] {
        let read = noted(text).unwrap_or_else(|error| panic!("{text}: {error}"));
        let [said] = &read.warnings[..] else { panic!("{text}: {:?}", read.warnings) };
        let Some(Argument::Text(name)) = said.fact.argument("name") else {
            panic!("{text}: {said:?}");
        };
        assert!(said.fact.key == "columns-not-read.one" && name.to_lowercase().contains("nominal"));
    }
    let found = laboratories("label,x,U\nPilot,10,1\nReference laboratory,10,1\n");
    assert_eq!(found.len(), 2);
}

/// By hand: 359.95 deg and 0.02 deg are 0.07 deg apart, half of U(d) = 0.1 sqrt(2) deg; they were 359.93 deg
/// and En = 2545. Of three laboratories the mean of 359.95, 0.02 and 0.03 is 0 deg.
#[test]
fn angles_are_compared_on_one_branch() {
    let heading = "label,x1 [deg],U1 [deg],x2 [deg],U2 [deg]\n";
    let found = noted(&format!("{heading}a,359.95,0.1,0.02,0.1\nb,10,0.1,10.1,0.1\n")).unwrap();
    let ComparisonTable::Pairs(pairs) = &found.table else { panic!() };
    let compared = pairs[0].compare().unwrap();
    assert!((compared.difference + 0.07).abs() < 1e-12, "{compared:?}");
    assert!((compared.normalized_error - 0.07 / 0.02f64.sqrt()).abs() < 1e-9);
    assert_eq!(pairs[1].results[1].value, 10.1);
    let codes: Vec<&str> = found.warnings.iter().map(|of| of.code()).collect();
    assert_eq!(codes, ["angle-branch"]);
    let [angle, compared] = ["0.02 deg", "360.02 deg"].map(Argument::number);
    let moved = fact!("angle-branch.moved", angle, name = "a, second", compared);
    assert_eq!(found.warnings[0].fact.argument("angles"), Some(&moved.into()));
    let text = "Lab,x [deg],U [arcmin]\nA,0.02,6\nB,359.95,6\nC,0.03,6\n";
    let values: Vec<f64> = laboratories(text).iter().map(|of| of.result.value).collect();
    assert_eq!(values, [0.02, -0.05, 0.03]);
    // the printed digits go with the value
    assert_eq!(laboratories(text)[1].result.printed[0], -0.05);
    for (text, expected) in [
        (
            format!("{heading}a,5,0.1,725,0.1\n"),
            "`a`, 5 deg, and `a, second`, 725 deg, are more than",
        ),
        (
            "Lab,x [deg],U [deg]\nA,0,1\nB,120,1\nC,240,1\n".to_owned(),
            "`A`, 0 deg, and `C`, 240 deg",
        ),
    ] {
        let error = read(&text).unwrap_err().to_string();
        assert!(error.contains(expected), "{error}");
    }
    for unit in ["rev", "mm"] {
        let text = format!("Lab,x [{unit}],U [{unit}]\nA,0,1\nB,359,1\n");
        assert_eq!(laboratories(&text)[1].result.value, 359.0);
    }
}

/// `1,000` of a condition was 1 without a word, where it may be 1000.
#[test]
fn marks_of_conditions_are_asked() {
    let row = format!(r#"{{"conditions": {{"f": 1}}, {}}}"#, output("V", 10.0));
    let found = against("label;f;x1;U1\ny;1,000;10;2\n", "", &row).unwrap_err();
    assert!(found.contains("`1,000` can be `1.000` or `1000`"), "{found}");
    // another number that shows the mark
    assert!(against("label;f;x1;U1\ny;1,000;10,5;2\n", "", &row).is_ok());
    let found = read("label;x1;U1;k1;x2;U2\na;10;2;2,000;11;2\n").unwrap_err().to_string();
    assert!(found.contains("`2,000` can be"), "{found}");
}

/// The results of a pair: of 10.0 with U = 0.2 and 10.1 with 0.1 (k = 2).
fn is_lab_and_reference(text: &str) {
    let Ok(ComparisonTable::Pairs(pairs)) = read(text) else {
        panic!("{text}: {:?}", read(text).map_err(|errors| errors.to_string()))
    };
    let [lab, reference] = pairs[0].results;
    let found = [lab.value, lab.expanded / lab.factor, reference.value, reference.expanded];
    for (found, expected) in found.into_iter().zip([10.0, 0.1, 10.1, 0.1]) {
        assert!((found - expected).abs() < 1e-12, "{text}: {pairs:?}");
    }
    assert_eq!(reference.factor, 2.0, "{text}");
}

#[test]
fn laboratory_and_reference_are_told_by_words() {
    for heading in [
        "Point;Lab value [V];U_lab (k=2) [V];Ref. value [V];Ref U [V]",
        "Point;Lab value;U_lab;Assigned value;U_ref",
        "Lab;Result;U;Assigned value;U_ref",
        "Lab;x_lab;Ulab;x_ref;Uref",
        "Lab;X_LAB;U_LAB;X_REF;U_REF",
        "Lab;x_i;U(x_i);x_pt;U(x_pt)",
        "Messpunkt;Laborwert;U_Lab;Referenzwert;U_Ref",
        "Messpunkt;Laborwert;U Labor;zugewiesener Wert;U des zugewiesenen Wertes",
        "Punkt;Messwert Labor;erw. Messunsicherheit Labor;Bezugswert;erw. Messunsicherheit Referenz",
        "Point de mesure;Valeur laboratoire;Incertitude élargie laboratoire;Valeur de référence;Incertitude élargie de référence",
        "Point;Valeur du laboratoire;U_lab;Valeur assignée;U_réf",
        "Point;Lab error;U_lab;Reference error;U_ref",
        "Nominal value;Value_lab;U_lab;ref_value;ref_U",
        "Point;Lab value;Lab uncertainty (k=2);Reference value;Reference uncertainty (k=2)",
    ] {
        is_lab_and_reference(&format!("{heading}\n1;10,0;0,2;10,1;0,1\n"));
    }
    is_lab_and_reference("Ref value;U_ref;Lab;Lab value;U_lab\n10,1;0,1;1;10,0;0,2\n");
    is_lab_and_reference(
        "Lab,x_lab,u_lab,x_ref,U_ref,Difference,En\n1,10.0,0.1,10.1,0.1,-0.1,0.4\n",
    );
    // results of one laboratory each
    for text in ["Lab,x_lab,U_lab\nA,1,2\nB,2,1\n", "Labor;Abweichung [V];U [V]\nA;1;2\nB;2;1\n"] {
        assert_eq!(laboratories(text)[1].result.value, 2.0, "{text}");
    }
    let refused = |text: &str| read(text).unwrap_err().to_string();
    let found = refused("Lab,Value,Error,U\nA,1,1,1\nB,1,1,1\n");
    assert!(found.contains("`Value` and `Error` can both be what is compared"), "{found}");
    let found = refused("Point,Lab value,Lab uncertainty,Ref value,U_ref\n1,1,1,1,1\n");
    assert!(found.contains("`Lab uncertainty` can be the standard uncertainty"), "{found}");
    // points have no mean, and what is not read may be of the reference
    let found = refused("Point,Value,U\n1,1,1\n2,1,1\n");
    assert!(found.contains("no column label"), "{found}");
    let found = refused("Lab,Lab value,U lab,After,U after\na,1,1,1,1\nb,1,1,1,1\n");
    assert!(found.contains("`U after` is not known"), "{found}");
    is_lab_and_reference("Lab,x_lab,U_lab,x_ref,U_ref\n1,10.0,±0.2,10.1,+/-0.1\n");
    let found = refused("Point,x_lab,U,x_ref,u\n1,1,1,1,1\n");
    assert!(found.contains("no column U"), "{found}");
}

#[test]
fn results_in_one_cell() {
    for (text, expanded, factor) in [
        ("Lab,x\nA,10.0(2)\nB,10.1(1) \n", 0.2, 1.0),
        ("Lab,x [V]\nA,10.0(2) V\nB,10.1(1)\n", 0.2, 1.0),
        ("Lab,x (k=2)\nA,10.0 ± 0.2\nB,10.1 ± 0.1\n", 0.2, 2.0),
        ("Lab,Value ± U\nA,10.0 ± 0.2\nB,10.1 +/- 0.1\n", 0.2, 2.0),
        ("Lab,x ± u\nA,10.0 ± 0.2\nB,10.1 ± 0.1\n", 0.2, 1.0),
        ("Lab,Value\nA,(10.0 ± 0.2) V (k=2)\nB,10.1 V ± 100 mV (k=2)\n", 0.2, 2.0),
        ("Lab,Value,k\nA,10.0 ± 0.2,3\nB,10.1 ± 0.1,2\n", 0.2, 3.0),
        ("Labor;Messwert (k=2)\nA;10,0 ± 0,2\nB;10,1 ± 0,1\n", 0.2, 2.0),
    ] {
        let found = laboratories(text);
        assert!((found[0].result.expanded - expanded).abs() < 1e-12, "{text}: {found:?}");
        assert_eq!((found[0].result.value, found[0].result.factor), (10.0, factor), "{text}");
    }
    is_lab_and_reference("Point,Lab value,Ref value\n1,10.0 ± 0.2 (k=2),10.1 ± 0.1 (k=2)\n");
    for (text, expected) in [
        ("Lab,x\nA,10.0 ± 0.2\nB,10.1 ± 0.1\n", "the standard uncertainty or an expanded one"),
        ("Lab,x (k=2)\nA,10.0(2)\nB,10.1(1)\n", "and the table the coverage factor 2"),
        ("Lab,x (k=2)\nA,10.0 ± 0.2 (k=3)\nB,10.1 ± 0.1\n", "is 3 in one place and 2 in another"),
        ("Lab,x (k=2)\nA,10.0 ± 0.2\nB,10.1\n", "`10.1` has no uncertainty behind it"),
        ("Lab,x,U\nA,10.0 ± 0.2,0.2\nB,10.1,0.1\n", "write the estimate alone"),
        ("Lab;x (k=2)\nA;1,000 ± 1\nB;1,001 ± 1\n", "`1,000` can be `1.000` or `1000`"),
    ] {
        let found = read(text).unwrap_err().to_string();
        assert!(found.contains(expected), "{text}: {found}");
    }
}
