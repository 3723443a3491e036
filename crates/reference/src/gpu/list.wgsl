// A group's list, as walk.wgsl writes it.

@group(0) @binding(5) var<storage, read> pool: array<u32>;
@group(0) @binding(6) var<storage, read> heads: array<List>;
// Visible and (upper half) all samples of both halves; the basis' share and the variance as bits.
@group(0) @binding(7) var<storage, read_write> results: array<vec4<u32>>;

// First words of results that are none.
const LIT = 0xffffffffu;
const HIDDEN = 0xfffffffeu;
const FOR_CPU = 0xfffffffdu;
const AGAIN = 0xfffffffcu;
// More layers than the look can count.
const TOO_DEEP = 0xfffffffbu;

fn corner(place: u32, length: u32) -> vec3<f32> {
    return bitcast<vec3<f32>>(bits(place, length));
}

fn bits(place: u32, length: u32) -> vec3<u32> {
    return vec3<u32>(pool[place], pool[place + length], pool[place + 2u * length]);
}

// In the queue with the list of a receiver's group: an edge of it crosses the light.
const COUNTS = 0x80000000u;
