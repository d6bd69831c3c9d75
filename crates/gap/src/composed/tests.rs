use gumption_units::Unit;

/// Differences of Celsius temperatures are in kelvin, and sizes are in units that add.
#[test]
fn differences_have_units_of_their_own() {
    let of = |text: &str| super::target::of_differences(&Unit::parse(text).unwrap());
    assert_eq!(of("degC").text(), "K");
    assert_eq!(of("mV").text(), "mV");
    assert_eq!(of("dBm").text(), "dB");
}
