use population::ServoShareSpec;
use population::{ArmClass, LogKind, LogKindSpec, MotionClass, PopulationSpec, RobotShares};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::trials::hash::seed_of;

/// Seed of the public sets.
const PUBLIC_SEED: u64 = 56;

/// A set of trials of CauseBench.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum BenchSet {
    /// Twelve trials of short logs.
    Smoke,
    /// 120 trials.
    Core,
    /// Sixty trials with wrong descriptions, servos and spoilt logs.
    Hard,
    /// Logs of real arms, whose causes nobody knows: predictions and drifts alone.
    Recorded,
}

impl BenchSet {
    /// All of them.
    pub const ALL: [Self; 4] = [Self::Smoke, Self::Core, Self::Hard, Self::Recorded];

    /// Its name in files and on the command line.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Smoke => "smoke",
            Self::Core => "core",
            Self::Hard => "hard",
            Self::Recorded => "recorded",
        }
    }

    /// The population that its trials are of; none for recorded ones.
    pub(crate) fn population(self) -> Option<PopulationSpec> {
        let (trials, logs, log_s, longest_s) = match self {
            Self::Recorded => return None,
            Self::Smoke => (12, [1, 3], [5.0, 10.0], 20.0),
            Self::Core => (120, [1, 4], [5.0, 20.0], 40.0),
            Self::Hard => (60, [1, 4], [5.0, 20.0], 40.0),
        };
        let usual = PopulationSpec {
            trials,
            seed: PUBLIC_SEED,
            arms: ArmClass::ALL.to_vec(),
            motions: MotionClass::ALL.to_vec(),
            logs,
            log_s,
            longest_s,
            causes: [0, 4],
            strangers: 0.2,
            clean: 0.15,
            spoilt: 0.0,
            robots: RobotShares::default(),
            instruments: None,
            log_kinds: [].into(),
            servos: None,
            recorded: None,
        };
        Some(match self {
            Self::Smoke | Self::Core | Self::Recorded => usual,
            Self::Hard => PopulationSpec {
                spoilt: 0.2,
                robots: RobotShares {
                    wrong_urdfs: 0.4,
                    strong_friction: 0.5,
                    delayed_drives: 0.15,
                    exchanged_joints: 0.05,
                    turned_axes: 0.05,
                    unknown_mounts: 0.5,
                    tools_taken_off: 0.05,
                    changed_payloads: 0.1,
                },
                log_kinds: [LogKind::LowRate, LogKind::HeldValues]
                    .map(|kind| (kind, LogKindSpec { share: 0.05, size: None }))
                    .into(),
                servos: Some(ServoShareSpec { share: 0.15, delay_ms: [0.0, 60.0] }),
                ..usual
            },
        })
    }

    /// Seed of trial `number`, from that of the set; `seed` of a set that nobody else can make.
    pub(crate) fn trial_seed(self, seed: Option<u64>, number: usize) -> u64 {
        let kind = format!("cause_bench/{}", self.name());
        seed_of(seed.unwrap_or(PUBLIC_SEED), &kind, number)
    }
}
