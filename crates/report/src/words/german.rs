//! German.

use super::Sentences;

/// The sentences of all rooms.
pub(super) const ROOMS: [Sentences; 7] =
    [EVALUATION, FORMULAS, FILES, SIGNALS, GAP, COMMANDS, PARTS];

/// Facts of the engine about an evaluation.
#[rustfmt::skip]
const EVALUATION: Sentences = &[
    ("few-trials", "{trials} Versuche sind wenige für die Überdeckungswahrscheinlichkeit {probability}: JCGM \
        101, 7.2.2 rät zu mindestens {needed}"),
    ("correlations-rounded", "die angegebenen Korrelationskoeffizienten sind nur innerhalb ihrer Rundung \
        möglich; in den Versuchen werden die nächsten möglichen verwendet"),
    ("correlations-rounded.output", "`{name}`: Die angegebenen Korrelationskoeffizienten ergeben nach dem \
        Fortpflanzungsgesetz keine positive Varianz, die nächsten möglichen aber doch; die Ergebnisse der \
        Monte-Carlo-Methode sind zu verwenden oder die Koeffizienten mit mehr Stellen anzugeben"),
    ("undefined-trials", "{count} von {trials} Versuchen haben kein endliches Ergebnis und wurden \
        weggelassen"),
    ("gaussian-copula", "{names} werden mit einer Gauß-Copula gezogen, die an ihre Verteilungen und die \
        angegebenen Korrelationskoeffizienten angepasst ist. Ihre gemeinsame Verteilung ist darüber \
        hinaus eine Annahme"),
    ("copula-adjusted", "eine Gauß-Copula gibt die angegebenen Korrelationskoeffizienten nur innerhalb ihrer \
        Rundung; in den Versuchen weichen sie um bis zu {difference} ab"),
    ("copula-adjusted.results", "eine Gauß-Copula gibt die Korrelationskoeffizienten dieser gespeicherten \
        Ergebnisse nur ungefähr; in den Versuchen weichen sie um bis zu {difference} ab. Wenn sich Größen \
        eines Ergebnisses fast aufheben, ist alles in einem Modell auszuwerten"),
    ("trials-off", "`{name}`: Ergebnisse der Versuche weichen um mehr als {errors} numerische \
        Standardfehler von den Ergebnissen ohne Versuche ab: {far}"),
    ("raised-to-cmc", "die erweiterte Unsicherheit von `{name}` liegt unter der Messmöglichkeit (CMC) des \
        Laboratoriums von {cmc} und wird auf sie angehoben: Anzugeben ist {expanded}"),
    ("raised-to-cmc.rows", "die erweiterte Unsicherheit von `{name}` liegt in {count} von {of} Zeilen unter \
        der Messmöglichkeit (CMC) des Laboratoriums und wird dort auf sie angehoben"),
    ("below-cmc", "die erweiterte Unsicherheit von `{name}` ist {expanded}, liegt unter der Messmöglichkeit \
        (CMC) des Laboratoriums von {cmc} und darf nicht angegeben werden (ILAC-P14)"),
    ("below-cmc.rows", "die erweiterte Unsicherheit von `{name}` liegt in {count} von {of} Zeilen unter der \
        Messmöglichkeit (CMC) des Laboratoriums und darf dort nicht angegeben werden (ILAC-P14)"),
    ("gum-undefined", "`{name}`{at}: Der Schätzwert oder ein Empfindlichkeitskoeffizient ist bei den \
        Schätzwerten der Eingangsgrößen nicht endlich, so dass es keine Auswertung nach dem GUM gibt"),
    ("gum-dof-undefined", "`{name}`{at}: Korrelierte Eingangsgrößen haben endliche Freiheitsgrade, für \
        die die Welch-Satterthwaite-Formel nicht gilt; zu verwenden ist das Monte-Carlo-Intervall oder \
        ein angegebener `coverage_factor`"),
    ("gum-dof-undefined.stated", "`{name}`{at}: Korrelierte Eingangsgrößen haben endliche Freiheitsgrade, \
        für die die Welch-Satterthwaite-Formel nicht gilt; der angegebene Faktor k = {k} wird unverändert \
        verwendet"),
    ("not-converged", "`{name}`{at}: Nach {trials} Versuchen sind die Ergebnisse noch nicht innerhalb der \
        Toleranz {tolerance} stabil; siehe ihre numerischen Standardfehler"),
    ("no-variance", "`{name}`{at}: Eine Eingangsgröße wird aus einer t-Verteilung mit {dof} \
        Freiheitsgraden gezogen, die keine Varianz hat, so dass die Versuche keine Standardunsicherheit \
        haben; die Überdeckungsintervalle sind nicht betroffen, und der Wert ist der Schätzwert nach dem \
        Fortpflanzungsgesetz"),
    ("no-variance.of-model", "`{name}`{at}: Eine Eingangsgröße wird aus einer t-Verteilung mit {dof} \
        Freiheitsgraden gezogen, die keine Varianz und mit diesem Modell keinen Erwartungswert hat, so \
        dass die Versuche keinen Schätzwert und keine Standardunsicherheit haben; die \
        Überdeckungsintervalle sind nicht betroffen, und der Wert ist der Schätzwert nach dem \
        Fortpflanzungsgesetz"),
    ("no-variance.one", "`{name}`{at}: Eine Eingangsgröße wird aus einer t-Verteilung mit {dof} \
        Freiheitsgrad gezogen, die keinen Erwartungswert und keine Varianz hat, so dass die Versuche \
        keinen Schätzwert und keine Standardunsicherheit haben; die Überdeckungsintervalle sind nicht \
        betroffen, und der Wert ist der Schätzwert nach dem Fortpflanzungsgesetz"),
    ("no-variance.no-expectation", "`{name}`{at}: Eine Eingangsgröße wird aus einer t-Verteilung mit \
        {dof} Freiheitsgraden gezogen, die keinen Erwartungswert und keine Varianz hat, so dass die \
        Versuche keinen Schätzwert und keine Standardunsicherheit haben; die Überdeckungsintervalle sind \
        nicht betroffen, und der Wert ist der Schätzwert nach dem Fortpflanzungsgesetz"),
    ("stated-by.gum", "`{name}`{at}: U wird nach dem Fortpflanzungsgesetz angegeben, wie `statement` verlangt"),
    ("stated-by.monte-carlo", "`{name}`{at}: U wird nach dem Intervall der Monte-Carlo-Versuche angegeben, wie \
        `statement` verlangt"),
    ("stated-by.few-dof", "`{name}`{at}: U wird nach dem Fortpflanzungsgesetz angegeben, mit k aus den \
        effektiven Freiheitsgraden (EA-4/02 M:2022): Mit unendlich vielen Freiheitsgraden weichen seine \
        Endpunkte um {difference} % von U von den Endpunkten der Versuche ab. `--statement monte-carlo` \
        gibt das Intervall der Versuche an"),
    ("stated-by.near", "`{name}`{at}: U wird nach dem Fortpflanzungsgesetz angegeben: Seine Endpunkte \
        weichen um {difference} % von U von den Endpunkten der Versuche ab, erlaubt sind {allowed} %. \
        `--statement monte-carlo` gibt das Intervall der Versuche an"),
    ("stated-by.shape", "`{name}`{at}: U wird nach dem Intervall der Versuche angegeben: Die Endpunkte \
        des Fortpflanzungsgesetzes weichen um {difference} % von U davon ab, mehr als {allowed} %, wegen \
        der Form einer Verteilung oder eines nichtlinearen Modells. `--statement gum` gibt das \
        Fortpflanzungsgesetz an"),
    ("stated-by.shape-few-dof", "`{name}`{at}: U wird nach dem Intervall der Versuche angegeben: Auch mit \
        unendlich vielen Freiheitsgraden weichen die Endpunkte des Fortpflanzungsgesetzes um {difference} \
        % von U davon ab, mehr als {allowed} %, wegen der Form einer Verteilung oder eines nichtlinearen \
        Modells. `--statement gum` gibt das Fortpflanzungsgesetz an"),
    ("few-dof", "`{name}`{at}: Die Standardunsicherheit der Monte-Carlo-Methode {difference}, weil einige \
        Eingangsgrößen wenige Freiheitsgrade haben{dof}: Ihre t-Verteilungen haben eine größere \
        Standardabweichung, was {alone} ausmacht. {conclusion}"),
    ("non-linear", "`{name}`{at}: Die Standardunsicherheit der Monte-Carlo-Methode {difference}, weil das \
        Modell über die Unsicherheiten seiner Eingangsgrößen nicht linear ist{few_dof}{second}. Die \
        Ergebnisse der Monte-Carlo-Methode sind zu verwenden"),
    ("non-linear.second-order", "`{name}`{at}: {second}"),
    ("non-linear.results", "`{name}`{at}: Die Standardunsicherheit der Monte-Carlo-Methode {difference}, \
        weil die Versuche gespeicherter Ergebnisse eine andere Standardabweichung als ihre \
        Standardunsicherheit haben ({results}): Ihre Modelle sind nicht linear. Die Ergebnisse der \
        Monte-Carlo-Methode sind zu verwenden"),
    ("correlations-by-propagation", "`{name}`: Die Standardabweichung der Versuche ist nicht \
        aussagekräftig; die Korrelationskoeffizienten folgen daher aus dem Fortpflanzungsgesetz"),
    ("correlations-by-propagation.none", "`{name}`: Die Standardabweichung der Versuche ist nicht \
        aussagekräftig, und es gibt keine Auswertung nach dem GUM; es gibt daher keine \
        Korrelationskoeffizienten"),
    ("conformity-by-propagation", "`{name}`: Ohne Versuche wird über die Toleranz nach dem \
        Fortpflanzungsgesetz mit einer Normal- oder t-Verteilung entschieden (JCGM 106, 7.2); Versuche \
        zeigen, ob das ausreicht"),
    ("heavy-tails", "`{name}`{at}: Die Momente hängen von seltenen extremen Versuchen ab, so dass die \
        Versuche {missing} angeben (JCGM 101, 3.6, Anmerkung 1); Median und Überdeckungsintervalle sind \
        nicht betroffen, und {value}"),
    ("interval-of-extremes", "`{name}`{at}: Bei nur {trials} Versuchen sind die Endpunkte des \
        Monte-Carlo-Intervalls für diese Überdeckungswahrscheinlichkeit die äußersten Versuche, ohne \
        numerischen Standardfehler; Abschnitt 8 ist nicht entschieden"),
    ("result-cancellation", "`{name}`{at}: Größen eines gespeicherten Ergebnisses heben sich fast auf, \
        und die {trials} Versuche des Ergebnisses geben ihre Differenz nur auf etwa {left} an, bei einer \
        Standardunsicherheit von {spread} in den Versuchen hier; alles ist in einem Modell auszuwerten"),
    ("copula-effect", "`{name}`{at}: Mit den Korrelationskoeffizienten der Gauß-Copula statt der \
        angegebenen ist die Standardunsicherheit in den Versuchen etwa {drawn}, nicht {linear}"),
    ("phase-jumps", "`{name}`: {percent} der Versuche liegen eine Umdrehung von den anderen entfernt, \
        jenseits des Schnitts einer Phase, so dass Mittelwert, Standardabweichung und Intervall der \
        Versuche nicht aussagekräftig sind; mit `\"periodic\": {turn}` bei der Ergebnisgröße bleiben ihre \
        Werte innerhalb einer halben Umdrehung um den Schätzwert"),
    ("phase-jumps.apart", "`{name}`: {percent} der Versuche liegen etwa {size} von den anderen entfernt, \
        jenseits eines Schnitts von `atan2`, einer Phase oder `mod`, so dass Mittelwert, \
        Standardabweichung und Intervall der Versuche nicht aussagekräftig sind; wenn Werte in diesem \
        Abstand gleichwertig sind, ist der Abstand als `\"periodic\"` bei der Ergebnisgröße anzugeben, so \
        dass ihre Werte innerhalb des halben Abstands um den Schätzwert bleiben"),
    ("result-few-trials", "`{name}`{at}: Gespeicherte Ergebnisse aus wenigen Versuchen ({results}) lassen \
        Ergebnisse unsicher, unabhängig von der Zahl der Versuche hier: {errors} (je ein numerischer \
        Standardfehler); diese Ergebnisse sind mit mehr Versuchen zu speichern"),
    ("double-precision", "`{name}`: Zahlen doppelter Genauigkeit mit 16 Stellen lassen {undetermined} von \
        `{input}` unbestimmt, {share} % der Standardunsicherheit: Die Größe ist {estimate} mit der \
        Standardunsicherheit {uncertainty}; als Eingangsgröße ist der Unterschied zu einem Bezugswert zu \
        verwenden"),
    ("underflow", "`{name}`: Ein Produkt, ein Quotient oder eine Potenz der Gleichungen liegt unter der \
        kleinsten Zahl doppelter Genauigkeit, 2,2e-308, und ist im Ergebnis zu klein; zu wählen sind \
        Einheiten von der Größe der Messgrößen"),
];

