//! What exports cannot read off a map: their options by name, as a client writes them.

use super::list::Export;
use super::location_sheet::InventoryOptions;
use super::locations_csv::Profile;
use super::nav2_masks::{KeepoutOptions, SpeedOptions};
use super::vda5050_header::Recipient;
use super::vda5050_zone_rules::ZoneRules;
use crate::coordinates::Crs;

/// Greatest radius of a vehicle, metres: no aisle of a warehouse is as wide.
const WIDEST_RADIUS_M: f64 = 10.0;
/// Most characters of a text.
const LONGEST: usize = 64;
/// Most characters of an address, and of rules for zones.
const LONGEST_LINK: usize = 2_000;

/// An option.
#[derive(Debug, Clone, Copy)]
pub struct ExportOption {
    /// Its name.
    pub name: &'static str,
    /// What it says, and what holds without it.
    pub description: &'static str,
    /// A value that it may have.
    pub example: &'static str,
    set: fn(&mut ExportOptions, &str) -> Result<(), String>,
}

const OPTIONS: &[ExportOption] = &[
    ExportOption {
        name: "footprintRadiusM",
        description: "Distance that the middle of the vehicle keeps from obstacles, metres, 0 to 10; half the vehicle width \
                      of the analysis when absent",
        example: "0.35",
        set: |options, text| {
            options.footprint_radius = Some(number(text, 0.0, WIDEST_RADIUS_M)?);
            Ok(())
        },
    },
    ExportOption {
        name: "zones",
        description: "Zones of labels as `LABEL:RULE` with commas between them, where the rule is a zone type of VDA 5050 \
                      with its value, or `NONE`; what a label is for decides when absent",
        example: "ju:SPEED_LIMIT:0.8,un:NONE",
        set: |options, text| {
            options.zones = ZoneRules::read(&text_of(text, LONGEST_LINK)?)?;
            Ok(())
        },
    },
    ExportOption {
        name: "manufacturer",
        description: "Manufacturer of the vehicle that the message goes to; `any` when absent",
        example: "any",
        set: |options, text| {
            options.recipient.manufacturer = text_of(text, LONGEST)?;
            Ok(())
        },
    },
    ExportOption {
        name: "serialNumber",
        description: "Serial number of that vehicle; `any` when absent",
        example: "any",
        set: |options, text| {
            options.recipient.serial_number = text_of(text, LONGEST)?;
            Ok(())
        },
    },
    ExportOption {
        name: "link",
        description: "Where vehicles fetch `bundle.zip`; the service itself when absent",
        example: "https://maps.example/bundle.zip",
        set: |options, text| {
            options.link = Some(text_of(text, LONGEST_LINK)?);
            Ok(())
        },
    },
    ExportOption {
        name: "workPlaces",
        description: "Whether vehicles may drive on work places such as offices: `open` or `closed`; `closed` when absent",
        example: "open",
        set: |options, text| {
            options.keepout.work_places = word(text, &[("closed", true), ("open", false)])?;
            Ok(())
        },
    },
    ExportOption {
        name: "junctionPercent",
        description: "Greatest speed in junctions, percent of the vehicle's own, 1 to 100; 50 when absent",
        example: "50",
        set: |options, text| {
            options.speed.junction_percent = percent(text)?;
            Ok(())
        },
    },
    ExportOption {
        name: "workPlacePercent",
        description: "Greatest speed in work places, likewise; 25 when absent",
        example: "25",
        set: |options, text| {
            options.speed.work_place_percent = percent(text)?;
            Ok(())
        },
    },
    ExportOption {
        name: "profile",
        description: "Columns of the table: `generic`, `odoo`, `sap-ewm` or `business-central`; `generic` when absent",
        example: "odoo",
        set: |options, text| {
            options.profile = word(text, &Profile::ALL.map(|profile| (profile.name(), profile)))?;
            Ok(())
        },
    },
    ExportOption {
        name: "warehouse",
        description: "Name of the warehouse in the inventory system: parent location, warehouse number (4 characters in SAP \
                      EWM) or location code (10 in Business Central); `WH` when absent",
        example: "WH",
        set: |options, text| {
            options.inventory.warehouse = text_of(text, LONGEST)?;
            Ok(())
        },
    },
    ExportOption {
        name: "storageType",
        description: "Storage type (4 characters) in SAP EWM, zone code (10) in Business Central; `BULK` when absent",
        example: "BULK",
        set: |options, text| {
            options.inventory.storage_type = text_of(text, LONGEST)?;
            Ok(())
        },
    },
    ExportOption {
        name: "crs",
        description: "System of the coordinates: `EPSG:3857` (of a map without georeference the metres of its frame) or \
                      `CRS84` (longitude, latitude); `EPSG:3857` when absent",
        example: "CRS84",
        set: |options, text| {
            options.crs = word(text, &[("EPSG:3857", Crs::WebMercator), ("CRS84", Crs::Crs84)])?;
            Ok(())
        },
    },
];

/// Every option of some export.
#[must_use]
pub const fn options() -> &'static [ExportOption] {
    OPTIONS
}

/// The option of a name.
#[must_use]
pub fn option(name: &str) -> Option<&'static ExportOption> {
    options().iter().find(|option| option.name == name)
}

