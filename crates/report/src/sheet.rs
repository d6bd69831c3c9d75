//! A table without a look: every page, document and workbook draws it in its own way.

use super::number::MISSING;

/// A table, column by column.
#[derive(Clone, Debug, Default)]
pub(crate) struct Sheet {
    pub(crate) columns: Vec<SheetColumn>,
    /// Whether the last row sums up the others.
    pub(crate) footer: bool,
    /// How many columns tell which row it is; the first one alone if there are none.
    pub(crate) naming: usize,
}

/// A column of a table.
#[derive(Clone, Debug)]
pub(crate) struct SheetColumn {
    /// What stands above it; a line break may be in it.
    pub(crate) header: String,
    /// What stands above it where the page is too narrow for that.
    pub(crate) narrow: Option<String>,
    /// The cells as a page shows them.
    pub(crate) cells: Vec<String>,
    /// The numbers that the cells were rounded from, where they are known: as many as cells, or
    /// none at all.
    pub(crate) values: Vec<Option<f64>>,
    pub(crate) kind: ColumnKind,
    /// Whether it stands behind the others where a page is too narrow for one table.
    pub(crate) aside: bool,
}

/// What the cells of a column are.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum ColumnKind {
    /// Texts.
    Text,
    /// Numbers, whose decimal points stand under each other.
    Numbers,
    /// Units as files write them: `m/s^2`.
    Units,
    /// Formulas as files write them: `a*sin(t)`.
    Equations,
}

/// A number as a page shows it, and as it was before rounding.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Figure {
    pub(crate) text: String,
    pub(crate) value: Option<f64>,
}

impl Figure {
    /// A number that was rounded once.
    pub(crate) fn of(value: f64, text: String) -> Self {
        Self { text, value: Some(value) }
    }

    /// A number that there is none of.
    pub(crate) fn missing() -> Self {
        Self { text: MISSING.to_owned(), value: None }
    }

    /// A number rounded by `round` if there is one.
    pub(crate) fn rounded(value: Option<f64>, round: impl FnOnce(f64) -> String) -> Self {
        value.map_or_else(Self::missing, |value| Self::of(value, round(value)))
    }
}

impl Sheet {
    /// Adds a column of texts.
    pub(crate) fn text(&mut self, header: &str, cells: impl IntoIterator<Item = String>) {
        self.push(header, cells, ColumnKind::Text);
    }

    /// Adds a column of numbers.
    pub(crate) fn numbers(&mut self, header: &str, cells: impl IntoIterator<Item = String>) {
        self.push(header, cells, ColumnKind::Numbers);
    }

    /// Adds a column of units.
    pub(crate) fn units(&mut self, header: &str, cells: impl IntoIterator<Item = String>) {
        self.push(header, cells, ColumnKind::Units);
    }

    /// Adds a column of numbers whose unrounded values are known.
    pub(crate) fn figures(&mut self, header: &str, cells: impl IntoIterator<Item = Figure>) {
        let (texts, values): (Vec<_>, Vec<_>) =
            cells.into_iter().map(|figure| (figure.text, figure.value)).unzip();
        self.numbers(header, texts);
        if let Some(column) = self.columns.last_mut() {
            column.values = values;
        }
    }

    /// Where a page is too narrow for one table, the last column stands behind the others.
    pub(crate) fn aside(&mut self) {
        if let Some(column) = self.columns.last_mut() {
            column.aside = true;
        }
    }

    /// Adds a row of cells, one for each column.
    pub(crate) fn append(&mut self, cells: impl IntoIterator<Item = String>) {
        for (column, cell) in self.columns.iter_mut().zip(cells) {
            column.cells.push(cell);
        }
    }

    /// Adds a column of a kind.
    pub(crate) fn push(
        &mut self,
        header: &str,
        cells: impl IntoIterator<Item = String>,
        kind: ColumnKind,
    ) {
        let cells = cells.into_iter().collect();
        let (header, narrow, values) = (header.to_owned(), None, Vec::new());
        self.columns.push(SheetColumn { header, narrow, cells, values, kind, aside: false });
    }

    /// Gives the last column another header for pages that are too narrow.
    pub(crate) fn narrow(&mut self, header: &str) {
        if let Some(column) = self.columns.last_mut() {
            column.narrow = Some(header.to_owned());
        }
    }

    /// The same with decimal commas in its numbers.
    pub(crate) fn with_commas(mut self) -> Self {
        for column in self.columns.iter_mut().filter(|column| column.kind == ColumnKind::Numbers) {
            for cell in &mut column.cells {
                *cell = super::printed::with_comma(cell);
            }
        }
        self
    }

    /// Whether something stands above the columns.
    pub(crate) fn has_headers(&self) -> bool {
        self.columns.iter().any(|column| !column.header.is_empty())
    }

    /// How many rows it has.
    pub(crate) fn rows(&self) -> usize {
        self.columns.iter().map(|column| column.cells.len()).max().unwrap_or(0)
    }
}

impl SheetColumn {
    /// Whether the cells are numbers.
    pub(crate) fn is_numeric(&self) -> bool {
        self.kind == ColumnKind::Numbers
    }

    /// Whether the cells are texts that may be broken.
    pub(crate) fn wraps(&self) -> bool {
        matches!(self.kind, ColumnKind::Text | ColumnKind::Equations)
    }

    /// The header on one line.
    pub(crate) fn title(&self) -> String {
        self.header.split_whitespace().collect::<Vec<_>>().join(" ")
    }

    /// The cell of a row; nothing where it has none.
    pub(crate) fn cell(&self, row: usize) -> &str {
        self.cells.get(row).map_or("", String::as_str)
    }

    /// The unrounded number of a row.
    pub(crate) fn value(&self, row: usize) -> Option<f64> {
        self.values.get(row).copied().flatten()
    }
}