/// Facts about formulas.
#[rustfmt::skip]
const FORMULAS: Sentences = &[
    ("share-converted-twice", "`{formula}` rechnet noch einmal aus {unit} um: Formeln haben einen Anteil in \
        {unit} schon als Zahl, so dass sein Name genügt"),
    ("share-converted-twice.logarithm", "`{formula}` rechnet mit {number}, dem Logarithmus von {of}, noch \
        einmal aus {unit} um: Formeln haben einen Anteil in {unit} schon als Zahl; die Zahl entfällt"),
    ("rate-converted-twice", "`{formula}` rechnet noch einmal in Radiant je Sekunde um: Formeln haben, was \
        in {unit} angegeben ist, schon in Radiant je Sekunde, so dass sein Name genügt"),
    ("angle-converted-twice", "`{formula}` rechnet noch einmal in Radiant um: Formeln haben einen Winkel in \
        {unit} schon in Radiant, so dass sein Name genügt"),
    ("angle-converted-twice.degrees", "`{function}` nimmt Radiant, und `{argument}` ist durch den Faktor \
        180/pi eine Zahl von Grad; der Faktor entfällt, denn Formeln haben Winkel in Radiant"),
    ("angle-of-turns", "`{function}` nimmt `{name}` in Radiant, da es keine Winkeleinheit hat, und {angle} \
        rad sind mehr als eine Umdrehung; ein Winkel in Grad hat `\"unit\": \"deg\"`"),
    ("angle-of-turns.constant", "`{function}` nimmt Radiant, und {angle} rad sind mehr als eine Umdrehung; \
        ein Winkel in Grad wird `{angle} [deg]` geschrieben"),
    ("angle-of-turns.phase", "`{name}` ist {angle} rad, mehr als eine Umdrehung, denn eine Phase ohne \
        Einheit ist in Radiant angegeben; eine in Grad hat `\"unit\": \"deg\"`"),
    ("rounded-as-number", "`{formula}` wird auf ganze Zahlen gerechnet, wie Formeln rechnen, und nicht auf \
        ganze {unit}; diese gibt `{meant}`"),
    ("rounded-as-number.radians", "`{formula}` wird auf ganze Radiant gerechnet, wie Formeln rechnen, und \
        nicht auf ganze {unit}; diese gibt `{meant}`"),
    ("bare-number", "in `{formula}` ist {number} die Zahl {number}, das sind {converted} {unit}, denn \
        `{quantity}` ist {given}; {number} {unit} werden `{meant}` geschrieben"),
    ("bare-number.radians", "in `{formula}` ist {number} der Winkel {number} rad, denn `{quantity}` ist \
        {given}; {number} {unit} werden `{meant}` geschrieben"),
    ("bare-number.angle", "in `{formula}` ist {number} der Winkel {number} rad, denn `{quantity}` ist ein \
        Winkel in Radiant; {number} {unit} werden `{meant}` geschrieben"),
    ("radians-as-periods", "`{formula}` ist nach dem, woraus es besteht, eine Kreisfrequenz in Radiant je \
        Sekunde und wird als Frequenz angegeben; diese ist `({formula})/(2*pi)`, und eine Kreisfrequenz wird \
        in `rad/s` angegeben"),
    ("periods-as-radians", "`{function}` nimmt Radiant, und `{argument}` zählt Perioden von je 2*pi Radiant; \
        der Winkel ist `2*pi*{argument}`"),
    ("periods-as-radians.torque", "`{formula}` multipliziert ein Drehmoment mit Perioden, denn die Drehzahl \
        darin zählt keinen Winkel, und die Arbeit eines Drehmoments gilt je Radiant; die Leistung ist \
        `2*pi*{formula}`, oder die Drehzahl ist in `rpm` anzugeben"),
    ("level-of-other-kind", "`{formula}` ist das 10-fache des Logarithmus eines Verhältnisses von \
        Leistungswurzelgrößen, deren Pegel das 20-fache ist; Leistungen haben 10, und Spannungen, Ströme, \
        Schalldrücke und dergleichen, deren Quadrate Leistungen sind, haben 20"),
    ("level-of-other-kind.powers", "`{formula}` ist das 20-fache des Logarithmus eines Verhältnisses von \
        Leistungen, deren Pegel das 10-fache ist; Leistungen haben 10, und Spannungen, Ströme, Schalldrücke \
        und dergleichen, deren Quadrate Leistungen sind, haben 20"),
    ("radians-of-turns", "`{name}` zählt Winkel und wird in `{unit}` in Radiant angegeben, 2*pi je \
        Umdrehung; sind Umdrehungen gemeint, ist `.../[rev]` zu schreiben oder rpm oder rev als Einheit \
        anzugeben"),
    ("radians-of-turns.inverse", "`{name}` ist durch etwas geteilt, das Umdrehungen zählt, und wird in \
        `{unit}` je Radiant angegeben; ist es je Umdrehung gemeint, ist `...*[rev]` zu schreiben"),
    ("radians-of-turns.product", "`{formula}` multipliziert mit Radiant, 2*pi je Umdrehung, denn Formeln \
        rechnen Umdrehungen in Radiant um; mit Umdrehungen ist es `{formula}/[rev]`"),
    ("rate-of-turns", "`{name}` gilt als Kreisfrequenz mit 2*pi Radiant je Umdrehung, denn es ist nicht \
        angegeben, dass es Umdrehungen zählt; wenn es das tut, ist `...*[rev]` zu schreiben oder die \
        Einheit `1/min` anzugeben"),
    ("result-converted-twice", "`{formula}` rechnet in {unit} um, und {what} in {unit} noch einmal: Formeln \
        rechnen mit {computed}; der Faktor entfällt{or_plain}"),
    ("result-converted-twice.product", "`{formula}` hat{with} den Faktor {factor}, der aus den Einheiten der \
        Größen in {to}; der Faktor entfällt, oder er ist eine eigene Eingangsgröße, wenn er nichts \
        umrechnet{or_turns}"),
    ("quantity-converted-twice", "`{formula}` hat den Faktor {factor}, der aus den Einheiten der Größen in \
        {to} umrechnet, was Formeln schon getan haben; der Faktor entfällt"),
    ("quantity-converted-twice.product", "`{formula}` hat{with} den Faktor {factor}, der aus den Einheiten \
        der Größen in kohärente SI-Einheiten umrechnet, in denen Formeln sie schon haben; der Faktor \
        entfällt, oder er ist eine eigene Eingangsgröße, wenn er nichts umrechnet{or_turns}"),
    ("unit-left-out", "`{formula}` hat keine Einheit, so dass Formeln die Zahlen als bloße Zahlen \
        verwenden (1 ist {one} {unit}), neben `{beside}` in {unit}; anzugeben ist die Einheit, `{unit}` \
        oder `{plain}`"),
    ("unit-left-out.output", "`{formula}` hat keine Einheit, so dass Formeln die Zahlen als bloße Zahlen \
        verwenden (1 ist {one} {unit}), und die Ergebnisgröße wird in {unit} angegeben; anzugeben ist die \
        Einheit, `{unit}` oder `{plain}`"),
    ("level-as-number", "`{name}` ist ein Pegel und wird als Zahl der Dezibel angegeben, wie Formeln sie \
        rechnen; die Einheit `dB` oder `Np` ist anzugeben"),
    ("sum-of-levels", "`{name}` in {unit} addiert Pegel über einem Bezugswert oder vervielfacht einen und \
        hat so selbst keinen Bezugswert; der Pegel einer Summe von Leistungen ist `10*log10(10^(L1/10) + \
        10^(L2/10))`, und Verstärkungen sind in dB"),
    ("celsius-as-kelvin", "`{name}` ist nach der Einheit eines Koeffizienten eine Zahl von Grad Celsius und \
        wird in {unit} als Differenz angegeben; kelvin(...) steht für eine thermodynamische Temperatur, oder \
        sie ist in degC anzugeben"),
    ("difference-in-degrees", "`{name}` ist eine Differenz von Temperaturen und wird in {unit} angegeben, \
        so dass alles Weitere sie als Temperatur liest; sie ist in K anzugeben, oder, wenn eine \
        Korrektion von einer Temperatur abgezogen wird, die Korrektion in K"),
    ("picohenry", "die Einheit `pH` von `{name}` ist das Pikohenry; ein pH-Wert ist eine Zahl mit der \
        Einheit `1`"),
    ("imaginary-unit", "`i` ist in den Formeln dieser Datei die Größe dieses Namens und nicht die imaginäre \
        Einheit; ist diese gemeint, braucht die Größe einen anderen Namen"),
    ("unused-input", "keine Gleichung verwendet die Eingangsgröße `{name}`: Sie trägt zu keiner Unsicherheit \
        bei"),
];

