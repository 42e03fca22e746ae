use inspection::CorrectedLogs;
use logs::Run;
use robot::{Loaded, LockedJoint, RobotWarning};

use crate::messages::warn;

/// Distance from the position of a locked joint within which a log confirms it (rad or m).
const NEAR: f64 = 0.01;

/// Memory that a diagnosis takes for one sample of one joint (bytes), as measured on logs of 7 joints with two threads.
const BYTES_PER_SAMPLE: f64 = 430.0;

const GIGA: f64 = 1e9;

/// Warnings about the input of a diagnosis: what the robot's description leaves out of its motion,
/// locked joints that a log has at another position, and logs that need more memory than is free.
pub fn input_warnings<'a>(loaded: &Loaded, runs: impl IntoIterator<Item = &'a Run>) -> Vec<String> {
    let of_motion = loaded.warnings.iter().filter(|warning| warning.is_about_motion());
    let mut warnings: Vec<String> = of_motion.map(RobotWarning::to_string).collect();
    let mut all = 0;
    for run in runs {
        warnings.extend(loaded.locked.iter().filter_map(|lock| locked_joint_warning(lock, run)));
        all += joint_samples(run);
    }
    warnings.extend(learner::available_bytes().and_then(|free| memory_warning(all, free)));
    warnings
}

/// The runs as [`corrected_runs`] has them, whose warnings are printed.
pub fn correct_runs(loaded: &Loaded, runs: &[Run]) -> Option<Vec<Run>> {
    let (read, warnings) = corrected_runs(loaded, runs);
    warnings.iter().for_each(|warning| warn(warning));
    read
}

/// The runs with those errors corrected that the inspection can correct, none without errors; and the warnings about the
/// input, with each correction.
pub fn corrected_runs(loaded: &Loaded, runs: &[Run]) -> (Option<Vec<Run>>, Vec<String>) {
    let mut warnings = input_warnings(loaded, runs);
    let CorrectedLogs { runs: read, mended, .. } = inspection::correct(&loaded.robot, runs);
    warnings.extend(mended.iter().map(|seen| {
        format!("{} Until then the logs are read so.", seen.sentence(&loaded.robot, runs))
    }));
    (read, warnings)
}

/// Memory that a diagnosis of the runs takes (GB), in digits.
pub fn memory_need_gb(runs: &[Run]) -> String {
    short(memory_need_bytes(runs.iter().map(joint_samples).sum()) / GIGA)
}

/// Samples of a run, counted for each joint.
fn joint_samples(run: &Run) -> usize {
    run.time.len() * run.joints.len()
}

/// Memory that a diagnosis of so many samples of single joints takes (bytes).
fn memory_need_bytes(joint_samples: usize) -> f64 {
    BYTES_PER_SAMPLE * joint_samples as f64
}

/// Warns of samples that need more memory than is free (bytes).
fn memory_warning(joint_samples: usize, free: f64) -> Option<String> {
    let memory_need_bytes = memory_need_bytes(joint_samples);
    let [memory_need_gb, free_gb] = [memory_need_bytes, free].map(|bytes| short(bytes / GIGA));
    (memory_need_bytes > free).then(|| {
        format!(
            "the logs need about {memory_need_gb} GB of memory and {free_gb} GB are free: \
             read less of them with --from-s and --to-s, or give fewer logs, or logs of a lower rate"
        )
    })
}

/// Warns of a log that has a locked joint at another position.
fn locked_joint_warning(lock: &LockedJoint, run: &Run) -> Option<String> {
    let LockedJoint { joint, position, .. } = lock;
    let logged = run.extra.get(&format!("{joint}.position"))?;
    let known = || logged.iter().copied().filter(|q| q.is_finite());
    let (low, high) = (known().reduce(f64::min)?, known().reduce(f64::max)?);
    if low > position - NEAR && high < position + NEAR {
        return None;
    }
    let [at, low_words, high_words] = [*position, low, high].map(short);
    let advice = if high - low < 2.0 * NEAR {
        let middle = short(0.5 * (low + high));
        format!("locked = {{ {joint} = {middle} }} in a robot.toml locks it there")
    } else {
        "what its motion does to the torque of the others is left out".to_owned()
    };
    Some(format!(
        "{}: joint {joint} is locked at {at}, the log has it from {low_words} to {high_words}: {advice}",
        run.name
    ))
}

fn short(value: f64) -> String {
    report::significant(value, 3)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn logs_that_need_more_than_is_free_are_told() {
        assert_eq!(memory_warning(2_000_000, 1e9), None);
        let told = memory_warning(10_000_000, 1e9).unwrap();
        assert!(
            told.contains(
                "need about 4.30 GB of memory and 1.00 GB are free: read less of them with --from-s"
            ),
            "{told}"
        );
    }

    fn warning_of(logged: &[f64]) -> Option<String> {
        let lock = LockedJoint { joint: "grip".to_owned(), position: 0.2, mimics: None };
        let run = Run {
            name: "run_1".to_owned(),
            source: "run_1.csv".into(),
            sha256: String::new(),
            is_torn: false,
            mended: Vec::new(),
            time: vec![0.0; logged.len()],
            joints: vec![],
            extra: [("grip.position".to_owned(), logged.to_vec())].into(),
        };
        locked_joint_warning(&lock, &run)
    }

    #[test]
    fn a_log_that_has_a_locked_joint_elsewhere_or_moving_is_told() {
        assert_eq!(warning_of(&[]), None);
        assert_eq!(warning_of(&[f64::NAN, 0.2001, 0.1999]), None);
        assert_eq!(
            warning_of(&[0.3, 0.302]).unwrap(),
            "run_1: joint grip is locked at 0.200, the log has it from 0.300 to 0.302: \
             locked = { grip = 0.301 } in a robot.toml locks it there"
        );
        assert_eq!(
            warning_of(&[0.2, 0.5]).unwrap(),
            "run_1: joint grip is locked at 0.200, the log has it from 0.200 to 0.500: \
             what its motion does to the torque of the others is left out"
        );
    }
}
