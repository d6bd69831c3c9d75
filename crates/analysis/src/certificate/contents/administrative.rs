//! Parties and device of a certificate: texts that are stated as given.

use super::Localized;

/// The content of a certificate besides its results. Everything is optional unless a format
/// requires it.
#[derive(Clone, Debug, Default)]
pub struct AdministrativeData {
    /// The title; `None` for the standard title of the language.
    pub title: Option<Localized>,
    /// The number of the certificate.
    pub number: Option<String>,
    /// The device that was calibrated.
    pub device: Option<Device>,
    /// The customer.
    pub customer: Option<Party>,
    /// The laboratory.
    pub laboratory: Option<Party>,
    /// Who is responsible.
    pub responsible: Option<String>,
    /// First and last day of the calibration, as ISO 8601 writes them: 2026-03-02.
    pub calibrated: Option<[String; 2]>,
    /// Day on which the device was received.
    pub received: Option<String>,
    /// Day of issue.
    pub issued: Option<String>,
    /// Where the calibration was made.
    pub place: PerformanceLocation,
    /// The environment: temperature, humidity.
    pub environment: Option<Localized>,
    /// The method of calibration.
    pub method: Option<Localized>,
    /// How the results are traceable to the SI.
    pub traceability: Option<Localized>,
    /// Further remarks.
    pub remarks: Vec<Localized>,
}

/// What stands for the name of the file of readings, without its ending, in the numbers of a
/// certificate and of its device.
pub const NAME_OF_READINGS: &str = "{readings}";

impl AdministrativeData {
    /// The key of a number that names the file of readings, if none was put in its place.
    pub fn without_readings(&self) -> Option<&'static str> {
        let device = self.device.as_ref();
        let numbers = [
            ("number", self.number.as_ref()),
            ("device.serial_number", device.and_then(|device| device.serial_number.as_ref())),
            ("device.customer_number", device.and_then(|device| device.customer_number.as_ref())),
        ];
        let names = |text: &&String| text.contains(NAME_OF_READINGS);
        numbers.into_iter().find_map(|(key, text)| text.filter(names).map(|_| key))
    }
}

/// A device.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Device {
    /// What it is.
    pub name: Localized,
    /// Who made it.
    pub manufacturer: Option<String>,
    /// Its model or type.
    pub model: Option<String>,
    /// Its condition when it was received.
    pub condition: Option<Localized>,
    /// Its serial number.
    pub serial_number: Option<String>,
    /// The customer's number for it.
    pub customer_number: Option<String>,
}

/// A laboratory or a customer.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Party {
    /// Its name.
    pub name: String,
    /// Its accreditation or laboratory code.
    pub code: Option<String>,
    /// Street.
    pub street: Option<String>,
    /// Number in the street.
    pub street_number: Option<String>,
    /// Post code.
    pub post_code: Option<String>,
    /// City.
    pub city: Option<String>,
    /// Country: two capital letters of ISO 3166-1.
    pub country: Option<String>,
    /// Electronic mail.
    pub email: Option<String>,
    /// Telephone.
    pub phone: Option<String>,
}

impl Party {
    /// The address on one line; empty if there is none.
    pub fn address(&self) -> String {
        self.address_lines().join(", ")
    }

    /// The address line by line: the street, then city and country.
    pub fn address_lines(&self) -> Vec<String> {
        let joined = |words: [&Option<String>; 2], between: &str| {
            let words: Vec<&str> = words.into_iter().flatten().map(String::as_str).collect();
            words.join(between)
        };
        let street = joined([&self.street, &self.street_number], " ");
        let city = joined([&self.post_code, &self.city], " ");
        let city = joined([&Some(city).filter(|city| !city.is_empty()), &self.country], ", ");
        [street, city].into_iter().filter(|line| !line.is_empty()).collect()
    }
}

/// Where a calibration was made.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum PerformanceLocation {
    /// In the laboratory.
    #[default]
    Laboratory,
    /// At the customer's.
    Customer,
    /// In a branch of the laboratory.
    LaboratoryBranch,
    /// In a branch of the customer's.
    CustomerBranch,
    /// Elsewhere.
    Other,
}

impl PerformanceLocation {
    /// All of them.
    pub const ALL: [Self; 5] = [
        Self::Laboratory,
        Self::Customer,
        Self::LaboratoryBranch,
        Self::CustomerBranch,
        Self::Other,
    ];

    /// The name in files and digital certificates.
    pub fn name(self) -> &'static str {
        match self {
            Self::Laboratory => "laboratory",
            Self::Customer => "customer",
            Self::LaboratoryBranch => "laboratoryBranch",
            Self::CustomerBranch => "customerBranch",
            Self::Other => "other",
        }
    }

    /// The place of that name.
    pub fn named(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|place| place.name() == name)
    }
}
