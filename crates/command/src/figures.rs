//! The figures of a Markdown or LaTeX page as files beside it.
//!
//! They are written with the page: all of them, or none. Their number is known only when the page is
//! made, so before that only names are checked.

use std::ffi::OsStr;
use std::io;
use std::path::{Path, PathBuf};

use clap::ValueEnum;

use super::Failure;
use super::options::AnswerOptions;
use super::output::{self, AnswerPlace, Destination, Identity, folder_of, shown};
use gumption_report::{FigureNames, with_figures};

/// Maximum number of figures beside a page: each is an open file until all are complete.
const MOST: usize = 200;

/// Formats of pages with figures beside them, and the extension of the figures.
const FORMATS: [(&str, &str); 2] = [("markdown", "svg"), ("latex", "pdf")];

/// The extension of the figures beside a page of a format; `None` for other formats.
fn extension<F: ValueEnum + Send + Sync>(format: &F) -> Option<&'static str> {
    let format = format.to_possible_value()?;
    let found = FORMATS.iter().find(|(name, _)| *name == format.get_name());
    found.map(|(_, extension)| *extension)
}

impl<F: ValueEnum + Send + Sync + 'static> AnswerOptions<F> {
    /// Whether the figures of the answer are files beside it.
    pub(super) fn has_figures_beside(&self) -> bool {
        self.is_to_file() && extension(&self.format).is_some()
    }

    /// Checks that no figure would replace one of these files: inputs, or other output.
    pub(super) fn check_figures(&self, taken: &[PathBuf]) -> Result<(), Failure> {
        let page = output::to_file(self.output.as_deref());
        let Some((page, extension)) = page.zip(extension(&self.format)) else { return Ok(()) };
        let names = names(page, extension);
        let folder = Identity::of(folder_of(page));
        let existing = std::fs::read_dir(folder_of(page)).into_iter().flatten().flatten();
        let figures: Vec<PathBuf> = existing
            .map(|entry| entry.path())
            .filter(|path| path.file_name().is_some_and(|name| is_figure(&names, name)))
            .collect();
        let is_replaced = |path: &&PathBuf| {
            let named = path.file_name().is_some_and(|name| is_figure(&names, name))
                && Identity::of(folder_of(path)) == folder;
            let same = |figure: &PathBuf| {
                Identity::of(figure).is_some_and(|figure| Identity::of(path) == Some(figure))
            };
            named || figures.iter().any(same)
        };
        match taken.iter().find(is_replaced) {
            None => Ok(()),
            Some(path) => Err(Failure::Argument(format!(
                "a figure beside `{}` would have the name of `{}`; give the page another name",
                shown(page),
                shown(path)
            ))),
        }
    }

    /// Writes a page, and its figures beside it if it is a Markdown or LaTeX file.
    pub(super) fn write_page(
        &self,
        place: AnswerPlace,
        make: impl FnOnce() -> String,
    ) -> Result<(), Failure> {
        let Some(extension) = extension(&self.format) else { return place.write(&make()) };
        let page = match place {
            AnswerPlace::File(page) if page.is_regular() => page,
            place => {
                let made = with_figures(None, make);
                if made.left_out > 0 {
                    self.note(["without figures; `--output FILE` writes them beside FILE"]);
                }
                return place.write(&made.page);
            }
        };
        let names = names(page.path(), extension);
        let folder = folder_of(page.path()).to_owned();
        let made = with_figures(Some(names.clone()), make);
        if made.left_out > 0 {
            self.note([format!(
                "the first {MOST} figures are written beside the page; {} further ones are left out",
                made.left_out
            )]);
        }
        let mut files = vec![(page, made.page.into_bytes())];
        for (number, figure) in (1..).zip(&made.figures) {
            let file = Destination::open(&folder.join(names.name(number)))?;
            let bytes = if extension == "pdf" { pdf(figure)? } else { figure.clone().into_bytes() };
            files.push((file, bytes));
        }
        write_together(files.into_iter())
    }
}

/// The names of the figures beside a page: that of the page, with a hyphen for each character that
/// needs quoting in Markdown or LaTeX.
fn names(page: &Path, extension: &'static str) -> FigureNames {
    let stem = page.file_stem().unwrap_or_default().to_string_lossy();
    let plain = |letter: char| letter.is_alphanumeric() || matches!(letter, '-' | '_' | '.' | '+');
    let stem = stem.chars().map(|letter| if plain(letter) { letter } else { '-' }).collect();
    FigureNames { stem, extension, most: MOST }
}