/// Facts about models, tables, certificates and other files.
#[rustfmt::skip]
const FILES: Sentences = &[
    ("placeholder-about", "`about` von `{name}` ist noch der Text einer neuen Datei, \"{about}\", und \
        Kalibrierscheine drucken ihn: Die Quelle der Größe ist anzugeben oder der Schlüssel wegzulassen"),
    ("units-not-checked", "Einheiten werden nicht geprüft: Die Formeln rechnen mit den Zahlen in den \
        angegebenen Einheiten ({quantities}{more})"),
    ("units-not-checked.plain", "Einheiten werden nicht geprüft: Jede Größe ist eine bloße Zahl"),
    ("units-not-checked-changed", "DIESES ERGEBNIS PRÜFEN: {numbers}. Frühere Versionen rechneten sie \
        erst in SI-Einheiten um, etwa `{name}` aus {unit}, und gaben für diese Datei andere Ergebnisse. \
        Sind die Formeln für die angegebenen Einheiten geschrieben, so ist dieses Ergebnis richtig: \
        Anzugeben ist \"format\": 2. Sind sie für SI-Einheiten geschrieben, so sind die Größen in \
        SI-Einheiten anzugeben"),
    ("width-zero", "die Breite von `{of}` folgt ihrem Schätzwert und wird{rows} 0; dort ist sie eine \
        Konstante"),
    ("share-of-zero", "der Anteil vom Messwert in der Breite von `{name}` ist{rows} 0, wie ihr Schätzwert; \
        vom Wert einer anderen Größe wäre er `20 ppm of 10 V`"),
    ("limits-moved", "die `limits` von `{name}` verschieben sich mit dem neuen Schätzwert; wenn sie \
        bleiben müssen, wie bei einer Konzentration, die nicht negativ sein kann, ist `{name}.mean=...` \
        für den Wert vor der Begrenzung zu schreiben"),
    ("readings-replaced", "die Ablesungen von {names} sind aus `{file}`"),
    ("readings-kept", "`{file}` hat keine Spalte für {names}: die Ablesungen des Modells bleiben"),
    ("readings-apart", "die Ablesungen von `{part}` haben den Mittelwert {mean}, mehr als drei seiner \
        Standardunsicherheiten von {estimate} entfernt, dem Schätzwert, der für `{name}` angegeben ist: Nur \
        ihre Streuung zählt; ohne den angegebenen Schätzwert gilt ihr Mittelwert"),
    ("component-estimate", "der Schätzwert {own} des Anteils `{part}` wird zu {total} addiert, dem \
        Schätzwert von `{name}`: zusammen {sum}; Anteile sind Abweichungen, um 0 herum"),
    ("component-result", "der Anteil `{part}` ist ein gespeichertes Ergebnis von {estimate}, von dem nur die \
        Abweichung davon zählt; eine Korrektion ist eine eigene Eingangsgröße, die eine Gleichung addiert"),
    ("resolution-taken", "`{name}`: Die Streuung der Messwerte liegt unter der Unsicherheit der \
        Auflösung, die stattdessen als Rechteckverteilung verwendet wird (JCGM 100, F.2.2.1)"),
    ("no-scatter", "`{name}`: Alle Messwerte sind gleich und zeigen keine Streuung; sie sind eine Konstante \
        neben den anderen Komponenten, von denen eine die Auflösung sein muss"),
    ("nested-readings", "`{name}` ist der Mittelwert von {groups} Gruppen von Messwerten; die \
        Standardunsicherheit ist die der Gruppenmittel mit {dof} Freiheitsgraden (JCGM 100, H.5){within}"),
    ("dependent-readings", "`{name}`: Die {count} Messwerte sind nicht unabhängig: Jeder liegt nahe am \
        vorigen (von-Neumann-Verhältnis {ratio}, 2 bei unabhängigen Messwerten; unabhängige Messwerte \
        ergeben ein so kleines in höchstens 1 von 100 Fällen). s/sqrt(n) ist dann zu klein (JCGM 100, \
        4.2.7): Messwerte in größeren Abständen oder Mittelwerte von Gruppen helfen"),
    ("dependent-readings.drift", "`{name}`: Die {count} Messwerte driften: Eine Gerade durch sie ändert \
        sich vom ersten zum letzten um {change}; unabhängige Messwerte ergeben eine so steile in \
        höchstens 1 von 100 Fällen. s/sqrt(n) gilt nur für unabhängige Messwerte (JCGM 100, 4.2.7): Die \
        Drift ist zu korrigieren und die verbleibende Unsicherheit anzugeben"),
    ("interpolated", "`{quantity}` nimmt Werte von kubischen Splines durch die {points} Punkte von \
        `{file}` ({low} bis {high}); Geraden weichen auf halbem Weg zwischen ihnen um höchstens \
        {difference} ab; keine Unsicherheit enthält dies, wenn keine Eingangsgröße es angibt"),
    ("interpolated.linear", "`{quantity}` nimmt Werte von Geraden durch die {points} Punkte von `{file}` \
        ({low} bis {high}); kubische Splines weichen auf halbem Weg zwischen ihnen um höchstens \
        {difference} ab; keine Unsicherheit enthält dies, wenn keine Eingangsgröße es angibt"),
    ("date-origin", "Datumsangaben sind Anzahlen von Tagen seit dem {origin}"),
    ("fit-not-valid", "die Punkte passen nicht zu `{name}`: Chi-Quadrat ist {chi2} mit {dof} \
        Freiheitsgraden, über seinem 95-%-Quantil {limit}; die Form oder die angegebenen Unsicherheiten \
        sind nicht richtig"),
    ("fit-units-not-checked", "in der Formel von `{name}` werden Einheiten nicht geprüft: Sie rechnet mit \
        x in {x} und y in {y}, und ihre Parameter sind bloße Zahlen; die Parameter von `start` sind mit \
        Einheiten anzugeben"),
    ("extrapolation.fit", "`{name}` wird bei x = {x} verwendet, außerhalb der Punkte von {low} bis \
        {high}: Die angegebene Unsicherheit setzt voraus, dass die Form dort richtig ist"),
    ("interval-uncertainty", "`{name}`: Wenn `{file}` mit einem Überdeckungsintervall eine \
        Standardunsicherheit angibt, wird diese statt U/k verwendet, dessen Stellen gerundet sind"),
    ("certificate-distribution", "`{name}`: `{file}` nennt die Verteilung `{called}`, die unbekannt ist; \
        verwendet wird eine Normalverteilung mit der angegebenen Standardunsicherheit"),
    ("certificate-difference", "`{name}`: `{file}` gibt eine Differenz von Temperaturen an, etwa eine \
        Abweichung oder eine Korrektion, die in K gelesen wird; für eine Temperatur ist `\"difference\": \
        false` anzugeben"),
    ("certificate-exact", "`{name}`: `{file}` gibt für diesen Wert keine Unsicherheit an, so dass er als \
        genau gilt; eine Unsicherheit aus einem Text oder von einer anderen Größe ist in der Modelldatei \
        anzugeben"),
    ("certificate-before-adjustment", "`{name}`: Nach seinem Status in `{file}` wurde der Wert vor einer \
        Justierung oder Reparatur ermittelt; zu verwenden ist der Wert danach, wenn der Kalibrierschein \
        ihn enthält (`gumption dcc`)"),
    ("certificate-asymmetric", "`{name}`: `{file}` gibt ein Überdeckungsintervall an, das nicht \
        symmetrisch um den Wert liegt; verwendet werden der Wert und die Standardunsicherheit, ohne die \
        Asymmetrie"),
    ("certificate-correlation", "Korrelationskoeffizienten zwischen Ergebnissen eines Kalibrierscheins \
        bleiben erhalten: {pairs}"),
    ("certificate-correlation-moved", "Korrelationskoeffizienten eines Kalibrierscheins, die für die \
        Verteilungen seiner Ergebnisse unmöglich sind, werden durch die nächsten möglichen ersetzt: \
        {pairs}"),
    ("codata-correlation", "Korrelationskoeffizienten zwischen gemessenen Konstanten sind die von CODATA \
        2022: {pairs}"),
    ("correlation-with-constant", "die Korrelation von `{first}` und `{second}` hat keine Wirkung, denn \
        `{constant}` hat keine Unsicherheit"),
    ("result-correlation", "die Korrelation gespeicherter Ergebnisse bleibt erhalten: {pairs}"),
    ("result-dependence-unknown", "`{first}` und `{second}` hängen vielleicht voneinander ab, weil ihre \
        Ergebnisse auf dieselbe Modelldatei zurückgehen; da eine der Größen keine endlichen \
        Empfindlichkeitskoeffizienten hat, ist die Abhängigkeit unbekannt; sie werden als unabhängig \
        verwendet"),
    ("result-inputs-differ", "Ergebnisse einer Modelldatei mit verschiedenen Größen für eine \
        Eingangsgröße sind in ihr unabhängig: {pairs}; ist es eine Größe, sind die Ergebnisse in einem \
        Modell auszuwerten, oder ihre Korrelation ist anzugeben"),
    ("result-without-ranks", "von {pairs} sind nur die Korrelationskoeffizienten bekannt, nicht wie sie \
        gemeinsam schwanken, weil ihr Ergebnis von einer älteren Version gespeichert wurde; es ist neu zu \
        speichern"),
    ("result-without-digest", "`{file}` hat keine Prüfsumme, wie Dateien älterer Versionen: Ob die Datei \
        seit dem Speichern geändert wurde, ist unbekannt"),
    ("result-changed", "`{file}` wurde seit dem Speichern geändert{parts} und wird so verwendet, wie es \
        jetzt ist"),
    ("counted-twice", "`{name}` hat den Namen und die Werte einer Eingangsgröße des Ergebnisses \
        `{result}` und gilt als unabhängig davon; sind sie eine Größe, sind beide in einem Modell \
        auszuwerten, oder ihre Korrelation ist anzugeben"),
    ("counted-twice.certificate", "`{name}` ist ein Wert eines Kalibrierscheins, aus dem auch das Ergebnis \
        `{result}` ermittelt wurde, und gilt als unabhängig davon; beide sind in einem Modell auszuwerten, \
        oder ihre Korrelation ist anzugeben"),
    ("grams", "`{name}`: Die Einheit `{unit}` ist die einer Masse, das Gramm; eine Beschleunigung in \
        Einheiten der Normfallbeschleunigung steht in `{meant}`"),
    ("effect-dimension", "Effekt `{name}`, Ersatz für `{quantity}`: {misfit}"),
    ("effect-dimension.other", "die Formel gibt {found}, aber `{quantity}` ist {own}"),
    ("effect-misfit", "der Effekt `{name}` entfällt: Er {reason}"),
    ("sheet-chosen", "gelesen wird das Blatt `{sheet}`, nicht {others}"),
    ("relative-uncertainties", "Unsicherheiten in {units} sind Anteile der Werte"),
    ("angle-branch", "Winkel werden innerhalb einer halben Umdrehung voneinander verglichen: {angles}"),
    ("angle-branch.moved", "{angle} von `{name}` als {compared}"),
    ("columns-not-read", "die Spalten {names} werden nicht gelesen"),
    ("columns-not-read.one", "die Spalte `{name}` wird nicht gelesen"),
    ("assigned-value-chosen", "der zugewiesene Wert ist der robuste Mittelwert nach Algorithmus A, weil kein anderer angegeben \
        ist (`--assigned`)"),
    ("sigma-chosen", "die Standardabweichung für die Eignungsbeurteilung ist die robuste Standardabweichung nach \
        Algorithmus A, weil keine andere angegeben ist (`--sigma`)"),
    ("few-participants", "{count} Teilnehmer sind weniger als {least}: robuste Schätzwerte aus so wenigen Ergebnissen \
        sind nicht zuverlässig (ISO 13528:2022, D.1); geben Sie den zugewiesenen Wert und die \
        Standardabweichung an, wenn sie bekannt sind"),
    ("algorithm-a-first-scale", "mehr als die Hälfte der Ergebnisse sind gleich: Algorithmus A begann mit der Standardabweichung \
        der Stichprobe statt mit der medianen absoluten Abweichung, die 0 ist (ISO 13528:2022, C.3.1); \
        prüfen Sie die Ergebnisse auf Ausreißer"),
    ("sigma-zero", "die Ergebnisse streuen nach diesem Schätzwert nicht, sodass es keine Scores gibt; geben Sie die \
        Standardabweichung für die Eignungsbeurteilung an, `--sigma WERT`"),
    ("sigma-zero.share", "der zugewiesene Wert ist 0 und damit auch ein Anteil von ihm, sodass es keine Scores gibt; \
        geben Sie die Standardabweichung für die Eignungsbeurteilung in der Einheit der Ergebnisse an, \
        `--sigma WERT`"),
    ("assigned-value-without-uncertainty", "für den zugewiesenen Wert ist keine Unsicherheit angegeben (`--assigned-u`), sodass es keine \
        z'-, Zeta- und En-Scores gibt"),
    ("assigned-uncertainty-large", "die Standardunsicherheit des zugewiesenen Werts ist das {ratio}-Fache der Standardabweichung \
        für die Eignungsbeurteilung, mehr als {limit}: z'-Scores entscheiden (ISO 13528:2022, 9.2 und \
        9.5)"),
];

