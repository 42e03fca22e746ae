/// Chooses rows at a steady pace, across blocks.
#[derive(Debug)]
pub(crate) struct RowPace {
    period_s: f64,
    next_s: f64,
}

impl RowPace {
    /// At most one row a period (s), the first one always.
    pub fn new(period_s: f64) -> Self {
        Self { period_s, next_s: f64::NEG_INFINITY }
    }

    /// Whether the row at this time is one of them.
    pub fn takes(&mut self, time_s: f64) -> bool {
        // A hundredth of a period is allowed: clocks are rounded.
        let due = time_s >= self.next_s - 0.01 * self.period_s;
        if due {
            self.next_s = time_s + self.period_s;
        }
        due
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_tenth_of_the_rows_is_taken_whatever_the_rounding_of_the_clock() {
        let mut pace = RowPace::new(0.02);
        let taken = (0..30_000).filter(|&i| pace.takes(f64::from(i) / 500.0)).count();
        assert_eq!(taken, 3000);
        let mut pace = RowPace::new(0.02);
        let mut time_s = 1e5;
        let taken = (0..30_000).filter(|_| {
            time_s += 0.002;
            pace.takes(time_s)
        });
        assert_eq!(taken.count(), 3000);
    }

    #[test]
    fn slow_rows_are_all_taken() {
        let mut pace = RowPace::new(0.02);
        assert!((0..100).all(|i| pace.takes(f64::from(i) / 40.0)));
    }
}
