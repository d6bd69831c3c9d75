//! Measured fundamental constants as inputs: the values of CODATA 2022 (Mohr, Newell, Taylor, Tiesinga,
//! Rev. Mod. Phys. 97 (2025) 025002; <https://physics.nist.gov/constants>, web version 9.0) with the
//! correlations of the adjustment.
//!
//! Each constant is a product of powers of a few adjusted constants and of constants that are exact in
//! the SI, as m_e = 2 h R_inf/(c alpha^2). The powers are relative sensitivity coefficients, so that u and
//! all correlation coefficients follow from those of the adjusted constants by the law of propagation
//! (JCGM 100, 5.2.2), and no pair of constants can contradict another.

use gumption_engine::distribution::{Distribution, Invalid, Normal};
use gumption_text::DiagnosticKind;
use gumption_text::object::Object;
use gumption_units::{Unit, nearest};

/// The adjusted constants that the others are made from.
const ADJUSTED: usize = 13;

/// Fine-structure constant.
const ALPHA: usize = 0;
/// Rydberg constant.
const RYDBERG: usize = 1;
/// Relative atomic masses: of the electron, proton, neutron, deuteron, helion and alpha particle.
const ELECTRON: usize = 2;
const PROTON: usize = 3;
const NEUTRON: usize = 4;
const DEUTERON: usize = 5;
const HELION: usize = 6;
const ALPHA_PARTICLE: usize = 7;
/// Muon-electron mass ratio.
const MUON: usize = 8;
/// Newtonian constant of gravitation.
const GRAVITATION: usize = 9;
/// Magnetic moment of the proton, free and shielded, to the nuclear magneton.
const PROTON_MOMENT: usize = 10;
const SHIELDED_MOMENT: usize = 11;
/// Lattice spacing {220} of silicon.
const LATTICE: usize = 12;

/// Relative standard uncertainties of the adjusted constants. NIST publishes two digits; the further ones
/// are those with which every constant here has its published uncertainty, and every pair its published
/// correlation coefficient to 1e-5 (the tests compare all of them).
const RELATIVE: [f64; ADJUSTED] = [
    1.55689e-10, // alpha
    1.08970e-12, // rydberg
    1.76463e-11, // electron
    8.24918e-12, // proton
    4.00305e-10, // neutron
    7.40303e-12, // deuteron
    2.45093e-11, // helion
    1.55484e-11, // alpha particle
    2.22107e-08, // muon
    2.24743e-05, // gravitation
    2.94373e-10, // proton moment
    4.08146e-09, // shielded moment
    1.64291e-08, // lattice
];

/// The correlation coefficients of adjusted constants as NIST lists them; all others are below 1e-5.
const COEFFICIENTS: [(usize, usize, f64); 46] = [
    (ALPHA, RYDBERG, 0.00125),
    (ALPHA, ELECTRON, -0.03972),
    (RYDBERG, ELECTRON, -0.03754),
    (ALPHA, PROTON, -0.01095),
    (RYDBERG, PROTON, 0.00651),
    (ELECTRON, PROTON, 0.2744),
    (ALPHA, NEUTRON, 0.00168),
    (RYDBERG, NEUTRON, 0.0001),
    (ELECTRON, NEUTRON, 0.00397),
    (PROTON, NEUTRON, 0.01122),
    (ALPHA, DEUTERON, -0.01036),
    (RYDBERG, DEUTERON, 0.00645),
    (ELECTRON, DEUTERON, 0.25967),
    (PROTON, DEUTERON, 0.86097),
    (NEUTRON, DEUTERON, 0.01921),
    (ALPHA, HELION, -0.00332),
    (RYDBERG, HELION, 0.00203),
    (ELECTRON, HELION, 0.08307),
    (PROTON, HELION, 0.28555),
    (NEUTRON, HELION, 0.00513),
    (DEUTERON, HELION, 0.29794),
    (ALPHA, ALPHA_PARTICLE, 1e-05),
    (RYDBERG, ALPHA_PARTICLE, 1e-05),
    (ELECTRON, ALPHA_PARTICLE, -0.00031),
    (PROTON, ALPHA_PARTICLE, -8e-05),
    (DEUTERON, ALPHA_PARTICLE, -7e-05),
    (HELION, ALPHA_PARTICLE, -2e-05),
    (ALPHA, MUON, 0.01388),
    (RYDBERG, MUON, 7e-05),
    (ELECTRON, MUON, -0.00056),
    (PROTON, MUON, -0.00015),
    (NEUTRON, MUON, 2e-05),
    (DEUTERON, MUON, -0.00014),
    (HELION, MUON, -5e-05),
    (ELECTRON, PROTON_MOMENT, -8e-05),
    (PROTON, PROTON_MOMENT, 2e-05),
    (DEUTERON, PROTON_MOMENT, 1e-05),
    (MUON, PROTON_MOMENT, -0.00018),
    (ALPHA, SHIELDED_MOMENT, 3e-05),
    (RYDBERG, SHIELDED_MOMENT, 2e-05),
    (ELECTRON, SHIELDED_MOMENT, -0.00053),
    (PROTON, SHIELDED_MOMENT, 0.00012),
    (DEUTERON, SHIELDED_MOMENT, 9e-05),
    (HELION, SHIELDED_MOMENT, 3e-05),
    (MUON, SHIELDED_MOMENT, 0.00022),
    (NEUTRON, LATTICE, -0.0974),
];

