//! Columns of texts and of numbers whose decimal points stand under each other.

use std::ops::Range;

use comfy_table::{
    Cell, CellAlignment, ColumnConstraint, ContentArrangement, ContentLineStyle, LineStyle, Row,
    Table, TableStyle, Width,
};

use super::{USUAL, width};
use crate::number::align;
use crate::printed;
use crate::sheet::{ColumnKind, Sheet};

/// Spaces between columns.
const GAP: u16 = 2;

const LINE: char = '─';

/// Letters of a word that a narrow column keeps together, at most.
const LONGEST_WORD: usize = 40;

/// Letters that a text keeps on a line, however narrow the page is.
const LEAST_TEXT: usize = 12;

/// Rows below one header. Longer tables begin again with it, so that it stays in sight, and so that
/// no more than this is laid out at a time.
const PAGE: usize = 1000;

/// A table that is filled column by column.
#[derive(Debug, Default)]
pub struct Grid {
    columns: Vec<GridColumn>,
    /// Whether the last row is set off by a line and kept to one line.
    footer: bool,
    /// How many columns tell which row it is; the first one alone if there are none.
    naming: usize,
}

#[derive(Clone, Debug)]
struct GridColumn {
    header: String,
    cells: Vec<String>,
    alignment: CellAlignment,
    constraint: Option<ColumnConstraint>,
    /// Whether it stands behind the others where one table is too wide for all.
    aside: bool,
}

impl GridColumn {
    /// The cell of a row; nothing where it has none.
    fn cell(&self, row: usize) -> &str {
        self.cells.get(row).map_or("", String::as_str)
    }

    /// The width below which words would break.
    fn word_width(&self) -> usize {
        if matches!(self.constraint, Some(ColumnConstraint::ContentWidth)) {
            return self.width();
        }
        let texts = self.header.lines().chain(self.cells.iter().map(String::as_str));
        let words = texts.flat_map(str::split_whitespace);
        words.map(|word| word.chars().count()).max().unwrap_or(0).min(LONGEST_WORD)
    }

    fn width(&self) -> usize {
        let lines = self.header.lines().chain(self.cells.iter().map(String::as_str));
        lines.map(|line| line.chars().count()).max().unwrap_or(0)
    }
}

/// Whether a text is one line of letters of one column each.
fn is_plain(text: &str) -> bool {
    text.bytes().all(|byte| (b' '..=b'~').contains(&byte))
}

impl Grid {
    /// The table of a sheet, with its narrow headers if it is too wide for the page.
    pub(crate) fn of(sheet: &Sheet) -> Self {
        let wide = Self::wide(sheet);
        if wide.natural_width() <= width() { wide } else { Self::headed(sheet, true) }
    }

    /// The table of a sheet with its wide headers.
    pub(crate) fn wide(sheet: &Sheet) -> Self {
        Self::headed(sheet, false)
    }

    fn headed(sheet: &Sheet, is_narrow: bool) -> Self {
        let (columns, footer, naming) = (Vec::new(), sheet.footer, sheet.naming);
        let mut grid = Self { columns, footer, naming };
        for column in &sheet.columns {
            let cells = column.cells.iter().cloned();
            let header = column.narrow.as_ref().filter(|_| is_narrow).unwrap_or(&column.header);
            match column.kind {
                ColumnKind::Numbers => {
                    grid.numbers(header, cells.map(|cell| printed::text(&cell)));
                }
                ColumnKind::Text | ColumnKind::Equations => {
                    grid.text_from(header, LEAST_TEXT, cells)
                }
                ColumnKind::Units => grid.units(header, cells),
            }
            if let Some(last) = grid.columns.last_mut() {
                last.aside = column.aside;
            }
        }
        grid
    }

    /// A column of texts, which wrap if the page is too narrow.
    pub fn text(&mut self, header: &str, cells: impl IntoIterator<Item = String>) {
        self.push(header, cells.into_iter().collect(), CellAlignment::Left, None);
    }

    /// A column of units, which never wrap.
    pub(crate) fn units(&mut self, header: &str, cells: impl IntoIterator<Item = String>) {
        let constraint = Some(ColumnConstraint::ContentWidth);
        self.push(header, cells.into_iter().collect(), CellAlignment::Left, constraint);
    }

    /// A column of texts that wrap only above a width.
    fn text_from(&mut self, header: &str, width: usize, cells: impl IntoIterator<Item = String>) {
        self.text(header, cells);
        if let Some(column) = self.columns.last_mut() {
            let width = width.min(column.width()) as u16;
            column.constraint = Some(ColumnConstraint::LowerBoundary(Width::Fixed(width)));
        }
    }

