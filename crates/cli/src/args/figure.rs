//! Arguments of figures.

use clap::Args;
use std::path::PathBuf;

#[derive(Args, Debug)]
pub(crate) struct FigureArgs {
    /// Folder of a run: of `evaluate`, with or without techniques of your own, or of `score`.
    pub(crate) run: PathBuf,
    /// Scene of the window; the first one otherwise.
    #[arg(long, value_name = "NAME")]
    pub(crate) scene: Option<String>,
    /// Camera path of the window.
    #[arg(long, value_name = "NAME")]
    pub(crate) path: Option<String>,
    /// Variant, in this order (several by repeating): `chss`, `mine`, `chss/as-printed`; all but those as printed
    /// otherwise.
    #[arg(long = "variant", value_name = "NAME")]
    pub(crate) variants: Vec<String>,
    /// Inset inside the picture, in its pixels (several by repeating); the worst place of the first variant otherwise.
    #[arg(long = "crop", value_name = "X,Y,W,H", value_parser = parse_crop)]
    pub(crate) crops: Vec<[u32; 4]>,
    /// How many times pictures are magnified.
    #[arg(long, value_name = "N", default_value_t = 2, value_parser = clap::value_parser!(u32).range(1..=16))]
    pub(crate) times: u32,
    /// Folder of the figures.
    #[arg(long, value_name = "DIR", default_value = "figures")]
    pub(crate) out: PathBuf,
}

fn parse_crop(text: &str) -> Result<[u32; 4], String> {
    let numbers: Result<Vec<u32>, _> = text.split(',').map(|n| n.trim().parse()).collect();
    match numbers.map(<[u32; 4]>::try_from) {
        Ok(Ok(crop)) if crop[2] > 0 && crop[3] > 0 => Ok(crop),
        _ => Err("left, top, width and height in pixels, as in 40,32,64,64".into()),
    }
}
