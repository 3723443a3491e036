//! D2 and D4: heights of millimetres, slopes and pitches.

use super::*;

#[test]
fn boxes_and_posts_hang_0_1_5_and_20_millimetres_high() {
    let model = Generator::Contact.model();
    assert_eq!(contact::RAISED, [0.0, 0.001, 0.005, 0.020]);
    for raised in contact::RAISED {
        for (_, degrees) in contact::ROWS {
            let (lo, hi) = bounds(object(&model, &format!("box {raised} m above, {degrees} degrees")));
            assert!((lo.y - raised).abs() < ROUNDING && (hi.y - lo.y - contact::BOX).abs() < ROUNDING);
            // A square of 1 m, seen across its turn.
            let (sin, cos) = f64::to_radians(degrees).sin_cos();
            assert!((hi.x - lo.x - contact::BOX * (sin + cos)).abs() < ROUNDING);
        }
        let (lo, hi) = bounds(object(&model, &format!("post {raised} m above")));
        assert!((lo.y - raised).abs() < ROUNDING && (hi.y - lo.y - contact::POST.0).abs() < ROUNDING);
    }
}

#[test]
fn balls_and_slab_lie_on_the_floor() {
    let model = Generator::Contact.model();
    for k in 0..3 {
        let ball = object(&model, &format!("ball {k}"));
        let (lo, hi) = bounds(ball);
        assert_eq!(lo.y, 0.0, "the pole itself touches");
        let centre = 0.5 * (lo + hi);
        for &corner in &ball.positions {
            assert!((corner.distance(centre) - contact::BALL_RADIUS).abs() < ROUNDING);
        }
    }
    let (lo, hi) = bounds(object(&model, "slab"));
    assert_eq!([lo.y, hi.y], [0.0, contact::SLAB_HEIGHT]);
}

/// The ramp's face, and what stands on it: nothing sinks in, nothing hangs.
#[test]
fn the_ramp_rises_by_15_degrees() {
    let model = Generator::Contact.model();
    let ramp = object(&model, "ramp");
    let steepest = corners(ramp).map(|[a, b, c]| (b - a).cross(c - a).normalize());
    let face = steepest.max_by(|a, b| a.y.total_cmp(&b.y)).expect("faces");
    let degrees = face.y.acos().to_degrees();
    // acos in degrees near 15.
    assert!((degrees - contact::RAMP_DEGREES).abs() < 1e-10, "{degrees}");
    assert!(face.z < 0.0 && face.x.abs() < ROUNDING, "towards the cameras");
    let foot = ramp.positions[0];
    for (name, top) in [("box on the ramp", 2.0 * contact::RAMP_BOX_HALF), ("pole on the ramp", 1.0)] {
        let above: Vec<f64> = object(&model, name).positions.iter().map(|p| (*p - foot).dot(face)).collect();
        let [low, high] =
            [above.iter().copied().fold(1.0, f64::min), above.iter().copied().fold(0.0, f64::max)];
        assert!(low.abs() < ROUNDING && (high - top).abs() < ROUNDING, "{name}: {low} to {high}");
    }
}

#[test]
fn bars_are_2_cm_wide_and_6_cm_apart() {
    let model = Generator::Grating.model();
    assert_eq!(model.objects.len(), 1 + 3 * grating::BARS);
    assert_eq!(grating::BARS as f64 * grating::PITCH, grating::SIDE);
    for degrees in grating::TURNED_DEGREES {
        let bar = |k: usize| object(&model, &format!("bar {k} at {degrees} degrees"));
        let centre = |k: usize| bar(k).positions.iter().sum::<DVec3>() / 8.0;
        let axis = bar(0).positions[1] - bar(0).positions[0];
        let azimuth = axis.x.atan2(axis.z).to_degrees();
        // atan2 in degrees.
        assert!((azimuth - degrees).abs() < 1e-10, "{azimuth}");
        for k in 1..grating::BARS {
            let apart = centre(k) - centre(k - 1);
            assert!((apart.length() - grating::PITCH).abs() < ROUNDING && apart.dot(axis).abs() < ROUNDING);
        }
        let across = bar(0).positions[4] - bar(0).positions[0];
        assert!((across.length() - grating::BAR).abs() < ROUNDING && across.y.abs() < ROUNDING);
    }
}

#[test]
fn gratings_rise_from_2_cm_to_half_a_metre() {
    let model = Generator::Grating.model();
    for bar in model.objects.iter().filter(|object| object.name.starts_with("bar")) {
        // The lower edges, at both ends.
        let ends = [bar.positions[0], bar.positions[1]];
        for (end, height) in ends.into_iter().zip(grating::HEIGHTS) {
            assert!((end.y - height).abs() < ROUNDING, "'{}': {end}", bar.name);
        }
        assert!((ends[0].distance(ends[1]) - grating::SIDE).abs() < ROUNDING);
        assert!(ends[1].z > ends[0].z, "rises away from the cameras");
    }
}
