//! Ways in: budgets in spreadsheets, and workbooks of this program with changed cells.

use std::fs;
use std::io::{Cursor, Read, Write};
use std::path::Path;

use rust_xlsxwriter::{Format, Workbook};
use serde_json::Value;
use zip::write::SimpleFileOptions;
use zip::{ZipArchive, ZipWriter};

use crate::support::{command, root};

/// Standard output and error of the program in a folder, with its exit code.
fn told(folder: &Path, arguments: &[&str]) -> (String, String, Option<i32>) {
    let said = command().args(arguments).current_dir(folder).output().expect("a run");
    let text = |bytes| String::from_utf8(bytes).expect("UTF-8");
    (text(said.stdout), text(said.stderr), said.status.code())
}

/// A workbook in whose sheets some texts are replaced, as by a hand in a cell.
fn changed(book: &Path, replacements: &[(&str, &str)]) {
    let mut archive = ZipArchive::new(Cursor::new(fs::read(book).unwrap())).unwrap();
    let mut writer = ZipWriter::new(Cursor::new(Vec::new()));
    let mut made = 0;
    for number in 0..archive.len() {
        let mut part = archive.by_index(number).unwrap();
        let name = part.name().unwrap().into_owned();
        let mut content = Vec::new();
        part.read_to_end(&mut content).unwrap();
        if name.starts_with("xl/worksheets/") {
            let mut text = String::from_utf8(content).unwrap();
            // only on the sheet of inputs, whose coverage probability stands in B4
            if text.contains("r=\"I7\"") && text.contains("<f>C7*H7</f>")
                || text.contains("$C$7*$H$7")
            {
                for (from, to) in replacements {
                    assert!(text.contains(from), "{from}: {text}");
                    text = text.replacen(from, to, 1);
                    made += 1;
                }
            }
            content = text.into_bytes();
        }
        writer.start_file(name, SimpleFileOptions::default()).unwrap();
        writer.write_all(&content).unwrap();
    }
    assert_eq!(made, replacements.len());
    fs::write(book, writer.finish().unwrap().into_inner()).unwrap();
}

const MODEL: &str = r#"{
  "title": "Power",
  "inputs": {
    "voltage": {"unit": "V", "distribution": "normal", "expanded": 0.02, "k": 2, "mean": 5.01},
    "current": {"unit": "mA", "distribution": "rectangular", "mean": 12, "half_width": 0.3},
    "rep": {"unit": "1", "distribution": "readings", "values": [1.01, 0.99, 1.0]}
  },
  "correlations": [["voltage", "current", 0.25]],
  "equations": {"power": "voltage*current*rep"},
  "outputs": {"power": {"unit": "mW"}}
}
"#;

#[test]
fn a_workbook_of_ours_comes_back_with_its_changed_cells() {
    let folder = tempfile::tempdir().unwrap();
    let at = folder.path();
    fs::write(at.join("power.json"), MODEL).unwrap();
    let export = ["run", "power.json", "--format", "xlsx", "--output", "b.xlsx", "--trials", "0"];
    assert_eq!(told(at, &export).2, Some(0));
    // untouched it is the same file
    let (text, said, code) = told(at, &["import", "b.xlsx"]);
    assert_eq!((text.as_str(), code), (MODEL, Some(0)), "{said}");
    assert!(said.contains("other cells are ignored"), "{said}");

    // voltage 5.2 V with u = 0.02 V; u of the current doubled; the readings' estimate; r
    changed(
        &at.join("b.xlsx"),
        &[
            ("<v>5.01</v>", "<v>5.2</v>"),
            ("<v>0.01</v>", "<v>0.02</v>"),
            ("<v>0.17320508075688773</v>", "<v>0.34641016151377546</v>"),
            ("<v>1</v></c><c r=\"C9\"", "<v>1.001</v></c><c r=\"C9\""),
            ("<v>0.25</v>", "<v>-0.5</v>"),
        ],
    );
    let (text, said, code) = told(at, &["import", "b.xlsx", "--output", "changed.json"]);
    assert_eq!(code, Some(0), "{text} {said}");
    for part in ["`voltage`: estimate 5.2 instead of 5.01", "r(voltage, current) = -0.5"] {
        assert!(said.contains(part), "{part}: {said}");
    }
    assert!(said.contains("note: `rep` is normal now"), "{said}");
    let made: Value =
        serde_json::from_str(&fs::read_to_string(at.join("changed.json")).unwrap()).unwrap();
    let number = |value: &Value| value.as_f64().unwrap();
    let inputs = &made["inputs"];
    assert_eq!(inputs["voltage"]["mean"], 5.2);
    assert!((number(&inputs["voltage"]["expanded"]) - 0.04).abs() < 1e-15);
    assert!((number(&inputs["current"]["half_width"]) - 0.6).abs() < 1e-14);
    assert_eq!(inputs["rep"]["distribution"], "normal");
    assert_eq!(inputs["rep"]["dof"], 2.0);
    assert_eq!(made["correlations"][0][2], -0.5);

    // a cell that holds no number, and one that no width can be
    changed(&at.join("b.xlsx"), &[("<v>0.02</v>", "<v>-0.02</v>")]);
    let (text, said, code) = told(at, &["import", "b.xlsx"]);
    assert_eq!((text.as_str(), code), ("", Some(2)), "{said}");
    assert!(said.contains("expanded"), "{said}");
}

