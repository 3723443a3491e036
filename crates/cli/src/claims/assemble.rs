//! Cards of all claims, and their crops.

use super::crops::crops;
use super::judge::{Judge, Judged};
use super::registry::Claim;
use super::rule::verdict;
use crate::error::CliError;
use std::collections::BTreeMap;
use umbrage_report::{ClaimCard, Crop, Outcome};

/// Cards, crops by claim, and what was not finite.
pub(crate) struct Assembled {
    pub(crate) cards: Vec<ClaimCard>,
    pub(crate) crops: BTreeMap<String, Crop>,
    pub(crate) broken: Vec<String>,
}

/// Judges every part of every claim.
pub(crate) fn assemble(claims: &[&Claim], judge: &Judge<'_>) -> Result<Assembled, CliError> {
    let mut all = Assembled { cards: vec![], crops: BTreeMap::new(), broken: vec![] };
    for claim in claims {
        let parts: Vec<Judged> = claim.part.iter().map(|p| judge.part(p)).collect::<Result<_, _>>()?;
        let broken = parts.iter().filter(|p| p.broken);
        all.broken.extend(broken.map(|p| format!("{}, \"{}\"", claim.id, p.card.says)));
        all.crops.extend(crops(&parts, judge.measurements).map(|crop| (claim.id.clone(), crop)));
        let outcomes: Vec<Outcome> = parts.iter().map(|p| p.card.outcome).collect();
        all.cards.push(ClaimCard {
            id: claim.id.clone(),
            document: claim.document.clone(),
            statement: claim.statement.clone(),
            note: claim.note.clone(),
            verdict: verdict(&outcomes),
            parts: parts.into_iter().map(|p| p.card).collect(),
            crop: None,
            crop_caption: None,
        });
    }
    Ok(all)
}
