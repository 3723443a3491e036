//! What the scores say, in words: nothing that an interval does not carry.

mod caption;
mod compare;
mod coverage;
mod elsewhere;
mod headline;
mod line;
mod sentences;
mod span;
#[cfg(test)]
mod tests;

pub(crate) use caption::{error_caption, shadow_caption, swim_caption};
pub(crate) use compare::{Comparison, is_still, is_unresolved};
pub(crate) use coverage::scored;
pub(crate) use elsewhere::{any_swim_caveat, swim_caveat};
pub(crate) use line::plain_line;
pub(crate) use sentences::answer;
pub(crate) use span::{Sentence, Span, full_name};