/// German headers, a title in merged cells, empty rows, a column of formulas.
#[test]
fn a_german_workbook_becomes_a_model() {
    let folder = tempfile::tempdir().unwrap();
    let mut book = Workbook::new();
    let sheet = book.add_worksheet();
    let bold = Format::new().set_bold();
    sheet.merge_range(0, 0, 0, 6, "Messunsicherheitsbudget", &bold).unwrap();
    sheet.write_string(2, 0, "R = U/I").unwrap();
    let header = [
        "Größe",
        "Schätzwert",
        "Einheit",
        "Halbbreite",
        "Verteilung",
        "Teiler",
        "Standardunsicherheit",
        "Freiheitsgrade",
    ];
    for (column, name) in (0..).zip(header) {
        sheet.write_string(4, column, name).unwrap();
    }
    // an empty row between the two quantities
    for (row, (name, estimate, unit, half, shape, divisor)) in [
        (6, ("U", 5.0112, "V", 0.0046, "Normal", 2.0)),
        (8, ("I", 0.01, "A", 1e-5, "Rechteck", 1.7320508075688772)),
    ] {
        sheet.write_string(row, 0, name).unwrap();
        sheet.write_number(row, 1, estimate).unwrap();
        sheet.write_string(row, 2, unit).unwrap();
        sheet.write_number(row, 3, half).unwrap();
        sheet.write_string(row, 4, shape).unwrap();
        sheet.write_number(row, 5, divisor).unwrap();
        let formula = rust_xlsxwriter::Formula::new(format!("=D{0}/F{0}", row + 1));
        let formula = formula.set_result(format!("{}", half / divisor));
        sheet.write_formula(row, 6, formula).unwrap();
        sheet.write_string(row, 7, "∞").unwrap();
    }
    book.save(folder.path().join("budget.xlsx")).unwrap();
    let (text, said, code) =
        told(folder.path(), &["import", "budget.xlsx", "--output", "model.json"]);
    assert_eq!(code, Some(0), "{text} {said}");
    assert!(said.contains("the equation R = U/I"), "{said}");
    let (text, said, code) =
        told(folder.path(), &["run", "model.json", "--format", "json", "--trials", "0"]);
    assert_eq!(code, Some(0), "{said}");
    let answer: Value = serde_json::from_str(&text).unwrap();
    let r = &answer["outputs"]["R"]["gum"];
    // 501.12 ohm, relative u of 0.0023/5.0112 and 1e-3/sqrt(3)
    let relative = f64::hypot(0.0023 / 5.0112, 1e-3 / 3.0_f64.sqrt());
    assert!((r["estimate"].as_f64().unwrap() - 501.12).abs() < 1e-9);
    assert!((r["standard_uncertainty"].as_f64().unwrap() / (501.12 * relative) - 1.0).abs() < 1e-9);
}