/// Facts about recordings.
#[rustfmt::skip]
const SIGNALS: Sentences = &[
    ("preamble", "`{name}`: Zeile {first} ist über der Kopfzeile in Zeile {header} und wird nicht gelesen"),
    ("preamble.lines", "`{name}`: Zeilen {first} bis {last} sind über der Kopfzeile in Zeile {header} und \
        werden nicht gelesen"),
    ("uneven-instants", "`{name}`: Die Zeitpunkte der Zeitspalte streuen um {percent} % des Abtastintervalls \
        (Effektivwert) um gleiche Abstände; wenn wirklich dann abgetastet wurde, ist es als `jitter` anzugeben"),
    ("sampling-rates-differ", "`{name}`: Das Rezept gibt eine Abtastrate von {stated} Hz an, aber {whose} \
        {found} Hz; die Rate des Rezepts wird verwendet, so dass die Frequenzen das {times}-Fache der \
        Frequenzen der Datei sind; wenn die Datei richtig ist, ist `sampling_rate` wegzulassen"),
    ("flat-channel", "`{name}`, Kanal `{channel}`: alle Werte sind {value}"),
    ("saturated", "`{name}`, {at}: {count} von {of} Werten sind {value}, der {end} der Aufzeichnung, und \
        {next} der ihm nächste; der Kanal kann übersteuert sein"),
    ("saturated.in-a-row", "`{name}`, {at}: {count} Werte in Folge sind {value}, der {end} der Aufzeichnung; \
        der Kanal kann übersteuert sein"),
    ("near-noise", "`{name}`: Rauschen allein ergibt in {percent} % aller Aufzeichnungen eine Amplitude, die \
        so groß ist wie die bei {frequency} Hz; die Phase ist dort kaum bekannt und die Amplitude im Mittel zu \
        groß"),
    ("strong-tone", "`{name}`: Das Vielfache {multiple} einer Frequenz, das `components` nicht nennt, hat bei \
        {at} Hz die Amplitude {size}, mehr als die {asked} bei {hertz} Hz; Frequenz und Abtastrate sind zu \
        prüfen{other_unit}"),
    ("strong-tone.beside", "`{name}`: Eine Schwingung, die das Rezept nicht nennt, hat bei {at} Hz die \
        Amplitude {size}, mehr als die {asked} bei {hertz} Hz; Frequenz und Abtastrate sind zu \
        prüfen{other_unit}"),
    ("strong-tone.left", "`{name}`: In den Residuen ist bei etwa {at} Hz eine Schwingung von {size}, mehr als \
        die {asked} bei {hertz} Hz; Frequenz und Abtastrate sind zu prüfen{other_unit}"),
    ("tone-in-residuals", "`{name}`: Den größten Teil der Residuen macht eine Schwingung von {size} bei etwa \
        {at} Hz aus, die nicht angepasst wird und als Rauschen zählt{multiple}"),
    ("far-samples", "`{name}`: {samples}{more} liegen weit außerhalb der übrigen, bis zu {far} robuste \
        Standardabweichungen der Residuen von der Anpassung entfernt; ist das eine Störspitze oder eine Zahl \
        für einen fehlenden Wert, so ist die Aufzeichnung zu berichtigen oder dieser Teil mit `from` und `to` \
        wegzulassen, weil er wie jeder andere Abtastwert zählt"),
    ("far-samples.one", "`{name}`: {samples} liegt weit außerhalb der übrigen, bis zu {far} robuste \
        Standardabweichungen der Residuen von der Anpassung entfernt; ist das eine Störspitze oder eine Zahl \
        für einen fehlenden Wert, so ist die Aufzeichnung zu berichtigen oder dieser Teil mit `from` und `to` \
        wegzulassen, weil er wie jeder andere Abtastwert zählt"),
    ("filter-not-corrected", "`{name}`: Die Verstärkung des Schritts `{step}` bei {at} Hz, {value}, wird nicht \
        korrigiert"),
    ("filter-not-corrected.phase", "`{name}`: Die Phase des Schritts `{step}` bei {at} Hz, {value}, wird nicht \
        korrigiert"),
    ("correlated-residuals", "`{name}`: Die Residuen sind korreliert (Koeffizient {coefficient} bei der \
        Verschiebung 1); {way}"),
    ("correlated-residuals.before-steps", "`{name}`: Vor den Schritten sind die Residuen korreliert \
        (Koeffizient {coefficient} bei der Verschiebung 1); {way}"),
    ("short-record", "`{name}`: Die Aufzeichnung ist zu kurz, um weißes Rauschen von Rauschen mit Gedächtnis \
        zu unterscheiden; die Standardunsicherheiten setzen weißes Rauschen voraus und sind vielleicht zu \
        klein"),
    ("short-record.white-before-steps", "`{name}`: Vor den Schritten ist die Aufzeichnung zu kurz, um weißes \
        Rauschen von Rauschen mit Gedächtnis zu unterscheiden; die Standardunsicherheiten setzen weißes \
        Rauschen voraus, das die Schritte durchläuft, und sind vielleicht zu klein"),
    ("short-record.suspected", "`{name}`: Die Residuen sind vielleicht korreliert; die Aufzeichnung ist \
        zu kurz, um das zu entscheiden (Koeffizient {coefficient} bei der Verschiebung 1); {way}"),
    ("short-record.before-steps", "`{name}`: Vor den Schritten sind die Residuen vielleicht korreliert; \
        die Aufzeichnung ist zu kurz, um das zu entscheiden (Koeffizient {coefficient} bei der \
        Verschiebung 1); {way}"),
    ("waveform-ends-differ", "`{name}`: Erster und letzter Wert der Aufzeichnung unterscheiden sich um das {times}-fache \
        ihres Rauschens; die Korrektur nimmt die Aufzeichnung als eine Periode, sodass Werte nahe den Enden falsch sind: \
        aufzeichnen, bis das Signal wieder dort ist, wo es begann"),
    ("waveform-methods-differ", "`{name}`: Die Standardabweichung der Werte in den Versuchen ist im Mittel {drawn}, die \
        nach dem Fortpflanzungsgesetz {stated}: Die Korrektur ist innerhalb ihrer Unsicherheiten nicht linear, und die \
        der Versuche ist anzugeben"),
    ("waveform-quantity-missing", "`{name}`: {missing} von {trials} Versuchen haben kein {figure}"),
    ("waveform-quantity-methods-differ", "`{name}`: Die Standardabweichung von {figure} in den Versuchen ist {drawn}, die \
        nach dem Fortpflanzungsgesetz {stated}: Die Größe ist innerhalb ihrer Unsicherheit nicht linear (ein größter Wert \
        wählt das Rauschen, das ihn hebt); ein Tiefpass mit niedrigerer Grenzfrequenz hilft"),
    ("found-tone", "`{name}`: Etwas schwingt, das das Rezept nicht nennt, bei {tones}; es wird zusammen mit \
        den genannten Frequenzen angepasst und zählt im Signal-Rausch-Verhältnis als Rauschen"),
    ("found-drift", "`{name}`: Der Pegel driftet über die Aufzeichnung um {range}; ein Polynom vom Grad \
        {degree} wird zusammen mit den genannten Frequenzen angepasst, der Offset ist der Mittelwert über die \
        Aufzeichnung mit der Standardabweichung der Drift in seiner Unsicherheit, und die Drift zählt im \
        Signal-Rausch-Verhältnis als Rauschen"),
    ("tones-too-near", "`{name}`: Etwas schwingt innerhalb von {within} Hz (eins durch die Länge der \
        Aufzeichnung) um eine genannte Frequenz, oder die Schwingung bei dieser Frequenz wächst, klingt \
        ab oder wandert; diese Aufzeichnung kann beides nicht trennen, und Amplitude und Phase gehören zu \
        beidem zusammen; eine längere Aufzeichnung kann es"),
    ("wandering-level", "`{name}`: Der Pegel wandert und kehrt innerhalb der Aufzeichnung nicht zurück; \
        die Unsicherheit des Offsets bezieht sich auf den ersten Wert der Aufzeichnung. Eine stetige \
        Drift, die kein Rauschen ist, verändert Amplituden und Phasen um mehr als deren Unsicherheiten: \
        Der Schritt `remove-trend` entfernt eine Gerade"),
    ("wandering-level.flicker", "`{name}`: Das Rauschen wächst zu den tiefsten Frequenzen der \
        Aufzeichnung hin, wie 1/f-Rauschen, ohne eigenen Pegel; die Unsicherheit des Offsets bezieht sich \
        auf den Mittelwert einer zehnmal so langen Aufzeichnung"),
    ("looks-quantized", "`{name}`: Es ist keine Auflösung angegeben, doch die Werte sind Vielfache von {step}; \
        dies gilt als Auflösung"),
    ("looks-quantized.finer", "`{name}`: Es ist eine feinere Auflösung angegeben, doch die Werte sind \
        Vielfache von {step}; dies gilt als Auflösung"),
    ("coherent-sampling", "`{name}`: Die {samples} Abtastwerte fallen auf {phases} verschiedene Phasen \
        der Schwingung, und das Rauschen ist zu klein, um die Rundung zu verwischen, so dass sie sich nur \
        über diese Phasen ausmittelt"),
    ("common-noise", "`{name}`: Das Rauschen ist mit dem Rauschen der Referenz korreliert (Koeffizient \
        der beiden Phasen: {coefficient}); die Unsicherheit der Phase enthält dies"),
    ("frequency-differs", "`{name}`: Zur Aufzeichnung passt eine Frequenz, die um {by} Hz von {frequency} Hz \
        abweicht, mehr, als die Unsicherheiten zulassen; die Abtastrate ist zu prüfen oder die Frequenz \
        schätzen zu lassen"),
];

