//! Layers before each sample, counted edge by edge.
//!
//! On each row an edge changes the number of layers before all samples on its right. Vertices belong to edges by
//! half-open ranges across the rows, so that the outline of a triangle counts each sample 0 or 1 times.

#[cfg(target_arch = "x86_64")]
mod avx2;
mod portable;

use super::edges::Seen;
use super::eight::{Eight, LANES, bytes};
use super::frame::{Cone, Frame, Turn};
use super::lines::{Lines, REPLICATES, RISE, Row, Ruling};
use super::outline::MARGIN;
use portable::Portable;

/// For each bit that is set.
macro_rules! for_each {
    ($bits:expr, $lane:ident => $body:block) => {
        let mut bits: u32 = $bits;
        while bits != 0 {
            let $lane = bits.trailing_zeros() as usize;
            bits &= bits - 1;
            $body
        }
    };
}

/// Samples of a row that fit into a word, a byte each.
const PER_WORD: usize = 8;

/// Words of a row, at most.
const MOST_WORDS: usize = 4;

/// What a byte may hold before it is moved on, either sign.
const MOST: u8 = 127;

/// A byte in each of a word's.
const EACH: u64 = 0x0101_0101_0101_0101;

/// Of a row: the replicates in `ORDER`, eight samples of each.
#[derive(Clone, Copy)]
#[repr(align(64))]
struct Bytes([u8; REPLICATES * PER_WORD]);

/// In which AVX2 unpacks the lanes of a register.
const ORDER: [usize; REPLICATES] = [0, 1, 4, 5, 2, 3, 6, 7];

/// Eight edges on the rows: `x = slope y + at` between two places across them.
struct Runs {
    slope: Eight,
    at: Eight,
    low: Eight,
    high: Eight,
    weight: [i32; LANES],
}

/// One of them.
#[derive(Clone, Copy)]
struct Run {
    slope: f32,
    at: f32,
    low: f32,
    high: f32,
    weight: i32,
}

impl Runs {
    #[inline(always)]
    fn run(&self, lane: usize) -> Run {
        let Self { slope, at, low, high, weight } = self;
        let ends = [low.0[lane], high.0[lane]];
        Run { slope: slope.0[lane], at: at.0[lane], low: ends[0], high: ends[1], weight: weight[lane] }
    }
}

/// What is done to a row, for a kind of registers. The same bits with any.
trait Registers: Copy {
    /// Adds an edge's weight where it crosses a row.
    fn before(self, run: &Run, row: &Row, layers: &mut [i32; REPLICATES]);

    /// Adds it to the samples after the edge; `half` a row's samples.
    fn across<const WORDS: usize>(
        self,
        run: &Run,
        row: &Row,
        place: (Option<&Cone>, f32),
        words: &mut [Bytes; WORDS],
    );

    /// Which of a row's samples have as many layers in `bytes` as make none together with `layers`: a byte for each
    /// replicate of `ORDER`.
    fn none(self, bytes: &Bytes, layers: &[i32; REPLICATES]) -> [u8; REPLICATES];
}

/// Rows of runs, one after the other: a loop over them all ends once, one over the few of each run would be guessed
/// wrong at most of its ends.
#[derive(Default)]
struct Steps {
    /// 256 times the run, and the row; what is beyond `count` is of no use.
    list: Vec<u32>,
    count: usize,
}

/// Layers before each sample of a receiver.
#[derive(Default)]
pub(super) struct Winding {
    runs: Vec<Runs>,
    /// Where a run may cross samples, and where it is before all of them.
    across: Steps,
    before: Steps,
    bytes: Vec<Bytes>,
    /// What the bytes of a row may hold by now.
    full: Vec<u8>,
    /// What did not fit into bytes; empty while all fits.
    more: Vec<[i32; REPLICATES * PER_WORD]>,
    words: usize,
    /// Layers before every sample of a row.
    rows: Vec<[i32; REPLICATES]>,
    /// Layers before every sample.
    all: i32,
}

