//! Pages for a terminal.

use std::sync::Arc;

use super::*;
use crate::{BudgetColumn, table};
use gumption_engine::distribution::{Distribution, EvaluationType as Kind, Rectangular};
use gumption_engine::propagate::gum::Dof;
use gumption_engine::task::Coverage;

/// A page with one blank between words.
fn words(page: &str) -> String {
    page.split_whitespace().collect::<Vec<_>>().join(" ")
}

fn page(case: &Case) -> String {
    let page = table(&case.report(), &full());
    // the results are whole lines
    let below = page.lines().skip_while(|line| !line.is_empty());
    let widest = below.map(|line| line.chars().count()).max().unwrap_or(0);
    assert!(widest <= 100, "{widest} columns:\n{page}");
    assert!(page.lines().all(|line| !line.ends_with(' ')), "{page}");
    page
}

#[test]
fn inclined_plane() {
    insta::assert_snapshot!(page(&only_z(Case::new(plane_at(35.0, 100_000)))), @"
    a_z = (8.192 ± 0.020) m/s^2, k = 1.96, coverage probability 95 %

    inclined-plane
    ══════════════

    coverage probability 95 %; 100 000 Monte Carlo trials, seed 1

    a_z in m/s^2: Acceleration along the sensor's z axis, RMS.
    ──────────────────────────────────────────────────────────

    a_z = (8.192 ± 0.020) m/s^2, k = 1.96, coverage probability 95 %
    JCGM 101, clause 8: the GUM interval is validated: its endpoints differ from the Monte Carlo
    endpoints by 0.00016 and 0.00007 m/s^2, within the numerical tolerance δ = 0.0005 m/s^2 (2 digits).

    quantity  estimate     standard  unit   distribution  dof  sensitivity  contribution  share
                        uncertainty                            coefficient                 in %
    ───────────────────────────────────────────────────────────────────────────────────────────────────
    a_ref       10.000        0.010  m/s^2  normal          ∞       0.8192        0.0082   66.8  █████▍
    tilt        35.000        0.058  deg    rectangular     ∞      -0.1001        0.0058   33.2  ██▋
    ───────────────────────────────────────────────────────────────────────────────────────────────────
    a_z          8.192        0.010  m/s^2  combined        ∞                     0.010   100.0

    Sensitivity coefficients in m/s^2 per unit of the quantity, contributions in m/s^2.

    Constants: rotation = 0 deg.

    result                         value  unit
    ─────────────────────────────────────────────────────
    combined standard uncertainty  0.010  m/s^2
    effective degrees of freedom   ∞
    coverage factor                1.96          for 95 %
    expanded uncertainty           0.020  m/s^2

    quantity                              GUM  Monte Carlo       numerical
                                                            standard error
    ──────────────────────────────────────────────────────────────────────
    estimate                            8.192        8.192         0.00003
    standard uncertainty                0.010        0.010         0.00002
    median                              -            8.192         0.00004
    coverage interval, symmetric: from  8.172        8.172         0.00007
    coverage interval, symmetric: to    8.211        8.211         0.00007
    coverage interval, shortest: from   -            8.172         0.0003
    coverage interval, shortest: to     -            8.211         0.0003
    skewness                            -           -0.01          0.008
    excess kurtosis                     -           -0.13          0.01

    Measurement model
    ─────────────────

    Model inclined-plane: Prato, Mazzoleni, Schiavi (2020), equations (1)-(3); Chiominto et al. (2024),
    equation (1).

    quantity  equation
    ────────────────────────────────────────────
    a_x       abs(a_ref*sin(tilt)*cos(rotation))
    a_y       abs(a_ref*sin(tilt)*sin(rotation))
    a_z       abs(a_ref*cos(tilt))

    Quantities
    ──────────

    quantity  what it is
    ─────────────────────────────────────────────────────────
    a_ref     Reference acceleration along the vertical, RMS.
    tilt      Tilt angle of the plane against the horizontal.
    rotation  Rotation angle of the sensor on the plane.

    Reproducing this result
    ───────────────────────

    what                  value
    ────────────────────────────────────
    program               gumption 0.1.0
    seed                  1
    trials                100000
    coverage probability  0.95
    digits                2
    model file, SHA-256   0123
    data.csv, SHA-256     4567

    The same program, files and seed give the same result with any number of threads.
    ");
}

#[test]
fn readings_groups_and_degrees_of_freedom() {
    insta::assert_snapshot!(page(&Case::new(grouped(20_000))), @"
    a_x = (4.967 ± 0.016) m/s^2, k = 2.08, coverage probability 95 %
    a_y = (2.868 ± 0.013) m/s^2, k = 1.98, coverage probability 95 %
    a_z = (8.192 ± 0.017) m/s^2, k = 2.23, coverage probability 95 %

    a_x, a_y, a_z: GUM interval not validated (JCGM 101, clause 8) because of few degrees of freedom. U
    is stated by the law of propagation.

    inclined-plane
    ══════════════

    coverage probability 95 %; 20 000 Monte Carlo trials, seed 1

    a_x in m/s^2: Acceleration along the sensor's x axis, RMS.
    ──────────────────────────────────────────────────────────

    a_x = (4.967 ± 0.016) m/s^2, k = 2.08, coverage probability 95 %
    JCGM 101, clause 8: the GUM interval is not validated: its endpoints differ from the Monte Carlo
    endpoints by 0.0017 and 0.0017 m/s^2, more than the numerical tolerance δ = 0.00005 m/s^2 (2
    digits).
    The cause is few degrees of freedom: with infinite degrees of freedom the endpoints differ by 0.49 %
    of U.
    U is stated by the law of propagation.

    quantity  estimate     standard  unit   distribution         dof  sensitivity  contribution  share
                        uncertainty                                   coefficient                 in %
    ──────────────────────────────────────────────────────────────────────────────────────────────────
    tilt       35.000        0.050   deg    normal (drawn as t)   12      0.1238         0.0062   64.9
    a_ref      10.0000       0.0071  m/s^2  readings               4      0.4967         0.0035   20.9
    rotation   30.000        0.058   deg    rectangular            ∞     -0.05005        0.0029   14.2
    ──────────────────────────────────────────────────────────────────────────────────────────────────
    a_x         4.9673       0.0077  m/s^2  combined              21                     0.0077  100.0

    Sensitivity coefficients in m/s^2 per unit of the quantity, contributions in m/s^2.

    Subtotals: angles 79.1 %, no group 20.9 %; type A 20.9 %, type B 79.1 %.

    result                           value  unit
    ───────────────────────────────────────────────────────
    combined standard uncertainty   0.0077  m/s^2
    effective degrees of freedom   21
    coverage factor                 2.08           for 95 %
    expanded uncertainty            0.016   m/s^2

    quantity                               GUM  Monte Carlo       numerical
                                                             standard error
    ───────────────────────────────────────────────────────────────────────
    estimate                            4.9673       4.9673         0.00006
    standard uncertainty                0.0077       0.0090         -
    median                              -            4.9673         0.00007
    coverage interval, symmetric: from  4.9513       4.9496         0.0002
    coverage interval, symmetric: to    4.9833       4.9850         0.0001
    coverage interval, shortest: from   -            4.9500         0.0004
    coverage interval, shortest: to     -            4.9853         0.0002
    skewness                            -           -0.13           -

    a_y in m/s^2: Acceleration along the sensor's y axis, RMS.
    ──────────────────────────────────────────────────────────

    a_y = (2.868 ± 0.013) m/s^2, k = 1.98, coverage probability 95 %
    JCGM 101, clause 8: the GUM interval is not validated: its endpoints differ from the Monte Carlo
    endpoints by 0.0003 and 0.0005 m/s^2, more than the numerical tolerance δ = 0.00005 m/s^2 (2
    digits).
    The cause is few degrees of freedom: with infinite degrees of freedom the endpoints differ by 3.9 %
    of U.
    U is stated by the law of propagation.

    quantity  estimate     standard  unit   distribution         dof  sensitivity  contribution  share
                        uncertainty                                   coefficient                 in %
    ──────────────────────────────────────────────────────────────────────────────────────────────────
    rotation   30.000        0.058   deg    rectangular            ∞      0.08670        0.0050   59.7
    tilt       35.000        0.050   deg    normal (drawn as t)   12      0.07148        0.0036   30.5
    a_ref      10.0000       0.0071  m/s^2  readings               4      0.2868         0.0020    9.8
    ──────────────────────────────────────────────────────────────────────────────────────────────────
    a_y         2.8679       0.0065  m/s^2  combined              98                     0.0065  100.0

    Sensitivity coefficients in m/s^2 per unit of the quantity, contributions in m/s^2.

    Subtotals: angles 90.2 %, no group 9.8 %; type A 9.8 %, type B 90.2 %.

    result                           value  unit
    ───────────────────────────────────────────────────────
    combined standard uncertainty   0.0065  m/s^2
    effective degrees of freedom   98
    coverage factor                 1.98           for 95 %
    expanded uncertainty            0.013   m/s^2

    quantity                               GUM  Monte Carlo       numerical
                                                             standard error
    ───────────────────────────────────────────────────────────────────────
    estimate                            2.8679       2.8679         0.00005
    standard uncertainty                0.0065       0.0070         -
    median                              -            2.8679         0.00007
    coverage interval, symmetric: from  2.8550       2.8548         0.0001
    coverage interval, symmetric: to    2.8807       2.8812         0.0001
    coverage interval, shortest: from   -            2.8545         0.0003
    coverage interval, shortest: to     -            2.8810         0.0002
    skewness                            -           -0.04           -

    a_z in m/s^2: Acceleration along the sensor's z axis, RMS.
    ──────────────────────────────────────────────────────────

    a_z = (8.192 ± 0.017) m/s^2, k = 2.23, coverage probability 95 %
    JCGM 101, clause 8: the GUM interval is not validated: its endpoints differ from the Monte Carlo
    endpoints by 0.0023 and 0.0023 m/s^2, more than the numerical tolerance δ = 0.00005 m/s^2 (2
    digits).
    The cause is few degrees of freedom: with infinite degrees of freedom the endpoints differ by 0.44 %
    of U.
    U is stated by the law of propagation.

    quantity  estimate     standard  unit   distribution         dof  sensitivity  contribution  share
                        uncertainty                                   coefficient                 in %
    ──────────────────────────────────────────────────────────────────────────────────────────────────
    a_ref      10.0000       0.0071  m/s^2  readings               4       0.8192        0.0058   57.2
    tilt       35.000        0.050   deg    normal (drawn as t)   12      -0.1001        0.0050   42.8
    rotation   30.000        0.058   deg    rectangular            ∞       0             0         0.0
    ──────────────────────────────────────────────────────────────────────────────────────────────────
    a_z         8.1915       0.0077  m/s^2  combined              10                     0.0077  100.0

    Sensitivity coefficients in m/s^2 per unit of the quantity, contributions in m/s^2.

    Subtotals: angles 42.8 %, no group 57.2 %; type A 57.2 %, type B 42.8 %.

    result                           value  unit
    ───────────────────────────────────────────────────────
    combined standard uncertainty   0.0077  m/s^2
    effective degrees of freedom   10
    coverage factor                 2.23           for 95 %
    expanded uncertainty            0.017   m/s^2

    quantity                               GUM  Monte Carlo       numerical
                                                             standard error
    ───────────────────────────────────────────────────────────────────────
    estimate                            8.1915        8.191         0.00007
    standard uncertainty                0.0077        0.010         -
    median                              -             8.192         0.00007
    coverage interval, symmetric: from  8.1745        8.172         0.0002
    coverage interval, symmetric: to    8.2086        8.211         0.0002
    coverage interval, shortest: from   -             8.173         0.0003
    coverage interval, shortest: to     -             8.212         0.0007
    skewness                            -            -0.70          -

    Correlation of the outputs
    ──────────────────────────

    correlation    a_y    a_z
    ─────────────────────────
    a_x          0.430  0.066
    a_y                 0.040

    Measurement model
    ─────────────────

    Model inclined-plane: Prato, Mazzoleni, Schiavi (2020), equations (1)-(3); Chiominto et al. (2024),
    equation (1).

    quantity  equation
    ────────────────────────────────────────────
    a_x       abs(a_ref*sin(tilt)*cos(rotation))
    a_y       abs(a_ref*sin(tilt)*sin(rotation))
    a_z       abs(a_ref*cos(tilt))

    Quantities
    ──────────

    quantity  what it is
    ─────────────────────────────────────────────────────────
    a_ref     repeatability
    tilt      Tilt angle of the plane against the horizontal.
    rotation  Rotation angle of the sensor on the plane.

    Reproducing this result
    ───────────────────────

    what                  value
    ────────────────────────────────────
    program               gumption 0.1.0
    seed                  1
    trials                20000
    coverage probability  0.95
    digits                2
    model file, SHA-256   0123
    data.csv, SHA-256     4567

    The same program, files and seed give the same result with any number of threads.
    ");
}

#[test]
fn correlated_inputs() {
    insta::assert_snapshot!(page(&only_z(Case::new(correlated(20_000)))), @"
    a_z = (8.192 ± 0.032) m/s^2, k = 1.96, coverage probability 95 %

    a_z: undecided whether the GUM interval is validated (JCGM 101, clause 8); more trials decide.

    inclined-plane
    ══════════════

    coverage probability 95 %; 20 000 Monte Carlo trials, seed 1

    a_z in m/s^2: Acceleration along the sensor's z axis, RMS.
    ──────────────────────────────────────────────────────────

    a_z = (8.192 ± 0.032) m/s^2, k = 1.96, coverage probability 95 %
    JCGM 101, clause 8: undecided whether the GUM interval is validated: its endpoints differ from the
    Monte Carlo endpoints by 0.0005 and 0.0003 m/s^2, too near to the numerical tolerance δ = 0.0005
    m/s^2 (2 digits) for 20 000 trials.

    quantity        estimate     standard  unit   distribution  dof  sensitivity  contribution  share
                              uncertainty                            coefficient                 in %
    ─────────────────────────────────────────────────────────────────────────────────────────────────
    tilt              35.00         0.10   deg    normal          ∞      -0.1001        0.010    37.7
    a_ref             10.000        0.010  m/s^2  normal          ∞       0.8192        0.0082   25.3
    r(a_ref, tilt)    -0.6                        correlation                                    37.0
    ─────────────────────────────────────────────────────────────────────────────────────────────────
    a_z                8.192        0.016  m/s^2  combined        ∞                     0.016   100.0

    Sensitivity coefficients in m/s^2 per unit of the quantity, contributions in m/s^2.

    Constants: rotation = 0 deg.

    result                         value  unit
    ─────────────────────────────────────────────────────
    combined standard uncertainty  0.016  m/s^2
    effective degrees of freedom   ∞
    coverage factor                1.96          for 95 %
    expanded uncertainty           0.032  m/s^2

    quantity                              GUM  Monte Carlo       numerical
                                                            standard error
    ──────────────────────────────────────────────────────────────────────
    estimate                            8.192        8.191         0.0001
    standard uncertainty                0.016        0.016         0.00008
    median                              -            8.191         0.0001
    coverage interval, symmetric: from  8.160        8.159         0.0003
    coverage interval, symmetric: to    8.223        8.223         0.0003
    coverage interval, shortest: from   -            8.159         0.0007
    coverage interval, shortest: to     -            8.223         0.0009
    skewness                            -           -0.02          0.02
    excess kurtosis                     -            0.08          0.05

    Measurement model
    ─────────────────

    Model inclined-plane: Prato, Mazzoleni, Schiavi (2020), equations (1)-(3); Chiominto et al. (2024),
    equation (1).

    quantity  equation
    ────────────────────────────────────────────
    a_x       abs(a_ref*sin(tilt)*cos(rotation))
    a_y       abs(a_ref*sin(tilt)*sin(rotation))
    a_z       abs(a_ref*cos(tilt))

    Quantities
    ──────────

    quantity  what it is
    ─────────────────────────────────────────────────────────
    a_ref     Reference acceleration along the vertical, RMS.
    tilt      Tilt angle of the plane against the horizontal.
    rotation  Rotation angle of the sensor on the plane.

    Reproducing this result
    ───────────────────────

    what                  value
    ────────────────────────────────────
    program               gumption 0.1.0
    seed                  1
    trials                20000
    coverage probability  0.95
    digits                2
    model file, SHA-256   0123
    data.csv, SHA-256     4567

    The same program, files and seed give the same result with any number of threads.
    ");
}

#[test]
fn by_gum_alone() {
    insta::assert_snapshot!(page(&only_z(Case::new(plane_at(35.0, 0)))), @"
    a_z = (8.192 ± 0.020) m/s^2, k = 1.96, coverage probability 95 %

    inclined-plane
    ══════════════

    coverage probability 95 %

    a_z in m/s^2: Acceleration along the sensor's z axis, RMS.
    ──────────────────────────────────────────────────────────

    a_z = (8.192 ± 0.020) m/s^2, k = 1.96, coverage probability 95 %
    Coverage interval from 8.172 to 8.211 m/s^2, by GUM alone.

    quantity  estimate     standard  unit   distribution  dof  sensitivity  contribution  share
                        uncertainty                            coefficient                 in %
    ───────────────────────────────────────────────────────────────────────────────────────────────────
    a_ref       10.000        0.010  m/s^2  normal          ∞       0.8192        0.0082   66.8  █████▍
    tilt        35.000        0.058  deg    rectangular     ∞      -0.1001        0.0058   33.2  ██▋
    ───────────────────────────────────────────────────────────────────────────────────────────────────
    a_z          8.192        0.010  m/s^2  combined        ∞                     0.010   100.0

    Sensitivity coefficients in m/s^2 per unit of the quantity, contributions in m/s^2.

    Constants: rotation = 0 deg.

    result                         value  unit
    ─────────────────────────────────────────────────────
    combined standard uncertainty  0.010  m/s^2
    effective degrees of freedom   ∞
    coverage factor                1.96          for 95 %
    expanded uncertainty           0.020  m/s^2

    Measurement model
    ─────────────────

    Model inclined-plane: Prato, Mazzoleni, Schiavi (2020), equations (1)-(3); Chiominto et al. (2024),
    equation (1).

    quantity  equation
    ────────────────────────────────────────────
    a_x       abs(a_ref*sin(tilt)*cos(rotation))
    a_y       abs(a_ref*sin(tilt)*sin(rotation))
    a_z       abs(a_ref*cos(tilt))

    Quantities
    ──────────

    quantity  what it is
    ─────────────────────────────────────────────────────────
    a_ref     Reference acceleration along the vertical, RMS.
    tilt      Tilt angle of the plane against the horizontal.
    rotation  Rotation angle of the sensor on the plane.

    Reproducing this result
    ───────────────────────

    what                  value
    ────────────────────────────────────
    program               gumption 0.1.0
    seed                  1
    trials                0
    coverage probability  0.95
    digits                2
    model file, SHA-256   0123
    data.csv, SHA-256     4567

    The same program, files and seed give the same result with any number of threads.
    ");
}

#[test]
fn where_gum_is_not_valid() {
    // at tilt 0 the cosine is at its maximum: its distribution is lopsided
    let mut case = only_z(Case::new(plane_at(0.0, 100_000)));
    let mut task = plane_at(0.0, 100_000);
    let tilt: Distribution = Rectangular::new(0.0, 10.0).unwrap().into();
    Arc::get_mut(&mut task.rows[0].distributions).unwrap()[1] = Arc::new(tilt);
    case.evaluation = only_z(Case::new(task)).evaluation;
    insta::assert_snapshot!(page(&case), @"
    a_z = 9.950 m/s^2, from 9.854 to 10.010, coverage probability 95 % (Monte Carlo, symmetric)

    a_z: GUM interval not validated (JCGM 101, clause 8) because of the shape of a distribution or a
    nonlinear model. The symmetric Monte Carlo interval is stated.

    inclined-plane
    ══════════════

    coverage probability 95 %; 100 000 Monte Carlo trials, seed 1

    a_z in m/s^2: Acceleration along the sensor's z axis, RMS.
    ──────────────────────────────────────────────────────────

    a_z = 9.950 m/s^2, from 9.854 to 10.010, coverage probability 95 % (Monte Carlo, symmetric)
    JCGM 101, clause 8: the GUM interval is not validated: its endpoints differ from the Monte Carlo
    endpoints by 0.13 and 0.0092 m/s^2, more than the numerical tolerance δ = 0.0005 m/s^2 (2 digits).
    The cause is the shape of a distribution or a nonlinear model: the endpoints differ by 650 % of U.
    The symmetric Monte Carlo interval is stated.

    quantity  estimate     standard  unit   distribution  dof  sensitivity  contribution  share
                        uncertainty                            coefficient                 in %
    ───────────────────────────────────────────────────────────────────────────────────────────
    a_ref       10.000        0.010  m/s^2  normal          ∞        1.000         0.010  100.0
    tilt         0.0          5.8    deg    rectangular     ∞        0             0        0.0
    ───────────────────────────────────────────────────────────────────────────────────────────
    a_z         10.000        0.010  m/s^2  combined        ∞                      0.010  100.0

    Sensitivity coefficients in m/s^2 per unit of the quantity, contributions in m/s^2.

    Constants: rotation = 0 deg.

    result                         value  unit
    ─────────────────────────────────────────────────────
    combined standard uncertainty  0.010  m/s^2
    effective degrees of freedom   ∞
    coverage factor                1.96          for 95 %
    expanded uncertainty           0.020  m/s^2

    quantity                               GUM  Monte Carlo       numerical
                                                             standard error
    ───────────────────────────────────────────────────────────────────────
    estimate                            10.000        9.950         0.0001
    standard uncertainty                 0.010        0.046         0.00008
    median                               -            9.962         0.0002
    coverage interval, symmetric: from   9.980        9.854         0.0002
    coverage interval, symmetric: to    10.020       10.010         0.0001
    coverage interval, shortest: from    -            9.857         0.0007
    coverage interval, shortest: to      -           10.013         0.0006
    skewness                             -           -0.60          0.004
    excess kurtosis                      -           -0.78          0.008

    Measurement model
    ─────────────────

    Model inclined-plane: Prato, Mazzoleni, Schiavi (2020), equations (1)-(3); Chiominto et al. (2024),
    equation (1).

    quantity  equation
    ────────────────────────────────────────────
    a_x       abs(a_ref*sin(tilt)*cos(rotation))
    a_y       abs(a_ref*sin(tilt)*sin(rotation))
    a_z       abs(a_ref*cos(tilt))

    Quantities
    ──────────

    quantity  what it is
    ─────────────────────────────────────────────────────────
    a_ref     Reference acceleration along the vertical, RMS.
    tilt      Tilt angle of the plane against the horizontal.
    rotation  Rotation angle of the sensor on the plane.

    Reproducing this result
    ───────────────────────

    what                  value
    ────────────────────────────────────
    program               gumption 0.1.0
    seed                  1
    trials                100000
    coverage probability  0.95
    digits                2
    model file, SHA-256   0123
    data.csv, SHA-256     4567

    The same program, files and seed give the same result with any number of threads.
    ");
}

#[test]
fn no_gum_interval() {
    let mut case = only_z(Case::new(plane_at(35.0, 10_000)));
    case.evaluation.rows[0].outputs[0].gum = None;
    case.evaluation.rows[0].outputs[0].validation = None;
    case.evaluation.stopped = true;
    insta::assert_snapshot!(page(&case), @"
    a_z = 8.191 m/s^2, from 8.172 to 8.211, coverage probability 95 % (Monte Carlo, symmetric)

    a_z: there is no GUM interval. The symmetric Monte Carlo interval is stated.

    inclined-plane
    ══════════════

    coverage probability 95 %; 10 000 Monte Carlo trials, seed 1, as it was stopped; 10 000 were asked
    for
    stopped after 10 000 trials

    a_z in m/s^2: Acceleration along the sensor's z axis, RMS.
    ──────────────────────────────────────────────────────────

    a_z = 8.191 m/s^2, from 8.172 to 8.211, coverage probability 95 % (Monte Carlo, symmetric)
    JCGM 101, clause 8: there is no GUM interval to compare; the Monte Carlo interval is stated.

    There is no budget: the estimate or a sensitivity coefficient is not finite here.

    quantity                            GUM  Monte Carlo       numerical
                                                          standard error
    ────────────────────────────────────────────────────────────────────
    estimate                              -        8.191         0.0001
    standard uncertainty                  -        0.010         0.00007
    median                                -        8.192         0.0001
    coverage interval, symmetric: from    -        8.172         0.0002
    coverage interval, symmetric: to      -        8.211         0.0002
    coverage interval, shortest: from     -        8.172         0.0003
    coverage interval, shortest: to       -        8.212         0.0003
    skewness                              -       -0.02          0.02
    excess kurtosis                       -       -0.14          0.05

    Measurement model
    ─────────────────

    Model inclined-plane: Prato, Mazzoleni, Schiavi (2020), equations (1)-(3); Chiominto et al. (2024),
    equation (1).

    quantity  equation
    ────────────────────────────────────────────
    a_x       abs(a_ref*sin(tilt)*cos(rotation))
    a_y       abs(a_ref*sin(tilt)*sin(rotation))
    a_z       abs(a_ref*cos(tilt))

    Quantities
    ──────────

    quantity  what it is
    ─────────────────────────────────────────────────────────
    a_ref     Reference acceleration along the vertical, RMS.
    tilt      Tilt angle of the plane against the horizontal.
    rotation  Rotation angle of the sensor on the plane.

    Reproducing this result
    ───────────────────────

    what                  value
    ────────────────────────────────────────────────────────
    program               gumption 0.1.0
    seed                  1
    trials                10000; stopped after 10 000 trials
    coverage probability  0.95
    digits                2
    model file, SHA-256   0123
    data.csv, SHA-256     4567

    The same program, files and seed give the same result with any number of threads.
    ");
}

#[test]
fn undefined_degrees_of_freedom() {
    let mut case = only_z(Case::new(correlated(10_000)));
    let output = &mut case.evaluation.rows[0].outputs[0];
    let gum = output.gum.as_mut().unwrap();
    (gum.dof, gum.coverage_factor, output.validation) = (Dof::Undefined, None, None);
    let page = page(&case);
    for said in [
        "effective degrees of freedom undefined",
        "coverage factor not defined for these degrees of freedom",
        "expanded uncertainty not defined",
        "JCGM 101, clause 8: there is no GUM interval to compare; the Monte Carlo interval is stated.",
    ] {
        assert!(page.lines().any(|found| words(found) == said), "{said}\n{page}");
    }
    let gum = &case.json()["outputs"]["a_z"]["gum"];
    assert_eq!(gum["dof_status"], "undefined");
    for key in ["dof", "coverage_factor", "expanded_uncertainty", "interval"] {
        assert!(gum[key].is_null(), "{key}");
    }
}

#[test]
fn digits_are_those_of_the_settings() {
    let mut case = only_z(Case::new(plane_at(35.0, 0)));
    case.evaluation.settings.digits = 3;
    assert!(words(&page(&case)).contains("standard uncertainty 0.0100 m/s^2"));
    case.evaluation.settings.digits = 1;
    assert!(words(&page(&case)).contains("standard uncertainty 0.01 m/s^2"));
}

#[test]
fn a_sweep_is_one_table_for_each_output() {
    insta::assert_snapshot!(page(&sweep(&[0.0, 15.0, 45.0, 90.0], 20_000)), @"
    inclined-plane
    ══════════════

    coverage probability 95 %; 20 000 Monte Carlo trials for each row, seed 1

    a_x in m/s^2: Acceleration along the sensor's x axis, RMS.
    ──────────────────────────────────────────────────────────

        f    tilt  estimate     standard     expanded     k  Monte Carlo       to  GUM interval
    in Hz  in deg            uncertainty  uncertainty               from           validated
    ───────────────────────────────────────────────────────────────────────────────────────────
       80       0     0            0            0      1.96       0.0004   0.0170  no
       80      15     2.588        0.010        0.020  1.96       2.571    2.606   no
       80      45     7.071        0.010        0.020  1.96       7.052    7.090   undecided
       80      90    10.000        0.010        0.020  1.96       9.980   10.020   undecided

    The stated coverage interval is the Monte Carlo interval, not estimate ± U, in rows 1, 2.

    Shares of the variance in %:

        f    tilt  a_ref  tilt
    in Hz  in deg
    ──────────────────────────
       80       0    0.0   0.0
       80      15    6.6  93.4
       80      45   49.6  50.4
       80      90  100.0   0.0

    a_y in m/s^2: Acceleration along the sensor's y axis, RMS.
    ──────────────────────────────────────────────────────────

        f    tilt  estimate     standard     expanded     k  Monte Carlo  to  GUM interval
    in Hz  in deg            uncertainty  uncertainty               from      validated
    ──────────────────────────────────────────────────────────────────────────────────────
       80       0         0            0            0  1.96            0   0  yes
       80      15         0            0            0  1.96            0   0  yes
       80      45         0            0            0  1.96            0   0  yes
       80      90         0            0            0  1.96            0   0  yes

    a_z in m/s^2: Acceleration along the sensor's z axis, RMS.
    ──────────────────────────────────────────────────────────

        f    tilt  estimate     standard     expanded     k  Monte Carlo       to  GUM interval
    in Hz  in deg            uncertainty  uncertainty               from           validated
    ───────────────────────────────────────────────────────────────────────────────────────────
       80       0    10.000        0.010        0.020  1.96       9.980   10.020   undecided
       80      15     9.659        0.010        0.020  1.96       9.639    9.679   undecided
       80      45     7.071        0.010        0.020  1.96       7.052    7.090   undecided
       80      90     0.000        0.010        0.020  1.96       0.0004   0.0170  no

    The stated coverage interval is the Monte Carlo interval, not estimate ± U, in row 4.

    Shares of the variance in %:

        f    tilt  a_ref   tilt
    in Hz  in deg
    ───────────────────────────
       80       0  100.0    0.0
       80      15   93.2    6.8
       80      45   49.6   50.4
       80      90    0.0  100.0

    Budgets, shortest intervals, numerical standard errors and correlations of every row: --format json.

    Measurement model
    ─────────────────

    Model inclined-plane: Prato, Mazzoleni, Schiavi (2020), equations (1)-(3); Chiominto et al. (2024),
    equation (1).

    quantity  equation
    ────────────────────────────────────────────
    a_x       abs(a_ref*sin(tilt)*cos(rotation))
    a_y       abs(a_ref*sin(tilt)*sin(rotation))
    a_z       abs(a_ref*cos(tilt))

    Quantities
    ──────────

    quantity  what it is
    ─────────────────────────────────────────────────────────
    a_ref     Reference acceleration along the vertical, RMS.
    tilt      Tilt angle of the plane against the horizontal.
    rotation  Rotation angle of the sensor on the plane.

    Reproducing this result
    ───────────────────────

    what                  value
    ────────────────────────────────────
    program               gumption 0.1.0
    seed                  1
    trials                20000
    coverage probability  0.95
    digits                2
    model file, SHA-256   0123
    data.csv, SHA-256     4567

    The same program, files and seed give the same result with any number of threads.
    ");
}

#[test]
fn a_coverage_factor_is_named_as_people_name_it() {
    let mut task = plane_at(35.0, 0);
    task.settings.coverage = Coverage::Factor { factor: 2.0, fixed: false };
    assert!(words(&page(&Case::new(task))).contains("factor 2.00 for approximately 95 %"));
    let mut task = plane_at(35.0, 0);
    task.settings.coverage = Coverage::Factor { factor: 3.0, fixed: true };
    assert!(words(&page(&Case::new(task))).contains("factor 3.00 for 99.73 %, fixed"));
}

#[test]
fn long_names_and_texts_keep_the_page_in_bounds() {
    let mut case = Case::new(correlated(2000));
    let long = "a_very_long_name_of_a_quantity_that_goes_on_and_on_and_on/with_a_component";
    for variable in &mut case.task.variables {
        variable.name = long.to_owned();
        variable.about = "words and ".repeat(30);
        variable.group = Some("group of a long name ".repeat(4));
        variable.evaluation = Kind::A;
    }
    case.task.title = "\u{1b}[31mred\u{7}\r\n title".to_owned() + &" and more".repeat(20);
    for output in &mut case.task.model.outputs {
        output.quantity.name = long.to_owned();
        output.quantity.about = "more words ".repeat(30);
    }
    let page = page(&case);
    assert!(page.chars().all(|c| c == '\n' || !c.is_control()));
    assert!(page.contains("\n[31mred title and more"));
}

/// Texts far beyond what anybody reads, in one word or in many, are cut after twenty lines; the
/// answer for programs has them whole.
#[test]
fn endless_texts_are_cut() {
    for text in ["x".repeat(70_000), "word ".repeat(20_000)] {
        let mut case = Case::new(correlated(2000));
        case.task.title.clone_from(&text);
        for variable in &mut case.task.variables {
            variable.about.clone_from(&text);
            variable.group = Some(text.clone());
        }
        for output in &mut case.task.model.outputs {
            output.quantity.about.clone_from(&text);
        }
        let shown = Shown { columns: &BudgetColumn::ALL, ..full() };
        let page = table(&case.report(), &shown);
        assert!(page.lines().all(|line| line.chars().count() <= 100), "{page}");
        let above: Vec<&str> = page.lines().take_while(|line| !line.contains('═')).collect();
        let title = above.rsplit(|line| line.is_empty()).next().unwrap();
        assert!((20..=21).contains(&title.len()), "{title:?}");
        assert!(title.last().is_some_and(|line| line.ends_with('…')), "{title:?}");
        assert_eq!(case.json()["title"], text);
    }
}

/// A sweep with twelve conditions beside the tilt.
fn many_conditions(tilts: &[f64]) -> Case {
    let mut case = sweep(tilts, 2000);
    let condition = case.task.model.conditions[1].clone();
    for number in 0..12 {
        let name = format!("condition_{number}");
        case.task.model.conditions.push(Quantity { name, ..condition.clone() });
        for (row, tilt) in case.evaluation.rows.iter_mut().zip(tilts) {
            row.conditions.push(0.25 + tilt);
        }
    }
    case
}

/// What was measured in every row stands among the conditions: the tilt names the rows.
#[test]
fn rows_are_named_by_what_tells_them_apart() {
    let case = many_conditions(&[0.0, 15.0]);
    let page = page(&case);
    let (answers, conditions) = page.split_once("All conditions of the rows").expect("all of them");
    assert!(answers.contains("\n  tilt  estimate ") && !answers.contains("condition_3"), "{page}");
    assert!(conditions.contains("\n  tilt ") && conditions.contains("condition_3"), "{page}");
    let found = gumption_engine::propagate::naming(&case.evaluation.rows);
    assert_eq!(found, [1]);
}

#[test]
fn many_conditions_are_numbered() {
    // two rows are alike, so that nothing tells all apart
    let case = many_conditions(&[0.0, 15.0, 0.0]);
    let page = page(&case);
    let (answers, conditions) = page.split_once("All conditions of the rows").expect("all of them");
    assert!(answers.contains("\nrow  estimate ") && !answers.contains("condition_3"), "{page}");
    assert!(conditions.contains("\nrow ") && conditions.contains("condition_3"), "{page}");
}

/// Pages for terminals: no line is longer than the terminal is wide, and every word is one of those
/// that a page has on which nothing is narrow.
#[test]
fn nothing_breaks_in_mid_word_from_60_columns_up() {
    let cases = [
        Case::new(grouped(2000)),
        Case::new(correlated(2000)),
        sweep(&[15.0, 35.0, 55.0, 75.0], 2000),
    ];
    for case in &cases {
        let page = |columns: usize| {
            crate::within_width(columns, || table(&case.report(), &Shown::default()))
        };
        let words = |page: &str| -> std::collections::BTreeSet<String> {
            let words = page.split_whitespace().filter(|word| !word.contains(['─', '═']));
            words.map(str::to_owned).collect()
        };
        // headers of narrow columns are written with hyphens
        let hyphens = "sensi- tivity contri- bution distri- uncer- tainty";
        let wide = [page(100), page(200), hyphens.to_owned()].join(" ");
        let known = words(&wide);
        for columns in [60, 64, 72, 80, 90, 99, 100, 120, 140, 200] {
            let page = page(columns);
            for line in page.lines() {
                assert!(line.chars().count() <= columns, "{columns}: {line}\n{page}");
            }
            let broken: Vec<String> = words(&page).difference(&known).cloned().collect();
            assert!(broken.is_empty(), "{columns}: {broken:?}\n{page}");
        }
    }
}
