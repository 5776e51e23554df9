//! The `matcha` command.
fn main() {}
