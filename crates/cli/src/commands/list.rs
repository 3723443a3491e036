//! `umbrage list`: what there is.

use crate::args::{ListArgs, Listed};
use crate::error::CliError;
use crate::output::print;
use crate::own;
use crate::run::provenance::describe_light;
use crate::scenes::find_scene;
use serde_json::{Value, json};
use umbrage_metrics::METRICS;
use umbrage_scene::{AreaLight, CameraPath, Scene, builtin_names};
use umbrage_shadows::{Calibration, VARIANTS, VariantId, adapters};

/// A heading and rows: one shape for text and JSON.
struct Table {
    columns: &'static [&'static str],
    rows: Vec<Vec<String>>,
}

pub(crate) fn run(args: &ListArgs) -> Result<(), CliError> {
    if args.scene.is_some() && !matches!(args.what, Listed::Paths | Listed::Lights) {
        return Err(CliError::Usage("--scene is for paths and lights".into()));
    }
    let table = match args.what {
        Listed::Scenes => scenes()?,
        Listed::Paths => paths(args)?,
        Listed::Lights => lights(args)?,
        Listed::Variants => variants(args)?,
        Listed::Metrics => metrics(),
        Listed::Adapters => adapter_table(),
    };
    print(&if args.json { json_of(&table) } else { text_of(&table) })
}

fn scenes() -> Result<Table, CliError> {
    let mut rows = Vec::new();
    for name in builtin_names() {
        let scene = Scene::builtin(name)?;
        let paths = scene.paths.iter().map(|p| p.name.clone()).collect::<Vec<_>>().join(" ");
        rows.push(vec![
            name.to_string(),
            scene.geometry.triangles.len().to_string(),
            paths,
            scene.title.clone(),
        ]);
    }
    Ok(Table { columns: &["scene", "triangles", "paths", "title"], rows })
}

/// The scene that was asked for, or those that come with the program.
fn asked(args: &ListArgs) -> Result<Vec<Scene>, CliError> {
    match &args.scene {
        Some(scene) => Ok(vec![find_scene(scene)?.0]),
        None => Ok(builtin_names().map(Scene::builtin).collect::<Result<_, _>>()?),
    }
}

fn paths(args: &ListArgs) -> Result<Table, CliError> {
    let scenes = asked(args)?;
    let row = |scene: &Scene, path: &CameraPath| {
        vec![scene.name.clone(), path.name.clone(), path.frames.len().to_string(), path.title.clone()]
    };
    let rows = scenes.iter().flat_map(|s| s.paths.iter().map(|p| row(s, p))).collect();
    Ok(Table { columns: &["scene", "path", "frames", "title"], rows })
}

fn lights(args: &ListArgs) -> Result<Table, CliError> {
    let scenes = asked(args)?;
    let row = |scene: &Scene, (i, light): (usize, &AreaLight)| {
        vec![scene.name.clone(), (i + 1).to_string(), describe_light(light)]
    };
    let rows = scenes.iter().flat_map(|s| s.lights.iter().enumerate().map(|l| row(s, l))).collect();
    Ok(Table { columns: &["scene", "--light", "light"], rows })
}

fn variants(args: &ListArgs) -> Result<Table, CliError> {
    let scene = Scene::builtin("colonnade")?;
    let both = Calibration::ALL.map(Calibration::name).join(" ");
    let built_in = VARIANTS.iter().map(|variant| {
        let id = VariantId { variant, calibration: Calibration::LightMatched };
        (id, both.clone())
    });
    let own = own::techniques(&args.own)?.into_iter().map(|id| (id, id.calibration.name().to_string()));
    let row = |(id, calibrations): (VariantId, String)| {
        let (info, variant) = (id.info(), id.variant);
        let passes = id.passes(&scene).join(" > ");
        vec![
            variant.name.to_string(),
            calibrations,
            info.document.to_string(),
            info.options,
            info.taps,
            passes,
            variant.technique.lights().describe().to_string(),
            info.title.to_string(),
        ]
    };
    let columns = &["variant", "calibrations", "document", "options", "taps", "passes", "lights", "title"];
    Ok(Table { columns, rows: built_in.chain(own).map(row).collect() })
}

fn metrics() -> Table {
    let row = |m: &umbrage_metrics::MetricInfo| {
        vec![
            m.id.to_string(),
            m.name.to_string(),
            m.unit.to_string(),
            m.range.to_string(),
            m.definition.to_string(),
        ]
    };
    Table {
        columns: &["metric", "name", "unit", "range", "definition"],
        rows: METRICS.iter().map(row).collect(),
    }
}

fn adapter_table() -> Table {
    let row =
        |a: umbrage_shadows::AdapterDescription| vec![a.name, a.device_type.to_string(), a.backend, a.driver];
    Table {
        columns: &["adapter", "type", "backend", "driver"],
        rows: adapters().into_iter().map(row).collect(),
    }
}

fn json_of(table: &Table) -> String {
    let object = |row: &Vec<String>| {
        let pairs = table.columns.iter().zip(row).map(|(column, cell)| ((*column).to_string(), json!(cell)));
        Value::Object(pairs.collect())
    };
    format!("{:#}", Value::Array(table.rows.iter().map(object).collect()))
}

/// Columns aligned, except the last, which may be long.
fn text_of(table: &Table) -> String {
    let header = table.columns.iter().map(|c| (*c).to_string()).collect::<Vec<_>>();
    let width = |column: usize| {
        let cells = table.rows.iter().chain([&header]).map(|row| row[column].chars().count());
        cells.max().unwrap_or(0)
    };
    let widths: Vec<usize> = (0..header.len()).map(width).collect();
    let line = |row: &Vec<String>| {
        let cells = row.iter().zip(&widths).map(|(cell, &width)| format!("{cell:width$}"));
        cells.collect::<Vec<_>>().join("  ").trim_end().to_string()
    };
    let lines: Vec<String> = [&header].into_iter().chain(&table.rows).map(line).collect();
    lines.join("\n")
}
