//! A document as a LaTeX file that a plain TeX Live compiles: `article`, tables by `booktabs`,
//! numbers and units by `siunitx`.

mod equation;
mod text;
pub(super) mod unit;

pub use equation::equation_latex;

use super::beside::{FigureBeside, beside};
use super::{Block, Document, FootPart, Head};
use crate::sheet::{ColumnKind, Sheet, SheetColumn};
use gumption_analysis::certificate::contents::{Picture, PictureFormat};
use text::escaped;

/// Maximum number of rows of a table that is kept on one page.
const LONG: usize = 12;

/// Number of letters above which a text column becomes a paragraph with this width, or more if the
/// line has room.
const PARAGRAPH: usize = 30;

/// Width of a letter at the usual size of tables, in millimetres.
const LETTER: f64 = 1.65;

/// Maximum number of letters in a line for each text size of a table.
const SIZES: [(usize, &str); 3] = [(98, "\\small"), (116, "\\footnotesize"), (136, "\\scriptsize")];

/// Numbers with a decimal comma.
const COMMA: &str = ",output-decimal-marker={,}";

/// A page style that names the document and the page number. Packages for this are not in every TeX
/// Live.
fn foot(document: &Document) -> String {
    let foot = document.foot();
    let page = foot.parts().into_iter().map(|part| match part {
        FootPart::Text(text) => spaced(text),
        FootPart::Page => "\\thepage{}".to_owned(),
        FootPart::Pages => "\\pageref{end}".to_owned(),
    });
    let page: String = page.collect();
    format!(
        "\\makeatletter\n\\def\\ps@foot{{\\def\\@oddhead{{}}\\let\\@evenhead\\@oddhead\n  \
         \\def\\@oddfoot{{\\footnotesize\\parbox[t]{{0.75\\textwidth}}{{\\raggedright {}}}\\hfil {page}}}\
         \\let\\@evenfoot\\@oddfoot}}\n\\makeatother\n\\pagestyle{{foot}}",
        escaped(&foot.about)
    )
}

/// A text that keeps the spaces at its ends.
fn spaced(text: &str) -> String {
    let end = |is: bool| if is { " " } else { "" };
    format!("{}{}{}", end(text.starts_with(' ')), escaped(text), end(text.ends_with(' ')))
}

/// The whole document, ending in a newline.
pub(crate) fn latex(document: &Document) -> String {
    let mut units = unit::Declared::default();
    let body = document.written(|part| block(part, &mut units));
    let subtitle: Vec<String> = document.subtitle.iter().map(|line| escaped(line)).collect();
    let mut parts = vec![
        "\\documentclass[10pt,a4paper]{article}".to_owned(),
        "\\usepackage[utf8]{inputenc}".to_owned(),
        "\\usepackage[margin=18mm]{geometry}".to_owned(),
        "\\usepackage{array,longtable,booktabs,siunitx}".to_owned(),
    ];
    if document.head.is_some() || body.iter().any(|part| part.contains(INCLUDED)) {
        parts.push("\\usepackage{graphicx}".to_owned());
    }
    parts.extend(units.lines());
    parts.extend([
        format!(
            "\\sisetup{{table-align-exponent=false{}}}",
            if document.comma { COMMA } else { "" }
        ),
        "\\setlength{\\parindent}{0pt}".to_owned(),
        "\\setlength{\\parskip}{0.6ex plus 0.2ex}".to_owned(),
        "\\setlength{\\LTleft}{0pt}".to_owned(),
        "\\setlength{\\LTpre}{0.6ex}".to_owned(),
        "\\emergencystretch=3em".to_owned(),
        format!("\\title{{{}}}", escaped(&document.title)),
        format!("\\author{{\\normalsize {}}}", subtitle.join(" \\\\ \\normalsize ")),
        "\\date{}".to_owned(),
        foot(document),
        "\\begin{document}".to_owned(),
        title(document, &subtitle),
        "\\thispagestyle{foot}".to_owned(),
        String::new(),
    ]);
    parts.join("\n") + "\n" + &body.join("\n\n") + "\n\n\\label{end}\n\\end{document}\n"
}

