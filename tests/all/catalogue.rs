//! `gumption models --effects`: the catalogue as people and programs see it.

use serde_json::{Value, json};

use crate::support::{gumption, output};

fn listed() -> Vec<Value> {
    let answer = output(&["models", "--effects", "--format", "json"]);
    let mut answer: Value = serde_json::from_str(&answer).expect("JSON");
    assert_eq!(answer["names"]["alpha"][1], "tilt");
    match answer["effects"].take() {
        Value::Array(effects) => effects,
        other => panic!("no list: {other}"),
    }
}

#[test]
fn the_page_says_all_of_every_effect() {
    let page = output(&["models", "--effects"]);
    assert!(page.lines().all(|line| line.chars().count() <= 100));
    let page = page.split_whitespace().collect::<Vec<_>>().join(" ");
    let effects = listed();
    // those of the seeds' benches that the contract names
    let wanted = [
        "spurious-x",
        "spurious-y",
        "spurious-z",
        "lateral-mode",
        "plane-resonance",
        "ac-coupling",
        "high-pass-cascade",
        "low-pass",
        "transverse-sensitivity",
        "tilt-offset",
        "rotation-offset",
        "mounting-misalignment",
        "radius-offset",
        "encoder-scale",
        "sampling-rate",
        "scale-factor",
        "background-vibration",
        "time-delay",
        "amplitude-nonlinearity",
        "offset",
    ];
    for name in wanted {
        assert!(effects.iter().any(|effect| effect["name"] == name), "{name}");
    }
    let has = |text: &Value| {
        let text = text.as_str().expect("a text");
        let text = text.split_whitespace().collect::<Vec<_>>().join(" ");
        assert!(page.contains(&text), "{text}");
    };
    for effect in &effects {
        has(&effect["name"]);
        has(&effect["about"]);
        has(&effect["source"]);
        for formula in effect["overrides"].as_object().expect("overrides").values() {
            has(formula);
        }
        for parameter in effect["parameters"].as_object().expect("parameters").values() {
            has(&parameter["distribution"]);
        }
    }
}

/// An effect of the list can be copied into a case, under another name, beside the ready-made one.
#[test]
fn listed_effects_can_be_copied_into_a_case() {
    let folder = tempfile::tempdir().expect("a folder");
    let data = "f,theta_0,radius,t,c\n5,17,170,49,7\n10,4.25,145,50,2\n";
    std::fs::write(folder.path().join("data.csv"), data).expect("written");
    let mut effects = json!({});
    let mut names = Vec::new();
    for effect in listed() {
        let name = effect["name"].as_str().expect("a name").to_owned();
        let Value::Object(mut members) = effect else { panic!("no object") };
        if members.remove("bench") != Some(json!("oscillating table")) || names.contains(&name) {
            continue;
        }
        members.remove("name");
        // the sim below has no radial mean, and names its quantities as the catalogue does
        let overrides = members["overrides"].as_object_mut().expect("overrides");
        overrides.retain(|name, _| !["a_r_mean", "a_r_peak"].contains(&name.as_str()));
        effects[format!("own {name}")] = Value::Object(members);
        names.push(name);
    }
    assert!(names.len() > 8);
    // as text, because equations stand in their order
    let case = format!(
        r#"{{
        "inputs": {{"encoder_gain": {{"distribution": "normal", "mean": 1, "std": 0.001}}}},
        "conditions": {{"f": {{"unit": "Hz"}}, "theta_0": {{"unit": "deg"}}, "radius": {{"unit": "mm"}}}},
        "equations": {{"r": "radius", "omega_0": "2*pi*f*theta_0*encoder_gain",
            "a_t": "2*pi*f*r*omega_0", "a_r": "r*omega_0^2/2"}},
        "outputs": {{"a_t": {{"unit": "m/s^2"}}, "a_r": {{"unit": "m/s^2"}}}},
        "observations": {{"file": "data.csv", "columns": {{"a_t": {{"value": "t"}}, "a_r": {{"value": "c"}}}}}},
        "effects": {effects}, "catalogue": {}}}"#,
        json!(names)
    );
    let path = folder.path().join("case.json");
    std::fs::write(&path, case).expect("written");
    gumption().arg("check").arg(&path).assert().success();
}

#[test]
fn one_effect_can_be_asked_for() {
    let page = output(&["models", "--effects", "encoder-scale"]);
    assert_eq!(page.matches("encoder-scale (oscillating table)").count(), 3);
    assert!(!page.contains("lateral-mode (inclined plane)"));
    let says = |arguments: &[&str]| {
        let refused = gumption().args(arguments).assert().code(2).stdout("");
        String::from_utf8(refused.get_output().stderr.clone()).expect("UTF-8")
    };
    let message = says(&["models", "--effects", "encoder-scal"]);
    assert!(message.contains("did you mean `encoder-scale`?"), "{message}");
    for arguments in [
        &["models", "--effects", "--format", "csv"][..],
        &["models", "--format", "json"],
        &["models", "inclined-plane", "--template", "--effects"],
    ] {
        assert!(!says(arguments).is_empty());
    }
}
