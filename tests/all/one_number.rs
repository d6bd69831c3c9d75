//! One result reads the same wherever it is printed: the expanded uncertainty of `run` and that of
//! `certificate`, in every format of both.

use std::fs;
use std::io::{Cursor, Read};
use std::path::Path;

use calamine::{Data, Reader, Xlsx};
use serde_json::{Value, json};

use crate::support::{gumption, root};

/// Expanded uncertainties with k = 2 that are ties at two significant digits, or are so but for
/// noise in the last bits, and what a half away from zero makes of them by hand.
const TIES: [(&str, &str); 13] = [
    ("0.125", "0.13"),
    ("0.12499999999999999", "0.13"),
    ("0.375", "0.38"),
    ("1.25e-7", "1.3e-7"),
    ("99.5", "100"),
    ("0.9995", "1.0"),
    ("2.5", "2.5"),
    ("0.0205", "0.021"),
    ("9.95", "10"),
    ("0.445", "0.45"),
    ("1150", "1200"),
    ("6.45e8", "650000000"),
    ("6.45e10", "6.5e10"),
];

/// A folder with a model `y = x` whose expanded uncertainty is known, and a certificate of it.
fn folder(expanded: &str) -> tempfile::TempDir {
    let folder = tempfile::tempdir().expect("a folder");
    let settings = r#""coverage_factor": 2, "coverage_factor_fixed": true,
        "monte_carlo": {"trials": 0}"#;
    let model = format!(
        r#"{{{settings}, "equations": {{"y": "x"}}, "outputs": {{"y": {{"unit": "m"}}}},
        "inputs": {{"x": {{"unit": "m", "distribution": "normal", "mean": 0,
        "expanded": {expanded}, "k": 2}}}}}}"#
    );
    fs::write(folder.path().join("model.json"), model).expect("written");
    // with all that a digital certificate needs
    let path = root().join("models/certificates/three_axis_accelerometer.json");
    let text = fs::read_to_string(path).expect("the worked day");
    let mut certificate: Value = serde_json::from_str(&text).expect("JSON");
    for (key, value) in [
        ("coverage_factor_fixed", json!(true)),
        ("rounding", json!("nearest")),
        ("language", json!("en")),
        ("monte_carlo", json!({"trials": 0})),
        ("rows", json!([{"model": "model.json", "output": "y"}])),
    ] {
        certificate[key] = value;
    }
    // which the model here has none of
    certificate.as_object_mut().expect("an object").remove("conditions");
    fs::write(folder.path().join("certificate.json"), certificate.to_string()).expect("written");
    folder
}

fn answer(folder: &Path, command: &str, file: &str, format: &str) -> Vec<u8> {
    let arguments = [command, file, "--format", format, "--quiet"];
    let done = gumption().current_dir(folder).args(arguments).assert().success();
    done.get_output().stdout.clone()
}

fn page(folder: &Path, command: &str, file: &str, format: &str) -> String {
    String::from_utf8(answer(folder, command, file, format)).expect("UTF-8")
}

/// The text with one blank where there are several.
fn squeezed(text: &str) -> String {
    text.split(' ').filter(|word| !word.is_empty()).collect::<Vec<_>>().join(" ")
}

/// A number in the notation of print: `1.3 × 10⁻⁷`.
fn printed(text: &str) -> String {
    let Some((digits, power)) = text.split_once('e') else { return text.to_owned() };
    let raised = |letter: char| match letter {
        '-' => '⁻',
        digit => ['⁰', '¹', '²', '³', '⁴', '⁵', '⁶', '⁷', '⁸', '⁹'][digit as usize - '0' as usize],
    };
    format!("{digits}\u{202f}×\u{202f}10{}", power.chars().map(raised).collect::<String>())
}

/// What `run` and `certificate` print for U in every format of text.
fn assert_pages(folder: &Path, u: f64, text: &str) {
    let run = |format| page(folder, "run", "model.json", format);
    let arguments = ["run", "model.json", "--full", "--quiet"];
    let full = gumption().current_dir(folder).args(arguments).assert().success();
    let table = String::from_utf8_lossy(&full.get_output().stdout).into_owned();
    let line = table.lines().find(|line| line.starts_with("expanded uncertainty"));
    let words: Vec<&str> = line.expect("a line").split_whitespace().collect();
    assert_eq!(words, ["expanded", "uncertainty", text, "m"]);
    for (format, sign) in [("markdown", "±"), ("html", "±"), ("latex", "$\\pm$")] {
        let shown = if format == "latex" { text.to_owned() } else { printed(text) };
        let result = format!(" {sign} {shown}) m, k = 2.00");
        assert!(run(format).contains(&result), "run, {format}: {result}");
    }
    // in full, for programs and spreadsheets
    let found: Value = serde_json::from_str(&run("json")).expect("JSON");
    assert_eq!(found["outputs"]["y"]["gum"]["expanded_uncertainty"].as_f64(), Some(u));
    let csv = run("csv");
    let cells: Vec<&str> = csv.lines().nth(1).expect("a line").split(',').collect();
    assert_eq!(cells[6].parse(), Ok(u));

    let certificate = |format| page(folder, "certificate", "certificate.json", format);
    let found: Value = serde_json::from_str(&certificate("json")).expect("JSON");
    let row = &found["rows"][0];
    assert_eq!(row["expanded_uncertainty"].as_f64(), Some(u));
    assert_eq!(row["stated"]["expanded_uncertainty"], text);
    let y = row["stated"]["value"].as_str().expect("the value");
    let cells = [
        ("table", format!("  {y}  {text}  m ")),
        ("markdown", format!(" {} | {} | m ", printed(y), printed(text))),
        (
            "html",
            format!(
                r#"<td class="number">{}</td><td class="number">{}</td>"#,
                printed(y),
                printed(text)
            ),
        ),
        ("latex", format!("{y} & {text} & \\unit{{\\metre}}")),
        ("csv", format!(",{y},{text},m,2.00,")),
        ("dcc", format!("<si:uncertaintyXMLList>{text}</si:uncertaintyXMLList>")),
    ];
    for (format, cell) in cells {
        let page = certificate(format);
        // columns may be wider
        assert!(
            squeezed(&page).contains(&squeezed(&cell)),
            "certificate, {format}: {cell}\n{page}"
        );
    }
}