impl Steps {
    #[inline(always)]
    fn add(&mut self, run: u32, first: u32, last: u32) {
        let count = last.saturating_sub(first);
        let mut step = run << 8 | first;
        // Always eight, most often more than there are.
        let end = self.count + count as usize;
        if self.list.len() < end + LANES {
            self.list.resize(2 * end + LANES, 0);
        }
        while self.count < end {
            for (k, into) in self.list[self.count..][..LANES].iter_mut().enumerate() {
                *into = step + k as u32;
            }
            self.count += LANES;
            step += LANES as u32;
        }
        self.count = end;
    }
}

impl Winding {
    #[inline(always)]
    pub(super) fn start(&mut self, ruling: &Ruling) {
        let [_, rows, per_row] = ruling.size();
        self.words = (per_row as usize).div_ceil(PER_WORD).clamp(1, MOST_WORDS);
        self.bytes.clear();
        self.bytes.resize(rows as usize * self.words, Bytes([0; REPLICATES * PER_WORD]));
        self.full.clear();
        self.full.resize(rows as usize, 0);
        self.more.clear();
        self.rows.clear();
        self.rows.resize(rows as usize, [0; REPLICATES]);
        self.all = 0;
        self.runs.clear();
        (self.across.count, self.before.count) = (0, 0);
    }

    /// Rows of edges so far.
    pub(super) fn steps(&self) -> usize {
        self.across.count + self.before.count
    }

    /// Takes what a receiver sees of eight edges.
    #[inline(always)]
    pub(super) fn add(
        &mut self,
        seen: &Seen,
        lines: &Lines,
        (frame, ruling, turn): (&Frame, &Ruling, &Turn),
    ) {
        let [p, q, r] = seen.line;
        let across = p * Eight::all(turn.xx) + q * Eight::all(turn.yx);
        let along = p * Eight::all(turn.xy) + q * Eight::all(turn.yy);
        // An edge along the rows becomes one that all but is.
        let least = Eight::all(1e-12) * (along.abs() + r.abs()) + Eight::all(f32::MIN_POSITIVE);
        let across = across.abs().max(least).signed_as(across);
        let per = -(Eight::all(1.0) / across);
        let (slope, at) = (along * per, r * per);
        // Ends in the rows' coordinates: the turn's inverse, whose determinant is 1.
        let from = turned(turn, &seen.from);
        let to = turned(turn, &seen.to);
        let (low, high) = (from[1].min(to[1]), from[1].max(to[1]));
        let (left, right) = (from[0].min(to[0]), from[0].max(to[0]));
        let rising = from[1].below(to[1]);
        // Off the light on the right nothing changes.
        let away = Eight::all(1.0 + MARGIN).below(left);
        // Off it on the left every sample of a row has the layer; rows all lie within this.
        let end = Eight::all(1.0 + 2.0 * RISE as f32 / ruling.rows as f32 + MARGIN);
        let before = right.below(Eight::all(-1.0 - MARGIN));
        let beyond = before.and(low.below(-end)).and(end.below(high));
        let [rising, away, before, beyond] = bytes([rising, away, before, beyond]);
        let [first, last] = frame.rows(ruling, low, high);
        let mut weight = seen.weight;
        for lane in 0..LANES {
            weight[lane] = if rising >> lane & 1 != 0 { weight[lane] } else { -weight[lane] };
        }
        let some = nonzero(weight) & !away;
        for_each!(some & beyond, lane => { self.all += i32::from(weight[lane]) });
        let some = some & !beyond;
        let first_run = (LANES * self.runs.len()) as u32;
        self.runs.push(Runs { slope, at, low, high, weight: weight.map(i32::from) });
        let rows = lines.rows.len() as u32;
        for_each!(some & before, lane => {
            self.before.add(first_run + lane as u32, first[lane], last[lane].min(rows));
        });
        for_each!(some & !before, lane => {
            self.across.add(first_run + lane as u32, first[lane], last[lane].min(rows));
        });
    }

