use super::parse;
use crate::model::Model;
use crate::{Scene, SceneError};
use glam::{DVec3, Vec3};
use proptest::prelude::*;
use std::path::Path;

fn model(text: &str) -> Model {
    parse(text.as_bytes(), Path::new("here.obj")).expect("a valid file")
}

fn error(text: &str) -> String {
    parse(text.as_bytes(), Path::new("here.obj")).expect_err("a broken file").to_string()
}

/// Sum of cross products over all triangles: twice the vector area.
fn double_area(model: &Model) -> DVec3 {
    let of = |o: &crate::model::Object| -> DVec3 {
        let corner = |v: u32| o.positions[v as usize];
        o.triangles.iter().map(|&[a, b, c]| (corner(b) - corner(a)).cross(corner(c) - corner(a))).sum()
    };
    model.objects.iter().map(of).sum()
}

#[test]
fn quads_and_convex_polygons_keep_their_area() {
    let quad = model("v 0 0 0\nv 2 0 0\nv 2 3 0\nv 0 3 0\nf 1 2 3 4\n");
    assert_eq!(quad.objects[0].triangles.len(), 2);
    assert_eq!(double_area(&quad), DVec3::new(0.0, 0.0, 12.0));
    assert_eq!(quad.notes, ["1 objects have no known material: grey 0.5"]);

    let hexagon = model("v 2 0 0\nv 1 2 0\nv -1 2 0\nv -2 0 0\nv -1 -2 0\nv 1 -2 0\nf 1 2 3 4 5 6\n");
    assert_eq!(hexagon.objects[0].triangles.len(), 4);
    assert_eq!(double_area(&hexagon), DVec3::new(0.0, 0.0, 24.0));
    assert!(hexagon.notes[0].contains("cut into fans"), "{:?}", hexagon.notes);
}

/// A concave polygon keeps its signed area as a fan, but triangles overlap: the known limit.
#[test]
fn a_concave_polygon_is_a_fan_and_noted() {
    let concave = model("v 0 0 0\nv 4 0 0\nv 4 4 0\nv 3 1 0\nv 0 1 0\nf 1 2 3 4 5\n");
    assert_eq!(concave.objects[0].triangles, [[0, 1, 2], [0, 2, 3], [0, 3, 4]]);
    assert!(concave.notes[0].starts_with("1 polygons"), "{:?}", concave.notes);
}

#[test]
fn negative_indices_count_from_the_last_vertex() {
    let text = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf -3 -2 -1\nv 0 0 5\nf -1 -3//7 -2/2\n";
    let object = &model(text).objects[0];
    let corner = |t: usize, k: usize| object.positions[object.triangles[t][k] as usize];
    assert_eq!(corner(0, 0), DVec3::ZERO);
    assert_eq!(corner(1, 0), DVec3::new(0.0, 0.0, 5.0));
    assert_eq!(corner(1, 1), DVec3::X);
    assert_eq!(corner(1, 2), DVec3::Y);
}

#[test]
fn groups_and_materials_split_objects() {
    let text = "v 0 0 0\nv 1 0 0\nv 0 1 0\no one\nf 1 2 3\ng two parts\nf 1 3 2\nusemtl missing\nf 1 2 3\n";
    let model = model(text);
    let names: Vec<&str> = model.objects.iter().map(|object| object.name.as_str()).collect();
    assert_eq!(names, ["one", "two parts"], "an unknown material is no reason to split");
    assert_eq!(model.objects[1].triangles.len(), 2);
}

#[test]
fn long_lines_go_on_after_a_backslash_and_colours_are_dropped() {
    let model = model("v 0 0 0 1 0 0\nv 2 0 0 2\nv 0 \\\n 1 0\nvn x\nvt\nl 1 2\np 1\nf 1 2 \\\r\n3\r\n");
    assert_eq!(model.objects[0].positions, [DVec3::ZERO, DVec3::X, DVec3::Y]);
}

