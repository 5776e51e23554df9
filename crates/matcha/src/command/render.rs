//! `matcha render`: one picture.

use crate::End;
use crate::arguments::RenderArguments;
use crate::output::{self, Format};
use crate::picture::{exr_file, png_file};
use crate::session::{self, FullStatistics, Loaded};
use anyhow::Result;
use matcha_render::backend::Backend;
use matcha_render::film::Film;

pub(crate) fn run(arguments: &RenderArguments) -> Result<End> {
    let format = output::format_of(&arguments.output)?;
    output::check_file(&arguments.output)?;
    if let Some(stats) = &arguments.options.stats {
        output::check_file(stats)?;
    }
    let loaded = Loaded::new(&arguments.scene, &arguments.options)?;
    let mut backend = loaded.backend(&arguments.options, arguments.cache)?;
    let complete = session::render(&loaded, &mut [&mut backend])?;
    let bytes = encode(backend.film(), format, &loaded)?;
    output::write(&arguments.output, &bytes)?;
    if let Some(stats) = &arguments.options.stats {
        output::write_json(stats, &FullStatistics::of(&loaded, &backend))?;
    }
    let statistics = backend.statistics();
    println!(
        "{}: {} samples a pixel in {:.2} s on {}",
        arguments.output.display(),
        backend.film().samples(),
        statistics.seconds,
        backend.device()
    );
    Ok(if complete {
        End::Done
    } else {
        End::Interrupted
    })
}

fn encode(film: &Film, format: Format, loaded: &Loaded) -> Result<Vec<u8>> {
    Ok(match format {
        Format::Exr => exr_file::encode(film)?,
        Format::Png => {
            png_file::encode_linear(film.width(), film.height(), &film.combined(), &loaded.view)?
        }
    })
}
