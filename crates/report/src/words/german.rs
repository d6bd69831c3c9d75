//! German.

use super::Sentences;

/// The sentences of all rooms.
pub(super) const ROOMS: [Sentences; 6] = [EVALUATION, FORMULAS, FILES, SIGNALS, GAP, COMMANDS];

/// Facts of the engine about an evaluation.
#[rustfmt::skip]
const EVALUATION: Sentences = &[
    ("few-trials", "{trials} Versuche sind wenige für die Überdeckungswahrscheinlichkeit {probability}: JCGM \
        101, 7.2.2 rät zu mindestens {needed}"),
    ("correlations-rounded", "die angegebenen Korrelationskoeffizienten sind nur innerhalb ihrer Rundung \
        möglich; in den Versuchen stehen die nächsten möglichen"),
    ("correlations-rounded.output", "`{name}`: Die angegebenen Korrelationskoeffizienten lassen nach dem \
        Fortpflanzungsgesetz keine Varianz oder eine unter null, die nächsten möglichen aber doch; die Angaben \
        der Monte-Carlo-Methode sind zu nehmen oder die Koeffizienten mit mehr Stellen anzugeben"),
    ("undefined-trials", "{count} von {trials} Versuchen sind nicht endlich und wurden weggelassen"),
    ("gaussian-copula", "{names} werden durch eine Gauß-Copula gezogen, die so angepasst ist, dass sie ihre \
        Verteilungen und die angegebenen Korrelationskoeffizienten haben; mehr sagen die Koeffizienten über \
        ihre gemeinsame Verteilung nicht, so dass dies eine Annahme ist"),
    ("copula-adjusted", "eine Gauß-Copula gibt die angegebenen Korrelationskoeffizienten nur innerhalb ihrer \
        Rundung; in den Versuchen weichen sie um bis zu {difference} ab"),
    ("copula-adjusted.results", "eine Gauß-Copula gibt die Korrelationskoeffizienten dieser gespeicherten \
        Ergebnisse nur ungefähr; in den Versuchen weichen sie um bis zu {difference} ab. Wo sich Größen eines \
        Ergebnisses fast aufheben, ist das Ganze in einem Modell auszuwerten"),
    ("trials-off", "`{name}`: Angaben der Versuche liegen weiter von denen ohne ihr Rauschen als {errors} \
        numerische Standardfehler: {far}"),
    ("moved", "{figure} um {by}"),
    ("figure.estimate", "der Schätzwert"),
    ("figure.standard-uncertainty", "die Standardunsicherheit"),
    ("figure.median", "der Median"),
    ("figure.inside", "die Wahrscheinlichkeit innerhalb der Toleranz"),
    ("figure.symmetric-lower", "das untere Ende des symmetrischen Intervalls"),
    ("figure.symmetric-upper", "das obere Ende des symmetrischen Intervalls"),
    ("figure.shortest-lower", "das untere Ende des kürzesten Intervalls"),
    ("figure.shortest-upper", "das obere Ende des kürzesten Intervalls"),
    ("raised-to-cmc", "die erweiterte Unsicherheit von `{name}` liegt unter der Messmöglichkeit (CMC) des \
        Laboratoriums von {cmc} und wird auf sie angehoben: Anzugeben ist {expanded}"),
    ("raised-to-cmc.rows", "die erweiterte Unsicherheit von `{name}` liegt in {count} von {of} Zeilen unter \
        der Messmöglichkeit (CMC) des Laboratoriums und wird dort auf sie angehoben"),
    ("below-cmc", "die erweiterte Unsicherheit von `{name}` ist {expanded}, liegt unter der Messmöglichkeit \
        (CMC) des Laboratoriums von {cmc} und darf nicht angegeben werden (ILAC-P14)"),
    ("below-cmc.rows", "die erweiterte Unsicherheit von `{name}` liegt in {count} von {of} Zeilen unter der \
        Messmöglichkeit (CMC) des Laboratoriums und darf dort nicht angegeben werden (ILAC-P14)"),
    ("at", " bei {conditions}"),
    ("condition", "{name} = {value}"),
    ("gum-undefined", "`{name}`{at}: Der Schätzwert oder ein Empfindlichkeitskoeffizient ist bei den \
        Schätzwerten der Eingangsgrößen nicht endlich, so dass es keine Auswertung nach dem GUM gibt"),
    ("gum-dof-undefined", "`{name}`{at}: Korrelierte Eingangsgrößen haben endliche Freiheitsgrade, für die die \
        Welch-Satterthwaite-Formel nicht gilt; es bleibt das Monte-Carlo-Intervall oder ein angegebener \
        `coverage_factor`"),
    ("gum-dof-undefined.stated", "`{name}`{at}: Korrelierte Eingangsgrößen haben endliche Freiheitsgrade, für \
        die die Welch-Satterthwaite-Formel nicht gilt; der angegebene Faktor k = {k} bleibt, wie er ist"),
    ("not-converged", "`{name}`{at}: Nach {trials} Versuchen sind die Angaben noch nicht auf die Toleranz \
        {tolerance} stabil; wie weit sie es sind, sagen die numerischen Standardfehler"),
    ("no-variance", "`{name}`{at}: Eine Eingangsgröße wird aus einer t-Verteilung mit {dof} Freiheitsgraden \
        gezogen, die keine Varianz hat, so dass die Versuche keine Standardunsicherheit haben; die \
        Überdeckungsintervalle gelten, und der Wert ist der Schätzwert nach dem Fortpflanzungsgesetz"),
    ("no-variance.of-model", "`{name}`{at}: Eine Eingangsgröße wird aus einer t-Verteilung mit {dof} \
        Freiheitsgraden gezogen, die keine Varianz und durch dieses Modell keinen Erwartungswert hat, so dass \
        die Versuche keinen Schätzwert und keine Standardunsicherheit haben; die Überdeckungsintervalle \
        gelten, und der Wert ist der Schätzwert nach dem Fortpflanzungsgesetz"),
    ("no-variance.one", "`{name}`{at}: Eine Eingangsgröße wird aus einer t-Verteilung mit {dof} Freiheitsgrad \
        gezogen, die keinen Erwartungswert und keine Varianz hat, so dass die Versuche keinen Schätzwert und \
        keine Standardunsicherheit haben; die Überdeckungsintervalle gelten, und der Wert ist der Schätzwert \
        nach dem Fortpflanzungsgesetz"),
    ("no-variance.no-expectation", "`{name}`{at}: Eine Eingangsgröße wird aus einer t-Verteilung mit {dof} \
        Freiheitsgraden gezogen, die keinen Erwartungswert und keine Varianz hat, so dass die Versuche keinen \
        Schätzwert und keine Standardunsicherheit haben; die Überdeckungsintervalle gelten, und der Wert ist \
        der Schätzwert nach dem Fortpflanzungsgesetz"),
    ("difference.above", "liegt {percent} über der des GUM"),
    ("difference.below", "liegt {percent} unter der des GUM"),
    ("difference.from-zero", "ist nicht null wie die des GUM"),
    ("beyond-bounds", "über alle Schranken"),
    ("in-brackets", " ({dof})"),
    ("few-dof", "`{name}`{at}: Die Standardunsicherheit der Monte-Carlo-Methode {difference}, weil einige \
        Eingangsgrößen wenige Freiheitsgrade haben{dof}: Ihre t-Verteilungen haben eine größere \
        Standardabweichung, was {alone} ausmacht. {conclusion}"),
    ("few-dof-not-allowed-for", "Keine von beiden ist falsch; kein Erweiterungsfaktor des GUM trägt dem hier \
        Rechnung"),
    ("few-dof-allowed-for", "Keine von beiden ist falsch; der GUM trägt dem im Erweiterungsfaktor Rechnung"),
    ("few-dof-long-tails", "Der GUM trägt dem in seinem Erweiterungsfaktor Rechnung, dem einer t-Verteilung, \
        deren lange Ausläufer diese Eingangsgrößen nicht haben"),
    ("non-linear", "`{name}`{at}: Die Standardunsicherheit der Monte-Carlo-Methode {difference}, weil das \
        Modell über die Unsicherheiten seiner Eingangsgrößen nicht linear ist{few_dof}{second}. Die Angaben \
        der Monte-Carlo-Methode sind zu nehmen"),
    ("non-linear-few-dof", "; wenige Freiheitsgrade{dof} allein brächten sie {alone} darüber"),
    ("non-linear-terms", "; {said}"),
    ("non-linear.second-order", "`{name}`{at}: {second}"),
    ("non-linear.results", "`{name}`{at}: Die Standardunsicherheit der Monte-Carlo-Methode {difference} wegen \
        gespeicherter Ergebnisse, deren Versuche eine andere Standardabweichung als ihre Standardunsicherheit \
        haben ({results}), da ihre Modelle nicht linear sind. Die Angaben der Monte-Carlo-Methode sind zu \
        nehmen"),
    ("second-order", "mit seinen Gliedern zweiter Ordnung (JCGM 100, 5.1.2, Anmerkung) gibt das \
        Fortpflanzungsgesetz {with_terms} statt {linear}{products}"),
    ("second-order-products", "; {products}"),
    ("squared", "`{name}` im Quadrat"),
    ("times", "`{first}` mal `{second}`"),
    ("contributes", "{product} ergibt {contribution}"),
    ("contributes.hidden", "{product} ergibt {contribution}, obwohl die Empfindlichkeitskoeffizienten hier \
        verschwinden"),
    ("correlations-by-propagation", "`{name}`: Die Versuche haben keine Standardabweichung, die etwas \
        bedeutet; die Korrelationskoeffizienten sind daher die des Fortpflanzungsgesetzes"),
    ("correlations-by-propagation.none", "`{name}`: Die Versuche haben keine Standardabweichung, die etwas \
        bedeutet, und es gibt keine Auswertung nach dem GUM; es gibt daher keine Korrelationskoeffizienten"),
    ("conformity-by-propagation", "`{name}`: Ohne Versuche wird über die Toleranz nach dem \
        Fortpflanzungsgesetz entschieden, wie bei einer Normal- oder t-Verteilung (JCGM 106, 7.2); ob das gilt, \
        zeigen Versuche"),
    ("heavy-tails", "`{name}`{at}: Weit außen liegende Versuche, von denen ein Lauf wenige oder keine hat, \
        tragen die Momente, so dass die Versuche {missing} angeben (JCGM 101, 3.6, Anmerkung 1); Median und \
        Überdeckungsintervalle gelten, und {value}"),
    ("no-deviation", "keine Standardabweichung"),
    ("no-moments", "weder Erwartungswert noch Standardabweichung"),
    ("value-by-propagation", "der Wert ist der Schätzwert nach dem Fortpflanzungsgesetz"),
    ("value-is-median", "der Wert ist der Median"),
    ("interval-of-extremes", "`{name}`{at}: {trials} Versuche sind für diese Überdeckungswahrscheinlichkeit so \
        wenige, dass das Monte-Carlo-Intervall das der äußersten ist, das keinen numerischen Standardfehler \
        hat; Abschnitt 8 bleibt unentschieden"),
    ("result-cancellation", "`{name}`{at}: Größen eines gespeicherten Ergebnisses heben sich fast auf, und die \
        {trials} Versuche, die das Ergebnis enthält, sagen nur auf etwa {left}, wie sie gemeinsam schwanken, \
        bei einer Standardunsicherheit von {spread} in den Versuchen hier; das Ganze ist in einem Modell \
        auszuwerten"),
    ("copula-effect", "`{name}`{at}: Mit den Korrelationskoeffizienten, die die Gauß-Copula an Stelle derer \
        der Eingangsgrößen gibt, ist die Standardunsicherheit in den Versuchen etwa {drawn}, nicht {linear}"),
    ("phase-jumps", "`{name}`: {percent} der Versuche liegen eine Umdrehung von den anderen entfernt, jenseits \
        des Schnitts einer Phase, so dass Mittelwert, Standardabweichung und Intervall der Versuche nichts \
        bedeuten; `\"periodic\": {turn}` bei der Ergebnisgröße nimmt ihre Werte innerhalb einer halben \
        Umdrehung um den Schätzwert"),
    ("phase-jumps.apart", "`{name}`: {percent} der Versuche liegen etwa {size} von den anderen entfernt, \
        jenseits eines Schnitts von `atan2`, einer Phase oder `mod`, so dass Mittelwert, Standardabweichung und \
        Intervall der Versuche nichts bedeuten; wo so weit entfernte Werte dasselbe sind, nimmt dieser Abstand \
        als `\"periodic\"` bei der Ergebnisgröße ihre Werte innerhalb seiner Hälfte um den Schätzwert"),
    ("result-few-trials", "`{name}`{at}: Gespeicherte Ergebnisse aus wenigen Versuchen ({results}) lassen \
        Angaben unsicher, wie viele Versuche hier auch gemacht werden: {errors} (je ein numerischer \
        Standardfehler); diese Ergebnisse sind mit mehr Versuchen zu speichern"),
    ("double-precision", "`{name}`: Zahlen doppelter Genauigkeit mit 16 Stellen lassen {undetermined} von \
        `{input}` unbestimmt, {share} % der Standardunsicherheit: Die Größe ist {estimate} mit der \
        Standardunsicherheit {uncertainty}; anzugeben ist der Unterschied zu einem Bezugswert"),
    ("underflow", "`{name}`: Ein Produkt, ein Quotient oder eine Potenz der Gleichungen liegt unter der \
        kleinsten Zahl doppelter Genauigkeit, 2,2e-308, und zählt weniger, als es ist; zu wählen sind \
        Einheiten von der Größe der Messgrößen"),
];

