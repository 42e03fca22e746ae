//! Rows that repeat the values of earlier rows: messages that were logged more often than they came.

use std::collections::BTreeMap;

use crate::checks::impossible::quantile;
use crate::reading::even_rows::{EvenRows, fill, rate};
use crate::runs::repair::Repair;
use crate::runs::run::{Channel, Channels, median};
use crate::signals::clock::interpolate;
use crate::signals::lattice;

/// Steps of a signal's lattice that a value must move between two rows, so that a repeated value in between is no chance.
const SURE_STEPS: f64 = 3.0;
/// Fewest repeats that are taken for a habit of the log.
const FEWEST: usize = 20;
/// Least mean age of the values of a log (s) that is changed; a younger log has no error that its band shows: 0.2 ms are
/// 4 mrad of phase at 3 Hz.
const LEAST_AGE_S: f64 = 2e-4;
/// Longest repeat, in those that nine of ten do not exceed. A longer one is a joint at rest, or a log that stood still.
const LONGEST: f64 = 3.0;
/// Rows for each value, at an uneven rate, below which values are interpolated to the rows between: their clock stays even.
const FEW_ROWS: f64 = 2.5;
/// Fewest rows of a mean interval of a signal that is held at a rate of its own, while others are new in every row.
const FEWEST_ROWS_OF_SIGNAL: f64 = 1.4;
/// Share of the signals of a kind that must be held, so that all signals are taken at their rate.
const MOST_SIGNALS: f64 = 0.5;

/// Takes the values of a run at the rows at which they are new, where rows repeat values of a moving arm.
///
/// A log is often written at the rate of its fastest message, and every other message is repeated until the next one
/// comes. The staircase that this makes is no motion: its steps are accelerations that nothing made.
///
/// - **Rows that repeat all** positions and efforts are left out, or interpolated where they are few. A joint moves on, by
///   [`SURE_STEPS`] steps of its encoder or more and in the same direction, before and after such a row. A longer stretch
///   without news is a rest, of which rows at the usual interval are kept, or a freeze, which is left to the inspection.
/// - **Signals of a slower message** are known at a rate of their own. All others are interpolated to it, by the same cubic as
///   rows with jitter, where half of the positions or half of the efforts are such.
///
/// Values that come at an even rate get an even clock where their rows are late by less than a row.
///
/// A commanded effort that alone is held is the command as it acts, and stays.
pub(crate) fn take_new_values(
    time: &mut Vec<f64>,
    joints: &mut [Channels],
    extra: &mut BTreeMap<String, Vec<f64>>,
    efforts: EffortOrigin,
) -> Vec<Repair> {
    let mut made = Vec::new();
    if let Some(news) = News::of_rows(time, joints, efforts) {
        let rows = time.len();
        let repeats = rows - news.known.as_ref().map_or(news.rows.len(), |known| known.0.len());
        let is_left_out = news.known.is_none();
        let log_hz = rate(time);
        let rate_hz = news.rate_hz();
        news.take(time, joints, extra);
        made.push(Repair::Repeats { repeats: [repeats, rows], log_hz, rate_hz, is_left_out });
    }
    if let Some((news, held)) = News::of_signals(time, joints, efforts) {
        let (log_hz, rate_hz) = (rate(time), news.rate_hz().unwrap_or_default());
        news.take(time, joints, extra);
        made.push(Repair::Held { held, log_hz, rate_hz });
    }
    made
}

/// What the efforts of a run are, for the question whether they may be held.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum EffortOrigin {
    /// Values of a sensor.
    Measured,
    /// Commands, which act for as long as they are held.
    Commanded,
    /// Computed later, from goals.
    Computed,
}

/// Rows at which values are new, and their times.
struct News {
    rows: Vec<usize>,
    /// Time of each (s), not later than that of its row.
    time: Vec<f64>,
    /// Mean interval of values that come at an even rate (s).
    interval_s: Option<f64>,
    /// Whether each signal has its values at these rows.
    is_new: Vec<[bool; 2]>,
    /// Rows and times of what is known of all signals, where the rows between them are interpolated.
    known: Option<(Vec<usize>, Vec<f64>)>,
}

/// The signals that are asked, in the order of [`News::is_new`].
const ASKED: [Channel; 2] = [Channel::Position, Channel::Effort];

impl News {
    fn rate_hz(&self) -> Option<f64> {
        self.interval_s.map(f64::recip)
    }

