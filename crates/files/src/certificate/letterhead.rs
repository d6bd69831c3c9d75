//! The head of a certificate's first page: logo and accreditation.

use super::super::keys;
use super::administrative::{localized, owned};
use gumption_analysis::certificate::contents::{Letterhead, Picture, PictureFormat};
use gumption_text::object::Object;
use gumption_text::{DiagnosticKind, Folder};

/// The largest picture: every page, digital certificate and workbook carries it.
const MOST_BYTES: u64 = 2_000_000;

/// The letterhead; without one nothing but name and address of the laboratory is stated.
pub(super) fn read(root: &Object<'_>, folder: Folder<'_>) -> Letterhead {
    let Some(member) = root.get("letterhead") else { return Letterhead::default() };
    let Some(of) = Object::new(root.log, "`letterhead`", &member.value, &member.key_span) else {
        return Letterhead::default();
    };
    keys::check(&of, keys::LETTERHEAD);
    Letterhead {
        logo: picture(&of, "logo", folder),
        mark: picture(&of, "accreditation_mark", folder),
        accreditation_number: owned(&of, "accreditation_number"),
        accreditation: localized(&of, "accreditation"),
    }
}

/// A picture in a file that the certificate names.
fn picture(of: &Object<'_>, key: &'static str, folder: Folder<'_>) -> Option<Picture> {
    let member = of.get(key)?;
    let name = of.text(key)?.to_owned();
    let bytes = match folder.content(&name, MOST_BYTES) {
        Ok(bytes) => bytes,
        Err(diagnostic) => {
            of.log.report(&member.value.span, diagnostic);
            return None;
        }
    };
    let Some(format) = PictureFormat::of(&bytes) else {
        let reason = format!("`{name}` is neither a PNG nor an SVG picture");
        of.log.report(&member.value.span, DiagnosticKind::Certificate { reason });
        return None;
    };
    Some(Picture { name, bytes, format })
}