/// Facts about formulas.
#[rustfmt::skip]
const FORMULAS: Sentences = &[
];

/// Facts about models, tables, certificates and other files.
#[rustfmt::skip]
const FILES: Sentences = &[
];

/// Facts about recordings.
#[rustfmt::skip]
const SIGNALS: Sentences = &[
    ("preamble", "`{name}`: Zeile {first} steht über der Kopfzeile in Zeile {header} und wird nicht gelesen"),
    ("preamble.lines", "`{name}`: Zeilen {first} bis {last} stehen über der Kopfzeile in Zeile {header} und \
        werden nicht gelesen"),
    ("uneven-instants", "`{name}`: Die Zeitpunkte der Zeitspalte streuen um {percent} % des Abtastintervalls \
        (Effektivwert) um gleiche Abstände; wenn wirklich dann abgetastet wurde, ist es als `jitter` anzugeben"),
    ("sampling-rates-differ", "`{name}`: Das Rezept gibt eine Abtastrate von {stated} Hz an, aber {whose} \
        {found} Hz; die des Rezepts wird verwendet, so dass die Frequenzen das {times}-Fache der Angabe der \
        Datei sind; wo die Datei stimmt, ist `sampling_rate` wegzulassen"),
    ("of-time-column", "die Zeitspalte hat"),
    ("of-header", "der Dateikopf sagt"),
    ("flat-channel", "`{name}`, Kanal `{channel}`: alle Werte sind {value}"),
    ("saturated", "`{name}`, {at}: {count} von {of} Werten sind {value}, der {end} der Aufzeichnung, und \
        {next} der ihm nächste; der Kanal kann übersteuert sein"),
    ("saturated.in-a-row", "`{name}`, {at}: {count} Werte in Folge sind {value}, der {end} der Aufzeichnung; \
        der Kanal kann übersteuert sein"),
    ("highest", "höchste"),
    ("lowest", "kleinste"),
    ("sample-of-time", "Abtastwert {sample}, die Zeit"),
    ("sample-of-channel", "Abtastwert {sample}, Kanal `{channel}`"),
];

