// A hard shadow blurred in screen space (T30), second axis: along columns, as far as the radius of
// the receiver's pixel. Distances count from the receiver's own place; an anchor between two columns
// takes its share of both. At a pixel's centre that is the pixel's column alone.
@group(0) @binding(6) var rows: texture_2d<f32>;
@group(0) @binding(9) var penumbra: texture_2d<f32>;

fn shade(r: Receiver) -> f32 {
    let pixel = vec2<i32>(floor(r.place));
    let radius = max(textureLoad(penumbra, pixel, 0).y, 1.0);
    let reach = i32(ceil(radius));
    let left = floor(r.place.x - 0.5);
    let across = r.place.x - 0.5 - left;
    var sum = vec2(0.0);
    for (var dy = -reach; dy <= reach; dy++) {
        for (var side = 0; side < 2; side++) {
            let tap = vec2(i32(left) + side, pixel.y + dy);
            let column = select(1.0 - across, across, side == 1);
            if column > 0.0 && in_frame(tap) {
                let distance = f32(tap.y) + 0.5 - r.place.y;
                let share = column * half_disc(distance / radius) * weight(r, tap);
                sum += share * vec2(textureLoad(rows, tap, 0).x, 1.0);
            }
        }
    }
    return select(textureLoad(rows, pixel, 0).x, sum.x / sum.y, sum.y > 0.0);
}
