//! What is named together with a finding because the log cannot tell the two apart.

use diagnosis::Diagnosis;

use checks::synthetic::Noise;

use crate::world::{World, against_nominal, finding, named, sign};

/// Rivals of the finding `words`, in words.
fn rivals(diagnosis: &Diagnosis, words: &str) -> Vec<String> {
    let found = finding(diagnosis, words).unwrap_or_else(|| panic!("no {words}"));
    found.not_separable_from.iter().map(|r| r.words()).collect()
}

/// Asymmetric friction can always do what Coulomb friction does: that makes it no rival.
#[test]
fn the_general_case_is_no_rival_of_its_special_case() {
    for seed in 2100..2103 {
        let world = World::nominal().torque(3, |[_, qd, _]| 0.5 * sign(qd));
        let answer = against_nominal(&world.log(seed)).diagnosis;
        let rivals = rivals(&answer, "FR02 Coulomb friction at j4_elbow_pitch");
        assert!(!rivals.iter().any(|r| r.starts_with("FR03")), "{rivals:?}");
    }
}

/// Friction with a level for each direction is Coulomb friction with an offset of half the difference of the levels: also
/// while the joint turns, where in little noise nearly all of what another law makes of them differs.
#[test]
fn asymmetric_friction_and_coulomb_friction_with_an_offset_are_named_together() {
    let at = "at j5_wrist_yaw";
    let one = format!("FR03 asymmetric friction {at}");
    let two = [format!("FR02 Coulomb friction {at}"), format!("DR03 torque offset {at}")];
    let noise =
        Noise { effort: vec![0.03, 0.03, 0.015, 0.012, 0.0015, 0.0012, 7e-4], ..Noise::of_a_wam() };
    let asymmetric =
        World::nominal().torque(4, |[_, qd, _]| if qd > 0.0 { 0.686 } else { 0.376 * sign(qd) });
    let with_offset = World::nominal().torque(4, |[_, qd, _]| 0.531 * sign(qd) + 0.155);
    for (world, seed) in
        [(&asymmetric, 2140), (&asymmetric, 2141), (&with_offset, 2142), (&with_offset, 2143)]
    {
        let answer = against_nominal(&world.runs(3, 12.0, &noise, seed)).diagnosis;
        let said = named(&answer);
        if said.contains(&one) {
            assert_eq!(said, std::slice::from_ref(&one), "{seed}");
            assert!(
                two.iter().all(|part| rivals(&answer, &one).contains(part)),
                "{seed}: {said:?}"
            );
        } else {
            assert!(
                said.len() == 2 && two.iter().all(|part| said.contains(part)),
                "{seed}: {said:?}"
            );
            assert!(
                rivals(&answer, &two[0]).contains(&one),
                "{seed}: {:?}",
                rivals(&answer, &two[0])
            );
        }
    }
}

/// A payload and the last link's own inertia are the same numbers.
#[test]
fn a_payload_and_the_inertia_of_the_last_link_are_named_together() {
    let world = World::nominal().body(|mut robot| {
        let palm = robot.joint_count() - 1;
        robot.link_mut(palm).unwrap().inertia.mass += 1.0;
        robot
    });
    let answer = against_nominal(&world.log(2110)).diagnosis;
    let pair = ["IN01 payload at palm", "IN02 inertial parameters at palm"];
    let named = pair.iter().find(|words| finding(&answer, words).is_some()).unwrap();
    let other = pair.iter().find(|words| *words != named).unwrap();
    let rivals = rivals(&answer, named);
    assert!(rivals.iter().any(|r| r == other), "{named}: {rivals:?}");
}

/// Of a first link that turns about the vertical one number moves anything, and it is that of a
/// rotor.
#[test]
fn a_rotor_and_the_inertia_of_the_first_link_are_named_together() {
    let world = World::nominal().body(|mut robot| {
        robot.link_mut(0).unwrap().actuator.rotor_inertia += 0.2;
        robot
    });
    let answer = against_nominal(&world.log(2120)).diagnosis;
    let rivals = rivals(&answer, "IN03 rotor inertia at j1_base_yaw");
    assert!(rivals.iter().any(|r| r == "IN02 inertial parameters at shoulder_yaw"), "{rivals:?}");
}

/// The torque of a palm that gravity does not load is that of its inertia: all of it a quarter larger
/// is a rotor a quarter larger. An elbow carries the forearm, which a rotor does not.
#[test]
fn a_torque_constant_and_a_rotor_are_named_together_where_nothing_hangs() {
    let said = |joint: usize, name: &str| {
        let world = World::nominal().reading(joint, |effort| 1.25 * effort);
        let answer = against_nominal(&world.log(2130)).diagnosis;
        let both = ["DR02 torque constant", "IN03 rotor inertia"].map(|e| format!("{e} at {name}"));
        let named = both.iter().find(|words| finding(&answer, words).is_some()).unwrap();
        let rivals = rivals(&answer, named);
        both.clone().map(|words| words == *named || rivals.contains(&words))
    };
    assert_eq!(said(6, "j7_palm_yaw"), [true, true]);
    assert_eq!(said(3, "j4_elbow_pitch"), [true, false]);
}
