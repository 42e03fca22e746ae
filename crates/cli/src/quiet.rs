/// Whether a command prints nothing but errors, and the JSON if it is asked for (`--quiet`).
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Quiet(pub bool);
