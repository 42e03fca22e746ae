use std::f64::consts::PI;

use logs::{Run, of_run};
use robot::Robot;

use crate::observation::{
    CountedTogether, JointUnit, Observation, ObservationKind, OtherLock, Rival, RunStretch, RunZero,
};

const FOREIGN: &str = "Nothing of the nominal torque is in the efforts, whatever sign, order, unit, gravity or clock \
                       they are read with";

/// Zeros of runs that are listed one by one.
const MOST_ZEROS: usize = 4;

/// Stretches that are listed one by one.
const MOST_STRETCHES: usize = 3;

impl Observation {
    /// What is wrong and where, the evidence with its numbers, and what to do, in words.
    ///
    /// Names of joints and runs are those of the arguments of [`crate::inspect`].
    pub fn sentence(&self, robot: &Robot, runs: &[Run]) -> String {
        let names = Names { robot, runs };
        let mut text = names.what(self.kind, &self.joints);
        if let Some(own) = names.own_units(&self.units) {
            text = own;
        }
        if !self.locks.is_empty() {
            text = locks(&self.locks);
        }
        if let Some(zeros) = names.zeros(&self.zeros, &self.joints) {
            text += &zeros;
        }
        if let ObservationKind::Overlap { shift_s, length_s } = self.kind {
            return names.overlap(&self.runs, shift_s, length_s);
        }
        if let ObservationKind::OtherClock { factor } = self.kind {
            text = names.other_clock(&self.runs, factor);
        }
        if !self.stretches.is_empty() {
            text += &format!(" ({})", names.stretches(&self.stretches));
        }
        for other in &self.or {
            text += &format!(", or {}", names.alternative(other));
        }
        text += ".";
        if let Some(e) = &self.evidence {
            let read = match self.kind {
                ObservationKind::AnotherRobot => "friction and offset alone",
                ObservationKind::LockedElsewhere if self.locks.len() == 1 => {
                    "with that joint there"
                }
                ObservationKind::LockedElsewhere => "with these joints there",
                _ => "the log read so",
            };
            text += &format!(
                " At joint {} the nominal torque leaves {} of the effort's variance as the log stands, {read} {}.",
                names.joint(e.joint),
                percent(e.before),
                percent(e.after)
            );
        }
        if let ObservationKind::LockedElsewhere = self.kind {
            return format!("{text} {}", locked_keys(&self.locks));
        }
        format!("{text} {}", remedy(self.kind))
    }
}

/// Names of joints and runs.
struct Names<'a> {
    robot: &'a Robot,
    runs: &'a [Run],
}

