//! French.

use super::Words;

pub(super) const WORDS: Words = Words {
    title: "Certificat d'étalonnage",
    number: "Numéro du certificat",
    device: "Objet",
    manufacturer: "Constructeur",
    model: "Type",
    condition: "État à la réception",
    serial_number: "Numéro de série",
    customer_number: "Numéro du client",
    customer: "Client",
    laboratory: "Laboratoire",
    accreditation: "Accréditation",
    code: "Code du laboratoire",
    responsible: "Responsable",
    calibrated: "Date de l'étalonnage",
    period: "du {first} au {last}",
    received: "Date de réception",
    issued: "Date d'émission",
    place: "Lieu de l'étalonnage",
    places: [
        "laboratoire",
        "chez le client",
        "site annexe du laboratoire",
        "site annexe du client",
        "ailleurs",
    ],
    environment: "Conditions d'environnement",
    method: "Méthode",
    traceability: "Traçabilité métrologique",
    remarks: "Remarques",

    results: "Résultats",
    row: "ligne",
    quantity: "grandeur",
    conditions: "conditions",
    nominal: "valeur nominale",
    value: "valeur",
    expanded: "U",
    unit: "unité",
    in_unit: "en {unit}",
    limits_heading: "limites",
    probability: "p en %",
    low: "de",
    high: "à",

    uncertainty: "Incertitude de mesure",
    rows: ["Ligne {rows} : ", "Lignes {rows} : "],
    and: " et ",
    normal: "L'incertitude élargie U est l'incertitude-type multipliée par le facteur d'élargissement \
        k = {k} qui, pour une loi normale, correspond à une probabilité de couverture de {p}.",
    student: "L'incertitude élargie U est l'incertitude-type multipliée par le facteur \
        d'élargissement k déclaré avec elle qui, pour une loi de Student avec les degrés de liberté \
        effectifs ν_eff, correspond à une probabilité de couverture de {p}.",
    fixed: "L'incertitude élargie U est l'incertitude-type multipliée par le facteur d'élargissement convenu \
        k = {k}. Aucune loi n'est supposée, et aucune probabilité de couverture n'est donc déclarée.",
    agreed: "L'incertitude élargie U est l'incertitude-type multipliée par le facteur \
        d'élargissement convenu k = {k}. La probabilité de couverture déclarée avec elle découle \
        de la loi de Student avec les degrés de liberté effectifs ν_eff.",
    shortest: "L'intervalle élargi déclaré est le plus court ayant une probabilité de couverture de {p}, \
        trouvé par la méthode de Monte-Carlo (JCGM 101:2008). U est la plus grande distance de la valeur \
        à une extrémité de l'intervalle ; k = U/u.",
    without_trials: "L'intervalle élargi déclaré a une probabilité de couverture de {p}. Il a été trouvé \
        par la propagation de distributions (JCGM 101:2008, article 5) sans tirages aléatoires. C'est \
        l'intervalle le plus court, ou l'intervalle symétrique si celui-ci est plus long de moins de 1 %. \
        U est la plus grande distance de la valeur à une extrémité de l'intervalle ; k = U/u.",
    propagation: "L'incertitude-type a été évaluée par la loi de propagation des incertitudes (JCGM \
        100:2008), comme l'exige EA-4/02 M:2022.",
    time: "Les incertitudes déclarées ne comprennent pas la stabilité à long terme de l'objet.",
    confirmed: "La méthode de Monte-Carlo (JCGM 101:2008, article 8) confirme ces intervalles.",
    rounding: "U est donnée avec {digits} ({rule}) ; la valeur est arrondie au même rang.",
    rules: [
        "arrondi au plus proche",
        "arrondi au plus proche ; par excès si U était sinon réduite de plus de 5 %, EA-4/02 M:2022",
        "arrondi par excès",
    ],
    kept: "U est arrondie par excès, car elle serait sinon inférieure à l'aptitude en matière de mesures \
        et d'étalonnages (CMC) du laboratoire.",
    digits: ["un chiffre significatif", "{digits} chiffres significatifs"],
    raised: [
        "L'incertitude élargie évaluée est inférieure à l'aptitude en matière de mesures et \
            d'étalonnages (CMC) du laboratoire, qui est déclarée comme U à sa place \
            (ILAC-P14:09/2020), {factor} ; \
            l'intervalle de valeur - U à valeur + U a une probabilité de couverture d'au moins \
            {p}.",
        "L'incertitude élargie évaluée est inférieure à l'aptitude en matière de mesures et \
            d'étalonnages (CMC) du laboratoire, qui est déclarée comme U à sa place \
            (ILAC-P14:09/2020), {factor}.",
    ],
    of_capability: [
        "avec le facteur d'élargissement k = {k} de l'aptitude",
        "convertie de son facteur d'élargissement 2 à k = {k}",
    ],
    dof_list: "Degrés de liberté effectifs ν_eff : {list}.",
    approximately: "{p} environ",

    function: "Fonction d'étalonnage {name}",
    in_range: "{equation} pour {low} ≤ x ≤ {high}, x et {name} étant des nombres dans les unités déclarées.",
    band: "U est l'incertitude élargie de la fonction en x, avec le facteur d'élargissement k = {k} ; \
        elle ne contient pas celle d'une lecture supplémentaire. Entre les valeurs de x déclarées elle \
        découle de u(x)² = g(x)' V g(x). g sont les dérivées par rapport aux paramètres ; V est leur \
        matrice de covariance, formée de leurs incertitudes-types et de leurs coefficients de corrélation \
        r.",
    parameter: "paramètre",
    standard: "u",
    region: "Région élargie",
    ellipsoid: "ellipsoïde (y - x)' U⁻¹ (y - x) ≤ k²",
    cuboid: "pavé de demi-côtés k u",
    smallest: "plus petite région des tirages : volume {volume}",
    measurement: "Modèle de mesure",
    equation: "équation",
    symbol: "symbole",
    meaning: "signification",
    correlation: "Corrélation des lignes",
    correlated: "Les lignes qui ont des grandeurs d'entrée en commun sont corrélées. L'incertitude-type \
        de la différence des lignes i et j découle de u² = u_i² + u_j² - 2 r u_i u_j, avec les \
        incertitudes-types u_i et u_j et le coefficient r déclarés ici. Ils viennent de la loi de \
        propagation ; U_i / k_i peut en différer.",
    correlated_raised: "Si U est l'aptitude du laboratoire, u_i la contient ; ce qu'elle ajoute à \
        l'incertitude évaluée est supposé non corrélé avec les autres lignes.",
    shared: "Les lignes ont en commun : {inputs}.",
    many: "Certaines des {rows} lignes ont des grandeurs d'entrée en commun ; les coefficients de \
        corrélation et les incertitudes-types correspondantes sont dans la réponse JSON et dans le \
        classeur.",
    conformity: "Conformité",
    decided: ["conforme", "non conforme", "non démontré"],
    decisions: [
        "Le résultat est conforme à la tolérance {limits}.",
        "Le résultat n'est pas conforme à la tolérance {limits}.",
    ],
    not_shown: [
        "La conformité du résultat à la tolérance {limits} n'est pas démontrée : il se trouve dans la \
            tolérance, mais hors des limites d'acceptation. La règle de décision le refuse.",
        "La conformité du résultat à la tolérance {limits} n'est pas démontrée : il se trouve dans la \
            tolérance, mais la règle de décision n'accepte aucune valeur. Le résultat est refusé.",
    ],
    levels: ["conforme", "conforme sous condition", "non conforme sous condition", "non conforme"],
    level_decisions: [
        "Conforme : le résultat est dans la tolérance {limits} et dans les limites d'acceptation.",
        "Conforme sous condition : le résultat est dans la tolérance {limits}, mais dans la bande de garde.",
        "Non conforme sous condition : le résultat est hors de la tolérance {limits}, d'au plus la bande de garde.",
        "Non conforme : le résultat est hors de la tolérance {limits}, de plus que la bande de garde.",
    ],
    limits: ["de {low} à {high}{unit}", "à partir de {low}{unit}", "jusqu'à {high}{unit}"],
    conforming: "La valeur est conforme avec une probabilité de {p}.",
    all_the_same: "Risque spécifique que la valeur refusée soit conforme : {p}.",
    unrounded: "La décision a été prise avec la valeur avant arrondi, {value}.",
    with_prior: "Cette probabilité tient compte de la connaissance a priori de tels objets (JCGM \
        106:2012, 6.3 et 7.1) : {prior}. D'après la valeur mesurée et son incertitude seules, elle est de \
        {p}.",
    prior: "loi `{shape}` de moyenne {mean} et d'écart-type {std}",
    global_risks: "Risques globaux avec cette connaissance a priori et ces limites d'acceptation \
        : acceptation à tort {a} %, rejet à tort {b} %.",
    percent: ["{p} %", "plus de {p} %", "moins de {p} %"],
    simple: "Règle de décision : acceptation simple (JCGM 106:2012, 8.2).",
    multiple: "Règle de décision : acceptation avec une bande de garde de {band} \
        ({clause}), avec U avant arrondi ; bande de garde {guard}, accepté {limits}.",
    too_wide: "Règle de décision : acceptation avec une bande de garde de {band} \
        ({clause}), avec U avant arrondi ; bande de garde {guard}, plus que la moitié de la tolérance : aucune \
        valeur n'est acceptée.",
    no_band: "Règle de décision : acceptation avec une bande de garde de {band} ({clause}), avec U avant \
        arrondi ; U est plus que la moitié de la tolérance : aucune valeur n'est acceptée.",
    of_rule: [
        "{rule} ; T : moitié de la tolérance",
        "{rule} ; T : moitié de la tolérance ; U avec k = {k}, la règle est définie pour U à 95 % environ",
    ],
    of_ilac_g8: [
        "ILAC-G8:09/2019, 4.2.2",
        "U avec k = {k} ; ILAC-G8:09/2019, 4.2.2, définit la bande de garde pour U à 95 % environ",
    ],
    rule_agreed: "La règle de décision a été convenue avec le client.",
    specification: "Spécification : {name}.",
    guarded: "Règle de décision : acceptation avec bande de garde (JCGM 106:2012, 8.3) pour {kind} d'au plus \
        {risk} % ; bande de garde {guard}, accepté {limits}.",
    never: "Règle de décision : acceptation avec bande de garde (JCGM 106:2012, 8.3) pour {kind} d'au \
        plus {risk} % ; aucune valeur n'a un risque aussi petit.",
    kinds: ["un risque spécifique de fausse acceptation", "un risque global de fausse acceptation"],

    page: "Page {page} sur {pages}",
    end: "Fin du certificat d'étalonnage",
    signed: ["Lieu, date", "Signature"],
    relates: "Les résultats ne se rapportent qu'à l'objet étalonné.",
    copies: "La reproduction de ce certificat n'est autorisée que sous sa forme intégrale, sauf approbation du laboratoire.",
    provenance: "Provenance",
    program: "programme",
    certificate_file: "fichier du certificat, SHA-256",
    certificate_name: "fichier du certificat",
    model_file: "fichier du modèle",
    table: "tableau",
    seed: "graine",
    trials: "tirages de Monte-Carlo",
    adaptive: "adaptatif",

    nominal_value: "Valeur nominale",
    measured_value: "Valeur mesurée",
    coverage_interval: "Intervalle de couverture",
    files: "Fichiers de l'évaluation",
    answer: "Résultat",
};
