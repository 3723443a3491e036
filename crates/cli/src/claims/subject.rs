//! From what the registry says to what is measured: every subject as members at places.

use super::place::Place;
use super::registry::{FullSubject, Other, Overrides, Part, Registry, Subject, Take};
use umbrage_shadows::{Calibration, PROBES, VariantId, select_variants};

/// A variant at some places.
#[derive(Clone, Debug)]
pub(crate) struct MemberAt {
    /// `chss/light-matched`.
    pub(crate) variant: String,
    pub(crate) places: Vec<Place>,
}

/// One or several members that make one number.
#[derive(Clone, Debug)]
pub(crate) struct Resolved {
    pub(crate) members: Vec<MemberAt>,
    pub(crate) take: Take,
    /// For people.
    pub(crate) label: String,
}

/// What B is.
#[derive(Clone, Debug)]
pub(crate) enum ResolvedOther {
    Constant(f64),
    Subject(Resolved),
}

/// A part with its subjects resolved.
#[derive(Clone, Debug)]
pub(crate) struct Comparison {
    pub(crate) a: Resolved,
    pub(crate) b: ResolvedOther,
    pub(crate) from: Option<Resolved>,
    pub(crate) per: Option<[Resolved; 2]>,
}

impl Resolved {
    /// What is read to make the one number: each member over all its places; for a spread each member
    /// in each place, so that changes of opposite sign in two places do not cancel.
    pub(super) fn readings(&self) -> Vec<MemberAt> {
        if self.take != Take::Spread {
            return self.members.clone();
        }
        let alone = |member: &MemberAt, place: &Place| MemberAt {
            variant: member.variant.clone(),
            places: vec![place.clone()],
        };
        self.members.iter().flat_map(|m| m.places.iter().map(move |p| alone(m, p))).collect()
    }
}

impl Comparison {
    /// `None` for an exact number, which has no subject.
    pub(crate) fn of(part: &Part, registry: &Registry) -> Result<Option<Self>, String> {
        let Some(a) = &part.a else { return Ok(None) };
        let resolve = |subject: &Subject| resolve(subject, part, registry);
        let b = match &part.b {
            Other::Constant(value) => ResolvedOther::Constant(*value),
            Other::Subject(subject) => ResolvedOther::Subject(resolve(subject)?),
        };
        let per = match &part.per {
            Some([a, b]) => Some([resolve(a)?, resolve(b)?]),
            None => None,
        };
        Ok(Some(Self { a: resolve(a)?, b, from: part.from.as_ref().map(resolve).transpose()?, per }))
    }

    /// All subjects: A, B, and the third ones.
    pub(crate) fn subjects(&self) -> Vec<&Resolved> {
        let b = match &self.b {
            ResolvedOther::Subject(b) => Some(b),
            ResolvedOther::Constant(_) => None,
        };
        std::iter::once(&self.a).chain(b).chain(&self.from).chain(self.per.iter().flatten()).collect()
    }

    /// Every variant at every place.
    pub(crate) fn units(&self) -> impl Iterator<Item = (&Place, &str)> {
        let members = self.subjects().into_iter().flat_map(|s| &s.members);
        members.flat_map(|m| m.places.iter().map(|p| (p, m.variant.as_str())))
    }

    /// The same comparison in one place alone, where every subject has equally many.
    pub(crate) fn in_place(&self, index: usize) -> Self {
        let mut one = self.clone();
        let only = |subject: &mut Resolved| {
            for member in &mut subject.members {
                member.places = vec![member.places[index].clone()];
            }
        };
        only(&mut one.a);
        if let ResolvedOther::Subject(b) = &mut one.b {
            only(b);
        }
        one.from.iter_mut().chain(one.per.iter_mut().flatten()).for_each(only);
        one
    }

    /// How many places each subject has, where all have equally many.
    pub(crate) fn places(&self) -> Option<usize> {
        let count = self.a.members.first()?.places.len();
        let members = self.subjects().into_iter().flat_map(|s| &s.members);
        members.into_iter().all(|m| m.places.len() == count).then_some(count)
    }
}

/// The kernels that are meant where a name does not say.
const DEFAULT: &str = "light-matched";

/// `chss` is `chss/light-matched`.
pub(crate) fn full_name(variant: &str) -> String {
    if variant.contains('/') { variant.into() } else { format!("{variant}/{DEFAULT}") }
}

/// The variant of a full name, probes included, where this build has it.
pub(crate) fn variant_of(full_name: &str) -> Option<VariantId> {
    let probe = || {
        let (name, calibration) = full_name.split_once('/')?;
        let variant = PROBES.iter().find(|v| v.name == name)?;
        let calibration = Calibration::ALL.into_iter().find(|c| c.name() == calibration)?;
        Some(VariantId { variant, calibration })
    };
    select_variants(full_name).into_iter().next().or_else(probe)
}

fn resolve(subject: &Subject, part: &Part, registry: &Registry) -> Result<Resolved, String> {
    let plain = |name: &String| FullSubject {
        variant: Some(name.clone()),
        variants: vec![],
        places: None,
        at: Overrides::default(),
        each: vec![],
        take: Take::Only,
    };
    let full = match subject {
        Subject::Name(name) => plain(name),
        Subject::Full(full) => (**full).clone(),
    };
    let variants: Vec<&String> = full.variant.iter().chain(&full.variants).collect();
    let each = if full.each.is_empty() { vec![Overrides::default()] } else { full.each.clone() };
    let count = variants.len() * each.len();
    if count == 0 || (count > 1) == (full.take == Take::Only) {
        return Err("a subject is one variant at one setting, or several with a take".into());
    }
    let places = registry.places_of(full.places.as_ref().unwrap_or(&part.places))?;
    let member = |variant: &String, over: &Overrides| MemberAt {
        variant: full_name(variant),
        places: places.iter().map(|p| Place::new(p.clone(), &[&part.at, &full.at, over])).collect(),
    };
    let members: Vec<MemberAt> =
        variants.iter().flat_map(|v| each.iter().map(move |over| member(v, over))).collect();
    let label = label(&variants, &full, &each);
    Ok(Resolved { members, take: full.take, label })
}

/// "least of chss-mask, chss-mask-1.4"; settings that are a subject's own in brackets.
fn label(variants: &[&String], full: &FullSubject, each: &[Overrides]) -> String {
    let setting = |over: &Overrides| {
        let described = Place::new((String::new(), String::new()), &[over]).label();
        described.trim_matches([' ', ',']).to_string()
    };
    let names = variants.iter().map(|v| v.as_str()).collect::<Vec<_>>().join(", ");
    let mut settings: Vec<String> =
        std::iter::once(&full.at).chain(each).map(setting).filter(|s| !s.is_empty()).collect();
    settings.extend(full.places.as_ref().map(|p| p.join(", ")));
    let take = match full.take {
        Take::Only => "",
        Take::Least => "least of ",
        Take::Spread => "spread of ",
    };
    let settings = if settings.is_empty() { String::new() } else { format!(" ({})", settings.join("; ")) };
    format!("{take}{names}{settings}")
}
