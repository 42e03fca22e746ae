use std::path::Path;

use document::Document;
use robot::Robot;
use simulator::effects::EffectSpec;
use simulator::scenario::Scenario;
use simulator::strangers::StrangerKind;

use crate::corner::FieldFeature;
use crate::error::PopulationError;
use crate::hidden::HiddenThings;
use crate::oracle::motion::SeenRun;
use crate::sheet::TruthSheet;
use crate::trial::background::Friction;
use crate::trial::field::mount;
use crate::trial::seen::{Seen, Truths};

/// Works out the sheet of a simulated trial anew from its `truth`, and leaves its logs as they are. How the logs were
/// spoilt is what the old sheet says.
///
/// # Errors
///
/// [`PopulationError`] when the files of the trial cannot be read, or its arm cannot be simulated.
pub fn sheet_again(folder: &Path) -> Result<TruthSheet, PopulationError> {
    let old = TruthSheet::open(folder)?;
    let scenario = folder.join("truth").join("scenario.toml");
    let scenario = Scenario::from_document(&Document::read(&scenario)?)?;
    let nominal = Robot::load(&folder.join("nominal").join("robot.toml"))?.robot;
    let (friction, causes) = split_friction(scenario.effects(), scenario.robot().joint_count());
    let hidden = HiddenThings { causes, strangers: scenario.strangers().to_vec() };
    if old.corner.field.contains(&FieldFeature::PayloadChanged) {
        let reason = "its payload changes between runs, a trial of one arm was expected".to_owned();
        return Err(PopulationError::Folder { path: folder.to_owned(), reason });
    }
    let beside = |runs: &[SeenRun]| {
        mount::difference(scenario.robot(), &nominal, runs).into_iter().collect::<Vec<_>>()
    };
    let truths = Truths {
        scenario: &scenario,
        nominal: &nominal,
        friction: &friction,
        hidden: &hidden,
        beside: &beside,
    };
    let Seen { scales, causes, mut strangers, .. } = truths.weigh()?;
    let simulated = |name: &str| StrangerKind::ALL.iter().any(|kind| kind.name() == name);
    strangers.extend(old.strangers.iter().filter(|s| !simulated(&s.name)).cloned());
    Ok(TruthSheet { torque_rms: scales, causes, strangers, ..old })
}

/// The everyday friction with which the effects of a trial begin, two a joint, and the effects behind it.
fn split_friction(effects: &[EffectSpec], joints: usize) -> (Vec<Friction>, Vec<EffectSpec>) {
    let mut friction = vec![Friction { coulomb: 0.0, viscous: 0.0 }; joints];
    let count = (2 * joints).min(effects.len());
    for (k, effect) in effects[..count].iter().enumerate() {
        match effect {
            EffectSpec::CoulombFriction(dry) => friction[k / 2].coulomb = dry.level_nm,
            EffectSpec::ViscousFriction(wet) => friction[k / 2].viscous = wet.viscous_nm_s_per_rad,
            _ => {}
        }
    }
    (friction, effects[count..].to_vec())
}
