//! A rectangle of pixels, row 0 at the top.

/// Pixels in rows from the top, left to right.
#[derive(Clone, Debug, PartialEq)]
pub struct Image<T> {
    width: u32,
    height: u32,
    pixels: Vec<T>,
}

/// The unoccluded fraction of the light per pixel: 1 = fully lit, 0 = umbra.
pub type ShadowMask = Image<f32>;

impl<T> Image<T> {
    /// Wraps `width * height` pixels.
    ///
    /// # Panics
    /// When the number of pixels differs: a programming error, never a user's.
    pub fn from_pixels(width: u32, height: u32, pixels: Vec<T>) -> Self {
        assert_eq!(pixels.len(), width as usize * height as usize, "pixels of a {width}x{height} image");
        Self { width, height, pixels }
    }

    /// Evaluates `pixel(x, y)` everywhere.
    pub fn from_fn(width: u32, height: u32, mut pixel: impl FnMut(u32, u32) -> T) -> Self {
        let pixels =
            (0..height).flat_map(|y| (0..width).map(move |x| (x, y))).map(|(x, y)| pixel(x, y)).collect();
        Self { width, height, pixels }
    }

    /// Pixels per row.
    pub fn width(&self) -> u32 {
        self.width
    }

    /// Rows.
    pub fn height(&self) -> u32 {
        self.height
    }

    /// All pixels, row by row.
    pub fn pixels(&self) -> &[T] {
        &self.pixels
    }

    /// All pixels, row by row, to write to.
    pub fn pixels_mut(&mut self) -> &mut [T] {
        &mut self.pixels
    }

    /// The pixels themselves, row by row.
    pub fn into_pixels(self) -> Vec<T> {
        self.pixels
    }

    /// The pixel in column `x`, row `y`.
    pub fn at(&self, x: u32, y: u32) -> &T {
        debug_assert!(x < self.width, "column {x} of {}", self.width);
        &self.pixels[y as usize * self.width as usize + x as usize]
    }

    /// A new image of the same shape, pixel by pixel.
    pub fn map<U>(&self, pixel: impl FnMut(&T) -> U) -> Image<U> {
        Image { width: self.width, height: self.height, pixels: self.pixels.iter().map(pixel).collect() }
    }
}

impl<T: Clone> Image<T> {
    /// The same value everywhere.
    pub fn filled(width: u32, height: u32, value: T) -> Self {
        Self { width, height, pixels: vec![value; width as usize * height as usize] }
    }
}
