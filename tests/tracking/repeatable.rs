//! A run on the virtual clock is the same to the last bit, on any number of threads.

use crate::bench::{Bench, PERFECT, REAL, motion, run};

fn tracking(time_ms: f64) -> String {
    format!(
        "feedforward = [\"rbd\", \"gp\"]\ncontrol.gains = \"low-quarter\"\n\
         prediction.time_ms = {time_ms:?}\nlearn = {{ train = [\"a\"], points = 60 }}\n{}\n",
        motion("motion.sinusoids", 62, 0.8, 4.0)
    )
}

#[test]
fn a_virtual_run_is_repeated_to_the_last_bit() {
    let plant = REAL.to_owned() + &run("a", 61, 0.8);
    let bench = Bench::new(&plant, &tracking(7.0));
    let learned = bench.learn();
    let once = bench.track(&learned);
    let pool = rayon::ThreadPoolBuilder::new().num_threads(1).build().unwrap();
    let again = pool.install(|| bench.track(&learned));
    for (once, again) in once.iter().zip(&again) {
        assert!(once.tracking.rows == again.tracking.rows, "{} differs", once.kind);
        assert_eq!(once.metrics, again.metrics);
    }
}

#[test]
fn a_slower_predictor_tracks_worse() {
    let plant = PERFECT.to_owned() + &run("a", 61, 0.8);
    let of = |time_ms: f64| {
        let tracking = tracking(time_ms).replace("[\"rbd\", \"gp\"]", "[\"cad\"]");
        let bench = Bench::new(&plant, &tracking);
        let run = bench.track(&bench.learn()).remove(0);
        (run.tracking.timing.updates_missed, run.metrics)
    };
    let ((fresh, quick), (stale, slow)) = (of(0.0), of(60.0));
    assert_eq!(fresh, 0);
    // Of 30 ticks one finds a newer prediction.
    assert!(stale > 28 * 2000 / 30, "{stale} of 2000");
    for (slow, quick) in slow.joints.iter().zip(&quick.joints) {
        assert!(slow.rmse > 10.0 * quick.rmse, "{} at 60 ms, {} at once", slow.rmse, quick.rmse);
    }
}
