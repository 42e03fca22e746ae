//! A perfect model of an arm without effects leaves the feedback nothing to do.

use crate::bench::{Bench, PERFECT, errors, motion, print, run};

/// What a perfect model may leave at low gains (rad).
const MOST: f64 = 1e-3;

fn tracking(gains: &str) -> String {
    format!(
        "feedforward = [\"cad\", \"gravity\"]\ncontrol.gains = \"{gains}\"\n\
         prediction.time_ms = 0.0\n{}\n",
        motion("motion.sinusoids", 31, 0.8, 10.0)
    )
}

#[test]
fn a_perfect_model_tracks_with_low_gains_to_a_milliradian() {
    for gains in ["low-quarter", "low-tenth"] {
        let bench = Bench::new(&(PERFECT.to_owned() + &run("idle", 1, 0.5)), &tracking(gains));
        let runs = bench.track(&bench.learn());
        print(&runs);
        let perfect = errors(&runs, "cad");
        assert!(perfect.iter().all(|error| *error < MOST), "{gains}: {perfect:?}");
        // The gains alone do not do it.
        let gravity = errors(&runs, "gravity");
        assert!(gravity.iter().all(|error| *error > 2.0 * MOST), "{gains}: {gravity:?}");
    }
}
