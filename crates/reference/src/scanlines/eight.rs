//! Eight numbers that go the same way. Each operation is a loop over lanes that compiles to wide
//! registers where the caller is compiled for them.

use std::ops::{Add, Div, Mul, Neg, Sub};

pub(crate) const LANES: usize = 8;

#[derive(Clone, Copy, Default)]
#[repr(align(32))]
pub(crate) struct Eight(pub(crate) [f32; LANES]);

/// All bits of a lane set, or none.
#[derive(Clone, Copy)]
#[repr(align(32))]
pub(crate) struct Mask([u32; LANES]);

macro_rules! each_lane {
    ($lanes:expr, $a:ident => $value:expr) => {{
        let lanes = $lanes;
        let mut out = [0.0; LANES];
        for k in 0..LANES {
            let $a = lanes[k];
            out[k] = $value;
        }
        Self(out)
    }};
}

macro_rules! each {
    ($op:ident, $name:ident, $sign:tt) => {
        impl $op for Eight {
            type Output = Self;
            #[inline(always)]
            fn $name(self, other: Self) -> Self {
                let mut out = [0.0; LANES];
                for k in 0..LANES {
                    out[k] = self.0[k] $sign other.0[k];
                }
                Self(out)
            }
        }
    };
}
each!(Add, add, +);
each!(Sub, sub, -);
each!(Mul, mul, *);
each!(Div, div, /);

impl Neg for Eight {
    type Output = Self;
    #[inline(always)]
    fn neg(self) -> Self {
        each_lane!(self.0, a => -a)
    }
}

impl Eight {
    #[inline(always)]
    pub(crate) fn all(value: f32) -> Self {
        Self([value; LANES])
    }

    #[inline(always)]
    pub(crate) fn abs(self) -> Self {
        each_lane!(self.0, a => a.abs())
    }

    #[inline(always)]
    pub(crate) fn sqrt(self) -> Self {
        each_lane!(self.0, a => a.sqrt())
    }

    #[inline(always)]
    pub(crate) fn min(self, other: Self) -> Self {
        let mut out = [0.0; LANES];
        for k in 0..LANES {
            out[k] = if self.0[k] < other.0[k] { self.0[k] } else { other.0[k] };
        }
        Self(out)
    }

    #[inline(always)]
    pub(crate) fn max(self, other: Self) -> Self {
        let mut out = [0.0; LANES];
        for k in 0..LANES {
            out[k] = if self.0[k] > other.0[k] { self.0[k] } else { other.0[k] };
        }
        Self(out)
    }

    #[inline(always)]
    pub(crate) fn below(self, other: Self) -> Mask {
        let mut out = [0; LANES];
        for k in 0..LANES {
            out[k] = if self.0[k] < other.0[k] { u32::MAX } else { 0 };
        }
        Mask(out)
    }

    /// This, negated where `sign` is negative.
    #[inline(always)]
    pub(crate) fn signed_as(self, sign: Self) -> Self {
        let mut out = [0.0; LANES];
        for k in 0..LANES {
            out[k] = f32::from_bits(self.0[k].to_bits() ^ (sign.0[k].to_bits() & 0x8000_0000));
        }
        Self(out)
    }

    /// Whole numbers below, from 0 to 255.
    #[inline(always)]
    pub(crate) fn floor(self) -> [u32; LANES] {
        let held = self.max(Self::all(0.0)).min(Self::all(255.0));
        let mut out = [0; LANES];
        for k in 0..LANES {
            out[k] = (held.0[k].floor() + 8_388_608.0).to_bits() & 0xff;
        }
        out
    }

    /// The number of samples before each place, at most 32.
    #[inline(always)]
    pub(crate) fn number(self) -> [u32; LANES] {
        let place = self.max(Self::all(0.0)).min(Self::all(32.0));
        let place = each_lane!(place.0, a => a.ceil());
        let mut out = [0; LANES];
        for k in 0..LANES {
            // The sum's lowest bits are the number.
            out[k] = (place.0[k] + 8_388_608.0).to_bits() & 0x3f;
        }
        out
    }

    /// The number of samples before each place, as the lowest bits of a mask.
    #[inline(always)]
    pub(crate) fn before(self) -> [u32; LANES] {
        let number = self.number();
        let mut out = [0; LANES];
        for k in 0..LANES {
            out[k] = 1u32.unbounded_shl(number[k]).wrapping_sub(1);
        }
        out
    }
}

impl Mask {
    #[inline(always)]
    pub(crate) fn not(self) -> Self {
        let mut out = [0; LANES];
        for k in 0..LANES {
            out[k] = !self.0[k];
        }
        Self(out)
    }

    #[inline(always)]
    pub(crate) fn or(self, other: Self) -> Self {
        let mut out = [0; LANES];
        for k in 0..LANES {
            out[k] = self.0[k] | other.0[k];
        }
        Self(out)
    }

    #[inline(always)]
    pub(crate) fn and(self, other: Self) -> Self {
        let mut out = [0; LANES];
        for k in 0..LANES {
            out[k] = self.0[k] & other.0[k];
        }
        Self(out)
    }

    #[inline(always)]
    pub(crate) fn same(self, other: Self) -> Self {
        let mut out = [0; LANES];
        for k in 0..LANES {
            out[k] = !(self.0[k] ^ other.0[k]);
        }
        Self(out)
    }

    /// `yes` where the lane is set, `no` elsewhere.
    #[inline(always)]
    pub(crate) fn pick(self, yes: Eight, no: Eight) -> Eight {
        let mut out = [0.0; LANES];
        for k in 0..LANES {
            out[k] = if self.0[k] != 0 { yes.0[k] } else { no.0[k] };
        }
        Eight(out)
    }

    /// Whether any lane is set.
    #[inline(always)]
    pub(crate) fn any(self) -> bool {
        let mut all = 0;
        for k in 0..LANES {
            all |= self.0[k];
        }
        all != 0
    }

    /// `yes` where the lane is set, `no` elsewhere.
    #[inline(always)]
    pub(crate) fn pick_words(self, yes: u32, no: [u32; LANES]) -> [u32; LANES] {
        let mut out = [0; LANES];
        for k in 0..LANES {
            out[k] = if self.0[k] != 0 { yes } else { no[k] };
        }
        out
    }

    /// A bit for each lane.
    #[inline(always)]
    pub(crate) fn bits(self) -> u32 {
        bytes([self, self, self, self])[0]
    }
}

/// A bit for each lane of four masks.
#[inline(always)]
pub(crate) fn bytes(masks: [Mask; 4]) -> [u32; 4] {
    let mut lanes = [0; LANES];
    for k in 0..LANES {
        let low = masks[0].0[k] & 0xff | masks[1].0[k] & 0xff00;
        let high = masks[2].0[k] & 0x00ff_0000 | masks[3].0[k] & 0xff00_0000;
        lanes[k] = (low | high) & 0x0101_0101 << k;
    }
    let mut all = 0;
    for k in 0..LANES {
        all |= lanes[k];
    }
    [all & 0xff, all >> 8 & 0xff, all >> 16 & 0xff, all >> 24]
}
