//! A case with other data and one candidate fewer, as files of their own.

use std::ops::Range;

use super::CaseFile;
use gumption_text::column_heading;
use gumption_text::json::{self, Json, Member, Node};
use gumption_text::{SourceText, bytes, table};

/// Why a case cannot be copied.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct NotCopied(pub String);

impl CaseFile {
    /// The files of this case with other measured values (for each observed output a value for each
    /// row, in its unit) and without the candidate `without`: names, relative to a folder of their
    /// own, and contents. The first one is the case.
    ///
    /// # Errors
    /// A table that lies outside the case's folder.
    pub fn variant(
        &self,
        values: &[Vec<f64>],
        without: Option<&str>,
    ) -> Result<Vec<(String, Vec<u8>)>, NotCopied> {
        let whole = |what: &str| NotCopied(format!("{what} cannot be read again"));
        let root = json::parse(&self.source).map_err(|_| whole("the case"))?;
        let observations = member(&root, "observations").ok_or_else(|| whole("`observations`"))?;
        let columns = member(&observations.value, "columns").ok_or_else(|| whole("`columns`"))?;
        let observed = self.case.model.outputs.iter().zip(&self.case.observed);
        let observed = observed.filter(|(_, observed)| observed.is_some());
        // the heading of each observed output with its values
        let measured: Option<Vec<(String, &Vec<f64>)>> = observed
            .zip(values)
            .map(|((output, _), values)| {
                let column = member(&columns.value, &output.quantity.name)?;
                Some((text_of(&column.value, "value")?, values))
            })
            .collect();
        let measured = measured.ok_or_else(|| whole("a column"))?;
        let mut edits: Vec<(Range<usize>, String)> =
            self.without(&root, without).into_iter().collect();
        let data = text_of(&observations.value, "file");
        if data.is_none() {
            let lists = member(&observations.value, "values").map(|of| &of.value.value);
            let Some(Json::Object(lists)) = lists else { return Err(whole("the data")) };
            let headings: Vec<String> = lists.iter().map(|of| of.key.trim().to_owned()).collect();
            for (name, values) in &measured {
                let place = column_heading::place_of(&headings, name);
                let place = place.ok_or_else(|| whole("a column"))?;
                let list: Vec<String> = values.iter().map(f64::to_string).collect();
                edits.push((lists[place].value.span.clone(), format!("[{}]", list.join(", "))));
            }
        }
        // from the end, so that places before stay
        edits.sort_by_key(|(range, _)| std::cmp::Reverse(range.start));
        let mut text = self.source.text.clone();
        for (range, by) in edits {
            text.replace_range(range, &by);
        }
        let mut files = vec![("case.json".to_owned(), text.into_bytes())];
        for (name, content) in &self.files {
            let inside = std::path::Path::new(name)
                .components()
                .all(|part| matches!(part, std::path::Component::Normal(_)));
            if !inside || name == "case.json" {
                return Err(NotCopied(format!(
                    "the table `{name}` does not lie in the folder of the case, so that it cannot be \
                     copied beside simulated data"
                )));
            }
            if Some(name) != data.as_ref() {
                files.push((name.clone(), content.clone()));
                continue;
            }
            let text = bytes::text(content).map_err(|_| whole("the data"))?;
            let table = table::parse(&SourceText::new(name.as_str(), &text), None)
                .map_err(|_| whole("the data"))?;
            let mut rows = table.rows.clone();
            for (name, values) in &measured {
                let column = table.column(name).ok_or_else(|| whole("a column"))?;
                for (row, value) in rows.iter_mut().zip(*values) {
                    if let Some(cell) = row.get_mut(column) {
                        *cell = *value;
                    }
                }
            }
            let mut out = csv::Writer::from_writer(Vec::new());
            let written = out.write_record(&table.columns).and_then(|()| {
                rows.iter().try_for_each(|row| out.write_record(row.iter().map(f64::to_string)))
            });
            let bytes = written.ok().and_then(|()| out.into_inner().ok());
            files.push((name.clone(), bytes.ok_or_else(|| whole("the data"))?));
        }
        Ok(files)
    }

    /// What takes one candidate out of the case's text: a range, and what stands there instead.
    fn without(&self, root: &Node, name: Option<&str>) -> Option<(Range<usize>, String)> {
        let name = name?;
        let own: &[Member] = match member(root, "effects").map(|m| &m.value.value) {
            Some(Json::Object(members)) => members,
            _ => &[],
        };
        if let Some(place) = own.iter().position(|member| member.key == name) {
            let span = |member: &Member| member.key_span.start..member.value.span.end;
            // with the comma before, or the one after the first
            let range = match (place.checked_sub(1).and_then(|p| own.get(p)), own.get(place + 1)) {
                (Some(before), _) => span(before).end..span(&own[place]).end,
                (None, Some(after)) => span(&own[place]).start..span(after).start,
                (None, None) => span(&own[place]),
            };
            return Some((range, String::new()));
        }
        let catalogue = member(root, "catalogue")?;
        let all = self
            .case
            .candidates
            .iter()
            .map(|candidate| self.case.listed_name(&candidate.effect.name));
        let shipped = all.filter(|name| own.iter().all(|member| member.key != **name));
        let mut names: Vec<String> = Vec::new();
        for other in
            shipped.filter(|shipped| *shipped != name).map(|shipped| format!("{shipped:?}"))
        {
            if !names.contains(&other) {
                names.push(other);
            }
        }
        Some((catalogue.value.span.clone(), format!("[{}]", names.join(", "))))
    }
}

fn member<'n>(node: &'n Node, key: &str) -> Option<&'n Member> {
    match &node.value {
        Json::Object(members) => members.iter().find(|member| member.key == key),
        _ => None,
    }
}

fn text_of(node: &Node, key: &str) -> Option<String> {
    match &member(node, key)?.value.value {
        Json::Text(text) => Some(text.clone()),
        _ => None,
    }
}