    /// The rows of a log that repeats whole rows; `None` where none does.
    fn of_rows(time: &[f64], joints: &[Channels], efforts: EffortOrigin) -> Option<Self> {
        let asked = if efforts == EffortOrigin::Computed { &ASKED[..1] } else { &ASKED[..] };
        let signals: Vec<&[f64]> = joints
            .iter()
            .flat_map(|joint| asked.iter().filter_map(|channel| joint.get(*channel)))
            .collect();
        let is_new = |k: &usize| *k == 0 || signals.iter().any(|x| differ(x[*k], x[k - 1]));
        let new: Vec<usize> = (0..time.len()).filter(is_new).collect();
        if time.len() - new.len() < FEWEST {
            return None;
        }
        let positions: Vec<Signal> =
            joints.iter().map(|joint| Signal::of(&joint.position)).collect();
        let moves = |rows: &[usize]| positions.iter().any(|signal| signal.moves_on(rows));
        // The arm moves on where a row repeats; rows[1] .. rows[2] is the interval with repeats.
        let repeats: Vec<f64> = new
            .windows(3)
            .filter(|rows| rows[2] - rows[1] > 1 && moves(rows))
            .map(|rows| (rows[2] - rows[1]) as f64)
            .collect();
        // In an interval of n rows values are 0, 1, .. n - 1 rows old.
        let ages: f64 = repeats.iter().map(|rows| 0.5 * rows * (rows - 1.0)).sum();
        if repeats.len() < FEWEST || ages / time.len() as f64 / rate(time) < LEAST_AGE_S {
            return None;
        }
        let longest = (LONGEST * quantile(repeats, 0.9)) as usize;
        let even = EvenRows::of(&new[1..], longest);
        // The first value may have come before the first row.
        let first = usize::from(even.is_some());
        let rows = fill(&new[first..], time.len(), longest, even.as_ref());
        let own: Vec<f64> = rows.iter().map(|row| time[*row]).collect();
        let is_new = vec![[true; 2]; joints.len()];
        if even.is_none() && (rows.len() as f64) * FEW_ROWS > time.len() as f64 {
            let (known, rows) = (Some((rows, own)), (0..time.len()).collect());
            return Some(Self { rows, time: time.to_vec(), interval_s: None, is_new, known });
        }
        let (time, interval_s) = match even.and_then(|even| even.clock(time, &rows)) {
            Some((clock, interval_s)) => (clock, Some(interval_s)),
            None => (own, None),
        };
        Some(Self { rows, time, interval_s, is_new, known: None })
    }

