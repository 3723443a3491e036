//! Names may hold anything; each format has its own way to say so.

/// A field of RFC 4180: quoted when it has to be, quotes doubled.
pub(crate) fn csv(field: &str) -> String {
    if field.contains([',', '"', '\n', '\r']) {
        format!("\"{}\"", field.replace('"', "\"\""))
    } else {
        field.into()
    }
}

fn is_xml(c: &char) -> bool {
    !matches!(c, '\0'..='\u{8}' | '\u{b}' | '\u{c}' | '\u{e}'..='\u{1f}' | '\u{fffe}' | '\u{ffff}')
}

/// Markup without the characters that XML cannot hold at all.
pub(crate) fn legal_xml(markup: &str) -> String {
    markup.chars().filter(is_xml).collect()
}

/// Text or an attribute of XML 1.0; characters that XML cannot hold at all are dropped.
pub(super) fn xml(text: &str) -> String {
    let mut escaped = String::with_capacity(text.len());
    for c in text.chars().filter(is_xml) {
        match c {
            '&' => escaped += "&amp;",
            '<' => escaped += "&lt;",
            '>' => escaped += "&gt;",
            '"' => escaped += "&quot;",
            '\'' => escaped += "&apos;",
            // Attributes would turn them into spaces.
            '\n' | '\r' | '\t' => escaped += &format!("&#{};", c as u32),
            c => escaped.push(c),
        }
    }
    escaped
}

/// A code span of Markdown (CommonMark 6.1): fenced by more backticks than stand together in it, on one line.
pub(crate) fn code(text: &str) -> String {
    let text = text.replace(['\n', '\r'], " ");
    let longest = text.split(|c| c != '`').map(str::len).max().unwrap_or(0);
    let fence = "`".repeat(longest + 1);
    let room = if text.starts_with('`') || text.ends_with('`') { " " } else { "" };
    format!("{fence}{room}{text}{room}{fence}")
}

/// Text in a paragraph or a cell of Markdown: no markup, no links, no HTML, one line.
pub(crate) fn markdown(text: &str) -> String {
    let mut escaped = String::with_capacity(text.len());
    for c in text.chars() {
        match c {
            '&' => escaped += "&amp;",
            '<' => escaped += "&lt;",
            '>' => escaped += "&gt;",
            '\\' | '`' | '*' | '_' | '[' | ']' | '|' | '~' | '#' | '@' | '!' => {
                escaped.push('\\');
                escaped.push(c);
            }
            c if c.is_control() => escaped.push(' '),
            c => escaped.push(c),
        }
    }
    escaped
}

#[cfg(test)]
mod tests {
    use super::*;

    const HOSTILE: &str = "<script>alert(1)</script>&\"'";

    #[test]
    fn hostile_names_are_harmless_everywhere() {
        assert_eq!(xml(HOSTILE), "&lt;script&gt;alert(1)&lt;/script&gt;&amp;&quot;&apos;");
        assert_eq!(xml("a\u{0}\u{1b}b\n"), "ab&#10;");
        assert_eq!(markdown(HOSTILE), "&lt;script&gt;alert(1)&lt;/script&gt;&amp;\"'");
        assert_eq!(markdown("a|b\n[x](y)"), "a\\|b \\[x\\](y)");
        assert_eq!(csv(HOSTILE), "\"<script>alert(1)</script>&\"\"'\"");
        assert_eq!(csv("plain"), "plain");
    }
}