/// Facts about a diagnosis.
#[rustfmt::skip]
const GAP: Sentences = &[
    ("interrupted", "Die Diagnose wurde abgebrochen; dies ist der Stand bei der Unterbrechung. Hypothesen \
        fehlen vielleicht, und ihre Wahrscheinlichkeiten sind grob. Nicht begonnene Teile (anderes \
        Rauschen, Bereiche, Kreuzvalidierung, nächste Messungen) sind weggelassen"),
    ("estimated-noise", "Das Rauschen von Ergebnisgrößen ohne angegebene Unsicherheiten ist aus wiederholten \
        Zeilen und Residuen zusammen geschätzt"),
    ("estimated-noise.from-residuals", "Es gibt weder angegebene Unsicherheiten noch wiederholte Zeilen; \
        das Rauschen ist daher aus den Residuen selbst geschätzt: Eine Abweichung, die wie Rauschen \
        aussieht, ist nicht davon zu unterscheiden, und der Chi-Quadrat-Test gibt keine Auskunft"),
    ("resolution", "Die Werte von {name} sind auf {resolution} gerundet, gröber als ihr Rauschen: Die \
        Rundung zählt als Standardunsicherheit von {deviation}, dieselbe für gleiche Werte unter gleichen \
        Bedingungen"),
    ("many-settings", "Die Residuen von {name} sind in den Zeilen jeder Einstellung ähnlich, als hätten \
        diese eine gemeinsame Abweichung vom etwa {ratio}-Fachen des Rauschens einer Zeile. Abweichungen \
        von Einstellungen werden für höchstens {most} Einstellungen mal Ergebnisgrößen geprüft; hier sind \
        es {errors}. Anzugeben ist eine Eingangsgröße, die für jede Einstellung einen Wert hat (`per`), \
        oder die Mittelwerte der Einstellungen mit ihren Unsicherheiten"),
    ("unit-slip", "Die Werte von {name} sind {rows} etwa das {ratio}-Fache der Werte der Simulation: \
        {cause} würde diesen Faktor erklären; die Einheiten der Daten und der Simulation sind zu prüfen, \
        bevor ein Effekt angenommen wird"),
    ("far-input", "Die Eingangsgröße `{input}` allein würde die Daten erklären, wenn sie {distance} \
        Standardunsicherheiten über ihrem Schätzwert läge{others}. Das ist keine Hypothese, weil die \
        angegebenen Eingangsgrößen nicht in Frage stehen: Zu prüfen sind die Quelle des Werts und seine \
        Unsicherheit"),
    ("far-input.below", "Die Eingangsgröße `{input}` allein würde die Daten erklären, wenn sie {distance} \
        Standardunsicherheiten unter ihrem Schätzwert läge{others}. Das ist keine Hypothese, weil die \
        angegebenen Eingangsgrößen nicht in Frage stehen: Zu prüfen sind die Quelle des Werts und seine \
        Unsicherheit"),
    ("whole-turns", "{far} von {count} Werten von {name} liegen mehr als eine halbe Umdrehung von der \
        Simulation entfernt: Bei einer periodischen Ergebnisgröße ist `\"periodic\": {turn}` anzugeben"),
    ("whole-turns.jumps", "Die Residuen von {name} springen zwischen benachbarten Bedingungen um fast \
        eine Umdrehung, und alle Werte liegen innerhalb einer Umdrehung: Bei einer periodischen \
        Ergebnisgröße ist `\"periodic\": {turn}` anzugeben"),
    ("poor-integral", "Zwei unabhängige Integrale derselben Hypothese unterscheiden sich im Logarithmus \
        der Evidenz um {apart}; die Wahrscheinlichkeiten sind Mittelwerte über diese Abweichung und daher \
        weniger sicher"),
    ("poor-integral.few-draws", "Die Evidenz des Befundes beruht auf nur {draws} effektiven Ziehungen \
        (Standardfehler ihres Logarithmus {error}); die Wahrscheinlichkeiten sind Mittelwerte über diese \
        Abweichung und daher weniger sicher"),
    ("look-alikes", "Diese Daten können die Hypothesen in der Gruppe des Befundes nicht unterscheiden: \
        Ihre Vorhersagen stimmen innerhalb der Unsicherheiten überein. Zwischen ihnen entscheiden nur \
        ihre A-priori-Wahrscheinlichkeiten und die A-priori-Breiten ihrer Größen"),
    ("small-gap", "Die Lücke liegt unter 3 Standardunsicherheiten der Daten; der beseitigte Anteil wäre daher \
        ein Verhältnis zweier Rauschwerte und wird nicht angegeben"),
    ("poor-fit", "Der Befund ist die beste der Hypothesen, hat aber bei ausgelassenen Bedingungen ein \
        Chi-Quadrat von {chi_square} je Wert: Etwas fehlt noch"),
    ("curved-sim", "Bei den Schätzwerten der Eingangsgrößen sind die Residuen {times}-mal so groß, wie \
        das Fortpflanzungsgesetz zulässt, doch andere Werte der Eingangsgrößen innerhalb ihrer \
        Unsicherheiten erklären sie: Die Simulation ist dort in ihren Eingangsgrößen nicht linear"),
    ("row-drift", "Die Residuen von `{name}` nach dem Befund driften über die Zeilen, von der ersten bis \
        zur letzten um das {change}-Fache der Standardabweichung des Rauschens (durch Zufall in einer von \
        10 000 Tabellen). Wurden die Zeilen in dieser Reihenfolge aufgenommen, so ändert sich etwas mit \
        der Zeit: Anzugeben ist die Zeit als Bedingung oder ein Effekt, der driftet; sonst sind die \
        Größen Mittelwerte über die Zeilen"),
    ("row-drift.best-hypothesis", "Die Residuen von `{name}` nach der besten Hypothese driften über die \
        Zeilen, von der ersten bis zur letzten um das {change}-Fache der Standardabweichung des Rauschens \
        (durch Zufall in einer von 10 000 Tabellen). Wurden die Zeilen in dieser Reihenfolge aufgenommen, \
        so ändert sich etwas mit der Zeit: Anzugeben ist die Zeit als Bedingung oder ein Effekt, der \
        driftet; sonst sind die Größen Mittelwerte über die Zeilen"),
    ("row-drift.memory", "Die Residuen von `{name}` ändern sich langsam über die Zeilen: Benachbarte \
        Zeilen haben den Korrelationskoeffizienten {coefficient} (durch Zufall in einer von 10 000 \
        Tabellen). Wurden die Zeilen in dieser Reihenfolge aufgenommen, so ändert sich etwas mit der \
        Zeit, und die angegebenen Unsicherheiten können richtig sein: Anzugeben ist die Zeit als \
        Bedingung oder ein Effekt, der sich mit ihr ändert"),
    ("copied-rows", "Die Zeilen {rows}{more} haben die Bedingungen und auf alle Stellen die Werte der \
        {firsts}. {said}"),
    ("copied-rows.one", "Zeile {copy} hat die Bedingungen und auf alle Stellen die Werte der Zeile {first}. \
        {said}"),
    ("several-rows", "Zeilen {rows}{more}"),
    ("few-conditions", "Es gibt nur {count} verschiedene Bedingungen; Effekte, die sich anderswo \
        unterscheiden, können hier gleich sein"),
    ("few-conditions.one", "Es gibt nur eine Bedingung; Effekte, die sich anderswo unterscheiden, können \
        hier gleich sein"),
    ("periodic-residuals", "Die Residuen von `{name}` folgen längs `{condition}` einem Sinus mit der \
        Periode {period} und der Amplitude {amplitude}, {percent} % ihrer Varianz (durch Zufall in einer \
        von einer Million Tabellen): eine periodische Störung, kein größeres Rauschen. Sie ist als Effekt \
        anzugeben, etwa `{name} + k*sin(2*pi*{condition}/({divisor}) + phi)`"),
    ("periodic-residuals.rows", "Die Residuen von `{name}` folgen längs der Zeilen in ihrer Reihenfolge \
        einem Sinus mit einer Periode von {period} Zeilen und der Amplitude {amplitude}, {percent} % \
        ihrer Varianz (durch Zufall in einer von einer Million Tabellen): eine periodische Störung, kein \
        größeres Rauschen. Sie ist als Effekt anzugeben, etwa `{name} + k*sin(2*pi*row/... + phi)` mit \
        einer Bedingung für Zeit oder Ort der Zeilen"),
    ("prior-conflict", "{who} würde die Daten mit einem Wert von {parameter} erklären, der {distance} \
        {counted_in} liegt (Wahrscheinlichkeit {probability}, mit {widened}-mal so breiten \
        A-priori-Verteilungen)"),
    ("wide-priors", "Die A-priori-Verteilungen der Parameter der Effekte sind so breit, dass eine \
        Abweichung beliebiger Form wahrscheinlicher ist als {effect}; mit {times}-mal so schmalen \
        A-priori-Verteilungen ist {effect} wahrscheinlicher. A-priori-Verteilungen sollten nur so breit \
        sein, wie es das Vorwissen verlangt"),
    ("wide-priors.several", "Die A-priori-Verteilungen der Parameter der Effekte sind so breit, dass eine \
        Abweichung beliebiger Form wahrscheinlicher ist als {effects}; mit {times}-mal so schmalen \
        A-priori-Verteilungen sind {effects} wahrscheinlicher. A-priori-Verteilungen sollten nur so breit \
        sein, wie es das Vorwissen verlangt"),
    ("undefined-prediction", "In {count} von {rows} Zeilen der Vorhersage haben einige Hypothesen keinen \
        Wert (eine Wurzel oder ein Logarithmus einer negativen Zahl, eine Division durch null). Sie \
        bleiben dort weg; wenn sie wahrscheinlicher sind als die übrigen, wird nichts vorhergesagt"),
    ("emulator", "Mit {name} weichen die vorhergesagten Ausgaben des Simulators um etwa {error} \
        Standardunsicherheiten der Daten ab (Norm über alle Zeilen); weniger als {goal} ist \
        vernachlässigbar. Etwa {runs} weitere Läufe sind nötig"),
    ("emulator.plain", "Ohne Effekt weichen die vorhergesagten Ausgaben des Simulators um etwa {error} \
        Standardunsicherheiten der Daten ab (Norm über alle Zeilen); weniger als {goal} ist \
        vernachlässigbar. Etwa {runs} weitere Läufe sind nötig"),
    ("emulator.not-run", "Mit {name} lief der Simulator nie in der Nähe der Parameter, die zu den Daten \
        passen, so dass die Wahrscheinlichkeit auf Läufen anderswo beruht. Etwa {runs} weitere Läufe sind \
        nötig"),
    ("emulator.plain-not-run", "Ohne Effekt lief der Simulator nie in der Nähe der Eingangsgrößen, die zu \
        den Daten passen, so dass die Wahrscheinlichkeit auf Läufen anderswo beruht. Etwa {runs} weitere \
        Läufe sind nötig"),
    ("simulator", "Der Simulator lief {runs}-mal. Bei den angegebenen Parametern weichen seine \
        vorhergesagten Ausgaben um etwa {error} Standardunsicherheiten der Daten ab (Norm über alle \
        Zeilen)"),
    ("simulator.runs", "Der Simulator lief {runs}-mal"),
    ("simulator.scatter", "Von Lauf zu Lauf streut {name} des Simulators bei gleichen Parametern um \
        {deviation} Standardunsicherheiten der Daten, wie {repeats} Läufe am Anfang zeigen. Die Streuung \
        gilt als unabhängig von Zeile zu Zeile und als gleich für alle Parameter. Verglichen wird mit dem \
        Mittelwert des Simulators, dessen Unsicherheit aus der Streuung der Läufe enthalten ist"),
    ("simulator.scatter-correlated", "Von Lauf zu Lauf streut {name} des Simulators bei gleichen \
        Parametern um {deviation} Standardunsicherheiten der Daten, wie {repeats} Läufe am Anfang zeigen. \
        Die Streuung gilt als über die Zeilen korreliert, mit einem Koeffizienten von {correlation} \
        zwischen Nachbarn, der mit seinen Potenzen fällt, und als gleich für alle Parameter. Verglichen \
        wird mit dem Mittelwert des Simulators, dessen Unsicherheit aus der Streuung der Läufe enthalten \
        ist"),
    ("simulator.untold", "Die Daten enthalten keine Information über {names}: Die Unsicherheit ist \
        jeweils wie in der A-priori-Verteilung"),
    ("simulator.together", "Die Daten bestimmen {first} und {second} zusammen, aber keines allein: Ihr \
        Korrelationskoeffizient ist {coefficient}"),
    ("simulator.failed", "{failed} von {runs} Läufen des Simulators schlugen fehl, der erste bei {at}: {why}"),
    ("extrapolation", "{outside} von {rows} Zeilen der Vorhersage liegen außerhalb der Bedingungen der \
        Daten. Kein Effekt der Liste beschreibt die Abweichung dort: Glatte und zusammengesetzte \
        Abweichungen werden mit weniger Gewicht auf ihren Wahrscheinlichkeiten gemittelt, und die \
        Standardunsicherheit wächst mit der Entfernung"),
    ("extrapolation.effects", "{outside} von {rows} Zeilen der Vorhersage liegen außerhalb der \
        Bedingungen der Daten. Die Formeln der Effekte werden dort verwendet, aber die Daten prüfen sie \
        nicht: Hypothesen, die bei den Daten übereinstimmen, können sich dort unterscheiden und werden \
        mit ihren Wahrscheinlichkeiten gemittelt"),
];

