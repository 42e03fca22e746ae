/// Prior of every weight: a normal distribution within bounds.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Prior<'a> {
    /// Standard deviations.
    pub sd: &'a [f64],
    /// Lowest and highest physically possible values.
    pub bounds: &'a [(f64, f64)],
    /// The weights of effects whose size is unknown by decades ([`effects::Hypothesis::has_any_scale`]).
    pub of_any_scale: &'a [Vec<usize>],
    /// Their scales, all as likely.
    pub scales: &'a [f64],
}
