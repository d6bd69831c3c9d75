//! A departure that no candidate makes, in words and in JSON.

use super::{diagnosis, json, unexplained};

#[test]
fn a_departure_is_told_in_words() {
    let page = crate::gap::table(&unexplained()).replace('\n', " ");
    for wanted in [
        "What the departure looks like",
        "With probability 0.912: a_x departs by what is a share of its sim, stepping down over f near \
         71.5 Hz, over a factor of 3.5 of it; root mean square 1.2 %, beside delay.",
        "With probability 0.068: a_x and ratio depart by what is added to the sim, rising with the \
         sim's own value, each in its own way, over a length of 4.6 m/s^2; root mean square 0.12 m/s^2.",
    ] {
        assert!(page.contains(wanted), "{wanted}\n{page}");
    }
    assert!(!crate::gap::table(&diagnosis()).contains("What the departure looks like"));
}

#[test]
fn a_departure_is_in_the_answer() {
    let answer = json(&unexplained());
    let first = &answer["departure"][0];
    assert_eq!(first["outputs"][0], "a_x");
    assert_eq!(first["kind"], "proportional");
    assert_eq!(first["over"], "f");
    assert_eq!(first["shape"], "step");
    assert_eq!(first["scale"], 3.456);
    assert_eq!(first["probability"], 0.912_345);
    assert_eq!(answer["departure"][1]["over"], "value");
    // where everything is explained nothing is said
    assert!(json(&diagnosis()).get("departure").is_none());
}
