//! What a description says of a drive, where less is found.

use checks::arms::workspace_root;
use effects::without_unused_shapes;
use robot::{Robot, Warming};

/// A drive is described to lose by warming up what it is found not to have: the robot that is written can be read.
#[test]
fn a_drive_that_has_less_friction_than_it_was_described_to_lose_loses_what_it_has() {
    let loaded = Robot::load(&workspace_root().join("robots/wam7/robot.toml")).unwrap();
    let mut described = loaded.robot.clone();
    let drive = &mut described.link_mut(2).unwrap().actuator;
    (drive.viscous, drive.coulomb_forward, drive.coulomb_backward) = (1.0, 2.0, 2.5);
    let warming = Warming { viscous_lost: 0.8, coulomb_lost: 1.5, time_constant_s: 600.0 };
    drive.warming = Some(warming);
    let mut found = described.clone();
    let drive = &mut found.link_mut(2).unwrap().actuator;
    (drive.viscous, drive.coulomb_forward) = (0.3, 0.5);
    let written = without_unused_shapes(found, &described);
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("robot.toml");
    let text = loaded.to_toml(&written, &loaded.urdf_path.display().to_string()).unwrap();
    std::fs::write(&path, text).unwrap();
    let read = Robot::load(&path).unwrap().robot;
    let lost = Warming { viscous_lost: 0.3, coulomb_lost: 0.5, ..warming };
    assert_eq!(read.links()[2].actuator.warming, Some(lost));
}
