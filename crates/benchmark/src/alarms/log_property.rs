use population::{ArmClass, Corner, EffortClass, MotionClass, Origin};

/// A property of the logs of a trial, by which false alarms are counted.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord)]
pub(super) struct LogProperty {
    /// Place of the property and of its value in tables.
    order: [u64; 2],
    /// The property and its value, such as `rate 250 Hz`.
    words: String,
}

/// The properties in the order of the tables.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum LogProperties {
    /// What made them, and all that follows.
    All,
    /// Arm, rate, encoder and effort: what a ledger crosses.
    Crossed,
}

impl LogProperty {
    /// The properties of the logs of a corner.
    pub fn of(corner: &Corner, wanted: LogProperties) -> Vec<Self> {
        let bits = encoder_bits(corner);
        let engine = match corner.origin {
            Origin::AnotherEngine => "another engine",
            Origin::Simulated => "the simulator",
            Origin::Transplant | Origin::Recorded => "an arm",
        };
        let all = [
            ("made by", corner.origin as u64, engine.to_owned()),
            ("motion", rank(corner.motion, MotionClass::ALL), corner.motion.to_string()),
            ("arm", arm_rank(&corner.arm), corner.arm.clone()),
            ("rate", (1e3 * corner.rate_hz).round() as u64, format!("{} Hz", corner.rate_hz)),
            ("encoder", bits, format!("{bits} bits")),
            ("effort", rank(corner.effort, EffortClass::ALL), corner.effort.to_string()),
        ];
        let first = if wanted == LogProperties::All { 0 } else { 2 };
        let numbered = all.into_iter().zip(0..).skip(first);
        let property = |((name, rank, value), place): ((&str, u64, String), u64)| Self {
            order: [place, rank],
            words: format!("{name} {}", value.replace('_', " ")),
        };
        numbered.map(property).collect()
    }

    /// The property and its value.
    pub fn words(&self) -> &str {
        &self.words
    }
}

/// Resolution of the coarsest encoder as bits of a turn: `log2(2 pi / step)`, rounded; 0 without steps. A sliding
/// joint has steps of a spindle, so that an arm that only slides counts as finer than its encoders are.
pub(super) fn encoder_bits(corner: &Corner) -> u64 {
    let bits = (std::f64::consts::TAU / corner.encoder_step).log2().round();
    if bits.is_finite() { bits.max(0.0) as u64 } else { 0 }
}

fn rank<T: PartialEq>(one: T, all: &[T]) -> u64 {
    all.iter().zip(0..).find(|(other, _)| **other == one).map_or(u64::MAX, |(_, place)| place)
}

/// Recorded arms follow the classes.
fn arm_rank(name: &str) -> u64 {
    let arms = ArmClass::ALL.iter().zip(0..);
    arms.filter(|(arm, _)| arm.name() == name).map(|(_, place)| place).next().unwrap_or(u64::MAX)
}
