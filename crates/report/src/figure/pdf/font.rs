//! The font of PDF figures, embedded whole: journals want no font that is not in the file.

use pdf_writer::types::{CidFontType, FontFlags, SystemInfo, UnicodeCmap};
use pdf_writer::{Filter, Finish as _, Name, Pdf, Rect, Ref, Str};
use std::collections::BTreeMap;
use ttf_parser::Face;

/// Roboto, with letters and signs that names of variants are likely to have: see the README beside it.
const FILE: &[u8] = include_bytes!("../font/roboto-subset.ttf");
/// Six capitals before the name say that it is a part of a font.
const NAME: Name = Name(b"UMBRAG+Roboto-Regular");
/// Drawn for what the font does not have.
const UNKNOWN: char = '\u{fffd}';
const IDENTITY: SystemInfo =
    SystemInfo { registry: Str(b"Adobe"), ordering: Str(b"Identity"), supplement: 0 };

/// The font, and which of its glyphs were used for which letters.
pub(super) struct Font {
    face: Face<'static>,
    used: BTreeMap<u16, char>,
}

/// Where the font's objects are in the file.
pub(super) struct FontRefs {
    pub(super) font: Ref,
    pub(super) descendant: Ref,
    pub(super) descriptor: Ref,
    pub(super) file: Ref,
    pub(super) unicode: Ref,
}

impl Font {
    pub(super) fn new() -> Result<Self, String> {
        let face = Face::parse(FILE, 0).map_err(|e| e.to_string())?;
        Ok(Self { face, used: BTreeMap::new() })
    }

    /// Text as two bytes a glyph, and its width in units of the font's size.
    pub(super) fn set(&mut self, text: &str) -> (Vec<u8>, f32) {
        let (mut bytes, mut width) = (Vec::new(), 0.0);
        for c in text.chars() {
            let known = self.face.glyph_index(c).map(|glyph| (glyph, c));
            let other = || self.face.glyph_index(UNKNOWN).map(|glyph| (glyph, UNKNOWN));
            let Some((glyph, c)) = known.or_else(other) else { continue };
            self.used.insert(glyph.0, c);
            bytes.extend(glyph.0.to_be_bytes());
            width += self.per_em(self.face.glyph_hor_advance(glyph).unwrap_or(0)) / 1000.0;
        }
        (bytes, width)
    }

    /// Thousandths of the font's size, as PDF counts.
    fn per_em(&self, units: impl Into<f32>) -> f32 {
        1000.0 * units.into() / f32::from(self.face.units_per_em())
    }

    /// Writes the font's objects.
    pub(super) fn write(&self, pdf: &mut Pdf, refs: &FontRefs) {
        let mut font = pdf.type0_font(refs.font);
        font.base_font(NAME).encoding_predefined(Name(b"Identity-H"));
        font.descendant_font(refs.descendant).to_unicode(refs.unicode);
        font.finish();

        let mut descendant = pdf.cid_font(refs.descendant);
        descendant.subtype(CidFontType::Type2).base_font(NAME).system_info(IDENTITY);
        descendant.font_descriptor(refs.descriptor).cid_to_gid_map_predefined(Name(b"Identity"));
        let advance = |glyph| self.face.glyph_hor_advance(ttf_parser::GlyphId(glyph)).unwrap_or(0);
        let widths = (0..self.face.number_of_glyphs()).map(|glyph| self.per_em(advance(glyph)));
        descendant.widths().consecutive(0, widths);
        descendant.finish();

        let bounds = self.face.global_bounding_box();
        let [left, bottom, right, top] =
            [bounds.x_min, bounds.y_min, bounds.x_max, bounds.y_max].map(|v| self.per_em(v));
        let mut descriptor = pdf.font_descriptor(refs.descriptor);
        descriptor.name(NAME).flags(FontFlags::SYMBOLIC).bbox(Rect::new(left, bottom, right, top));
        descriptor.italic_angle(0.0).ascent(self.per_em(self.face.ascender()));
        descriptor.descent(self.per_em(self.face.descender()));
        descriptor.cap_height(self.per_em(self.face.capital_height().unwrap_or(1456)));
        // Thickness of upright stems: readers use it only where the font is missing, and it is not.
        descriptor.stem_v(80.0).font_file2(refs.file);
        descriptor.finish();

        let packed = super::deflated(FILE);
        let mut file = pdf.stream(refs.file, &packed);
        file.filter(Filter::FlateDecode);
        file.pair(Name(b"Length1"), FILE.len() as i32);
        file.finish();

        // What the glyphs mean, so that text can be searched and copied.
        let mut unicode = UnicodeCmap::<u16>::new(Name(b"Letters"), IDENTITY);
        self.used.iter().for_each(|(&glyph, &c)| unicode.pair(glyph, c));
        pdf.cmap(refs.unicode, &unicode.finish());
    }
}
