use robot::{Robot, TorqueSource};

/// Warns when the time skew found equals the effect of a zero-order hold that is not described.
///
/// A command that is held for `T` from its sample on acts `T / 2` later on average. The log is then early: a skew of
/// `-T / 2`. A described command without a rate counts as held for one row `I` ([`logs::centre_commands`]), which
/// leaves a skew of `(I - T) / 2`.
pub(crate) fn words_for_hold(robot: &Robot, extended: &Robot, row_s: f64) -> Option<String> {
    let (first, found) = robot.links().first().zip(extended.links().first())?;
    let skew_s = found.actuator.effort_skew_s - first.actuator.effort_skew_s;
    let source = first.actuator.torque_source;
    let (held_s, missing) = match source {
        TorqueSource::Commanded => (row_s - 2.0 * skew_s, "control_rate_hz"),
        TorqueSource::Unknown => {
            (-2.0 * skew_s, "torque_source = \"commanded\" and control_rate_hz")
        }
        TorqueSource::Measured | TorqueSource::Current => return None,
    };
    let is_one = robot.links().iter().all(|link| link.actuator.torque_source == source);
    (is_one && skew_s != 0.0 && held_s > 0.0 && held_s <= row_s).then(|| {
        format!(
            "the skew of {:.2} ms is what commands make that are renewed every {:.2} ms and held: if these efforts are \
            commands, state {missing} in robot.toml",
            1e3 * skew_s,
            1e3 * held_s
        )
    })
}

/// How much of the lateness of goals may be the time for which they are held, where a delay was found and the description does
/// not say how long that is.
pub(crate) fn words_for_goals(robot: &Robot, extended: &Robot, row_s: f64) -> Option<String> {
    let (first, found) = robot.links().first().zip(extended.links().first())?;
    let (delay_s, hold_s) = (found.actuator.goal_delay_s, 0.5 * row_s);
    let is_new = (delay_s - first.actuator.goal_delay_s).abs() > 0.0;
    (is_new && delay_s >= hold_s && first.actuator.goal_hold_s.is_none()).then(|| {
        format!(
            "of the goal delay of {:.2} ms, {:.2} ms are the hold where each goal is kept until the next row, and {:.2} ms \
             the delay itself: state goal_hold_hz in effort_source of robot.toml",
            1e3 * delay_s,
            1e3 * hold_s,
            1e3 * (delay_s - hold_s)
        )
    })
}
