//! Map-frame metres -> the coordinates a client asked for, and back.
//!
//! A map without georeference is *nominal*: its frame is taken for EPSG:3857 metres about (0, 0), so that EPSG:3857
//! answers are the metres of the map exactly, and longitude and latitude follow by the inverse spherical Mercator.
//! A georeferenced map lies on the plane that touches the ellipsoid (WGS 84) at its origin: metres become degrees by
//! the radii of curvature there. Over a kilometre that plane is some centimetres off, at 60 degrees of latitude. Degrees
//! become metres of Web Mercator or of a zone of UTM.
//!
//! A georeference is given by hand, or fitted to pairs of points that were surveyed ([`Survey`]).

mod crs;
mod georeference;
mod survey;
mod transform;
mod transverse_mercator;

pub use crs::Crs;
pub use georeference::{Georeference, OutOfRange};
pub use survey::{PointPair, Survey, SurveyFit, SurveyProblem};
pub use transform::Transform;
pub use transverse_mercator::UtmZone;
