//! What stands in for a cause that has no name here: its size is no constant.

use diagnosis::{Diagnosis, RuledOut, Verdict};

use crate::world::{World, against_nominal, finding, named};

/// Why the effect `words` was ruled out.
fn reason<'a>(diagnosis: &'a Diagnosis, words: &str) -> &'a RuledOut {
    let found = diagnosis.ruled_out.iter().find(|r| r.at.words() == words);
    found.unwrap_or_else(|| panic!("{words} is named: {:?}", named(diagnosis)))
}

/// Verdict on the elbow.
fn elbow(diagnosis: &Diagnosis) -> Verdict {
    diagnosis.joints[3].verdict
}

const VISCOUS: &str = "FR01 viscous friction at j4_elbow_pitch";

/// A viscous friction of 0.6 N m s/rad, with half as much again more or less as the elbow turns: such a law
/// is in no catalogue.
#[test]
fn friction_that_varies_as_its_law_does_not_has_no_name() {
    for seed in 2200..2203 {
        let world = World::nominal()
            .torque(3, |[q, qd, _]| 0.6 * (1.0 + 1.5 * (2.0 * (q - 1.1)).sin()) * qd);
        let answer = against_nominal(&world.log(seed)).diagnosis;
        println!("{:?} {}", named(&answer), reason(&answer, VISCOUS).because);
        assert!(matches!(elbow(&answer), Verdict::Unexplained | Verdict::PartlyExplained));
        let because = &reason(&answer, VISCOUS).because;
        assert!(because.contains("would have to vary"), "{because}");
    }
}

/// With a fifth of itself more or less it is viscous friction, of which every law is a rough one.
#[test]
fn friction_that_varies_a_little_keeps_its_name() {
    for seed in 2210..2213 {
        let world = World::nominal()
            .torque(3, |[q, qd, _]| 0.6 * (1.0 + 0.2 * (2.0 * (q - 1.1)).sin()) * qd);
        let answer = against_nominal(&world.log(seed)).diagnosis;
        assert!(finding(&answer, VISCOUS).is_some(), "{:?}", named(&answer));
    }
}
