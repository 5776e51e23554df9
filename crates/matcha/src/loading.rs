//! From the command line's scene to an imported one, with its report in the log.

use crate::arguments::SceneArguments;
use crate::progress;
use anyhow::Result;
use matcha_import::{LoadOptions, Progress, load};
use matcha_render::scene::Scene;

/// Loads the scene; what was substituted goes to the log, once per kind.
pub(crate) fn load_scene(arguments: &SceneArguments) -> Result<Scene> {
    let options = LoadOptions {
        strict: arguments.strict,
        blender: arguments.blender.clone(),
        ..LoadOptions::default()
    };
    let spinner = progress::loading();
    let mut exporting = false;
    let imported = load(&arguments.scene, &options, &mut |step| {
        if !exporting && spinner.is_hidden() && matches!(step, Progress::Export { .. }) {
            exporting = true;
            tracing::info!("exporting {} through Blender", arguments.scene.display());
        }
        spinner.set_message(words(&step));
    });
    spinner.finish_and_clear();
    let imported = imported?;
    for item in imported.report.items() {
        if item.kind.is_note() {
            tracing::info!("{item}");
        } else {
            tracing::warn!("{item}");
        }
    }
    Ok(imported.scene)
}

fn words(step: &Progress) -> String {
    match step {
        Progress::Export { fraction, what } => {
            format!("exporting {:.0} %: {what}", fraction * 100.0)
        }
        Progress::Scene => "reading meshes and materials".into(),
        Progress::Images { done, total } => format!("decoding pictures {done}/{total}"),
        Progress::Tangents => "computing tangents".into(),
    }
}
