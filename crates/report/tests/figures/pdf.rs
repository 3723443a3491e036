//! A reader of our PDF files that shares nothing with their writer: enough to say what is on the page.

use flate2::read::ZlibDecoder;
use std::collections::BTreeMap;
use std::io::Read as _;

/// What is on the one page of a file.
pub(crate) struct Sheet {
    /// Each piece of text, by the letters that a reader copies.
    pub(crate) texts: Vec<String>,
    /// Operators, in order.
    pub(crate) operators: Vec<String>,
}

/// The page of a file, after a check of where its table says that objects are.
pub(crate) fn read(file: &[u8]) -> Sheet {
    assert!(file.starts_with(b"%PDF-"));
    let objects = objects(file);
    let all: Vec<String> = objects.values().map(|o| String::from_utf8_lossy(o).into_owned()).collect();
    assert_eq!(all.iter().filter(|o| o.contains("/Type /Page\n")).count(), 1, "one page");
    assert!(all.iter().any(|o| o.contains("/Count 1")));
    assert!(!all.iter().any(|o| o.contains("/Image")), "no pixels");
    assert!(all.iter().any(|o| o.contains("/FontFile2")), "the font is in the file");
    let page = all.iter().find(|o| o.contains("/Type /Page\n")).expect("a page");
    let letters = all.iter().find(|o| o.contains("begincmap")).expect("what glyphs mean");
    sheet(&stream(&objects[&reference(page, "/Contents ")]), &letters_of(letters))
}

/// The bytes of every object, found by the table at the end of the file.
fn objects(file: &[u8]) -> BTreeMap<usize, Vec<u8>> {
    let text = String::from_utf8_lossy(file);
    let start: usize =
        after(&text, "startxref").trim().lines().next().expect("a line").parse().expect("a place");
    assert!(file[start..].starts_with(b"xref"));
    let table = String::from_utf8_lossy(&file[start..]);
    let places = table.lines().skip(2).take_while(|line| line.len() >= 17).enumerate();
    let used = places.filter(|(_, line)| line.trim_end().ends_with('n'));
    let object = |(number, line): (usize, &str)| {
        let bytes = &file[line[..10].parse::<usize>().expect("a place")..];
        assert!(bytes.starts_with(format!("{number} 0 obj").as_bytes()), "object {number}");
        let end = bytes.windows(6).position(|w| w == b"endobj").expect("an end");
        (number, bytes[..end].to_vec())
    };
    used.map(object).collect()
}

fn after<'a>(text: &'a str, word: &str) -> &'a str {
    text.split(word).nth(1).unwrap_or_else(|| panic!("no {word}"))
}

fn reference(object: &str, key: &str) -> usize {
    after(object, key).split(' ').next().expect("a number").parse().expect("a number")
}

fn stream(object: &[u8]) -> Vec<u8> {
    let start = object.windows(7).position(|w| w == b"stream\n").expect("a stream") + 7;
    let mut plain = Vec::new();
    ZlibDecoder::new(&object[start..]).read_to_end(&mut plain).expect("deflated");
    plain
}

/// `<0024> <0041>`: glyph and letter.
fn letters_of(map: &str) -> BTreeMap<u16, char> {
    let pair = |line: &str| {
        let (glyph, letter) = line.strip_prefix('<')?.strip_suffix('>')?.split_once("> <")?;
        let hex = |text: &str| u16::from_str_radix(text, 16).ok();
        Some((hex(glyph)?, char::from_u32(hex(letter)?.into())?))
    };
    let body = after(map, "endcodespacerange");
    body.lines().filter_map(pair).collect()
}

fn sheet(content: &[u8], letters: &BTreeMap<u16, char>) -> Sheet {
    let (mut texts, mut operators, mut string) = (Vec::new(), Vec::new(), Vec::new());
    let mut at = 0;
    while at < content.len() {
        match content[at] {
            b'<' => {
                let end = at + content[at..].iter().position(|&c| c == b'>').expect("an end");
                let digits: Vec<u8> = content[at + 1..end].iter().map(|c| hex(*c)).collect();
                string = digits.chunks(2).map(|d| 16 * d[0] + d[1]).collect();
                at = end;
            }
            b'(' => (string, at) = literal(content, at),
            c if c.is_ascii_alphabetic() || c == b'/' => {
                let end =
                    at + content[at..].iter().position(u8::is_ascii_whitespace).unwrap_or(content.len() - at);
                let word = String::from_utf8_lossy(&content[at..end]).into_owned();
                if word == "Tj" {
                    let glyphs = string.chunks(2).map(|b| u16::from_be_bytes([b[0], b[1]]));
                    texts.push(glyphs.map(|g| letters[&g]).collect());
                }
                if !word.starts_with('/') {
                    operators.push(word);
                }
                at = end;
            }
            _ => {}
        }
        at += 1;
    }
    Sheet { texts, operators }
}

fn hex(digit: u8) -> u8 {
    char::from(digit).to_digit(16).expect("a digit") as u8
}

/// A string in brackets, and where it ends.
fn literal(content: &[u8], open: usize) -> (Vec<u8>, usize) {
    let (mut bytes, mut at, mut depth) = (Vec::new(), open + 1, 1);
    loop {
        let c = content[at];
        match c {
            b'\\' => {
                at += 1;
                let escaped = content[at];
                match escaped {
                    b'n' => bytes.push(b'\n'),
                    b'r' => bytes.push(b'\r'),
                    b't' => bytes.push(b'\t'),
                    b'b' => bytes.push(8),
                    b'f' => bytes.push(12),
                    b'0'..=b'7' => {
                        let digits = std::str::from_utf8(&content[at..at + 3]).expect("digits");
                        bytes.push(u8::from_str_radix(digits, 8).expect("octal"));
                        at += 2;
                    }
                    other => bytes.push(other),
                }
            }
            b')' if depth == 1 => return (bytes, at),
            b'(' | b')' => {
                depth += if c == b'(' { 1 } else { -1 };
                bytes.push(c);
            }
            c => bytes.push(c),
        }
        at += 1;
    }
}
