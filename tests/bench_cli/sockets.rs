//! No command opens a socket.

use crate::alarm::{ASKED, alarm, alarmed};
use crate::faults::{Place, words};
use crate::writers::COMMANDS;

#[test]
fn no_command_opens_a_socket() {
    let place = Place::of_files(1);
    let Some(alarm) = alarm(place.path()) else {
        println!("skipped: there is no compiler cc");
        return;
    };
    for (index, (command, _)) in COMMANDS.iter().enumerate() {
        place.prepare(index);
        let answer = alarmed(&alarm, place.path(), &words(index));
        assert!(answer.code <= 1 && answer.code != ASKED, "{command}: {}", answer.err);
    }
}
