/// Prior of every weight: a normal distribution within bounds.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Prior<'a> {
    /// Standard deviations.
    pub sd: &'a [f64],
    /// Lowest and highest physically possible values.
    pub bounds: &'a [(f64, f64)],
}
