use std::ops::Range;

use crate::runs::{repair::Repair, run::Run};

/// Number of samples, counted per joint, above which a diagnosis gains little: 20 minutes of seven joints at 500 Hz.
pub const ENOUGH_SAMPLES: usize = 4_200_000;

/// Length of a stretch (s).
const STRETCH_S: f64 = 60.0;

/// Fewest stretches that are kept. At a high rate each one is shorter than a minute.
const FEWEST: usize = 20;

/// Place of stretch `k` in its part of the logs: the fractional part of `k` times the golden section. The multiples of
/// the golden section spread evenly and never lock to a periodic motion.
const PHASE: f64 = 0.618_033_988_749_894_9;

/// Thins long logs out to `most` samples, counted per joint. Stretches of about a minute are kept, spread evenly over
/// the logs. Logs with no more samples are returned unchanged.
///
/// The logs are cut into `N` stretches, in order, and divided into `n = N most / samples` equal parts. One stretch of
/// each part is kept. A run without a kept stretch is left out; every other run gets a [`Repair::Stretches`].
pub fn thin_out(runs: Vec<Run>, most: usize) -> Vec<Run> {
    let samples: usize = runs.iter().map(|run| run.time.len() * run.joints.len()).sum();
    if samples <= most {
        return runs;
    }
    let cut: Vec<Vec<Range<usize>>> = runs.iter().map(|run| cut(run, most)).collect();
    let count = cut.iter().map(Vec::len).sum();
    let wanted = (count as f64 * most as f64 / samples as f64) as usize;
    let chosen = choose(count, wanted.max(1));
    let whole_s = runs.iter().map(length_s).sum();
    let mut first = 0;
    let mut kept: Vec<Run> = Vec::new();
    for (run, cut) in runs.into_iter().zip(cut) {
        let own = chosen.iter().filter_map(|k| cut.get(k.checked_sub(first)?).cloned());
        let own: Vec<Range<usize>> = own.collect();
        first += cut.len();
        if !own.is_empty() {
            kept.push(keep_rows(&run, &own));
        }
    }
    let taken_s = kept.iter().map(Run::recorded_s).sum();
    for run in &mut kept {
        for mend in &mut run.mended {
            if let Repair::Stretches { all, .. } = mend {
                *all = [taken_s, whole_s];
            }
        }
    }
    kept
}

/// The rows of a run, cut into stretches of equal length.
fn cut(run: &Run, most: usize) -> Vec<Range<usize>> {
    let rows = run.time.len();
    let in_time = STRETCH_S * rows as f64 / length_s(run).max(f64::MIN_POSITIVE);
    let longest = in_time.min((most / (FEWEST * run.joints.len().max(1))) as f64).max(1.0);
    let count = (rows as f64 / longest).ceil() as usize;
    (0..count).map(|k| k * rows / count..(k + 1) * rows / count).collect()
}

/// Chooses `wanted` of `count` numbers, one in each of `wanted` equal parts.
fn choose(count: usize, wanted: usize) -> Vec<usize> {
    let of = |part: usize| {
        let [from, to] = [part, part + 1].map(|p| p * count / wanted);
        from + ((part as f64 * PHASE).fract() * (to - from) as f64) as usize
    };
    (0..wanted).map(of).collect()
}

/// The run reduced to these rows, given in rising order.
fn keep_rows(run: &Run, kept: &[Range<usize>]) -> Run {
    let mut left = vec![false; run.time.len()];
    kept.iter().for_each(|rows| left[rows.clone()].fill(true));
    let apart = kept.windows(2).filter(|pair| pair[0].end < pair[1].start);
    let gaps_s = apart.map(|pair| run.time[pair[1].start] - run.time[pair[0].end]).collect();
    let mut thinned = run.with_rows(&left);
    thinned.mended.push(Repair::Stretches { gaps_s, all: [0.0; 2] });
    thinned
}

/// Time from the first to the last sample (s).
fn length_s(run: &Run) -> f64 {
    run.time.last().copied().unwrap_or(0.0) - run.time.first().copied().unwrap_or(0.0)
}

impl Run {
    /// Time from the first to the last sample, without the gaps that [`thin_out`] left (s).
    pub fn recorded_s(&self) -> f64 {
        let left_out = self.mended.iter().flat_map(|mend| match mend {
            Repair::Stretches { gaps_s, .. } => gaps_s.as_slice(),
            _ => &[],
        });
        length_s(self) - left_out.sum::<f64>()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::runs::run::Channels;

    /// A run of one joint at 10 Hz whose samples are numbered.
    fn run(name: &str, samples: usize) -> Run {
        let numbers: Vec<f64> = (0..samples).map(|k| k as f64).collect();
        let joint =
            Channels { position: numbers.clone(), effort: numbers.clone(), ..Channels::default() };
        Run {
            name: name.to_owned(),
            source: name.into(),
            sha256: String::new(),
            is_torn: false,
            mended: Vec::new(),
            time: numbers.iter().map(|k| 100.0 + 0.1 * k).collect(),
            joints: vec![joint],
            extra: [("more".to_owned(), numbers)].into(),
        }
    }

    #[test]
    fn logs_that_are_no_longer_than_is_enough_stay_as_they_are() {
        let runs = vec![run("a", 600), run("b", 400)];
        assert_eq!(thin_out(runs.clone(), 1000), runs);
    }

    #[test]
    fn of_a_longer_log_stretches_are_kept_that_are_spread_over_all_of_it() {
        // 200 minutes, of which 40 take part.
        let [kept] = <[Run; 1]>::try_from(thin_out(vec![run("a", 120_000)], 24_000)).unwrap();
        assert_eq!(kept.time.len(), 24_000);
        assert_eq!(kept.joints[0].position, kept.extra["more"]);
        let starts: Vec<f64> = std::iter::once(kept.time[0])
            .chain(kept.time.windows(2).filter(|t| t[1] - t[0] > 0.15).map(|t| t[1]))
            .collect();
        // One in each 300 s, but where two of them meet.
        for part in 0..40 {
            let [from, to] = [part, part + 1].map(|p| 100.0 + 300.0 * f64::from(p));
            let own = kept.time.iter().filter(|t| (from..to - 0.05).contains(*t)).count();
            assert_eq!(own, 600, "part {part}");
        }
        // Not always at the same place of it.
        let places: std::collections::BTreeSet<i64> =
            starts.iter().map(|t| ((t - 100.0) % 300.0 / 60.0).round() as i64 % 5).collect();
        assert_eq!(places.len(), 5);
        let Some(Repair::Stretches { gaps_s, all: [taken_s, whole_s] }) = kept.mended.first()
        else {
            panic!("nothing is said")
        };
        assert_eq!(gaps_s.len() + 1, starts.len());
        assert!((whole_s - 11_999.9).abs() < 1e-6 && (taken_s - 2399.9).abs() < 1e-6, "{taken_s}");
        assert!((kept.recorded_s() - taken_s).abs() < 1e-6);
    }

    #[test]
    fn of_many_logs_some_take_part_whole() {
        let runs: Vec<Run> = (0..100).map(|k| run(&k.to_string(), 600)).collect();
        let kept = thin_out(runs.clone(), 12_000);
        assert_eq!(kept.len(), 20);
        for kept in kept {
            let whole = &runs[kept.name.parse::<usize>().unwrap()];
            assert_eq!(kept.time, whole.time);
        }
    }

    #[test]
    fn a_log_of_few_rows_that_are_too_many_is_cut() {
        let kept = thin_out(vec![run("a", 1000)], 100);
        assert_eq!(kept[0].time.len(), 100);
    }
}