    /// A column of numbers, which never wrap.
    pub fn numbers(&mut self, header: &str, cells: impl IntoIterator<Item = String>) {
        let cells: Vec<String> = cells.into_iter().collect();
        let constraint = Some(ColumnConstraint::ContentWidth);
        self.push(header, align(&cells), CellAlignment::Right, constraint);
    }

    fn push(
        &mut self,
        header: &str,
        cells: Vec<String>,
        alignment: CellAlignment,
        constraint: Option<ColumnConstraint>,
    ) {
        let (header, aside) = (header.to_owned(), false);
        self.columns.push(GridColumn { header, cells, alignment, constraint, aside });
    }

    /// The width that nothing wraps at.
    pub(crate) fn natural_width(&self) -> usize {
        let gaps = self.columns.len().saturating_sub(1) * usize::from(GAP);
        self.columns.iter().map(GridColumn::width).sum::<usize>() + gaps
    }

    /// The table with its header, ending in a newline.
    pub fn render(&self, width: usize) -> String {
        if self.word_width() > width && self.columns.len() > 2 {
            return self.folded(width);
        }
        self.pages(width)
    }

    fn pages(&self, width: usize) -> String {
        let rows = self.rows();
        let words = self.squeezed_words(width);
        let pages = (0..rows.max(1)).step_by(PAGE).map(|first| first..(first + PAGE).min(rows));
        let pages: Vec<String> =
            pages.map(|page| self.page(width, page, words.as_deref())).collect();
        pages.join("\n")
    }

    /// The least width of each column, where columns are squeezed and words are kept together. It
    /// takes all rows, so it is found once for all pages.
    fn squeezed_words(&self, width: usize) -> Option<Vec<u16>> {
        let squeezed = width < USUAL && self.natural_width() > width;
        let word =
            |column: &GridColumn| u16::try_from(column.word_width()).unwrap_or(u16::MAX - GAP);
        squeezed.then(|| self.columns.iter().map(word).collect())
    }

    /// The width below which words would break.
    fn word_width(&self) -> usize {
        let gaps = self.columns.len().saturating_sub(1) * usize::from(GAP);
        self.columns.iter().map(GridColumn::word_width).sum::<usize>() + gaps
    }

    /// Tables one below the other that begin with the same columns, where one would be too wide.
    fn folded(&self, width: usize) -> String {
        let naming = self.naming.clamp(1, self.columns.len() - 1);
        let room = |naming: usize| {
            let named = self.columns.iter().take(naming);
            named.map(|column| column.word_width() + usize::from(GAP)).sum::<usize>()
        };
        let naming = if 2 * room(naming) > width { 1 } else { naming };
        let (named, rest) = self.columns.split_at(naming);
        let of = |columns: Vec<GridColumn>| Self { columns, footer: self.footer, naming };
        let mut grids = vec![of(named.to_vec())];
        let (others, aside) = rest.iter().partition::<Vec<_>, _>(|column| !column.aside);
        for column in others.into_iter().chain(aside) {
            let gap = usize::from(GAP) + column.word_width();
            match grids.last_mut() {
                Some(last) if last.columns.len() == naming || last.word_width() + gap <= width => {
                    last.columns.push(column.clone());
                }
                _ => grids.push(of([named, std::slice::from_ref(column)].concat())),
            }
        }
        grids.iter().map(|grid| grid.pages(width)).collect::<Vec<_>>().join("\n")
    }

    fn rows(&self) -> usize {
        self.columns.iter().map(|column| column.cells.len()).max().unwrap_or(0)
    }

    /// Some rows with the header above them.
    fn page(&self, width: usize, rows: Range<usize>, words: Option<&[u16]>) -> String {
        let ends = rows.end == self.rows();
        let lines = self.lines(width, true, rows, words);
        let header = self.columns.iter().map(|column| column.header.lines().count()).max();
        // the line below the header, over the whole table
        let rule = lines.get(header.unwrap_or(0).max(1)).cloned().unwrap_or_default();
        let mut text = String::new();
        let last = lines.len().saturating_sub(1);
        for (place, line) in lines.iter().enumerate() {
            if self.footer && ends && place == last {
                text += &format!("{rule}\n");
            }
            text += &format!("{line}\n");
        }
        text
    }