/// Cells are read as they are shown: 0.0002 in a cell that shows `0.02 %` is a share of the estimate,
/// and 0.5 in one that shows `0.5 mV` is half a millivolt in a row of volts.
#[test]
fn cells_of_a_workbook_mean_what_they_show() {
    let folder = tempfile::tempdir().unwrap();
    let mut book = Workbook::new();
    let sheet = book.add_worksheet();
    let header = ["Quantity", "Estimate", "Unit", "Half-width", "Distribution", "Divisor"];
    for (column, name) in (0..).zip(header) {
        sheet.write_string(0, column, name).unwrap();
    }
    for (row, (name, format, half)) in
        [(1, ("U", "0.00%", 0.0002)), (2, ("dU", "0.0\" mV\"", 0.5)), (3, ("dV", "0.0000", 0.0003))]
    {
        sheet.write_string(row, 0, name).unwrap();
        sheet.write_number(row, 1, if row == 1 { 10.05 } else { 0.0 }).unwrap();
        sheet.write_string(row, 2, "V").unwrap();
        let format = Format::new().set_num_format(format);
        sheet.write_number_with_format(row, 3, half, &format).unwrap();
        sheet.write_string(row, 4, "rectangular").unwrap();
    }
    book.save(folder.path().join("shown.xlsx")).unwrap();
    let (text, said, code) = told(
        folder.path(),
        &[
            "import",
            "shown.xlsx",
            "--output",
            "model.json",
            "--coefficients",
            "one",
            "--row",
            "quantity=2",
        ],
    );
    assert_eq!(code, Some(0), "{text} {said}");
    let model = fs::read_to_string(folder.path().join("model.json")).unwrap();
    let model: Value = serde_json::from_str(&model).unwrap();
    for (name, half) in [("U", 0.00201), ("dU", 0.0005), ("dV", 0.0003)] {
        assert_eq!(model["inputs"][name]["half_width"], half, "{model}");
    }
}

/// What a number format shows around a number makes another one of it: `√3` of 3, `5×10³` of 5.
#[test]
fn formats_that_make_another_number_are_read_or_refused() {
    let folder = tempfile::tempdir().unwrap();
    let save = |cells: [(&str, f64); 3]| {
        let mut book = Workbook::new();
        let sheet = book.add_worksheet();
        let header = ["Quantity", "Estimate", "Unit", "Half-width", "Distribution", "Divisor"];
        for (column, name) in (0..).zip(header) {
            sheet.write_string(0, column, name).unwrap();
        }
        for (column, text) in [(0, "x"), (2, "V"), (4, "rectangular")] {
            sheet.write_string(1, column, text).unwrap();
        }
        for (column, (format, value)) in [1, 3, 5].into_iter().zip(cells) {
            let format = Format::new().set_num_format(format);
            sheet.write_number_with_format(1, column, value, &format).unwrap();
        }
        book.save(folder.path().join("shown.xlsx")).unwrap();
        told(folder.path(), &["import", "shown.xlsx", "--coefficients", "one"])
    };
    for format in ["0.0\"×10³\"", "0.0\"x10^3\"", "0.0\"e3\"", "0.0\"·10³ V\""] {
        let (text, said, code) = save([(format, 5.0), ("0", 10.0), ("\"√\"0", 3.0)]);
        assert_eq!(code, Some(0), "{format} {said}");
        let model: Value = serde_json::from_str(&text).unwrap();
        let expected = serde_json::json!({"unit": "V", "distribution": "rectangular", "mean": 5000.0,
            "half_width": 10.0});
        assert_eq!(model["inputs"]["x"], expected, "{format}");
    }
    for (cells, shown) in [
        ([("\"<\"0", 5.0), ("0", 1.0), ("0", 3.0)], "<5"),
        ([("0\",\"0", 15.0), ("0", 1.0), ("0", 3.0)], "shown with `,` between digits"),
        ([("0", 5.0), ("0.0\"*\"", 1.0), ("\"√\"0", 3.0)], "1 *"),
    ] {
        let (text, said, code) = save(cells);
        assert_eq!(code, Some(2), "{text}");
        assert!(said.contains("line 2") || said.contains(":2:"), "{said}");
        assert!(said.contains(shown), "{said}");
    }
}