/// The title of the document, below its head.
fn title(document: &Document, subtitle: &[String]) -> String {
    let Some(of) = &document.head else { return "\\maketitle".to_owned() };
    let lines: String = subtitle.iter().map(|line| format!("{line}\\par\n")).collect();
    // `\maketitle` begins a page of its own below other text
    format!("{}\n\n{{\\LARGE {}\\par}}\n{lines}\\medskip", head(of), escaped(&document.title))
}

/// The head in LaTeX. The pictures are files beside the document, an SVG as a PDF of the same
/// name; where a file is missing the document compiles without it.
fn head(of: &Head) -> String {
    let picture = |picture: &Option<Picture>| {
        let name = picture.as_ref().map(file_beside);
        name.map_or_else(String::new, |name| {
            format!(
                "\\IfFileExists{{{name}}}{{\\includegraphics[height=16mm,width=40mm,\
                 keepaspectratio]{{{name}}}}}{{}}"
            )
        })
    };
    let lines = |lines: &[String]| {
        lines.iter().map(|line| escaped(line)).collect::<Vec<_>>().join(" \\\\ ")
    };
    format!(
        "\\noindent\\begin{{minipage}}[c]{{42mm}}{}\\end{{minipage}}\\hfill\n\
         \\begin{{minipage}}[c]{{76mm}}\\raggedright {}\\end{{minipage}}\\hfill\n\
         \\begin{{minipage}}[c]{{42mm}}\\raggedleft {}\\\\ \\footnotesize {}\\end{{minipage}}\n\n\
         \\medskip\\hrule\\medskip",
        picture(&of.logo),
        lines(&of.lines),
        picture(&of.mark),
        lines(&of.below_mark),
    )
}

/// The name of the file that LaTeX reads, without its folders.
fn file_beside(picture: &Picture) -> String {
    let name = picture.name.rsplit(['/', '\\']).next().unwrap_or(&picture.name);
    let stem = name.rsplit_once('.').map_or(name, |(stem, _)| stem);
    match picture.format {
        PictureFormat::Png => name.to_owned(),
        PictureFormat::Svg => format!("{stem}.pdf"),
    }
}

fn block(block: &Block, units: &mut unit::Declared) -> String {
    match block {
        Block::Section(title) => format!("\\section*{{{}}}", escaped(title)),
        Block::Text(text) => escaped(text),
        Block::InLanguage(_, part) => self::block(part, units),
        Block::Verdict(sentences) => {
            let stressed = |(place, sentence): (usize, &String)| {
                let sentence = escaped(sentence);
                if place == 0 { format!("\\textbf{{{sentence}}}") } else { sentence }
            };
            let lines: Vec<String> = sentences.iter().enumerate().map(stressed).collect();
            format!("\\begin{{quote}}\n{}\n\\end{{quote}}", lines.join("\n\n"))
        }
        Block::List(items) => {
            let items: Vec<String> =
                items.iter().map(|item| format!("\\item {}", escaped(item))).collect();
            format!("\\begin{{itemize}}\n{}\n\\end{{itemize}}", items.join("\n"))
        }
        Block::Table(sheet) => table(sheet, units),
        Block::Figure(drawing) => beside(drawing).map_or_else(String::new, |of| figure(&of)),
        Block::Characters(_) => String::new(),
        Block::Folded(title, blocks) => {
            let blocks: Vec<String> = blocks.iter().map(|part| self::block(part, units)).collect();
            format!("{}:\n\n{}", escaped(title), blocks.join("\n\n"))
        }
        Block::Signature(places) => {
            let line = |place: &String| {
                format!("\\parbox[t]{{70mm}}{{\\rule{{70mm}}{{0.4pt}}\\\\{}}}", escaped(place))
            };
            let lines: Vec<String> = places.iter().map(line).collect();
            format!("\\nopagebreak\\vspace{{18mm}}\n{}", lines.join("\\hfill\n"))
        }
        Block::End(text) => format!("\\begin{{center}}--- {} ---\\end{{center}}", escaped(text)),
        Block::Listing { about, text } => {
            let lines: Vec<String> = text.lines().map(listed).collect();
            format!(
                "{}\n\n{{\\ttfamily\\scriptsize\\raggedright\n{}\\par}}",
                escaped(about),
                lines.join("\\\\\n")
            )
        }
    }
}

