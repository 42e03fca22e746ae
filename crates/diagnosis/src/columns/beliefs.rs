/// What is believed of every weight before any data.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Beliefs<'a> {
    /// Standard deviations.
    pub prior: &'a [f64],
    /// Lowest and highest physically possible values.
    pub bounds: &'a [(f64, f64)],
}
