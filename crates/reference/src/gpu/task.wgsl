// What is the same for all receivers of a dispatch. The constants that are declared nowhere here (KIND,
// SET, BASE_ROWS, ...) are written before this file by the host (kernels.rs).
const ROUND = KIND != RECT;
const CONE = KIND == SUN || KIND == SPHERE;
const FLAT = !CONE;

struct Task {
    centre: vec3<f32>,
    radius: f32,
    u: vec3<f32>,
    // Largest absolute coordinate of the scene.
    extent: f32,
    v: vec3<f32>,
    first_group: u32,
    // A sun's axis; a flat light's u x v.
    axis: vec3<f32>,
    pool_words: u32,
    // A sun's rows of light from world.
    rows: array<vec4<f32>, 3>,
    // The planes that hold a sun, turned inwards; w is 0 where there is none.
    sides: array<vec4<f32>, 4>,
    // A flat light's corners.
    corners: array<vec4<f32>, 4>,
    // The box that the light ends in.
    low: vec4<f32>,
    high: vec4<f32>,
    // A sun's angle, sine, tangent, tangent / angle.
    cone: vec4<f32>,
    // Of the receivers' seeds, low word first.
    seed: vec2<u32>,
    // 0, which the compiler does not know.
    zero: u32,
    // The first pair of nodes.
    root: u32,
}

// A group's candidates: the first chunk of their list, and how many triangles and edges there are.
struct List {
    first: u32,
    length: u32,
    edges: u32,
    unused: u32,
}

// With the slot of a listed triangle: it is surely above every receiver's horizon.
const CLEAR = 0x80000000u;

// First chunks of lists that are none.
const NONE = 0xffffffffu;
const OVERFLOW = 0xfffffffeu;
const EXHAUSTED = 0xfffffffdu;

// Receivers: their position's bits and, in the lowest bits of the last word, the slot of their triangle.
const IN_AIR = 0x0fffffffu;
const BACK = 0x10000000u;
const ACROSS = 0x20000000u;

@group(0) @binding(0) var<uniform> task: Task;
// Three corners a slot, bits of floats. With each, 16 times the slot that lies on the side from there to the next (IN_AIR if none
// does), twice two bits of the piece that the triangle is of, and whether the other side goes the other way.
@group(0) @binding(1) var<storage, read> corners: array<vec4<u32>>;
@group(0) @binding(2) var<storage, read> receivers: array<vec4<u32>>;

struct Group {
    low: vec3<f32>,
    first: u32,
    high: vec3<f32>,
    count: u32,
    // Of all its receivers, or zero.
    normal: vec3<f32>,
    unused: u32,
}
@group(0) @binding(3) var<storage, read> groups: array<Group>;

// The pair of a unit vector, as glam takes it.
fn orthonormal_pair(n: vec3<f32>) -> mat2x3<f32> {
    let s = select(1.0, -1.0, (bitcast<u32>(n.z) >> 31u) != 0u);
    let a = -1.0 / (s + n.z);
    let b = n.x * n.y * a;
    return mat2x3<f32>(
        vec3<f32>(1.0 + s * n.x * n.x * a, s * b, -s * n.x),
        vec3<f32>(b, s + n.y * n.y * a, -n.y),
    );
}

// A corner of a triangle, by three times its slot.
fn vertex(at: u32) -> vec3<f32> {
    return bitcast<vec3<f32>>(corners[at].xyz);
}

// As many of the lowest bits, 32 too.
fn low_bits(number: u32) -> u32 {
    return select((1u << (number & 31u)) - 1u, 0xffffffffu, number >= 32u);
}