/// Facts that only a command knows.
#[rustfmt::skip]
const COMMANDS: Sentences = &[
    ("few-trials.audit", "{trials} Versuche sind zu wenige, um die Wirkung von Annahmen zu erkennen; es \
        werden {made} gemacht"),
    ("more-than-two-digits", "U wird auf {digits} signifikante Stellen angegeben; ein akkreditierter \
        Kalibrierschein darf höchstens zwei haben (ILAC-P14:09/2020, 5.3)"),
    ("rounded-away", "Zeile {row}: U wird als {stated} angegeben, {percent} % weniger als {expanded}; \
        EA-4/02 M:2022, 6.3, erlaubt, dass die Rundung U um höchstens 5 % verringert: `\"rounding\": \
        \"ea\"` rundet dort auf"),
    ("digits-of-trials", "Zeile {row}: Die Werte folgen aus den Versuchen, so dass ihre letzte Stelle vom \
        Startwert abhängt: {why}"),
    ("raised-to-cmc.certificate", "Zeile {row}: U wird auf die Messmöglichkeit (CMC) des Laboratoriums von \
        {cmc} angehoben"),
    ("below-cmc.certificate", "Zeile {row}: U = {expanded} liegt unter der Messmöglichkeit (CMC) des \
        Laboratoriums von {cmc}, was ein akkreditierter Kalibrierschein nicht angeben darf (ILAC-P14); \
        `\"cmc_floor\": true` hebt es an"),
    ("not-stated", "dem Kalibrierschein fehlen Angaben, die ISO/IEC 17025:2017, 7.8.2.1 und 7.8.4.1 \
        verlangen: {missing}"),
    ("evidence-unused", "der Beleg zu `{name}` wird nicht verwendet: Er gilt einer angenommenen Verteilung \
        (Typ B), und diese ist aus Ablesungen ermittelt (Typ A)"),
    ("evidence-unused.constant", "der Beleg zu `{name}` wird nicht verwendet: Er gilt einer angenommenen \
        Verteilung (Typ B), und dies ist eine Konstante"),
    ("evidence-first-row", "`{name}` ist nicht in allen Zeilen dieselbe Größe; der Beleg wird mit der ersten \
        Zeile verglichen"),
    ("variant-undefined", "mit einer anderen Form oder Breite von `{name}` haben einige Versuche kein \
        endliches Ergebnis; diese Varianten haben keine Ergebnisse"),
    ("drawn-together", "{names} werden gemeinsam gezogen; sie haben einen gemeinsamen Sobol-Index"),
    ("drawn-together.ranks", "{names} werden gemeinsam gezogen; sie haben einen gemeinsamen Sobol-Index. Mit \
        einer anderen Form bleibt die Abhängigkeit ihrer Ränge, so dass sich der Korrelationskoeffizient etwas \
        bewegt"),
];

