//! Every constant that decides, with its unit, what it means and what it was chosen on.
//!
//! Two of them can be set: the practical share and the open share of [`crate::Settings`]. The others were tried at
//! a few values on the panel (`scenarios/panel.toml`) and on the recorded arms that the README of this crate names.

// Search.

/// Least gain in log evidence (nats) for a hypothesis to enter or stay, most that one in its place may
/// lack to be its rival, and half the weighted sum of squares (of held-out blocks) by which a size must vary:
/// odds of 20 to 1.
pub(crate) const EVIDENCE: f64 = 3.0;

/// The same (nats) for an effect that some error elsewhere, or one of many trial shapes, may pass for.
pub(crate) const EVIDENCE_OF_DOUBTFUL: f64 = 10.0;

/// Fall of a joint's held-out mean square that counts, as a share of what was left, however
/// small that is.
pub(crate) const SHARE_OF_REST: f64 = 0.25;

/// Least share of what a link's inertia explains that a physical inertia must explain.
pub(crate) const KEPT_BY_BODIES: f64 = 0.9;

/// Variation (RMS, as a share of the size) beyond which an effect is not the cause. The laws of bodies,
/// gears and sensors are exact.
pub(crate) const VARIATION: f64 = 0.25;

/// The same for friction and springs, of which every law is a rough one.
pub(crate) const VARIATION_OF_ROUGH: f64 = 0.7;

/// Least share of a finding's held-out gain that a rival must reach to be one.
pub(crate) const RECOVERED: f64 = 0.5;

/// Standard errors by which a model must do worse to be told apart.
pub(crate) const TOLD_APART: f64 = 2.0;

// What is known.

/// Share of the prior's standard deviation above which a number is the prior's, not the data's: it is not
/// determined, and of an effect that is ruled out the logs show nothing.
pub(crate) const DETERMINED: f64 = 0.5;

/// Standard errors at which an effect would be found in four cases of five by a test at
/// level 0.005, two-sided: 2.81 + 0.84.
pub(crate) const DETECTED_AT: f64 = 3.65;

// Lines and limits.

/// Least power of a tone over that of the spectrum around it, in every run: one false tone in
/// `exp(20)` frequencies of one run.
pub(crate) const LINE_STANDS_OUT: f64 = 20.0;

/// The same where there are fewer than three runs to agree on it.
pub(crate) const LINE_STANDS_OUT_IN_FEW: f64 = 40.0;

/// Largest ratio of the amplitudes of a tone in two runs.
pub(crate) const LINE_IS_EVEN: f64 = 2.0;

/// Least share of what is left at a joint that a tone must be.
pub(crate) const LINE_SHARE: f64 = 0.02;

/// Least share of what is left, in every window, that a tone as slow as the motion must be.
pub(crate) const LINE_SHARE_OF_SLOW: f64 = 0.5;

/// Least share of what is left in the band of the diagnosis that a tone in it must be: what the
/// motion makes of an effect that is not found has lines there too.
pub(crate) const LINE_SHARE_IN_BAND: f64 = 0.25;

/// Share of the speed of a joint at the frequency of such a tone that may make it the motion's.
pub(crate) const LINE_SHARE_OF_SPEED: f64 = 0.4;

/// Largest difference between the beats of two lines that are one, over the beat of the stronger.
pub(crate) const ONE_LINE: f64 = 0.05;

/// Least amplitude, over that of the stronger line, of one that makes the two a band.
pub(crate) const OF_A_BAND: f64 = 0.5;

/// Least share of what all other effects leave that must go with the limit.
pub(crate) const LIMIT_SHARE: f64 = 0.5;

/// Power of what the other effects lack above the limit, over what they leave below it.
pub(crate) const LIMIT_STANDS_OUT: f64 = 25.0;

/// Most of that which may be left once the effort is clamped.
pub(crate) const LIMIT_LEFT: f64 = 0.1;

// Verdict.

/// How far above the noise what is left may be and still be noise, whatever the length of the log: a
/// density read from a spectrum is some ten per cent off. A command holds besides what a controller
/// makes of the steps of encoders, which is not white.
pub(crate) const OF_NOISE: f64 = 1.2;

/// The same of a command.
pub(crate) const OF_COMMANDED_NOISE: f64 = 1.6;

/// Standard errors of an RMS, `1 / sqrt(2 n)` of it for `n` independent samples, that it may be besides.
pub(crate) const ERRORS: f64 = 3.0;

/// Share of the effort's RMS above which only the effort's own noise closes a joint, and nothing one that
/// has a cause of its own: more room than that measures up to what matters.
pub(crate) const DROWNED: f64 = 0.15;

/// Share of what is left that a flexible predictor must find for it to depend on the motion.
pub(crate) const DEPENDS: f64 = 0.15;

/// Share of a joint's effort RMS below which dry friction that goes unseen does not matter. Of 78 arms of the panel
/// that were called consistent or explained, 33 wrongly, a quarter leaves 15 wrong and 38 right ones, a tenth 13
/// and 33; the palm of a clean WAM, which needs 1.3 mN m, hides .12.
pub(crate) const UNSEEN: f64 = 0.25;

/// Least share of a residual that a signal must predict to be named.
pub(crate) const NAMED: f64 = 0.03;
