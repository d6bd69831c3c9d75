//! Texts of cells with formatted parts: raised, lowered, or struck through.
//!
//! Without the format, `10` and a raised `3` read as 103, and `0.05` with a raised footnote mark 1
//! as 0.051.

use quick_xml::events::Event;

use super::attribute;

/// The parts of one text, as they are read.
#[derive(Clone, Debug, Default)]
pub(super) struct RichTextParts {
    /// The text before the current part.
    before: String,
    text: String,
    /// The format of the part: `raised`, `lowered` or `struck through`.
    look: Option<&'static str>,
    in_text: bool,
    found: Option<String>,
}

impl RichTextParts {
    /// Processes an XML event between the beginning and the end of the text.
    pub(super) fn take(&mut self, event: &Event<'_>) {
        match event {
            Event::Start(element) | Event::Empty(element) => match element.local_name().as_ref() {
                "r" => {
                    self.close();
                    self.look = None;
                }
                "vertAlign" => {
                    self.look = match attribute(element, "val").as_deref() {
                        Some("superscript") => Some("raised"),
                        Some("subscript") => Some("lowered"),
                        _ => self.look,
                    }
                }
                "strike"
                    if attribute(element, "val")
                        .is_none_or(|text| text == "1" || text == "true") =>
                {
                    self.look = Some("struck-through");
                }
                "t" => self.in_text = matches!(event, Event::Start(_)),
                _ => {}
            },
            Event::Text(text) if self.in_text => self.text.push_str(text),
            Event::End(element) => match element.local_name().as_ref() {
                "t" => self.in_text = false,
                "r" => self.close(),
                _ => {}
            },
            _ => {}
        }
    }

    fn close(&mut self) {
        let text = std::mem::take(&mut self.text);
        let is_number = |c: char| c.is_ascii_digit() || matches!(c, '-' | '−' | '+' | ',' | '.');
        let touches = self.before.ends_with(|c: char| c.is_ascii_digit() || matches!(c, '.' | ','));
        if let Some(look) = self.look
            && self.found.is_none()
            && text.trim().starts_with(is_number)
            && (touches || look == "struck-through")
        {
            self.found = Some(format!(
                "holds `{}` with a {look} `{}`, which may be a power, a footnote, or text that \
                 does not belong to the number: \
                 write the number alone",
                self.before.trim(),
                text.trim()
            ));
        }
        self.before.push_str(&text);
    }

    /// Why the text is not a plain number; `None` if all parts have the same format.
    pub(super) fn doubt(&mut self) -> Option<String> {
        self.close();
        self.found.take()
    }
}

/// The doubt about each of the texts that cells share, in order.
pub(super) fn shared(text: &str) -> Vec<Option<String>> {
    let mut xml = quick_xml::Reader::from_str(text);
    let (mut found, mut parts) = (Vec::new(), RichTextParts::default());
    loop {
        let event = match xml.read_event() {
            Ok(Event::Eof) | Err(_) => return found,
            Ok(event) => event,
        };
        parts.take(&event);
        match event {
            Event::Start(element) if element.local_name().as_ref() == "si" => {
                parts = RichTextParts::default()
            }
            Event::Empty(element) if element.local_name().as_ref() == "si" => found.push(None),
            Event::End(element) if element.local_name().as_ref() == "si" => {
                found.push(parts.doubt())
            }
            _ => {}
        }
    }
}

#[cfg(test)]
mod tests {
    use super::shared;

    #[test]
    fn raised_digits_behind_digits_are_doubtful() {
        let run = |look: &str, text: &str| format!("<r><rPr>{look}</rPr><t>{text}</t></r>");
        let raised = r#"<vertAlign val="superscript"/>"#;
        let texts = [
            run("", "0.05") + &run(raised, "1"),
            run("", "mm") + &run(raised, "2"),
            run("", "5 m/s") + &run(raised, "2"),
            "<t>103</t>".to_owned(),
            run("<strike/>", "0.05") + &run("", "0.06"),
            run("", "5·10") + &run(raised, "-6"),
        ];
        let text: String = texts.iter().map(|text| format!("<si>{text}</si>")).collect();
        let found = shared(&format!("<sst>{text}</sst>"));
        let is_doubtful: Vec<bool> = found.iter().map(Option::is_some).collect();
        assert_eq!(is_doubtful, [true, false, false, false, true, true], "{found:?}");
        assert!(found[0].as_ref().unwrap().contains("`0.05` with a raised `1`"));
    }
}
