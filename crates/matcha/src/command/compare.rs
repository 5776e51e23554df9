//! `matcha compare`: the paper's figure for a scene.

use super::report::Report;
use crate::End;
use crate::arguments::{Cache, CompareArguments};
use crate::device::Device;
use crate::output;
use crate::picture::figure::{self, Panel};
use crate::picture::{difference, exr_file, heat, png_file};
use crate::session::{self, FullStatistics, Loaded};
use anyhow::{Context, Result};
use image::RgbImage;
use matcha_render::backend::Backend;
use serde::Serialize;

const WITHOUT: &str = "without.exr";
const WITH: &str = "with.exr";
const DIFFERENCE: &str = "difference.png";
const HEAT_MAP: &str = "heatmap.png";
const FIGURE: &str = "figure.png";
const REPORT: &str = "report.json";
/// What is written.
const FILES: [&str; 6] = [WITHOUT, WITH, DIFFERENCE, HEAT_MAP, FIGURE, REPORT];

/// Both renderings' statistics.
#[derive(Serialize)]
struct BothStatistics {
    without: FullStatistics,
    with: FullStatistics,
}

pub(crate) fn run(arguments: &CompareArguments) -> Result<End> {
    output::make_folder(&arguments.output)?;
    if let Some(stats) = &arguments.options.stats {
        let mut others = FILES.map(|name| arguments.output.join(name)).to_vec();
        others.push(arguments.scene.scene.clone());
        output::check_statistics(stats, &others)?;
    }
    let device = Device::choose(&arguments.options)?;
    let loaded = Loaded::new(&arguments.scene, &arguments.options)?;
    let caches = [Cache::Off, arguments.cache];
    let mut backends = loaded.backends(&device, &arguments.options, caches)?;
    let outcome = session::render(&loaded, &mut backends)?;
    let [without, with] = backends.each_ref().map(AsRef::as_ref);
    let shown = Shown::new(&loaded, without, with)?;
    let report = Report::new(&loaded, without, with, [&shown.without, &shown.with]);
    write_all(arguments, &shown, &report, [without, with])?;
    if let Some(stats) = &arguments.options.stats {
        let both = BothStatistics {
            without: FullStatistics::of(&loaded, without),
            with: FullStatistics::of(&loaded, with),
        };
        output::write_json(stats, &both)?;
    }
    output::print(&format!(
        "{}\npictures and report are in {}\n",
        report.summary(),
        arguments.output.display()
    ))?;
    outcome.end(&arguments.output)
}

/// The pictures as people see them.
struct Shown {
    without: RgbImage,
    with: RgbImage,
    difference: RgbImage,
    heat_map: RgbImage,
}

impl Shown {
    fn new(loaded: &Loaded, without: &dyn Backend, with: &dyn Backend) -> Result<Self> {
        let [width, height] = loaded.resolution();
        let show = |backend: &dyn Backend| {
            let bytes = loaded.view.bytes(&backend.film().combined());
            RgbImage::from_raw(width, height, bytes).context("the film is smaller than its picture")
        };
        let without_cache = show(without)?;
        let with_cache = show(with)?;
        Ok(Self {
            difference: difference::magnified(width, height, &with_cache, &without_cache),
            heat_map: heat::map(width, height, &with.film().nodes_found()),
            without: without_cache,
            with: with_cache,
        })
    }

    fn figure(&self, report: &Report) -> RgbImage {
        let [without, with, difference, nodes] = report.captions();
        let panel = |picture: &RgbImage, lines, heat| Panel {
            picture: picture.clone(),
            lines,
            heat,
        };
        figure::compose(&[
            panel(&self.without, without, false),
            panel(&self.with, with, false),
            panel(&self.difference, difference, false),
            panel(&self.heat_map, nodes, true),
        ])
    }
}

fn write_all(
    arguments: &CompareArguments,
    shown: &Shown,
    report: &Report,
    [without, with]: [&dyn Backend; 2],
) -> Result<()> {
    let path = |name: &str| arguments.output.join(name);
    output::write(&path(WITHOUT), &exr_file::encode(without.film())?)?;
    output::write(&path(WITH), &exr_file::encode(with.film())?)?;
    output::write(&path(DIFFERENCE), &png_file::encode(&shown.difference)?)?;
    output::write(&path(HEAT_MAP), &png_file::encode(&shown.heat_map)?)?;
    output::write(&path(FIGURE), &png_file::encode(&shown.figure(report))?)?;
    output::write_json(&path(REPORT), report)
}
