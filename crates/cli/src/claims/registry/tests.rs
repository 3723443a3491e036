use super::*;
use crate::claims::subject::{Comparison, variant_of};
use crate::claims::{cost_needs, needs};
use std::collections::BTreeSet;
use umbrage_scene::Scene;

fn built_in() -> Registry {
    Registry::built_in().expect("the compiled-in claims")
}

#[test]
fn every_claim_is_there_once_and_says_something() {
    let registry = built_in();
    let ids: Vec<&str> = registry.claim.iter().map(|c| c.id.as_str()).collect();
    assert_eq!(ids, (1..=40).map(|n| format!("C{n}")).collect::<Vec<_>>());
    for claim in &registry.claim {
        assert!(
            !claim.statement.is_empty() && !claim.document.is_empty() && !claim.part.is_empty(),
            "{}",
            claim.id
        );
        assert!(claim.part.iter().all(|p| !p.says.is_empty()), "{}", claim.id);
    }
}

#[test]
fn own_margins_have_a_reason_and_all_are_legal() {
    let registry = built_in();
    for part in registry.claim.iter().flat_map(|c| &c.part) {
        assert_eq!(part.margin.is_some(), part.why.is_some(), "{}", part.says);
    }
    let all = registry.margin.values().flat_map(|m| m.ratio.into_iter().chain(m.absolute));
    assert!(all.into_iter().all(|m| m.is_finite() && m >= 0.0));
}

#[test]
fn every_variant_exists() {
    let registry = built_in();
    let all: Vec<&Claim> = registry.claim.iter().collect();
    let pictured = needs(&all, &registry).expect("resolved");
    let timed = cost_needs(&all, &registry).expect("resolved");
    let names = pictured.values().flat_map(|v| v.keys()).chain(timed.values().flatten());
    let missing: BTreeSet<&String> = names.filter(|name| variant_of(name).is_none()).collect();
    assert!(missing.is_empty(), "this build has no {missing:?}");
}

#[test]
fn every_place_exists() {
    let registry = built_in();
    let all: Vec<&Claim> = registry.claim.iter().collect();
    let missing: BTreeSet<String> = needs(&all, &registry)
        .expect("resolved")
        .keys()
        .filter(|p| Scene::builtin(&p.scene).and_then(|s| s.path(&p.path).map(|_| ())).is_err())
        .map(|p| p.label())
        .collect();
    assert!(missing.is_empty(), "there is no {missing:?}");
}

#[test]
fn both_sides_of_every_part_resolve() {
    let registry = built_in();
    for (claim, part) in registry.claim.iter().flat_map(|c| c.part.iter().map(move |p| (c, p))) {
        let comparison = Comparison::of(part, &registry).unwrap_or_else(|e| panic!("{}: {e}", claim.id));
        assert_eq!(comparison.is_none(), part.a.is_none(), "{}", claim.id);
    }
}

#[test]
fn an_unknown_id_names_those_that_exist() {
    let registry = built_in();
    let error = registry.select(&["C7".into(), "C41".into()]).expect_err("unknown").to_string();
    assert!(error.contains("\"C41\"") && error.contains("C1, C2") && error.contains("C40"), "{error}");
    assert_eq!(registry.select(&["c7".into()]).expect("known").len(), 1, "case does not matter");
}

#[test]
fn what_makes_no_sense_is_refused() {
    let part = |text: &str| {
        let text = format!(
            "[margin]\nerror = {{ ratio = 0.1 }}\n[[claim]]\nid = \"X\"\ndocument = \"d\"\nstatement = \"s\"\npart = [{{ {text} }}]"
        );
        Registry::parse(&text, Path::new("x.toml")).expect_err("refused").to_string()
    };
    let rest = r#"says = "x", a = "hard", b = "chss", expect = "below""#;
    assert!(
        part(&format!(r#"{rest}, number = "beauty", places = ["a/P1"]"#)).contains("no number \"beauty\"")
    );
    assert!(part(&format!(r#"{rest}, number = "error", places = ["a"]"#)).contains("no scene/path"));
    assert!(part(&format!(r#"{rest}, number = "error", places = []"#)).contains("no places"));
    assert!(
        part(&format!(r#"{rest}, number = "error", places = ["a/P1"], margin = -1.0"#)).contains("margin")
    );
    assert!(part(&format!(r#"{rest}, number = "noise", places = ["a/P1"]"#)).contains("margin"));
}
