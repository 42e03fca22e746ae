//! Every constant that decides, with its unit, what it means and what it was chosen on.
//!
//! Two more can be set: the practical share and the open share of [`crate::Settings`]. Each of these was taken out, or
//! set to a few values, on stored trials of the panel (`scenarios/panel.toml`); the README of this crate has what
//! that won and lost.

/// Least gain in log evidence (nats) for a hypothesis to enter or stay, most that one in its place may
/// lack to be its rival, and half the weighted sum of squares (of held-out blocks) by which a size must vary:
/// odds of 20 to 1.
pub(crate) const EVIDENCE: f64 = 3.0;

/// The same (nats) for an effect that some error elsewhere, or one of many trial shapes, may pass for.
pub(crate) const EVIDENCE_OF_DOUBTFUL: f64 = 10.0;

/// Variation (RMS, as a share of the size) beyond which an effect is not the cause. The laws of bodies,
/// gears and sensors are exact.
pub(crate) const VARIATION: f64 = 0.25;

/// The same for friction and springs, of which every law is a rough one.
pub(crate) const VARIATION_OF_ROUGH: f64 = 0.7;

/// Half, wherever most of something is asked for: of a finding's held-out gain, that a rival must reach; of what is
/// left (RMS), that a name may take instead of what counts in practice and that a tone in the band must be; of its
/// power, that a tone as slow as the motion must be, or the effort beyond a limit must take; of the amplitude of a tone
/// in one run or line, that it must have in another to be the same there; of the prior's standard deviation, below
/// which that of a number must lie for the logs to tell it.
pub(crate) const MOST: f64 = 0.5;

/// Least share of what a link's inertia explains that a physical inertia must explain.
pub(crate) const KEPT_BY_BODIES: f64 = 0.9;

/// Standard errors by which two numbers differ: errors of two models over the blocks, an RMS and the noise.
pub(crate) const ERRORS: f64 = 2.0;

/// Standard errors at which an effect would be found in four cases of five by a test at
/// level 0.005, two-sided: 2.81 + 0.84.
pub(crate) const DETECTED_AT: f64 = 3.65;

/// Least power over that around it: of a tone over the spectrum, in every run (one false tone in `exp(20)` frequencies
/// of one run), of what the other effects lack above a limit over what they leave below and over what is left there of a
/// clamped effort.
pub(crate) const STANDS_OUT: f64 = 20.0;

/// Largest difference between the beats of two lines that are one, over the beat of the stronger.
pub(crate) const ONE_LINE: f64 = 0.05;

/// How far above the noise what is left may be and still be noise, whatever the length of the log: a
/// density read from a spectrum is some ten per cent off.
pub(crate) const OF_NOISE: f64 = 1.2;

/// The same of a command, which holds what a controller makes of the steps of encoders.
pub(crate) const OF_COMMANDED_NOISE: f64 = 1.6;

/// Share of the effort's RMS above which only the effort's own noise closes a joint, and nothing one that
/// has a cause of its own: more room than that measures up to what matters.
pub(crate) const DROWNED: f64 = 0.15;

/// Share of a joint's effort RMS below which dry friction that goes unseen does not matter. Of 78 arms of the panel
/// that were called consistent or explained, 33 wrongly, a quarter leaves 15 wrong and 38 right ones, a tenth 13
/// and 33; the palm of a clean WAM, which needs 1.3 mN m, hides .12.
pub(crate) const UNSEEN: f64 = 0.25;
