//! The same results for machines and for chats: CSV, Markdown, JUnit.

mod csv;
mod escape;
mod junit;
mod summary;

pub(crate) use csv::scores_csv;
pub(crate) use escape::{csv as csv_field, legal_xml, markdown};
pub(crate) use junit::junit;
pub(crate) use summary::summary;
