use super::*;
use glam::{DMat4, Vec3};

/// A camera at (1, 2, 3) that looks along +x with y up, in glTF's terms.
fn wanted() -> DMat4 {
    let back = DVec3::NEG_X;
    let right = DVec3::Y.cross(back);
    DMat4::from_cols(
        right.extend(0.0),
        DVec3::Y.extend(0.0),
        back.extend(0.0),
        DVec3::new(1.0, 2.0, 3.0).extend(1.0),
    )
}

fn text(convention: &str, numbers: [f64; 16]) -> String {
    format!(
        "{{\"version\": 1, \"convention\": {convention}, \"frames\": [{{\"index\": 4, \"world_from_camera\": {numbers:?}, \
         \"yfov\": 0.8}}]}}"
    )
}

fn read(text: &str) -> Result<Vec<FrameCamera>, String> {
    let file = CameraFile::parse(text, Path::new("cameras.json"), None).map_err(|e| e.to_string())?;
    let convention = file.convention;
    file.cameras(&convention, DVec3::ZERO).map_err(|e| e.to_string())
}

fn columns(axes: [[f64; 3]; 3], eye: [f64; 3]) -> [f64; 16] {
    let [a, b, c] = axes;
    [a[0], a[1], a[2], 0.0, b[0], b[1], b[2], 0.0, c[0], c[1], c[2], 0.0, eye[0], eye[1], eye[2], 1.0]
}

/// One and the same camera as each engine writes it, worked out by hand: where its own x, y and z axes point in
/// its own world, and where it stands.
#[test]
fn presets_agree_on_one_camera() {
    // glTF looks along +x: the camera's x is +z, its y up, its -z is +x.
    let gltf = columns([[0.0, 0.0, 1.0], [0.0, 1.0, 0.0], [-1.0, 0.0, 0.0]], [1.0, 2.0, 3.0]);
    // Blender's (x, y, z) is glTF's (x, z, -y): glTF's +z is -y there.
    let blender = columns([[0.0, -1.0, 0.0], [0.0, 0.0, 1.0], [-1.0, 0.0, 0.0]], [1.0, -3.0, 2.0]);
    // Unity's x is glTF's -x; its camera looks along its own +z and has +x to the right.
    let unity = columns([[0.0, 0.0, 1.0], [0.0, 1.0, 0.0], [-1.0, 0.0, 0.0]], [-1.0, 2.0, 3.0]);
    // Unreal's (x, y, z) is glTF's (x, z, y), in centimetres, row vectors: rows are where x (forward),
    // y (right) and z (up) point.
    let unreal = columns([[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]], [100.0, 300.0, 200.0]);
    let all = [
        ("gltf", gltf),
        ("godot", gltf),
        ("bevy", gltf),
        ("blender", blender),
        ("unity", unity),
        ("unreal", unreal),
    ];
    for (preset, numbers) in all {
        let frames = read(&text(&format!("{{\"preset\": \"{preset}\"}}"), numbers)).expect(preset);
        let off = (frames[0].camera.world_from_camera - wanted().as_mat4()).to_cols_array();
        // Entries up to 3, in f32.
        assert!(off.iter().all(|v| v.abs() < 1e-6), "{preset}: {:?}", frames[0].camera);
        assert_eq!((frames[0].index, frames[0].camera.eye()), (4, Vec3::new(1.0, 2.0, 3.0)), "{preset}");
    }
}

#[test]
fn layouts_and_origins() {
    let numbers = columns([[0.0, 0.0, 1.0], [0.0, 1.0, 0.0], [-1.0, 0.0, 0.0]], [1.0, 2.0, 3.0]);
    let rows: [f64; 16] = std::array::from_fn(|i| numbers[i % 4 * 4 + i / 4]);
    let same = read(&text("{}", numbers)).expect("columns");
    assert_eq!(read(&text("{\"matrix_order\": \"row\"}", rows)).expect("rows"), same);
    assert_eq!(read(&text("{\"vector\": \"row\"}", rows)).expect("row vectors"), same);
    let file = CameraFile::parse(&text("{}", numbers), Path::new("c.json"), None).expect("read");
    let moved = file.cameras(&file.convention, DVec3::new(1.0, 0.0, 0.0)).expect("read");
    assert_eq!(moved[0].camera.eye(), Vec3::new(0.0, 2.0, 3.0));
    // A layout that cannot be is told apart from a camera that can.
    assert!(read(&text("{}", rows)).expect_err("rows").contains("translation stands in the last row"));
}

