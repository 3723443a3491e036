//! Where the points of the middle frame lie in the pictures of the others.

use glam::{Mat4, Vec3};
use umbrage_frame::Image;

/// For each frame and pixel, the point of the middle frame that it shows.
pub(super) fn maps(depth: &Image<f32>, cameras: &[[f32; 16]]) -> Vec<Vec<Option<usize>>> {
    let cameras: Vec<Mat4> = cameras.iter().map(Mat4::from_cols_array).collect();
    let world = positions(depth, cameras[cameras.len() / 2]);
    cameras.iter().map(|camera| map(depth, camera, &world)).collect()
}

fn positions(depth: &Image<f32>, camera: Mat4) -> Vec<Option<Vec3>> {
    let inverse = camera.inverse();
    let (width, height) = (depth.width(), depth.height());
    let position = |(i, &d): (usize, &f32)| {
        let (x, y) = ((i as u32 % width) as f32 + 0.5, (i as u32 / width) as f32 + 0.5);
        let at = inverse
            * glam::vec4((2.0 * x / width as f32 - 1.0) * d, (1.0 - 2.0 * y / height as f32) * d, 0.0, d);
        // In perspective the depth is clip w; w of a world point is 1, which settles clip z.
        let z = (1.0 - at.w) / inverse.z_axis.w;
        d.is_finite().then(|| (at + z * inverse.z_axis).truncate())
    };
    depth.pixels().iter().enumerate().map(position).collect()
}

fn map(depth: &Image<f32>, camera: &Mat4, world: &[Option<Vec3>]) -> Vec<Option<usize>> {
    let (width, height) = (depth.width(), depth.height());
    let mut nearest = vec![(f32::INFINITY, None); world.len()];
    for (point, position) in world.iter().enumerate() {
        let Some(position) = position else { continue };
        let clip = *camera * position.extend(1.0);
        let (x, y) =
            ((0.5 + 0.5 * clip.x / clip.w) * width as f32, (0.5 - 0.5 * clip.y / clip.w) * height as f32);
        if clip.w > 0.0 && x >= 0.0 && y >= 0.0 && x < width as f32 && y < height as f32 {
            let at = y as usize * width as usize + x as usize;
            if clip.w < nearest[at].0 {
                nearest[at] = (clip.w, Some(point));
            }
        }
    }
    closed(&nearest.into_iter().map(|(_, point)| point).collect::<Vec<_>>(), width as usize)
}

/// Points come apart where the camera nears them: a pixel that none meets takes the one beside it where there
/// are points on both sides. What the middle frame does not see stays open.
fn closed(points: &[Option<usize>], width: usize) -> Vec<Option<usize>> {
    let across = |at: usize, step: usize| {
        let (before, after) =
            (points.get(at.checked_sub(step)?).copied()??, points.get(at + step).copied()??);
        Some(before.min(after))
    };
    let pixel = |(at, &point): (usize, &Option<usize>)| {
        let inside = at % width > 0 && at % width + 1 < width;
        // Where two cracks cross, there are points at the corners only.
        let slanted = || across(at, width + 1).or_else(|| across(at, width - 1)).filter(|_| inside);
        point.or_else(|| across(at, 1).filter(|_| inside)).or_else(|| across(at, width)).or_else(slanted)
    };
    points.iter().enumerate().map(pixel).collect()
}

#[cfg(test)]
mod tests {
    use super::closed;

    #[test]
    fn a_crack_is_closed_and_an_edge_is_not() {
        // In rows of three: a crack in the first row, and one that crosses it through the middle.
        let points = [Some(0), None, Some(2), None, None, None, Some(6), None, Some(8)];
        let filled = closed(&points, 3);
        let [a, b] = [Some(0), Some(2)];
        assert_eq!(filled, [a, a, b, a, a, b, Some(6), Some(6), Some(8)]);
        // Beyond the last row and the last column there is nothing to close up with.
        let open = [Some(0), Some(1), None, Some(3), Some(4), None, None, None, None];
        assert_eq!(closed(&open, 3), open);
    }
}
