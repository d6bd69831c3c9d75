//! Running text in LaTeX: every character is literal and compiles, whatever a user wrote.

/// A text on one line. Exponents as in `m/s^2` are raised; characters that the usual fonts do not
/// have are written as codes.
pub(super) fn escaped(text: &str) -> String {
    let words = text.split_whitespace().collect::<Vec<_>>().join(" ");
    if words == "-" {
        return "--".to_owned();
    }
    let letters: Vec<char> = words.chars().collect();
    let mut out = String::with_capacity(words.len());
    let mut place = 0;
    let mut unbroken = 0;
    while let Some(&letter) = letters.get(place) {
        place += 1;
        // a line may break within a text as long as a digest
        unbroken = if letter.is_ascii_alphanumeric() { unbroken + 1 } else { 0 };
        if unbroken > UNBROKEN && unbroken % 8 == 1 {
            out += "\\allowbreak{}";
        }
        if letter == '^' {
            let power = exponent(letters.get(place..).unwrap_or_default());
            place += power.chars().count();
            out += &match power.strip_prefix('-') {
                _ if power.is_empty() => "\\textasciicircum{}".to_owned(),
                Some(digits) => format!("$^{{-{digits}}}$"),
                None => format!("$^{{{power}}}$"),
            };
        } else {
            out += &character(letter);
        }
    }
    out
}

/// Number of letters and digits that stay on one line.
const UNBROKEN: usize = 24;

/// The whole number that an exponent begins with.
fn exponent(letters: &[char]) -> String {
    let sign = usize::from(letters.first() == Some(&'-'));
    let digits = letters.iter().skip(sign).take_while(|c| c.is_ascii_digit()).count();
    if digits == 0 { String::new() } else { letters.iter().take(sign + digits).collect() }
}

fn character(letter: char) -> String {
    let known = match letter {
        '\\' => "\\textbackslash{}",
        '{' => "\\{",
        '}' => "\\}",
        '$' => "\\$",
        '&' => "\\&",
        '#' => "\\#",
        '%' => "\\%",
        '_' => "\\_",
        '~' => "\\textasciitilde{}",
        '<' => "$<$",
        '>' => "$>$",
        '|' => "$|$",
        '"' => "{''}",
        '`' => "\\textasciigrave{}",
        '[' => "{[}",
        ']' => "{]}",
        '±' => "$\\pm$",
        '×' => "$\\times$",
        '·' | '⋅' => "$\\cdot$",
        '−' => "$-$",
        '≤' => "$\\leq$",
        '≥' => "$\\geq$",
        '≠' => "$\\neq$",
        '≈' => "$\\approx$",
        '√' => "$\\sqrt{\\ }$",
        '∞' => "$\\infty$",
        '°' => "$^\\circ$",
        'µ' => "$\\mu$",
        'Ω' => "$\\Omega$",
        '²' => "$^2$",
        '³' => "$^3$",
        '¹' => "$^1$",
        '½' => "$1/2$",
        '′' => "$'$",
        '″' => "$''$",
        '‰' => "\\textperthousand{}",
        '–' => "--",
        '—' => "---",
        '…' => "\\ldots{}",
        '‘' => "`",
        '’' => "'",
        '“' => "``",
        '”' => "''",
        'ß' => "\\ss{}",
        'æ' => "\\ae{}",
        'Æ' => "\\AE{}",
        'ø' => "\\o{}",
        'Ø' => "\\O{}",
        'å' => "\\aa{}",
        'Å' => "\\AA{}",
        _ => "",
    };
    if !known.is_empty() {
        return known.to_owned();
    }
    match letter {
        ' '..='~' => letter.to_string(),
        _ => greek(letter).or_else(|| accented(letter)).unwrap_or_else(|| {
            let code = u32::from(letter);
            format!("{{[}}U+{code:04X}{{]}}")
        }),
    }
}

