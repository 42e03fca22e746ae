use crate::watch::ControlTick;

/// Every tick of a run, kept flat.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct TrackingRows {
    joints: usize,
    width: usize,
    data: Vec<f64>,
}

/// The signals of every joint that are kept in every tick.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Signal {
    /// Position asked for (rad or m).
    QRef,
    /// Velocity asked for (rad/s or m/s).
    QdRef,
    /// Acceleration asked for (rad/s² or m/s²).
    QddRef,
    /// Position that the machine reported (rad or m).
    Q,
    /// Velocity that the machine reported (rad/s or m/s).
    Qd,
    /// Torque that the machine reported (N m or N).
    Effort,
    /// By how much the motor is to lead the reference of its link (rad or m).
    QLead,
    /// Torque of the feedforward (N m or N).
    Feedforward,
    /// Torque of the feedback (N m or N).
    Feedback,
    /// Torque that the machine was commanded (N m or N).
    Command,
    /// 1 where the command was brought within the limits, 0 elsewhere.
    Limited,
    /// Position of the link (rad or m); NaN where the machine does not know.
    Link,
}

/// Time, time of the reading and age of the prediction.
const HEAD: usize = 3;
const SIGNALS: usize = Signal::Link as usize + 1;
/// Rows that are allocated before a run: ten minutes at 500 Hz.
const ROOM: usize = 300_000;

impl TrackingRows {
    /// No rows yet of `joints` joints, and room for `ticks`.
    pub(crate) fn new(joints: usize, ticks: usize) -> Self {
        let width = HEAD + SIGNALS * joints;
        Self { joints, width, data: Vec::with_capacity(width * ticks.min(ROOM)) }
    }

    pub(crate) fn push(&mut self, tick: &ControlTick) {
        let ControlTick { reference, reading, feedforward, .. } = tick;
        let age_s = tick.age_s.unwrap_or(f64::NAN);
        self.data.extend([tick.time_s, reading.time_s, age_s]);
        let signals = [&reference.q, &reference.qd, &reference.qdd];
        let signals = signals.into_iter().chain([&reading.q, &reading.qd, &reading.effort]);
        for signal in signals.chain([&feedforward.q_lead, &feedforward.tau]) {
            self.data.extend(signal);
        }
        self.data.extend(tick.feedback);
        self.data.extend(tick.command);
        self.data.extend(tick.limited.iter().map(|limited| f64::from(u8::from(*limited))));
        match tick.link_positions {
            Some(positions) => self.data.extend(positions),
            None => self.data.extend(std::iter::repeat_n(f64::NAN, self.joints)),
        }
    }

    /// Number of ticks.
    pub fn len(&self) -> usize {
        self.data.len().checked_div(self.width).unwrap_or(0)
    }

    /// Whether there is no tick.
    pub fn is_empty(&self) -> bool {
        self.data.is_empty()
    }

    /// Number of joints.
    pub fn joints(&self) -> usize {
        self.joints
    }

    /// Whether the machine knew the positions of its links in every tick.
    pub fn knows_links(&self) -> bool {
        let known = |tick| self.row(tick, Signal::Link).iter().all(|q| q.is_finite());
        !self.is_empty() && (0..self.len()).all(known)
    }

    /// Time of every tick since the motion began (s).
    pub fn time_s(&self) -> impl ExactSizeIterator<Item = f64> + Clone {
        self.data.chunks_exact(self.width.max(1)).map(|row| row[0])
    }

    /// The machine's time of every reading (s).
    pub fn reading_time_s(&self) -> impl ExactSizeIterator<Item = f64> + Clone {
        self.data.chunks_exact(self.width.max(1)).map(|row| row[1])
    }

    /// Age of the prediction in every tick (s), NaN without one.
    pub fn age_s(&self) -> impl ExactSizeIterator<Item = f64> + Clone {
        self.data.chunks_exact(self.width.max(1)).map(|row| row[2])
    }

    /// A signal of every joint in a tick.
    ///
    /// # Panics
    ///
    /// When there is no such tick.
    pub fn row(&self, tick: usize, signal: Signal) -> &[f64] {
        let at = tick * self.width + HEAD + signal as usize * self.joints;
        &self.data[at..at + self.joints]
    }

    /// A signal of one joint in every tick.
    ///
    /// # Panics
    ///
    /// When there is no such joint.
    pub fn column(
        &self,
        signal: Signal,
        joint: usize,
    ) -> impl ExactSizeIterator<Item = f64> + Clone {
        assert!(joint < self.joints, "joint {joint} of {}", self.joints);
        let at = HEAD + signal as usize * self.joints + joint;
        self.data.chunks_exact(self.width.max(1)).map(move |row| row[at])
    }
}

#[cfg(test)]
pub(crate) mod tests {
    use motion::State;
    use robot::Reading;

    use super::*;
    use crate::feedforward::TorquePrediction;

    /// Rows of one joint at 1 Hz, from `[q_ref, q, feedforward, feedback]` and the link.
    pub fn rows_of(ticks: &[[f64; 4]], link: Option<f64>) -> TrackingRows {
        let mut rows = TrackingRows::new(1, ticks.len());
        for (k, &[q_ref, q, feedforward, feedback]) in ticks.iter().enumerate() {
            let reference = State { q: vec![q_ref], qd: vec![2.0], qdd: vec![3.0] };
            let time_s = k as f64 + 0.5;
            let reading = Reading { time_s, q: vec![q], qd: vec![5.0], effort: vec![6.0] };
            let prediction =
                TorquePrediction { tau: vec![feedforward], ..TorquePrediction::zero(1) };
            rows.push(&ControlTick {
                time_s: k as f64,
                reference: &reference,
                reading: &reading,
                link_positions: link.as_ref().map(std::slice::from_ref),
                feedforward: &prediction,
                feedback: &[feedback],
                command: &[feedforward + feedback],
                limited: &[k == 1],
                age_s: (k > 0).then_some(0.25),
            });
        }
        rows
    }

    #[test]
    fn a_signal_is_found_by_tick_and_by_joint() {
        let rows = rows_of(&[[1.0, 4.0, 8.0, 9.0], [1.5, 4.5, 8.5, 9.5]], Some(7.0));
        let signals = [
            Signal::QRef,
            Signal::QdRef,
            Signal::QddRef,
            Signal::Q,
            Signal::Qd,
            Signal::Effort,
            Signal::QLead,
            Signal::Feedforward,
            Signal::Feedback,
            Signal::Command,
            Signal::Limited,
            Signal::Link,
        ];
        let second = [1.5, 2.0, 3.0, 4.5, 5.0, 6.0, 0.0, 8.5, 9.5, 18.0, 1.0, 7.0];
        for (signal, expected) in signals.into_iter().zip(second) {
            assert_eq!(rows.row(1, signal), [expected], "{signal:?}");
            assert_eq!(rows.column(signal, 0).nth(1), Some(expected), "{signal:?}");
        }
        assert_eq!((rows.len(), rows.joints(), rows.knows_links()), (2, 1, true));
        assert_eq!(rows.time_s().collect::<Vec<_>>(), [0.0, 1.0]);
        assert_eq!(rows.reading_time_s().collect::<Vec<_>>(), [0.5, 1.5]);
        assert!(rows.age_s().next().unwrap().is_nan() && rows.age_s().nth(1) == Some(0.25));
        assert!(!rows_of(&[[0.0; 4]], None).knows_links());
    }
}
