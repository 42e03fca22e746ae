//! Named effects hold where nothing was measured.

use crate::bench::{Bench, REAL, errors, motion, print, run};

#[test]
fn named_effects_track_better_than_any_process_at_twice_the_amplitude() {
    let plant = REAL.to_owned() + &run("a", 51, 0.4) + &run("b", 52, 0.4);
    let tracking = format!(
        "feedforward = [\"rbd\", \"gp\", \"gp-rbd\", \"rbd-kernel\", \"named\"]\n\
         control.gains = \"low-quarter\"\nlearn = {{ train = [\"a\", \"b\"], points = 500 }}\n{}\n",
        motion("motion.sinusoids", 53, 0.8, 12.0)
    );
    let bench = Bench::new(&plant, &tracking);
    let runs = bench.track(&bench.learn());
    print(&runs);
    let named = errors(&runs, "named");
    for process in ["gp", "gp-rbd", "rbd-kernel"] {
        let own = errors(&runs, process);
        for j in 0..named.len() {
            assert!(named[j] < own[j], "{process}, joint {j}: {} and named {}", own[j], named[j]);
        }
    }
}