    /// The rows of the slowest signals, and what these are; `None` where fewer than half of the positions and of the
    /// efforts are held.
    fn of_signals(
        time: &[f64],
        joints: &[Channels],
        efforts: EffortOrigin,
    ) -> Option<(Self, &'static str)> {
        let ways = [
            (Channel::Position, "positions", true),
            (Channel::Effort, "efforts", efforts == EffortOrigin::Measured),
        ];
        let mut slowest: Option<(Self, &'static str)> = None;
        for (channel, words, _) in ways.into_iter().filter(|way| way.2) {
            let all: Vec<&[f64]> = joints.iter().filter_map(|joint| joint.get(channel)).collect();
            let held: Vec<Option<Vec<usize>>> =
                all.iter().map(|x| Signal::of(x).find_new_rows()).collect();
            let varied = all.iter().filter(|x| x.iter().any(|value| differ(*value, x[0]))).count();
            let count = held.iter().flatten().count();
            if count == 0 || (count as f64) < MOST_SIGNALS * varied as f64 {
                continue;
            }
            let Some(rows) = held.iter().flatten().min_by_key(|rows| rows.len()) else { continue };
            let longest = (LONGEST * middle_interval(rows)) as usize;
            let Some(even) = EvenRows::of(&rows[1..], longest) else { continue };
            let rows = fill(&rows[1..], time.len(), longest, Some(&even));
            if slowest.as_ref().is_some_and(|(slowest, _)| slowest.rows.len() <= rows.len()) {
                continue;
            }
            let own = rows.iter().map(|row| time[*row]).collect();
            let (own, interval_s) =
                even.clock(time, &rows).unwrap_or((own, even.rows / rate(time)));
            let is_own =
                |signal: Option<&[f64]>| signal.is_some_and(|x| is_constant_between(x, &rows));
            let is_new = joints
                .iter()
                .map(|joint| ASKED.map(|channel| is_own(joint.get(channel))))
                .collect();
            let interval_s = Some(interval_s);
            slowest = Some((Self { rows, time: own, interval_s, is_new, known: None }, words));
        }
        slowest
    }

    /// Takes the values at these rows. Signals that come at the rows' own rate are interpolated to the clock.
    fn take(
        self,
        time: &mut Vec<f64>,
        joints: &mut [Channels],
        extra: &mut BTreeMap<String, Vec<f64>>,
    ) {
        let at_rows = |x: &[f64]| -> Vec<f64> { self.rows.iter().map(|row| x[*row]).collect() };
        for (joint, is_new) in joints.iter_mut().zip(&self.is_new) {
            for channel in Channel::ALL {
                // Derivatives are of the message that has the position.
                let is_new = match channel {
                    Channel::Position
                    | Channel::Velocity
                    | Channel::Acceleration
                    | Channel::LinkPosition => is_new[0],
                    Channel::Effort => is_new[1],
                    _ => true,
                };
                // Efforts that are computed later are not there yet.
                let Some(x) = joint.get(channel).filter(|x| !x.is_empty()) else { continue };
                let taken = match &self.known {
                    Some((rows, t)) => {
                        let x: Vec<f64> = rows.iter().map(|row| x[*row]).collect();
                        interpolate(t, &x, &self.time)
                    }
                    None if is_new => at_rows(x),
                    None => self.resample_signal(time, x),
                };
                joint.set(channel, taken);
            }
        }
        extra.values_mut().for_each(|x| *x = at_rows(x));
        *time = self.time;
    }

    /// A signal that has no new values at these rows, at their times: between its own values where it is held too, else
    /// between the rows.
    fn resample_signal(&self, time: &[f64], x: &[f64]) -> Vec<f64> {
        match Signal::of(x).find_new_rows().map(|rows| with_last(&rows, x.len())) {
            Some(rows) => {
                let t: Vec<f64> = rows.iter().map(|row| time[*row]).collect();
                let x: Vec<f64> = rows.iter().map(|row| x[*row]).collect();
                interpolate(&t, &x, &self.time)
            }
            None => interpolate(time, x, &self.time),
        }
    }
}

/// A signal and the step of the lattice on which its values lie; zero without a lattice.
struct Signal<'a> {
    x: &'a [f64],
    step: f64,
}

impl<'a> Signal<'a> {
    fn of(x: &'a [f64]) -> Self {
        Self { x, step: lattice::step(x).unwrap_or(0.0) }
    }

    /// Whether the signal moves from the first of three rows to the second, and on to the third.
    fn moves_on(&self, rows: &[usize]) -> bool {
        let [before, after] = [0, 1].map(|k| self.x[rows[k + 1]] - self.x[rows[k]]);
        let least = SURE_STEPS * self.step;
        before * after > 0.0 && before.abs() >= least && after.abs() >= least
    }

    /// The rows at which the signal has a new value, where that comes at a rate slower than that of the rows.
    fn find_new_rows(&self) -> Option<Vec<usize>> {
        let is_new = |k: &usize| *k == 0 || differ(self.x[*k], self.x[k - 1]);
        let new: Vec<usize> = (0..self.x.len()).filter(is_new).collect();
        if new.len() < FEWEST || new.len() as f64 * FEWEST_ROWS_OF_SIGNAL > self.x.len() as f64 {
            return None;
        }
        let longest = (LONGEST * middle_interval(&new)) as usize;
        EvenRows::of(&new[1..], longest)?;
        let jumps: Vec<f64> =
            new.windows(2).map(|rows| (self.x[rows[1]] - self.x[rows[0]]).abs()).collect();
        (median(&jumps) >= SURE_STEPS * self.step).then_some(new)
    }
}

/// The rows of new values with the last row, so that an interpolation reaches it.
fn with_last(new: &[usize], rows: usize) -> Vec<usize> {
    let last = rows.saturating_sub(1);
    let more = new.last().is_some_and(|row| *row < last).then_some(last);
    new.iter().copied().chain(more).collect()
}

/// Whether a signal changes at no other rows than these.
fn is_constant_between(x: &[f64], rows: &[usize]) -> bool {
    let mut next = rows.iter().peekable();
    (0..x.len()).all(|k| {
        let is_row = next.next_if(|row| **row == k).is_some();
        is_row || k == 0 || !differ(x[k], x[k - 1])
    })
}

