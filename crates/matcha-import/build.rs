//! Embeds the exporter: all Python files and manifests of the add-on folder.

use std::fmt::Write;
use std::path::{Path, PathBuf};
use std::{env, fs};

fn main() {
    let root =
        Path::new(&env::var("CARGO_MANIFEST_DIR").expect("cargo sets it")).join("../../blender");
    println!("cargo::rerun-if-changed={}", root.display());
    let mut files = Vec::new();
    collect(&root, &mut files);
    files.sort();
    let mut list = String::from("&[\n");
    for file in &files {
        println!("cargo::rerun-if-changed={}", file.display());
        let name = file
            .strip_prefix(&root)
            .expect("was found below it")
            .to_string_lossy()
            .replace('\\', "/");
        let full = fs::canonicalize(file).expect("was listed just now");
        writeln!(
            list,
            "    ({name:?}, include_bytes!({:?})),",
            full.display().to_string()
        )
        .expect("a string grows");
    }
    list.push_str("]\n");
    let out = PathBuf::from(env::var("OUT_DIR").expect("cargo sets it")).join("exporter_files.rs");
    fs::write(out, list).expect("OUT_DIR can be written");
}

fn collect(folder: &Path, files: &mut Vec<PathBuf>) {
    let Ok(entries) = fs::read_dir(folder) else {
        return;
    };
    for path in entries.flatten().map(|entry| entry.path()) {
        let name = path
            .file_name()
            .unwrap_or_default()
            .to_string_lossy()
            .into_owned();
        if path.is_dir() && !name.starts_with(['.', '_']) && name != "tests" {
            collect(&path, files);
        } else if path.extension().is_some_and(|e| e == "py" || e == "toml")
            && !name.starts_with("test_")
        {
            files.push(path);
        }
    }
}