/// A Greek letter.
fn greek(letter: char) -> Option<String> {
    const SMALL: [&str; 25] = [
        "alpha", "beta", "gamma", "delta", "epsilon", "zeta", "eta", "theta", "iota", "kappa",
        "lambda", "mu", "nu", "xi", "", "pi", "rho", "varsigma", "sigma", "tau", "upsilon", "phi",
        "chi", "psi", "omega",
    ];
    const LARGE: [(char, &str); 11] = [
        ('Γ', "Gamma"),
        ('Δ', "Delta"),
        ('Θ', "Theta"),
        ('Λ', "Lambda"),
        ('Ξ', "Xi"),
        ('Π', "Pi"),
        ('Σ', "Sigma"),
        ('Υ', "Upsilon"),
        ('Φ', "Phi"),
        ('Ψ', "Psi"),
        ('Ω', "Omega"),
    ];
    const LIKE_LATIN: [(char, char); 15] = [
        ('Α', 'A'),
        ('Β', 'B'),
        ('Ε', 'E'),
        ('Ζ', 'Z'),
        ('Η', 'H'),
        ('Ι', 'I'),
        ('Κ', 'K'),
        ('Μ', 'M'),
        ('Ν', 'N'),
        ('Ο', 'O'),
        ('Ρ', 'P'),
        ('Τ', 'T'),
        ('Χ', 'X'),
        ('ο', 'o'),
        ('ϕ', 'f'),
    ];
    if letter == 'ϕ' {
        return Some("$\\phi$".to_owned());
    }
    if ('α'..='ω').contains(&letter) && letter != 'ο' {
        let place = u32::from(letter) - u32::from('α');
        return SMALL.get(place as usize).map(|name| format!("$\\{name}$"));
    }
    let large = LARGE.iter().find(|(c, _)| *c == letter).map(|(_, name)| format!("$\\{name}$"));
    large.or_else(|| LIKE_LATIN.iter().find(|(c, _)| *c == letter).map(|(_, c)| format!("${c}$")))
}

/// A Latin letter with an accent.
fn accented(letter: char) -> Option<String> {
    const ACCENTS: [(&str, &str, &str); 7] = [
        ("\\`", "ÀÈÌÒÙàèìòù", "AEIOUaeiou"),
        ("\\'", "ÁÉÍÓÚÝáéíóúýĆćŃńŚśŹź", "AEIOUYaeiouyCcNnSsZz"),
        ("\\^", "ÂÊÎÔÛâêîôû", "AEIOUaeiou"),
        ("\\\"", "ÄËÏÖÜäëïöüÿ", "AEIOUaeiouy"),
        ("\\~", "ÃÑÕãñõ", "ANOano"),
        ("\\c", "Çç", "Cc"),
        ("\\v", "ČčŘřŠšŽžĚě", "CcRrSsZzEe"),
    ];
    ACCENTS.iter().find_map(|(command, with, plain)| {
        let (_, base) = with.chars().zip(plain.chars()).find(|(c, _)| *c == letter)?;
        Some(format!("{command}{{{base}}}"))
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_character_stands_for_itself() {
        assert_eq!(escaped(r"50 % of a_x & \b{c}"), r"50 \% of a\_x \& \textbackslash{}b\{c\}");
        assert_eq!(escaped("kg*m^-3 and x^y"), r"kg*m$^{-3}$ and x\textasciicircum{}y");
        assert_eq!(escaped("Δα = 1 µm, ∞"), r"$\Delta$$\alpha$ = 1 $\mu$m, $\infty$");
        assert_eq!(escaped("Prüfling, Škoda"), "Pr\\\"{u}fling, \\v{S}koda");
        assert_eq!(escaped("温\u{7}度"), "{[}U+6E29{]}{[}U+0007{]}{[}U+5EA6{]}");
        assert_eq!(escaped("-"), "--");
    }

    #[test]
    fn digests_may_be_broken() {
        let digest = "0123456789abcdef".repeat(4);
        let broken = escaped(&digest);
        assert_eq!(broken.replace("\\allowbreak{}", ""), digest);
        // pieces of eight after the first 24
        assert_eq!(broken.matches("\\allowbreak{}").count(), 5);
        assert_eq!(escaped("electroencephalographical"), "electroencephalographica\\allowbreak{}l");
        assert_eq!(escaped("a calibration certificate"), "a calibration certificate");
    }
}
