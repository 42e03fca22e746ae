/// The signal that a design explains.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Response {
    /// The efforts.
    Effort,
    /// The position that the first encoder of a joint reports minus that of the link, which a second encoder shows.
    Twist,
}
