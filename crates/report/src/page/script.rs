//! The page's script: the modules of `js/` in one, for a page from a disk may not load modules.
//!
//! Each becomes a function of its own that returns what it exports; `import { a } from "./b.js"`
//! becomes a look into what `b` returned. Names that are exported are never assigned again, so that
//! nothing else of modules is missed.

/// In an order in which none needs a later one.
const MODULES: [(&str, &str); 22] = [
    ("half", include_str!("js/half.js")),
    ("planes", include_str!("js/planes.js")),
    ("camera", include_str!("js/camera.js")),
    ("points", include_str!("js/points.js")),
    ("cells", include_str!("js/cells.js")),
    ("captions", include_str!("js/captions.js")),
    ("layers", include_str!("js/layers.js")),
    ("colour", include_str!("js/colour.js")),
    ("digits", include_str!("js/digits.js")),
    ("numbers", include_str!("js/numbers.js")),
    ("stage", include_str!("js/stage.js")),
    ("state", include_str!("js/state.js")),
    ("says", include_str!("js/says.js")),
    ("inspect", include_str!("js/inspect.js")),
    ("series", include_str!("js/series.js")),
    ("viewer", include_str!("js/viewer.js")),
    ("controls", include_str!("js/controls.js")),
    ("keys", include_str!("js/keys.js")),
    ("table", include_str!("js/table.js")),
    ("trace", include_str!("js/trace.js")),
    ("thresholds", include_str!("js/thresholds.js")),
    ("main", include_str!("js/main.js")),
];

/// All of it, to go into one block.
pub(super) fn script() -> String {
    let modules: String = MODULES.iter().map(|(name, source)| module(name, source)).collect();
    format!("\"use strict\";\n(() => {{\nconst modules = {{}};\n{modules}}})();\n")
}

fn module(name: &str, source: &str) -> String {
    let mut exports = Vec::new();
    let body: String = source.lines().map(|line| plain(line, &mut exports) + "\n").collect();
    format!("modules.{name} = (() => {{\n{body}return {{ {} }};\n}})();\n", exports.join(", "))
}

/// A line without the words of modules.
fn plain(line: &str, exports: &mut Vec<String>) -> String {
    if let Some((names, from)) = line.strip_prefix("import ").and_then(|l| l.split_once(" from ")) {
        let module = from.trim_matches(|c| "\"./;".contains(c)).trim_end_matches(".js");
        return format!("const {names} = modules.{module};");
    }
    let Some(declared) = line.strip_prefix("export ") else { return line.into() };
    let words = declared.split(|c: char| !(c.is_alphanumeric() || c == '_' || c == '$'));
    let name = words.into_iter().find(|w| !["async", "function", "const", "class", ""].contains(w));
    exports.extend(name.map(str::to_string));
    declared.into()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn modules_only_look_at_earlier_ones_and_at_what_those_export() {
        let mut before: Vec<(&str, Vec<String>)> = Vec::new();
        for (name, source) in MODULES {
            for line in source.lines().filter(|l| l.starts_with("import ")) {
                let from = line.split("./").nth(1).and_then(|f| f.split(".js").next()).expect("a module");
                let known = before.iter().find(|m| m.0 == from).expect("an earlier module");
                let names = line.split(['{', '}']).nth(1).expect("names in braces");
                for wanted in names.split(',').map(str::trim) {
                    assert!(known.1.iter().any(|n| n == wanted), "{name}: {from} exports no {wanted}");
                }
            }
            let mut exports = Vec::new();
            source.lines().for_each(|line| drop(plain(line, &mut exports)));
            before.push((name, exports));
        }
    }

    #[test]
    fn nothing_in_it_ends_its_block() {
        assert!(!script().contains("</") && !script().contains("<!--"));
    }
}
