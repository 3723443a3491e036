// The camera's depth alone, 0 where nothing is seen: for passes over anchors, which reconstruct no
// surface and yet look at the frame.
@group(0) @binding(2) var camera_depth: texture_2d<f32>;
