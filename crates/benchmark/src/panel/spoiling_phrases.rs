use population::LogKind;

/// Phrases of which a sentence of the program has one where it says that the logs are so: a column and a row at fault name
/// what is in single rows.
pub(crate) fn spoiling_phrases(kind: LogKind) -> &'static [&'static str] {
    match kind {
        LogKind::EffortSign | LogKind::PositionSign => OTHER_SIGN,
        LogKind::EffortsExchanged => EXCHANGED,
        LogKind::EffortUnit | LogKind::EffortInAmperes => &["in another unit", ".effort, row"],
        LogKind::EffortWithoutGravity => &["torque of gravity", "without gravity"],
        LogKind::TimeUnit | LogKind::TimeStretched | LogKind::OtherClock => {
            &["what a second is", "unit of time", "another clock"]
        }
        LogKind::StuckEncoder => &["stands still"],
        LogKind::HeldByLogger => &["signals stand still"],
        LogKind::Spikes => &["single samples", ".position, row"],
        LogKind::TurnJump => &["full turns"],
        LogKind::EffortZeros => &["zero", ".effort, row"],
        LogKind::EffortSpikes => &["single samples", "spike", ".effort, row"],
        LogKind::EffortWithoutSign => &["without a sign", "no sign", "never negative"],
        LogKind::BeyondStatedLimit => &["beyond the limit", "beyond its limit", "limit is wrong"],
        LogKind::NormalisedUnits => &["normalised"],
        LogKind::HeldValues => &["repeat", "held"],
        LogKind::LowRate => &["rate"],
        LogKind::NoNoise => &["noise"],
    }
}

/// Phrases for a signal or an axis that is turned.
pub(crate) const OTHER_SIGN: &[&str] = &["other sign"];

/// Phrases for joints or columns that are taken for each other.
pub(crate) const EXCHANGED: &[&str] = &["exchanged"];