/// Facts that stand within others, and the notes that import gives without a code.
#[rustfmt::skip]
const PARTS: Sentences = &[
    ("moved", "{figure} um {by}"),
    ("figure.estimate", "der Schätzwert"),
    ("figure.standard-uncertainty", "die Standardunsicherheit"),
    ("figure.median", "der Median"),
    ("figure.inside", "die Wahrscheinlichkeit innerhalb der Toleranz"),
    ("figure.symmetric-lower", "der untere Endpunkt des symmetrischen Intervalls"),
    ("figure.symmetric-upper", "der obere Endpunkt des symmetrischen Intervalls"),
    ("figure.shortest-lower", "der untere Endpunkt des kürzesten Intervalls"),
    ("figure.shortest-upper", "der obere Endpunkt des kürzesten Intervalls"),
    ("at", " bei {conditions}"),
    ("condition", "{name} = {value}"),
    ("difference.above", "ist {percent} größer als der GUM-Wert"),
    ("difference.below", "ist {percent} kleiner als der GUM-Wert"),
    ("difference.from-zero", "ist im Unterschied zum GUM-Wert nicht null"),
    ("beyond-bounds", "über alle Schranken"),
    ("in-brackets", " ({dof})"),
    ("few-dof-not-allowed-for", "Beide sind richtig; hier enthält kein Erweiterungsfaktor des GUM dies"),
    ("few-dof-allowed-for", "Beide sind richtig; der GUM berücksichtigt dies im Erweiterungsfaktor"),
    ("few-dof-long-tails", "Der GUM berücksichtigt dies in seinem Erweiterungsfaktor aus einer \
        t-Verteilung, deren lange Ausläufer diese Eingangsgrößen nicht haben"),
    ("non-linear-few-dof", "; wenige Freiheitsgrade{dof} allein würden sie {alone} größer machen"),
    ("non-linear-terms", "; {said}"),
    ("second-order", "mit seinen Gliedern zweiter Ordnung (JCGM 100, 5.1.2, Anmerkung) gibt das \
        Fortpflanzungsgesetz {with_terms} statt {linear}{products}"),
    ("second-order-products", "; {products}"),
    ("squared", "`{name}` im Quadrat"),
    ("times", "`{first}` mal `{second}`"),
    ("contributes", "{product} ergibt {contribution}"),
    ("contributes.hidden", "{product} ergibt {contribution}, obwohl die Empfindlichkeitskoeffizienten hier \
        verschwinden"),
    ("no-deviation", "keine Standardabweichung"),
    ("no-moments", "weder Erwartungswert noch Standardabweichung"),
    ("value-by-propagation", "der Wert ist der Schätzwert nach dem Fortpflanzungsgesetz"),
    ("value-is-median", "der Wert ist der Median"),
    ("beside.given", "in {unit} angegeben"),
    ("beside.computed", "aus einer Größe in {unit} berechnet"),
    ("converted-to.coherent-unit", "{unit} umrechnet, worin Formeln sie schon haben"),
    ("converted-to.unit", "{unit} umrechnet, und {what} in {unit} wird auch umgerechnet: Formeln rechnen in \
        kohärenten SI-Einheiten"),
    ("converted-to.beside", "die Einheit daneben"),
    ("converted-to.number", "eine bloße Zahl"),
    ("with-equations", " mit den Gleichungen, die es aufnimmt,"),
    ("or-turns", "; eine Drehzahl wird statt dessen mit 2*pi multipliziert"),
    ("or-without-unit", ", oder {what} hat keine Einheit"),
    ("computed.rates", "Radiant je Sekunde"),
    ("computed.angles", "Winkeln in Radiant"),
    ("computed.shares", "Anteilen als Zahlen"),
    ("computed.ratios", "Verhältnissen als Zahlen"),
    ("result.output", "die Ausgangsgröße"),
    ("result.quantity", "die Größe"),
    ("result.named-output", "die Ausgangsgröße `{name}`"),
    ("all-of", "{parts} und {last}"),
    ("one-of", "{parts} oder {last}"),
    ("more", "{count} weitere"),
    ("quoted", "`{name}`"),
    ("quoted.hidden", "`{name}` (ausgeblendet)"),
    ("quantity-in-unit", "`{name}` in {unit}"),
    ("more-quantities", ", ..."),
    ("in-row", " in Zeile {row}"),
    ("in-row.and-others", " in Zeile {row} und anderen"),
    ("groups.within", "; Standardabweichung innerhalb der Gruppen {deviation}{between}"),
    ("groups.between", ", zwischen den Gruppen {deviation}, F = {ratio} (Wahrscheinlichkeit eines größeren \
        ohne eine Wirkung der Gruppen {probability})"),
    ("groups.of-other-sizes", "; die Gruppen sind nicht gleich groß, und ihre Mittelwerte zählen gleich"),
    ("pairs", "{pairs}{more}"),
    ("pairs.more", " und {count} weitere Paare"),
    ("pair", "`{first}` und `{second}`"),
    ("pair.correlated", "`{first}` und `{second}` ({coefficient})"),
    ("pair.certified", "`{first}` und `{second}` ({coefficient}, aus `{file}`)"),
    ("pair.moved", "`{first}` und `{second}` ({from} zu {to})"),
    ("pair.with-input", "`{input}` von `{first}` und `{second}` ({reason})"),
    ("other-input.unknown-row", "eine wurde von einer älteren Version gespeichert, die weder Daten noch \
        Zeile angab"),
    ("other-input.row", "aus verschiedenen Zeilen"),
    ("other-input.values-set", "mit anderen gesetzten Werten"),
    ("other-input.figures", "mit anderem Schätzwert oder anderer Standardunsicherheit"),
    ("other-input.unknown-place", "eine wurde von einer älteren Version gespeichert, die die Stelle im \
        Kalibrierschein nicht angab"),
    ("other-input.content", "mit denselben Werten, aber aus Dateien mit verschiedenem Inhalt"),
    ("changed-parts", " ({parts})"),
    ("misfit", "passt nicht zu diesem Modell{why}{condition}{needs}"),
    ("misfit.missing", ", das {quantities} nicht hat"),
    ("misfit.prior", ": Seine A-priori-Verteilung ist {prior}, die die Daten nicht enthalten"),
    ("misfit.unchanged", ", das keine der Größen hat, die er ändert: {quantities}"),
    ("misfit.condition", "; die Bedingung `{name}` ist eingestellt und bekannt: Sie ist durch eine Größe zu \
        ersetzen, die aus der Bedingung berechnet wird, oder durch eine Eingangsgröße, deren Mittelwert die \
        Bedingung ist"),
    ("misfit.anywhere", "; er {needs}"),
    ("misfit.on-bench", "; für den Prüfstand `{bench}` gilt: Er {needs}"),
    ("misfit.needs", "braucht {quantities}"),
    ("misfit.changes", "ändert {quantities}"),
    ("misfit.history", "passt nicht zu diesen Daten: Die Reihenfolge ihrer Zeilen trennt seine \
        Vorgeschichte nicht von den Bedingungen, zum Beispiel weil eine Bedingung nur steigt"),
    ("misfit.no-change", "ändert keine beobachtete Ausgangsgröße"),
    ("misfit.refused", "kann auf dieses Modell nicht wirken: {error}"),
    ("observed.amplitudes", "jede beobachtete Ausgangsgröße, die keine Phase ist"),
    ("observed.phases", "jede beobachtete Ausgangsgröße, die eine Phase ist"),
    ("import.columns", "Zeile {row}: Spalten {columns}"),
    ("import.column", "`{heading}` als {name}{unit}"),
    ("import.in-unit", " in {unit}"),
    ("import.named-column", "Spalte {letter} `{heading}`"),
    ("import.hidden-column", "{column} ist ausgeblendet und wird gelesen"),
    ("import.column-not-read", "{column} wird nicht gelesen"),
    ("import.column-remark", "{column} bleibt als Bemerkung erhalten"),
    ("import.merged-cell", "die verbundene Zelle `{text}` gilt für die Zeilen {first} bis {last}"),
    ("import.row-not-read", "Zeile {row} `{text}` wird nicht gelesen"),
    ("import.row-without-numbers", "Zeile {row} `{text}` hat keine Zahlen und wird nicht gelesen"),
    ("import.row-constant", "Zeile {row} `{text}` hat keine Unsicherheit und ist eine Konstante der \
        Gleichung"),
    ("import.row-named", "Zeile {row}: `{words}` heißt `{name}`"),
    ("import.distribution", "Zeile {row}: Die Standardunsicherheit von `{text}` wird verwendet, wie bei \
        einer Normalverteilung"),
    ("import.dof", "Zeile {line}: {dof} Freiheitsgrade werden aus `{text}` gelesen"),
    ("import.equation", "die Gleichung {name} = {formula}"),
    ("import.unit-of-result", "das Ergebnis ist in `{unit}`, der kohärenten Einheit seiner Gleichung"),
    ("import.constant", "die Konstante {constant} wird addiert, die den Schätzwert des Ergebnisses ergibt: \
        Das Modell ist um die Schätzwerte linear"),
    ("import.sum", "{name} = {formula}: die Summe der Größen mal ihren Empfindlichkeitskoeffizienten, in \
        {unit}"),
    ("import.unchanged", "die Modelldatei dieser Arbeitsmappe; kein Schätzwert, keine Standardunsicherheit, \
        keine Freiheitsgrade und keine Korrelation wurden geändert, und andere Zellen werden nicht beachtet"),
    ("import.changed-estimate", "`{name}`: Schätzwert {now} statt {before}"),
    ("import.changed-uncertainty", "`{name}`: Standardunsicherheit {now} statt {before}"),
    ("import.changed-dof", "`{name}`: Freiheitsgrade {now} statt {before}"),
    ("import.changed-probability", "Überdeckungswahrscheinlichkeit {now} statt {before}"),
    ("import.changed-correlation", "{name} = {coefficient}"),
    ("import.normal-now", "`{name}` ist jetzt normalverteilt: Die bisherige Verteilung ({distribution}) \
        passt nicht zu den geänderten Zellen"),
    ("of-time-column", "die Zeitspalte hat"),
    ("of-header", "der Dateikopf nennt"),
    ("highest", "höchste"),
    ("lowest", "kleinste"),
    ("sample-of-time", "Abtastwert {sample}, die Zeit"),
    ("sample-of-channel", "Abtastwert {sample}, Kanal `{channel}`"),
    ("frequency-in-other-unit", " ({number} {unit} sind {hertz} Hz)"),
    ("peak-amplitude", "{amplitude} (Scheitelwert)"),
    ("higher-multiple", ": das Vielfache {multiple} der Frequenz, und `harmonics` ist {harmonics}"),
    ("far-sample", "{value} bei {at} s"),
    ("and-more", " und {count} weitere"),
    ("noise-of-parts", "das Rauschen nahe jeder Frequenz wird aus {parts} Teilen der Aufzeichnung bestimmt"),
    ("noise-of-process", "das Rauschen nahe jeder Frequenz wird einem Prozess erster Ordnung entnommen, der \
        die Residuen beschreibt"),
    ("noise-of-process.before-steps", "das Rauschen nahe jeder Frequenz nach den Schritten wird einem Prozess \
        erster Ordnung entnommen, der diese Residuen beschreibt"),
    ("noise-even", "die Aufzeichnung ist zu kurz, um das Rauschen nahe jeder Frequenz zu bestimmen; es \
        gilt als gleichmäßig über das Band der Schritte, so dass Standardunsicherheiten vielleicht zu \
        klein sind"),
    ("noise-unknown", "die Aufzeichnung ist zu kurz, um das Rauschen nahe jeder Frequenz zu bestimmen, so dass \
        Standardunsicherheiten vielleicht zu klein sind"),
    ("other-tone", "{frequency} Hz (Amplitude {amplitude})"),
    ("slip-in-all-rows", "in allen Zeilen"),
    ("slip-in-rows", "in den Zeilen {first} bis {last} (in den übrigen stimmen sie mit ihr überein)"),
    ("slip-in-rows.some", "in {count} der Zeilen {first} bis {last} (in den übrigen stimmen sie mit ihr \
        überein)"),
    ("slip-of.prefix", "ein Vorsatz oder Prozent"),
    ("slip-of.sign", "ein Vorzeichen"),
    ("slip-of.turn", "eine Frequenz in Hz statt in rad/s"),
    ("slip-of.minute", "eine Zeit in Minuten statt in Sekunden oder ein Winkel in Minuten statt in Grad"),
    ("slip-of.hour", "eine Zeit in Stunden statt in Sekunden"),
    ("slip-of.degree", "ein Winkel in Grad statt in rad"),
    ("slip-of.peak", "ein Effektivwert statt eines Scheitelwerts"),
    ("other-far-inputs", ". Das gilt auch für {inputs}, weiter von ihren Schätzwerten entfernt"),
    ("scatter", "Die Residuen sind {times}-mal so groß, wie ihre Unsicherheiten zulassen, aber ohne ein \
        Muster, das ein Effekt oder eine glatte Diskrepanz ergäbe: Das angegebene Rauschen ist wahrscheinlich \
        zu klein, oder einzelne Werte sind falsch"),
    ("one-row", "Zeile {row}"),
    ("range-of-rows", "{first} bis {last}"),
    ("copies-count-once", "Unabhängige Messwerte mit den angegebenen Unsicherheiten würden sich mit einer \
        Wahrscheinlichkeit unter {below} so oft wiederholen: Die wiederholten Werte wurden kopiert, oder \
        die Zeilen haben eine gemeinsame Unsicherheit, so dass sie keine neue Information enthalten. \
        Diese Zeilen zählen einmal, {counted} von {all}"),
    ("copies-count-once.one", "Unabhängige Messwerte mit den angegebenen Unsicherheiten würden einander \
        mit einer Wahrscheinlichkeit unter {below} wiederholen: Der wiederholte Wert wurde kopiert, oder \
        die Zeilen haben eine gemeinsame Unsicherheit, so dass er keine neue Information enthält. Diese \
        Zeilen zählen einmal, {counted} von {all}"),
    ("copies-unknown", "Ohne angegebene Unsicherheiten ist unbekannt, ob sie gemessen wurden; sie zählen \
        daher mit eigenem Rauschen. Wurden sie kopiert, so ist die Diagnose zu sicher oder findet eine \
        Lücke, die es nicht gibt: Diese Zeilen sind wegzulassen, wenn sie nicht gemessen wurden"),
    ("copies-unknown.one", "Ohne angegebene Unsicherheiten ist unbekannt, ob sie gemessen wurde; sie \
        zählt daher mit eigenem Rauschen. Wurde sie kopiert, so ist die Diagnose zu sicher oder findet \
        eine Lücke, die es nicht gibt: Diese Zeilen sind wegzulassen, wenn sie nicht gemessen wurden"),
    ("copies-by-chance", "Durch Zufall ist dies selten, doch sie können gemessen sein; sie zählen daher \
        mit eigenem Rauschen. Wurden sie kopiert, so ist die Diagnose zu sicher oder findet eine Lücke, \
        die es nicht gibt: Diese Zeilen sind wegzulassen, wenn sie nicht gemessen wurden"),
    ("copies-by-chance.one", "Durch Zufall ist dies selten, doch sie kann gemessen sein; sie zählt daher \
        mit eigenem Rauschen. Wurde sie kopiert, so ist die Diagnose zu sicher oder findet eine Lücke, \
        die es nicht gibt: Diese Zeilen sind wegzulassen, wenn sie nicht gemessen wurden"),
    ("effect-alone", "{effect} allein"),
    ("effects-together", "{others} zusammen mit {last}"),
    ("widths-beyond-bound", "A-priori-Breiten jenseits der Grenze der A-priori-Verteilung"),
    ("deviations-from-mean", "Standardabweichungen der A-priori-Verteilung von ihrem Erwartungswert entfernt"),
    ("effect-with", "{first} mit {second}"),
    ("of-model", "{model}: "),
    ("of-row", "Zeile {row}, "),
];
