//! Eight f64 numbers that go the same way, and vectors of them. Operation by operation what glam does with
//! one, so that the bits are the same.

use crate::scanlines::LANES;
use glam::DVec3;
use std::ops::{Add, Div, Mul, Sub};

#[derive(Clone, Copy)]
#[repr(align(64))]
pub(crate) struct Wide(pub(crate) [f64; LANES]);

#[derive(Clone, Copy)]
pub(crate) struct Wide3 {
    pub(crate) x: Wide,
    pub(crate) y: Wide,
    pub(crate) z: Wide,
}

macro_rules! each {
    ($op:ident, $name:ident, $sign:tt) => {
        impl $op for Wide {
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

impl Wide {
    #[inline(always)]
    pub(crate) fn all(value: f64) -> Self {
        Self([value; LANES])
    }

    #[inline(always)]
    pub(crate) fn sqrt(self) -> Self {
        let mut out = self.0;
        for lane in &mut out {
            *lane = lane.sqrt();
        }
        Self(out)
    }
}

impl Wide3 {
    pub(crate) const ZERO: Self =
        Self { x: Wide([0.0; LANES]), y: Wide([0.0; LANES]), z: Wide([0.0; LANES]) };

    #[inline(always)]
    pub(crate) fn all(v: DVec3) -> Self {
        Self { x: Wide::all(v.x), y: Wide::all(v.y), z: Wide::all(v.z) }
    }

    #[inline(always)]
    pub(crate) fn set(&mut self, lane: usize, v: DVec3) {
        (self.x.0[lane], self.y.0[lane], self.z.0[lane]) = (v.x, v.y, v.z);
    }

    #[inline(always)]
    pub(crate) fn lane(&self, lane: usize) -> DVec3 {
        DVec3::new(self.x.0[lane], self.y.0[lane], self.z.0[lane])
    }

    #[inline(always)]
    pub(crate) fn dot(self, other: Self) -> Wide {
        self.x * other.x + self.y * other.y + self.z * other.z
    }

    #[inline(always)]
    pub(crate) fn cross(self, other: Self) -> Self {
        Self {
            x: self.y * other.z - other.y * self.z,
            y: self.z * other.x - other.z * self.x,
            z: self.x * other.y - other.x * self.y,
        }
    }
}

impl Add for Wide3 {
    type Output = Self;
    #[inline(always)]
    fn add(self, other: Self) -> Self {
        Self { x: self.x + other.x, y: self.y + other.y, z: self.z + other.z }
    }
}

impl Sub for Wide3 {
    type Output = Self;
    #[inline(always)]
    fn sub(self, other: Self) -> Self {
        Self { x: self.x - other.x, y: self.y - other.y, z: self.z - other.z }
    }
}

impl Mul<Wide> for Wide3 {
    type Output = Self;
    #[inline(always)]
    fn mul(self, other: Wide) -> Self {
        Self { x: self.x * other, y: self.y * other, z: self.z * other }
    }
}
