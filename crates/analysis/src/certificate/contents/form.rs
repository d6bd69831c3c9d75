//! The form of a certificate: languages, texts in several of them, rounding rules.

/// A language of a certificate.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Language {
    /// English.
    English,
    /// German.
    German,
    /// Italian.
    Italian,
    /// French.
    French,
}

impl Language {
    /// All of them.
    pub const ALL: [Self; 4] = [Self::English, Self::German, Self::Italian, Self::French];

    /// The code of ISO 639-1, two lower case letters.
    pub fn code(self) -> &'static str {
        match self {
            Self::English => "en",
            Self::German => "de",
            Self::Italian => "it",
            Self::French => "fr",
        }
    }

    /// The usual decimal mark of the language.
    pub fn decimal_mark(self) -> DecimalMark {
        match self {
            Self::English => DecimalMark::Point,
            Self::German | Self::Italian | Self::French => DecimalMark::Comma,
        }
    }

    /// The language of that code.
    pub fn of_code(code: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|language| language.code() == code)
    }
}

/// The mark between the integer part of a number and its decimals (ISO 80000-1 allows both).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum DecimalMark {
    /// A point: 0.5.
    Point,
    /// A comma: 0,5.
    Comma,
}

impl DecimalMark {
    /// Both of them.
    pub const ALL: [Self; 2] = [Self::Point, Self::Comma];

    /// The name that files use.
    pub fn name(self) -> &'static str {
        match self {
            Self::Point => "point",
            Self::Comma => "comma",
        }
    }

    /// The mark of that name.
    pub fn named(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|mark| mark.name() == name)
    }
}

/// A text, the same in all languages or one for each.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Localized {
    /// The texts, each with its language or for all of them.
    pub texts: Vec<(Option<Language>, String)>,
}

impl Localized {
    /// A text that is the same in all languages.
    pub fn plain(text: impl Into<String>) -> Self {
        Self { texts: vec![(None, text.into())] }
    }

    /// The text in a language, or in another language if it is missing.
    pub fn get(&self, language: Language) -> &str {
        let own = self.texts.iter().find(|(of, _)| of.is_none_or(|of| of == language));
        own.or(self.texts.first()).map_or("", |(_, text)| text)
    }

    /// The text in these languages, without repetitions.
    pub fn all(&self, languages: &[Language]) -> Vec<&str> {
        let mut texts: Vec<&str> = Vec::new();
        for text in languages.iter().map(|language| self.get(*language)) {
            if !texts.contains(&text) {
                texts.push(text);
            }
        }
        texts
    }

    /// Whether there is no text.
    pub fn is_empty(&self) -> bool {
        self.texts.iter().all(|(_, text)| text.trim().is_empty())
    }
}

/// How an expanded uncertainty is rounded to the digits of a certificate.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Rounding {
    /// To the nearest, a half up (JCGM 100, 7.2.6).
    #[default]
    Nearest,
    /// To the nearest, but up if that would reduce U by more than 5 % (EA-4/02 M:2022, 6.3).
    Ea,
    /// Always up.
    Up,
}

impl Rounding {
    /// All of them.
    pub const ALL: [Self; 3] = [Self::Nearest, Self::Ea, Self::Up];

    /// The name that files use.
    pub fn name(self) -> &'static str {
        match self {
            Self::Nearest => "nearest",
            Self::Ea => "ea",
            Self::Up => "up",
        }
    }

    /// The rule of that name.
    pub fn named(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|rule| rule.name() == name)
    }
}
