//! The `stillage` command.

fn main() -> std::process::ExitCode {
    stillage::cli::run()
}