impl Names<'_> {
    fn joint(&self, j: usize) -> String {
        self.robot.joint_names().nth(j).unwrap_or("?").to_owned()
    }

    fn run(&self, r: usize) -> &str {
        self.runs.get(r).map_or("?", |run| run.name.as_str())
    }

    /// `joint a`, `joints a and b`, `all joints`.
    fn joints(&self, joints: &[usize]) -> String {
        let names: Vec<String> = joints.iter().map(|&j| self.joint(j)).collect();
        match names.as_slice() {
            all if all.len() == self.robot.joint_count() && all.len() > 2 => {
                "all joints".to_owned()
            }
            [] => "no joint".to_owned(),
            [one] => format!("joint {one}"),
            [first @ .., last] => format!("joints {} and {last}", first.join(", ")),
        }
    }

    /// Units of position and effort of joints.
    fn units(&self, joints: &[usize]) -> [&'static str; 2] {
        let slides = |j: &usize| {
            self.robot.links().get(*j).is_some_and(|link| !link.joint.kind.is_rotation())
        };
        if !joints.is_empty() && joints.iter().all(slides) { ["m", "N"] } else { ["rad", "N m"] }
    }

    fn what(&self, kind: ObservationKind, joints: &[usize]) -> String {
        use ObservationKind as K;
        let at = self.joints(joints);
        match kind {
            K::StuckEncoder
            | K::Held
            | K::Spikes { .. }
            | K::FrequentSpikes { .. }
            | K::TurnJump { .. } => self.moment(kind, joints),
            K::EffortSign | K::PositionSign | K::AxisSign | K::VelocitySign => {
                other_sign(kind, &at)
            }
            K::JointsExchanged => format!("The columns of {at} seem to be exchanged"),
            K::EffortsExchanged => format!("The efforts of {at} seem to be exchanged"),
            K::EffortUnit { factor } => {
                let (factor, [_, unit]) = (number(factor), self.units(joints));
                format!(
                    "The effort of {at} seems to be in another unit: {factor} logged per {unit}"
                )
            }
            K::UnknownUnit => format!(
                "The unit of the effort of {at} is not known: other joints are in another unit, and the motion here does \
                 not show its own. It is read with their middle factor"
            ),
            K::ZerosOfRuns => format!("The zero of the effort of {at} differs from run to run"),
            K::GoalVelocity => goal_velocity(&at),
            K::NormalisedPositions { share } => self.normalised_positions(joints, share),
            K::EffortWithoutGravity => "The efforts lack the torque of gravity".to_owned(),
            K::GravityDirection { .. } | K::GravityValue { .. } => self.gravity(kind),
            K::PositionOffset { offset } => {
                format!(
                    "The position of {at} seems to be off by {:.0} degrees",
                    offset * 180.0 / PI
                )
            }
            K::CountedTogether(counted) => self.counting_words(counted),
            K::Degrees => format!("The position of {at} seems to be degrees"),
            K::TimeUnit { factor } => format!(
                "Effort and motion disagree on what a second is: {} in the column `time` are one",
                number(factor)
            ),
            K::OtherClock { .. } | K::Overlap { .. } => String::new(),
            K::EffortShifted { shift_s } => format!(
                "The efforts fit the motion when they are taken {:.2} s {}",
                shift_s.abs(),
                if shift_s > 0.0 { "earlier" } else { "later" }
            ),
            K::VelocityUnit { factor } => format!(
                "The velocity columns are {} times the derivative of the positions",
                number(factor)
            ),
            K::AtLimit { share, limit } => {
                let (share, [_, unit]) = (percent(share), self.units(joints));
                format!("The effort of {at} is at {limit:.3} {unit} for {share} of the time")
            }
            K::LockedElsewhere => "Joints that are locked seem to stand elsewhere".to_owned(),
            K::InertiaUnit => self.wide_inertias(),
            K::AnotherRobot => FOREIGN.to_owned(),
        }
    }

    /// What is wrong with some seconds.
    fn moment(&self, kind: ObservationKind, joints: &[usize]) -> String {
        use ObservationKind as K;
        let at = self.joints(joints);
        match kind {
            K::StuckEncoder => format!("The position of {at} stands still while the arm moves on"),
            K::Spikes { count, height } => {
                let [unit, _] = self.units(joints);
                format!(
                    "The position of {at} has single samples that are off: {count}, by up to {height:.3} {unit}"
                )
            }
            K::FrequentSpikes { share, height } => {
                let ([unit, _], share) = (self.units(joints), percent(share));
                format!(
                    "The position of {at} has single samples that are off, in {share} of the rows, by up to {height:.3} {unit}"
                )
            }
            K::TurnJump { turns } => {
                let turns = turns.abs();
                format!("The position of {at} jumps between two samples, by {turns} full turns")
            }
            _ => "All signals stand still while the clock runs on".to_owned(),
        }
    }

    /// The links whose inertia is in another unit.
    fn wide_inertias(&self) -> String {
        let all = self.robot.wide_inertias();
        let each: Vec<String> = all.iter().map(ToString::to_string).collect();
        format!("The description has an inertia in another unit: {}", each.join("; "))
    }

    /// A position that is counted together with another one.
    fn counting_words(&self, counted: CountedTogether) -> String {
        let [own, with] = [counted.joint, counted.with].map(|j| self.joint(j));
        let sign = if counted.sign > 0.0 { "+" } else { "-" };
        let drive = if counted.is_driven {
            format!(
                ", and the effort of {with} to be that of a drive that does not carry the drive of {own}"
            )
        } else {
            String::new()
        };
        format!(
            "The position of joint {own} seems to be counted from where {with} begins (its column holds {own} {sign} \
             {with}){drive}"
        )
    }

    /// Positions that are no degrees.
    fn normalised_positions(&self, joints: &[usize], share: f64) -> String {
        let limits = |j: &usize| self.robot.links().get(*j)?.joint.limits.position;
        let limits = joints
            .first()
            .and_then(limits)
            .map_or_else(String::new, |(low, high)| format!(" of {low:.3} to {high:.3} rad"));
        format!(
            "Read as degrees, the position of {} is beyond its limits{limits} in {} of the rows, and no joint of the \
             dataset is beyond 100: it may be normalised to -100 .. 100, or have another zero",
            self.joints(joints),
            percent(share)
        )
    }

    /// Another gravity than that of the description.
    fn gravity(&self, kind: ObservationKind) -> String {
        let nominal = self.robot.gravity_in_base().norm();
        match kind {
            ObservationKind::GravityDirection { gravity_in_base: g, angle } => format!(
                "The efforts ask for a gravity of ({:.2}, {:.2}, {:.2}) m/s² in the base frame, {:.0} degrees from that \
                 of the description",
                g.x,
                g.y,
                g.z,
                angle * 180.0 / PI
            ),
            ObservationKind::GravityValue { value } => format!(
                "The efforts ask for a gravity of {value:.2} m/s², the description has {nominal:.2} m/s²"
            ),
            _ => String::new(),
        }
    }

    /// The units of joints that have each their own; `None` where all have the same.
    fn own_units(&self, units: &[JointUnit]) -> Option<String> {
        let one = |unit: &JointUnit| {
            let (factor, error) = (unit.factor?, unit.standard_error?);
            let [low, high] = [factor - 2.0 * error, factor + 2.0 * error].map(number);
            let (joint, factor) = (self.joint(unit.joint), number(factor));
            Some(format!("{factor} ({low} to {high}) at {joint}"))
        };
        let each: Vec<String> = units.iter().filter_map(one).collect();
        let joints: Vec<usize> = units.iter().map(|unit| unit.joint).collect();
        let [_, unit] = self.units(&joints);
        (!each.is_empty()).then(|| {
            let each = each.join(", ");
            format!("The efforts seem to be in another unit, such as currents: logged per {unit} are {each}")
        })
    }

    /// The zeros of the runs, joint by joint: each, or their range where there are many.
    fn zeros(&self, zeros: &[RunZero], joints: &[usize]) -> Option<String> {
        let of_joint = |&joint: &usize| {
            let own: Vec<&RunZero> = zeros.iter().filter(|zero| zero.joint == joint).collect();
            let offsets = || own.iter().map(|zero| zero.offset);
            let [_, unit] = self.units(&[joint]);
            let each = match own.len() {
                0..=MOST_ZEROS => {
                    let each: Vec<String> = own
                        .iter()
                        .map(|zero| format!("{:.3} in {}", zero.offset, self.run(zero.run)))
                        .collect();
                    format!("{} ({unit})", each.join(", "))
                }
                many => format!(
                    "{:.3} to {:.3} {unit} over {many} runs",
                    offsets().fold(f64::INFINITY, f64::min),
                    offsets().fold(f64::NEG_INFINITY, f64::max)
                ),
            };
            if joints.len() > 1 { format!("{}: {each}", self.joint(joint)) } else { each }
        };
        let each: Vec<String> = joints.iter().map(of_joint).collect();
        (!zeros.is_empty()).then(|| format!(": {}", each.join("; ")))
    }

    fn alternative(&self, rival: &Rival) -> String {
        let what = self.what(rival.kind, &rival.joints);
        let mut letters = what.chars();
        let first = letters.next().map(|c| c.to_lowercase().to_string()).unwrap_or_default();
        first + letters.as_str()
    }

    fn overlap(&self, runs: &[usize], shift_s: f64, length_s: f64) -> String {
        let name = |k: usize| self.run(runs.get(k).copied().unwrap_or(usize::MAX));
        format!(
            "Runs {} and {} hold the same {length_s:.2} s, in the second {shift_s:+.3} s later. {}",
            name(0),
            name(1),
            remedy(ObservationKind::Overlap { shift_s, length_s })
        )
    }

    fn other_clock(&self, runs: &[usize], factor: f64) -> String {
        let run = self.run(runs.first().copied().unwrap_or(usize::MAX));
        format!(
            "Run {run} has another clock: {} in the column `time` are a second, as its velocities say, which agree with \
             the positions in other runs",
            number(factor)
        )
    }

    fn stretches(&self, all: &[RunStretch]) -> String {
        let one = |s: &RunStretch| {
            if s.to_s - s.from_s > 0.0 {
                format!("{}, {:.3} to {:.3} s", of_run(self.run(s.run)), s.from_s, s.to_s)
            } else {
                format!("{}, {:.3} s", of_run(self.run(s.run)), s.from_s)
            }
        };
        let first: Vec<String> = all.iter().take(MOST_STRETCHES).map(one).collect();
        let more = all.len().saturating_sub(MOST_STRETCHES);
        let rest = if more > 0 { format!("; and {more} more") } else { String::new() };
        first.join("; ") + &rest
    }
}

