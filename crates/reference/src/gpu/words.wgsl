// 64-bit words in pairs, low first, and the bijection that draws everything (SplitMix64's finaliser).

fn wide_product(a: u32, b: u32) -> vec2<u32> {
    let a0 = a & 0xffffu;
    let a1 = a >> 16u;
    let b0 = b & 0xffffu;
    let b1 = b >> 16u;
    let low = a0 * b0;
    let one = a0 * b1;
    let other = a1 * b0;
    let middle = (low >> 16u) + (one & 0xffffu) + (other & 0xffffu);
    return vec2<u32>(a * b, a1 * b1 + (one >> 16u) + (other >> 16u) + (middle >> 16u));
}

fn product(a: vec2<u32>, b: vec2<u32>) -> vec2<u32> {
    let p = wide_product(a.x, b.x);
    return vec2<u32>(p.x, p.y + a.x * b.y + a.y * b.x);
}

fn sum(a: vec2<u32>, b: vec2<u32>) -> vec2<u32> {
    let low = a.x + b.x;
    return vec2<u32>(low, a.y + b.y + select(0u, 1u, low < a.x));
}

// z ^ (z >> by), by from 1 to 31.
fn fold_down(z: vec2<u32>, by: u32) -> vec2<u32> {
    return z ^ vec2<u32>((z.x >> by) | (z.y << (32u - by)), z.y >> by);
}

fn mix(word: vec2<u32>) -> vec2<u32> {
    var z = sum(word, vec2<u32>(0x7f4a7c15u, 0x9e3779b9u));
    z = product(fold_down(z, 30u), vec2<u32>(0x1ce4e5b9u, 0xbf58476du));
    z = product(fold_down(z, 27u), vec2<u32>(0x133111ebu, 0x94d049bbu));
    return fold_down(z, 31u);
}

// The upper 24 bits as a number in [0, 1).
fn unit(bits: u32) -> f32 {
    return f32(bits >> 8u) * (1.0 / 16777216.0);
}
