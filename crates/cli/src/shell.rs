//! Command lines that can be copied into a shell.

/// Words as a line, each quoted where it has to be.
pub(crate) fn line(words: impl IntoIterator<Item = String>) -> String {
    words.into_iter().map(|word| quoted(&word)).collect::<Vec<_>>().join(" ")
}

/// A word as a shell takes it.
pub(crate) fn quoted(word: &str) -> String {
    let plain = word.chars().all(|c| c.is_ascii_alphanumeric() || "-_./=+,:".contains(c));
    if plain && !word.is_empty() { word.into() } else { format!("'{}'", word.replace('\'', "'\\''")) }
}

/// A line of [`line()`] without some flags and their values.
pub(crate) fn without(line: &str, flags: &[&str]) -> String {
    let mut kept = Vec::new();
    let mut all = words(line).into_iter();
    while let Some(word) = all.next() {
        let name = word.split('=').next().unwrap_or_default();
        if !flags.contains(&name) {
            kept.push(word);
        } else if name.len() == word.len() {
            all.next();
        }
    }
    self::line(kept)
}

/// A line of [`line()`] with those values of a flag alone that are wanted.
pub(crate) fn keeping(line: &str, flag: &str, is_wanted: impl Fn(&str) -> bool) -> String {
    let mut kept = Vec::new();
    let mut all = words(line).into_iter();
    while let Some(word) = all.next() {
        match word.strip_prefix(flag) {
            Some("") => {
                if let Some(value) = all.next().filter(|value| is_wanted(value)) {
                    kept.extend([word, value]);
                }
            }
            Some(rest) if rest.strip_prefix('=').is_some_and(|value| !is_wanted(value)) => {}
            _ => kept.push(word),
        }
    }
    self::line(kept)
}

/// The words that a line of [`line()`] was made of.
fn words(line: &str) -> Vec<String> {
    let (mut words, mut word, mut inside, mut any) = (Vec::new(), String::new(), false, false);
    let mut letters = line.chars();
    while let Some(letter) = letters.next() {
        match letter {
            '\'' => (inside, any) = (!inside, true),
            '\\' if !inside => word.extend(letters.next()),
            ' ' if !inside => {
                if any || !word.is_empty() {
                    words.push(std::mem::take(&mut word));
                }
                any = false;
            }
            letter => word.push(letter),
        }
    }
    if any || !word.is_empty() {
        words.push(word);
    }
    words
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_quoted_comes_back() {
        let all = ["umbrage", "a scene", "it's", "", "--out=x y", "a=b"].map(String::from);
        assert_eq!(words(&line(all.clone())), all);
    }

    #[test]
    fn flags_go_with_their_values() {
        let line = "umbrage evaluate 'my scene' --out 'a b' --cache=c --quick --scene x";
        assert_eq!(without(line, &["--out", "--cache", "--scene"]), "umbrage evaluate 'my scene' --quick");
        assert_eq!(without("umbrage --out", &["--out"]), "umbrage");
        let line = "umbrage score --frames 'a b=x.##.exr' --frames=c=y.exr --frames d/z.exr --seeds 3";
        assert_eq!(
            keeping(line, "--frames", |v| v.starts_with("a b")),
            "umbrage score --frames 'a b=x.##.exr' --seeds 3"
        );
        assert_eq!(
            keeping(line, "--frames", |v| v.starts_with('c')),
            "umbrage score --frames=c=y.exr --seeds 3"
        );
    }
}
