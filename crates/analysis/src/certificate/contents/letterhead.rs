//! The head of the first page of a certificate: pictures and the accreditation.

use super::Localized;

/// The head of the first page, beside name and address of the laboratory.
#[derive(Clone, Debug, Default)]
pub struct Letterhead {
    /// The logo of the laboratory.
    pub logo: Option<Picture>,
    /// The mark of the accreditation body.
    pub mark: Option<Picture>,
    /// The number of the accreditation.
    pub accreditation_number: Option<String>,
    /// A text about the accreditation.
    pub accreditation: Option<Localized>,
}

/// A picture in a file.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Picture {
    /// The name of the file, as the certificate file has it.
    pub name: String,
    /// Its content.
    pub bytes: Vec<u8>,
    /// Its format.
    pub format: PictureFormat,
}

/// The format of a picture.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum PictureFormat {
    /// Portable Network Graphics.
    Png,
    /// Scalable Vector Graphics.
    Svg,
}

impl PictureFormat {
    /// The media type.
    pub fn media_type(self) -> &'static str {
        match self {
            Self::Png => "image/png",
            Self::Svg => "image/svg+xml",
        }
    }

    /// The format of a file by its content; `None` for others.
    pub fn of(bytes: &[u8]) -> Option<Self> {
        const PNG: &[u8] = b"\x89PNG\r\n\x1a\n";
        if bytes.starts_with(PNG) {
            return Some(Self::Png);
        }
        let text = std::str::from_utf8(bytes).ok()?;
        let start = text.trim_start_matches('\u{feff}').trim_start();
        (start.starts_with('<') && text.contains("<svg") && text.contains("</svg>"))
            .then_some(Self::Svg)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn formats_follow_from_the_content() {
        assert_eq!(PictureFormat::of(b"\x89PNG\r\n\x1a\n..."), Some(PictureFormat::Png));
        let svg = "<?xml version=\"1.0\"?>\n<svg xmlns=\"http://www.w3.org/2000/svg\"></svg>";
        assert_eq!(PictureFormat::of(svg.as_bytes()), Some(PictureFormat::Svg));
        for other in [&b"GIF89a"[..], b"", b"<html></html>", b"\xff\xd8\xff\xe0", b"svg"] {
            assert_eq!(PictureFormat::of(other), None, "{other:?}");
        }
    }
}
