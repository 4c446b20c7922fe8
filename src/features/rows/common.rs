//! Properties that several collections have.

use crate::features::property::{Kind, Property};
use crate::features::words::FUNCTIONALITIES;

/// The name that people gave.
pub const NAME: Property = Property::new("name", Kind::Text, "Name", "The name that people gave it").nullable();

/// The groups that people put it in.
pub const GROUPS: Property = Property::new("groups", Kind::Texts, "Groups", "The groups that people put it in");

/// Id of a label.
pub const LABEL: Property = Property::new("label", Kind::Text, "Label", "Id of the label");

/// Name of a label.
pub const LABEL_NAME: Property = Property::new("labelName", Kind::Text, "Label name", "Name of the label for people");

/// What a label is for.
pub const FUNCTIONALITY: Property =
    Property::new("functionality", Kind::Words(FUNCTIONALITIES), "Functionality", "What places of this label are for");

/// The direction of a straight thing.
pub const ORIENTATION: Property = Property::new(
    "orientation",
    Kind::Number,
    "Orientation",
    "Its direction, counter-clockwise from the map's x axis, from -90 to 90",
)
.unit("deg");
