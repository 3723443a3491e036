// The six faces of a cube map, three by two in one texture: +x -x +y -y +z -z. On the face of axis
// a, right and up are the axes a+1 and a+2 (in cyclic order), whatever the sign: a mirrored face is
// as good as any.
fn face_of(direction: vec3<f32>) -> u32 {
    let size = abs(direction);
    if size.x >= size.y && size.x >= size.z {
        return select(0u, 1u, direction.x < 0.0);
    }
    if size.y >= size.z {
        return select(2u, 3u, direction.y < 0.0);
    }
    return select(4u, 5u, direction.z < 0.0);
}

// Right, up and forward components of a direction on a face.
fn on_face(face: u32, d: vec3<f32>) -> vec3<f32> {
    let sign = select(1.0, -1.0, face % 2u == 1u);
    switch face / 2u {
        case 0u: { return vec3(d.y, d.z, d.x * sign); }
        case 1u: { return vec3(d.z, d.x, d.y * sign); }
        default: { return vec3(d.x, d.y, d.z * sign); }
    }
}

// The way back.
fn from_face(face: u32, f: vec3<f32>) -> vec3<f32> {
    let forward = f.z * select(1.0, -1.0, face % 2u == 1u);
    switch face / 2u {
        case 0u: { return vec3(forward, f.x, f.y); }
        case 1u: { return vec3(f.y, forward, f.x); }
        default: { return vec3(f.x, f.y, forward); }
    }
}