/// A measured constant.
#[derive(Debug)]
pub struct MeasuredConstant {
    /// The name that NIST lists it with.
    pub name: &'static str,
    /// A short name in letters, which files may use as well.
    pub symbol: &'static str,
    /// The recommended value.
    pub value: f64,
    /// The unit of the value.
    pub unit: &'static str,
    /// The powers of adjusted constants that it is a product of.
    powers: &'static [(usize, i8)],
}

const fn constant(
    name: &'static str,
    symbol: &'static str,
    value: f64,
    unit: &'static str,
    powers: &'static [(usize, i8)],
) -> MeasuredConstant {
    MeasuredConstant { name, symbol, value, unit, powers }
}

/// The constants that inputs may be.
#[rustfmt::skip]
pub static MEASURED: [MeasuredConstant; 25] = [
    constant("fine-structure constant", "alpha", 7.2973525643e-3, "1", &[(ALPHA, 1)]),
    constant("Rydberg constant", "R_inf", 1.0973731568157e7, "1/m", &[(RYDBERG, 1)]),
    constant("electron mass", "m_e", 9.1093837139e-31, "kg", &[(ALPHA, -2), (RYDBERG, 1)]),
    constant("proton mass", "m_p", 1.67262192595e-27, "kg", &[(ALPHA, -2), (RYDBERG, 1), (ELECTRON, -1), (PROTON, 1)]),
    constant("neutron mass", "m_n", 1.67492750056e-27, "kg", &[(ALPHA, -2), (RYDBERG, 1), (ELECTRON, -1), (NEUTRON, 1)]),
    constant("muon mass", "m_mu", 1.883531627e-28, "kg", &[(ALPHA, -2), (RYDBERG, 1), (MUON, 1)]),
    constant("deuteron mass", "m_d", 3.3435837768e-27, "kg", &[(ALPHA, -2), (RYDBERG, 1), (ELECTRON, -1), (DEUTERON, 1)]),
    constant("helion mass", "m_h", 5.0064127862e-27, "kg", &[(ALPHA, -2), (RYDBERG, 1), (ELECTRON, -1), (HELION, 1)]),
    constant("alpha particle mass", "m_alpha", 6.6446573450e-27, "kg", &[(ALPHA, -2), (RYDBERG, 1), (ELECTRON, -1), (ALPHA_PARTICLE, 1)]),
    constant("atomic mass constant", "m_u", 1.66053906892e-27, "kg", &[(ALPHA, -2), (RYDBERG, 1), (ELECTRON, -1)]),
    constant("molar mass constant", "M_u", 1.00000000105e-3, "kg/mol", &[(ALPHA, -2), (RYDBERG, 1), (ELECTRON, -1)]),
    constant("vacuum magnetic permeability", "mu_0", 1.25663706127e-6, "N/A^2", &[(ALPHA, 1)]),
    constant("vacuum electric permittivity", "epsilon_0", 8.8541878188e-12, "F/m", &[(ALPHA, -1)]),
    constant("characteristic impedance of vacuum", "Z_0", 3.76730313412e2, "ohm", &[(ALPHA, 1)]),
    constant("Bohr radius", "a_0", 5.29177210544e-11, "m", &[(ALPHA, 1), (RYDBERG, -1)]),
    constant("classical electron radius", "r_e", 2.8179403205e-15, "m", &[(ALPHA, 3), (RYDBERG, -1)]),
    constant("Compton wavelength", "lambda_C", 2.42631023538e-12, "m", &[(ALPHA, 2), (RYDBERG, -1)]),
    constant("Thomson cross section", "sigma_e", 6.6524587051e-29, "m^2", &[(ALPHA, 6), (RYDBERG, -2)]),
    constant("Bohr magneton", "mu_B", 9.2740100657e-24, "J/T", &[(ALPHA, 2), (RYDBERG, -1)]),
    constant("nuclear magneton", "mu_N", 5.0507837393e-27, "J/T", &[(ALPHA, 2), (RYDBERG, -1), (ELECTRON, 1), (PROTON, -1)]),
    constant("Hartree energy", "E_h", 4.3597447222060e-18, "J", &[(RYDBERG, 1)]),
    constant("Newtonian constant of gravitation", "G", 6.67430e-11, "m^3/(kg s^2)", &[(GRAVITATION, 1)]),
    constant("proton gyromagnetic ratio", "gamma_p", 2.6752218708e8, "1/(s T)", &[(ALPHA, 2), (RYDBERG, -1), (ELECTRON, 1), (PROTON, -1), (PROTON_MOMENT, 1)]),
    constant("shielded proton gyromagnetic ratio", "gamma_p_shielded", 2.675153194e8, "1/(s T)", &[(ALPHA, 2), (RYDBERG, -1), (ELECTRON, 1), (PROTON, -1), (SHIELDED_MOMENT, 1)]),
    constant("lattice spacing of ideal Si (220)", "d_220", 1.920155716e-10, "m", &[(LATTICE, 1)]),
];

