//! Keys that other programs call by another name. The spelling alone would suggest no key, or a
//! wrong one.

/// The key that is meant by an unknown one.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct OtherName {
    /// The key that takes it.
    pub key: &'static str,
    /// Whether the value can stay as it is.
    pub is_same: bool,
    /// An explanation, as a part of a sentence.
    pub said: &'static str,
}

/// The names, each with the key that must be known in the object for the name to mean it.
const OTHER_NAMES: [(&[&str], OtherName); 10] = [
    (
        &["width", "full_width", "range", "span"],
        OtherName {
            key: "half_width",
            is_same: false,
            said: "a full width is given by its half, as the key `half_width`",
        },
    ),
    (
        &["U", "expanded_uncertainty"],
        OtherName {
            key: "expanded",
            is_same: true,
            said: "an expanded uncertainty is the key `expanded`, beside `k` or `p`",
        },
    ),
    (
        &["u", "sd", "sigma", "stdev", "standard_uncertainty", "standard_deviation"],
        OtherName { key: "std", is_same: true, said: "a standard uncertainty is the key `std`" },
    ),
    (
        &["value", "estimate"],
        OtherName { key: "mean", is_same: true, said: "the estimate is the key `mean`" },
    ),
    (
        &["mean", "estimate"],
        OtherName { key: "value", is_same: true, said: "the estimate is the key `value`" },
    ),
    (
        &["nominal", "deviation", "plus_minus", "half_width", "width", "limit", "limits"],
        OtherName {
            key: "lower",
            is_same: false,
            said: "limits are the keys `lower` and `upper`, in the output's unit",
        },
    ),
    (
        &["k", "K", "coverage"],
        OtherName {
            key: "coverage_factor",
            is_same: true,
            said: "the coverage factor of the results is the key `coverage_factor`",
        },
    ),
    (
        &["p", "probability", "confidence", "confidence_level", "level_of_confidence"],
        OtherName {
            key: "coverage_probability",
            is_same: true,
            said: "the coverage probability of the results is the key `coverage_probability`",
        },
    ),
    (
        &["degrees_of_freedom", "nu", "veff", "v_eff", "nu_eff"],
        OtherName { key: "dof", is_same: true, said: "degrees of freedom are the key `dof`" },
    ),
    (
        &["samples", "iterations", "draws", "M", "runs"],
        OtherName {
            key: "trials",
            is_same: true,
            said: "the number of Monte Carlo trials is the key `trials`",
        },
    ),
];

/// The key that is meant by `key`, which is not among the `known` ones.
pub fn other_name(key: &str, known: &[&str]) -> Option<OtherName> {
    let is_meant = |names: &[&str], of: &OtherName| {
        // limits of inputs replace their half-width
        let has_half = known.contains(&"half_width") && of.key == "lower";
        names.contains(&key) && known.contains(&of.key) && !known.contains(&key) && !has_half
    };
    OTHER_NAMES.into_iter().find(|(names, of)| is_meant(names, of)).map(|(_, of)| of)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_by_what_is_known_beside_them() {
        let said = |key: &str, known: &[&str]| other_name(key, known).map(|of| of.key);
        assert_eq!(said("width", &["mean", "half_width", "lower"]), Some("half_width"));
        assert_eq!(said("width", &["lower", "upper", "prior"]), Some("lower"));
        assert_eq!(said("U", &["mean", "std", "expanded"]), Some("expanded"));
        assert_eq!(said("value", &["mean", "std"]), Some("mean"));
        assert_eq!(said("mean", &["value"]), Some("value"));
        assert_eq!(said("value", &["value", "mean"]), None);
        assert_eq!(said("nominal", &["lower", "upper"]), Some("lower"));
        assert_eq!(said("U", &["title"]), None);
        assert_eq!(said("k", &["title", "coverage_factor"]), Some("coverage_factor"));
        assert_eq!(said("k", &["expanded", "k", "dof"]), None);
        assert_eq!(said("nu", &["std", "dof"]), Some("dof"));
    }
}
