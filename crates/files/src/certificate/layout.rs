//! The tables of a certificate: which columns they have.

use super::super::conditions::parse_unit;
use super::super::keys;
use super::super::settings::named;
use super::administrative::localized;
use gumption_analysis::certificate::contents::{
    Asked, ColumnContent, ColumnUnit, LayoutColumn, LayoutTable, Line,
};
use gumption_engine::model::Output;
use gumption_text::DiagnosticKind;
use gumption_text::json::{Json, Node};
use gumption_text::object::Object;
use gumption_units::{Unit, nearest};

/// The most decimals of a column.
const MOST_DECIMALS: u64 = 15;

/// A table whose columns are still to be read: they name quantities of models that rows ask for.
#[derive(Debug)]
pub(super) struct OpenTable<'a> {
    object: Object<'a>,
    pub(super) name: Option<String>,
}

/// The tables of the file by their names; empty without a layout.
pub(super) fn tables<'a>(root: &Object<'a>) -> Vec<OpenTable<'a>> {
    let Some(member) = root.get("layout") else { return Vec::new() };
    let Some(layout) = Object::new(root.log, "`layout`", &member.value, &member.key_span) else {
        return Vec::new();
    };
    keys::check(&layout, keys::LAYOUT);
    if layout.get("tables").is_none() {
        if layout.required("columns").is_some() {
            return vec![OpenTable { object: layout, name: None }];
        }
        return Vec::new();
    }
    if let Some(columns) = layout.get("columns") {
        let diagnostic = DiagnosticKind::Exclusive { first: "tables", second: "columns" };
        root.log.report(&columns.key_span, diagnostic);
        return Vec::new();
    }
    let mut found: Vec<OpenTable<'a>> = Vec::new();
    for node in layout.list("tables").unwrap_or_default() {
        let Some(table) = Object::new(root.log, "a table", node, &node.span) else { continue };
        keys::check(&table, keys::LAYOUT_TABLE);
        table.required("columns");
        table.required("name");
        let name = table.text("name").map(str::to_owned);
        if let (Some(name), Some(member)) = (&name, table.get("name"))
            && found.iter().any(|other| other.name.as_ref() == Some(name))
        {
            let reason = format!("another table is called `{name}` too");
            root.log.report(&member.value.span, DiagnosticKind::Certificate { reason });
        }
        found.push(OpenTable { object: table, name });
    }
    found
}

/// The index of the table that a row chooses, among the names of the tables; `None` after an error.
pub(super) fn chosen(row: &Object<'_>, tables: &[Option<String>]) -> Option<usize> {
    let refuse = |place, reason: String| {
        row.log.report(place, DiagnosticKind::Certificate { reason });
        None
    };
    let known = || {
        let names: Vec<String> = tables.iter().flatten().map(|name| format!("`{name}`")).collect();
        gumption_units::listed(&names, " and ")
    };
    match (row.get("table"), tables) {
        (None, [] | [_]) => Some(0),
        (None, _) => refuse(
            row.place(),
            format!("the layout has several tables: `table` says which one, of {}", known()),
        ),
        (Some(member), _) => {
            let name = row.text("table")?;
            if let Some(place) = tables.iter().position(|table| table.as_deref() == Some(name)) {
                return Some(place);
            }
            let reason = match tables.iter().flatten().next() {
                None => "`layout` has no `tables` to choose from".to_owned(),
                Some(_) => format!("the layout has no table `{name}`; it has {}", known()),
            };
            refuse(&member.value.span, reason)
        }
    }
}

/// What the rows of a table ask for.
struct Rows<'r> {
    lines: Vec<&'r Line>,
    evaluations: &'r [Asked],
}

impl<'r> Rows<'r> {
    /// The stated outputs of the table of that name.
    fn outputs(&self, name: &str) -> Vec<&'r Output> {
        self.stated().filter(|output| output.quantity.name == name).collect()
    }

    fn stated(&self) -> impl Iterator<Item = &'r Output> + '_ {
        self.lines.iter().filter_map(|line| {
            self.evaluations.get(line.evaluation)?.task.model.outputs.get(line.output)
        })
    }

    /// The names of the stated outputs, each once.
    fn names(&self) -> Vec<String> {
        let mut names: Vec<String> = Vec::new();
        for output in self.stated() {
            if !names.contains(&output.quantity.name) {
                names.push(output.quantity.name.clone());
            }
        }
        names
    }

    /// The units of an input or a condition in the models of the table.
    fn units_of_known(&self, name: &str) -> Vec<&'r Unit> {
        let units = self.lines.iter().filter_map(|line| {
            Some(self.evaluations.get(line.evaluation)?.value(line.row, name)?.1)
        });
        units.collect()
    }

    /// Whether a model of the table has an output of that name.
    fn has_output(&self, name: &str) -> bool {
        self.lines
            .iter()
            .filter_map(|line| self.evaluations.get(line.evaluation))
            .any(|asked| asked.task.model.outputs.iter().any(|output| output.quantity.name == name))
    }

    /// All names that a column can have.
    fn known(&self) -> Vec<String> {
        let mut names = self.names();
        for asked in self.lines.iter().filter_map(|line| self.evaluations.get(line.evaluation)) {
            let model = &asked.task.model;
            let inputs = model.inputs.iter().map(|input| &input.quantity);
            for quantity in inputs.chain(&model.conditions) {
                if !names.contains(&quantity.name) {
                    names.push(quantity.name.clone());
                }
            }
        }
        names
    }
}

