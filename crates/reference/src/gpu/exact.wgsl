// Heights over a triangle's plane to twice the precision of f32 (Dekker 1971, Knuth's sum): enough to
// tell a vertex in the receiver's plane from one a rounding above it.

// Compilers may cancel (a + b) - a; they cannot see through this.
fn hold(x: f32) -> f32 {
    return bitcast<f32>(bitcast<u32>(x) ^ task.zero);
}

// A sum, and what rounding took of it.
fn two_sum(a: f32, b: f32) -> vec2<f32> {
    let s = hold(a + b);
    let t = hold(s - a);
    return vec2<f32>(s, hold(a - hold(s - t)) + hold(b - t));
}

// A product, and what rounding took of it.
fn two_product(a: f32, b: f32) -> vec2<f32> {
    let p = hold(a * b);
    let a1 = bitcast<f32>(bitcast<u32>(a) & 0xfffff000u);
    let b1 = bitcast<f32>(bitcast<u32>(b) & 0xfffff000u);
    let a0 = hold(a - a1);
    let b0 = hold(b - b1);
    return vec2<f32>(p, hold(hold(hold(a1 * b1) - p) + hold(a1 * b0)) + hold(a0 * b1) + a0 * b0);
}

fn height(slot: u32, v: vec3<f32>) -> f32 {
    let n = planes[2u * slot];
    let rest = planes[2u * slot + 1u];
    let x = two_product(n.x, v.x);
    let y = two_product(n.y, v.y);
    let z = two_product(n.z, v.z);
    let xy = two_sum(x.x, y.x);
    let xyz = two_sum(xy.x, z.x);
    let over = two_sum(xyz.x, -n.w);
    let low = over.y + xyz.y + xy.y + x.y + y.y + z.y;
    return over.x + (low + (dot(rest.xyz, v) - rest.w));
}
