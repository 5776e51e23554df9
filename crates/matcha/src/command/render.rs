//! `matcha render`: one picture.

use crate::End;
use crate::arguments::RenderArguments;
use crate::device::Device;
use crate::output::{self, Format};
use crate::picture::{exr_file, png_file};
use crate::session::{self, FullStatistics, Loaded};
use anyhow::Result;
use matcha_render::film::Film;

pub(crate) fn run(arguments: &RenderArguments) -> Result<End> {
    let format = output::format_of(&arguments.output)?;
    output::check_file(&arguments.output)?;
    if let Some(stats) = &arguments.options.stats {
        let others = [arguments.output.clone(), arguments.scene.scene.clone()];
        output::check_statistics(stats, &others)?;
    }
    let device = Device::choose(&arguments.options)?;
    let loaded = Loaded::new(&arguments.scene, &arguments.options)?;
    let mut backends = loaded.backends(&device, &arguments.options, [arguments.cache])?;
    let outcome = session::render(&loaded, &mut backends)?;
    let [backend] = &backends;
    let bytes = encode(backend.film(), format, &loaded)?;
    output::write(&arguments.output, &bytes)?;
    if let Some(stats) = &arguments.options.stats {
        output::write_json(stats, &FullStatistics::of(&loaded, backend.as_ref()))?;
    }
    let statistics = backend.statistics();
    output::print(&format!(
        "{}: {} samples a pixel in {:.2} s on {}\n",
        arguments.output.display(),
        backend.film().samples(),
        statistics.seconds,
        backend.device()
    ))?;
    outcome.end(&arguments.output)
}

fn encode(film: &Film, format: Format, loaded: &Loaded) -> Result<Vec<u8>> {
    Ok(match format {
        Format::Exr => exr_file::encode(film)?,
        Format::Png => {
            png_file::encode_linear(film.width(), film.height(), &film.combined(), &loaded.view)?
        }
    })
}
