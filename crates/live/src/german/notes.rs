//! Notes on an evaluation, in the form of [`super::sentences`].

/// Notes of the engine and of the readers. The first one that fits is taken.
pub(super) const NOTES: &[(&str, &str)] = &[
    (
        "{} trials are few for a coverage probability of {}: JCGM 101, 7.2.2 advises at least {}",
        "{0} Versuche sind wenige für die Überdeckungswahrscheinlichkeit {1}: JCGM 101, 7.2.2 rät zu mindestens {2}",
    ),
    (
        "the declared correlation coefficients are possible only within their rounding; the nearest possible ones are used in the trials",
        "die angegebenen Korrelationskoeffizienten sind nur innerhalb ihrer Rundung möglich; in den Versuchen stehen die nächsten möglichen",
    ),
    (
        "{} of {} trials are not finite and were left out",
        "{0} von {1} Versuchen sind nicht endlich und wurden weggelassen",
    ),
    (
        "{} are drawn by a Gaussian copula, fitted so that they have their distributions and the declared correlation coefficients; the coefficients do not say more about their joint distribution, so this is an assumption",
        "{0} werden durch eine Gauß-Copula gezogen, die so angepasst ist, dass sie ihre Verteilungen und die angegebenen Korrelationskoeffizienten haben; mehr sagen die Koeffizienten über ihre gemeinsame Verteilung nicht, so dass dies eine Annahme ist",
    ),
    (
        "a Gaussian copula gives the correlation coefficients of these saved results only nearly; in the trials they differ by up to {}. Where outputs of one result nearly cancel, evaluate the whole in one model",
        "eine Gauß-Copula gibt die Korrelationskoeffizienten dieser gespeicherten Ergebnisse nur ungefähr; in den Versuchen weichen sie um bis zu {0} ab. Wo sich Größen eines Ergebnisses fast aufheben, ist das Ganze in einem Modell auszuwerten",
    ),
    (
        "a Gaussian copula gives the declared correlation coefficients only within their rounding; in the trials they differ by up to {}",
        "eine Gauß-Copula gibt die angegebenen Korrelationskoeffizienten nur innerhalb ihrer Rundung; in den Versuchen weichen sie um bis zu {0} ab",
    ),
    (
        "{}: numbers of double precision, with 16 digits, leave {} of {} undetermined, {} % of its standard uncertainty: it is {} with a standard uncertainty of {}; make it the difference from a reference value",
        "{0+}: Zahlen doppelter Genauigkeit mit 16 Stellen lassen {1} von {2} unbestimmt, {3} % der Standardunsicherheit: Die Größe ist {4} mit der Standardunsicherheit {5}; anzugeben ist der Unterschied zu einem Bezugswert",
    ),
    (
        "{}: a product, a quotient or a power in its equations is below the smallest number of double precision, 2.2e-308, and counts as less than it is; choose units of the size of the quantities",
        "{0+}: Ein Produkt, ein Quotient oder eine Potenz der Gleichungen liegt unter der kleinsten Zahl doppelter Genauigkeit, 2,2e-308, und zählt weniger, als es ist; zu wählen sind Einheiten von der Größe der Messgrößen",
    ),
    (
        "{}: its trials have no standard deviation that means something, so its correlation coefficients are those of the law of propagation",
        "{0+}: Die Versuche haben keine Standardabweichung, die etwas bedeutet; die Korrelationskoeffizienten sind daher die des Fortpflanzungsgesetzes",
    ),
    (
        "{}: its trials have no standard deviation that means something, and there is no GUM evaluation, so it has no correlation coefficients",
        "{0+}: Die Versuche haben keine Standardabweichung, die etwas bedeutet, und es gibt keine Auswertung nach dem GUM; es gibt daher keine Korrelationskoeffizienten",
    ),
    (
        "{}: figures of the trials are farther from those without their noise than {} numerical standard errors: {}",
        "{0}: Angaben der Versuche liegen weiter von denen ohne ihr Rauschen als {1} numerische Standardfehler: {2+}",
    ),
    (
        "the expanded uncertainty of {} is below the laboratory's capability (CMC) and raised to it: {} is to be stated",
        "die erweiterte Unsicherheit von {0} liegt unter der Messmöglichkeit (CMC) des Laboratoriums und wird auf sie angehoben: Anzugeben ist {1}",
    ),
    (
        "the expanded uncertainty of {} is {}, below the laboratory's capability (CMC) of {}, and must not be stated (ILAC-P14)",
        "die erweiterte Unsicherheit von {0} ist {1}, liegt unter der Messmöglichkeit (CMC) des Laboratoriums von {2} und darf nicht angegeben werden (ILAC-P14)",
    ),
    (
        "{}: the estimate or a sensitivity coefficient is not finite at the inputs' estimates, so there is no GUM evaluation",
        "{0+}: Der Schätzwert oder ein Empfindlichkeitskoeffizient ist bei den Schätzwerten der Eingangsgrößen nicht endlich, so dass es keine Auswertung nach dem GUM gibt",
    ),
    (
        "{}: correlated inputs have finite degrees of freedom, for which the Welch-Satterthwaite formula does not hold; the stated factor k = {} is used as it stands",
        "{0+}: Korrelierte Eingangsgrößen haben endliche Freiheitsgrade, für die die Welch-Satterthwaite-Formel nicht gilt; der angegebene Faktor k = {1} bleibt, wie er ist",
    ),
    (
        "{}: correlated inputs have finite degrees of freedom, for which the Welch-Satterthwaite formula does not hold; the Monte Carlo interval is the way, or a stated {}",
        "{0+}: Korrelierte Eingangsgrößen haben endliche Freiheitsgrade, für die die Welch-Satterthwaite-Formel nicht gilt; es bleibt das Monte-Carlo-Intervall oder ein angegebener {1}",
    ),
    (
        "{}: a few of the {} trials carry their standard uncertainty (excess kurtosis {}), so that its distribution may have no expectation and no standard deviation (JCGM 101, 3.6, note 1): estimate and standard uncertainty of the trials are of these trials alone and have no numerical standard error; median and coverage intervals stand",
        "{0+}: Wenige der {1} Versuche tragen ihre Standardunsicherheit (Exzess {2}), so dass die Verteilung vielleicht keinen Erwartungswert und keine Standardabweichung hat (JCGM 101, 3.6, Anmerkung 1): Schätzwert und Standardunsicherheit der Versuche gelten nur für diese Versuche und haben keinen numerischen Standardfehler; Median und Überdeckungsintervalle gelten",
    ),
    (
        "{}: after {} trials the figures are not yet stable to the tolerance {}; the numerical standard errors say how far they are",
        "{0+}: Nach {1} Versuchen sind die Angaben noch nicht auf die Toleranz {2} stabil; wie weit sie es sind, sagen die numerischen Standardfehler",
    ),
    (
        "{}: an input is drawn from a t distribution with {} degrees of freedom, which has no variance, so the trials have no standard uncertainty; the coverage intervals stand",
        "{0+}: Eine Eingangsgröße wird aus einer t-Verteilung mit {1} Freiheitsgraden gezogen, die keine Varianz hat, so dass die Versuche keine Standardunsicherheit haben; die Überdeckungsintervalle gelten",
    ),
    (
        "{}: an input is drawn from a t distribution with {} degrees of freedom, which has no expectation and no variance, so the trials have no estimate and no standard uncertainty; the coverage intervals stand",
        "{0+}: Eine Eingangsgröße wird aus einer t-Verteilung mit {1} Freiheitsgraden gezogen, die keinen Erwartungswert und keine Varianz hat, so dass die Versuche keinen Schätzwert und keine Standardunsicherheit haben; die Überdeckungsintervalle gelten",
    ),
    (
        "{}: the Monte Carlo standard uncertainty {} because standard uncertainties of inputs have few degrees of freedom{}: what is drawn for them has a larger standard deviation, which alone makes {}. Neither is wrong; the GUM allows for it in the coverage factor",
        "{0+}: Die Standardunsicherheit der Monte-Carlo-Methode {1:}, weil Standardunsicherheiten von Eingangsgrößen wenige Freiheitsgrade haben{2}: Was für sie gezogen wird, hat eine größere Standardabweichung, was allein {3} ausmacht. Keine von beiden ist falsch; der GUM trägt dem im Erweiterungsfaktor Rechnung",
    ),
    (
        "{}: the Monte Carlo standard uncertainty {} because standard uncertainties of inputs have few degrees of freedom{}: what is drawn for them has a larger standard deviation, which alone makes {}. The GUM allows for it in its coverage factor, that of a t distribution, whose long tails these inputs do not have",
        "{0+}: Die Standardunsicherheit der Monte-Carlo-Methode {1:}, weil Standardunsicherheiten von Eingangsgrößen wenige Freiheitsgrade haben{2}: Was für sie gezogen wird, hat eine größere Standardabweichung, was allein {3} ausmacht. Der GUM trägt dem in seinem Erweiterungsfaktor Rechnung, dem einer t-Verteilung, deren lange Ausläufer diese Eingangsgrößen nicht haben",
    ),
    (
        "{}: the Monte Carlo standard uncertainty {} because the model is not linear over the uncertainties of its inputs. Take the Monte Carlo figures",
        "{0+}: Die Standardunsicherheit der Monte-Carlo-Methode {1:}, weil das Modell über die Unsicherheiten seiner Eingangsgrößen nicht linear ist. Die Angaben der Monte-Carlo-Methode sind zu nehmen",
    ),
    (
        "{}: the Monte Carlo standard uncertainty {} because the model is not linear over the uncertainties of its inputs; few degrees of freedom{} alone would bring it {} above; {}. Take the Monte Carlo figures",
        "{0+}: Die Standardunsicherheit der Monte-Carlo-Methode {1:}, weil das Modell über die Unsicherheiten seiner Eingangsgrößen nicht linear ist; wenige Freiheitsgrade{2} allein brächten sie {3:} darüber; {4:}. Die Angaben der Monte-Carlo-Methode sind zu nehmen",
    ),
    (
        "{}: the Monte Carlo standard uncertainty {} because the model is not linear over the uncertainties of its inputs; few degrees of freedom{} alone would bring it {} above. Take the Monte Carlo figures",
        "{0+}: Die Standardunsicherheit der Monte-Carlo-Methode {1:}, weil das Modell über die Unsicherheiten seiner Eingangsgrößen nicht linear ist; wenige Freiheitsgrade{2} allein brächten sie {3:} darüber. Die Angaben der Monte-Carlo-Methode sind zu nehmen",
    ),
    (
        "{}: the Monte Carlo standard uncertainty {} because the model is not linear over the uncertainties of its inputs; {}. Take the Monte Carlo figures",
        "{0+}: Die Standardunsicherheit der Monte-Carlo-Methode {1:}, weil das Modell über die Unsicherheiten seiner Eingangsgrößen nicht linear ist; {2:}. Die Angaben der Monte-Carlo-Methode sind zu nehmen",
    ),
    ("is {} above that of the GUM", "liegt {0} über der des GUM"),
    ("is {} below that of the GUM", "liegt {0} unter der des GUM"),
    ("is not zero as that of the GUM is", "ist nicht null wie die des GUM"),
    ("beyond all bounds", "über alle Schranken"),
    (
        "with its terms of second order (JCGM 100, 5.1.2, note) the law of propagation gives {} instead of {}; {}",
        "mit seinen Gliedern zweiter Ordnung (JCGM 100, 5.1.2, Anmerkung) gibt das Fortpflanzungsgesetz {0} statt {1}; {2+}",
    ),
    (
        "with its terms of second order (JCGM 100, 5.1.2, note) the law of propagation gives {} instead of {}",
        "mit seinen Gliedern zweiter Ordnung (JCGM 100, 5.1.2, Anmerkung) gibt das Fortpflanzungsgesetz {0} statt {1}",
    ),
    (
        "{}: with its terms of second order (JCGM 100, 5.1.2, note) the law of propagation gives {} instead of {}; {}",
        "{0+}: Mit seinen Gliedern zweiter Ordnung (JCGM 100, 5.1.2, Anmerkung) gibt das Fortpflanzungsgesetz {1} statt {2}; {3+}",
    ),
    (
        "{}: with its terms of second order (JCGM 100, 5.1.2, note) the law of propagation gives {} instead of {}",
        "{0+}: Mit seinen Gliedern zweiter Ordnung (JCGM 100, 5.1.2, Anmerkung) gibt das Fortpflanzungsgesetz {1} statt {2}",
    ),
    (
        "{}: {} trials are so few for this coverage probability that the Monte Carlo interval is that of the extreme ones, which has no numerical standard error; clause 8 is left undecided",
        "{0+}: {1} Versuche sind für diese Überdeckungswahrscheinlichkeit so wenige, dass das Monte-Carlo-Intervall das der äußersten ist, das keinen numerischen Standardfehler hat; Abschnitt 8 bleibt unentschieden",
    ),
    (
        "{}: outputs of a saved result nearly cancel, and the {} trials that the result holds tell how they vary together to about {} only, of a standard uncertainty of {} in the trials here; evaluate the whole in one model",
        "{0+}: Größen eines gespeicherten Ergebnisses heben sich fast auf, und die {1} Versuche, die das Ergebnis enthält, sagen nur auf etwa {2}, wie sie gemeinsam schwanken, bei einer Standardunsicherheit von {3} in den Versuchen hier; das Ganze ist in einem Modell auszuwerten",
    ),
    (
        "{}: with the correlation coefficients that the Gaussian copula gives in place of those of the inputs, its standard uncertainty in the trials is about {}, not {}",
        "{0+}: Mit den Korrelationskoeffizienten, die die Gauß-Copula an Stelle derer der Eingangsgrößen gibt, ist die Standardunsicherheit in den Versuchen etwa {1}, nicht {2}",
    ),
    (
        "{}: {} % of the trials lie a turn away from the others, beyond the cut of the {}; write {} at the output, which takes its values within half a turn of the estimate",
        "{0}: {1} % der Versuche liegen eine Umdrehung von den anderen entfernt, jenseits des Schnitts von {2}; {3} bei der Ergebnisgröße nimmt ihre Werte innerhalb einer halben Umdrehung um den Schätzwert",
    ),
    // of the file
    (
        "the width of {} follows its estimate and becomes 0 in row {} and others; it is a constant there",
        "die Breite von {0} folgt ihrem Schätzwert und wird in Zeile {1} und anderen 0; dort ist sie eine Konstante",
    ),
    (
        "the width of {} follows its estimate and becomes 0; it is a constant there",
        "die Breite von {0} folgt ihrem Schätzwert und wird 0; dort ist sie eine Konstante",
    ),
    (
        "the share of reading in the width of {} is 0 in row {} and others, as its estimate is; of another quantity's value it would be {}",
        "der Anteil vom Messwert in der Breite von {0} ist in Zeile {1} und anderen 0, wie ihr Schätzwert; vom Wert einer anderen Größe wäre er {2}",
    ),
    (
        "the share of reading in the width of {} is 0 in row {}, as its estimate is; of another quantity's value it would be {}",
        "der Anteil vom Messwert in der Breite von {0} ist in Zeile {1} 0, wie ihr Schätzwert; vom Wert einer anderen Größe wäre er {2}",
    ),
    (
        "the readings of {} have the mean {}, more than three of its standard uncertainties from {}, the estimate that {} is given: only their scatter counts; leave the estimate out to take their mean",
        "die Ablesungen von {0} haben den Mittelwert {1}, mehr als drei seiner Standardunsicherheiten von {2} entfernt, dem Schätzwert, der für {3} angegeben ist: Nur ihre Streuung zählt; ohne den angegebenen Schätzwert gilt ihr Mittelwert",
    ),
    (
        "the estimate {} of the component {} is added to {}, that of {}: together {}; components are deviations, about 0",
        "der Schätzwert {0} des Anteils {1} wird zu {2} addiert, dem von {3}: zusammen {4}; Anteile sind Abweichungen, um 0 herum",
    ),
    (
        "the share of reading in the width of {} is 0, as its estimate is; of another quantity's value it would be {}",
        "der Anteil vom Messwert in der Breite von {0} ist 0, wie ihr Schätzwert; vom Wert einer anderen Größe wäre er {1}",
    ),
    (
        "the width of {} follows its estimate and becomes 0 in row {}; it is a constant there",
        "die Breite von {0} folgt ihrem Schätzwert und wird in Zeile {1} 0; dort ist sie eine Konstante",
    ),
    (
        "{}: the scatter of the readings is below what the resolution leaves unknown, which is taken in its place as a rectangular distribution (JCGM 100, F.2.2.1)",
        "{0}: Die Streuung der Messwerte liegt unter dem, was die Auflösung offen lässt; dies steht an ihrer Stelle als Rechteckverteilung (JCGM 100, F.2.2.1)",
    ),
    (
        "{}: all readings are equal and show no scatter; it is a constant beside the other components, one of which has to be the resolution",
        "{0}: Alle Messwerte sind gleich und zeigen keine Streuung; sie sind eine Konstante neben den anderen Komponenten, von denen eine die Auflösung sein muss",
    ),
    (
        "{} is the mean of {} groups of readings; its standard uncertainty is that of the means of the groups, with {} degrees of freedom (JCGM 100, H.5); standard deviation within groups {}, between groups {}, F = {} (probability of a larger one without an effect of the groups {})",
        "{0} ist der Mittelwert von {1} Gruppen von Messwerten; die Standardunsicherheit ist die der Gruppenmittel mit {2} Freiheitsgraden (JCGM 100, H.5); Standardabweichung innerhalb der Gruppen {3}, zwischen den Gruppen {4}, F = {5} (Wahrscheinlichkeit eines größeren ohne eine Wirkung der Gruppen {6})",
    ),
    (
        "{} is the mean of {} groups of readings; its standard uncertainty is that of the means of the groups, with {} degrees of freedom (JCGM 100, H.5); standard deviation within groups {}",
        "{0} ist der Mittelwert von {1} Gruppen von Messwerten; die Standardunsicherheit ist die der Gruppenmittel mit {2} Freiheitsgraden (JCGM 100, H.5); Standardabweichung innerhalb der Gruppen {3}",
    ),
    (
        "{} is the mean of {} groups of readings; its standard uncertainty is that of the means of the groups, with {} degrees of freedom (JCGM 100, H.5)",
        "{0} ist der Mittelwert von {1} Gruppen von Messwerten; die Standardunsicherheit ist die der Gruppenmittel mit {2} Freiheitsgraden (JCGM 100, H.5)",
    ),
    (
        "{}: the {} readings drift: a straight line through them changes by {} from the first to the last; one as steep comes from independent readings in at most 1 case of 100. s/sqrt(n) holds for independent readings only (JCGM 100, 4.2.7): correct the drift, or state what it leaves",
        "{0}: Die {1} Messwerte driften: Eine Gerade durch sie ändert sich vom ersten zum letzten um {2}; eine so steile kommt bei unabhängigen Messwerten in höchstens 1 von 100 Fällen vor. s/sqrt(n) gilt nur für unabhängige Messwerte (JCGM 100, 4.2.7): Die Drift ist zu korrigieren, oder es ist anzugeben, was sie übrig lässt",
    ),
    (
        "{}: the {} readings are not independent: each is near the one before it (von Neumann's ratio {}, 2 for independent readings; one as small comes from those in at most 1 case of 100). s/sqrt(n) is too small then (JCGM 100, 4.2.7): take readings further apart, or means of groups",
        "{0}: Die {1} Messwerte sind nicht unabhängig: Jeder liegt nahe am vorigen (von-Neumann-Verhältnis {2}, 2 bei unabhängigen Messwerten; ein so kleines kommt bei diesen in höchstens 1 von 100 Fällen vor). s/sqrt(n) ist dann zu klein (JCGM 100, 4.2.7): Messwerte in größeren Abständen oder Mittelwerte von Gruppen helfen",
    ),
    (
        "{} has no digest of itself, as those of older versions: whether it was changed since it was saved cannot be told",
        "{0} hat keine Prüfsumme seiner selbst, wie die älterer Versionen: Ob es seit dem Speichern geändert wurde, ist nicht zu sagen",
    ),
    (
        "{} was changed since it was saved{}, and is taken all the same",
        "{0} wurde seit dem Speichern geändert{1} und wird dennoch genommen",
    ),
    ("effect {}, override of {}: {}", "Effekt {0}, Ersatz für {1}: {2}"),
    (
        "{} is a number of degrees Celsius by the unit of a coefficient, and is reported in {} as a difference; write kelvin(...) for a thermodynamic temperature, or report it in degC",
        "{0} ist nach der Einheit eines Koeffizienten eine Zahl von Grad Celsius und wird in {1} als Differenz angegeben; kelvin(...) steht für eine thermodynamische Temperatur, oder sie ist in degC anzugeben",
    ),
    (
        "CHECK THIS RESULT: {}. Earlier versions converted them to SI units first, such as {} from {}, and gave other results for this file. If its formulas are written for the declared units, they are right now: say so with \"format\": 2. If they are written for SI units, declare the quantities in SI units",
        "DIESES ERGEBNIS PRÜFEN: {0:}. Frühere Versionen rechneten sie erst in SI-Einheiten um, etwa {1} aus {2}, und gaben für diese Datei andere Ergebnisse. Sind die Formeln für die angegebenen Einheiten geschrieben, so stimmen sie jetzt: \"format\": 2 sagt es. Sind sie für SI-Einheiten geschrieben, so sind die Größen in SI-Einheiten anzugeben",
    ),
    (
        "units are not checked: every quantity is a plain number",
        "Einheiten werden nicht geprüft: Jede Größe ist eine bloße Zahl",
    ),
    (
        "units are not checked: formulas compute with the numbers in the declared units ({})",
        "Einheiten werden nicht geprüft: Die Formeln rechnen mit den Zahlen in den angegebenen Einheiten ({0})",
    ),
    (
        "{} takes values from {} through the {} points of {} ({} to {}); {} differ by at most {} half way between them, which is in no uncertainty unless an input states it",
        "{0} nimmt Werte von {1:} durch die {2} Punkte von {3} ({4} bis {5}); {6:} weichen auf halbem Weg zwischen ihnen um höchstens {7} ab, was in keiner Unsicherheit steckt, wenn keine Eingangsgröße es angibt",
    ),
    (
        "{} takes values from {} through the {} points of {} ({} to {}); {} differs by at most {} half way between them, which is in no uncertainty unless an input states it",
        "{0} nimmt Werte von {1:} durch die {2} Punkte von {3} ({4} bis {5}); {6:} weicht auf halbem Weg zwischen ihnen um höchstens {7} ab, was in keiner Unsicherheit steckt, wenn keine Eingangsgröße es angibt",
    ),
    ("a cubic spline", "kubischen Splines"),
    ("straight lines", "Geraden"),
    (
        "the points do not agree with {}: chi-squared is {} with {} degrees of freedom, above its 95 % quantile {}; the form or the stated uncertainties are wrong",
        "die Punkte passen nicht zu {0}: Chi-Quadrat ist {1} mit {2} Freiheitsgraden, über seinem 95-%-Quantil {3}; die Form oder die angegebenen Unsicherheiten sind falsch",
    ),
    (
        "{}: {} calls its distribution {}, which is none that is known here; a normal distribution with its standard uncertainty is taken",
        "{0}: {1} nennt die Verteilung {2}, die hier nicht bekannt ist; genommen wird eine Normalverteilung mit der angegebenen Standardunsicherheit",
    ),
    (
        "{}: where {} states a standard uncertainty with a coverage interval, it is taken in place of U over k, whose digits are rounded",
        "{0}: Wo {1} mit einem Überdeckungsintervall eine Standardunsicherheit angibt, wird diese genommen und nicht U geteilt durch k, deren Stellen gerundet sind",
    ),
    (
        "correlation coefficients of a certificate that its results cannot have with the distributions that they are read with are the nearest possible: {}",
        "Korrelationskoeffizienten eines Kalibrierscheins, die seine Ergebnisse mit den Verteilungen, mit denen sie gelesen werden, nicht haben können, sind die nächsten möglichen: {0+}",
    ),
    (
        "correlation coefficients between results of one certificate are kept: {}",
        "Korrelationskoeffizienten zwischen Ergebnissen eines Kalibrierscheins bleiben erhalten: {0+}",
    ),
    (
        "the correlation of saved results is kept: {}",
        "die Korrelation gespeicherter Ergebnisse bleibt erhalten: {0+}",
    ),
    (
        "of {} only the correlation coefficients are known, not how they vary together, because their result was saved by an older version; save it again",
        "von {0+} sind nur die Korrelationskoeffizienten bekannt, nicht wie sie gemeinsam schwanken, weil ihr Ergebnis von einer älteren Version gespeichert wurde; es ist neu zu speichern",
    ),
    (
        "{} may depend on each other, because their results go back to the same model file, but one of them has no finite sensitivity coefficients, so the dependence cannot be told; they are taken as independent",
        "{0+} hängen vielleicht voneinander ab, weil ihre Ergebnisse auf dieselbe Modelldatei zurückgehen; da eine der Größen keine endlichen Empfindlichkeitskoeffizienten hat, ist die Abhängigkeit nicht zu sagen; sie werden als unabhängig genommen",
    ),
    (
        "{} is {} rad, which are more than a turn, as a phase without a unit is in radians; one in degrees says {}",
        "{0} ist {1} rad, mehr als eine Umdrehung, denn eine Phase ohne Einheit ist in Radiant angegeben; eine in Grad sagt {2}",
    ),
    (
        "in {}, {} is {} rad, as {} is given in {}; {} {} are written {}",
        "in {0} ist {1} der Winkel {2} rad, denn {3} ist in {4} angegeben; {5} {6} werden {7} geschrieben",
    ),
    (
        "in {}, {} is the number {}, that is {}, as {} is given in {}; {} {} are written {}",
        "in {0} ist {1} die Zahl {2}, das sind {3}, denn {4} ist in {5} angegeben; {6} {7} werden {8} geschrieben",
    ),
    (
        "{} converts to radians once more: formulas have an angle in {} in radians already, so that its name is enough",
        "{0} rechnet noch einmal in Radiant um: Formeln haben einen Winkel in {1} schon in Radiant, so dass sein Name genügt",
    ),
    (
        "{} converts from {} once more: formulas have a share in {} as a plain number already, so that its name is enough",
        "{0} rechnet noch einmal aus {1} um: Formeln haben einen Anteil in {2} schon als Zahl, so dass sein Name genügt",
    ),
    (
        "{} is used at x = {}, and its points lie from {} to {}: beyond them nothing says that the form holds, and the stated uncertainty supposes that it does",
        "{0} wird bei x = {1} verwendet, und die Punkte liegen zwischen {2} und {3}: Darüber hinaus sagt nichts, dass die Form gilt, und die angegebene Unsicherheit setzt es voraus",
    ),
    (
        "{} converts to radians per second once more: formulas have what is given in {} in radians per second already, so that its name is enough",
        "{0} rechnet noch einmal in Radiant je Sekunde um: Formeln haben, was in {1} angegeben ist, schon in Radiant je Sekunde, so dass sein Name genügt",
    ),
    (
        "{} converts to {}, and so does the output in {}, once more: formulas compute shares as plain numbers; leave the factor out, or give the output without a unit",
        "{0} rechnet in {1} um, und die Ausgangsgröße in {2} noch einmal: Formeln rechnen mit Anteilen als Zahlen; der Faktor entfällt, oder die Ausgangsgröße hat keine Einheit",
    ),
    (
        "{} converts to {}, and so does the output in {}, once more: formulas compute ratios as plain numbers; leave the factor out, or give the output without a unit",
        "{0} rechnet in {1} um, und die Ausgangsgröße in {2} noch einmal: Formeln rechnen mit Verhältnissen als Zahlen; der Faktor entfällt, oder die Ausgangsgröße hat keine Einheit",
    ),
    (
        "{} takes {} in radians, as it has no unit of angle, and {} rad are more than a turn; one in degrees says {}",
        "{0} nimmt {1} in Radiant, da es keine Winkeleinheit hat, und {2} rad sind mehr als eine Umdrehung; ein Winkel in Grad hat {3}",
    ),
    (
        "{} converts to {}, and so does the output in {}, once more: formulas compute angles in radians; leave the factor out, or give the output without a unit",
        "{0} rechnet in {1} um, und die Ausgangsgröße in {2} noch einmal: Formeln rechnen mit Winkeln in Radiant; der Faktor entfällt, oder die Ausgangsgröße hat keine Einheit",
    ),
    (
        "{} in {} adds levels above a reference, or multiplies one, so that it is above no reference itself; the level of a sum of powers is {}, and gains are in dB",
        "{0} in {1} addiert Pegel über einem Bezugswert oder vervielfacht einen und hat so selbst keinen Bezugswert; der Pegel einer Summe von Leistungen ist {2}, und Verstärkungen sind in dB",
    ),
    (
        "{} is taken for an angular frequency, of which 2*pi radians are a revolution, as nothing says that it counts revolutions; if it does, write {}, or give it in {}",
        "{0} gilt als Kreisfrequenz, von der 2*pi Radiant eine Umdrehung sind, denn nichts sagt, dass es Umdrehungen zählt; wenn es das tut, ist {1} zu schreiben oder die Einheit {2} anzugeben",
    ),
    (
        "{} counts angle and is reported in {} in radians, 2*pi for a revolution; if revolutions are meant, write {}, or report it in rpm or rev",
        "{0} zählt Winkel und wird in {1} in Radiant angegeben, 2*pi je Umdrehung; sind Umdrehungen gemeint, ist {2} zu schreiben oder rpm oder rev als Einheit anzugeben",
    ),
    (
        "{}: without trials it is decided about its tolerance by the law of propagation, as of a normal or t distribution (JCGM 106, 7.2); trials show whether that holds",
        "{0}: Ohne Versuche wird über die Toleranz nach dem Fortpflanzungsgesetz entschieden, wie bei einer Normal- oder t-Verteilung (JCGM 106, 7.2); Versuche zeigen, ob das gilt",
    ),
    (
        "the `about` of {} still says {}, as a new file does, and certificates print it: write from where it is known, or take the key out",
        "`about` von {0} hat noch den Text einer neuen Datei, {1}, und Kalibrierscheine drucken ihn: Angeben, woher die Größe bekannt ist, oder den Schlüssel weglassen",
    ),
    (
        "{} has the name and the figures of an input that the result {} was evaluated from, and counts as independent of it; if they are one quantity, evaluate both in one model, or state their correlation",
        "{0} hat den Namen und die Werte einer Eingangsgröße, aus der das Ergebnis {1} ermittelt wurde, und gilt als unabhängig davon; sind sie eine Größe, sind beide in einem Modell auszuwerten, oder ihre Korrelation ist anzugeben",
    ),
    (
        "the unit {} of {} is the picohenry; a pH value is a number, with the unit {}",
        "die Einheit {0} von {1} ist das Pikohenry; ein pH-Wert ist eine Zahl mit der Einheit {2}",
    ),
    (
        "no equation uses the input {}: it contributes nothing to any uncertainty",
        "keine Gleichung verwendet die Eingangsgröße {0}: Sie trägt zu keiner Unsicherheit bei",
    ),
    (
        "the correlation of {} and {} has no effect, as {} has no uncertainty",
        "die Korrelation von {0} und {1} hat keine Wirkung, denn {2} hat keine Unsicherheit",
    ),
    (
        "{} takes radians, and {} rad are more than a turn; an angle in degrees is written {}",
        "{0} nimmt Radiant, und {1} rad sind mehr als eine Umdrehung; ein Winkel in Grad wird {2} geschrieben",
    ),
    (
        "units are not checked in the formula of {}: it computes with x in {} and y in {}, and its parameters are plain numbers; give those of {} with units",
        "in der Formel von {0} werden Einheiten nicht geprüft: Sie rechnet mit x in {1} und y in {2}, und ihre Parameter sind bloße Zahlen; die von {3} sind mit Einheiten anzugeben",
    ),
];
