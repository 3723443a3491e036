//! D7 and D9: leaves, and surfaces that are not planes.

use super::*;

#[test]
fn four_hundred_leaves_fill_a_ball_of_four_metres() {
    let model = Generator::Foliage.model();
    let leaves: Vec<&Object> = model.objects.iter().filter(|o| o.name.starts_with("leaf")).collect();
    assert_eq!(leaves.len(), 400);
    let trunk = bounds(object(&model, "trunk"));
    assert_radius(object(&model, "trunk"), foliage::TRUNK_RADIUS);
    let crown = (0.5 * (trunk.0 + trunk.1)).with_y(foliage::CROWN_HEIGHT);
    let middle = |leaf: &Object| leaf.positions.iter().sum::<DVec3>() / 4.0;
    for leaf in &leaves {
        let from_crown = middle(leaf).distance(crown);
        assert!(from_crown <= foliage::CROWN_RADIUS + ROUNDING, "'{}': {from_crown}", leaf.name);
        let [a, b, c] = [0, 1, 2].map(|k| leaf.positions[k]);
        assert!(
            (a.distance(b) - foliage::LEAF).abs() < ROUNDING
                && (a.distance(c) - foliage::LEAF).abs() < ROUNDING
        );
        assert!((b - a).dot(c - a).abs() < ROUNDING, "'{}' is no square", leaf.name);
    }
    // Evenly: a share of 1/8 lies inside half the radius. 400 leaves, standard deviation 6.6.
    let inner =
        leaves.iter().filter(|leaf| middle(leaf).distance(crown) < 0.5 * foliage::CROWN_RADIUS).count();
    assert!((30..70).contains(&inner), "{inner}");
}

/// No direction is preferred: the mean of |cosine| to each axis is 1/2 for even directions.
#[test]
fn leaves_face_anywhere() {
    let model = Generator::Foliage.model();
    let leaves = model.objects.iter().filter(|o| o.name.starts_with("leaf"));
    let facing = leaves.map(|leaf| {
        let [a, b, c] = [0, 1, 2].map(|k| leaf.positions[k]);
        (b - a).cross(c - a).normalize().abs()
    });
    let mean = facing.sum::<DVec3>() / foliage::LEAVES as f64;
    // The standard deviation of |cosine| is .29, that of a mean over 400 is .0144: four of them.
    assert!((mean - DVec3::splat(0.5)).abs().max_element() < 0.058, "{mean}");
}

/// On every machine: integers and exactly rounded operations make it. Only the sun, under which the
/// tree is planted, has a sine and a cosine, whose last bits may differ.
#[test]
fn the_tree_is_always_the_same() {
    let model = Generator::Foliage.model();
    let first = object(&model, "leaf 0").positions[0];
    let last = object(&model, "leaf 399").positions[3];
    assert!(first.distance(FIRST) < ROUNDING, "{first:?}");
    assert!(last.distance(LAST) < ROUNDING, "{last:?}");
}

/// The first corner of the first leaf and the last one of the last, when this was written.
const FIRST: DVec3 = DVec3::new(2.5243735466801405, 1.7405160870610077, 1.5024426525983179);
const LAST: DVec3 = DVec3::new(2.2978504762862473, 3.2118729444044396, -1.6532521264203788);

#[test]
fn torus_and_ball_have_their_radii() {
    let model = Generator::CurvedReceivers.model();
    let [ring, tube] = curved_receivers::TORUS;
    let torus = object(&model, "torus");
    let (lo, hi) = bounds(torus);
    assert!(lo.y.abs() < ROUNDING && (hi.y - 2.0 * tube).abs() < ROUNDING, "it lies on the floor");
    let centre = 0.5 * (lo + hi);
    for &corner in &torus.positions {
        let out = (corner - centre).with_y(0.0).length() - ring;
        assert!((out.hypot(corner.y - centre.y) - tube).abs() < ROUNDING);
    }
    let ball = object(&model, "ball");
    let (lo, hi) = bounds(ball);
    assert_eq!(lo.y, 0.0);
    for &corner in &ball.positions {
        let radius = corner.distance(0.5 * (lo + hi));
        assert!((radius - curved_receivers::BALL_RADIUS).abs() < ROUNDING);
    }
}

#[test]
fn twelve_steps_rise_alike() {
    let model = Generator::CurvedReceivers.model();
    let steps: Vec<_> = model.objects.iter().filter(|o| o.name.starts_with("step")).map(bounds).collect();
    assert_eq!(steps.len(), 12);
    for pair in steps.windows(2) {
        assert!((pair[1].1.y - pair[0].1.y - curved_receivers::RISE).abs() < ROUNDING);
        assert!((pair[0].1.x - pair[1].1.x - curved_receivers::TREAD).abs() < ROUNDING);
        assert!((pair[0].0.x - pair[1].1.x).abs() < ROUNDING, "a step begins where the last one ends");
    }
}

/// 5 degrees between the slope and the sun's rays, on the lit side, and none of it hidden by itself.
#[test]
fn the_sun_grazes_the_slope() {
    let model = Generator::CurvedReceivers.model();
    let [_, _, sun] = map_axes(SUN_AZIMUTH_DEGREES);
    let facing = corners(object(&model, "slope")).map(|[a, b, c]| (b - a).cross(c - a).normalize());
    let slope = facing.filter(|n| n.y > 0.1).map(|n| n.dot(sun).asin().to_degrees());
    let angles: Vec<f64> = slope.collect();
    assert_eq!(angles.len(), 2, "two triangles");
    // asin in degrees.
    assert!(
        angles.iter().all(|angle| (angle - curved_receivers::GRAZING_DEGREES).abs() < 1e-10),
        "{angles:?}"
    );
    let facing = corners(object(&model, "slope")).map(|[a, b, c]| (b - a).cross(c - a).normalize());
    assert!(facing.filter(|n| n.y > 0.1).all(|n| n.z < -0.3), "towards the cameras");
}

/// The rays from each pole's middle along the sun meet the receiver that it is named after.
#[test]
fn poles_shade_their_receivers() {
    let model = Generator::CurvedReceivers.model();
    let [_, _, sun] = map_axes(SUN_AZIMUTH_DEGREES);
    for receiver in ["torus", "ball", "stairs"] {
        for (higher, _) in curved_receivers::POLES {
            let pole = object(&model, &format!("pole {higher} m above the {receiver}"));
            let middle = 0.5 * (pole.positions[0] + pole.positions[1]);
            let below = middle - sun * (higher / sun.y);
            let named = model.objects.iter().filter(|o| match receiver {
                "stairs" => o.name.starts_with("step"),
                name => o.name == name,
            });
            let inside =
                |(lo, hi): (DVec3, DVec3)| below.cmpge(lo - 0.2).all() && below.cmple(hi + 0.2).all();
            assert!(named.map(bounds).any(inside), "'{}' aims at {below}", pole.name);
        }
    }
}
