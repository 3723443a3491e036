//! Names in LaTeX: text and never commands, with the encoding and the fonts of any LaTeX.

/// Signs that LaTeX has a command for, or takes for something else.
const SIGNS: [(char, &str); 29] = [
    ('\\', "\\textbackslash{}"),
    ('~', "\\textasciitilde{}"),
    ('^', "\\textasciicircum{}"),
    // The old encoding has other signs in the places of these.
    ('<', "\\textless{}"),
    ('>', "\\textgreater{}"),
    ('|', "\\textbar{}"),
    ('"', "{\\ttfamily\\char34}"),
    ('`', "\\textasciigrave{}"),
    ('±', "$\\pm$"),
    ('−', "$-$"),
    ('×', "$\\times$"),
    ('·', "$\\cdot$"),
    ('°', "$^{\\circ}$"),
    ('≤', "$\\leq$"),
    ('≥', "$\\geq$"),
    ('–', "--"),
    ('—', "---"),
    ('’', "'"),
    ('…', "\\dots{}"),
    ('α', "$\\alpha$"),
    ('β', "$\\beta$"),
    ('γ', "$\\gamma$"),
    ('δ', "$\\delta$"),
    ('ε', "$\\varepsilon$"),
    ('θ', "$\\theta$"),
    ('λ', "$\\lambda$"),
    ('µ', "$\\mu$"),
    ('μ', "$\\mu$"),
    ('σ', "$\\sigma$"),
];

/// Text that prints as it reads, also at the start of a row.
pub(super) fn escaped(text: &str) -> String {
    // The line break before a row would take these for its own.
    let mut out = String::from(if text.starts_with(['[', '*']) { "{}" } else { "" });
    let mut before = ' ';
    for c in text.chars() {
        if (before, c) == ('-', '-') {
            // Two would be a dash.
            out += "{}";
        }
        out += &letter(c);
        before = c;
    }
    out
}

fn letter(c: char) -> String {
    if let Some((_, sign)) = SIGNS.iter().find(|(sign, _)| *sign == c) {
        return (*sign).into();
    }
    match c {
        '&' | '%' | '$' | '#' | '_' | '{' | '}' => format!("\\{c}"),
        // An empty line would end the cell.
        c if c.is_control() => " ".into(),
        // The old encoding does not have these.
        'Ð' | 'Þ' | 'ð' | 'þ' => "?".into(),
        // Letters with accents; the signs before them ask for packages.
        ' '..='~' | 'À'..='ÿ' => c.into(),
        _ => "?".into(),
    }
}

#[cfg(test)]
mod tests {
    use super::escaped;

    #[test]
    fn names_are_no_commands() {
        assert_eq!(escaped("a_b\\input{x} 1.2 ± 0.1"), "a\\_b\\textbackslash{}input\\{x\\} 1.2 $\\pm$ 0.1");
        assert_eq!(escaped("a--b\n\n[x]"), "a-{}-b  [x]");
        assert_eq!((escaped("[x]"), escaped("1 [2]")), ("{}[x]".into(), "1 [2]".into()));
        assert_eq!(escaped("é λ 中"), "é $\\lambda$ ?");
    }
}