/// Facts about a diagnosis.
#[rustfmt::skip]
const GAP: Sentences = &[
];

/// Facts that only a command knows.
#[rustfmt::skip]
const COMMANDS: Sentences = &[
    ("of-model", "{model}: "),
    ("few-trials.audit", "{trials} Versuche sind zu wenige, um zu sagen, wie Annahmen das Ergebnis bewegen; es \
        werden {made} gemacht"),
    ("more-than-two-digits", "U wird auf {digits} signifikante Stellen angegeben; ein akkreditierter \
        Kalibrierschein darf höchstens zwei haben (ILAC-P14:09/2020, 5.3)"),
    ("rounded-away", "Zeile {row}: U wird als {stated} angegeben, {percent} % weniger als {expanded}; EA-4/02 \
        M:2022, 6.3, erlaubt eine Rundung, die höchstens 5 % wegnimmt: `\"rounding\": \"ea\"` rundet dort auf"),
    ("digits-of-trials", "Zeile {row}: Die Angaben sind die der Versuche, deren letzte Stelle vom Startwert \
        abhängt: {why}"),
    ("raised-to-cmc.certificate", "Zeile {row}: U wird auf die Messmöglichkeit (CMC) des Laboratoriums von \
        {cmc} angehoben"),
    ("below-cmc.certificate", "Zeile {row}: U = {expanded} liegt unter der Messmöglichkeit (CMC) des \
        Laboratoriums von {cmc}, was ein akkreditierter Kalibrierschein nicht angeben darf (ILAC-P14); \
        `\"cmc_floor\": true` hebt es an"),
    ("not-stated", "der Kalibrierschein sagt nicht, was ISO/IEC 17025:2017, 7.8.2.1 und 7.8.4.1 verlangen: \
        {missing}"),
    ("evidence-unused", "der Beleg zu `{name}` wird nicht verwendet: Er gilt einer angenommenen Verteilung \
        (Typ B), und diese ist aus Ablesungen ermittelt (Typ A)"),
    ("evidence-unused.constant", "der Beleg zu `{name}` wird nicht verwendet: Er gilt einer angenommenen \
        Verteilung (Typ B), und dies ist eine Konstante"),
    ("evidence-first-row", "`{name}` ist nicht in allen Zeilen dieselbe Größe; der Beleg wird mit der ersten \
        Zeile verglichen"),
    ("variant-undefined", "mit einer anderen Form oder Breite von `{name}` haben einige Versuche kein endliches \
        Ergebnis; diese Varianten haben keine Angaben"),
    ("drawn-together", "{names} werden gemeinsam gezogen; sie haben einen gemeinsamen Sobol-Index"),
    ("drawn-together.ranks", "{names} werden gemeinsam gezogen; sie haben einen gemeinsamen Sobol-Index. Mit \
        einer anderen Form bleibt die Abhängigkeit ihrer Ränge, so dass sich der Korrelationskoeffizient etwas \
        bewegt"),
];
