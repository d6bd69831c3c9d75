//! A table without a look: text pages and HTML pages draw it each in their own way.

/// A table, column by column.
#[derive(Clone, Debug, Default)]
pub(crate) struct Sheet {
    pub(crate) columns: Vec<Column>,
}

/// A column of a table.
#[derive(Clone, Debug)]
pub(crate) struct Column {
    /// What stands above it; a line break may be in it.
    pub(crate) header: String,
    pub(crate) cells: Vec<String>,
    /// Whether the cells are numbers, whose decimal points stand under each other.
    pub(crate) numbers: bool,
}

impl Sheet {
    /// Adds a column of texts.
    pub(crate) fn text(&mut self, header: &str, cells: impl IntoIterator<Item = String>) {
        self.push(header, cells, false);
    }

    /// Adds a column of numbers.
    pub(crate) fn numbers(&mut self, header: &str, cells: impl IntoIterator<Item = String>) {
        self.push(header, cells, true);
    }

    fn push(&mut self, header: &str, cells: impl IntoIterator<Item = String>, numbers: bool) {
        let cells = cells.into_iter().collect();
        self.columns.push(Column { header: header.to_owned(), cells, numbers });
    }

    /// How many rows it has.
    pub(crate) fn rows(&self) -> usize {
        self.columns.iter().map(|column| column.cells.len()).max().unwrap_or(0)
    }
}
