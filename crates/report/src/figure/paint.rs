//! What the classes of a plot look like on paper: one table, as a style sheet and for the PDF.

/// A colour by what it is for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Ink {
    Text,
    Muted,
    Rule,
    Paper,
    /// The variant's own: class `c0` to `c7`.
    Variant,
    None,
}

/// What elements with all of these classes look like; `text` is every piece of text. Later rules win.
struct Rule {
    on: &'static [&'static str],
    fill: Option<Ink>,
    stroke: Option<Ink>,
    width: Option<f32>,
    dash: &'static [f32],
    opacity: Option<f32>,
}

const NOTHING: Rule = Rule { on: &[], fill: None, stroke: None, width: None, dash: &[], opacity: None };

/// The light page's looks.
const RULES: [Rule; 13] = [
    Rule { on: &["text"], fill: Some(Ink::Text), ..NOTHING },
    Rule { on: &["tick"], fill: Some(Ink::Muted), ..NOTHING },
    Rule { on: &["axis"], fill: Some(Ink::Muted), ..NOTHING },
    Rule { on: &["grid"], stroke: Some(Ink::Rule), ..NOTHING },
    Rule { on: &["line"], fill: Some(Ink::None), stroke: Some(Ink::Variant), width: Some(1.8), ..NOTHING },
    Rule { on: &["line", "printed"], width: Some(1.3), dash: &[4.0, 3.0], ..NOTHING },
    Rule { on: &["mark"], fill: Some(Ink::Variant), stroke: Some(Ink::Variant), width: Some(1.5), ..NOTHING },
    Rule { on: &["mark", "printed"], fill: Some(Ink::Paper), ..NOTHING },
    Rule { on: &["band"], fill: Some(Ink::Variant), opacity: Some(0.13), ..NOTHING },
    Rule { on: &["band", "printed"], opacity: Some(0.06), ..NOTHING },
    Rule { on: &["whisker"], stroke: Some(Ink::Variant), width: Some(1.4), ..NOTHING },
    Rule { on: &["frontier"], fill: Some(Ink::None), stroke: Some(Ink::Muted), dash: &[2.0, 3.0], ..NOTHING },
    // Its outline lies under the letters and keeps lines off them.
    Rule { on: &["label"], stroke: Some(Ink::Paper), width: Some(4.0), ..NOTHING },
];

/// `c0` to `c7`.
const VARIANTS: [[u8; 3]; 8] = [
    [0x1d, 0x4f, 0x91],
    [0xc8, 0x50, 0x1e],
    [0x13, 0x84, 0x68],
    [0xb5, 0x54, 0x8f],
    [0xa5, 0x7c, 0x00],
    [0x3b, 0x98, 0xcf],
    [0x6a, 0x6d, 0x75],
    [0x7a, 0x3f, 0xb0],
];

impl Ink {
    fn rgb(self, variant: usize) -> Option<[u8; 3]> {
        match self {
            Self::Text => Some([0x1c, 0x1d, 0x21]),
            Self::Muted => Some([0x65, 0x68, 0x71]),
            Self::Rule => Some([0xde, 0xdc, 0xd6]),
            Self::Paper => Some([255; 3]),
            Self::Variant => VARIANTS.get(variant).copied(),
            Self::None => None,
        }
    }
}

/// How one element is drawn; SVG's own defaults where no rule says otherwise.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Paint {
    pub(super) fill: Option<[u8; 3]>,
    pub(super) stroke: Option<[u8; 3]>,
    pub(super) width: f32,
    pub(super) dash: &'static [f32],
    pub(super) opacity: f32,
}

impl Paint {
    /// Of an element's name and its classes.
    pub(super) fn of(element: &str, classes: &str) -> Self {
        // A class may be called as an element is: `line` is a curve's class too.
        let text = (element == "text").then_some(element);
        let classes: Vec<&str> = classes.split_whitespace().chain(text).collect();
        let variant = (0..VARIANTS.len()).find(|v| classes.contains(&format!("c{v}").as_str()));
        let variant = variant.unwrap_or_default();
        let mut paint = Self { fill: Some([0; 3]), stroke: None, width: 1.0, dash: &[], opacity: 1.0 };
        for rule in RULES.iter().filter(|rule| rule.on.iter().all(|class| classes.contains(class))) {
            paint.fill = rule.fill.map_or(paint.fill, |ink| ink.rgb(variant));
            paint.stroke = rule.stroke.map_or(paint.stroke, |ink| ink.rgb(variant));
            paint.width = rule.width.unwrap_or(paint.width);
            paint.dash = if rule.dash.is_empty() { paint.dash } else { rule.dash };
            paint.opacity = rule.opacity.unwrap_or(paint.opacity);
        }
        paint
    }
}

/// The same as a style sheet. Not every reader of SVG knows variables: colours are written out.
pub(super) fn style_sheet() -> String {
    let mut sheet = String::from("text{font:12px Helvetica,Arial,sans-serif}.label{paint-order:stroke}");
    for rule in &RULES {
        let of_variant = [rule.fill, rule.stroke].contains(&Some(Ink::Variant));
        let variants = if of_variant { VARIANTS.len() } else { 1 };
        let selector: String =
            rule.on.iter().map(|c| if *c == "text" { "text".into() } else { format!(".{c}") }).collect();
        for variant in 0..variants {
            let more = if of_variant { format!(".c{variant}") } else { String::new() };
            sheet += &format!("{selector}{more}{{{}}}", declarations(rule, variant));
        }
    }
    sheet
}

fn declarations(rule: &Rule, variant: usize) -> String {
    let colour = |ink: Ink| {
        ink.rgb(variant).map_or("none".into(), |[r, g, b]: [u8; 3]| format!("#{r:02x}{g:02x}{b:02x}"))
    };
    let dash = rule.dash.iter().map(f32::to_string).collect::<Vec<_>>().join(" ");
    let all = [
        rule.fill.map(|ink| format!("fill:{}", colour(ink))),
        rule.stroke.map(|ink| format!("stroke:{}", colour(ink))),
        rule.width.map(|w| format!("stroke-width:{w}")),
        (!dash.is_empty()).then(|| format!("stroke-dasharray:{dash}")),
        rule.opacity.map(|o| format!("fill-opacity:{o}")),
    ];
    all.into_iter().flatten().collect::<Vec<_>>().join(";")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn later_rules_win_and_the_sheet_says_the_same() {
        let hollow = Paint::of("circle", "mark c1 printed");
        assert_eq!((hollow.fill, hollow.stroke), (Some([255; 3]), Some(VARIANTS[1])));
        assert_eq!(Paint::of("path", "line c0 printed").dash, [4.0, 3.0]);
        assert_eq!(Paint::of("path", "line c0 matched").fill, None);
        assert_eq!(Paint::of("line", "grid").stroke, Ink::Rule.rgb(0));
        let sheet = style_sheet();
        assert!(sheet.contains(".mark.c1{fill:#c8501e;stroke:#c8501e;stroke-width:1.5}"), "{sheet}");
        // The cascade of a browser is by classes first, then by place: `.mark.printed` has to come after `.mark.c1`.
        assert!(sheet.find(".mark.printed{") > sheet.find(".mark.c7{"));
    }
}