/// A sheet with a header, and rows of a name, an estimate and a half-width in volts.
fn budget_on(sheet: &mut rust_xlsxwriter::Worksheet, rows: &[(&str, f64, f64)]) {
    let header = ["Quantity", "Estimate", "Unit", "Half-width", "Distribution"];
    for (column, name) in (0..).zip(header) {
        sheet.write_string(0, column, name).unwrap();
    }
    for (row, (name, estimate, half)) in (1..).zip(rows) {
        sheet.write_string(row, 0, *name).unwrap();
        sheet.write_number(row, 1, *estimate).unwrap();
        sheet.write_string(row, 2, "V").unwrap();
        sheet.write_number(row, 3, *half).unwrap();
        sheet.write_string(row, 4, "rectangular").unwrap();
    }
}

/// The first sheet that is shown and holds a budget is read; where several do, the name tells.
#[test]
fn sheets_of_a_workbook() {
    let folder = tempfile::tempdir().unwrap();
    let at = folder.path();
    let mut book = Workbook::new();
    let old = book.add_worksheet().set_name("Old").unwrap();
    budget_on(old, &[("A", 0.0, 0.7)]);
    old.set_hidden(true);
    book.add_worksheet().set_name("Cover").unwrap().write_string(0, 0, "Laboratory").unwrap();
    let sheet = book.add_worksheet().set_name("Budget").unwrap();
    budget_on(sheet, &[("A", 0.0, 0.2)]);
    sheet.set_active(true);
    book.save(at.join("one.xlsx")).unwrap();
    let (text, said, code) = told(at, &["import", "one.xlsx"]);
    assert_eq!(code, Some(0), "{said}");
    assert!(text.contains("\"half_width\":0.2"), "{text}");
    assert!(said.contains("sheet `Budget` is read, not `Old` (hidden) or `Cover`"), "{said}");
    let (text, _, code) = told(at, &["import", "one.xlsx", "--sheet", "Old"]);
    assert_eq!(code, Some(0));
    assert!(text.contains("\"half_width\":0.7"), "{text}");
    let (_, said, code) = told(at, &["import", "one.xlsx", "--sheet", "None"]);
    assert_eq!(code, Some(2));
    let part = "it has no sheet `None`; its sheets are `Old` (hidden), `Cover` and `Budget`";
    assert!(said.contains(part), "{said}");
    let mut book = Workbook::new();
    book.add_worksheet().write_string(0, 0, "Laboratory").unwrap();
    let hidden = book.add_worksheet().set_name("Old").unwrap();
    budget_on(hidden, &[("A", 0.0, 0.7)]);
    hidden.set_hidden(true);
    book.save(at.join("none.xlsx")).unwrap();
    let (_, said, code) = told(at, &["import", "none.xlsx"]);
    assert_eq!(code, Some(2));
    assert!(said.contains("the hidden sheet `Old` does: show it"), "{said}");
    fs::write(at.join("b.csv"), "Quantity,Estimate,Unit,Half-width\n").unwrap();
    let (_, said, code) = told(at, &["import", "b.csv", "--sheet", "Old"]);
    assert_eq!(code, Some(2));
    assert!(said.contains("it is no workbook (.xlsx), and so has no sheet `Old`"), "{said}");
    let mut book = Workbook::new();
    for (name, half) in [("DC", 0.2), ("AC", 0.4)] {
        budget_on(book.add_worksheet().set_name(name).unwrap(), &[("A", 0.0, half)]);
    }
    book.save(at.join("two.xlsx")).unwrap();
    let (_, said, code) = told(at, &["import", "two.xlsx"]);
    assert_eq!(code, Some(2));
    assert!(said.contains("the sheets `DC` and `AC` hold a budget each"), "{said}");
    assert!(said.contains("`--sheet NAME`"), "{said}");
    let (text, _, code) = told(at, &["import", "two.xlsx", "--sheet", "AC"]);
    assert_eq!(code, Some(0));
    assert!(text.contains("\"half_width\":0.4"), "{text}");
}