/// The part of a workbook.
fn part(bytes: &[u8], name: &str) -> String {
    let mut archive = zip::ZipArchive::new(Cursor::new(bytes)).expect("a workbook");
    let mut text = String::new();
    archive.by_name(name).expect(name).read_to_string(&mut text).expect("UTF-8");
    text
}

/// The number of a cell and the number format that it is shown with.
fn shown(bytes: &[u8], sheet: &str, cell: &str) -> (f64, String) {
    let text = part(bytes, sheet);
    let sheet = roxmltree::Document::parse(&text).expect("XML");
    let cell = sheet.descendants().find(|node| node.attribute("r") == Some(cell)).expect("a cell");
    let value = cell.children().find(|node| node.has_tag_name(node_name(node, "v")));
    let value = value.and_then(|node| node.text()).expect("a number");
    let style: usize = cell.attribute("s").expect("a style").parse().expect("a number");
    let text = part(bytes, "xl/styles.xml");
    let styles = roxmltree::Document::parse(&text).expect("XML");
    let of = |tag: &str| styles.descendants().find(|node| node.tag_name().name() == tag);
    let style = of("cellXfs").and_then(|all| all.children().nth(style)).expect("its style");
    let id = style.attribute("numFmtId").expect("its format");
    let mut formats = styles.descendants().filter(|node| node.tag_name().name() == "numFmt");
    let format = formats.find(|node| node.attribute("numFmtId") == Some(id));
    let code = format.and_then(|node| node.attribute("formatCode")).unwrap_or("0");
    (value.parse().expect("a number"), code.to_owned())
}

fn node_name<'a>(node: &roxmltree::Node<'a, 'a>, name: &'a str) -> roxmltree::ExpandedName<'a, 'a> {
    match node.tag_name().namespace() {
        Some(namespace) => (namespace, name).into(),
        None => name.into(),
    }
}

/// How many decimals a number or a number format has, without an exponent.
fn decimals(text: &str) -> i32 {
    let (mantissa, exponent) = text.split_once('e').unwrap_or((text, "0"));
    let decimals = mantissa.split_once('.').map_or(0, |(_, decimals)| decimals.len() as i32);
    (decimals - exponent.parse::<i32>().expect("an exponent")).max(0)
}

/// A spreadsheet rounds a half away from zero too, so that it shows U as the pages do if the cell
/// has the number and a format with as many decimals (it shows tens and hundreds in full). The
/// certificate's cell is rounded already.
fn assert_workbooks(folder: &Path, u: f64, text: &str) {
    let bytes = answer(folder, "run", "model.json", "xlsx");
    let mut book: Xlsx<_> = Xlsx::new(Cursor::new(bytes.as_slice())).expect("a workbook");
    let (index, name) = book
        .sheet_names()
        .into_iter()
        .enumerate()
        .find(|(_, name)| name.starts_with("Budget"))
        .expect("a budget");
    let cells = book.worksheet_range(&name).expect("a sheet");
    let (first, _) = cells.start().expect("cells");
    let row = cells.rows().position(|row| row[0] == *"expanded uncertainty U").expect("a row");
    let cell = format!("B{}", first as usize + row + 1);
    let (value, format) = shown(&bytes, &format!("xl/worksheets/sheet{}.xml", index + 1), &cell);
    assert_eq!(value, u);
    assert_eq!(decimals(&format), decimals(text), "{format} for {text}");

    let bytes = answer(folder, "certificate", "certificate.json", "xlsx");
    let mut book: Xlsx<_> = Xlsx::new(Cursor::new(bytes)).expect("a workbook");
    let (_, cells) = book.worksheets().into_iter().next().expect("a sheet");
    let header = cells.rows().position(|row| row.iter().any(|cell| *cell == *"U")).expect("U");
    let rows: Vec<&[Data]> = cells.rows().collect();
    let column = rows[header].iter().position(|cell| *cell == *"U").expect("U");
    assert_eq!(rows[header + 1][column], Data::Float(text.parse().expect("a number")));
}

#[test]
fn run_and_certificate_state_one_expanded_uncertainty_in_every_format() {
    for (u, text) in TIES {
        let folder = folder(u);
        let value: f64 = u.parse().expect("a number");
        // U is 2 times the half of it, exactly
        assert_pages(folder.path(), value, text);
        assert_workbooks(folder.path(), value, text);
    }
}
