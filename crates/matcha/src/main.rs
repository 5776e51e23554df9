//! The `matcha` command.

fn main() -> std::process::ExitCode {
    matcha::main()
}