/// Whether a file has the name of a figure.
fn is_figure(names: &FigureNames, file: &OsStr) -> bool {
    let file = file.to_string_lossy();
    let number = file
        .strip_prefix(names.stem.as_str())
        .and_then(|rest| rest.strip_prefix('-'))
        .and_then(|rest| rest.strip_suffix(names.extension))
        .and_then(|rest| rest.strip_suffix('.'));
    number.is_some_and(|number| !number.is_empty() && number.bytes().all(|b| b.is_ascii_digit()))
}

/// Writes files together: none gets its name before all are complete, and the first gets it last.
fn write_together(mut files: impl Iterator<Item = (Destination, Vec<u8>)>) -> Result<(), Failure> {
    let Some((file, bytes)) = files.next() else { return Ok(()) };
    let mut failed = None;
    let written = file.write_with(|out| {
        out.write_all(&bytes)?;
        out.flush()?;
        write_together_within(&mut files).map_err(|failure| {
            failed = Some(failure);
            io::Error::other("another file of the page failed")
        })?;
        Ok(true)
    });
    failed.map_or(written, Err)
}

/// The same behind a type that does not grow with each file.
fn write_together_within(
    files: &mut dyn Iterator<Item = (Destination, Vec<u8>)>,
) -> Result<(), Failure> {
    write_together(files)
}

/// A figure as a PDF file with its fonts.
#[cfg(not(target_family = "wasm"))]
fn pdf(figure: &str) -> Result<Vec<u8>, Failure> {
    use svg2pdf::usvg::{Options, Tree};
    use svg2pdf::{ConversionOptions, PageOptions, to_pdf};

    let mut options = Options::default();
    let fonts = options.fontdb_mut();
    for font in FONTS {
        fonts.load_font_data(font.to_vec());
    }
    fonts.set_sans_serif_family("DejaVu Sans");
    // other fonts take time to find
    if !figure.chars().all(has_glyph) {
        fonts.load_system_fonts();
    }
    let failed = |reason: String| Failure::System(format!("cannot draw a figure as PDF: {reason}"));
    let tree = Tree::from_str(figure, &options).map_err(|error| failed(error.to_string()))?;
    to_pdf(&tree, ConversionOptions::default(), PageOptions::default())
        .map_err(|error| failed(error.to_string()))
}

/// In a browser there are no files beside a page.
#[cfg(target_family = "wasm")]
fn pdf(_figure: &str) -> Result<Vec<u8>, Failure> {
    Err(Failure::System("a browser writes no PDF files".to_owned()))
}

/// DejaVu Sans and its bold face, reduced to the characters of figures (`fonts/LICENSE`).
#[cfg(not(target_family = "wasm"))]
const FONTS: [&[u8]; 2] =
    [include_bytes!("../fonts/DejaVuSans.ttf"), include_bytes!("../fonts/DejaVuSans-Bold.ttf")];

/// Whether the reduced font has a character.
#[cfg(not(target_family = "wasm"))]
fn has_glyph(letter: char) -> bool {
    matches!(letter,
        '\n' | ' '..='~' | '\u{a0}'..='\u{24f}' | '\u{370}'..='\u{3ff}' | '\u{400}'..='\u{45f}'
        | '\u{2010}'..='\u{2027}' | '\u{202f}'..='\u{203a}' | '\u{2070}'..='\u{209c}'
        | '\u{2190}'..='\u{2199}' | '\u{2200}'..='\u{22a5}')
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn figures_have_names_without_markup() {
        let names = names(Path::new("out/page (2) of_3.tex"), "pdf");
        assert_eq!(names.name(12), "page--2--of_3-12.pdf");
        let is = |name: &str| is_figure(&names, OsStr::new(name));
        assert!(is("page--2--of_3-7.pdf"));
        assert!(!is("page--2--of_3-.pdf") && !is("page--2--of_3-7.svg") && !is("page-7.pdf"));
    }

    /// A PDF file has text of the embedded font, with superscripts and Greek letters.
    #[test]
    fn a_figure_becomes_a_pdf_file() {
        let figure = "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"90\" height=\"30\">\
                      <text x=\"5\" y=\"20\" font-family=\"sans-serif\">5 × 10⁻⁷ Ω</text></svg>";
        let made = pdf(figure).unwrap();
        assert!(made.starts_with(b"%PDF-"));
        let text = String::from_utf8_lossy(&made);
        assert!(text.contains("DejaVuSans"), "{text}");
        let broken = pdf("<svg").unwrap_err().to_string();
        assert!(broken.contains("cannot draw a figure as PDF"), "{broken}");
    }
}
