//! Italian.

use super::Words;

pub(super) const WORDS: Words = Words {
    title: "Certificato di taratura",
    number: "Numero del certificato",
    device: "Oggetto",
    manufacturer: "Costruttore",
    model: "Modello",
    condition: "Stato al ricevimento",
    serial_number: "Matricola",
    customer_number: "Numero del cliente",
    customer: "Cliente",
    laboratory: "Laboratorio",
    accreditation: "Accreditamento",
    code: "Codice del laboratorio",
    responsible: "Responsabile",
    calibrated: "Data della taratura",
    period: "dal {first} al {last}",
    received: "Data di ricevimento",
    issued: "Data di emissione",
    place: "Luogo della taratura",
    places: [
        "laboratorio",
        "presso il cliente",
        "sede distaccata del laboratorio",
        "sede distaccata del cliente",
        "altrove",
    ],
    environment: "Condizioni ambientali",
    method: "Procedura",
    traceability: "Riferibilità metrologica",
    remarks: "Note",

    results: "Risultati",
    row: "riga",
    quantity: "grandezza",
    conditions: "condizioni",
    nominal: "nominale",
    value: "valore",
    expanded: "U",
    unit: "unità",
    in_unit: "in {unit}",
    limits_heading: "limiti",
    probability: "p in %",
    low: "da",
    high: "a",

    uncertainty: "Incertezza di misura",
    rows: ["Riga {rows}: ", "Righe {rows}: "],
    and: " e ",
    normal: "L'incertezza estesa U è l'incertezza tipo moltiplicata per il fattore di copertura k = {k}, \
        che per una distribuzione normale corrisponde a una probabilità di copertura di {p}.",
    student: "L'incertezza estesa U è l'incertezza tipo moltiplicata per il fattore di copertura \
        k dichiarato con essa, che per una distribuzione t con i gradi di libertà effettivi ν_eff \
        corrisponde a una probabilità di copertura di {p}.",
    fixed: "L'incertezza estesa U è l'incertezza tipo moltiplicata per il fattore di copertura concordato \
        k = {k}. Non si suppone alcuna distribuzione, perciò non si dichiara una probabilità di copertura.",
    agreed: "L'incertezza estesa U è l'incertezza tipo moltiplicata per il fattore di copertura \
        concordato k = {k}. La probabilità di copertura dichiarata con essa segue dalla \
        distribuzione t con i gradi di libertà effettivi ν_eff.",
    shortest: "L'intervallo di copertura dichiarato è il più corto con una probabilità di copertura di \
        {p}, trovato con il metodo Monte Carlo (JCGM 101:2008). U è la distanza maggiore del valore da un \
        estremo dell'intervallo; k = U/u.",
    without_trials: "L'intervallo di copertura dichiarato ha una probabilità di copertura di {p}. È stato \
        trovato con la propagazione delle distribuzioni (JCGM 101:2008, punto 5) senza prove casuali. È \
        l'intervallo più corto, oppure quello simmetrico se questo è più lungo di meno dell'1 %. U è la \
        distanza maggiore del valore da un estremo dell'intervallo; k = U/u.",
    propagation: "L'incertezza tipo è stata valutata con la legge di propagazione dell'incertezza (JCGM \
        100:2008), come richiesto da EA-4/02 M:2022.",
    time: "Le incertezze dichiarate non comprendono la stabilità a lungo termine dell'oggetto.",
    confirmed: "Il metodo Monte Carlo (JCGM 101:2008, punto 8) conferma questi intervalli.",
    rounding: "U è data con {digits} ({rule}); il valore è arrotondato alla stessa cifra.",
    rules: [
        "arrotondamento al più vicino",
        "arrotondamento al più vicino; per eccesso se altrimenti U si ridurrebbe di più del 5 %, EA-4/02 \
         M:2022",
        "arrotondamento per eccesso",
    ],
    kept: "U è arrotondata per eccesso, poiché altrimenti sarebbe minore della capacità di misura e \
        taratura (CMC) del laboratorio.",
    digits: ["una cifra significativa", "{digits} cifre significative"],
    raised: [
        "L'incertezza estesa valutata è minore della capacità di misura e taratura (CMC) del \
            laboratorio, che è dichiarata come U in sua vece (ILAC-P14:09/2020), {factor}; l'intervallo da valore - U a valore + U ha una \
            probabilità di copertura di almeno {p}.",
        "L'incertezza estesa valutata è minore della capacità di misura e taratura (CMC) del \
            laboratorio, che è dichiarata come U in sua vece (ILAC-P14:09/2020), {factor}.",
    ],
    of_capability: [
        "con il fattore di copertura k = {k} della capacità",
        "convertita dal suo fattore di copertura 2 a k = {k}",
    ],
    dof_list: "Gradi di libertà effettivi ν_eff: {list}.",
    approximately: "circa {p}",

    function: "Funzione di taratura {name}",
    in_range: "{equation} per {low} ≤ x ≤ {high}, dove x e {name} sono numeri nelle unità dichiarate.",
    band: "U è l'incertezza estesa della funzione in x, con il fattore di copertura k = {k}; non \
        comprende quella di una lettura ulteriore. Fra i valori di x dichiarati segue da u(x)² = g(x)' V \
        g(x). g sono le derivate rispetto ai parametri; V è la loro matrice di covarianza, formata dalle \
        loro incertezze tipo e dai loro coefficienti di correlazione r.",
    parameter: "parametro",
    standard: "u",
    region: "Regione di copertura",
    ellipsoid: "ellissoide (y - x)' U⁻¹ (y - x) ≤ k²",
    cuboid: "parallelepipedo di semilati k u",
    smallest: "regione minima delle prove: volume {volume}",
    measurement: "Modello di misura",
    equation: "equazione",
    symbol: "simbolo",
    meaning: "significato",
    correlation: "Correlazione fra le righe",
    correlated: "Le righe che hanno grandezze d'ingresso in comune sono correlate. L'incertezza tipo \
        della differenza fra le righe i e j segue da u² = u_i² + u_j² - 2 r u_i u_j, con le incertezze \
        tipo u_i e u_j e il coefficiente r dichiarati qui. Provengono dalla legge di propagazione; U_i / \
        k_i può differirne.",
    correlated_raised: "Se U è la capacità del laboratorio, u_i la contiene; ciò che essa aggiunge \
        all'incertezza valutata si suppone non correlato con le altre righe.",
    shared: "Le righe hanno in comune: {inputs}.",
    many: "Alcune delle {rows} righe hanno grandezze d'ingresso in comune; i coefficienti di correlazione \
        e le incertezze tipo corrispondenti sono nella risposta JSON e nella cartella di lavoro.",
    conformity: "Conformità",
    decided: ["conforme", "non conforme", "non dimostrato"],
    decisions: [
        "Il risultato è conforme alla tolleranza {limits}.",
        "Il risultato non è conforme alla tolleranza {limits}.",
    ],
    not_shown: [
        "La conformità del risultato alla tolleranza {limits} non è dimostrata: esso è entro la \
            tolleranza, ma fuori dai limiti di accettazione. La regola decisionale lo respinge.",
        "La conformità del risultato alla tolleranza {limits} non è dimostrata: esso è entro la \
            tolleranza, ma la regola decisionale non accetta alcun valore. Il risultato è respinto.",
    ],
    levels: ["conforme", "conforme con riserva", "non conforme con riserva", "non conforme"],
    level_decisions: [
        "Conforme: il risultato è entro la tolleranza {limits} ed entro i limiti di accettazione.",
        "Conforme con riserva: il risultato è entro la tolleranza {limits}, ma nella banda di guardia.",
        "Non conforme con riserva: il risultato è fuori dalla tolleranza {limits}, al massimo della banda di guardia.",
        "Non conforme: il risultato è fuori dalla tolleranza {limits} di più della banda di guardia.",
    ],
    limits: ["da {low} a {high}{unit}", "da {low}{unit} in su", "fino a {high}{unit}"],
    conforming: "Il valore è conforme con una probabilità di {p}.",
    all_the_same: "Rischio specifico che il valore respinto sia conforme: {p}.",
    unrounded: "La decisione è stata presa con il valore prima dell'arrotondamento, {value}.",
    with_prior: "Questa probabilità tiene conto della conoscenza a priori di tali oggetti (JCGM 106:2012, \
        6.3 e 7.1): {prior}. Dal valore misurato e dalla sua incertezza soltanto è {p}.",
    prior: "distribuzione `{shape}` con media {mean} e scarto tipo {std}",
    global_risks: "Rischi globali con questa conoscenza a priori e questi limiti di \
        accettazione: falsa accettazione {a} %, falso rifiuto {b} %.",
    percent: ["{p} %", "oltre {p} %", "meno di {p} %"],
    simple: "Regola decisionale: accettazione semplice (JCGM 106:2012, 8.2).",
    multiple: "Regola decisionale: accettazione con una banda di guardia di {band} \
        ({clause}), con U prima dell'arrotondamento; banda di guardia {guard}, accettato {limits}.",
    too_wide: "Regola decisionale: accettazione con una banda di guardia di {band} \
        ({clause}), con U prima dell'arrotondamento; banda di guardia {guard}, più della metà della tolleranza: nessun \
        valore è accettato.",
    no_band: "Regola decisionale: accettazione con una banda di guardia di {band} ({clause}), con U prima \
        dell'arrotondamento; U è più della metà della tolleranza: nessun valore è accettato.",
    of_rule: [
        "{rule}; T: metà della tolleranza",
        "{rule}; T: metà della tolleranza; U con k = {k}, la regola è definita per U al 95 % circa",
    ],
    of_ilac_g8: [
        "ILAC-G8:09/2019, 4.2.2",
        "U con k = {k}; ILAC-G8:09/2019, 4.2.2, definisce la banda di guardia per U al 95 % circa",
    ],
    rule_agreed: "La regola decisionale è stata concordata con il cliente.",
    specification: "Specifica: {name}.",
    guarded: "Regola decisionale: accettazione con banda di guardia (JCGM 106:2012, 8.3) per {kind} non \
        superiore a {risk} %; banda di guardia {guard}, accettato {limits}.",
    never: "Regola decisionale: accettazione con banda di guardia (JCGM 106:2012, 8.3) per {kind} non \
        superiore a {risk} %; nessun valore ha un rischio così piccolo.",
    kinds: [
        "un rischio specifico di falsa accettazione",
        "un rischio globale di falsa accettazione",
    ],

    page: "Pagina {page} di {pages}",
    end: "Fine del certificato di taratura",
    signed: ["Luogo, data", "Firma"],
    relates: "I risultati si riferiscono soltanto all'oggetto tarato.",
    copies: "Questo certificato non può essere riprodotto in forma parziale senza l'approvazione del laboratorio.",
    provenance: "Provenienza",
    program: "programma",
    certificate_file: "file del certificato, SHA-256",
    certificate_name: "file del certificato",
    model_file: "file del modello",
    table: "tabella",
    seed: "seme",
    trials: "prove Monte Carlo",
    adaptive: "adattivo",

    nominal_value: "Valore nominale",
    measured_value: "Valore misurato",
    coverage_interval: "Intervallo di copertura",
    files: "File della valutazione",
    answer: "Risultato",
};
