use catalogue::EffectKind;
use document::DocumentError;
use logs::{LogError, of_run};
use robot::MachineFault;

use crate::strangers::kind::StrangerKind;

/// Why an arm cannot be simulated.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum SimulatorError {
    /// The engine cannot build the tree of bodies.
    #[error("robot {robot}: its links cannot be put together as a tree of bodies")]
    NoTree {
        /// Name of the robot.
        robot: String,
    },
    /// A motor behind backlash or elasticity has no rotor inertia.
    #[error(
        "joint {joint}: its rotor inertia is {inertia} kg m^2, a motor with backlash or elasticity needs a positive one: give rotor_inertia_kg_m2 in robot.toml"
    )]
    NoRotorInertia {
        /// The joint.
        joint: String,
        /// Its rotor inertia (kg m² or kg).
        inertia: f64,
    },
    /// A joint moves neither a body nor a rotor with inertia.
    #[error(
        "joint {joint}: neither its links nor its rotor have an inertia about its axis, a positive one was expected"
    )]
    NoInertia {
        /// The joint.
        joint: String,
    },
    /// A spring is too stiff for the engine's step.
    #[error(
        "joint {joint}: a stiffness of {stiffness:.4} N m/rad rings at {frequency_hz:.0} Hz, too fast for steps of {step_ms} ms: soften it or set engine.step_ms to at most {longest_step_ms:.4}"
    )]
    SpringTooStiff {
        /// The joint.
        joint: String,
        /// Sum of the springs at the joint (N m/rad or N/m).
        stiffness: f64,
        /// Frequency of their resonance (Hz).
        frequency_hz: f64,
        /// Step of the engine (ms).
        step_ms: f64,
        /// Longest step that is short enough (ms).
        longest_step_ms: f64,
    },
    /// A value of the scenario is impossible.
    #[error(transparent)]
    Scenario(#[from] DocumentError),
    /// A log cannot be read or written.
    #[error(transparent)]
    Log(#[from] LogError),
    /// The rows of a record are too far apart in time.
    #[error(
        "{of_run}: it has {rate_hz} rows a second, at least {slowest_hz} were expected; is its time in seconds?", of_run = of_run(run))]
    TooSlow {
        /// Name of the run.
        run: String,
        /// Its rate (Hz).
        rate_hz: f64,
        /// The slowest rate that is simulated (Hz).
        slowest_hz: f64,
    },
    /// A record is shorter than one replay window.
    #[error(
        "{of_run}: {found_s:.3} s are left of it, at least a window of {window_s} s was expected", of_run = of_run(run))]
    TooShort {
        /// Name of the run.
        run: String,
        /// Length of the record after filtering (s).
        found_s: f64,
        /// The window (s).
        window_s: f64,
    },
    /// An effect cannot act on the robot.
    #[error("effect {code} {effect}, {key}: {found}", code = .effect.code())]
    Effect {
        /// The effect.
        effect: EffectKind,
        /// Key of the value at fault.
        key: String,
        /// What was found and what was expected.
        found: String,
    },
    /// A stranger cannot act on the robot.
    #[error("stranger {stranger}, {key}: {found}")]
    Stranger {
        /// The stranger.
        stranger: StrangerKind,
        /// Key of the value at fault.
        key: String,
        /// What was found and what was expected.
        found: String,
    },
    /// No effect could be drawn.
    #[error(
        "hidden effects: none of {tried} draws gave a torque between {least} and {largest} of its joint's, {last}"
    )]
    NothingDrawn {
        /// Number of draws.
        tried: usize,
        /// Least share of the joint's torque.
        least: f64,
        /// Largest share.
        largest: f64,
        /// The last draw and its result in words, or that no effect could be put in.
        last: String,
    },
    /// A joint left its allowed range.
    #[error("{of_run} ended early: {fault}", of_run = of_run(run))]
    Fault {
        /// Name of the run.
        run: String,
        /// What happened.
        #[source]
        fault: MachineFault,
    },
}