/// Rows that nobody sees, or that are struck through, are asked; before, they were used.
#[test]
fn rows_that_are_hidden_or_struck_through() {
    let folder = tempfile::tempdir().unwrap();
    let at = folder.path();
    let import = |change: &dyn Fn(&mut rust_xlsxwriter::Worksheet)| {
        let mut book = Workbook::new();
        let sheet = book.add_worksheet();
        budget_on(sheet, &[("A", 0.0, 0.2), ("B", 0.0, 0.3)]);
        change(sheet);
        book.save(at.join("b.xlsx")).unwrap();
        let (_, said, code) = told(at, &["import", "b.xlsx"]);
        (said, code)
    };
    let (said, code) = import(&|sheet| {
        sheet.set_row_hidden(2).unwrap();
    });
    assert_eq!(code, Some(2), "{said}");
    assert!(said.contains("row 3 (`B`) is hidden: show it, or delete it"), "{said}");
    let (said, code) = import(&|sheet| {
        sheet.set_row_height(2, 0).unwrap();
    });
    assert_eq!(code, Some(2), "{said}");
    let (said, code) = import(&|sheet| {
        let struck = Format::new().set_font_strikethrough();
        sheet.write_string_with_format(2, 0, "B", &struck).unwrap();
    });
    assert_eq!(code, Some(2), "{said}");
    assert!(said.contains("row 3 (`B`) is struck through"), "{said}");
    let (said, code) = import(&|sheet| {
        sheet.set_row_hidden(7).unwrap();
    });
    assert_eq!(code, Some(0), "{said}");
}

/// Merged cells of units, distributions and divisors count for all rows that they span.
#[test]
fn merged_cells_count_for_their_rows() {
    let folder = tempfile::tempdir().unwrap();
    let mut book = Workbook::new();
    let sheet = book.add_worksheet();
    budget_on(sheet, &[("A", 0.0, 0.2), ("B", 0.0, 0.3), ("C", 0.0, 0.4)]);
    for row in 1..=3 {
        sheet.write_blank(row, 2, &Format::new()).unwrap();
        sheet.write_blank(row, 4, &Format::new()).unwrap();
    }
    sheet.merge_range(1, 2, 3, 2, "mV", &Format::new()).unwrap();
    sheet.merge_range(1, 4, 2, 4, "triangular", &Format::new()).unwrap();
    sheet.write_string(3, 4, "rectangular").unwrap();
    book.save(folder.path().join("b.xlsx")).unwrap();
    let (text, said, code) = told(folder.path(), &["import", "b.xlsx"]);
    assert_eq!(code, Some(0), "{said}");
    let model: Value = serde_json::from_str(&text).unwrap();
    for (name, shape) in [("A", "triangular"), ("B", "triangular"), ("C", "rectangular")] {
        assert_eq!(model["inputs"][name]["unit"], "mV", "{text}");
        assert_eq!(model["inputs"][name]["distribution"], shape, "{text}");
    }
    assert!(said.contains("the merged cell `triangular` counts for rows 2 to 3"), "{said}");
}

/// The rows of a certificate's workbook are results; before, they were inputs of a sum.
#[test]
fn the_workbook_of_a_certificate_is_no_budget() {
    let folder = tempfile::tempdir().unwrap();
    let at = folder.path();
    fs::write(at.join("power.json"), MODEL).unwrap();
    let rows = r#"{"rows": [{"model": "power.json", "output": "power", "nominal": 0.5}], "monte_carlo": {"trials": 0}}"#;
    fs::write(at.join("c.json"), rows).unwrap();
    let export = ["certificate", "c.json", "--format", "xlsx", "--output", "c.xlsx"];
    let (_, said, code) = told(at, &export);
    assert_eq!(code, Some(0), "{said}");
    for sheet in [&[][..], &["--sheet", "Certificate"], &["--sheet", "Unrounded"]] {
        let (text, said, code) = told(at, &[&["import", "c.xlsx"], sheet].concat());
        assert_eq!((text.as_str(), code), ("", Some(2)), "{said}");
        assert!(
            said.contains("it is the workbook of a certificate, whose rows are results"),
            "{said}"
        );
    }
    for language in ["de", "fr", "it"] {
        let text = rows.replacen('{', &format!("{{\"language\": [\"{language}\"], "), 1);
        fs::write(at.join("c.json"), text).unwrap();
        let (_, said, code) = told(at, &export);
        assert_eq!(code, Some(0), "{said}");
        for ask in ["import", "compare"] {
            let (_, said, code) = told(at, &[ask, "c.xlsx"]);
            assert!(code == Some(2) && said.contains("the workbook of a certificate"), "{said}");
        }
    }
}

