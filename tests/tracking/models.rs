//! The order of the models in figure 3 of Nguyen-Tuong & Peters 2010, and what naming the
//! effects is worth beside them.

use crate::bench::{Bench, REAL, errors, motion, print, run};

const SEMIPARAMETRIC: [&str; 4] = ["gp-rbd", "gp-rbd-prior", "gp-rbd-shared", "rbd-kernel"];

/// Elbow and wrist, counted from 0: most of what their drives need is friction.
const ELBOW_AND_WRIST: [usize; 3] = [3, 4, 5];

/// The palm's torque is friction of its own velocity, which rigid bodies add nothing to.
const PALM: usize = 6;

fn tracking() -> String {
    format!(
        "feedforward = [\"rbd\", \"gp\", \"gp-rbd\", \"gp-rbd-prior\", \"gp-rbd-shared\", \
         \"rbd-kernel\", \"named\"]\n\
         control.gains = \"low-quarter\"\nlearn = {{ train = [\"a\", \"b\"], regression = [\"a\", \"b\", \"c\", \"d\", \"e\", \"f\", \"g\", \"h\"], points = 500 }}\n{}\n",
        motion("motion.sinusoids", 43, 0.8, 12.0)
    )
}

#[test]
fn models_with_rigid_bodies_and_data_track_best_and_named_effects_better_still() {
    let runs = ["a", "b", "c", "d", "e", "f", "g", "h"];
    let runs = runs.iter().zip(410..).map(|(name, seed)| run(name, seed, 0.8));
    let plant = REAL.to_owned() + &runs.collect::<String>();
    let bench = Bench::new(&plant, &tracking());
    let runs = bench.track(&bench.learn());
    print(&runs);
    let (rbd, gp) = (errors(&runs, "rbd"), errors(&runs, "gp"));
    for name in SEMIPARAMETRIC {
        let own = errors(&runs, name);
        for j in 0..own.len() {
            assert!(own[j] < rbd[j], "{name}, joint {j}: {} and RBD {}", own[j], rbd[j]);
        }
        for j in ELBOW_AND_WRIST {
            assert!(2.0 * own[j] < rbd[j], "{name}, joint {j}: {} and RBD {}", own[j], rbd[j]);
        }
        for j in 0..PALM {
            assert!(own[j] < gp[j], "{name}, joint {j}: {} and GP {}", own[j], gp[j]);
        }
    }
    let named = errors(&runs, "named");
    for j in ELBOW_AND_WRIST {
        let best = SEMIPARAMETRIC.iter().map(|name| errors(&runs, name)[j]).fold(gp[j], f64::min);
        assert!(named[j] <= best, "joint {j}: {} and the best process {best}", named[j]);
    }
}