/// A line of a listing with its indentation.
fn listed(line: &str) -> String {
    let text = line.trim_start();
    let spaces = line.chars().count() - text.chars().count();
    format!("\\hspace*{{{}em}}{}\\strut", 0.5 * spaces as f64, escaped(text))
}

/// How LaTeX includes a picture.
const INCLUDED: &str = "\\includegraphics";

/// A figure above its caption, on one page. It does not float, so that it stays in its section.
fn figure(of: &FigureBeside<'_>) -> String {
    let FigureBeside { number, name, caption } = of;
    let caption = escaped(caption);
    format!(
        "\\medskip\n\\noindent\\begin{{minipage}}{{\\linewidth}}\n\
         {INCLUDED}[width=\\linewidth]{{{name}}}\n\n\
         \\small \\textbf{{Figure {number}.}} {caption}\n\\end{{minipage}}\n\\medskip"
    )
}

fn table(sheet: &Sheet, units: &mut unit::Declared) -> String {
    let widths = widths(sheet);
    let letters = widths.iter().sum::<usize>() + 2 * widths.len().saturating_sub(1);
    let size = SIZES.iter().find(|(most, _)| letters <= *most).map_or("\\tiny", |(_, size)| size);
    let columns: Vec<String> =
        sheet.columns.iter().zip(&widths).map(|(column, width)| form(column, *width)).collect();
    let line = |cells: Vec<String>| cells.join(" & ") + " \\\\";
    let header = match sheet.has_headers() {
        true => format!("{}\n\\midrule\n", line(sheet.columns.iter().map(header).collect())),
        false => String::new(),
    };
    let mut rows: Vec<String> = (0..sheet.rows())
        .map(|row| line(sheet.columns.iter().map(|column| cell(column, row, units)).collect()))
        .collect();
    if sheet.footer && rows.len() > 1 {
        rows.insert(rows.len() - 1, "\\midrule".to_owned());
    }
    let form = format!("@{{}}{}@{{}}", columns.join(""));
    let rows = rows.join("\n");
    if sheet.rows() > LONG {
        format!(
            "{{{size}\n\\begin{{longtable}}{{{form}}}\n\\toprule\n{header}\\endhead\n\
             \\bottomrule\n\\endfoot\n{rows}\n\\end{{longtable}}}}"
        )
    } else {
        format!(
            "\\medskip\n{{{size}\n\\begin{{tabular}}{{{form}}}\n\\toprule\n{header}{rows}\n\
             \\bottomrule\n\\end{{tabular}}\\par}}\n\\medskip"
        )
    }
}

/// Width of each column in letters: as needed, and for paragraphs the remaining width.
fn widths(sheet: &Sheet) -> Vec<usize> {
    let mut widths: Vec<usize> = sheet.columns.iter().map(width).collect();
    let longest = |column: &SheetColumn| column.cells.iter().map(|cell| cell.chars().count()).max();
    let longest: Vec<usize> =
        sheet.columns.iter().map(|column| longest(column).unwrap_or(0)).collect();
    let is_cut =
        |place: usize, width: usize| sheet.columns[place].wraps() && longest[place] > width;
    let gaps = 2 * widths.len().saturating_sub(1);
    let used = widths.iter().sum::<usize>() + gaps;
    let cut = widths.iter().enumerate().filter(|(place, width)| is_cut(*place, **width)).count();
    let room = SIZES[0].0.saturating_sub(used).checked_div(cut).unwrap_or(0);
    for (place, width) in widths.iter_mut().enumerate() {
        if is_cut(place, *width) {
            *width = longest[place].min(*width + room);
        }
    }
    widths
}

/// Letters that a column needs.
fn width(column: &SheetColumn) -> usize {
    let lines = column.header.lines().chain(column.cells.iter().map(String::as_str));
    let longest = lines.map(|line| line.chars().count()).max().unwrap_or(0);
    if !column.wraps() {
        return longest;
    }
    // a longer word cannot be broken
    let words = column.cells.iter().flat_map(|cell| cell.split_whitespace());
    let word = words.map(|word| word.chars().count()).max().unwrap_or(0);
    longest.min(PARAGRAPH.max(word))
}

