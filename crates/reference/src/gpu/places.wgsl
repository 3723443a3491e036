// Samples by their places along a row.

// The number of samples before a place, as the lowest bits of a mask.
fn before(place: f32) -> u32 {
    return low_bits(u32(ceil(clamp(place, 0.0, 32.0))));
}

// From the tangent plane to the sine along a row, in half widths.
fn along_cone(s: Sight, x: f32, cosine: f32) -> f32 {
    let w = x * s.cone.z * cosine;
    return w / (s.cone.y * sqrt(1.0 + w * w));
}

// The samples between two places of a row.
fn between(s: Sight, row: Row, places: vec2<f32>) -> u32 {
    var span = places;
    if CONE {
        span = vec2<f32>(along_cone(s, places.x, row.cosine), along_cone(s, places.y, row.cosine));
    }
    let half = 0.5 * f32(PER_ROW);
    let centre = half - row.shift;
    return before(span.y * half + centre) & ~before(span.x * half + centre);
}

// Those of some samples at which a form is larger than the light's nearness.
fn nearer(s: Sight, turn: vec4<f32>, row: Row, form: vec3<f32>, asked: u32) -> u32 {
    var bits = asked & row.inside & ~row.hidden;
    var hidden = 0u;
    while bits != 0u {
        let sample = firstTrailingBit(bits);
        bits &= bits - 1u;
        var x = 2.0 * (f32(sample) + row.shift) / f32(PER_ROW) - 1.0;
        if CONE {
            let sine = x * s.cone.y;
            x = sine / (row.cosine * sqrt(1.0 - sine * sine) * s.cone.z);
        }
        let at = vec2<f32>(turn.x * x + turn.y * row.y, turn.z * x + turn.w * row.y);
        if dot(form, vec3<f32>(at, 1.0)) * (1.0 - LIGHT_GAP) > nearness(s, at) {
            hidden |= 1u << sample;
        }
    }
    return hidden;
}
