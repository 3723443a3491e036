//! What a user's technique answered, before anything is scored.

use crate::{Shaded, ShadowError, VariantId};
use umbrage_device::DeviceError;

/// How far beyond 0 and 1 a fraction may lie: sums of a thousand taps in f32 round by 1e-4 at most.
const ROUNDING: f32 = 1e-4;

/// The result of a variant's run; for a user's own it is an error where a value is no fraction, and a
/// driver that did not answer is put down to the file.
pub(crate) fn judged(variant: VariantId, result: Result<Shaded, ShadowError>) -> Result<Shaded, ShadowError> {
    let Some(file) = variant.variant.technique.own_file() else { return result };
    let name = || variant.variant.name.to_string();
    match result {
        Ok(shaded) => match told(&shaded.values) {
            None => Ok(shaded),
            Some(what) => Err(ShadowError::Value { name: name(), file: file.into(), what }),
        },
        Err(ShadowError::Device(DeviceError::Timeout { secs })) => {
            Err(ShadowError::Endless { name: name(), file: file.into(), secs })
        }
        Err(other) => Err(other),
    }
}

/// What is wrong with values, if anything.
fn told(values: &[f32]) -> Option<String> {
    let is_fraction = |v: f32| (-ROUNDING..=1.0 + ROUNDING).contains(&v);
    let mut wrong = values.iter().enumerate().filter(|(_, v)| !is_fraction(**v));
    let (index, value) = wrong.next()?;
    let more = wrong.count();
    Some(format!("{value} at receiver {index} of {} and {more} more like it", values.len()))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Own;

    fn judged_as(result: Result<Vec<f32>, ShadowError>) -> Result<Shaded, String> {
        let text = "//! name = \"mine\"\nfn shade(r: Receiver) -> f32 { return 1.0; }\n";
        let own = Own::read("mine.wgsl", text.into()).and_then(Own::into_variant).expect("valid");
        let shaded = result.map(|values| Shaded { values, timings: vec![] });
        judged(own, shaded).map_err(|e| e.to_string())
    }

    #[test]
    fn fractions_pass_and_rounding_with_them() {
        assert!(judged_as(Ok(vec![0.0, 0.5, 1.0, 1.0 + 1e-6, -1e-6])).is_ok());
    }

    #[test]
    fn what_is_no_fraction_is_put_down_to_the_file() {
        for value in [f32::NAN, f32::INFINITY, -0.5, 1.5] {
            let error = judged_as(Ok(vec![0.0, value])).expect_err("no fraction");
            assert!(
                error.starts_with(&format!("mine (mine.wgsl) returned {value} at receiver 1")),
                "{error}"
            );
        }
    }

    #[test]
    fn a_driver_that_does_not_answer_is_put_down_to_the_file() {
        let timeout = ShadowError::Device(DeviceError::Timeout { secs: 7 });
        let error = judged_as(Err(timeout)).expect_err("a timeout");
        assert!(error.starts_with("mine (mine.wgsl) did not finish a frame within 7 s"), "{error}");
    }
}
