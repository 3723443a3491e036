//! Intervals must cover a known 0 at least 43 times in 48 draws: with a coverage of 95 % fewer happen
//! once in 30 runs, with the 14 % of resampled pixels never. Draws are seeded, so the test is steady.

mod support;

use std::f64::consts::TAU;
use support::{Picture, Random, slats};
use umbrage_metrics::{Bootstrap, Panel, Quantity, cells, window_tiles};

const PICTURE: Picture = Picture { width: 480, height: 288 };
const FRAMES: usize = 4;
const SEEDS: usize = 4;
const DRAWS: u64 = 48;
const NEEDED: usize = 43;

/// One noise value for each square of `side` pixels of the screen, drawn afresh for each frame and
/// seed; the surface moves over the screen by `speed` pixels a frame.
fn noisy_panel(draw: u64, side: usize, speed: usize) -> Panel {
    let g = slats(20.0, 48.0);
    let truth: Vec<f64> = (0..PICTURE.points()).map(|p| g(PICTURE.place(p).0, PICTURE.place(p).1)).collect();
    let (width, height) = (PICTURE.width as usize, PICTURE.height as usize);
    let blocks = (width + speed * FRAMES) / side + 2;
    let mut random = Random(draw);
    let mut values = Vec::with_capacity(FRAMES * SEEDS * truth.len());
    for frame in 0..FRAMES {
        for _ in 0..SEEDS {
            let noise: Vec<f64> =
                (0..blocks * (height / side + 1)).map(|_| 0.5 * (TAU * random.unit()).cos()).collect();
            // Aligned with the tiles in the middle frame, as a screen pattern is.
            let shift = (speed * frame) as isize - (speed * FRAMES / 2) as isize + side as isize;
            for (p, g) in truth.iter().enumerate() {
                let column = ((p % width) as isize + shift) as usize / side;
                values.push((g + g * (1.0 - g) * noise[p / width / side * blocks + column]) as f32);
            }
        }
    }
    Panel { points: truth.len(), frames: FRAMES, seeds: SEEDS, values }
}

const ALL: [Quantity; 4] =
    [Quantity::Swimming, Quantity::SmoothStatic, Quantity::StructuredMoving, Quantity::StructuredStatic];

/// How often the interval of each quantity covers 0.
fn covered(side: usize, speed: usize, quantities: &[Quantity]) -> Vec<usize> {
    let truth = PICTURE.truth(slats(20.0, 48.0), 0.0, 1);
    let tiling = PICTURE.tiling(&truth);
    let bootstrap = Bootstrap { replicates: 400, ..Bootstrap::default() };
    let mut hits = vec![0; quantities.len()];
    for draw in 0..DRAWS {
        let table = window_tiles(&noisy_panel(draw, side, speed), &truth, &tiling).expect("a table");
        let cells = cells(&[&table], &bootstrap).expect("cells");
        for (hits, quantity) in hits.iter_mut().zip(quantities) {
            *hits += usize::from(cells.get(*quantity).score().expect("measured").contains(0.0));
        }
    }
    hits
}

#[test]
fn white_noise() {
    let hits = covered(1, 0, &ALL);
    assert!(hits.iter().all(|&h| h >= NEEDED), "{hits:?}");
}

#[test]
fn noise_in_blocks_of_a_quarter_resolution_mask() {
    // A block fills its tiles, so this noise is wholly smooth: the structured cells hold what f32
    // rounding leaves (1e-16), which is an error and no 0.
    let hits = covered(64, 0, &ALL[..2]);
    assert!(hits.iter().all(|&h| h >= NEEDED), "{hits:?}");
}

#[test]
fn noise_in_blocks_under_a_moving_camera() {
    let hits = covered(64, 5, &ALL);
    assert!(hits.iter().all(|&h| h >= NEEDED), "{hits:?}");
}
