//! A technique whose recording is changed before it runs: to read an intermediate quantity, or to
//! plant an error and see that a test notices it.

use umbrage_shadows::{
    Calibration, Fragment, Info, Inputs, Kernels, Lights, Pass, Projection, Recording, Technique, Variant,
    VariantId,
};

/// A piece of WGSL to replace.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Edit {
    /// Name of the fragment.
    pub(crate) fragment: &'static str,
    /// Text that it must contain.
    pub(crate) from: &'static str,
    /// Text in its place.
    pub(crate) to: &'static str,
}

/// Applied to the recording of another technique.
pub(crate) type Change = Box<dyn Fn(&mut Recording) + Sync>;

struct Edited {
    original: &'static dyn Technique,
    change: Change,
}

impl Technique for Edited {
    fn info(&self) -> Info {
        self.original.info()
    }

    fn kernels(&self, calibration: Calibration) -> Kernels {
        self.original.kernels(calibration)
    }

    fn lights(&self) -> Lights {
        self.original.lights()
    }

    fn projection(&self) -> Projection {
        self.original.projection()
    }

    fn history(&self) -> usize {
        self.original.history()
    }

    fn record(&self, recording: &mut Recording, inputs: &Inputs<'_>) {
        self.original.record(recording, inputs);
        // Kept textures would carry an edit into other tests.
        recording.textures.iter_mut().for_each(|texture| texture.kept = None);
        (self.change)(recording);
    }
}

/// The variant whose recording is changed before it runs.
pub(crate) fn with_change(original: VariantId, change: Change) -> VariantId {
    // Variants live as long as the program: a few bytes a test.
    let technique: &'static Edited =
        Box::leak(Box::new(Edited { original: original.variant.technique, change }));
    let variant = Box::leak(Box::new(Variant { name: original.variant.name, technique }));
    VariantId { variant, ..original }
}

/// The variant with a text replaced wherever the fragment is used; panics where it is not found.
pub(crate) fn with_edit(original: VariantId, edit: Edit) -> VariantId {
    let change = move |recording: &mut Recording| {
        let mut found = 0;
        for pass in &mut recording.passes {
            for fragment in shader_of(pass).iter_mut().filter(|f| f.name == edit.fragment) {
                assert!(fragment.source.contains(edit.from), "{edit:?}: no such text any more");
                fragment.source = fragment.source.replace(edit.from, edit.to).into();
                found += 1;
            }
        }
        assert!(found > 0, "{edit:?}: no pass uses this fragment");
    };
    with_change(original, Box::new(change))
}

/// The variant with a shared fragment in place of another.
pub(crate) fn swapped(original: VariantId, from: &'static str, to: &'static str) -> VariantId {
    let all = umbrage_shadows::fragments();
    let other = all.into_iter().find(|f| f.name == to).unwrap_or_else(|| panic!("no fragment {to}"));
    let change = move |recording: &mut Recording| {
        let used = recording.passes.iter_mut().flat_map(shader_of).filter(|f| f.name == from);
        used.for_each(|fragment| *fragment = other.clone());
    };
    with_change(original, Box::new(change))
}

/// The variant whose last pass computes `body` in place of a shadow; `body` is that of
/// `fn shade(r: Receiver) -> f32`.
pub(crate) fn probe(original: VariantId, body: &'static str) -> VariantId {
    let change = move |recording: &mut Recording| {
        let last = recording.passes.last_mut().expect("a technique has passes");
        let source = format!("fn shade(r: Receiver) -> f32 {{ {body} }}");
        shader_of(last)[0] = Fragment { name: "probe".into(), source: source.into() };
    };
    with_change(original, Box::new(change))
}

/// The variant whose passes have lost the value of a constant.
pub(crate) fn without_constant(original: VariantId, name: &'static str) -> VariantId {
    let change = move |recording: &mut Recording| {
        for pass in &mut recording.passes {
            if let Pass::Compute(compute) = pass {
                compute.constants.retain(|constant| constant.0 != name);
            }
        }
    };
    with_change(original, Box::new(change))
}

fn shader_of(pass: &mut Pass) -> &mut Vec<Fragment> {
    match pass {
        Pass::Raster(raster) => &mut raster.shader,
        Pass::Compute(compute) => &mut compute.shader,
    }
}

/// Both calibrations of every variant.
pub(crate) fn all_variants() -> Vec<VariantId> {
    let both = |variant| Calibration::ALL.map(|calibration| VariantId { variant, calibration });
    umbrage_shadows::VARIANTS.iter().flat_map(both).collect()
}
