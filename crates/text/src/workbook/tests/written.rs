//! Workbooks that tests write; those of other crates take this file by its path.

use std::io::{Cursor, Write};

/// The parts of a workbook beside its sheets.
pub(super) const PARTS: [(&str, &str); 4] = [
    (
        "[Content_Types].xml",
        r#"<Types xmlns="http://schemas.openxmlformats.org/package/2006/content-types"/>"#,
    ),
    (
        "_rels/.rels",
        r#"<Relationships xmlns="http://schemas.openxmlformats.org/package/2006/relationships"><Relationship Id="r1" Type="http://schemas.openxmlformats.org/officeDocument/2006/relationships/officeDocument" Target="xl/workbook.xml"/></Relationships>"#,
    ),
    (
        "xl/workbook.xml",
        r#"<workbook xmlns="http://schemas.openxmlformats.org/spreadsheetml/2006/main" xmlns:r="http://schemas.openxmlformats.org/officeDocument/2006/relationships"><sheets><sheet name="a" sheetId="1" r:id="r1"/></sheets></workbook>"#,
    ),
    (
        "xl/_rels/workbook.xml.rels",
        r#"<Relationships xmlns="http://schemas.openxmlformats.org/package/2006/relationships"><Relationship Id="r1" Type="http://schemas.openxmlformats.org/officeDocument/2006/relationships/worksheet" Target="worksheets/sheet1.xml"/><Relationship Id="r2" Type="http://schemas.openxmlformats.org/officeDocument/2006/relationships/sharedStrings" Target="sharedStrings.xml"/></Relationships>"#,
    ),
];

/// A workbook of sheets with their names and whether they are hidden; a cell may begin with the number of
/// its style and a colon: 1 shows a date, 2 two decimals, 3 is struck through.
pub(crate) fn sheets(all: &[(&str, bool, &[&[&str]])]) -> Vec<u8> {
    const SPACE: &str = "http://schemas.openxmlformats.org/spreadsheetml/2006/main";
    const RELATIONS: &str = "http://schemas.openxmlformats.org/officeDocument/2006/relationships";
    let mut zip = zip::ZipWriter::new(Cursor::new(Vec::new()));
    let options = zip::write::SimpleFileOptions::default();
    let mut part = |name: &str, text: &str| {
        zip.start_file(name, options).unwrap();
        zip.write_all(text.as_bytes()).unwrap();
    };
    let relation = |id: &str, kind: &str, target: &str| {
        format!(r#"<Relationship Id="{id}" Type="{RELATIONS}/{kind}" Target="{target}"/>"#)
    };
    let mut relations = relation("styles", "styles", "styles.xml");
    let mut names = String::new();
    for (number, (name, is_hidden, rows)) in all.iter().enumerate() {
        let (id, target) = (format!("r{number}"), format!("worksheets/sheet{number}.xml"));
        relations += &relation(&id, "worksheet", &target);
        let state = if *is_hidden { "hidden" } else { "visible" };
        let place = number + 1;
        names +=
            &format!(r#"<sheet name="{name}" sheetId="{place}" state="{state}" r:id="{id}"/>"#);
        let cell = |cell: &&str| {
            let styled = cell.split_once(':').filter(|(style, _)| style.len() == 1);
            let (style, text) = styled.unwrap_or(("0", cell));
            match text.parse::<f64>() {
                Ok(_) => format!(r#"<c s="{style}"><v>{text}</v></c>"#),
                Err(_) => format!(r#"<c s="{style}" t="inlineStr"><is><t>{text}</t></is></c>"#),
            }
        };
        let rows = rows
            .iter()
            .map(|row| format!("<row>{}</row>", row.iter().map(cell).collect::<String>()));
        let rows: String = rows.collect();
        let sheet =
            format!(r#"<worksheet xmlns="{SPACE}"><sheetData>{rows}</sheetData></worksheet>"#);
        part(&format!("xl/{target}"), &sheet);
    }
    for (name, text) in &PARTS[..2] {
        part(name, text);
    }
    let book = format!(
        r#"<workbook xmlns="{SPACE}" xmlns:r="{RELATIONS}"><sheets>{names}</sheets></workbook>"#
    );
    part("xl/workbook.xml", &book);
    let space = "http://schemas.openxmlformats.org/package/2006/relationships";
    let relations = format!(r#"<Relationships xmlns="{space}">{relations}</Relationships>"#);
    part("xl/_rels/workbook.xml.rels", &relations);
    let fonts = "<fonts><font/><font><strike/></font></fonts>";
    let styles: String = [(0, 0), (14, 0), (2, 0), (0, 1)]
        .map(|(format, font)| format!(r#"<xf numFmtId="{format}" fontId="{font}"/>"#))
        .concat();
    let styles =
        format!(r#"<styleSheet xmlns="{SPACE}">{fonts}<cellXfs>{styles}</cellXfs></styleSheet>"#);
    part("xl/styles.xml", &styles);
    zip.finish().unwrap().into_inner()
}