    /// Hides the samples that have a layer before them.
    #[inline(always)]
    pub(super) fn hide(&mut self, lines: &mut Lines, frame: &Frame) {
        #[cfg(target_arch = "x86_64")]
        if let Some(simd) = pulp::x86::V3::try_new() {
            return self.hide_with(simd, lines, frame);
        }
        self.hide_with(Portable, lines, frame);
    }

    #[inline(always)]
    fn hide_with(&mut self, registers: impl Registers, lines: &mut Lines, frame: &Frame) {
        for &step in &self.before.list[..self.before.count] {
            let (run, j) = (self.run(step), step as usize & 0xff);
            registers.before(&run, &lines.rows[j], &mut self.rows[j]);
        }
        match self.words {
            1 => self.cross::<1>(registers, lines, frame),
            2 => self.cross::<2>(registers, lines, frame),
            3 => self.cross::<3>(registers, lines, frame),
            _ => self.cross::<MOST_WORDS>(registers, lines, frame),
        }
        self.mark(registers, lines);
    }

    #[inline(always)]
    fn run(&self, step: u32) -> Run {
        let run = step as usize >> 8;
        self.runs[run / LANES].run(run % LANES)
    }

    /// Adds all edges that may cross samples.
    #[inline(always)]
    fn cross<const WORDS: usize>(&mut self, registers: impl Registers, lines: &Lines, frame: &Frame) {
        let half = 0.5 * lines.per_row;
        for i in 0..self.across.count {
            let step = self.across.list[i];
            let (run, j) = (self.run(step), step as usize & 0xff);
            let weight = run.weight.unsigned_abs() as u8;
            let full = self.full[j] + weight;
            self.full[j] = full;
            if full > MOST {
                self.spill(j);
                self.full[j] = weight;
            }
            let words = &mut self.bytes.as_chunks_mut::<WORDS>().0[j];
            registers.across(&run, &lines.rows[j], (frame.cone.as_ref(), half), words);
        }
    }

    /// Makes room in the bytes of a row.
    #[cold]
    fn spill(&mut self, row: usize) {
        self.more.resize(self.bytes.len(), [0; REPLICATES * PER_WORD]);
        for at in row * self.words..(row + 1) * self.words {
            for (more, byte) in self.more[at].iter_mut().zip(&mut self.bytes[at].0) {
                *more += i32::from(*byte as i8);
                *byte = 0;
            }
        }
    }

    #[inline(always)]
    fn mark(&self, registers: impl Registers, lines: &mut Lines) {
        for (j, row) in lines.rows.iter_mut().enumerate() {
            let layers = self.rows[j].map(|layers| layers + self.all);
            for w in 0..self.words {
                let at = j * self.words + w;
                let none = match self.more.get(at) {
                    None => registers.none(&self.bytes[at], &layers),
                    Some(more) => none(&self.bytes[at], more, &layers),
                };
                for (&k, none) in ORDER.iter().zip(none) {
                    row.hidden[k] |= u32::from(!none) << (w * PER_WORD);
                }
            }
        }
    }
}

/// The samples without layers where some did not fit into bytes.
#[cold]
fn none(bytes: &Bytes, more: &[i32; REPLICATES * PER_WORD], layers: &[i32; REPLICATES]) -> [u8; REPLICATES] {
    let mut none = [0; REPLICATES];
    for (i, (byte, more)) in bytes.0.iter().zip(more).enumerate() {
        let all = more + i32::from(*byte as i8) + layers[ORDER[i / PER_WORD]];
        none[i / PER_WORD] |= u8::from(all == 0) << (i % PER_WORD);
    }
    none
}

