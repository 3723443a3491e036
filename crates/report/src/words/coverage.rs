//! How much of what is seen was scored.

use crate::WindowCard;
use crate::numbers::percent;

/// Two shares over windows, each as a range: of the pictures (none when the file is older than
/// that number), and of the surface points that face the light.
pub(crate) struct Scored {
    pub(crate) pictures: Option<String>,
    pub(crate) facing: String,
}

/// What these windows cover; none when there is no window.
pub(crate) fn scored<'a>(windows: impl Iterator<Item = &'a WindowCard> + Clone) -> Option<Scored> {
    let facing = range(windows.clone().map(|w| w.coverage))?;
    let known = windows.clone().any(|w| w.picture > 0.0);
    let pictures = if known { range(windows.map(|w| w.picture)) } else { None };
    Some(Scored { pictures, facing })
}

/// "45.0 % to 92.0 %", or one percentage where both ends read the same.
fn range(shares: impl Iterator<Item = f64> + Clone) -> Option<String> {
    let low = shares.clone().min_by(f64::total_cmp)?;
    let high = shares.max_by(f64::total_cmp)?;
    let (low, high) = (percent(low), percent(high));
    Some(if low == high { low } else { format!("{low} to {high}") })
}
