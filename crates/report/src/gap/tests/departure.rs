//! A departure that no candidate makes, in words and in JSON.

use super::{diagnosis, json, provenance, unexplained, with_something_beside};

#[test]
fn a_departure_is_told_in_words() {
    let page = crate::gap::table(&unexplained(), &provenance()).replace('\n', " ");
    for wanted in [
        "Form of the departure",
        "With probability 0.912: a_x departs by a share of the sim, stepping down over f near 71.5 Hz, \
         over a factor of 3.5 of it; root mean square 1.2 %, beside delay.",
        "With probability 0.068: a_x and ratio depart by an added term, rising with the sim's own \
         value, different in each, over a length of 4.6 m/s^2; root mean square 0.12 m/s^2.",
    ] {
        assert!(page.contains(wanted), "{wanted}\n{page}");
    }
    assert!(!crate::gap::table(&diagnosis(), &provenance()).contains("Form of the departure"));
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

#[test]
fn what_is_left_beside_the_effects_is_in_the_headline() {
    let page = crate::gap::table(&with_something_beside(), &provenance()).replace('\n', " ");
    for wanted in [
        "There is a gap. low-pass and delay are present (probability 0.988) and explain 97 % of it. \
         Something else remains (probability 0.977, 2 % of the gap): a_x and ratio depart by an \
         added term, rising with the sim's own value",
        "low-pass 91 %, delay 6 %, unnamed discrepancy 2 %, noise 1 %.",
        "low-pass + delay, and something beside",
    ] {
        assert!(page.contains(wanted), "{wanted}\n{page}");
    }
}

#[test]
fn what_is_left_beside_the_effects_is_in_the_answer() {
    let answer = json(&with_something_beside());
    let beside = &answer["verdict"]["beside"];
    assert_eq!(answer["verdict"]["kind"], "explained");
    assert_eq!(beside["probability"], 0.976_543);
    assert_eq!(beside["over"], "value");
    assert_eq!(beside["shape"], "rising");
    assert_eq!(beside["share_of_gap"], 0.023_456);
    assert!(beside["words"].as_str().unwrap().ends_with("beside low-pass and delay"));
    assert_eq!(answer["hypotheses"][0]["beside"], false);
    assert_eq!(answer["hypotheses"][1]["beside"], true);
    let shares = answer["shrinks"]["shares"].as_array().unwrap();
    let names: Vec<&str> = shares.iter().map(|of| of["what"].as_str().unwrap()).collect();
    assert_eq!(names, ["low-pass", "delay", "departure", "noise"]);
    assert!(json(&diagnosis())["verdict"]["beside"].is_null());
}