#[test]
fn what_cannot_be_is_refused_with_its_frame() {
    let numbers = columns([[0.0, 0.0, 1.0], [0.0, 1.0, 0.0], [-1.0, 0.0, 0.0]], [1.0, 2.0, 3.0]);
    let refused = |text: String, why: &str| {
        let message = read(&text).expect_err(why);
        assert!(message.contains(why) && message.contains("cameras.json"), "{message}");
    };
    let good = text("{}", numbers);
    refused(
        good.replace("0.8", "52.0"),
        "frame 4: yfov must be in radians, 0 to 3.14, is 52; degrees, perhaps?",
    );
    refused(good.replace("\"yfov\"", "\"fov\""), "unknown field `fov`");
    refused(good.replace("\"version\": 1", "\"version\": 2"), "version 2 is not known");
    refused(good.replace("0.8", "0.8, \"jitter\": [0.25, 0.0]"), "temporal antialiasing");
    refused(good.replace("0.8", "0.8, \"near\": 5, \"far\": 2"), "near must be above 0 and below far");
    refused(good.replace("[0.0, 0.0, 1.0", "[0.7, 0.0, 1.0"), "right angles");
    refused(text("{\"right\": \"+y\"}", numbers), "three different axes");
    refused(text("{\"handedness\": \"left\"}", numbers), "axes are Right-handed");
    refused(text("{\"right\": \"-x\"}", numbers), "mirrors the picture");
    let twice = good.replace("\"frames\": [", "\"frames\": [{\"index\": 4, \"yfov\": 1, \"world_from_camera\": [1,0,0,0,0,1,0,0,0,0,1,0,0,0,0,1]}, ");
    refused(twice, "frame 4: is there twice");
    refused(good.replace("0.8", "0.8, \"width\": 320"), "frame 4: has a width without a height");
    refused(good.replace("0.8", "0.8, \"width\": 0, \"height\": 0"), "width and height must be above 0");
    refused(good[..40].to_string(), "cameras.json:1:");
}

#[test]
fn transforms_are_read_as_blender_writes_them() {
    let text = "{\"camera_angle_x\": 1.0, \"w\": 200, \"h\": 100, \"frames\": [{\"file_path\": \"./train/r_012\", \
                \"transform_matrix\": [[0, 0, -1, 1], [-1, 0, 0, -3], [0, 1, 0, 2], [0, 0, 0, 1]]}]}";
    let frames = read(text).expect("read");
    assert_eq!((frames[0].index, frames[0].size), (12, Some((200, 100))));
    let off = (frames[0].camera.world_from_camera - wanted().as_mat4()).to_cols_array();
    assert!(off.iter().all(|v| v.abs() < 1e-6), "{:?}", frames[0].camera);
    // Half as high as wide: tan(y) = tan(x) / 2.
    assert!((frames[0].camera.yfov_radians - 2.0 * (0.5f32.tan() / 2.0).atan()).abs() < 1e-6);
    assert!(read(&text.replace("\"w\"", "\"cx\": 90, \"w\"")).expect_err("off").contains("off the centre"));
    assert!(read(&text.replace("\"w\": 200, \"h\": 100,", "")).expect("square")[0].square);
}

#[test]
fn a_frame_may_have_a_lens_of_its_own() {
    let text = |all: &str, own: &str| {
        format!(
            "{{{all} \"frames\": [{{\"file_path\": \"r_012.png\", {own} \"transform_matrix\": [[0, 0, -1, 1], [-1, 0, 0, -3], \
             [0, 1, 0, 2], [0, 0, 0, 1]]}}]}}"
        )
    };
    let frame = |all: &str, own: &str| read(&text(all, own)).map(|frames| frames[0]);
    let own = frame("", "\"fl_x\": 100, \"fl_y\": 50, \"w\": 300, \"h\": 100,").expect("read");
    assert_eq!((own.size, own.square), (Some((300, 100)), false));
    assert!((own.camera.yfov_radians - 2.0 * 1.0f32.atan()).abs() < 1e-6);
    // A frame's own focal length counts before an angle of all.
    let both = frame("\"camera_angle_x\": 1.0, \"w\": 300, \"h\": 100,", "\"fl_y\": 50,").expect("read");
    assert_eq!(both.camera, own.camera);
    let straight = "\"camera_model\": \"OPENCV\", \"k1\": 0.0, \"camera_angle_x\": 1.0,";
    assert!(frame(straight, "").is_ok());
    let bent = frame("\"camera_angle_x\": 1.0, \"k1\": -0.02,", "").expect_err("bent");
    assert!(bent.contains("frame 12: k1 is -0.02") && bent.contains("undistort"), "{bent}");
    let fish = frame("\"camera_model\": \"OPENCV_FISHEYE\", \"camera_angle_x\": 1.0,", "").expect_err("fish");
    assert!(fish.contains("OPENCV_FISHEYE"), "{fish}");
    assert!(frame("", "").expect_err("none").contains("neither camera_angle_x nor fl_y"));
}

#[test]
fn the_shipped_schema_is_current() {
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/cameras.schema.json");
    if std::env::var_os("UMBRAGE_BLESS").is_some() {
        std::fs::write(path, cameras_schema()).expect("written");
    }
    let shipped = std::fs::read_to_string(path).expect("crates/scene/cameras.schema.json");
    assert!(shipped == cameras_schema(), "the schema has changed: bless it");
}
