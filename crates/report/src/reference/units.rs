//! The unit symbols, their spellings and sizes, and the prefixes.

use gumption_units::{Dimension, Prefix, Symbol, Unit};

use crate::document::Document;
use crate::sheet::Sheet;

pub(super) fn document() -> Document {
    let mut document = Document { title: "Units".to_owned(), ..Document::default() };
    document.text(
        "A unit is a symbol, or a product, quotient or power of symbols: `m/s^2`, `kg*m^-3`, \
         `kg·m⁻³`, `W/(m^2 K)`, `nV/√Hz`, `1e-6/K`, `1`. Most take SI prefixes. Sizes are in the \
         coherent SI unit; temperatures and levels count from a zero of their own.",
    );
    document.section("Symbols");
    let symbols: Vec<&Symbol> = gumption_units::symbols().collect();
    let unit = |symbol: &Symbol| Unit::parse(symbol.name()).ok();
    let mut sheet = Sheet::default();
    sheet.text("symbol", symbols.iter().map(|symbol| format!("`{}`", symbol.name())));
    let also = |symbol: &&Symbol| {
        let names: Vec<String> =
            symbol.spellings().skip(1).map(|name| format!("`{name}`")).collect();
        names.join(" ")
    };
    sheet.text("also", symbols.iter().map(also));
    let prefixes = |symbol: &&Symbol| if symbol.takes_prefixes() { "yes" } else { "" }.to_owned();
    sheet.text("prefixes", symbols.iter().map(prefixes));
    let size = |symbol: &&Symbol| unit(symbol).map_or_else(String::new, |unit| size(&unit));
    sheet.text("is", symbols.iter().map(size));
    let measures = |symbol: &&Symbol| {
        let what = unit(symbol).and_then(|unit| unit.dimension().quantity()).unwrap_or_default();
        let without_article = what.trim_start_matches("an ").trim_start_matches("a ");
        without_article.replace(" or an ", " or ").replace(" or a ", " or ")
    };
    sheet.text("measures", symbols.iter().map(measures));
    document.table(sheet);
    document.section("Prefixes");
    let prefixes: Vec<&Prefix> = gumption_units::prefixes().collect();
    let mut sheet = Sheet::default();
    sheet.text("prefix", prefixes.iter().map(|prefix| format!("`{}`", prefix.symbol())));
    sheet.text("name", prefixes.iter().map(|prefix| prefix.name().to_owned()));
    sheet.text("factor", prefixes.iter().map(|prefix| format!("1e{}", prefix.decimal())));
    document.table(sheet);
    document
}

/// The size of a unit: `0.0254 m`.
fn size(unit: &Unit) -> String {
    let factor = unit.factor();
    let number = if factor != 0.0 && (1e-4..1e6).contains(&factor.abs()) {
        format!("{factor}")
    } else {
        format!("{factor:e}")
    };
    match unit.dimension() {
        of if of == Dimension::NONE => number,
        of => format!("{number} {}", of.usual_unit()),
    }
}
