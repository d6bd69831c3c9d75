//! Figures as SVG texts that are part of a page.

use maud::{Markup, PreEscaped, html};
use plotters::backend::SVGBackend;
use plotters::coord::Shift;
use plotters::drawing::{DrawingArea, DrawingAreaErrorKind, IntoDrawingArea};
use plotters::element::Text;
use plotters::style::text_anchor::{HPos, Pos, VPos};
use plotters::style::{Color, FontStyle, IntoFont, RGBColor, TextStyle};

use super::Chart;
use crate::printed::figure_text;

/// Drawing units per pixel of the page: positions are whole numbers of units.
pub(crate) const SCALE: i32 = 4;

/// Size of the text in pixels.
pub(crate) const FONT: f64 = 12.0;

/// The backend writes text smaller than requested by this factor.
const FONT_FACTOR: f64 = 1.24;

/// Distance of the pointer from a position within which its text is shown, in pixels.
const REACH: f64 = 7.0;

/// Maximum number of pointer texts in a figure.
const MOST_TITLES: usize = 300;

/// What is drawn on.
pub(crate) type Area<'a> = DrawingArea<SVGBackend<'a>, Shift>;

/// Drawing to memory cannot fail, but the plotting library may refuse a degenerate axis.
pub(crate) type Drawn<T = ()> = Result<T, DrawingAreaErrorKind<std::io::Error>>;

/// Pixels of the page in units of the drawing.
pub(crate) fn px(pixels: f64) -> i32 {
    (pixels * f64::from(SCALE)).round() as i32
}

/// The texts that a page shows when the pointer rests on a position of a figure, without a script.
#[derive(Clone, Debug, Default)]
pub(crate) struct Titles {
    places: Vec<(i32, i32, String)>,
}

impl Titles {
    /// Adds the text for a position of a panel.
    pub(crate) fn at(&mut self, chart: &Chart<'_>, place: (f64, f64), text: &str) {
        let (x, y) = chart.plotting_area().map_coordinate(&place);
        self.places.push((x, y, text.to_owned()));
    }

    /// Adds the text for a position in pixels.
    pub(crate) fn at_pixels(&mut self, (x, y): (f64, f64), text: &str) {
        self.places.push((px(x), px(y), text.to_owned()));
    }

    /// Invisible circles, each with its text; empty if they would overlap.
    fn markup(&self) -> Markup {
        let shown = if self.places.len() > MOST_TITLES { &[] } else { self.places.as_slice() };
        html! {
            @for (x, y, text) in shown {
                circle cx=(x) cy=(y) r=(px(REACH)) fill="transparent" { title { (figure_text(text)) } }
            }
        }
    }
}

/// A figure with a size in pixels, as the text of an `svg` element.
pub(crate) fn svg(width: f64, height: f64, draw: impl FnOnce(&Area<'_>) -> Drawn) -> String {
    svg_with_titles(width, height, |area, _| draw(area))
}

/// The same with texts for the pointer.
pub(crate) fn svg_with_titles(
    width: f64,
    height: f64,
    draw: impl FnOnce(&Area<'_>, &mut Titles) -> Drawn,
) -> String {
    let mut titles = Titles::default();
    let mut text = String::new();
    let size = (px(width).unsigned_abs(), px(height).unsigned_abs());
    {
        let area = SVGBackend::with_string(&mut text, size).into_drawing_area();
        let drawn = draw(&area, &mut titles).and_then(|()| area.present());
        debug_assert!(drawn.is_ok(), "{drawn:?}");
    }
    // the page gives the size, the drawing its proportions
    let size = format!("width=\"{}\" height=\"{}\" ", size.0, size.1);
    let mut text = text.replacen(&size, &format!("width=\"{width}\" height=\"{height}\" "), 1);
    if let Some(end) = text.rfind("</svg>") {
        text.insert_str(end, &titles.markup().into_string());
    }
    text
}

/// A layer of a figure: the method whose results it shows, if there is one, and the function that
/// draws it.
pub(crate) type Layer<'l> = (Option<&'static str>, &'l dyn Fn(&Area<'_>, &mut Titles) -> Drawn);

/// A figure of superimposed layers. The results of a method form a group that is marked with its
/// name, so that it can be hidden.
pub(crate) fn svg_in_layers(width: f64, height: f64, layers: &[Layer<'_>]) -> String {
    let mut whole = String::new();
    for (method, draw) in layers {
        let drawn = svg_with_titles(width, height, draw);
        let inside =
            drawn.find("<svg ").and_then(|from| Some(from + drawn.get(from..)?.find('>')?));
        let (Some(from), Some(to)) = (inside, drawn.rfind("</svg>")) else { continue };
        if whole.is_empty() {
            whole.push_str(&drawn[..=from]);
        }
        let inside = drawn[from + 1..to].trim();
        match method {
            Some(method) => {
                whole += &html! { g data-method=(method) { (PreEscaped(inside)) } }.into_string();
            }
            None => whole += inside,
        }
        whole.push('\n');
    }
    whole + "</svg>\n"
}

/// The part of a text that is at its position.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Anchor {
    Start,
    Middle,
    End,
}

/// The position and style of a text.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Write {
    /// Where the anchor is, in pixels.
    pub(crate) at: (f64, f64),
    /// The part of the text at that position.
    pub(crate) anchor: Anchor,
    /// Size in pixels.
    pub(crate) size: f64,
    /// Colour.
    pub(crate) colour: RGBColor,
    /// Whether it is bold.
    pub(crate) bold: bool,
}

/// Writes a text, vertically centred at its position.
pub(crate) fn write(area: &Area<'_>, text: &str, how: Write) -> Drawn {
    let anchor = match how.anchor {
        Anchor::Start => HPos::Left,
        Anchor::Middle => HPos::Center,
        Anchor::End => HPos::Right,
    };
    let style = text_style(how.size, how.colour, how.bold).pos(Pos::new(anchor, VPos::Center));
    area.draw(&Text::new(figure_text(text), (px(how.at.0), px(how.at.1)), style))
}

/// The style of a text of a size in pixels.
pub(crate) fn text_style(size: f64, colour: RGBColor, bold: bool) -> TextStyle<'static> {
    let style = if bold { FontStyle::Bold } else { FontStyle::Normal };
    let font = ("sans-serif", size * f64::from(SCALE) * FONT_FACTOR, style).into_font();
    TextStyle { color: colour.to_backend_color(), ..TextStyle::from(font) }
}

/// The usual width of a letter, relative to the size of its font.
const LETTER: f64 = 0.58;

/// The length of a text in pixels, estimated from the usual width of letters.
pub(crate) fn length(text: &str, size: f64) -> f64 {
    LETTER * size * text.chars().count() as f64
}

/// A text shortened to a width in pixels, estimated from the usual width of letters.
pub(crate) fn shortened(text: &str, width: f64, size: f64) -> String {
    let most = (width / (LETTER * size)).floor().max(2.0) as usize;
    if text.chars().count() <= most {
        return text.to_owned();
    }
    text.chars().take(most - 1).chain(['…']).collect()
}