/// The options of an export, checked.
#[derive(Debug, Clone, PartialEq)]
pub struct ExportOptions {
    /// Distance that the middle of the vehicle keeps from obstacles, metres; `None` for half the vehicle width of the
    /// analysis.
    pub footprint_radius: Option<f64>,
    /// Zones of VDA 5050.
    pub zones: ZoneRules,
    /// The vehicle that a message goes to.
    pub recipient: Recipient,
    /// Where vehicles fetch the bundle.
    pub link: Option<String>,
    /// Of the Nav2 keepout mask and the vector objects.
    pub keepout: KeepoutOptions,
    /// Of the Nav2 speed mask.
    pub speed: SpeedOptions,
    /// Columns of the CSV.
    pub profile: Profile,
    /// Names in the inventory system.
    pub inventory: InventoryOptions,
    /// Coordinates of GIS files.
    pub crs: Crs,
}

impl Default for ExportOptions {
    fn default() -> Self {
        Self {
            footprint_radius: None,
            zones: ZoneRules::default(),
            recipient: Recipient::default(),
            link: None,
            keepout: KeepoutOptions::default(),
            speed: SpeedOptions::default(),
            profile: Profile::default(),
            inventory: InventoryOptions::default(),
            crs: Crs::WebMercator,
        }
    }
}

/// An option that an export does not have, or that has a bad value.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct OptionProblem {
    /// Its name.
    pub name: String,
    /// What is wrong and what would be right, to be put after the name.
    pub detail: String,
}

impl ExportOptions {
    /// Reads the options of an export, given by name and value.
    ///
    /// # Errors
    /// [`OptionProblem`] for the first one that is unknown, there twice or has a bad value.
    pub fn read<'a>(
        export: &Export,
        given: impl IntoIterator<Item = (&'a str, &'a str)>,
    ) -> Result<Self, OptionProblem> {
        let mut options = Self::default();
        let mut seen: Vec<&str> = Vec::new();
        for (name, value) in given {
            let problem = |detail: String| OptionProblem { name: name.to_owned(), detail };
            let known = option(name).filter(|option| export.options.contains(&option.name));
            let option = known.ok_or_else(|| problem(not_an_option(export)))?;
            if seen.contains(&name) {
                return Err(problem("is there twice".to_owned()));
            }
            (option.set)(&mut options, value).map_err(problem)?;
            seen.push(name);
        }
        options.check_inventory()?;
        Ok(options)
    }

    /// The names in the inventory system are as short as it asks.
    fn check_inventory(&self) -> Result<(), OptionProblem> {
        let InventoryOptions { warehouse, storage_type } = &self.inventory;
        for (name, text) in [("warehouse", warehouse), ("storageType", storage_type)] {
            let most = self.profile.longest_name();
            if text.chars().count() > most {
                let detail = format!("{text} has more than the {most} characters of profile {}", self.profile.name());
                return Err(OptionProblem { name: name.to_owned(), detail });
            }
        }
        Ok(())
    }
}

fn not_an_option(export: &Export) -> String {
    match export.options {
        [] => format!("is no option of {}, which has none", export.name),
        options => format!("is no option of {}, which has {}", export.name, options.join(", ")),
    }
}

fn number(text: &str, least: f64, most: f64) -> Result<f64, String> {
    let number = text.trim().parse::<f64>().ok().filter(|number| (least..=most).contains(number));
    number.ok_or_else(|| format!("{text} is no number from {least} to {most}"))
}

fn percent(text: &str) -> Result<u8, String> {
    let number = text.trim().parse().ok().filter(|percent| (1..=100).contains(percent));
    number.ok_or_else(|| format!("{text} is no whole number from 1 to 100"))
}

fn text_of(text: &str, longest: usize) -> Result<String, String> {
    if text.trim().is_empty() || text.chars().count() > longest || text.chars().any(char::is_control) {
        return Err(format!("must be a text of 1 to {longest} characters"));
    }
    Ok(text.to_owned())
}

fn word<T: Copy>(text: &str, words: &[(&str, T)]) -> Result<T, String> {
    let found = words.iter().find(|(word, _)| *word == text).map(|(_, value)| *value);
    let known = || words.iter().map(|(word, _)| *word).collect::<Vec<_>>().join(", ");
    found.ok_or_else(|| format!("{text} is none of {}", known()))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn refused(file: &str, given: &[(&str, &str)]) -> (String, String) {
        let problem = ExportOptions::read(Export::find(file).unwrap(), given.iter().copied()).unwrap_err();
        (problem.name, problem.detail)
    }

    #[test]
    fn every_option_of_an_export_is_known_and_its_example_is_good() {
        for export in crate::exports::list() {
            for name in export.options {
                let option = option(name).unwrap_or_else(|| panic!("{name} of {}", export.name));
                ExportOptions::read(export, [(option.name, option.example)]).unwrap();
            }
        }
    }

    #[test]
    fn wrong_options_say_what_would_be_right() {
        let (name, detail) = refused("locations.csv", &[("profil", "odoo")]);
        assert_eq!(name, "profil");
        assert_eq!(
            detail,
            "is no option of locations.csv, which has profile, warehouse, storageType, footprintRadiusM"
        );
        let (_, detail) = refused("locations.csv", &[("profile", "excel")]);
        assert_eq!(detail, "excel is none of generic, odoo, sap-ewm, business-central");
        let (name, _) = refused("locations.csv", &[("profile", "sap-ewm"), ("warehouse", "W-001")]);
        assert_eq!(name, "warehouse");
        assert_eq!(refused("map.map", &[("crs", "CRS84")]).1, "is no option of map.map, which has none");
        assert_eq!(refused("lif.json", &[("footprintRadiusM", "NaN")]).1, "NaN is no number from 0 to 10");
        assert_eq!(refused("nav2-speed.zip", &[("junctionPercent", "0")]).0, "junctionPercent");
        let twice = [("workPlaces", "open"), ("workPlaces", "closed")];
        assert_eq!(refused("nav2-keepout.zip", &twice).1, "is there twice");
    }
}
