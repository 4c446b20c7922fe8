//! The kinds of sites.

use std::fmt;
use std::str::FromStr;

/// A kind of site; each varies with the seed in everything that its name leaves open.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Kind {
    /// Selective racks: uprights, bays of two or three places.
    Selective,
    /// Euro pallets with the long side to the aisle: wide, shallow places.
    EuroLong,
    /// Pallets of 48 x 40 inches.
    Inch,
    /// Wide flues between the backs of narrow-aisle racks.
    Flues,
    /// Tunnels through the racks.
    Tunnels,
    /// Guards at the ends of the racks.
    Guards,
    /// Places two deep from each aisle.
    DoubleDeep,
    /// Racks in two directions in one hall.
    TwoDirections,
    /// Columns of the building in rows and aisles.
    Columns,
    /// A hall in the form of an L.
    LShape,
    /// Places marked on the floor before the doors.
    Staging,
    /// Pallets on the floor in lanes four to eight deep.
    BlockStorage,
    /// Aisles aslant in the hall.
    Diagonal,
    /// Offices in a corner.
    Offices,
    /// Boxes and legs in one map.
    Mixed,
    /// Parts that nobody drove to.
    Unexplored,
}

impl Kind {
    /// All kinds.
    pub const ALL: [Self; 16] = [
        Self::Selective,
        Self::EuroLong,
        Self::Inch,
        Self::Flues,
        Self::Tunnels,
        Self::Guards,
        Self::DoubleDeep,
        Self::TwoDirections,
        Self::Columns,
        Self::LShape,
        Self::Staging,
        Self::BlockStorage,
        Self::Diagonal,
        Self::Offices,
        Self::Mixed,
        Self::Unexplored,
    ];

    /// Its name on the command line and in the names of folders.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Selective => "selective",
            Self::EuroLong => "euro-long",
            Self::Inch => "inch",
            Self::Flues => "flues",
            Self::Tunnels => "tunnels",
            Self::Guards => "guards",
            Self::DoubleDeep => "double-deep",
            Self::TwoDirections => "two-directions",
            Self::Columns => "columns",
            Self::LShape => "l-shape",
            Self::Staging => "staging",
            Self::BlockStorage => "block-storage",
            Self::Diagonal => "diagonal",
            Self::Offices => "offices",
            Self::Mixed => "mixed",
            Self::Unexplored => "unexplored",
        }
    }

    /// What is special about it.
    #[must_use]
    pub const fn description(self) -> &'static str {
        match self {
            Self::Selective => "selective racks with uprights, bays of two or three places",
            Self::EuroLong => "Euro pallets with the long side to the aisle",
            Self::Inch => "pallets of 48 x 40 inches, on blocks or stringers",
            Self::Flues => "wide flues between the backs of narrow-aisle racks",
            Self::Tunnels => "tunnels through the racks",
            Self::Guards => "guards at the ends of the racks and before their posts",
            Self::DoubleDeep => "places two deep from each aisle",
            Self::TwoDirections => "racks in two directions in one hall",
            Self::Columns => "columns of the building in rows and aisles",
            Self::LShape => "a hall in the form of an L",
            Self::Staging => "a grid of places marked on the floor before the doors",
            Self::BlockStorage => "pallets on the floor in lanes four to eight deep",
            Self::Diagonal => "aisles aslant in the hall",
            Self::Offices => "offices in a corner",
            Self::Mixed => "boxes and legs in one map",
            Self::Unexplored => "short sight, aisles and an end of the hall that nobody drove to",
        }
    }
}

impl fmt::Display for Kind {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        formatter.write_str(self.name())
    }
}

impl FromStr for Kind {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        Self::ALL.into_iter().find(|kind| kind.name() == text).ok_or_else(|| {
            let names: Vec<&str> = Self::ALL.iter().map(|kind| kind.name()).collect();
            format!("there is no kind {text}: name one of {}", names.join(", "))
        })
    }
}
