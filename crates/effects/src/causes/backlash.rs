use catalogue::EffectKind;
use robot::{Actuator, Robot};

use crate::bounds::down_to_zero;
use crate::column::{Column, at_joint};
use crate::effect::Explain;
use crate::motion::frame::Frame;
use crate::motion::run_motion::Motion;
use crate::motion::scale::Scale;
use crate::motion::transmission::{Carried, Gap, play};
use crate::place::{Place, every_joint};
use crate::quantity::{Quantity, actuator_quantity};
use crate::traits::{Law, Linearity, Nature, Seat, Weights};

/// Motor and link apart by half the gap on the side of the load: one weight a joint, the change
/// of the gap (rad or m).
///
/// How long the link takes from side to side goes with the third root of the gap, and what is late
/// by a tenth of a second is none of what is not. The column of a robot without a gap is that of a
/// trial gap, and the difference of two gaps in a robot with one.
pub(crate) struct Backlash;

/// Trial gaps (rad or m), each one and a half times the one before: those below the first are
/// crossed as fast as it.
const TRIALS: [f64; 9] = [0.002, 0.003, 0.0045, 0.007, 0.01, 0.015, 0.022, 0.033, 0.05];

/// Gap for which the column is made where none was tried (rad or m).
const SMALL: f64 = 0.005;

/// Relative difference of the gaps whose motions are compared.
const STEP: f64 = 0.1;

/// Standard deviation of a gap before any data (rad or m): gears have tenths of a milliradian,
/// worn joints some ten.
const GAP_SD: f64 = 0.01;

impl Explain for Backlash {
    fn kind(&self) -> EffectKind {
        EffectKind::Backlash
    }

    fn nature(&self) -> Nature {
        Nature::new(Linearity::Doubtful, Law::Firm, Seat::BeforeTheLink, Weights::Direct, &[])
    }

    fn places(&self, robot: &Robot) -> Vec<Place> {
        every_joint(robot)
    }

    fn shapes(&self, joint: usize, robot: &Robot, _: &Scale) -> Vec<f64> {
        let known = robot.links()[joint].actuator.backlash > 0.0;
        if known { Vec::new() } else { TRIALS.to_vec() }
    }

    fn sow(&self, _: usize, drive: &mut Actuator, shape: f64) {
        drive.backlash_trial = shape;
    }

    fn columns(&self, place: Place, motion: &Motion) -> Vec<Column> {
        let Place::Joint(j) = place else { return Vec::new() };
        let carried = Carried::beyond(motion.tight_load(j), &motion.slopes(j)[j]);
        vec![motion.twisted(j, &play_per_gap(motion, j, carried))]
    }

    fn twist(&self, place: Place, motion: &Motion) -> Vec<Column> {
        let Place::Joint(j) = place else { return Vec::new() };
        let ratio = motion.drives[j].transmission_ratio;
        let play = play_per_gap(motion, j, Carried::here(&motion.load[j], &motion.slopes(j)[j]));
        vec![at_joint(j, play.into_iter().map(|x| x / ratio))]
    }

    fn prior(&self, _: Place, _: &Robot, _: &Scale) -> Vec<f64> {
        vec![GAP_SD]
    }

    fn bounds(&self, place: Place, robot: &Robot) -> Vec<(f64, f64)> {
        let Place::Joint(j) = place else { return Vec::new() };
        down_to_zero(robot.links()[j].actuator.backlash)
    }

    fn extend(&self, place: Place, robot: &mut Robot, weights: &[f64], _: &Frame) {
        let (Place::Joint(j), [change]) = (place, weights) else { return };
        if let Some(link) = robot.link_mut(j) {
            link.actuator.backlash += change;
        }
    }

    fn quantities(&self, place: Place, nominal: &Robot, extended: &Robot) -> Vec<Quantity> {
        let Place::Joint(j) = place else { return Vec::new() };
        vec![actuator_quantity(self.kind(), 0, j, [nominal, extended], |a| a.backlash)]
    }
}

/// What a unit of gap adds to `theta - q` at joint `j`.
fn play_per_gap(motion: &Motion, j: usize, carried: Carried<'_>) -> Vec<f64> {
    let drive = &motion.drives[j];
    let at = |gap: f64| play(carried, Gap::of(drive, gap), motion.period_s);
    let Actuator { backlash: gap, backlash_trial: trial, .. } = *drive;
    if gap > 0.0 {
        let (wide, narrow) = (at((1.0 + STEP) * gap), at((1.0 - STEP) * gap));
        wide.iter().zip(narrow).map(|(w, n)| (w - n) / (2.0 * STEP * gap)).collect()
    } else {
        let gap = if trial > 0.0 { trial } else { SMALL };
        at(gap).iter().map(|x| x / gap).collect()
    }
}
