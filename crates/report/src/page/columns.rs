//! The columns of the table: adding one is a line here.

use crate::plot::Target;

/// A score that the table shows.
pub(super) struct Column {
    /// Metric id.
    pub(super) id: &'static str,
    /// What stands above it.
    pub(super) head: &'static str,
    /// A second line, smaller.
    pub(super) sub: &'static str,
    /// What it should be.
    pub(super) target: Target,
}

/// Columns that belong together.
pub(super) struct Group {
    pub(super) head: &'static str,
    pub(super) columns: &'static [Column],
}

const fn zero(id: &'static str, head: &'static str, sub: &'static str) -> Column {
    Column { id, head, sub, target: Target::Zero }
}

/// In display order; the cost follows them.
pub(super) const GROUPS: [Group; 5] = [
    Group {
        head: "Headline",
        columns: &[zero("error", "ERROR", "RMSE"), zero("swimming", "SWIMMING", "moving cells")],
    },
    Group {
        head: "Five cells that add up to the squared error",
        columns: &[
            zero("smooth_static", "smooth static", "wrong width, depth"),
            zero("structured_static", "structured static", "bands"),
            zero("smooth_moving", "smooth moving", "breathing"),
            zero("structured_moving", "structured moving", "crawling bands"),
            zero("noise", "noise", "between seeds"),
        ],
    },
    Group {
        head: "Outside the penumbra",
        columns: &[
            zero("light_leak", "light leak", "in the umbra"),
            zero("false_shadow", "false shadow", "in the light"),
        ],
    },
    Group {
        head: "Shape",
        columns: &[Column { id: "width_ratio", head: "width", sub: "1 is right", target: Target::One }],
    },
    Group { head: "The eye", columns: &[zero("flip", "FLIP", "shaded image")] },
];

/// The columns without their groups.
pub(super) fn columns() -> impl Iterator<Item = &'static Column> {
    GROUPS.iter().flat_map(|g| g.columns)
}

/// Metrics that have no column, and are listed in each window's own table.
pub(super) fn has_column(id: &str) -> bool {
    columns().any(|c| c.id == id)
}
