//! The lines of an OBJ file as tobj is to see them: counted, joined where one continues, and
//! without what is not used here. tobj reads through this, so that an error has a line number.

use std::cell::{Cell, RefCell};
use std::collections::BTreeMap;
use std::io::{self, BufRead, Read};

/// What was met so far; shared with whoever started the reading.
#[derive(Debug, Default)]
pub(super) struct Counts {
    /// Lines read.
    pub(super) lines: Cell<usize>,
    /// Faces of more than four corners.
    pub(super) polygons: Cell<usize>,
    /// Materials of faces whose corners have no place in a picture, and the line of the first: tobj would give
    /// them the first place of the file.
    pub(super) bare: RefCell<BTreeMap<String, usize>>,
    material: RefCell<String>,
}

/// Serves one rewritten line at a time.
pub(super) struct Lines<'a> {
    rest: &'a [u8],
    counts: &'a Counts,
    kept: Kept,
    /// Rewritten, not yet handed over; only for readers that do not ask for lines.
    pending: Vec<u8>,
}

/// What of a corner is kept.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Kept {
    /// Its position: nobody asks for more, and a damaged texture coordinate is no reason to fail.
    Positions,
    /// Its place in a picture, too.
    Pictures,
}

impl<'a> Lines<'a> {
    pub(super) fn new(bytes: &'a [u8], counts: &'a Counts, kept: Kept) -> Self {
        Self { rest: bytes, counts, kept, pending: Vec::new() }
    }

    /// The next line with all its continuations; `None` at the end.
    fn next_line(&mut self) -> Option<String> {
        let mut line = String::new();
        loop {
            if self.rest.is_empty() {
                return (!line.is_empty()).then_some(line);
            }
            let end = self.rest.iter().position(|&byte| byte == b'\n').unwrap_or(self.rest.len());
            let (now, later) = self.rest.split_at(end);
            self.rest = later.get(1..).unwrap_or_default();
            self.counts.lines.set(self.counts.lines.get() + 1);
            let now = String::from_utf8_lossy(now);
            match now.trim().strip_suffix('\\') {
                Some(part) => line.extend([part, " "]),
                None => {
                    line.push_str(now.trim());
                    // A byte more than nothing: an empty line is not the end.
                    line.push('\n');
                    return Some(line);
                }
            }
        }
    }

    /// `v`, or `v/vt` of `v/vt/vn`.
    fn corner<'b>(&self, corner: &'b str) -> &'b str {
        let Some((position, rest)) = corner.split_once('/') else { return corner };
        let place = rest.split_once('/').map_or(rest, |(place, _)| place);
        match self.kept {
            Kept::Pictures if !place.is_empty() => &corner[..position.len() + 1 + place.len()],
            _ => position,
        }
    }

    /// A line without normals, colours, comments, points and curves.
    fn rewritten(&self, line: &str) -> String {
        let Some((keyword, rest)) = line.split_once(char::is_whitespace) else { return String::new() };
        let rest = rest.trim();
        match keyword {
            "v" => format!("v {}", coordinates(rest)),
            "f" => {
                let corners: Vec<&str> = rest.split_whitespace().map(|c| self.corner(c)).collect();
                self.counts.polygons.set(self.counts.polygons.get() + usize::from(corners.len() > 4));
                if self.kept == Kept::Pictures && corners.iter().any(|c| !c.contains('/')) {
                    let material = self.counts.material.borrow().clone();
                    self.counts.bare.borrow_mut().entry(material).or_insert(self.counts.lines.get());
                }
                format!("f {}", corners.join(" "))
            }
            "vt" if self.kept == Kept::Pictures => format!("vt {}", texture_coordinates(rest)),
            "o" | "g" => format!("{keyword} {rest}"),
            "usemtl" if !rest.is_empty() => {
                *self.counts.material.borrow_mut() = rest.to_owned();
                format!("usemtl {rest}")
            }
            "mtllib" if !rest.is_empty() => format!("{keyword} {rest}"),
            _ => String::new(),
        }
    }
}

/// u and v; v is 0 where it is left out.
fn texture_coordinates(rest: &str) -> String {
    let mut words = rest.split_whitespace();
    let (u, v) = (words.next().unwrap_or("0"), words.next().unwrap_or("0"));
    format!("{u} {v}")
}

/// The libraries that a file names.
pub(super) fn libraries(bytes: &[u8]) -> Vec<String> {
    let counts = Counts::default();
    let mut lines = Lines::new(bytes, &counts, Kept::Positions);
    let mut names = Vec::new();
    while let Some(line) = lines.next_line() {
        names.extend(line.strip_prefix("mtllib ").map(|name| name.trim().to_owned()));
    }
    names
}

/// x, y, z, and w if it is the only further number (else it is a colour).
fn coordinates(rest: &str) -> String {
    let words: Vec<&str> = rest.split_whitespace().collect();
    let kept = if words.len() == 4 { 4 } else { words.len().min(3) };
    words[..kept].join(" ")
}

impl BufRead for Lines<'_> {
    fn read_line(&mut self, to: &mut String) -> io::Result<usize> {
        let Some(line) = self.next_line() else { return Ok(0) };
        let rewritten = self.rewritten(&line);
        to.push_str(&rewritten);
        to.push('\n');
        Ok(rewritten.len() + 1)
    }

    fn fill_buf(&mut self) -> io::Result<&[u8]> {
        if self.pending.is_empty() {
            let mut line = String::new();
            self.read_line(&mut line)?;
            self.pending = line.into_bytes();
        }
        Ok(&self.pending)
    }

    fn consume(&mut self, amount: usize) {
        self.pending.drain(..amount.min(self.pending.len()));
    }
}

impl Read for Lines<'_> {
    fn read(&mut self, to: &mut [u8]) -> io::Result<usize> {
        let read = self.fill_buf()?.read(to)?;
        self.consume(read);
        Ok(read)
    }
}
