//! Techniques of the user's own: from files and `--set` to variants.

use crate::args::TechniqueArgs;
use crate::error::CliError;
use std::path::Path;
use umbrage_shadows::{Own, VariantId};

/// The variants that the files are, in the order given.
///
/// # Errors
/// A file that cannot be read or is no technique, two of one name, or a `--set` that fits none.
pub(crate) fn techniques(args: &TechniqueArgs) -> Result<Vec<VariantId>, CliError> {
    let mut all = args.techniques.iter().map(|path| read(path)).collect::<Result<Vec<Own>, _>>()?;
    for (place, own) in all.iter().enumerate() {
        if all[..place].iter().any(|earlier| earlier.name() == own.name()) {
            return Err(CliError::Usage(format!("two --technique files are called \"{}\"", own.name())));
        }
    }
    args.sets.iter().try_for_each(|set| apply(&mut all, set))?;
    Ok(all.into_iter().map(Own::into_variant).collect::<Result<_, _>>()?)
}

/// The names of variants that are none of the user's own: those are there whether they are named or not, and
/// commands that a report offers to copy name them.
pub(crate) fn others(names: &[String], own: &[VariantId]) -> Vec<String> {
    let is_own = |name: &String| own.iter().any(|id| id.variant.name == *name || id.name() == *name);
    names.iter().filter(|name| !is_own(name)).cloned().collect()
}

fn read(path: &Path) -> Result<Own, CliError> {
    let text = std::fs::read_to_string(path).map_err(CliError::file(path))?;
    Ok(Own::read(&path.display().to_string(), text)?)
}

/// `mine.search_radius_m=0.5`; a technique's name may have dots, a constant's has none.
fn apply(all: &mut [Own], set: &str) -> Result<(), CliError> {
    let shape = || CliError::Usage(format!("--set {set}: expected NAME.CONSTANT=VALUE, as in mine.taps=32"));
    let (place, value) = set.split_once('=').ok_or_else(shape)?;
    let (name, constant) = place.rsplit_once('.').ok_or_else(shape)?;
    let names = all.iter().map(|own| own.name().to_string()).collect::<Vec<_>>().join(", ");
    let own = all.iter_mut().find(|own| own.name() == name);
    let message =
        || CliError::Usage(format!("--set {set}: no --technique is called \"{name}\"; there is {names}"));
    Ok(own.ok_or_else(message)?.set(constant, value)?)
}
