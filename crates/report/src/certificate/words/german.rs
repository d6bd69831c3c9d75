//! German.

use super::Words;

pub(super) const WORDS: Words = Words {
    title: "Kalibrierschein",
    number: "Kalibrierscheinnummer",
    device: "Gegenstand",
    manufacturer: "Hersteller",
    model: "Typ",
    condition: "Zustand bei Eingang",
    serial_number: "Seriennummer",
    customer_number: "Nummer des Auftraggebers",
    customer: "Auftraggeber",
    laboratory: "Laboratorium",
    accreditation: "Akkreditierung",
    code: "Laborkennzeichen",
    responsible: "Verantwortlich",
    calibrated: "Datum der Kalibrierung",
    period: "{first} bis {last}",
    received: "Eingangsdatum",
    issued: "Ausstellungsdatum",
    place: "Ort der Kalibrierung",
    places: [
        "Laboratorium",
        "beim Auftraggeber",
        "Zweigstelle des Laboratoriums",
        "Zweigstelle des Auftraggebers",
        "an anderem Ort",
    ],
    environment: "Umgebungsbedingungen",
    method: "Verfahren",
    traceability: "Metrologische Rückführung",
    remarks: "Bemerkungen",

    results: "Messergebnisse",
    row: "Zeile",
    quantity: "Größe",
    conditions: "Bedingungen",
    nominal: "Nennwert",
    value: "Wert",
    expanded: "U",
    unit: "Einheit",
    in_unit: "in {unit}",
    limits_heading: "Grenzen",
    probability: "p in %",
    low: "von",
    high: "bis",

    uncertainty: "Messunsicherheit",
    rows: ["Zeile {rows}: ", "Zeilen {rows}: "],
    and: " und ",
    normal: "Die erweiterte Messunsicherheit U ist die Standardmessunsicherheit, multipliziert mit dem \
        Erweiterungsfaktor k = {k}, der bei einer Normalverteilung einer \
        Überdeckungswahrscheinlichkeit von {p} entspricht.",
    student: "Die erweiterte Messunsicherheit U ist die Standardmessunsicherheit, multipliziert \
        mit dem jeweils angegebenen Erweiterungsfaktor k, der bei einer t-Verteilung mit den \
        effektiven Freiheitsgraden ν_eff einer Überdeckungswahrscheinlichkeit von {p} entspricht.",
    fixed: "Die erweiterte Messunsicherheit U ist die Standardmessunsicherheit, multipliziert mit dem \
        vereinbarten Erweiterungsfaktor k = {k}. Es wird keine Verteilung vorausgesetzt und daher keine \
        Überdeckungswahrscheinlichkeit angegeben.",
    agreed: "Die erweiterte Messunsicherheit U ist die Standardmessunsicherheit, multipliziert \
        mit dem vereinbarten Erweiterungsfaktor k = {k}. Die jeweils angegebene \
        Überdeckungswahrscheinlichkeit folgt aus der t-Verteilung mit den effektiven \
        Freiheitsgraden ν_eff.",
    shortest: "Das angegebene Überdeckungsintervall ist das kürzeste mit einer \
        Überdeckungswahrscheinlichkeit von {p}, ermittelt mit dem Monte-Carlo-Verfahren (JCGM 101:2008). \
        U ist der größere Abstand des Werts von einem Endpunkt des Intervalls; k = U/u.",
    without_trials: "Das angegebene Überdeckungsintervall hat eine Überdeckungswahrscheinlichkeit von \
        {p}. Es wurde durch Fortpflanzung der Verteilungen (JCGM 101:2008, Abschnitt 5) ohne \
        Zufallsversuche ermittelt. Es ist das kürzeste Intervall oder das symmetrische, wenn dieses um \
        weniger als 1 % länger ist. U ist der größere Abstand des Werts von einem Endpunkt des \
        Intervalls; k = U/u.",
    propagation: "Die Standardmessunsicherheit wurde nach dem Fortpflanzungsgesetz der \
        Messunsicherheit (JCGM 100:2008) ermittelt, wie EA-4/02 M:2022 es verlangt.",
    time: "Die angegebenen Messunsicherheiten enthalten nicht die Langzeitstabilität des Gegenstands.",
    confirmed: "Das Monte-Carlo-Verfahren (JCGM 101:2008, Abschnitt 8) bestätigt diese Intervalle.",
    rounding: "U ist auf {digits} angegeben ({rule}); der Wert ist auf dieselbe Stelle gerundet.",
    rules: [
        "kaufmännisch gerundet",
        "kaufmännisch gerundet; aufgerundet, wenn U sonst um mehr als 5 % kleiner würde, EA-4/02 M:2022",
        "aufgerundet",
    ],
    kept: "U ist aufgerundet, da es sonst unter der kleinsten angebbaren Messunsicherheit (CMC) des \
        Laboratoriums läge.",
    digits: ["eine signifikante Stelle", "{digits} signifikante Stellen"],
    raised: [
        "Die ermittelte erweiterte Messunsicherheit ist kleiner als die kleinste angebbare \
            Messunsicherheit (CMC) des Laboratoriums; diese ist stattdessen als U angegeben \
            (ILAC-P14:09/2020), {factor}. Das Intervall von Wert - U \
            bis Wert + U hat eine Überdeckungswahrscheinlichkeit von mindestens {p}.",
        "Die ermittelte erweiterte Messunsicherheit ist kleiner als die kleinste angebbare \
            Messunsicherheit (CMC) des Laboratoriums; diese ist stattdessen als U angegeben \
            (ILAC-P14:09/2020), {factor}.",
    ],
    of_capability: [
        "mit ihrem Erweiterungsfaktor k = {k}",
        "von ihrem Erweiterungsfaktor 2 auf k = {k} umgerechnet",
    ],
    dof_list: "Effektive Freiheitsgrade ν_eff: {list}.",
    approximately: "annähernd {p}",

    function: "Kalibrierfunktion {name}",
    in_range: "{equation} für {low} ≤ x ≤ {high}, mit x und {name} als Zahlen in den angegebenen Einheiten.",
    band: "U ist die erweiterte Messunsicherheit der Funktion an der Stelle x mit dem Erweiterungsfaktor \
        k = {k}; die Messunsicherheit einer weiteren Ablesung ist nicht enthalten. Zwischen den \
        angegebenen Werten von x folgt sie aus u(x)² = g(x)' V g(x). g sind die Ableitungen nach den \
        Parametern; V ist deren Kovarianzmatrix aus ihren Standardmessunsicherheiten und \
        Korrelationskoeffizienten r.",
    parameter: "Parameter",
    standard: "u",
    region: "Überdeckungsbereich",
    ellipsoid: "Ellipsoid (y - x)' U⁻¹ (y - x) ≤ k²",
    cuboid: "Quader mit den halben Kantenlängen k u",
    smallest: "kleinster Bereich der Versuche: Volumen {volume}",
    measurement: "Modell der Messung",
    equation: "Gleichung",
    symbol: "Formelzeichen",
    meaning: "Bedeutung",
    correlation: "Korrelation der Zeilen",
    correlated: "Zeilen mit gemeinsamen Eingangsgrößen sind korreliert. Die Standardmessunsicherheit der \
        Differenz der Zeilen i und j folgt aus u² = u_i² + u_j² - 2 r u_i u_j mit den hier angegebenen \
        Standardmessunsicherheiten u_i und u_j und dem Koeffizienten r. Sie folgen aus dem \
        Fortpflanzungsgesetz; U_i / k_i kann davon abweichen.",
    correlated_raised: "Wenn U die kleinste angebbare Messunsicherheit des Laboratoriums ist, ist sie in \
        u_i enthalten; ihr Zuschlag zur ermittelten Messunsicherheit gilt als unkorreliert mit den \
        anderen Zeilen.",
    shared: "Gemeinsam haben die Zeilen: {inputs}.",
    many: "Einige der {rows} Zeilen haben gemeinsame Eingangsgrößen; die Korrelationskoeffizienten und \
        die zugehörigen Standardmessunsicherheiten stehen in der JSON-Ausgabe und in der Arbeitsmappe.",
    conformity: "Konformität",
    decided: ["konform", "nicht konform", "nicht nachgewiesen"],
    decisions: [
        "Das Ergebnis hält die Toleranz {limits} ein: konform.",
        "Das Ergebnis hält die Toleranz {limits} nicht ein: nicht konform.",
    ],
    not_shown: [
        "Es ist nicht nachgewiesen, dass das Ergebnis die Toleranz {limits} einhält: Es liegt innerhalb \
            der Toleranz, aber außerhalb der Annahmegrenzen. Nach der Entscheidungsregel wird es \
            zurückgewiesen.",
        "Es ist nicht nachgewiesen, dass das Ergebnis die Toleranz {limits} einhält: Es liegt innerhalb \
            der Toleranz, aber die Entscheidungsregel nimmt keinen Wert an. Das Ergebnis wird \
            zurückgewiesen.",
    ],
    levels: ["konform", "bedingt konform", "bedingt nicht konform", "nicht konform"],
    level_decisions: [
        "Konform: Das Ergebnis hält die Toleranz {limits} ein und liegt innerhalb der Annahmegrenzen.",
        "Bedingt konform: Das Ergebnis liegt innerhalb der Toleranz {limits}, aber im Sicherheitsband.",
        "Bedingt nicht konform: Das Ergebnis liegt außerhalb der Toleranz {limits}, um höchstens das Sicherheitsband.",
        "Nicht konform: Das Ergebnis liegt um mehr als das Sicherheitsband außerhalb der Toleranz {limits}.",
    ],
    limits: ["von {low} bis {high}{unit}", "ab {low}{unit}", "bis {high}{unit}"],
    conforming: "Der Wert ist mit einer Wahrscheinlichkeit von {p} konform.",
    all_the_same: "Spezifisches Risiko, dass der zurückgewiesene Wert konform ist: {p}.",
    unrounded: "Die Entscheidung beruht auf dem Wert vor der Rundung, {value}.",
    with_prior: "Diese Wahrscheinlichkeit berücksichtigt das Vorwissen über solche Gegenstände (JCGM \
        106:2012, 6.3 und 7.1): {prior}. Aus dem Messwert und seiner Unsicherheit allein beträgt sie {p}.",
    prior: "Verteilung `{shape}` mit Mittelwert {mean} und Standardabweichung {std}",
    global_risks: "Globale Risiken mit diesem Vorwissen und diesen Annahmegrenzen: irrtümliche \
        Annahme {a} %, irrtümliche Rückweisung {b} %.",
    percent: ["{p} %", "mehr als {p} %", "weniger als {p} %"],
    simple: "Entscheidungsregel: einfache Annahme (JCGM 106:2012, 8.2).",
    multiple: "Entscheidungsregel: Annahme mit einem Sicherheitsband von {band} \
        ({clause}), mit U vor der Rundung; Sicherheitsband {guard}, angenommen {limits}.",
    too_wide: "Entscheidungsregel: Annahme mit einem Sicherheitsband von {band} \
        ({clause}), mit U vor der Rundung; Sicherheitsband {guard}, mehr als die halbe Toleranz: kein Wert wird \
        angenommen.",
    no_band: "Entscheidungsregel: Annahme mit einem Sicherheitsband von {band} ({clause}), mit U vor der \
        Rundung; U ist mehr als die halbe Toleranz: kein Wert wird angenommen.",
    of_rule: [
        "{rule}; T: halbe Toleranz",
        "{rule}; T: halbe Toleranz; U mit k = {k}, die Regel gilt für U mit etwa 95 %",
    ],
    of_ilac_g8: [
        "ILAC-G8:09/2019, 4.2.2",
        "U mit k = {k}; ILAC-G8:09/2019, 4.2.2, legt das Sicherheitsband für U mit etwa 95 % fest",
    ],
    rule_agreed: "Die Entscheidungsregel ist mit dem Kunden vereinbart.",
    specification: "Spezifikation: {name}.",
    guarded: "Entscheidungsregel: Annahme mit Sicherheitsband (JCGM 106:2012, 8.3) für {kind} von \
        höchstens {risk} %; Sicherheitsband {guard}, angenommen {limits}.",
    never: "Entscheidungsregel: Annahme mit Sicherheitsband (JCGM 106:2012, 8.3) für {kind} von höchstens \
        {risk} %; kein Wert hat ein so kleines Risiko.",
    kinds: [
        "ein spezifisches Risiko der irrtümlichen Annahme",
        "ein globales Risiko der irrtümlichen Annahme",
    ],

    page: "Seite {page} von {pages}",
    end: "Ende des Kalibrierscheins",
    signed: ["Ort, Datum", "Unterschrift"],
    relates: "Die Ergebnisse beziehen sich nur auf den kalibrierten Gegenstand.",
    copies: "Dieser Kalibrierschein darf ohne Genehmigung des Laboratoriums nur vollständig vervielfältigt werden.",
    provenance: "Herkunft",
    program: "Programm",
    certificate_file: "Kalibrierscheindatei, SHA-256",
    certificate_name: "Kalibrierscheindatei",
    model_file: "Modelldatei",
    table: "Tabelle",
    seed: "Startwert",
    trials: "Monte-Carlo-Versuche",
    adaptive: "adaptiv",

    nominal_value: "Nennwert",
    measured_value: "Messwert",
    coverage_interval: "Überdeckungsintervall",
    files: "Dateien der Auswertung",
    answer: "Ergebnis",
};
