//! Sentences of the reports: English as the reports print them, with `{}` for what varies, and German
//! with its places: `{0}` as it stands, `{0:}` said in German itself, `{0;}` with the names of shapes
//! in German. A full stop at the end belongs to neither.

/// Sentences, captions and cells that are more than a word. The first one that fits is taken.
pub(super) const SENTENCES: &[(&str, &str)] = &[
    // the result
    (
        "{} = {}; k = {}, coverage probability {}",
        "{0} = {1}; k = {2}, Überdeckungswahrscheinlichkeit {3:}",
    ),
    (
        "{} = {}; k = {}, raised to the laboratory's capability (CMC)",
        "{0} = {1}; k = {2}, auf die Messmöglichkeit (CMC) des Laboratoriums angehoben",
    ),
    ("{} = {}; k = {}, an agreed factor", "{0} = {1}; k = {2}, ein vereinbarter Faktor"),
    (
        "{} = {}; coverage interval from {} to {} (Monte Carlo, shortest), coverage probability {}",
        "{0} = {1}; Überdeckungsintervall von {2} bis {3} (Monte Carlo, kürzestes), Überdeckungswahrscheinlichkeit {4:}",
    ),
    (
        "{} = {}; coverage interval from {} to {} (Monte Carlo, probabilistically symmetric), coverage probability {}",
        "{0} = {1}; Überdeckungsintervall von {2} bis {3} (Monte Carlo, probabilistisch symmetrisch), Überdeckungswahrscheinlichkeit {4:}",
    ),
    ("{} = {} with standard uncertainty {}", "{0} = {1} mit der Standardunsicherheit {2}"),
    ("{} is not defined at these estimates", "{0} ist bei diesen Schätzwerten nicht definiert"),
    ("approximately {} %", "etwa {0} %"),
    ("for approximately {} %", "für etwa {0} %"),
    ("for {} %", "für {0} %"),
    ("for {}, fixed", "für {0:}, fest"),
    ("whatever the degrees of freedom, fixed", "bei beliebigen Freiheitsgraden, fest"),
    (
        "Coverage interval from {} to {}, by GUM alone",
        "Überdeckungsintervall von {0} bis {1}, nach dem GUM allein",
    ),
    // clause 8
    (
        "JCGM 101, clause 8: there is no GUM interval to compare; take the Monte Carlo one",
        "JCGM 101, Abschnitt 8: Es gibt kein GUM-Intervall zum Vergleich; das Monte-Carlo-Intervall ist zu nehmen",
    ),
    (
        "JCGM 101, clause 8: undecided whether the GUM interval is valid here: {} trials are so few that the ends of the Monte Carlo interval are the extreme ones",
        "JCGM 101, Abschnitt 8: Nicht entschieden, ob das GUM-Intervall hier gilt: {0} Versuche sind so wenige, dass die Enden des Monte-Carlo-Intervalls die äußersten sind",
    ),
    (
        "JCGM 101, clause 8: the GUM interval is valid here: its ends lie d_low = {} and d_high = {} from the Monte Carlo ones, within the numerical tolerance {} ({} digit{})",
        "JCGM 101, Abschnitt 8: Das GUM-Intervall gilt hier: Seine Enden liegen d_low = {0} und d_high = {1} von denen der Monte-Carlo-Methode, innerhalb der numerischen Toleranz {2} (Stellen: {3})",
    ),
    (
        "JCGM 101, clause 8: the GUM interval is not valid here: its ends lie d_low = {} and d_high = {} from the Monte Carlo ones, beyond the numerical tolerance {} ({} digit{}). Take the symmetric Monte Carlo interval",
        "JCGM 101, Abschnitt 8: Das GUM-Intervall gilt hier nicht: Seine Enden liegen d_low = {0} und d_high = {1} von denen der Monte-Carlo-Methode, jenseits der numerischen Toleranz {2} (Stellen: {3}). Das symmetrische Monte-Carlo-Intervall ist zu nehmen",
    ),
    (
        "JCGM 101, clause 8: the GUM interval is not valid here: its ends lie d_low = {} and d_high = {} from the Monte Carlo ones, beyond the numerical tolerance {} ({} digit{}). Take the shortest Monte Carlo interval",
        "JCGM 101, Abschnitt 8: Das GUM-Intervall gilt hier nicht: Seine Enden liegen d_low = {0} und d_high = {1} von denen der Monte-Carlo-Methode, jenseits der numerischen Toleranz {2} (Stellen: {3}). Das kürzeste Monte-Carlo-Intervall ist zu nehmen",
    ),
    (
        "JCGM 101, clause 8: undecided whether the GUM interval is valid here: its ends lie d_low = {} and d_high = {} from the Monte Carlo ones, too near to the numerical tolerance {} ({} digit{}) for {} trials to tell",
        "JCGM 101, Abschnitt 8: Nicht entschieden, ob das GUM-Intervall hier gilt: Seine Enden liegen d_low = {0} und d_high = {1} von denen der Monte-Carlo-Methode, zu nahe an der numerischen Toleranz {2} (Stellen: {3}), als dass {5} Versuche es zeigen könnten",
    ),
    // conformity
    (
        "Tolerance {}: the estimate lies {}, and the value conforms with a probability of {} % (numerical standard error {} %; with the prior, by JCGM 106, 6.3 and 7.1; without it {} %)",
        "Toleranz {0:}: Der Schätzwert liegt {1:}, und der Wert ist mit einer Wahrscheinlichkeit von {2:} % konform (numerischer Standardfehler {3} %; mit dem Vorwissen, nach JCGM 106, 6.3 und 7.1; ohne es {4:} %)",
    ),
    (
        "Tolerance {}: the estimate lies {}, and the value conforms with a probability of {} % (numerical standard error {} %)",
        "Toleranz {0:}: Der Schätzwert liegt {1:}, und der Wert ist mit einer Wahrscheinlichkeit von {2:} % konform (numerischer Standardfehler {3} %)",
    ),
    (
        "Tolerance {}: the estimate lies {}, and the value conforms with a probability of {} % (with the prior, by JCGM 106, 6.3 and 7.1; without it {} %)",
        "Toleranz {0:}: Der Schätzwert liegt {1:}, und der Wert ist mit einer Wahrscheinlichkeit von {2:} % konform (mit dem Vorwissen, nach JCGM 106, 6.3 und 7.1; ohne es {3:} %)",
    ),
    (
        "Tolerance {}: the estimate lies {}, and the value conforms with a probability of {} % (with the laboratory's capability, u = {}; with the prior, by JCGM 106, 6.3 and 7.1; without it {} %)",
        "Toleranz {0:}: Der Schätzwert liegt {1:}, und der Wert ist mit einer Wahrscheinlichkeit von {2:} % konform (mit der Messmöglichkeit des Laboratoriums, u = {3}; mit dem Vorwissen, nach JCGM 106, 6.3 und 7.1; ohne es {4:} %)",
    ),
    (
        "Tolerance {}: the estimate lies {}, and the value conforms with a probability of {} % (with the laboratory's capability, u = {})",
        "Toleranz {0:}: Der Schätzwert liegt {1:}, und der Wert ist mit einer Wahrscheinlichkeit von {2:} % konform (mit der Messmöglichkeit des Laboratoriums, u = {3})",
    ),
    (
        "Tolerance {}: the estimate lies {}, and the value conforms with a probability of {} % (all {} trials conform)",
        "Toleranz {0:}: Der Schätzwert liegt {1:}, und der Wert ist mit einer Wahrscheinlichkeit von {2:} % konform (alle {3} Versuche sind konform)",
    ),
    (
        "Tolerance {}: the estimate lies {}, and the value conforms with a probability of {} % (none of the {} trials conforms)",
        "Toleranz {0:}: Der Schätzwert liegt {1:}, und der Wert ist mit einer Wahrscheinlichkeit von {2:} % konform (keiner der {3} Versuche ist konform)",
    ),
    (
        "Tolerance {}, simple acceptance (JCGM 106, 8.2): {} of {} rows accepted",
        "Toleranz {0:}, einfache Annahme (JCGM 106, 8.2): {1} von {2} Zeilen angenommen",
    ),
    (
        "Tolerance {}, simple acceptance (JCGM 106, 8.2): {} of {} rows accepted, rejected: row {}",
        "Toleranz {0:}, einfache Annahme (JCGM 106, 8.2): {1} von {2} Zeilen angenommen, zurückgewiesen: Zeile {3}",
    ),
    (
        "Tolerance {}, simple acceptance (JCGM 106, 8.2): {} of {} rows accepted, rejected: rows {}",
        "Toleranz {0:}, einfache Annahme (JCGM 106, 8.2): {1} von {2} Zeilen angenommen, zurückgewiesen: Zeilen {3}",
    ),
    (
        "Tolerance {}, guarded acceptance (JCGM 106, 8.3) for a {} risk of false acceptance of at most {} %: {} of {} rows accepted",
        "Toleranz {0:}, Annahme mit Schutzabstand (JCGM 106, 8.3) für ein {1:} Risiko fälschlicher Annahme von höchstens {2} %: {3} von {4} Zeilen angenommen",
    ),
    (
        "Tolerance {}, guarded acceptance (JCGM 106, 8.3) for a {} risk of false acceptance of at most {} %: {} of {} rows accepted, rejected: row {}",
        "Toleranz {0:}, Annahme mit Schutzabstand (JCGM 106, 8.3) für ein {1:} Risiko fälschlicher Annahme von höchstens {2} %: {3} von {4} Zeilen angenommen, zurückgewiesen: Zeile {5}",
    ),
    (
        "Tolerance {}, guarded acceptance (JCGM 106, 8.3) for a {} risk of false acceptance of at most {} %: {} of {} rows accepted, rejected: rows {}",
        "Toleranz {0:}, Annahme mit Schutzabstand (JCGM 106, 8.3) für ein {1:} Risiko fälschlicher Annahme von höchstens {2} %: {3} von {4} Zeilen angenommen, zurückgewiesen: Zeilen {5}",
    ),
    (
        "Probabilities, guard bands and risks of every row: --format json",
        "Wahrscheinlichkeiten, Schutzabstände und Risiken jeder Zeile: --format json",
    ),
    (
        "Decision rule: simple acceptance (JCGM 106, 8.2), accepted where the estimate lies within the tolerance. Decision: {}",
        "Entscheidungsregel: einfache Annahme (JCGM 106, 8.2), angenommen wird, wenn der Schätzwert innerhalb der Toleranz liegt. Entscheidung: {0:}",
    ),
    (
        "Tolerance {}, guarded acceptance (ILAC-G8, guard band of {} U): {} of {} rows accepted",
        "Toleranz {0:}, Annahme mit Schutzabstand (ILAC-G8, Schutzabstand von {1} U): {2} von {3} Zeilen angenommen",
    ),
    (
        "Tolerance {}, guarded acceptance (ILAC-G8, guard band of {} U): {} of {} rows accepted, rejected: row {}",
        "Toleranz {0:}, Annahme mit Schutzabstand (ILAC-G8, Schutzabstand von {1} U): {2} von {3} Zeilen angenommen, zurückgewiesen: Zeile {4}",
    ),
    (
        "Tolerance {}, guarded acceptance (ILAC-G8, guard band of {} U): {} of {} rows accepted, rejected: rows {}",
        "Toleranz {0:}, Annahme mit Schutzabstand (ILAC-G8, Schutzabstand von {1} U): {2} von {3} Zeilen angenommen, zurückgewiesen: Zeilen {4}",
    ),
    (
        "Decision rule: guarded acceptance (ILAC-G8, guard band of {} U): {}, accepted {}. Decision: {}",
        "Entscheidungsregel: Annahme mit Schutzabstand (ILAC-G8, Schutzabstand von {0} U): {1}, angenommen {2:}. Entscheidung: {3:}",
    ),
    (
        "Decision rule: guarded acceptance (ILAC-G8, guard band of {} U): {}, more than half of the tolerance, so that no value is accepted. Decision: {}",
        "Entscheidungsregel: Annahme mit Schutzabstand (ILAC-G8, Schutzabstand von {0} U): {1}, mehr als die halbe Toleranz, so dass kein Wert angenommen wird. Entscheidung: {2:}",
    ),
    (
        "Decision rule: guarded acceptance (JCGM 106, 8.3) for a {} risk of false acceptance of at most {} %; no value has so small a one. Decision: {}",
        "Entscheidungsregel: Annahme mit Schutzabstand (JCGM 106, 8.3) für ein {0:} Risiko fälschlicher Annahme von höchstens {1} %; kein Wert hat ein so kleines. Entscheidung: {2:}",
    ),
    (
        "Decision rule: guarded acceptance (JCGM 106, 8.3) for a {} risk of false acceptance of at most {} %: guard band {}, accepted {}. Decision: {}",
        "Entscheidungsregel: Annahme mit Schutzabstand (JCGM 106, 8.3) für ein {0:} Risiko fälschlicher Annahme von höchstens {1} %: Schutzabstand {2}, angenommen {3:}. Entscheidung: {4:}",
    ),
    (
        "Specific risk that the value does not conform: {} %",
        "Spezifisches Risiko, dass der Wert nicht konform ist: {0:} %",
    ),
    (
        "Specific risk that the value conforms all the same: {} %",
        "Spezifisches Risiko, dass der Wert dennoch konform ist: {0:} %",
    ),
    (
        "Global risks with the prior, for normally distributed errors: false acceptance {} %, false rejection {} %",
        "Globale Risiken mit dem Vorwissen, für normalverteilte Abweichungen: fälschliche Annahme {0} %, fälschliche Zurückweisung {1} %",
    ),
    (
        "The laboratory's capability (CMC) is {}; U is raised to it: {} is to be stated",
        "Die Messmöglichkeit (CMC) des Laboratoriums ist {0}; U wird auf sie angehoben: Anzugeben ist {1}",
    ),
    (
        "U = {} is below the laboratory's capability (CMC) of {}",
        "U = {0} liegt unter der Messmöglichkeit (CMC) des Laboratoriums von {1}",
    ),
    (
        "The laboratory's capability (CMC) is {}; U = {} can be stated",
        "Die Messmöglichkeit (CMC) des Laboratoriums ist {0}; U = {1} kann angegeben werden",
    ),
    (
        "The coverage factor {} is fixed whatever the degrees of freedom; the Monte Carlo intervals have the coverage probability {}",
        "Der Erweiterungsfaktor {0} ist fest, wie viele Freiheitsgrade es auch sind; die Monte-Carlo-Intervalle haben die Überdeckungswahrscheinlichkeit {1:}",
    ),
    // budget
    (
        "There is no budget: the estimate or a sensitivity coefficient is not finite here",
        "Es gibt kein Budget: Der Schätzwert oder ein Empfindlichkeitskoeffizient ist hier nicht endlich",
    ),
    (
        "Sensitivity coefficients in {} per unit of the quantity, contributions in {}",
        "Empfindlichkeitskoeffizienten in {0} je Einheit der Größe, Beiträge in {1}",
    ),
    (
        "Sensitivity coefficients per unit of the quantity",
        "Empfindlichkeitskoeffizienten je Einheit der Größe",
    ),
    ("Subtotals: {}", "Zwischensummen: {0+}"),
    (
        "Shares of the combined variance, largest first",
        "Anteile an der kombinierten Varianz, die größten zuerst",
    ),
    (
        "Shares of the combined variance, largest first; paler bars: correlation coefficients; {} smaller ones are left out",
        "Anteile an der kombinierten Varianz, die größten zuerst; hellere Balken: Korrelationskoeffizienten; {0} kleinere sind weggelassen",
    ),
    (
        "Shares of the combined variance, largest first; paler bars: correlation coefficients",
        "Anteile an der kombinierten Varianz, die größten zuerst; hellere Balken: Korrelationskoeffizienten",
    ),
    (
        "Shares of the combined variance, largest first; {} smaller ones are left out",
        "Anteile an der kombinierten Varianz, die größten zuerst; {0} kleinere sind weggelassen",
    ),
    ("{} coefficients", "{0} Koeffizienten"),
    ("{} (drawn as {})", "{0:} (gezogen als {1:})"),
    ("not defined for these degrees of freedom", "für diese Freiheitsgrade nicht definiert"),
    ("more than {}", "mehr als {0}"),
    // both methods
    (
        "The shortest interval is that of the trials within 1e-5 u",
        "Das kürzeste Intervall ist das der Versuche, auf 1e-5 u genau",
    ),
    (
        "The shortest interval is not unique: others are as short within their numerical error, and the trials chose among them",
        "Das kürzeste Intervall ist nicht eindeutig: Andere sind innerhalb ihres numerischen Fehlers ebenso kurz, und die Versuche haben unter ihnen gewählt",
    ),
    (
        "Exact: from the distributions of independent contributions, without trials; no figure is off by more than {}",
        "Exakt: aus den Verteilungen unabhängiger Beiträge, ohne Versuche; keine Angabe ist um mehr als {0} falsch",
    ),
    (
        "Quasi-random: {} integrated exactly, the other inputs over {} scrambled nets of {} points; numerical standard errors of the ends of the symmetric interval {} and {}",
        "Quasizufällig: {0} exakt integriert, die anderen Eingangsgrößen über {1} verwürfelte Netze von {2} Punkten; numerische Standardfehler der Enden des symmetrischen Intervalls {3} und {4}",
    ),
    (
        "No figures without the noise of trials: {}",
        "Keine Angaben ohne das Rauschen der Versuche: {0:}",
    ),
    ("a phase comes round, and is no sum", "eine Phase läuft um und ist keine Summe"),
    ("the output does not vary", "die Ergebnisgröße ändert sich nicht"),
    ("no quantiles are known", "es sind keine Quantile bekannt"),
    ("the quantity has no width", "die Größe hat keine Breite"),
    (
        "{} inputs come together in one function that is no sum and no product of their own ones",
        "{0} Eingangsgrößen stehen in einer Funktion zusammen, die keine Summe und kein Produkt von Funktionen je einer ist",
    ),
    (
        "{} inputs come together in one function that is no sum of their own ones",
        "{0} Eingangsgrößen stehen in einer Funktion zusammen, die keine Summe von Funktionen je einer ist",
    ),
    (
        "the output is not a monotone function of its only input",
        "die Ergebnisgröße ist keine monotone Funktion ihrer einzigen Eingangsgröße",
    ),
    (
        "the density is nearly zero at an end of the interval or at the median",
        "die Dichte ist an einem Ende des Intervalls oder am Median fast null",
    ),
    (
        "the ends of the interval would be known to {} of the standard uncertainty only",
        "die Enden des Intervalls wären nur auf {0} der Standardunsicherheit bekannt",
    ),
    (
        "outputs of one saved result, or parameters of a fit, are known together by draws alone",
        "Ergebnisgrößen eines gespeicherten Ergebnisses oder Parameter einer Anpassung sind gemeinsam nur durch Ziehungen bekannt",
    ),
    (
        "samples go through a function that is not linear",
        "Stichproben gehen durch eine Funktion, die nicht linear ist",
    ),
    (
        "no quantiles are known of the distribution {}",
        "von der Verteilung {0} sind keine Quantile bekannt",
    ),
    (
        "a quantity under a logarithm, a quotient or a root changes its sign or has no finite value",
        "eine Größe unter einem Logarithmus, einem Bruch oder einer Wurzel wechselt das Vorzeichen oder hat keinen endlichen Wert",
    ),
    (
        "paired readings go through a function that is not linear",
        "gepaarte Messreihen gehen durch eine Funktion, die nicht linear ist",
    ),
    (
        "the distribution of a function of several inputs is not found to enough digits",
        "die Verteilung einer Funktion mehrerer Eingangsgrößen wird nicht auf genügend Stellen gefunden",
    ),
    (
        "the characteristic function decays too slowly: narrow contributions beside wide ones without a smooth one",
        "die charakteristische Funktion fällt zu langsam ab: schmale Beiträge neben breiten ohne einen glatten",
    ),
    (
        "{}: {} trials are the most that may be made, and two blocks of {} would be needed to say how far the figures scatter",
        "{0:}: Mehr als {1} Versuche dürfen nicht gemacht werden, und zwei Blöcke von {2} wären nötig, um zu sagen, wie weit die Angaben streuen",
    ),
    (
        "{}: all figures of all outputs are stable after {} trials, {} blocks of {}, here to {}",
        "{0:}: Alle Angaben aller Ergebnisgrößen sind nach {1} Versuchen, {2} Blöcken von {3}, stabil, hier auf {4}",
    ),
    (
        "{}: not yet stable to {} after {} trials, {} blocks of {}",
        "{0:}: nach {2} Versuchen, {3} Blöcken von {4}, noch nicht auf {1} stabil",
    ),
    (
        "{}: by the scatter of the first {} blocks {} trials, {} blocks of {}, are enough for all figures of all outputs, here to {}, each with a probability of 95 %",
        "{0:}: nach der Streuung der ersten {1} Blöcke genügen {2} Versuche, {3} Blöcke von {4}, für alle Angaben aller Ergebnisgrößen, hier auf {5}, jede mit einer Wahrscheinlichkeit von 95 %",
    ),
    (
        "{}: by the scatter of the first blocks more than {} trials, {} blocks of {}, would be needed, here for {}",
        "{0:}: nach der Streuung der ersten Blöcke wären mehr als {1} Versuche, {2} Blöcke von {3}, nötig, hier für {4}",
    ),
    ("Stein's two-stage rule", "Steins zweistufige Regel"),
    // distribution
    (
        "The first {} Monte Carlo trials (bars), the density that the GUM gives (line) and the coverage intervals for {} % with the estimates (dots){}",
        "Die ersten {0} Monte-Carlo-Versuche (Balken), die Dichte nach dem GUM (Linie) und die Überdeckungsintervalle für {1} % mit den Schätzwerten (Punkte){2:}",
    ),
    (
        "The {} Monte Carlo trials (bars), the density that the GUM gives (line) and the coverage intervals for {} % with the estimates (dots){}",
        "Die {0} Monte-Carlo-Versuche (Balken), die Dichte nach dem GUM (Linie) und die Überdeckungsintervalle für {1} % mit den Schätzwerten (Punkte){2:}",
    ),
    (
        "The first {} Monte Carlo trials (bars) and the coverage intervals for {} % with the estimates (dots){}",
        "Die ersten {0} Monte-Carlo-Versuche (Balken) und die Überdeckungsintervalle für {1} % mit den Schätzwerten (Punkte){2:}",
    ),
    (
        "The {} Monte Carlo trials (bars) and the coverage intervals for {} % with the estimates (dots){}",
        "Die {0} Monte-Carlo-Versuche (Balken) und die Überdeckungsintervalle für {1} % mit den Schätzwerten (Punkte){2:}",
    ),
    (
        "; below them the tolerance and the limits of acceptance",
        "; darunter die Toleranz und die Annahmegrenzen",
    ),
    ("; below them the tolerance", "; darunter die Toleranz"),
    ("Monte Carlo, symmetric: {}", "Monte Carlo, symmetrisch: {0:}"),
    ("Monte Carlo, shortest: {}", "Monte Carlo, kürzestes: {0:}"),
    ("tolerance: {}", "Toleranz: {0:}"),
    ("acceptance: {}", "Annahme: {0:}"),
    ("{}: {} % of the trials", "{0:}: {1} % der Versuche"),
    // how the trials settle
    (
        "How the Monte Carlo figures settle: those of the first {} to {} trials (dots), each less that of all {} trials (line), with one numerical standard error either way (band)",
        "Wie sich die Monte-Carlo-Werte einstellen: die der ersten {0} bis {1} Versuche (Punkte), jeweils ohne den aller {2} Versuche (Linie), mit einem numerischen Standardfehler nach beiden Seiten (Band)",
    ),
    (
        "The ends are those of the symmetric coverage interval",
        "Die Enden sind die des symmetrischen Überdeckungsintervalls",
    ),
    (
        "The ends are those of the shortest coverage interval",
        "Die Enden sind die des kürzesten Überdeckungsintervalls",
    ),
    ("difference in % of u", "Unterschied in % von u"),
    ("difference in % of half the interval", "Unterschied in % des halben Intervalls"),
    ("{} trials: {} of {}", "{0} Versuche: {1:} von {2}"),
    // all outputs together
    ("Correlation of the outputs", "Korrelation der Ergebnisgrößen"),
    (
        "{} correlation coefficients of the outputs: --format json",
        "{0} Korrelationskoeffizienten der Ergebnisgrößen: --format json",
    ),
    (
        "{} of {} trials have no finite result and are left out",
        "{0} von {1} Versuchen haben kein endliches Ergebnis und sind weggelassen",
    ),
    ("Coverage region of {}", "Überdeckungsbereich von {0}"),
    ("k of the ellipsoid", "k des Ellipsoids"),
    ("k of the box", "k des Quaders"),
    (
        "The factors of the law of propagation are those of a normal distribution, though an output has {} of freedom: with them the regions hold less than {} %",
        "Die Faktoren des Fortpflanzungsgesetzes sind die einer Normalverteilung, obwohl eine Ergebnisgröße nur wenige Freiheitsgrade hat ({0}): Mit ihnen liegt weniger als {1} % in den Bereichen",
    ),
    (
        "With a probability of {} % all outputs lie together in the ellipsoid {}, U being their covariance matrix, and in the box of half-lengths k u (JCGM 102, 6.5)",
        "Mit einer Wahrscheinlichkeit von {0} % liegen alle Ergebnisgrößen gemeinsam im Ellipsoid {1}, worin U ihre Kovarianzmatrix ist, und im Quader der halben Kantenlängen k u (JCGM 102, 6.5)",
    ),
    (
        "The smallest region that holds as many trials has the volume {}, with a numerical standard error of {}: {} cells of a mesh",
        "Der kleinste Bereich, der ebenso viele Versuche enthält, hat das Volumen {0} mit einem numerischen Standardfehler von {1}: {2} Zellen eines Gitters",
    ),
    (
        "Estimates, standard uncertainties, the largest eigenvalue of the correlation matrix and k of both methods agree within the numerical tolerance: the ellipsoid of the law of propagation is valid here (JCGM 102, clause 8)",
        "Schätzwerte, Standardunsicherheiten, der größte Eigenwert der Korrelationsmatrix und k beider Verfahren stimmen innerhalb der numerischen Toleranz überein: Das Ellipsoid des Fortpflanzungsgesetzes gilt hier (JCGM 102, Abschnitt 8)",
    ),
    (
        "Estimates, standard uncertainties, the largest eigenvalue of the correlation matrix or k of both methods differ by more than the numerical tolerance: the ellipsoid of the law of propagation is not confirmed; take that of the trials (JCGM 102, clause 8)",
        "Schätzwerte, Standardunsicherheiten, der größte Eigenwert der Korrelationsmatrix oder k beider Verfahren weichen um mehr als die numerische Toleranz voneinander ab: Das Ellipsoid des Fortpflanzungsgesetzes ist nicht bestätigt; das der Versuche ist zu nehmen (JCGM 102, Abschnitt 8)",
    ),
    (
        "Coverage ellipse and box by the law of propagation (vermilion) and from the trials (blue). Dots are some of the trials",
        "Überdeckungsellipse und -rechteck nach dem Fortpflanzungsgesetz (zinnoberrot) und aus den Versuchen (blau). Die Punkte sind einige der Versuche",
    ),
    (
        "Coverage ellipse and box by the law of propagation (vermilion) and from the trials (blue)",
        "Überdeckungsellipse und -rechteck nach dem Fortpflanzungsgesetz (zinnoberrot) und aus den Versuchen (blau)",
    ),
    // sweeps
    ("Shares of the variance in %:", "Anteile an der Varianz in %:"),
    ("All conditions of the rows", "Alle Bedingungen der Zeilen"),
    (
        "Budgets, shortest intervals, numerical standard errors and correlations of every row: --format json",
        "Budgets, kürzeste Intervalle, numerische Standardfehler und Korrelationen jeder Zeile: --format json",
    ),
    (
        "The first {} of {} rows; all of them: --format csv",
        "Die ersten {0} von {1} Zeilen; alle: --format csv",
    ),
    (
        "Above: estimates with their expanded uncertainties U by the law of propagation, the first rows; below: U alone.{}",
        "Oben: Schätzwerte mit ihren erweiterten Unsicherheiten U nach dem Fortpflanzungsgesetz, die ersten Zeilen; unten: U allein.{0:}",
    ),
    (
        "Above: estimates with their expanded uncertainties U by the law of propagation; below: U alone.{}",
        "Oben: Schätzwerte mit ihren erweiterten Unsicherheiten U nach dem Fortpflanzungsgesetz; unten: U allein.{0:}",
    ),
    (
        "Above: estimates with their expanded uncertainties U by the law of propagation, the first rows; below: U alone",
        "Oben: Schätzwerte mit ihren erweiterten Unsicherheiten U nach dem Fortpflanzungsgesetz, die ersten Zeilen; unten: U allein",
    ),
    (
        "Above: estimates with their expanded uncertainties U by the law of propagation; below: U alone",
        "Oben: Schätzwerte mit ihren erweiterten Unsicherheiten U nach dem Fortpflanzungsgesetz; unten: U allein",
    ),
    (" Marks over {}: {}", " Zeichen über {0}: {1}"),
    // calibration functions
    ("Calibration function {}", "Kalibrierfunktion {0}"),
    (
        "{}(x), a formula of the file, fitted to {} points from x = {} to {} by {}",
        "{0}(x), eine Formel der Datei, an {1} Punkte von x = {2} bis {3} angepasst durch {4:}",
    ),
    (
        "{}, fitted to {} points from x = {} to {} by {}",
        "{0}, an {1} Punkte von x = {2} bis {3} angepasst durch {4:}",
    ),
    (
        "ordinary least squares, as nothing is stated of the uncertainty of y",
        "gewöhnliche kleinste Quadrate, da über die Unsicherheit von y nichts angegeben ist",
    ),
    ("weighted least squares", "gewichtete kleinste Quadrate"),
    (
        "generalized least squares with the covariance matrix of y",
        "verallgemeinerte kleinste Quadrate mit der Kovarianzmatrix von y",
    ),
    (
        "generalized distance regression with the covariance matrices of x and y",
        "verallgemeinerte Abstandsregression mit den Kovarianzmatrizen von x und y",
    ),
    (
        "generalized distance regression, x and y of each point being correlated",
        "verallgemeinerte Abstandsregression, wobei x und y jedes Punktes korreliert sind",
    ),
    (
        "generalized distance regression, x and y being uncertain",
        "verallgemeinerte Abstandsregression, wobei x und y unsicher sind",
    ),
    (
        "Chi-squared is {} with {} degrees of freedom, not above its 95 % quantile {} (p = {}): the points, the form of the curve and the stated uncertainties agree",
        "Chi-Quadrat ist {0} mit {1} Freiheitsgraden, nicht über seinem 95-%-Quantil {2} (p = {3}): Die Punkte, die Form der Kurve und die angegebenen Unsicherheiten passen zusammen",
    ),
    (
        "Chi-squared is {} with {} degrees of freedom, above its 95 % quantile {} (p = {}): the points, the form of the curve and the stated uncertainties do not agree",
        "Chi-Quadrat ist {0} mit {1} Freiheitsgraden, über seinem 95-%-Quantil {2} (p = {3}): Die Punkte, die Form der Kurve und die angegebenen Unsicherheiten passen nicht zusammen",
    ),
    (
        "The standard deviation of the residuals is {} with {} degrees of freedom; it stands for the uncertainty of y, so that nothing is left to test the form of the curve by",
        "Die Standardabweichung der Residuen ist {0} mit {1} Freiheitsgraden; sie steht für die Unsicherheit von y, so dass nichts übrig ist, um die Form der Kurve zu prüfen",
    ),
    (
        "The residuals make the stated uncertainties {} times as large, with {} degrees of freedom; nothing is left to test the form of the curve by",
        "Die Residuen machen die angegebenen Unsicherheiten {0}-mal so groß, mit {1} Freiheitsgraden; nichts ist übrig, um die Form der Kurve zu prüfen",
    ),
    (
        "The curve goes through all points, so that nothing tests its form",
        "Die Kurve geht durch alle Punkte, so dass nichts ihre Form prüft",
    ),
    (
        "From x = {} to {} the calibration function has the expanded uncertainty U(x) = k u(x), with the coverage factor k = {}, where {} is the sum of all covariances of the coefficients times the derivatives by both:",
        "Von x = {0} bis {1} hat die Kalibrierfunktion die erweiterte Unsicherheit U(x) = k u(x) mit dem Erweiterungsfaktor k = {2}, worin {3} die Summe aller Kovarianzen der Koeffizienten mal den Ableitungen nach beiden ist:",
    ),
    (
        "Above: curve with the band of its expanded uncertainty (of the curve, not of single points); below: residuals of the points about it.{}",
        "Oben: Kurve mit dem Band ihrer erweiterten Unsicherheit (der Kurve, nicht einzelner Punkte); unten: Residuen der Punkte um sie.{0:}",
    ),
    (
        "Above: line with the band of its expanded uncertainty (of the curve, not of single points); below: residuals of the points about it.{}",
        "Oben: Gerade mit dem Band ihrer erweiterten Unsicherheit (der Kurve, nicht einzelner Punkte); unten: Residuen der Punkte um sie.{0:}",
    ),
    (
        "Above: curve with the band of its expanded uncertainty (of the curve, not of single points); below: residuals of the points about it",
        "Oben: Kurve mit dem Band ihrer erweiterten Unsicherheit (der Kurve, nicht einzelner Punkte); unten: Residuen der Punkte um sie",
    ),
    (
        "Above: line with the band of its expanded uncertainty (of the curve, not of single points); below: residuals of the points about it",
        "Oben: Gerade mit dem Band ihrer erweiterten Unsicherheit (der Kurve, nicht einzelner Punkte); unten: Residuen der Punkte um sie",
    ),
    (
        " Bars are the expanded uncertainties of y alone. Not all points are drawn",
        " Die Balken sind die erweiterten Unsicherheiten von y allein. Nicht alle Punkte sind gezeichnet",
    ),
    (
        " Bars are the expanded uncertainties of y alone",
        " Die Balken sind die erweiterten Unsicherheiten von y allein",
    ),
    (" Not all points are drawn", " Nicht alle Punkte sind gezeichnet"),
    ("residual in {}", "Residuum in {0}"),
    // audit of the Type B assumptions
    (
        "As stated: u = {}, {} % interval {} to {}",
        "Wie angegeben: u = {0}, {1}-%-Intervall {2} bis {3}",
    ),
    (
        "As stated: no standard uncertainty, {} % interval {} to {}",
        "Wie angegeben: keine Standardunsicherheit, {0}-%-Intervall {1} bis {2}",
    ),
    (
        "No input has a shape that was assumed",
        "Keine Eingangsgröße hat eine Form, die angenommen wurde",
    ),
    (
        "No assumed shape matters: none moves the interval by more than {} %",
        "Keine angenommene Form ist wesentlich: Keine bewegt das Intervall um mehr als {0} %",
    ),
    ("Shapes that matter, by more than {} %: {}", "Wesentliche Formen, um mehr als {0} %: {1;}"),
    ("The readings contradict: {}", "Die Messreihen widersprechen: {0+}"),
    (
        "The {} readings of {} lie together, off the stated centre: their mean is {}, their standard deviation {}",
        "Die {0} Messwerte von {1} liegen beisammen, neben der angegebenen Mitte: Ihr Mittelwert ist {2}, ihre Standardabweichung {3}",
    ),
    (
        "The mean is off by {}, more than their scatter makes (t test, {} %)",
        "Der Mittelwert liegt um {0} daneben, mehr als ihre Streuung macht (t-Test, {1} %)",
    ),
    (
        "That is an offset to be corrected (JCGM 100, 3.2.4), no width and no shape: correct it, and state what is left",
        "Das ist eine Abweichung, die zu berichtigen ist (JCGM 100, 3.2.4), keine Breite und keine Form: Berichtigen Sie sie, und geben Sie an, was bleibt",
    ),
    ("With another shape", "Mit einer anderen Form"),
    ("Do the readings agree?", "Passen die Messreihen dazu?"),
    (
        "Changes are those of half the length of the coverage interval, relative to the stated assumptions, from the same random numbers; a change below 0.05 % or within twice its numerical standard error is none seen. Allowed is how far the width may be wrong until that length moves by more than the limit",
        "Änderungen sind die der halben Länge des Überdeckungsintervalls gegenüber den angegebenen Annahmen, aus denselben Zufallszahlen; eine Änderung unter 0.05 % oder innerhalb des Zweifachen ihres numerischen Standardfehlers ist nicht zu sehen. Erlaubt ist, wie weit die Breite falsch sein darf, bis sich diese Länge um mehr als die Schranke bewegt",
    ),
    ("too few readings to tell", "zu wenige Messwerte, um es zu sagen"),
    ("standard deviation", "Standardabweichung"),
    ("{} % interval", "{0}-%-Intervall"),
];

/// Parts of sentences and cells, which might be found in many sentences: they are looked for last, and
/// in short texts alone.
pub(super) const BRIEF: &[(&str, &str)] = &[
    (
        "of each row ({} in the first one, {} in the last one)",
        "je Zeile ({0:} in der ersten, {1:} in der letzten)",
    ),
    ("from {} on {}", "ab {0} {1}"),
    ("from {} on", "ab {0}"),
    ("from {} to {}", "von {0} bis {1}"),
    ("up to {}", "bis {0}"),
    ("more than {}", "mehr als {0}"),
    ("less than {}", "weniger als {0}"),
    ("{} % to {}", "{0} % bis {1:}"),
    ("any to {}", "beliebig bis {0:}"),
    ("{} to {}", "{0} bis {1}"),
];

/// The longest of those texts, in bytes.
pub(super) const BRIEF_LENGTH: usize = 60;