fn goal_velocity(at: &str) -> String {
    format!(
        "The position loop of {at} seems to follow the velocity of the goal as well: its effort is \
         kp (goal - q) + kd (d goal/dt - qd)"
    )
}

fn remedy(kind: ObservationKind) -> &'static str {
    use ObservationKind as K;
    match kind {
        K::EffortSign => "Turn the sign of the column, or the joint's axis in the description.",
        K::PositionSign => {
            "Turn the sign of position and velocity, or the joint's axis in the description."
        }
        K::AxisSign => "Turn the joint's axis in the description, or both signs in the column map.",
        K::VelocitySign => "The velocity column is not used; turn its sign.",
        K::JointsExchanged | K::EffortsExchanged => "Put the columns under the right names.",
        K::EffortUnit { .. } | K::UnknownUnit => "State the unit in the column map.",
        K::ZerosOfRuns => "Set the torque sensors to zero before every run.",
        K::GoalVelocity => {
            "State the gains of a loop that damps the velocity alone, or log efforts."
        }
        K::NormalisedPositions { .. } => {
            "In the column map, of position and desired_position: scale = (b - a) / 200 and offset = (a + b) / 2 with the range of the calibration from a to b (rad), a list with one number a joint each."
        }
        K::EffortWithoutGravity => {
            "Log the whole torque, or add the controller's gravity torque to the effort: without it, nothing at rest tells a mass."
        }
        K::GravityDirection { .. } | K::GravityValue { .. } => {
            "State how the base is mounted: `gravity_m_per_s2` in robot.toml."
        }
        K::PositionOffset { .. } => {
            "Check the zero of the encoder against that of the description."
        }
        K::CountedTogether(_) => {
            "Log the angle between the two links, or describe the joint as it is counted."
        }
        K::Degrees => "State the unit in the column map.",
        K::TimeUnit { .. } => {
            "State the unit of time in the column map, or log the controller's clock."
        }
        K::OtherClock { .. } => "Write the time of this run in seconds.",
        K::EffortShifted { .. } => "Check that both are of one clock.",
        K::VelocityUnit { .. } => {
            "The velocity columns are not used; state their unit in the column map."
        }
        K::StuckEncoder => "Leave these seconds out, and check the encoder and its cable.",
        K::Held => "Leave these seconds out, and check the logger.",
        K::Spikes { .. } => "Leave these samples out.",
        K::FrequentSpikes { .. } => {
            "Check the encoder and its cable: no derivative of such a position is that of the motion."
        }
        K::TurnJump { .. } => "Take the full turns from the samples behind the jump.",
        K::AtLimit { .. } => {
            "Record a gentler motion: a clipped effort says nothing of the torque."
        }
        K::Overlap { .. } => {
            "Use one of them: what is fitted to the one is not tested by the other."
        }
        K::LockedElsewhere => "State where they stand: `locked` in robot.toml.",
        K::InertiaUnit => "No logs can be compared with such a model.",
        K::AnotherRobot => "Check that logs and description are of the same robot.",
    }
}

