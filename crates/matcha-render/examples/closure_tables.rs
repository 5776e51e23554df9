//! Writes the albedo tables of the microfacet closures anew.

use matcha_render::closure::integrate::integrate_tables;
use std::path::Path;

fn main() -> std::io::Result<()> {
    let target = Path::new(env!("CARGO_MANIFEST_DIR")).join("src/closure/tables.bin");
    std::fs::write(&target, integrate_tables(1 << 14).to_bytes())
}
