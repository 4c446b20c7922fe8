//! Why a command failed, and with which code it ends.

/// Why a command failed.
#[derive(Debug)]
pub(super) enum Failure {
    /// The input is wrong: one sentence with cause and remedy.
    Input(String),
    /// The program or the system is at fault.
    Internal(String),
}

impl Failure {
    /// A fault of the program or the system.
    pub(super) fn internal(error: impl std::fmt::Display) -> Self {
        Self::Internal(error.to_string())
    }

    /// What keeps a service from starting is most often how it was set up; the message says what to change.
    pub(super) fn setup(error: impl std::fmt::Display) -> Self {
        Self::Input(error.to_string())
    }
}