/// The columns of the tables, for the rows that were read.
pub(super) fn layout(
    tables: Vec<OpenTable<'_>>,
    lines: &[Line],
    evaluations: &[Asked],
) -> Vec<LayoutTable> {
    let table = |(number, table): (usize, OpenTable<'_>)| {
        let object = &table.object;
        let lines: Vec<&Line> = lines.iter().filter(|line| line.table == number).collect();
        if lines.is_empty() {
            let reason = "no row of the certificate is in this table".to_owned();
            object.report(DiagnosticKind::Certificate { reason });
            return LayoutTable { name: table.name, title: None, columns: Vec::new() };
        }
        let rows = Rows { lines, evaluations };
        let list = object.list("columns").unwrap_or_default();
        if let (true, Some(member)) = (list.is_empty(), object.get("columns")) {
            let diagnostic = DiagnosticKind::NoValues { name: "columns".into() };
            object.log.report(&member.key_span, diagnostic);
        }
        let columns = list.iter().filter_map(|node| column(object, node, &rows)).collect();
        LayoutTable { name: table.name, title: localized(object, "title"), columns }
    };
    tables.into_iter().enumerate().map(table).collect()
}

/// A column: a text such as `E`, `U(E)` or `U`, or an object.
fn column(table: &Object<'_>, node: &Node, rows: &Rows<'_>) -> Option<LayoutColumn> {
    let refuse = |reason: String| {
        table.log.report(&node.span, DiagnosticKind::Certificate { reason });
        None
    };
    let Json::Text(text) = &node.value else {
        return column_of_object(table, node, rows);
    };
    let text = text.trim();
    let (content, quantity) = match text.strip_suffix(')').and_then(|text| text.split_once('(')) {
        Some((content, quantity)) => match ColumnContent::named(content.trim()) {
            Some(content) => (content, Some(quantity.trim())),
            None => {
                let names = ColumnContent::ALL.map(|content| format!("`{}(...)`", content.name()));
                let names = gumption_units::listed(&names, " or ");
                return refuse(format!("a column is not `{content}(...)`, but {names}"));
            }
        },
        None => match (ColumnContent::named(text), rows.known().iter().any(|name| name == text)) {
            (Some(content), true) => {
                let name = content.name();
                return refuse(format!(
                    "`{text}` is a quantity of the model, and a content of columns too: write \
                     `value({text})` for the quantity, or `{name}(OUTPUT)` with the output for the \
                     content"
                ));
            }
            (Some(content), false) => (content, None),
            (None, _) => (ColumnContent::Value, Some(text)),
        },
    };
    match of_content(content, quantity, rows) {
        Ok((quantity, _)) => {
            let unit = ColumnUnit::Own;
            Some(LayoutColumn { quantity, content, heading: None, unit, decimals: None })
        }
        Err(reason) => refuse(reason),
    }
}

/// The quantity of a column with its unit, or why there is none.
fn of_content<'r>(
    content: ColumnContent,
    quantity: Option<&str>,
    rows: &Rows<'r>,
) -> Result<(String, Option<&'r Unit>), String> {
    if content == ColumnContent::Label {
        return Ok((String::new(), None));
    }
    let stated = rows.names();
    let name = match (quantity, stated.as_slice()) {
        (Some(name), _) => name,
        (None, [only]) => only.as_str(),
        (None, _) => {
            let calls: Vec<String> =
                stated.iter().map(|name| format!("`{}({name})`", content.name())).collect();
            let calls = gumption_units::listed(&calls, " or ");
            return Err(format!("the table states several outputs: write {calls}"));
        }
    };
    if let Some(output) = rows.outputs(name).first() {
        let is_of_tolerance = matches!(content, ColumnContent::Limits | ColumnContent::Decision);
        if is_of_tolerance && rows.outputs(name).iter().all(|output| output.tolerance.is_none()) {
            return Err(format!("the output `{name}` has no `tolerance` in its model file"));
        }
        return Ok((name.to_owned(), Some(&output.quantity.unit)));
    }
    if rows.has_output(name) {
        return Err(format!(
            "no row of this table states the output `{name}`; add a row with `\"output\": \
             \"{name}\"`"
        ));
    }
    match (rows.units_of_known(name).first(), content) {
        (Some(unit), ColumnContent::Value) => Ok((name.to_owned(), Some(unit))),
        (Some(_), _) => Err(format!(
            "`{name}` is no output: a column shows only its value, and `{}` belongs to an output",
            content.name()
        )),
        (None, _) => {
            let known = rows.known();
            let near = nearest(name, known.iter().map(String::as_str));
            let near = near.map_or(String::new(), |near| format!("; did you mean `{near}`?"));
            Err(format!(
                "the models of this table have no output, input or condition `{name}`{near}"
            ))
        }
    }
}