#[test]
fn colours_come_from_the_library() {
    let folder = tempfile::tempdir().expect("a folder");
    let mtl = "newmtl red\nKd 0.8 0.1 0.1\nKa 1\nillum x\nnewmtl broken\nKd 1 2\nnewmtl bright\nKd 4 1 1\n";
    std::fs::write(folder.path().join("c.mtl"), mtl).expect("written");
    let obj = "mtllib c.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl red\nf 1 2 3\nusemtl broken\nf 1 2 3\nusemtl bright\nf 1 2 3\n";
    let path = folder.path().join("c.obj");
    std::fs::write(&path, obj).expect("written");
    let scene = Scene::load(&path).expect("a scene");
    let albedo: Vec<Vec3> =
        scene.geometry.material.iter().map(|&m| scene.materials[m as usize].albedo).collect();
    assert_eq!(albedo, [Vec3::new(0.8, 0.1, 0.1), Vec3::splat(0.5), Vec3::ONE]);
    assert_eq!(scene.notes.len(), 1, "{:?}", scene.notes);
    assert!(scene.notes[0].contains("'bright'"), "{:?}", scene.notes);
}

#[test]
fn a_missing_library_is_a_note() {
    let notes = model("mtllib nowhere.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl red\nf 1 2 3\n").notes;
    assert!(notes.iter().any(|note| note.contains("nowhere.mtl") && note.contains("grey 0.5")), "{notes:?}");
}

#[test]
fn broken_files_are_errors_with_a_line() {
    assert!(error("v 0 0 0\nv 1 0 0\nv 0 1\n").contains("here.obj:3: position parse error"));
    assert!(error("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 x\nv 1 1 1\n").contains("here.obj:4: face parse error"));
    assert!(error("v 0 0 0\nv 1 0 0\nf 1 2 3\n").contains("out of bounds"));
    assert!(error("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 -4\n").contains("out of bounds"));
    assert!(error("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 0 1 2\n").contains("out of bounds"));
}

#[test]
fn vertices_that_are_not_finite_are_named() {
    let folder = tempfile::tempdir().expect("a folder");
    for number in ["nan", "inf", "1e39"] {
        let path = folder.path().join("bad.obj");
        let text = format!("o good\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\no wall\nv 0 {number} 0\nf 1 2 4\n");
        std::fs::write(&path, text).expect("written");
        let error = Scene::load(&path).expect_err("not finite");
        assert!(
            matches!(&error, SceneError::VertexNotFinite { object, vertex: 2, .. } if object == "wall"),
            "{error}"
        );
        assert!(error.to_string().contains("bad.obj"), "{error}");
    }
}

#[test]
fn nothing_to_see_is_an_error() {
    let folder = tempfile::tempdir().expect("a folder");
    for text in ["", "# nothing\n", "v 0 0 0\n", "v 0 0 0\nv 1 1 1\nv 2 2 2\nf 1 2 3\n", "\u{0}\u{1}\u{2}"] {
        let path = folder.path().join("empty.obj");
        std::fs::write(&path, text).expect("written");
        let error = Scene::load(&path).expect_err("nothing to see");
        assert!(matches!(error, SceneError::NoTriangles { .. }), "{error}");
    }
}

#[test]
fn degenerate_triangles_are_dropped_and_counted() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("thin.obj");
    let text = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 2 0 0\nf 1 2 3\nf 1 1 2\nf 1 2 4\n";
    std::fs::write(&path, text).expect("written");
    let scene = Scene::load(&path).expect("one good triangle");
    assert_eq!(scene.geometry.triangles.len(), 1);
    assert_eq!(scene.geometry.positions.len(), 3, "the vertex of the dropped triangle is gone too");
    assert!(scene.notes.iter().any(|note| note == "2 degenerate triangles dropped"), "{:?}", scene.notes);
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(256))]

    #[test]
    fn no_bytes_panic(bytes in proptest::collection::vec(any::<u8>(), 0..200)) {
        let _ = parse(&bytes, Path::new("x.obj"));
    }

    /// Lines that look like OBJ, with every kind of wrong number.
    #[test]
    fn no_lines_panic(
        lines in proptest::collection::vec(
            "(v|f|f|o|g|usemtl|vn|vt|l|p|s|#|)( (-?[0-9]{1,20}|[0-9]\\.[0-9]e[0-9]{1,3}|nan|1/2/3|-1//-9|é|\\\\)){0,6}",
            0..30,
        )
    ) {
        let _ = parse(lines.join("\n").as_bytes(), Path::new("x.obj"));
    }

    #[test]
    fn no_library_panics(text in "(newmtl|Kd|Ka|map_Kd|Ns|#|)( [a-z0-9.é-]{0,5}){0,5}\n(newmtl|Kd)( [a-z0-9.-]{0,5}){0,5}") {
        let folder = tempfile::tempdir().expect("a folder");
        let path = folder.path().join("x.mtl");
        std::fs::write(&path, text).expect("written");
        let _ = super::library::read(&path);
    }
}
