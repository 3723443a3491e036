//! The numbers that a header's constants are.

use std::fmt;
use toml::Value;

/// WGSL's own abstract numbers: they become what the place where they are used asks for.
#[derive(Clone, Copy, PartialEq)]
pub(super) enum Number {
    /// Fits `i32`, `u32` or `f32`.
    Integer(i64),
    /// Fits `f32`.
    Float(f64),
}

impl Number {
    /// A TOML value.
    pub(super) fn of(value: &Value) -> Result<Self, String> {
        match value {
            Value::Integer(whole) => Self::Integer(*whole).in_range(),
            Value::Float(number) => Self::Float(*number).in_range(),
            other => Err(format!("a constant is a number, not a {}", other.type_str())),
        }
    }

    /// A value of the same kind, from text; a float takes whole numbers too.
    pub(super) fn like(self, text: &str) -> Result<Self, String> {
        let whole = || text.parse().map(Self::Integer).map_err(|_| format!("\"{text}\" is no whole number"));
        let float = || text.parse().map(Self::Float).map_err(|_| format!("\"{text}\" is no number"));
        match self {
            Self::Integer(_) => whole()?.in_range(),
            Self::Float(_) => float()?.in_range(),
        }
    }

    fn in_range(self) -> Result<Self, String> {
        let fits = match self {
            Self::Integer(whole) => (i64::from(i32::MIN)..=i64::from(u32::MAX)).contains(&whole),
            Self::Float(number) => (number as f32).is_finite(),
        };
        if fits { Ok(self) } else { Err(format!("{self} does not fit 32 bits")) }
    }
}

impl fmt::Display for Number {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Integer(whole) => write!(f, "{whole}"),
            // With a point or an exponent, whatever the value.
            Self::Float(number) => write!(f, "{number:?}"),
        }
    }
}
