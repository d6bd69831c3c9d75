//! What every typed measurement has, and the macro that writes it.

use crate::model::{
    InputQuantity, Model, NumberForm, Output, Quantity, Recorder, Traced, formula::Typing, in_unit,
    recorded_values, variables,
};
use crate::number::Number;
use gumption_units::{Unit, UnitError};

/// The function of a measurement, written once for every kind of number.
pub trait Equations<T: Number> {
    /// The struct of the output quantities.
    type Outputs;

    /// Computes the outputs. Quantities are in coherent SI units, angles in radians.
    ///
    /// Two kinds of quantities count from a zero of their own and arrive as numbers of it: one
    /// declared in `degC` or `degF` is a Celsius temperature, the number of degrees Celsius (20 for
    /// 20 degC and for 68 degF; add 273.15 for the thermodynamic temperature), and one declared in
    /// `dB` or `dBm` is the number of decibels. Outputs are given back in the same way. Such a
    /// quantity is asked for and given in units with a zero of that kind alone: a value in `K` for a
    /// declared `degC` is refused, and the other way round, because a quantity in `K` may be a
    /// difference.
    fn equations(self) -> Self::Outputs;
}

/// A declared input quantity.
#[derive(Clone, Copy, Debug)]
pub struct DeclaredInput {
    /// Name.
    pub name: &'static str,
    /// Unit in which the value is given unless the file says otherwise.
    pub unit: &'static str,
    /// Value in that unit where the input is left out; without it the input is required.
    pub default: Option<f64>,
    /// What it is.
    pub about: &'static str,
}

/// A declared output quantity.
#[derive(Clone, Copy, Debug)]
pub struct DeclaredOutput {
    /// Name.
    pub name: &'static str,
    /// Unit in which the value is reported unless the file says otherwise.
    pub unit: &'static str,
    /// The equation, as text for people.
    pub equation: &'static str,
    /// Length of a turn in `unit`, for phases.
    pub period: Option<f64>,
    /// What it is.
    pub about: &'static str,
}

/// What a measurement says of itself.
#[derive(Clone, Copy, Debug)]
pub struct Declaration {
    /// The name that files use.
    pub name: &'static str,
    /// What is measured.
    pub about: &'static str,
    /// Document and equations.
    pub source: &'static str,
    /// Input quantities in order.
    pub inputs: &'static [DeclaredInput],
    /// Output quantities in order.
    pub outputs: &'static [DeclaredOutput],
}

/// A struct of input quantities with a declaration; [`crate::measurement!`] implements it.
pub trait Measurement: Sized {
    /// What the fields hold: numbers, or what is known about each quantity.
    type Value;

    /// Names, units, texts.
    const DECLARATION: Declaration;

    /// The fields in the order of the declaration.
    fn into_values(self) -> Vec<Self::Value>;

    /// The outputs from the inputs, both in the order of the declaration and in SI units.
    /// Without as many inputs as declared there are no outputs.
    fn compute<T: Number>(inputs: &[T]) -> Vec<T>;
}

/// A measurement whose type is chosen at run time, by name.
#[derive(Clone, Copy, Debug)]
pub struct Typed {
    /// Names, units, texts.
    pub declaration: Declaration,
    record: for<'r> fn(&[Traced<'r>]) -> Vec<Traced<'r>>,
}

fn record<'r, M: Measurement>(inputs: &[Traced<'r>]) -> Vec<Traced<'r>> {
    M::compute(inputs)
}

impl Typed {
    /// The run-time form of a measurement.
    pub fn of<M: Measurement>() -> Self {
        Self { declaration: M::DECLARATION, record: record::<M> }
    }

    /// The declared input of that name, with its index.
    pub fn input(&self, name: &str) -> Option<(usize, &'static DeclaredInput)> {
        self.declaration.inputs.iter().enumerate().find(|(_, input)| input.name == name)
    }

    /// The declared output of that name, with its index.
    pub fn output(&self, name: &str) -> Option<(usize, &'static DeclaredOutput)> {
        self.declaration.outputs.iter().enumerate().find(|(_, output)| output.name == name)
    }

    /// The model with all declared inputs and outputs in their declared units.
    ///
    /// # Errors
    /// A declared unit that does not parse.
    pub fn model(&self) -> Result<Model, UnitError> {
        let inputs = self.declaration.inputs.iter().map(|input| {
            let quantity = Quantity {
                name: input.name.to_owned(),
                unit: Unit::parse(input.unit)?,
                about: input.about.to_owned(),
            };
            Ok(InputQuantity { quantity, parts: 1 })
        });
        let inputs = inputs.collect::<Result<Vec<_>, UnitError>>()?;
        Ok(self.model_with(inputs, Vec::new(), self.outputs()?))
    }

    /// The declared outputs in their declared units.
    ///
    /// # Errors
    /// A declared unit that does not parse.
    pub fn outputs(&self) -> Result<Vec<Output>, UnitError> {
        let one = |declared: &DeclaredOutput| {
            let quantity = Quantity {
                name: declared.name.to_owned(),
                unit: Unit::parse(declared.unit)?,
                about: declared.about.to_owned(),
            };
            Ok(Output { period: declared.period, ..Output::new(quantity) })
        };
        self.declaration.outputs.iter().map(one).collect()
    }

