//! Odd budgets: each is refused with a question or a mistake that names what is odd, and none comes in wrong.

use super::*;

/// A sheet, and a part of the message that refuses it.
const REFUSED: [(&str, &str); 102] = [
    ("label,x,U\nA,1,0.1\n", "this is a table of results, which `gumption compare` reads"),
    ("quantity,estimate,+-\n", "no row below this heading is a quantity"),
    (
        "quantity,estimate,+-\nx,one,2\n",
        "`one` in column B `estimate` is no number with a unit that is known",
    ),
    (
        "quantity;estimate;+-\nx;1.234;0,5\n",
        "`1.234` has a decimal point and `0,5` a decimal comma in one table",
    ),
    ("Quantity;Estimate;Min;Max\na;20;19;\n", "`a` has no uncertainty"),
    (
        "Quantity;Estimate;Unit;±\nh;0,5;;2 %\n",
        "the estimate `0,5` has no unit, and its uncertainty is in `%`",
    ),
    (
        "Source,Value,Unit,U,p\na,5,V,0.1,95%\n",
        "column E `p` is headed by no word that is known, and has numbers, units or distributions",
    ),
    ("quantity,estimate,unit,+-\nx,5,V,-0.1\n", "the uncertainty `-0.1` is below zero"),
    ("Quantity;Estimate;Min;Max\na;0,2;-1;1\n", "is not in the middle of the limits"),
    (
        "Quantity;Estimate;Min;Max\na;20;21;19\n",
        "the lower limit `21` is not below the upper one, `19`",
    ),
    (
        "Quantity;Estimate;Unit;±\nd;0;V;0,1 %\n",
        "`0,1 %` is a share, and of the estimate of this row nothing can be taken",
    ),
    ("Quantity;Estimate (mm);u (µm)\nL;50;2 %\n", "`2 %` is in `%`, and its heading says `µm`"),
    (
        "quantity,estimate,+-,divisor\nx,1,2,zero\n",
        "`zero` in column D `divisor` is no factor above 0",
    ),
    (
        "Quantity;Estimate (mm);u (µm)\nL;50;22 nm\n",
        "`22 nm` is in `nm`, and its heading says `µm`",
    ),
    (
        "Quantity;Estimate;Unit;U (2 SD)\nRef;10;V;0,004\n",
        "`2 SD` in the heading `U (2 SD)` is not understood: `2 SD` is no unit, factor or probabili",
    ),
    ("Quantity;Unit;Estimate;u\na;m;3;0,1;extra;cells\n", "`extra` stands below no heading"),
    (
        "Source,Unit,±,Divisor,u(xi)\nRef,V,0.030,2,0.030\n",
        "the row states two standard uncertainties",
    ),
    (
        "y = 2*(T-20)\nQuantity;Estimate;Unit;u\nT;30;K;0,5\n",
        "the equation `y = 2*(T-20)` does not pass the check of units (`T` is a temperature (K), bu",
    ),
    ("Quantity;Estimate;Unit;u\na;1,234;V;1\nb;2,500;V;2\n", "`1,234` can be `1.234` or `1234`"),
    ("Quantity,Estimate,Uncertainty\n,mm,(µm) k=2\na,20,1\n", "a row has numbers and no name"),
    (
        "Y = a\nQuantity;Estimate;Unit;u\na;3;V;0.1\na;4;V;0.1\n",
        "two rows are called `a`, which the equation uses",
    ),
    (
        "Grandeur;Estimation;Unité;Uncertainty U\nm;1;kg;0,0004\n",
        "nothing says what kind of uncertainty `0,0004` is",
    ),
    (
        "Quantity,Estimate,Unit,SD,Distribution\nA,10,V,0.1,normal\n",
        "column D `SD` holds standard deviations",
    ),
    (
        "Component,u (V)\nRef,0.001\nRep,0.0005\nAll together,0.00112\n",
        "`All together` has the combined uncertainty of the rows above",
    ),
    (
        "Quantity,Estimate,Unit,Uncertainty,Divisor\nr,0.85,1,5 mm,1\n",
        "the uncertainty `5 mm` is in `mm`, and the quantity in `1`",
    ),
    ("Quantity,Estimate (V),Standard uncertainty\nA (mV),10.5,0.1\n", "the row states two units"),
    (
        "Source,Value,Unit,U (k=2),Distribution\na,5,V,0.1,rectangular\n",
        "`0.1` is rectangular below a heading of expanded uncertainties",
    ),
    (
        "Quantity;Estimate;Unit;±;Coverage factor;Divisor\na;3;V;0.1;2;3\n",
        "the row states two factors",
    ),
    (
        "Quantity,Estimate,Unit,Standard uncertainty\na,10,1,0.1\nb,5,2,0.2\n",
        "`2` in the column of the unit is no unit that is known",
    ),
    (
        "Quantity;Estimate;Unit;u\na;3;1;0.1\nb;2;1;0.1\nY = a + b\nY = a - b\n",
        "two equations can be that of the result",
    ),
    (
        "Quantity;Estimate;Unit;u\na;3;1;0.1\nb;2;1;0.1\nY = a - b\nY = 2a + b\n",
        "`Y = 2a + b` cannot be read as an equation, `a` is not allowed here; expected an operator or",
    ),
    (
        "Quantity,Value,Unit,U,k\nV,10000,mV,20,2\nI,2,A,0.01,2\n\nR = V/(50*I)\n",
        "the number 50 of the equation may convert units, and the sheet states no result",
    ),
    (
        "Quantity,Value,Unit,U,k\nL0,10,mm,0.001,2\nd,4,µm,2,2\n\nL = L0 + d/1000\n",
        "the number 1000 of the equation may convert units, and the sheet states no result",
    ),
    (
        "c = 100*m/V\nSymbol;Estimate;Unit;u\nm;2,5;g;0,01\nV;50;mL;0,05\nc;50;%;0,2\n",
        "the equation `c = 100*m/V` does not pass the check of units (`c` has the unit `%`, a plain",
    ),
    (
        "Quantity,Estimate,Unit,Uncertainty,Distribution\nCal,0,V,0.0002,t (95 %)\n",
        "a t distribution needs its degrees of freedom",
    ),
    (
        "Quantity,Estimate,Unit,Standard uncertainty\nTemperature (°C),10.5,mm,0.1\n",
        "the row states two units",
    ),
    (
        "Quantity,Estimate,Unit,±,Distribution,Divisor\nm,1,V,0.1,rectangular,0.577\n",
        "the divisor 0.577 in column F `Divisor` is below 1",
    ),
    (
        "y = b*2^a\nQuantity;Estimate;Unit;Standard uncertainty\na;1;mV;0,1\nb;2;V;0,1\n",
        "the equation `y = b*2^a` does not pass the check of units (an exponent must be a plain num",
    ),
    (
        "Quantity;Estimate (V);Half-width (mV);Distribution\n;V;V;\na;1;2;rectangular\n",
        "the heading and the line below it say two units for column C `Half-width (mV)`",
    ),
    (
        "Quantity;Value;Uncertainty;Distribution\nA;10 ± 0.002 V;0.001 V;rectangular\n",
        "the row states its uncertainty 2 times: `0.001 V` and `0.002 V`",
    ),
    (
        "Quantity;Estimate;Unit;Standard uncertainty\na;1;V;0,1\nb;2;V;0,1\n\n\nc;3;V;0,1\n",
        "`c` stands below the table",
    ),
    (
        "P = M*n/9550\nSymbol;Value;Unit;u\nM;100;N m;0,5\nn;1500;1/min;1\nP;17,5;kW;0,08\n",
        "the sheet says that the estimate of the result is 17,5 kW, and this model 0.00026178 kW",
    ),
    (
        "2y = a*b\nQuantity;Estimate;Unit;Standard uncertainty\na;6.0;1;0.1\nb;2.0;1;0.1\n",
        "`2y = a*b` cannot be read as an equation, its left side is no name",
    ),
    (
        "Quantity,Value,Unit,U,k\nV,10000,mV,20,2\nI,2,A,0.01,2\n\nR = 1000*(V - V)/V + 3\n",
        "`I` is not in the equation `R = 1000*(V - V)/V + 3`",
    ),
    (
        "Quantity,Estimate,Unit,Standard uncertainty,c_i\na,293,K,0.9,1\nd,0,degF,0.9,1\n",
        "the coefficient 1 of `d` has no unit, and the quantity is in `degF`, the result in `K`",
    ),
    (
        "y = a : b\nQuantity;Estimate;Unit;Standard uncertainty\na;6.0;1;0.1\nb;2.0;1;0.1\n",
        "`y = a : b` cannot be read as an equation, `:` has no meaning in a formula; a choice is wr",
    ),
    (
        "Quantity;Estimate;Unit;Standard uncertainty\na;1;V;0,1\nb;2;V;0,1\nr(a, b) = 0,7;;;\n",
        "`r(a, b) = 0,7` speaks of correlation, which is not read",
    ),
    (
        "E = a - (b + c)/2\nQuantity,Unit,Standard uncertainty\na,V,0.01\nb,V,0.002\nc,V,0.003\n",
        "the equation `E = a - (b + c)/2` needs the estimate of `a`, and the row has none",
    ),
    (
        "Quantity,Estimate,Unit,Uncertainty,Distribution,Divisor\nres,10,V,0.1,rectangular,2\n",
        "`0.1` is rectangular, and its divisor is 2",
    ),
    (
        "Quantity,Estimate,Unit,Half-width,Distribution,Divisor\nres,10,V,0.1,triangular,4.9\n",
        "`0.1` is triangular, and its divisor is 4.9",
    ),
    (
        "Quantity,Estimate,Unit,Half-width,Distribution,Divisor\nres,10,V,0.1,rectangular,√12\n",
        "`0.1` is rectangular, and its divisor is 3.4641016151377544",
    ),
    (
        "P = V*V2/R\nQuantity,X,Unit,Standard uncertainty\nV,10.0,V,0.01\nV2,2.0,V,0.002\nR,1,V,0\n",
        "the number `10.0` stands in the place of the name of a quantity",
    ),
    (
        "Quantity;Estimate;Unit;Uncertainty;Distribution;Divisor\na;1;V;0.002;rectangular (peak);\n",
        "`rectangular (peak)` may say that the number of its row is no half-width",
    ),
    (
        "y = x - 0,5*z\nQuantity,Estimate,Uncertainty,Sensitivity coefficient\nx,10,0.1,1\nz,4,0.1,1\n",
        "`y = x - 0` may go on in the next cell: put an equation in quotation marks",
    ),
    (
        "Quantity;Estimate;Unit;Maximum permissible error;Distribution;Max\na;20;mm;0,3;rectangular;21\n",
        "a lower and an upper limit belong together, and one of them has no column",
    ),
    (
        "P = 2*pi*n*M/60\nQuantity,Estimate,Unit,Standard uncertainty\nn,3000,rpm,3\nM,10,N m,0.01\nP,100,W,\n",
        "the sheet says that the estimate of the result is 100 W, and this model 328.99 W",
    ),
    (
        "Quantity,Estimate,Unit,Lower limit,Upper limit,Distribution\nCal,10.000,V,-0.0005,0.0003,rectangular\n",
        "the estimate 10 is not in the middle of the limits `-0.0005` and `0.0003`",
    ),
    (
        "Quantity,Estimate,Unit,Lower limit,Upper limit,Distribution\nCal,9.9999,V,-0.0004,0.0004,rectangular\n",
        "the estimate 9.9999 is not in the middle of the limits `-0.0004` and `0.0004`",
    ),
    (
        "P = 2*pi*n*M/60\nQuantity,Estimate,Unit,Standard uncertainty\nn,3000,rpm,3\nM,10,N m,0.01\nP,3141.59,W,4.4\n",
        "the sheet says that the estimate of the result is 3141.59 W, and this model 328.99 W",
    ),
    (
        "Quantity,Value,Standard uncertainty,Sensitivity coefficient\nA,10 V,0.003 V,1\nB,5 V,0.004 V,1\nY,15 V,,1\n",
        "`Y` has the words of a result, and a coefficient",
    ),
    (
        "y = max(x,z)\nQuantity,Estimate,Unit,Uncertainty,Distribution,Divisor\nx,10,,0.1,normal,2\nz,4,,0.1,normal,2\n",
        "`y = max(x` cannot be read as an equation, the formula ends where an operator, `,` or `)`",
    ),
    (
        "Quantity,Estimate,Unit,Standard uncertainty,c_i,Unit of c_i\na,5,V,0.002,1,1\nb,2,mV,1,1,V/A\nResult,5.002,V,,,\n",
        "the coefficient of `b` is in `V/A`, and times `mV` it makes no `V`",
    ),
    (
        "Quantity,Estimate,Unit,Standard uncertainty,Sensitivity coefficient,Contribution\na,20,mm,0.006,1,6\nb,0,µm,3,1,3\n",
        "the sheet says that `a` contributes `6` mm, and this model 0.00600 mm",
    ),
    (
        "Quantity,Estimate,Unit,Standard uncertainty,c_i,Contribution\na,5,V,0.002,1,2 mV\nb,2,mV,1,1,1 mV\nResult,5.002,V,,,\n",
        "the sheet says that `b` contributes `1 mV`, and this model 1000 mV",
    ),
    (
        "Quantity;Value;Unit;Standard uncertainty;c;Contribution (µV)\nReference;10;V;25 µV;1;25\nLinearity;0;ppm;1,73;10;17,3\n",
        "the sheet says that `Reference` contributes `25` µV, and this model 0.0000250 µV",
    ),
    (
        "Quantity,Estimate,Unit,Standard uncertainty,Sensitivity coefficient,Contribution (µm)\na,20,mm,0.006,1,6\nb,0,µm,3,1,3\n",
        "the sheet says that `a` contributes `6` µm, and this model 0.00600 µm",
    ),
    (
        "Quantity,Estimate,Unit,Standard uncertainty,Sensitivity coefficient\na,5,V,0.3,1\nb,2,V,0.4,1\nc,0,V,1.2,1\nSumme,7,V,1.5,\n",
        "the sheet says that the standard uncertainty of the result is 1.5 V, and this model 1.30 V",
    ),
    (
        "Quantity,Estimate,Unit,Standard uncertainty,Distribution,c_i\na,5,V,0.003,normal,1\nb,2,V,0.004,normal,1\nU_x,7,V,0.005,,\n",
        "`U_x` has no sensitivity coefficient, and other rows have one",
    ),
    (
        "Quantity,Estimate,Unit,Standard uncertainty,Sensitivity coefficient\na,5,V,0.3,1\nb,2,V,0.4,1\nc,0,V,1.2,1\nU (k=2),,V,3.0,\n",
        "the sheet says that the expanded uncertainty of the result is 3.0 V, and this model 2.60 V",
    ),
    (
        "Größe,Schätzwert,Einheit,Relative Standardunsicherheit (%),Sensitivitätskoeffizient,Beitrag (%)\nP1,100,W,0.1,1,0.1\nP2,20,W,0.5,1,0.5\n",
        "the sheet says that `P2` contributes `0.5` %, and this model 0.0833 %",
    ),
    (
        "Quantity,Value,Unit,U (k=2),Distribution,Divisor\nCertificate,50,V,0.04,normal,1\nResolution,0,V,0.05,rectangular,1.732\nScatter,0,V,0.01,normal,1\n",
        "the heading says the factor 2, and the row 1",
    ),
    (
        "Quantity,Value,Unit,U (k=2),Distribution,Divisor\nCertificate,50,V,0.04,normal,2\nResolution,0,V,0.05,rectangular,1.732\nScatter,0,V,0.01,normal,1\n",
        "the heading `U (k=2)` says k = 2, and the row another divisor, 1.732",
    ),
    (
        "Quantity,Estimate,Unit,Uncertainty,Distribution,Divisor\na,1,V,0.1,normal,2\nQuantity,Estimate,Unit,Uncertainty,Distribution,Divisor\nb,1,V,0.1,normal,2\n",
        "line 3 begins a second budget",
    ),
    (
        "Beitrag;Unsicherheit (mV);Verteilung;Teiler;Standardunsicherheit (mV)\nPuffer;0,3;Rechteck;1,73;0,17\nTemperatur;0,5;Rechteck;1,73;0,29\nuc;;;;0,34\nU;;;;0,68\n",
        "no column is known as that of the names of the quantities",
    ),
    (
        "Quantity;Estimate;Unit;Standard uncertainty;Sensitivity coefficient;Degrees of freedom\nalpha;11,5e-6;/K;0,5e-6;2;∞ (B)\nbeta [K^-1];1e-6;m;1e-7;1;9 (A)\ngamma;2e-6;K-1;1e-7;1;50 (Type B)\n",
        "the row states two units",
    ),
    (
        "P = M*n/9550\nSymbol;Value;Unit;u\nM;100;N m;0,5\nn;1500;1/min;1\nP;15,707;kW;0,08\n",
        "the sheet says that the estimate of the result is 15,707 kW",
    ),
    (
        "Quantity;Estimate;Unit;u;Remark\na;0;V;0,1;\nb;0;V;0,1;correlated with a\n",
        "`correlated with a` speaks of correlation",
    ),
    (
        "Quantity;Estimate;Unit;Half-width;Distribution\nNoise (peak-to-peak);0;mV;0,6;rectangular\n",
        "may say that the number of its row is no half-width",
    ),
    (
        "Quantity,Unit,Estimate,Standard uncertainty\na,m,10,0,25\nb,m,2,0,5\n",
        "`25` stands below no heading",
    ),
    (
        "Quantity;Nominal;Value;Unit;U;k\na;100;100.0135;ohm;0.010;2\n",
        "two columns are headed as `estimate`",
    ),
    (
        "Quantity,Estimate,Unit,Uncertainty (% FS),Distribution\nA,10,V,5,normal (k=2)\n",
        "`% FS` in the heading",
    ),
    (
        "Quantity,Estimate,Unit,Uncertainty,Distribution\na,10,V,0.02,\"normal (k=2,95 %)\"\n",
        "can say k = 2 and `95 %`, or k = 2.95",
    ),
    (
        "Quantity;Estimate;Unit;u\nIndication;10.002;V;0.002\nReference;10.000;V;0.001\n",
        "there is neither an equation nor a column of sensitivity coefficients",
    ),
    (
        "Quantity;Estimate;Unit;u;c\nL_s;100.0002;mm;0.00005;1\ndT;0.5;°C;0.1;1.15\nL;100.000775;mm;;\n",
        "`L` has no uncertainty",
    ),
    (
        "Quantity;Estimate;Unit;±;Distribution;Divisor\nA;1;V;0,4;trapezoid;\n",
        "nothing says what kind of uncertainty `0,4` is",
    ),
    (
        "Quantity,Estimate,Standard uncertainty\na,20.00(6) V,0.03 V\nb,0 V,0.1 V\n",
        "the row states two standard uncertainties",
    ),
    (
        "Quantity,Estimate,Unit,Uncertainty,Unc. unit,Divisor\nRef,10.000,V,20,ppm,2\n",
        "column E `Unc. unit` is headed by no word that is known",
    ),
    (
        "Quantity,Estimate,Unit,Uncertainty,Uncertainty unit,Divisor\nRef,10,V,20,foo,2\n",
        "`foo`, the unit of the uncertainty, is not known",
    ),
    (
        "Quantity,Estimate,Unit,Uncertainty,Uncertainty unit,Divisor\nRef,10,V,5 nV,µV,2\n",
        "`5 nV` stands beside its unit `µV`",
    ),
    (
        "Quantity;Estimate;Unit;u\nA;10;V;0,02\nB;3;V;0,01\nA-B\n",
        "`A-B` may be the equation of the result",
    ),
    ("=a*b\nQuantity;Estimate;Unit;u\na;6.0;1;0.1\nb;2.0;1;0.1\n", "its left side is no name"),
    (
        "y = Σ x_i\nQuantity;Estimate;Unit;u\na;6.0;1;0.1\nb;2.0;1;0.1\n",
        "`y = Σ x_i` cannot be read as an equation",
    ),
    (
        "y = 1,5*x\nQuantity,Estimate,Uncertainty,Divisor\nx,10,0.1,2\nz,4,0.1,2\n",
        "may go on in the next cell",
    ),
    (
        "All values in mV\nQuantity;Estimate;Unit;u\nA;0;V;0,1\n",
        "states the unit of all values, and the row another one",
    ),
    (
        "All values in mVrms\nQuantity;Estimate;u\nA;0;0,1\n",
        "`mVrms` may be the unit of all values",
    ),
    (
        "Quantity,Unit,Estimate,Standard uncertainty,Distribution\na,m,0,0,25\nb,m,0,0,5\n",
        "the number `25` stands in the column of the distribution",
    ),
    (
        "Quantity,Estimate,Unit,Standard uncertainty (µV/V)\na,1.00002,1,3\n",
        "can be a share of the value",
    ),
    (
        "Quantity;Estimate;Unit;±;Distribution;Divisor\nA;0;V;0,4;normal (2 s);1\n",
        "what `normal (2 s)` says besides the distribution",
    ),
    (
        "Quantity;Estimate;Unit;Standard uncertainty;Distribution\nRef;0;V;0,004;t\n",
        "a t distribution needs its degrees of freedom",
    ),
    (
        "Quantity,Estimate,Unit,Lower limit,Upper limit,Distribution\nCal,20,V,19,20.5,triangular\n",
        "is not in the middle of the limits",
    ),
    (
        "Source,Value,Unit,Uncertainty,Distribution\nStandard (k=2),0,V,0.10,Rectangular\n",
        "`0.10` is rectangular, and its divisor is 2",
    ),
    (
        "Quantity,Estimate,Unit,\"U (k=2.13, dof=9)\"\na,0,V,0.02\n",
        "states degrees of freedom in its heading",
    ),
];

