use logs::Run;

/// Makes time run `factor` times as fast as it should from a row on.
///
/// ```text
/// t' = t_from + factor (t - t_from),   t_from = 0 for a whole log
/// ```
pub(crate) fn run_faster(run: &mut Run, factor: f64, from: usize) {
    let Some(&time) = run.time.get(from) else { return };
    let start = if from == 0 { 0.0 } else { time };
    run.time[from..].iter_mut().for_each(|t| *t = start + factor * (*t - start));
}