impl MeasuredConstant {
    /// The constant with that name or symbol.
    pub(super) fn named(name: &str) -> Option<&'static Self> {
        MEASURED.iter().find(|constant| constant.name == name || constant.symbol == name)
    }

    /// The relative standard uncertainty.
    pub fn relative_uncertainty(&self) -> f64 {
        self.covariance(self).sqrt()
    }

    /// The correlation coefficient with another constant.
    pub(super) fn correlation(&self, other: &Self) -> f64 {
        let spread = self.relative_uncertainty() * other.relative_uncertainty();
        (self.covariance(other) / spread).clamp(-1.0, 1.0)
    }

    /// The relative covariance with another constant.
    fn covariance(&self, other: &Self) -> f64 {
        let terms = self.powers.iter().flat_map(|&(first, of_first)| {
            other.powers.iter().map(move |&(second, of_second)| {
                let powers = f64::from(of_first) * f64::from(of_second);
                powers * RELATIVE[first] * RELATIVE[second] * coefficient(first, second)
            })
        });
        terms.sum()
    }

    /// The constant that an input with `"distribution": "codata"` names; anything else is reported.
    pub(super) fn read(object: &Object<'_>) -> Option<&'static Self> {
        let member = object.required("constant")?;
        let name = object.text("constant")?;
        let found = Self::named(name);
        if found.is_none() {
            let known = MEASURED.iter().flat_map(|constant| [constant.name, constant.symbol]);
            let near = nearest(name, known.clone()).map(str::to_owned);
            let diagnostic = DiagnosticKind::NotOneOf {
                key: "constant".into(),
                found: name.to_owned(),
                allowed: near.map_or_else(|| known.map(str::to_owned).collect(), |near| vec![near]),
            };
            object.log.report(&member.value.span, diagnostic);
        }
        found
    }

    /// Its own unit.
    pub(super) fn own_unit(&self) -> Unit {
        Unit::parse(self.unit).unwrap_or_else(|_| Unit::one())
    }

    /// The normal distribution about the value in a unit; a unit of another dimension is reported.
    pub(super) fn distribution(
        &self,
        object: &Object<'_>,
        name: &str,
        unit: &Unit,
    ) -> Option<Result<Distribution, Invalid>> {
        let own = self.own_unit();
        let Ok(value) = Unit::convert(self.value, &own, unit) else {
            let diagnostic = DiagnosticKind::WrongDimension {
                name: name.to_owned(),
                found: unit.to_string(),
                found_as: unit.describe(),
                expected: own.to_string(),
                expected_as: own.describe(),
            };
            let place = object.get("unit").map_or(object.place(), |member| &member.value.span);
            object.log.report(place, diagnostic);
            return None;
        };
        Some(Normal::new(value, self.relative_uncertainty() * value.abs()).map(Into::into))
    }
}

/// The correlation coefficient of two adjusted constants.
fn coefficient(first: usize, second: usize) -> f64 {
    if first == second {
        return 1.0;
    }
    let pair = (first.min(second), first.max(second));
    COEFFICIENTS.iter().find(|(a, b, _)| (*a, *b) == pair).map_or(0.0, |(.., r)| *r)
}

#[cfg(test)]
mod tests;
