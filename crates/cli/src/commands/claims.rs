//! `umbrage claims`: what the documents say, measured.

use super::evaluate::command_line;
use super::{open_gpu, open_truth_gpu};
use crate::args::ClaimsArgs;
use crate::claims::{self, CostBook, Judge, Registry};
use crate::clock::{self, Now};
use crate::error::CliError;
use crate::output::print;
use crate::run::provenance::adapter_card;
use crate::suite::{BASIS_SAMPLES, Sampling, WINDOW};
use std::path::Path;
use umbrage_metrics::Bootstrap;
use umbrage_report::{ClaimsCard, ClaimsProvenance, CostOrigin, publish_claims, write_claims};
use umbrage_shadows::Gpu;

/// Where costs are committed, from the root of a checkout.
const COMMITTED_COSTS: &str = "reports/gpu/claims-cost.json";
/// Of `claims.json`.
const SCHEMA_VERSION: u32 = 1;

pub(crate) fn run(args: &ClaimsArgs) -> Result<(), CliError> {
    let registry = match &args.registry {
        Some(path) => Registry::read(path)?,
        None => Registry::built_in()?,
    };
    let claims = registry.select(&args.claims)?;
    let now = clock::now();
    let mut gpu = open_gpu(&args.gpu)?;
    eprintln!("adapter: {} ({})", gpu.description().name, gpu.description().device_type);
    std::fs::create_dir_all(&args.out).map_err(CliError::file(&args.out))?;
    let costs = costs(args, (&registry, &claims), (&mut gpu, &now))?;
    let truth_gpu = open_truth_gpu(args.truth.reference_on, &args.gpu)?;
    let settings = claims::Settings {
        truth_gpu,
        cache: args.cache.clone(),
        map_texels: args.map,
        sampling: sampling(args),
    };
    let needs = claims::needs(&claims, &registry)?;
    let measurements = claims::run(&needs, &settings, &mut gpu)?;
    let bootstrap = Bootstrap::default();
    let judge = Judge {
        registry: &registry,
        measurements: &measurements,
        costs: &costs,
        sampling: settings.sampling,
        bootstrap,
    };
    let judged = claims::assemble(&claims, &judge)?;
    let mut card = ClaimsCard {
        schema_version: SCHEMA_VERSION,
        provenance: provenance(args, (&gpu, &costs), &now),
        claims: judged.cards,
        times: costs.table(&registry.time, &bootstrap),
    };
    let index = write_claims(&args.out, &mut card, &judged.crops)?;
    if let Some(reports) = &args.publish {
        publish_claims(&args.out, reports)?;
    }
    if args.json {
        let path = args.out.join("claims.json");
        print(std::fs::read_to_string(&path).map_err(CliError::file(&path))?.trim_end())?;
    }
    for claim in &card.claims {
        eprintln!("{:<4} {}", claim.id, claim.verdict.label());
    }
    eprintln!("report: {}", index.display());
    if judged.broken.is_empty() { Ok(()) } else { Err(CliError::NotFinite(judged.broken.join("; "))) }
}

fn sampling(args: &ClaimsArgs) -> Sampling {
    let quick = args.quick;
    Sampling {
        size: args.size.unwrap_or(if quick { (192, 108) } else { (320, 180) }),
        window: if quick { 8 } else { WINDOW },
        seeds: args.seeds.unwrap_or(if quick { 2 } else { 4 }),
        first_seed: 0,
        samples: args.samples.unwrap_or(if quick { 128 } else { 512 }),
        basis_samples: BASIS_SAMPLES,
        tolerance: None,
        plant: None,
    }
}

/// From a file that was named; from this GPU; or from the file that is committed.
fn costs(
    args: &ClaimsArgs,
    (registry, claims): (&Registry, &[&claims::Claim]),
    (gpu, now): (&mut Gpu, &Now),
) -> Result<CostBook, CliError> {
    if let Some(path) = &args.costs {
        if !path.exists() {
            return Err(CliError::Usage(format!("there are no costs at {}", path.display())));
        }
        return CostBook::read(path);
    }
    let needs = claims::cost_needs(claims, registry)?;
    if needs.is_empty() || gpu.description().is_software() {
        return CostBook::read(Path::new(COMMITTED_COSTS));
    }
    let adapter = adapter_card(gpu);
    let origin = CostOrigin {
        adapter: adapter.name,
        driver: format!("{}, {}", adapter.driver, adapter.backend),
        width: args.cost_size.0,
        height: args.cost_size.1,
        shadow_map_texels: args.map,
        date: now.rfc3339.clone(),
        command: command_line(),
    };
    eprintln!("timing at {}x{}", origin.width, origin.height);
    let book = claims::measure_costs(&needs, (gpu, args.map), origin)?;
    book.write(&args.out.join("claims-cost.json"))?;
    if let Some(reports) = &args.publish {
        book.write(&reports.join("gpu/claims-cost.json"))?;
    }
    Ok(book)
}

fn provenance(args: &ClaimsArgs, (gpu, costs): (&Gpu, &CostBook), now: &Now) -> ClaimsProvenance {
    let sampling = sampling(args);
    ClaimsProvenance {
        tool_version: env!("CARGO_PKG_VERSION").into(),
        date: now.rfc3339.clone(),
        command: command_line(),
        adapter: adapter_card(gpu),
        width: sampling.size.0,
        height: sampling.size.1,
        frames: sampling.window,
        seeds: sampling.seeds,
        samples_per_half: sampling.samples,
        shadow_map_texels: args.map,
        costs: costs.origin().cloned(),
        notes: match &args.registry {
            Some(path) => vec![format!("claims of {}", path.display())],
            None => vec![],
        },
    }
}