/// What has the other sign.
fn other_sign(kind: ObservationKind, at: &str) -> String {
    match kind {
        ObservationKind::EffortSign => format!("The effort of {at} seems to have the other sign"),
        ObservationKind::AxisSign => {
            format!("The axis of {at} seems to be turned: position and effort have the other sign")
        }
        ObservationKind::VelocitySign => format!(
            "The velocity column of {at} has the other sign than the derivative of the position"
        ),
        _ => format!("The position of {at} seems to have the other sign"),
    }
}

/// Where locked joints seem to stand.
fn locks(all: &[OtherLock]) -> String {
    let each: Vec<String> = all
        .iter()
        .map(|lock| {
            format!("{} at {:.2} rad, not {:.2}", lock.joint, lock.position, lock.described)
        })
        .collect();
    let joints =
        if all.len() == 1 { "A joint that is locked seems" } else { "Joints that are locked seem" };
    format!("{joints} to stand elsewhere: {}", each.join("; "))
}

/// The option that locks joints there.
fn locked_keys(all: &[OtherLock]) -> String {
    let each: Vec<String> =
        all.iter().map(|lock| format!("{}={:.2}", lock.joint, lock.position)).collect();
    let they = if all.len() == 1 { "it" } else { "they" };
    format!(
        "If {they} stood there, --locked {} says so, or `locked` in a robot.toml.",
        each.join(",")
    )
}

fn percent(share: f64) -> String {
    if share > MOST_SHARE { "over 1000 %".to_owned() } else { format!("{:.0} %", 100.0 * share) }
}

/// Share from which on its digits say nothing more.
const MOST_SHARE: f64 = 10.0;

/// A factor with three digits.
fn number(x: f64) -> String {
    match x.abs() {
        size if !(1e-2..1e5).contains(&size) => format!("{x:.2e}"),
        size if size >= 100.0 => format!("{x:.0}"),
        size if size < 1.0 => format!("{x:.4}"),
        _ => format!("{x:.3}"),
    }
}