#[test]
fn odd_budgets_are_refused() {
    let mut wrong = Vec::new();
    for (sheet, part) in REFUSED {
        let Err(refused) = import(sheet, &[]) else { panic!("{sheet} is read") };
        let text = refused.to_string();
        if !text.contains(part) {
            wrong.push(format!("{sheet}\n{part}\n{text}"));
        }
        for Question { about, option, .. } in &refused.questions {
            assert!(!about.is_empty() && option.contains(['`', '-']), "{sheet}: {about} {option}");
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

/// What is odd and has one reading: estimate and standard uncertainty of the result, by hand.
#[test]
fn odd_budgets_with_one_reading() {
    let root = f64::sqrt;
    let read: [(&str, &[&str], [f64; 2]); 16] = [
        // the last column has the numbers of the result
        (
            "Component,u (mV),Remark\nA,0.1,\nB,0.2,\n,0.22,root sum of squares\n",
            &[],
            [0.0, root(0.05)],
        ),
        ("Quantity,Estimate,Unit,±\na,0,V,0.3 V (k=2)\nb,0,mV,400 mV (k=2)\n", &[], [0.0, 0.25]),
        (
            "Quantity,Estimate,Unit,Full width,Distribution\na,0,V,0.6,rectangular\n",
            &[],
            [0.0, 0.3 / root(3.0)],
        ),
        (
            "Quantity,Estimate,Unit,Uncertainty,Distribution,Divisor\na,0,V,0.6,rectangular,2√3\n",
            &[],
            [0.0, 0.3 / root(3.0)],
        ),
        (
            "Quantity,Estimate,Unit,Uncertainty,Distribution,Factor\na,0,V,0.6,normal,0.5\n",
            &["column multiplier=F"],
            [0.0, 0.3],
        ),
        (
            "Quantity;Estimate;Unit;Uncertainty;Distribution;Divisor\nNoise (peak-to-peak);0;mV;0,6;rectangular;\n",
            &["column full-width=D"],
            [0.0, 0.3 / root(3.0)],
        ),
        (
            "Source,Value (mg),Distribution,Divisor,ui (mg)\na,0.30,normal,2,0.15\nb,0.10,rectangular,√3,0.058\n",
            &["column uncertainty=B"],
            [0.0, root(0.0225 + 0.01 / 3.0)],
        ),
        (
            "P = M*n/9550\nSymbol;Value;Unit;u\nM;100;N m;0,5\nn;1500;1/min;0\nP;15,707;kW;0,079\n",
            &["numbers"],
            [150_000.0 / 9550.0, 750.0 / 9550.0],
        ),
        (
            "Quantity,Estimate,Unit,u,c\nA,10,V,0.3,1\nB,5,V,0.4,-1\nE,5,V,0.5,\n",
            &["row result=4"],
            [5.0, 0.5],
        ),
        // a product: linear about the estimates, with the estimate of the sheet
        (
            "Quantity,Estimate,Unit,u,c,Unit of c\nV,10,V,0.01,100,ohm/V\nI,0.1,A,0.0001,-1000,ohm/A\nR,100,ohm,,,\n",
            &["row result=4"],
            [100.0, root(1.0 + 0.01)],
        ),
        (
            "Quantity,Estimate,Unit,u,c,Contribution\na,5,V,0.002,1,2 mV\nb,2,mV,1,1,1 mV\nResult,5.002,V,,,\n",
            &["coefficients ratios"],
            [5.002, root(5e-6)],
        ),
        (
            "Quantity;Estimate;Unit;Standard deviation\na;0;V;0,3\nb;0;V;0,4\n",
            &["column u=D"],
            [0.0, 0.5],
        ),
        ("Budget (all values in mV)\n\nQuantity;Estimate;u\na;0;0,3\nb;0;0,4\n", &[], [0.0, 0.5]),
        (
            "Größe;Schätzwert;Unsicherheit;Verteilung;Divisor\nX_i;x_i / V;in mV;;\na;0;0,4;normal;2\n",
            &[],
            [0.0, 2e-4],
        ),
        ("Quantity,Estimate,Unit,U (95 %),dof\na,0,V,2.262157162740992,9\n", &[], [0.0, 1.0]),
        (
            "c = a/2\ny = c - b\nQuantity;Estimate;Unit;u\na;50;mm;0,6\nb;1;mm;0,4\ny;24;mm;0,5\n",
            &[],
            [24.0, 0.5],
        ),
    ];
    for (sheet, said, [estimate, u]) in read {
        let budget = import(sheet, said).unwrap_or_else(|error| panic!("{sheet}\n{error}"));
        let found = result(&budget);
        assert!((found.0 - estimate).abs() < 1e-9 * estimate.abs().max(1.0), "{sheet}\n{found:?}");
        assert!(is_same(found.1, u), "{sheet}\n{found:?}, not {u}\n{}", budget.text);
    }
}

/// Sheets without end are read in the end, and no sheet stops the program.
#[test]
fn hostile_sheets_are_refused() {
    let chain: String = (1..1000).map(|n| format!("z{n} = z{} + a\n", n - 1)).collect();
    let head = "Quantity;Estimate;Unit;Standard uncertainty\n";
    let many = format!("{head}a;20;V;2\n").repeat(2000);
    let long = format!("{head}a;{};V;2\n", "x".repeat(10_000));
    for text in
        [format!("z0 = a\n{chain}{head}a;1;V;1\n"), many, long, "\"".to_owned(), head.repeat(2)]
    {
        let error = import(&text, &[]).unwrap_err().to_string();
        assert!(!error.is_empty() && error.len() < 5_000, "{}", error.len());
    }
    let error = import_budget_bytes(Path::new("b.ods"), b"PK".to_vec(), &ImportOptions::default());
    let error = error.unwrap_err().to_string();
    assert!(error.contains("a workbook of the format .ods, which cannot be read"), "{error}");
}