/// A bit for each that is not 0.
#[inline(always)]
fn nonzero(bytes: [i8; LANES]) -> u32 {
    const LOW: u64 = 0x7f7f_7f7f_7f7f_7f7f;
    let word = u64::from_le_bytes(bytes.map(|byte| byte as u8));
    // The highest bit of each byte, gathered in the highest byte.
    let bits = ((word & LOW).wrapping_add(LOW) | word) & !LOW;
    ((bits >> 7).wrapping_mul(0x0102_0408_1020_4080) >> 56) as u32
}

/// In the rows' coordinates.
#[inline(always)]
fn turned(turn: &Turn, [x, y]: &[Eight; 2]) -> [Eight; 2] {
    [
        Eight::all(turn.yy) * *x - Eight::all(turn.xy) * *y,
        Eight::all(-turn.yx) * *x + Eight::all(turn.xx) * *y,
    ]
}

#[cfg(all(test, target_arch = "x86_64"))]
mod tests {
    use super::*;
    use crate::aim::Aim;
    use crate::owen::{mix, unit};
    use crate::receiver::Receiver;
    use glam::{DVec3, Vec3};
    use pulp::x86::V3;
    use umbrage_scene::AreaLight;

    fn cone(radians: f32) -> Option<Cone> {
        let receiver = Receiver::in_air(DVec3::ZERO);
        let sun = AreaLight::Sun { direction_to_light: Vec3::Y, angular_diameter_radians: radians };
        Frame::new(&receiver, &Aim::new(&sun, &receiver)?)?.cone
    }

    fn same<const WORDS: usize>(simd: V3, cone: Option<Cone>, mut random: impl FnMut() -> f32) {
        let mut words = [[Bytes([0; REPLICATES * PER_WORD]); WORDS]; 2];
        let mut layers = [[0; REPLICATES]; 2];
        for step in 0..400 {
            let mut row = Row::default();
            for k in 0..REPLICATES {
                (row.y.0[k], row.cos.0[k], row.shift.0[k]) =
                    (random(), 1.0 - 0.1 * random().abs(), random().abs());
            }
            let (low, high) = (random(), random());
            // Slopes of all sizes, edges beyond either side, ends at a row.
            let slope = 3.0 * random() / random();
            let low = if step % 8 == 0 { row.y.0[step / 8 % REPLICATES] } else { low.min(high) };
            let run =
                Run { slope, at: 2.0 * random(), low, high: low.max(high), weight: step as i32 % 5 - 2 };
            Portable.before(&run, &row, &mut layers[0]);
            simd.before(&run, &row, &mut layers[1]);
            let half = 4.0 * WORDS as f32;
            Portable.across(&run, &row, (cone.as_ref(), half), &mut words[0]);
            simd.across(&run, &row, (cone.as_ref(), half), &mut words[1]);
            assert_eq!(layers[0], layers[1], "step {step}");
            for (a, b) in words[0].iter().zip(&words[1]) {
                assert_eq!(a.0, b.0, "step {step}, {WORDS} words");
                for shift in [-300, -1, 0, 1, 127, 128, 300] {
                    let layers = layers[0].map(|n| n % 7 + shift);
                    assert_eq!(
                        Portable.none(a, &layers),
                        simd.none(b, &layers),
                        "step {step}, {shift} layers"
                    );
                }
            }
        }
        assert!(layers[0].iter().any(|&n| n != 0) && words[0][0].0.iter().any(|&n| n != 0));
    }

    /// With AVX2 and without: the same bytes. A processor without it has nothing to compare.
    #[test]
    fn registers_do_not_matter() {
        let Some(simd) = V3::try_new() else { return };
        let mut state = 5;
        let mut random = || {
            state = mix(state);
            2.0 * unit(state as u32) - 1.0
        };
        for cone in [None, cone(0.05), cone(1.5)] {
            same::<1>(simd, cone, &mut random);
            same::<2>(simd, cone, &mut random);
            same::<3>(simd, cone, &mut random);
            same::<MOST_WORDS>(simd, cone, &mut random);
        }
    }
}
