/// An effort in words: thousandths of N·m or N, and two digits where it is smaller.
pub(crate) fn size(effort: f64) -> String {
    let is_small = effort.abs() > 0.0 && effort.abs() < 0.001;
    if is_small { format!("{effort:.1e}") } else { format!("{effort:.3}") }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn no_effort_that_is_there_reads_as_zero() {
        let words = [12.3456, 0.01234, 0.0, 0.000_234, -4e-9].map(size);
        assert_eq!(words, ["12.346", "0.012", "0.000", "2.3e-4", "-4.0e-9"]);
    }
}