/// The form of a column.
fn form(column: &SheetColumn, width: usize) -> String {
    match column.kind {
        ColumnKind::Numbers => number_format(column),
        ColumnKind::Units => "l".to_owned(),
        ColumnKind::Text | ColumnKind::Equations
            if column.cells.iter().any(|cell| cell.chars().count() > width) =>
        {
            let millimetres = (LETTER * width as f64).round();
            format!(">{{\\raggedright\\arraybackslash}}p{{{millimetres}mm}}")
        }
        ColumnKind::Text | ColumnKind::Equations => "l".to_owned(),
    }
}

/// The number of digits that a column of numbers reserves.
fn number_format(column: &SheetColumn) -> String {
    let (mut whole, mut decimals, mut power) = (1, 0, None::<usize>);
    let (mut signed, mut power_signed) = (false, false);
    for cell in column.cells.iter().filter(|cell| is_number(cell)) {
        let (mantissa, exponent) = cell.split_once('e').unwrap_or((cell, ""));
        let (before, after) = mantissa.split_once('.').unwrap_or((mantissa, ""));
        signed |= before.starts_with('-');
        whole = whole.max(before.trim_start_matches('-').len());
        decimals = decimals.max(after.len());
        if !exponent.is_empty() {
            power_signed |= exponent.starts_with('-');
            power = power.max(Some(exponent.trim_start_matches('-').len()));
        }
    }
    let sign = |negative: bool| if negative { "-" } else { "" };
    let power = power.map(|digits| format!("e{}{}", sign(power_signed), "1".repeat(digits).len()));
    let (sign, power) = (sign(signed), power.unwrap_or_default());
    format!("S[table-format={sign}{whole}.{decimals}{power}]")
}

/// Whether `siunitx` reads a cell as a number.
fn is_number(cell: &str) -> bool {
    cell.parse::<f64>().is_ok_and(f64::is_finite) && !cell.starts_with(['+', '.'])
}

fn header(column: &SheetColumn) -> String {
    let lines: Vec<String> = column.header.lines().map(escaped).collect();
    let side = if column.is_numeric() { "r" } else { "l" };
    match lines.as_slice() {
        [] => "{}".to_owned(),
        [line] => format!("{{{line}}}"),
        lines => format!("{{\\shortstack[{side}]{{{}}}}}", lines.join(" \\\\ ")),
    }
}

fn cell(column: &SheetColumn, row: usize, units: &mut unit::Declared) -> String {
    let text = column.cell(row);
    match column.kind {
        ColumnKind::Text => escaped(text),
        ColumnKind::Equations => equation::equation(text),
        ColumnKind::Units if text.trim().is_empty() => String::new(),
        ColumnKind::Units => units.unit(text),
        ColumnKind::Numbers if is_number(text) => text.to_owned(),
        ColumnKind::Numbers if text.is_empty() => String::new(),
        ColumnKind::Numbers => format!("{{{}}}", escaped(text)),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_reserve_their_digits() {
        let mut sheet = Sheet::default();
        let cells = ["10.05", "-3.1234", "1.2e-17", "-", ""].map(str::to_owned);
        sheet.numbers("standard\nuncertainty", cells);
        sheet.units("unit", ["m/s^2", "psi", "", "%", "1"].map(str::to_owned));
        sheet.text("a_b", ["100 %", "x_1 & y", "", "", ""].map(str::to_owned));
        let mut units = unit::Declared::default();
        insta::assert_snapshot!(table(&sheet, &mut units), @r"
        \medskip
        {\small
        \begin{tabular}{@{}S[table-format=-2.4e-2]ll@{}}
        \toprule
        {\shortstack[r]{standard \\ uncertainty}} & {unit} & {a\_b} \\
        \midrule
        10.05 & \unit{\metre\per\second\squared} & 100 \% \\
        -3.1234 & \unit{\gumptionpsi} & x\_1 \& y \\
        1.2e-17 &  &  \\
        {--} & \unit{\percent} &  \\
         & 1 &  \\
        \bottomrule
        \end{tabular}\par}
        \medskip
        ");
        assert_eq!(units.lines(), [r"\DeclareSIUnit{\gumptionpsi}{psi}"]);
    }
}
