/// What a design explains.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Look {
    /// The efforts.
    Effort,
    /// What the first encoder of a joint reports beyond the position of its link, where a second
    /// one shows it.
    Twist,
}
