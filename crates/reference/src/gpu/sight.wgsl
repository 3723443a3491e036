// A receiver and the light as it sees it (scanlines/frame.rs, aim.rs).

// Two a slot: a unit normal with its offset, then what f32 left of them.
@group(0) @binding(4) var<storage, read> planes: array<vec4<f32>>;

struct Sight {
    // The place is the sum of this and `rest`.
    place: vec3<f32>,
    // Depth before which a surface hides for sure, and from which it never does.
    near: f32,
    rest: vec3<f32>,
    far: f32,
    // Zero in mid-air.
    normal: vec3<f32>,
    slot: u32,
    // Light from world.
    x: vec3<f32>,
    // A cone's sine and cosine squared.
    sin2: f32,
    y: vec3<f32>,
    cos2: f32,
    z: vec3<f32>,
    // The normal in the light's axes: the horizon.
    horizon: vec3<f32>,
    // 1 if layers count upwards in these axes, -1 if they are the other hand's.
    handed: i32,
    // A cone's angle, sine, tangent, tangent / angle.
    cone: vec4<f32>,
    // How rows lie on the light; only where they are looked at.
    turn: vec4<f32>,
    seed: vec2<u32>,
    back: bool,
    across: bool,
    // What f32 cannot do: seen edge-on, or from close to a sphere.
    thin: bool,
}

// What is the same from everywhere is read from where it stands.
fn standing(kept: Sight) -> Sight {
    var s = kept;
    if KIND == SUN {
        s.x = task.rows[0].xyz;
        s.y = task.rows[1].xyz;
        s.z = task.rows[2].xyz;
        s.near = 3e38;
        s.far = 3e38;
        s.cone = task.cone;
    }
    return s;
}

fn sight_of(index: u32) -> Sight {
    let word = receivers[index];
    var s: Sight;
    s.place = bitcast<vec3<f32>>(word.xyz);
    s.slot = word.w & IN_AIR;
    s.back = (word.w & BACK) != 0u;
    s.across = (word.w & ACROSS) != 0u;
    var facing = 1.0;
    if s.slot != IN_AIR {
        facing = select(1.0, -1.0, s.back);
        let n = planes[2u * s.slot].xyz;
        s.rest = -height(s.slot, s.place) * n;
        s.normal = facing * n;
    }
    let axis = (task.centre - s.place) - s.rest;
    var u = task.u;
    var v = task.v;
    if KIND == SUN {
        s = standing(s);
    } else if FLAT {
        let across_v = cross(v, axis);
        let across_u = cross(axis, u);
        let volume = dot(task.axis, axis);
        s.thin = abs(volume) <= 2e-3 * length(u) * length(v) * length(axis);
        s.x = across_v / volume;
        s.y = across_u / volume;
        s.z = task.axis / volume;
        s.near = 1.0 - LIGHT_GAP;
        s.far = s.near;
    } else {
        let length2 = dot(axis, axis);
        let away = sqrt(length2);
        let sine = task.radius / away;
        // From closer or farther the roots of 1 - sin^2 and the angle lose too much.
        s.thin = !(sine < 0.9 && sine > 1e-5);
        s.sin2 = sine * sine;
        s.cos2 = 1.0 - s.sin2;
        let cosine = sqrt(s.cos2);
        let tangent = sine / cosine;
        let angle = angle_of(sine, cosine);
        s.cone = vec4<f32>(angle, sine, tangent, tangent / angle);
        let width = tangent * away;
        let pair = orthonormal_pair(axis / away);
        u = pair[0] * width;
        v = pair[1] * width;
        s.x = pair[0] / width;
        s.y = pair[1] / width;
        s.z = axis / length2;
        s.far = s.cos2;
        s.near = (1.0 - sine) * (1.0 - LIGHT_GAP);
    }
    if s.across {
        let to_axis = select(facing * height(s.slot, task.centre), dot(s.normal, task.axis), KIND == SUN);
        s.horizon = vec3<f32>(dot(s.normal, u), dot(s.normal, v), to_axis);
    }
    s.handed = select(1, -1, dot(cross(s.x, s.y), s.z) > 0.0);
    return s;
}

// Taylor's series, good to 1e-7 up to a right angle.
fn sin_cos(t: f32) -> vec2<f32> {
    let s = t * t;
    let sine = 1.0 + s * (-1.0 / 6.0 + s * (1.0 / 120.0 + s * (-1.0 / 5040.0 + s * (1.0 / 362880.0 - s / 39916800.0))));
    let cosine = 1.0 + s * (-0.5 + s * (1.0 / 24.0 + s * (-1.0 / 720.0
        + s * (1.0 / 40320.0 + s * (-1.0 / 3628800.0 + s * (1.0 / 479001600.0))))));
    return vec2<f32>(t * sine, cosine);
}

// The language promises 4096 ulps of `atan2`: one Newton step makes that 1e-10 and rounding.
fn angle_of(sine: f32, cosine: f32) -> f32 {
    let rough = atan2(sine, cosine);
    let at = sin_cos(rough);
    return rough + (sine * at.y - cosine * at.x);
}

// One over the distance along the axis at which a place of the light stands (samples.rs, `set_place`).
fn nearness(s: Sight, at: vec2<f32>) -> f32 {
    if KIND != SPHERE {
        return 1.0;
    }
    let tan2 = s.sin2 / s.cos2;
    let r2 = dot(at, at);
    let cos2_here = 1.0 / (1.0 + r2 * tan2);
    let cos_here = sqrt(cos2_here);
    let chord2 = max(tan2 * (1.0 - r2) * cos2_here * s.cos2, 0.0);
    return 1.0 / (cos_here * (cos_here - sqrt(chord2)));
}
