//! Names of values in the answer.

use serde_json::Value;

/// The name of the value at a path of the answer: `gum.interval[0]` is the lower endpoint of the
/// GUM interval.
pub fn words(path: &str, answer: &Value) -> String {
    if let Some(pair) = correlated(path, answer) {
        return format!("correlation of {} and {}", pair[0], pair[1]);
    }
    let (method, figure) = path.split_once('.').unwrap_or(("", path));
    let (name, end) = match figure.strip_suffix("[0]") {
        Some(name) => (name, ", from"),
        None => figure.strip_suffix("[1]").map_or((figure, ""), |name| (name, ", to")),
    };
    let name = match name {
        "dof" => "degrees of freedom".to_owned(),
        name => name.replace('_', " "),
    };
    let method = match method {
        "gum" => "GUM ",
        "monte_carlo" => "Monte Carlo ",
        _ => "",
    };
    format!("{method}{name}{end}")
}

/// The two outputs of a correlation coefficient.
fn correlated(path: &str, answer: &Value) -> Option<[String; 2]> {
    let place = path.strip_prefix("output_correlations[")?.split(']').next()?;
    let triple = answer.get("output_correlations")?.get(place.parse::<usize>().ok()?)?;
    let name = |i: usize| Some(triple.get(i)?.as_str()?.to_owned());
    Some([name(0)?, name(1)?])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn figures() {
        let answer = serde_json::json!({"output_correlations": [["r", "x", 0.5]]});
        let words = |path| words(path, &answer);
        assert_eq!(words("gum.interval[0]"), "GUM interval, from");
        assert_eq!(words("gum.dof"), "GUM degrees of freedom");
        assert_eq!(
            words("monte_carlo.symmetric_interval[1]"),
            "Monte Carlo symmetric interval, to"
        );
        assert_eq!(words("output_correlations[0][2]"), "correlation of r and x");
        assert_eq!(words("output_correlations[9][2]"), "output correlations[9][2]");
    }
}
