//! What a user says of a sheet that the sheet does not say: the answers to questions.

use serde::{Deserialize, Serialize};

/// What the coefficients of a sheet without units of coefficients are in.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Coefficients {
    /// The unit of the result per unit of the quantity.
    Units,
    /// Plain ratios: quantities are converted to the unit of the result first.
    Ratios,
    /// There are none: the result is the sum of the quantities.
    One,
}

/// How a sheet is read, as the options of `gumption import` and the file beside the sheet say it.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields, rename_all = "kebab-case")]
pub struct ImportOptions {
    /// The sheet of the workbook.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub sheet: Option<String>,
    /// What columns hold: its name (`estimate`, `U`, `k`) and the column, by letter, number or heading.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub columns: Vec<(String, String)>,
    /// The units of columns of numbers, by the name of the column.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub column_units: Vec<(String, String)>,
    /// What rows are (`heading`, `result`, `combined`, `expanded`, `quantity`, `constant`, `ignore`) with
    /// their numbers, from 1.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub rows: Vec<(String, String)>,
    /// The unit of the result.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub unit: Option<String>,
    /// The estimate of the result; `sum` for the sum of the products of coefficients and estimates.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub estimate: Option<String>,
    /// The coverage factor of expanded uncertainties for which the sheet says none.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub k: Option<f64>,
    /// The distribution of half-widths for which the sheet says none.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub distribution: Option<String>,
    /// What coefficients without units are in.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub coefficients: Option<Coefficients>,
    /// The equation of the result, in place of what stands on the sheet.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub equation: Option<String>,
    /// Whether the equation is one of the numbers in the units of the sheet.
    #[serde(skip_serializing_if = "std::ops::Not::not")]
    pub numbers: bool,
}

impl ImportOptions {
    /// These options, completed by others: each answer of these goes before the other's.
    #[must_use]
    pub fn or(self, other: Self) -> Self {
        let lists = |own: Vec<(String, String)>, other: Vec<(String, String)>| {
            let others = other
                .into_iter()
                .filter(|(name, _)| own.iter().all(|(own_name, _)| own_name != name));
            let others: Vec<_> = others.collect();
            own.into_iter().chain(others).collect()
        };
        Self {
            sheet: self.sheet.or(other.sheet),
            columns: lists(self.columns, other.columns),
            column_units: lists(self.column_units, other.column_units),
            rows: lists(self.rows, other.rows),
            unit: self.unit.or(other.unit),
            estimate: self.estimate.or(other.estimate),
            k: self.k.or(other.k),
            distribution: self.distribution.or(other.distribution),
            coefficients: self.coefficients.or(other.coefficients),
            equation: self.equation.or(other.equation),
            numbers: self.numbers || other.numbers,
        }
    }

    /// As text for the file beside a sheet, which ends in a newline.
    pub fn to_json(&self) -> String {
        serde_json::to_string_pretty(self).unwrap_or_default() + "\n"
    }

    /// Of the text of such a file.
    ///
    /// # Errors
    /// What is wrong with it, as a sentence.
    pub fn from_json(text: &str) -> Result<Self, String> {
        serde_json::from_str(text)
            .map_err(|error| format!("it is no file of `--keep-columns`: {error}"))
    }
}
