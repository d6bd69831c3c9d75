//! A case with other data and one candidate fewer, as files of their own.

use super::CaseFile;
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
        let data = text_of(&observations.value, "file").ok_or_else(|| whole("`file`"))?;
        let columns = member(&observations.value, "columns").ok_or_else(|| whole("`columns`"))?;
        let mut files = vec![("case.json".to_owned(), self.without(&root, without).into_bytes())];
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
            if name != &data {
                files.push((name.clone(), content.clone()));
                continue;
            }
            let text = bytes::text(content).map_err(|_| whole("the data"))?;
            let table = table::parse(&SourceText::new(name.as_str(), &text), None)
                .map_err(|_| whole("the data"))?;
            let mut rows = table.rows.clone();
            let observed = self.case.model.outputs.iter().zip(&self.case.observed);
            let observed = observed.filter(|(_, observed)| observed.is_some());
            for ((output, _), values) in observed.zip(values) {
                let column = member(&columns.value, &output.quantity.name)
                    .and_then(|member| text_of(&member.value, "value"))
                    .and_then(|name| table.column(&name))
                    .ok_or_else(|| whole("a column"))?;
                for (row, value) in rows.iter_mut().zip(values) {
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

    /// The case's text without one candidate.
    fn without(&self, root: &Node, name: Option<&str>) -> String {
        let text = &self.source.text;
        let Some(name) = name else { return text.clone() };
        let own: &[Member] = match member(root, "effects").map(|m| &m.value.value) {
            Some(Json::Object(members)) => members,
            _ => &[],
        };
        let mut cut = text.clone();
        if let Some(place) = own.iter().position(|member| member.key == name) {
            let span = |member: &Member| member.key_span.start..member.value.span.end;
            // with the comma before, or the one after the first
            let range = match (place.checked_sub(1).and_then(|p| own.get(p)), own.get(place + 1)) {
                (Some(before), _) => span(before).end..span(&own[place]).end,
                (None, Some(after)) => span(&own[place]).start..span(after).start,
                (None, None) => span(&own[place]),
            };
            cut.replace_range(range, "");
        } else if let Some(catalogue) = member(root, "catalogue") {
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
            cut.replace_range(catalogue.value.span.clone(), &format!("[{}]", names.join(", ")));
        }
        cut
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
