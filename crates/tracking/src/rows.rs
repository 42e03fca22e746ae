use crate::Tick;

/// Every tick of a run, kept flat.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Rows {
    joints: usize,
    width: usize,
    data: Vec<f64>,
}

/// What is kept of every joint in every tick.
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
    /// By how much the motor was to be before the reference of its link (rad or m).
    QLead,
    /// Torque of the feedforward (N m or N).
    Feedforward,
    /// Torque of the feedback (N m or N).
    Feedback,
    /// Torque that the machine was told (N m or N).
    Command,
    /// 1 where the command was brought within the limits, 0 elsewhere.
    Limited,
    /// Position of the link (rad or m); NaN where the machine does not know.
    Link,
}

/// Time, time of the reading and age of the prediction.
const HEAD: usize = 3;
const SIGNALS: usize = Signal::Link as usize + 1;
/// Rows that room is made for before a run: ten minutes at 500 Hz.
const ROOM: usize = 300_000;

impl Rows {
    /// No rows yet of `joints` joints, and room for `ticks`.
    pub(crate) fn new(joints: usize, ticks: usize) -> Self {
        let width = HEAD + SIGNALS * joints;
        Self { joints, width, data: Vec::with_capacity(width * ticks.min(ROOM)) }
    }

    pub(crate) fn push(&mut self, tick: &Tick) {
        let Tick { reference, reading, feedforward, .. } = tick;
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