    /// The declared outputs in SI units from the values of the inputs in SI units. A declared input
    /// without a value takes its default; without a default, or if its declared unit cannot be read,
    /// it is not a number.
    pub fn record_with<'r>(&self, value: impl Fn(&str) -> Option<Traced<'r>>) -> Vec<Traced<'r>> {
        let values: Vec<Traced<'r>> = self
            .declaration
            .inputs
            .iter()
            .map(|declared| {
                value(declared.name).unwrap_or_else(|| {
                    let unit = Unit::parse(declared.unit).ok();
                    let default = declared.default.zip(unit);
                    let default = default.map(|(value, u)| value * u.factor() + u.offset());
                    Traced::constant(default.unwrap_or(f64::NAN))
                })
            })
            .collect();
        (self.record)(&values)
    }

    /// The model whose variables are the parts of `inputs`, then `conditions`, and whose results are
    /// `outputs`, each in its own unit. A declared input that is in neither list is as in
    /// [`Typed::record_with`]; an output that is not declared is not a number.
    pub fn model_with(
        &self,
        inputs: Vec<InputQuantity>,
        conditions: Vec<Quantity>,
        outputs: Vec<Output>,
    ) -> Model {
        let recorder = Recorder::default();
        let given = recorded_values(&recorder, &inputs, &conditions, NumberForm::Coherent);
        let results = self.record_with(|name| {
            given.iter().find(|(known, _)| known == name).map(|(_, value)| *value)
        });
        let results: Vec<Traced<'_>> = outputs
            .iter()
            .map(|output| {
                let index = self.output(&output.quantity.name).map(|(index, _)| index);
                let result = index.and_then(|index| results.get(index)).copied();
                let result = result.unwrap_or_else(|| Traced::constant(f64::NAN));
                in_unit(result, &output.quantity.unit, Typing::in_unit(&output.quantity.unit))
            })
            .collect();
        let program = recorder.program(variables(&inputs, &conditions), &results);
        Model { inputs, conditions, outputs, program }
    }
}

/// Declares a measurement: a struct of input quantities and a struct of output quantities, both
/// generic over the number, with names, units and texts. The function is written beside it, as an
/// implementation of [`Equations`](crate::model::typed::Equations).
///
/// An input followed by `or VALUE` may be left out of a file and then has that value (in its
/// unit). An output followed by `periodic LENGTH` is a phase.
#[macro_export]
macro_rules! measurement {
    (
        $(#[doc = $about:literal])*
        pub $name:ident as $label:literal from $source:literal;
        inputs {
            $(
                $(#[doc = $input_about:literal])*
                $input:ident: $input_unit:literal $(or $default:expr)?
            ),* $(,)?
        }
        outputs $outputs:ident {
            $(
                $(#[doc = $output_about:literal])*
                $output:ident: $output_unit:literal = $equation:literal $(periodic $period:literal)?
            ),* $(,)?
        }
    ) => {
        $(#[doc = $about])*
        #[doc = ""]
        #[doc = concat!("Source: ", $source, ". In files: `\"model\": \"", $label, "\"`.")]
        #[derive(Clone, Copy, Debug)]
        pub struct $name<T> {
            $(
                $(#[doc = $input_about])*
                #[doc = concat!(" Unit: ", $input_unit, ".")]
                pub $input: T,
            )*
        }

        #[doc = concat!("Outputs of [`", stringify!($name), "`].")]
        #[derive(Clone, Copy, Debug)]
        pub struct $outputs<T> {
            $(
                $(#[doc = $output_about])*
                #[doc = concat!(" Unit: ", $output_unit, ". ", $equation, ".")]
                pub $output: T,
            )*
        }

        impl<X> $crate::model::typed::Measurement for $name<X> {
            type Value = X;

            const DECLARATION: $crate::model::typed::Declaration =
                $crate::model::typed::Declaration {
                    name: $label,
                    about: concat!($($about, "\n"),*),
                    source: $source,
                    inputs: &[$($crate::model::typed::DeclaredInput {
                        name: stringify!($input),
                        unit: $input_unit,
                        default: $crate::measurement!(@option $($default)?),
                        about: concat!($($input_about, "\n"),*),
                    }),*],
                    outputs: &[$($crate::model::typed::DeclaredOutput {
                        name: stringify!($output),
                        unit: $output_unit,
                        equation: $equation,
                        period: $crate::measurement!(@option $($period)?),
                        about: concat!($($output_about, "\n"),*),
                    }),*],
                };

            fn into_values(self) -> Vec<X> {
                vec![$(self.$input),*]
            }

            fn compute<T: $crate::number::Number>(inputs: &[T]) -> Vec<T> {
                let [$($input),*] = *inputs else {
                    return Vec::new();
                };
                let outputs: $outputs<T> =
                    $crate::model::typed::Equations::equations($name { $($input),* });
                vec![$(outputs.$output),*]
            }
        }
    };
    (@option) => { None };
    (@option $value:expr) => { Some($value) };
}