    /// The table without a header, ending in a newline.
    pub(crate) fn bare(&self, width: usize) -> String {
        let rows = self.rows();
        let pages = (0..rows).step_by(PAGE).map(|first| first..(first + PAGE).min(rows));
        let words = self.squeezed_words(width);
        let lines = pages.flat_map(|page| self.lines(width, false, page, words.as_deref()));
        lines.map(|line| line + "\n").collect()
    }

    /// The lines where nothing wraps; none where something may, or where letters are not of one column
    /// each.
    fn unwrapped(&self, width: usize, header: bool, rows: Range<usize>) -> Option<Vec<String>> {
        let mut widths = Vec::with_capacity(self.columns.len());
        for column in &self.columns {
            let cells = column.cells.get(rows.start..rows.end.min(column.cells.len()))?;
            if !column.header.is_ascii() || cells.iter().any(|cell| !is_plain(cell)) {
                return None;
            }
            let header = column.header.lines().filter(|_| header).map(str::len).max();
            let widest = cells.iter().map(String::len).max().max(header).unwrap_or(0);
            widths.push(match column.constraint {
                Some(ColumnConstraint::LowerBoundary(Width::Fixed(least))) => {
                    widest.max(usize::from(least))
                }
                _ => widest,
            });
        }
        let gap = usize::from(GAP);
        let all = widths.iter().sum::<usize>() + widths.len().saturating_sub(1) * gap;
        if widths.contains(&0) || all > width {
            return None;
        }
        let line = |cell: &dyn Fn(&GridColumn) -> &str| {
            let mut line = String::with_capacity(all);
            let mut end = 0;
            for (column, width) in self.columns.iter().zip(&widths) {
                let text = cell(column);
                let indent = match column.alignment {
                    CellAlignment::Right => width - text.len(),
                    _ => 0,
                };
                line.extend(std::iter::repeat_n(' ', end + indent - line.len()));
                line += text;
                end += width + gap;
            }
            line.truncate(line.trim_end().len());
            line
        };
        let mut lines = Vec::with_capacity(rows.len() + 3);
        if header {
            let height = self.columns.iter().map(|column| column.header.lines().count()).max();
            for place in 0..height.unwrap_or(0).max(1) {
                lines.push(line(&|column| column.header.lines().nth(place).unwrap_or_default()));
            }
            lines.push(std::iter::repeat_n(LINE, all).collect());
        }
        for place in rows {
            lines.push(line(&|column| column.cell(place)));
        }
        Some(lines)
    }

    /// `words` are the least widths of squeezed columns.
    fn lines(
        &self,
        width: usize,
        header: bool,
        rows: Range<usize>,
        words: Option<&[u16]>,
    ) -> Vec<String> {
        if let Some(lines) = self.unwrapped(width, header, rows.clone()) {
            return lines;
        }
        let mut table = Table::new();
        let mut style = TableStyle::new()
            .header_lines(ContentLineStyle::none())
            .content_lines(ContentLineStyle::none());
        if header {
            style = style.header_separator(LineStyle::none().fill(LINE));
            table.set_header(
                self.columns
                    .iter()
                    .map(|column| Cell::new(&column.header).set_alignment(column.alignment)),
            );
        }
        table.load_style(style);
        let width = u16::try_from(width).unwrap_or(u16::MAX);
        table.set_content_arrangement(ContentArrangement::Dynamic).set_width(width);
        let all = self.rows();
        for place in rows {
            let cells = self
                .columns
                .iter()
                .map(|column| Cell::new(column.cell(place)).set_alignment(column.alignment));
            let mut row = Row::from(cells.collect::<Vec<_>>());
            if self.footer && place + 1 == all {
                row.max_height(1);
            }
            table.add_row(row);
        }
        let last = self.columns.len().saturating_sub(1);
        for (place, (column, wanted)) in table.column_iter_mut().zip(&self.columns).enumerate() {
            let gap = if place == last { 0 } else { GAP };
            column.set_padding((0, gap));
            let word = words.and_then(|words| words.get(place)).copied();
            let constraint = match (wanted.constraint, word) {
                (Some(ColumnConstraint::ContentWidth), _) => Some(ColumnConstraint::ContentWidth),
                (_, Some(least))
                | (Some(ColumnConstraint::LowerBoundary(Width::Fixed(least))), None) => {
                    Some(ColumnConstraint::LowerBoundary(Width::Fixed(least + gap)))
                }
                (other, None) => other,
            };
            if let Some(constraint) = constraint {
                column.set_constraint(constraint);
            }
        }
        table.lines().map(|line| line.trim_end().to_owned()).collect()
    }
}
