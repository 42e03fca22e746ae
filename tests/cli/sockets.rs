//! No command opens a socket but `track --live`.

use crate::alarm::{ASKED, alarm, alarmed};
use crate::faults::{Place, words};
use crate::writers::COMMANDS;

#[test]
fn no_command_opens_a_socket_but_track_live() {
    let place = Place::of_files(1);
    let Some(alarm) = alarm(place.path()) else {
        println!("skipped: there is no compiler cc");
        return;
    };
    for (index, (command, _)) in COMMANDS.iter().enumerate() {
        place.prepare(index);
        let answer = alarmed(&alarm, place.path(), &words(index));
        assert!(answer.code <= 1, "{command}: {}", answer.err);
    }
    let others: [&[&str]; 5] = [
        &["robot", "check", "arm.urdf"],
        &["log", "info", "--robot", "arm.urdf", "run_0.csv"],
        &["export", "arm.urdf", "--to", "mjcf", "--out", "exported"],
        &["effects"],
        &["explain", "FR02"],
    ];
    for arguments in others {
        let answer = alarmed(&alarm, place.path(), arguments);
        assert!(answer.code <= 1, "{arguments:?}: {}", answer.err);
    }
    // A viewer may be there or not: it is asked for.
    let live = ["track", "tracking.toml", "--live", "--out", "live"];
    let answer = alarmed(&alarm, place.path(), &live);
    assert_eq!(answer.code, ASKED, "{}", answer.err);
}
