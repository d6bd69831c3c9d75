//! The figures of a Markdown or LaTeX page as files beside it.

use std::cell::RefCell;

use crate::html::Drawing;

/// How the files with figures are named: `page-1.svg`, `page-2.svg`.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct FigureNames {
    /// What the names begin with, without a folder.
    pub stem: String,
    /// What they end with, without the point.
    pub extension: &'static str,
    /// Maximum number of figures; further ones are left out.
    pub most: usize,
}

impl FigureNames {
    /// The name of a figure, counted from 1.
    pub fn name(&self, number: usize) -> String {
        format!("{}-{number}.{}", self.stem, self.extension)
    }
}

/// A page and the figures to which it refers.
#[derive(Clone, Debug)]
pub struct PageWithFigures<R> {
    /// The page.
    pub page: R,
    /// The figures in order, each as an SVG file that needs nothing else.
    pub figures: Vec<String>,
    /// Number of figures that the page does not show.
    pub left_out: usize,
}

/// The figures of the page that is being made.
#[derive(Debug, Default)]
struct Collected {
    names: Option<FigureNames>,
    figures: Vec<String>,
    left_out: usize,
}

thread_local! {
    // a page is made by many functions, and a thread makes one page at a time
    static COLLECTED: RefCell<Option<Collected>> = const { RefCell::new(None) };
}

/// Makes a Markdown or LaTeX page that refers to its figures by these names; without names, and
/// outside this function, pages of these formats have no figures.
pub fn with_figures<R>(names: Option<FigureNames>, make: impl FnOnce() -> R) -> PageWithFigures<R> {
    /// Ends the collection even if `make` panics.
    struct End(Option<Collected>);
    impl Drop for End {
        fn drop(&mut self) {
            COLLECTED.set(self.0.take());
        }
    }
    let end = End(COLLECTED.replace(Some(Collected { names, ..Collected::default() })));
    let page = make();
    let Collected { figures, left_out, .. } = COLLECTED.take().unwrap_or_default();
    drop(end);
    PageWithFigures { page, figures, left_out }
}

/// A figure to which a page refers.
#[derive(Debug)]
pub(super) struct FigureBeside<'d> {
    pub(super) number: usize,
    /// The name of its file.
    pub(super) name: String,
    pub(super) caption: &'d str,
}

/// Adds a figure to those of the page; `None` if the page has none.
pub(super) fn beside(drawing: &Drawing) -> Option<FigureBeside<'_>> {
    COLLECTED.with_borrow_mut(|collected| {
        let collected = collected.as_mut()?;
        let number = collected.figures.len() + 1;
        let Some(names) = collected.names.as_ref().filter(|names| number <= names.most) else {
            collected.left_out += 1;
            return None;
        };
        let name = names.name(number);
        collected.figures.push(drawing.standalone());
        Some(FigureBeside { number, name, caption: drawing.caption() })
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn figure() -> Drawing {
        Drawing::new("Two < three.".to_owned(), |width| format!("<svg width=\"{width}\"></svg>"))
    }

    #[test]
    fn figures_are_numbered_up_to_a_limit() {
        let names = FigureNames { stem: "a".to_owned(), extension: "svg", most: 2 };
        let found = with_figures(Some(names), || {
            let names = [0, 1, 2].map(|_| beside(&figure()).map(|of| of.name));
            assert_eq!(names, [Some("a-1.svg".to_owned()), Some("a-2.svg".to_owned()), None]);
        });
        assert_eq!((found.figures.len(), found.left_out), (2, 1));
        assert!(found.figures[0].contains("<title>Two &lt; three.</title>"));
    }

    #[test]
    fn without_names_they_are_counted() {
        let found = with_figures(None, || assert!(beside(&figure()).is_none()));
        assert_eq!((found.figures.len(), found.left_out), (0, 1));
        assert!(beside(&figure()).is_none());
    }
}
