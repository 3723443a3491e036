//! What the animations of a path show, frame by frame.

use crate::fixture::{self, Device};
use crate::request;
use png::Decoder;
use std::fs::File;
use std::io::BufReader;
use std::path::Path;
use umbrage_frame::{Image, read_exr};
use umbrage_report::{FigureRequest, write_figures};

const SIZE: (u32, u32) = (64, 36);
const FRAMES: usize = 16;

/// All frames of an APNG, as RGB.
fn frames(file: &Path) -> Vec<Image<[u8; 3]>> {
    let mut reader =
        Decoder::new(BufReader::new(File::open(file).expect("written"))).read_info().expect("PNG");
    let (width, height) = (reader.info().width, reader.info().height);
    let count = reader.info().animation_control().expect("animated").num_frames;
    let frame = |_| {
        let mut bytes = vec![0; (3 * width * height) as usize];
        reader.next_frame(&mut bytes).expect("a frame");
        let pixels = bytes.as_chunks::<3>().0.to_vec();
        Image::from_pixels(width, height, pixels)
    };
    (0..count).map(frame).collect()
}

fn grey(value: f32) -> u8 {
    (255.0 * value.clamp(0.0, 1.0)).round() as u8
}

/// With the point pinned, the inset's centre is the same surface point in every frame: its values are those of the
/// stored frames there, bit for bit of a picture, and truth does not move at all. As the camera sees it, only the
/// middle frame is in its place.
#[test]
fn a_pinned_point_stays_and_a_camera_moves() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    fixture::write(folder.path(), Device::Software, SIZE).expect("stored");
    let out = folder.path().join("figures");
    let crop = [24, 18, 16, 8];
    let asked = FigureRequest { variants: vec!["pcf-vogel-16-ign".into()], crops: vec![crop], ..request() };
    write_figures(folder.path(), &asked, &out).expect("figures");

    let mut stored =
        read_exr(&folder.path().join("pictures/window-00-variant-03-frames.exr")).expect("stored");
    stored.sort_by(|a, b| a.0.cmp(&b.0));
    let follow = frames(&out.join("path-follow.png"));
    assert_eq!((follow.len(), stored.len()), (FRAMES, FRAMES));
    // A magnification of 4 brings 16 pixels to a half of 64 twice as large; 8 px lie between truth and variant.
    let (zoom, gap) = (4, 8);
    assert_eq!(follow[0].width(), 2 * 16 * zoom + gap);
    let centre = (8 * zoom + 1, 4 * zoom + 1);
    for (shown, (_, frame)) in follow.iter().zip(&stored) {
        let value = *frame.at(crop[0] + 8, crop[1] + 4);
        assert_eq!(*shown.at(16 * zoom + gap + centre.0, centre.1), [grey(value); 3]);
        assert_eq!(shown.at(centre.0, centre.1), follow[0].at(centre.0, centre.1), "truth stands still");
    }

    let camera = frames(&out.join("path-camera.png"));
    assert_eq!(camera.len(), FRAMES);
    let truth = read_exr(&folder.path().join("pictures/window-00-truth.exr")).expect("stored");
    let truth = &truth.iter().find(|l| l.0 == "reference.V").expect("a layer").1;
    let differing = |shown: &Image<[u8; 3]>| {
        let places = (0..SIZE.1).flat_map(|y| (0..SIZE.0).map(move |x| (x, y)));
        let seen = places.filter(|&(x, y)| truth.at(x, y).is_finite());
        seen.filter(|&(x, y)| *shown.at(2 * x, 2 * y) != [grey(*truth.at(x, y)); 3]).count()
    };
    assert_eq!(differing(&camera[FRAMES / 2]), 0, "the middle frame is the picture itself");
    assert!(differing(&camera[0]) > 20, "the first is seen from elsewhere");
}