fn column_of_object(table: &Object<'_>, node: &Node, rows: &Rows<'_>) -> Option<LayoutColumn> {
    let of = Object::new(table.log, "a column", node, &node.span)?;
    keys::check(&of, keys::LAYOUT_COLUMN);
    let names = ColumnContent::ALL.map(ColumnContent::name);
    let content = match of.get("show") {
        Some(_) => named(&of, "show", ColumnContent::named, &names)?,
        None => ColumnContent::Value,
    };
    let quantity = of.text("quantity");
    if content == ColumnContent::Value && quantity.is_none() {
        of.required("quantity");
        return None;
    }
    let (quantity, own) = match of_content(content, quantity, rows) {
        Ok(found) => found,
        Err(reason) => {
            let place = of.get("quantity").map_or(&node.span, |member| &member.value.span);
            of.log.report(place, DiagnosticKind::Certificate { reason });
            return None;
        }
    };
    let is_output = !rows.outputs(&quantity).is_empty();
    let decimals = of.get("decimals").and_then(|member| {
        if is_output || content != ColumnContent::Value {
            let reason = "`decimals` is for inputs and conditions: the digits of an output follow \
                          from U"
                .to_owned();
            of.log.report(&member.key_span, DiagnosticKind::Certificate { reason });
            return None;
        }
        of.whole("decimals", 0, MOST_DECIMALS).and_then(|n| u32::try_from(n).ok())
    });
    Some(LayoutColumn {
        unit: unit(&of, content, &quantity, own, rows)?,
        heading: localized(&of, "heading"),
        quantity,
        content,
        decimals,
    })
}

/// The unit of a column; `None` after an error.
fn unit(
    of: &Object<'_>,
    content: ColumnContent,
    quantity: &str,
    own: Option<&Unit>,
    rows: &Rows<'_>,
) -> Option<ColumnUnit> {
    let refuse = |key: &str, reason: String| {
        let place = of.get(key).map_or(of.place(), |member| &member.value.span);
        of.log.report(place, DiagnosticKind::Certificate { reason });
        None
    };
    let relative_to = of.get("relative_to").and_then(|_| of.text("relative_to"));
    let Some(member) = of.get("unit") else {
        if of.get("relative_to").is_some() {
            return refuse(
                "relative_to",
                "`relative_to` needs a `unit` such as `%` or `ppm`".to_owned(),
            );
        }
        return Some(ColumnUnit::Own);
    };
    let unit = parse_unit(of.log, of.text("unit")?, &member.value.span)?;
    let Some(own) = own.filter(|_| {
        use ColumnContent::{Expanded, Limits, Value};
        matches!(content, Value | Expanded | Limits)
    }) else {
        return refuse("unit", format!("a column of `{}` has no unit", content.name()));
    };
    let is_number = Unit::conversion_factor(&unit, &Unit::one()).is_ok();
    let is_relative = content == ColumnContent::Expanded && is_number;
    match relative_to {
        Some(_) if !is_relative => refuse(
            "relative_to",
            "only a column of `U` in a unit such as `%` or `ppm` is relative".to_owned(),
        ),
        Some(to) => match of_content(ColumnContent::Value, Some(to), rows) {
            Ok((_, Some(base))) if base.is_compatible(own) => {
                Some(ColumnUnit::Relative { unit, to: to.to_owned() })
            }
            Ok(_) => refuse(
                "relative_to",
                format!(
                    "`{quantity}` and `{to}` have different kinds of units, so that U of one is \
                         not relative to the other"
                ),
            ),
            Err(reason) => refuse("relative_to", reason),
        },
        // the conversion of a number without dimension
        None if Unit::conversion_factor(own, &unit).is_ok() => Some(ColumnUnit::Other(unit)),
        None if is_relative => Some(ColumnUnit::Relative { unit, to: quantity.to_owned() }),
        None => refuse(
            "unit",
            format!("`{quantity}` is in `{own}`, which cannot be converted to `{unit}`"),
        ),
    }
}
