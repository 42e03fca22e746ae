//! The same input gives the same answer, to the last bit.

use crate::world::{World, against_nominal, sign};

fn world() -> World {
    World::nominal()
        .torque(3, |[_, qd, _]| 0.5 * sign(qd) + 0.6 * qd)
        .reading(2, |effort| effort + 0.3)
}

#[test]
fn the_answer_does_not_depend_on_the_number_of_threads() {
    let runs = world().log(5000);
    let with = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| against_nominal(&runs))
    };
    let one = with(1);
    assert!(!one.diagnosis.findings.is_empty());
    assert_eq!(one, with(2));
    assert_eq!(one, with(5));
}

#[test]
fn the_same_seed_gives_the_same_log_and_the_same_answer() {
    let (first, second) = (world().log(5001), world().log(5001));
    assert_eq!(first, second);
    assert_ne!(first, world().log(5002));
    assert_eq!(against_nominal(&first), against_nominal(&second));
}