/// Median interval between rows.
fn middle_interval(rows: &[usize]) -> f64 {
    let intervals: Vec<f64> = rows.windows(2).map(|rows| (rows[1] - rows[0]) as f64).collect();
    median(&intervals)
}

fn differ(a: f64, b: f64) -> bool {
    a.to_bits() != b.to_bits()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Rate of the messages (Hz).
    const RATE_HZ: f64 = 100.0;

    /// A joint that swings, and its effort with a part that looks drawn, at a time (s).
    fn at(t: f64, joint: usize) -> [f64; 2] {
        let phase = joint as f64;
        let q = 0.8 * (2.1 * t + phase).sin() + 0.2 * (5.3 * t).cos();
        [1e-5 * (q / 1e-5).round(), 3.0 * (1.9 * t - phase).sin() + 1e-3 * (1e4 * t).sin()]
    }

    /// Rows of which each has, of two joints, the message of the time that `message` gives.
    fn log(rows: &[f64], message: impl Fn(f64, usize, usize) -> f64) -> Vec<Channels> {
        let channel =
            |j: usize, k: usize| rows.iter().map(|t| at(message(*t, j, k), j)[k]).collect();
        let joint = |j: usize| Channels {
            name: format!("j{j}"),
            position: channel(j, 0),
            effort: channel(j, 1),
            ..Channels::default()
        };
        vec![joint(0), joint(1)]
    }

    fn rows(rate_hz: f64) -> Vec<f64> {
        (0..(20.0 * rate_hz) as usize).map(|k| k as f64 / rate_hz).collect()
    }

    /// Time of the last message that came before `t`, of messages `ahead` seconds before whole hundredths.
    fn last(t: f64, ahead: f64) -> f64 {
        ((t + ahead) * RATE_HZ + 1e-6).floor() / RATE_HZ - ahead
    }

    fn take(time: &mut Vec<f64>, joints: &mut [Channels]) -> Vec<Repair> {
        take_new_values(time, joints, &mut BTreeMap::new(), EffortOrigin::Measured)
    }

    /// Largest difference between a log and the signals at its times: of positions and of efforts.
    fn off(time: &[f64], joints: &[Channels]) -> [f64; 2] {
        let mut most = [0.0_f64; 2];
        for (j, joint) in joints.iter().enumerate() {
            for (k, t) in time.iter().enumerate() {
                let [q, tau] = at(*t, j);
                most[0] = most[0].max((joint.position[k] - q).abs());
                most[1] = most[1].max((joint.effort[k] - tau).abs());
            }
        }
        most
    }

    #[test]
    fn messages_that_are_repeated_at_any_rate_of_rows_come_back_at_their_times() {
        for rate_hz in [150.0, 250.0, 500.0, 1000.0, 333.3] {
            let mut time = rows(rate_hz);
            // Messages do not begin with the log.
            let mut joints = log(&time, |t, _, _| last(t, -0.4 / RATE_HZ));
            let made = take(&mut time, &mut joints);
            let [Repair::Repeats { rate_hz: Some(found), .. }] = made[..] else {
                panic!("{made:?}")
            };
            assert!((found / RATE_HZ - 1.0).abs() < 1e-3, "{found} Hz in rows of {rate_hz}");
            assert!((time.len() as f64 - 2000.0).abs() < 3.0, "{}", time.len());
            // At rates in a ratio of small numbers every message may be late by up to half a row, which nothing shows.
            let [q, tau] = off(&time, &joints);
            let late_s = 0.5 / rate_hz;
            assert!(q < 1e-3 + 2.8 * late_s, "{q} rad off in rows of {rate_hz} Hz");
            assert!(tau < 1e-2 + 6.0 * late_s, "{tau} N m off in rows of {rate_hz} Hz");
            assert_eq!(take(&mut time, &mut joints), []);
        }
    }

    #[test]
    fn efforts_of_a_slower_message_and_signals_of_other_phases_are_brought_together() {
        for ahead in [0.0, 0.004] {
            let mut time = rows(500.0);
            let all = |t: f64, j: usize, k: usize| last(t, ahead * ((2 * j + k) as f64 / 3.0));
            let of_efforts = |t: f64, j: usize, k: usize| if k == 0 { t } else { all(t, j, k) };
            let mut joints = log(&time, of_efforts);
            let made = take(&mut time, &mut joints);
            assert!(matches!(made[..], [Repair::Held { held: "efforts", .. }]), "{made:?}");
            let [q, tau] = off(&time, &joints);
            assert!(q < 5e-3 && tau < 5e-2, "{q} rad, {tau} N m off");

            let mut time = rows(500.0);
            let mut joints = log(&time, all);
            let made = take(&mut time, &mut joints);
            assert_eq!(made.len(), 1, "{made:?}");
            let [q, tau] = off(&time, &joints);
            assert!(q < 1e-2 && tau < 5e-2, "{q} rad, {tau} N m off, {made:?}");
        }
    }

    #[test]
    fn rows_that_repeat_by_chance_are_interpolated_and_the_clock_stays() {
        let mut time = rows(RATE_HZ);
        let before = time.clone();
        // A third of the rows, in no order: a multiplicative hash.
        let stale = |row: usize| row > 0 && ((row * 2_654_435_761) >> 16).is_multiple_of(3);
        let source = |t: f64| {
            let row = (t * RATE_HZ).round() as usize;
            (0..=row).rev().find(|row| !stale(*row)).unwrap_or(0) as f64 / RATE_HZ
        };
        let mut joints = log(&time, |t, _, _| source(t));
        let made = take(&mut time, &mut joints);
        assert!(matches!(made[..], [Repair::Repeats { is_left_out: false, .. }]), "{made:?}");
        assert_eq!(time, before);
        let [q, tau] = off(&time, &joints);
        assert!(q < 1e-3 && tau < 5e-2, "{q} rad, {tau} N m off");
    }

    #[test]
    fn what_stands_and_coarse_encoders_repeat_themselves_rightly() {
        // Slow motions of a coarse encoder, and an effort that follows its steps.
        for step in [1.5e-3, 0.02] {
            let mut time = rows(500.0);
            let coarse = |x: f64| step * (x / step).round();
            let mut joints = log(&time, |t, _, _| t);
            for joint in &mut joints {
                joint.position.iter_mut().for_each(|q| *q = coarse(*q));
                joint.effort = joint.position.iter().map(|q| -40.0 * q).collect();
            }
            let before = joints.clone();
            assert_eq!(take(&mut time, &mut joints), []);
            assert_eq!(joints, before);
        }
        // A rest of 2 s every 4 s, without noise.
        let mut time = rows(500.0);
        let move_on = |t: f64| (t / 4.0).floor() * 2.0 + (t % 4.0).min(2.0);
        let mut joints = log(&time, |t, _, _| move_on(t));
        assert_eq!(take(&mut time, &mut joints), []);
        // The same where messages are repeated: rests stay, at the rate of the messages.
        let mut joints = log(&time, |t, _, _| move_on(last(t, 0.0)));
        let made = take(&mut time, &mut joints);
        assert!(matches!(made[..], [Repair::Repeats { rate_hz: Some(_), .. }]), "{made:?}");
        assert!((time.len() as f64 - 2000.0).abs() < 30.0, "{}", time.len());
        assert!(time.windows(2).all(|t| (t[1] - t[0] - 0.01).abs() < 1e-3));
    }

    /// A log of goals and positions alone, whose efforts are not computed yet.
    #[test]
    fn logs_without_efforts_are_read_at_the_rate_of_their_positions() {
        let mut time = rows(500.0);
        let mut joints = log(&time, |t, _, _| last(t, 0.0));
        joints.iter_mut().for_each(|joint| {
            joint.desired_position = Some(joint.position.clone());
            joint.effort.clear();
        });
        let made =
            take_new_values(&mut time, &mut joints, &mut BTreeMap::new(), EffortOrigin::Computed);
        assert_eq!((made.len(), joints[0].effort.len()), (1, 0));
        assert_eq!(joints[1].desired_position.as_ref().map(Vec::len), Some(time.len()));
    }

    /// A command acts for as long as it is held.
    #[test]
    fn commands_that_are_held_stay() {
        let mut time = rows(500.0);
        let mut joints = log(&time, |t, _, k| if k == 0 { t } else { last(t, 0.0) });
        let made =
            take_new_values(&mut time, &mut joints, &mut BTreeMap::new(), EffortOrigin::Commanded);
        assert_eq!((made, time.len()), (Vec::new(), 10_000));
    }
}
