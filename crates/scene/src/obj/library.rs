//! Material libraries (MTL): diffuse colours, their pictures, and cut-outs.

use crate::Material;
use crate::picture::{Opacity, Picture};
use crate::texture::Wrap;
use glam::Vec3;
use std::path::Path;

/// Whether a library that can be read names a picture.
pub(super) fn has_pictures(path: &Path) -> bool {
    let bytes = std::fs::read(path).unwrap_or_default();
    let text = String::from_utf8_lossy(&bytes);
    text.lines().any(|line| is_used(line) && line.trim_start().starts_with("map_"))
}

/// The materials of a library; an unreadable one is a note, because shadows need no colours.
pub(super) fn read(path: &Path) -> (tobj::MTLLoadResult, Option<String>) {
    let name = path.display();
    let text = match std::fs::read(path) {
        Ok(bytes) => String::from_utf8_lossy(&bytes).into_owned(),
        Err(error) => {
            return (Ok(Default::default()), Some(format!("cannot read {name}: {error}; grey 0.5")));
        }
    };
    let kept: Vec<&str> = text.lines().map(str::trim).filter(|line| is_used(line)).collect();
    match tobj::load_mtl_buf(&mut kept.join("\n").as_bytes()) {
        Ok(loaded) => (Ok(loaded), None),
        Err(error) => (Ok(Default::default()), Some(format!("{name}: {error}; grey 0.5"))),
    }
}

/// The lines of a library that are used here: names, pictures and whole diffuse colours (tobj
/// panics at a colour of fewer than three numbers).
fn is_used(line: &str) -> bool {
    let mut words = line.split_whitespace();
    match words.next() {
        Some("newmtl") => true,
        Some("map_d" | "map_Kd") => words.next().is_some(),
        Some("Kd") => words.by_ref().take(3).filter(|word| word.parse::<f32>().is_ok()).count() == 3,
        _ => false,
    }
}

/// Without its `map_d` a material would shadow what it should not: that is an error. A missing
/// colour is a note.
pub(super) fn material(
    material: tobj::Material,
    folder: &Path,
    notes: &mut Vec<String>,
) -> Result<Material, String> {
    let name = material.name;
    let mut made = Material::plain(name.clone(), material.diffuse.map_or(Vec3::splat(0.5), Vec3::from));
    if let Some(line) = material.diffuse_texture {
        match picture(&line, folder) {
            Ok((picture, wrap)) => {
                // With a picture and no colour, the picture is the colour.
                made.albedo = material.diffuse.map_or(Vec3::ONE, Vec3::from);
                made.texture = Some(picture.texture(wrap));
            }
            Err(message) => notes.push(format!("material '{name}' is shown without its map_Kd: {message}")),
        }
    }
    if let Some(line) = material.dissolve_texture {
        let (picture, wrap) = picture(&line, folder).map_err(|message| {
            format!(
                "material '{name}' is cut out by its map_d: {message}; put the file there, or take the line out"
            )
        })?;
        made.mask = Some(picture.mask(wrap, Opacity::Dissolve)).filter(|mask| !mask.is_whole());
    }
    Ok(made)
}

fn picture(line: &str, folder: &Path) -> Result<(Picture, [Wrap; 2]), String> {
    let (name, wrap) = statement(line);
    let bytes = std::fs::read(folder.join(&name)).map_err(|error| format!("cannot read {name}: {error}"))?;
    let picture = Picture::decode(&bytes).map_err(|error| format!("{name}: {error}"))?;
    Ok((picture, [wrap; 2]))
}

/// A file's name after its options, of which `-clamp on` is used. Files from Windows write `\`.
fn statement(line: &str) -> (String, Wrap) {
    let mut words = line.split_whitespace().peekable();
    let mut wrap = Wrap::Repeat;
    while let Some(option) = words.next_if(|word| word.starts_with('-')) {
        let is_value = |word: &&str| word.parse::<f32>().is_ok() || ["on", "off"].contains(word);
        if matches!(option, "-imfchan" | "-type") {
            words.next();
        }
        while let Some(value) = words.next_if(is_value) {
            if option == "-clamp" && value == "on" {
                wrap = Wrap::Clamp;
            }
        }
    }
    (words.collect::<Vec<_>>().join(" ").replace('\\', "/"), wrap)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn options_stand_before_the_name() {
        assert_eq!(statement("a leaf.png"), ("a leaf.png".to_owned(), Wrap::Repeat));
        assert_eq!(statement("-s 1 2 1 -clamp on tex\\l.png"), ("tex/l.png".to_owned(), Wrap::Clamp));
        assert_eq!(statement("-imfchan m -bm 0.5 l.png"), ("l.png".to_owned(), Wrap::Repeat));
    }
}
