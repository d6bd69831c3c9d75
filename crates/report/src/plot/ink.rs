//! Colours that colour-blind readers can distinguish (Okabe and Ito) and that differ in lightness,
//! also in black-and-white print.
//!
//! Each is used for one purpose only: the style sheet of a page finds it by its value and replaces
//! it in dark mode.

use plotters::style::RGBColor;

/// Text, axes and lines.
pub(crate) const INK: RGBColor = RGBColor(0x1a, 0x1a, 0x1a);
/// Secondary text and lines.
pub(crate) const WEAK: RGBColor = RGBColor(0x5c, 0x5c, 0x5c);
/// Lines of a grid.
pub(crate) const FAINT: RGBColor = RGBColor(0xe4, 0xe4, 0xe4);
/// Before the correction: vermilion.
pub(crate) const BEFORE: RGBColor = RGBColor(0xd5, 0x5e, 0x00);
/// After the correction: blue.
pub(crate) const AFTER: RGBColor = RGBColor(0x00, 0x72, 0xb2);
/// Background elements: sky blue.
pub(crate) const EVEN: RGBColor = RGBColor(0x56, 0xb4, 0xe9);

/// From inconspicuous to very strong: a fill and the colour of text on it, in decreasing lightness.
pub(crate) const SHADES: [(RGBColor, RGBColor); 5] = [
    (RGBColor(0xf4, 0xf7, 0xfb), DARK),
    (RGBColor(0xc9, 0xdb, 0xee), DARK),
    (RGBColor(0x7f, 0xb3, 0xd8), DARK),
    (RGBColor(0x2d, 0x7a, 0xb9), LIGHT),
    (RGBColor(0x0b, 0x36, 0x6f), LIGHT),
];

/// Text on light fills.
const DARK: RGBColor = RGBColor(0x11, 0x11, 0x11);
/// Text on dark fills.
const LIGHT: RGBColor = RGBColor(0xff, 0xff, 0xff);

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_dark_page_replaces_every_colour() {
        let style = include_str!("../html/style.css");
        for RGBColor(r, g, b) in [INK, WEAK, FAINT, BEFORE, AFTER, EVEN] {
            for what in ["fill", "stroke"] {
                let rule = format!("svg [{what}=\"#{r:02X}{g:02X}{b:02X}\"] {{ {what}: var(");
                assert!(style.contains(&rule), "{rule}");
            }
        }
    }

    /// In black and white only lightness remains: it decreases from shade to shade, and the colours
    /// for before, after and equal values differ in it.
    #[test]
    fn colours_differ_in_lightness() {
        let lightness = |RGBColor(r, g, b): RGBColor| {
            0.299 * f64::from(r) + 0.587 * f64::from(g) + 0.114 * f64::from(b)
        };
        for pair in SHADES.windows(2) {
            assert!(lightness(pair[0].0) > lightness(pair[1].0) + 20.0);
        }
        for (fill, text) in SHADES {
            assert!((lightness(fill) - lightness(text)).abs() > 100.0, "{fill:?}");
        }
        assert!(lightness(BEFORE) > lightness(AFTER) + 20.0);
        assert!(lightness(EVEN) > lightness(AFTER) + 40.0);
    }
}