/// A question is an error with the option that decides; options are kept beside the sheet and read again.
#[test]
fn questions_name_the_option_that_decides() {
    let folder = tempfile::tempdir().unwrap();
    let at = folder.path();
    let sheet = "Source,Deviation of it,Unit,Expanded uncertainty\na,0,mV,0.4\nb,0,mV,0.3\n";
    fs::write(at.join("b.csv"), sheet).unwrap();
    let (text, said, code) = told(at, &["import", "b.csv", "--format", "json"]);
    assert_eq!(code, Some(2), "{said}");
    let answer: Value = serde_json::from_str(&text).unwrap();
    assert_eq!(answer["ok"], false);
    let question = &answer["questions"][0];
    assert!(question["about"].as_str().unwrap().contains("column B `Deviation of it`"), "{text}");
    assert_eq!(question["readings"].as_array().unwrap().len(), 2, "{text}");
    assert!(question["option"].as_str().unwrap().contains("`--column ignore=B`"), "{text}");
    assert!(said.contains("b.csv:1:1"), "{said}");
    let options = ["--column", "estimate=Deviation of it", "--k", "2", "--keep-columns"];
    let (first, said, code) = told(at, &[&["import", "b.csv"], &options[..]].concat());
    assert_eq!(code, Some(0), "{said}");
    let (again, said, code) = told(at, &["import", "b.csv"]);
    assert_eq!((again, code), (first, Some(0)), "{said}");
    assert!(said.contains("note: the options of `b.csv.columns.json` are used"), "{said}");
    // one option goes before what is kept
    let (text, _, code) = told(at, &["import", "b.csv", "--k", "3"]);
    assert!(code == Some(0) && text.contains("\"k\":3.0"), "{text}");
    fs::write(at.join("b.csv.columns.json"), "{\"colums\": []}").unwrap();
    let (_, said, code) = told(at, &["import", "b.csv"]);
    assert!(code == Some(2) && said.contains("`colums`"), "{said}");
    for (options, part) in [
        (["--column", "estimat=B"], "there is no column `estimat`"),
        (["--column", "estimate=Z9"], "no column is called `Z9`"),
        (["--row", "results=2"], "a row is one of heading, quantity"),
        (["--row", "result=77"], "the sheet has no row `77`"),
        (["--k", "0"], "a number above 0"),
    ] {
        fs::write(at.join("c.csv"), sheet).unwrap();
        let (text, said, code) = told(at, &[&["import", "c.csv"], &options[..]].concat());
        assert_eq!((text.as_str(), code), ("", Some(2)), "{said}");
        assert!(said.contains(part), "{part}: {said}");
    }
}

/// A template is a workbook that is read without a question.
#[test]
fn a_template_is_read_without_a_question() {
    let folder = tempfile::tempdir().unwrap();
    let at = folder.path();
    let (_, said, code) = told(at, &["import", "--template", "t.xlsx"]);
    assert_eq!(code, Some(0), "{said}");
    let (text, said, code) = told(at, &["import", "t.xlsx"]);
    assert_eq!(code, Some(0), "{said}");
    let model: Value = serde_json::from_str(&text).unwrap();
    assert_eq!(model["equations"]["R"], "V/I");
    assert_eq!(model["inputs"]["V"]["about"], "V; voltage; certificate");
}

/// A certificate of somebody else is listed, and other commands name the one that does it.
#[test]
fn a_digital_certificate_is_listed() {
    let folder = tempfile::tempdir().unwrap();
    let certificate = root().join("tests/errors/damaged_dcc.txt");
    fs::copy(certificate, folder.path().join("ref.xml")).unwrap();
    let (text, said, code) = told(folder.path(), &["dcc", "ref.xml"]);
    assert_eq!((said.as_str(), code), ("", Some(0)));
    assert!(text.contains("0  id v\n") && text.contains("not read: `five` in `value`"), "{text}");
    let (text, _, _) = told(folder.path(), &["dcc", "ref.xml", "--format", "json"]);
    let answer: Value = serde_json::from_str(&text).unwrap();
    assert_eq!(answer["results"][0]["id"], "v");
    for command in ["run", "check"] {
        let (_, said, code) = told(folder.path(), &[command, "ref.xml"]);
        assert_eq!(code, Some(2));
        let expected =
            "this is a digital calibration certificate, whose quantities `gumption dcc` lists";
        assert!(said.contains(expected), "{said}");
    }
}
