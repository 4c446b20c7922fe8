//! Coordinate reference systems, by their numbers and in well-known text (OGC 01-009).

use rusqlite::{Result, Transaction, params};

use crate::coordinates::Crs;

/// EPSG:4326; a `GeoPackage` has the longitude first, whatever the registry says.
const WGS_84: &str = r#"GEOGCS["WGS 84",DATUM["WGS_1984",SPHEROID["WGS 84",6378137,298.257223563,AUTHORITY["EPSG","7030"]],AUTHORITY["EPSG","6326"]],PRIMEM["Greenwich",0,AUTHORITY["EPSG","8901"]],UNIT["degree",0.0174532925199433,AUTHORITY["EPSG","9122"]],AUTHORITY["EPSG","4326"]]"#;
/// The projection of EPSG:3857.
const MERCATOR: &str = r#"PROJECTION["Mercator_1SP"],PARAMETER["central_meridian",0],PARAMETER["scale_factor",1],PARAMETER["false_easting",0],PARAMETER["false_northing",0]"#;
/// What readers of well-known text must know beside it: the sphere.
const MERCATOR_EXTENSION: &str = r#",EXTENSION["PROJ4","+proj=merc +a=6378137 +b=6378137 +lat_ts=0 +lon_0=0 +x_0=0 +y_0=0 +k=1 +units=m +nadgrids=@null +wktext +no_defs"]"#;
/// The number of EPSG:4326, which stands for longitude and latitude.
const WGS_84_ID: u32 = 4326;

/// The number of a system.
pub const fn id(crs: Crs) -> u32 {
    match crs.epsg() {
        Some(code) => code,
        None => WGS_84_ID,
    }
}

/// The systems that every file has (requirement 11), and the one of its coordinates.
pub fn insert(database: &Transaction<'_>, crs: Crs) -> Result<()> {
    let system = |name: &str, id: i64, organization: &str, definition: &str| {
        database.execute(
            "INSERT INTO gpkg_spatial_ref_sys VALUES (?1, ?2, ?3, ?2, ?4, NULL)",
            params![name, id, organization, definition],
        )
    };
    system("Undefined Cartesian SRS", -1, "NONE", "undefined")?;
    system("Undefined geographic SRS", 0, "NONE", "undefined")?;
    system("WGS 84", WGS_84_ID.into(), "EPSG", WGS_84)?;
    if let Some((name, definition)) = projected(crs) {
        system(&name, id(crs).into(), "EPSG", &definition)?;
    }
    Ok(())
}

/// Name and definition of a system in metres.
fn projected(crs: Crs) -> Option<(String, String)> {
    let code = crs.epsg()?;
    let (name, projection, extension) = match crs {
        Crs::Crs84 => return None,
        Crs::WebMercator => ("WGS 84 / Pseudo-Mercator".to_owned(), MERCATOR.to_owned(), MERCATOR_EXTENSION),
        Crs::Utm(_) => {
            // The codes of the north are 32601 to 32660, those of the south 32701 to 32760.
            let (zone, is_south) = (i64::from(code % 100), code >= 32_700);
            let (side, northing) = if is_south { ("S", 10_000_000) } else { ("N", 0) };
            let meridian = zone * 6 - 183;
            let projection = format!(
                r#"PROJECTION["Transverse_Mercator"],PARAMETER["latitude_of_origin",0],PARAMETER["central_meridian",{meridian}],PARAMETER["scale_factor",0.9996],PARAMETER["false_easting",500000],PARAMETER["false_northing",{northing}]"#
            );
            (format!("WGS 84 / UTM zone {zone}{side}"), projection, "")
        }
    };
    let definition = format!(
        r#"PROJCS["{name}",{WGS_84},{projection},UNIT["metre",1,AUTHORITY["EPSG","9001"]],AXIS["Easting",EAST],AXIS["Northing",NORTH]{extension},AUTHORITY["EPSG","{code}"]]"#
    );
    Some((name, definition))
}
