use std::sync::OnceLock;

use logs::{GoalEffort, differentiate};
use robot::{Actuator, Robot, SensingSide};

use crate::column::{ColumnPart, EffectColumn, at_joint};
use crate::motion::cable_loop::Loop;
use crate::motion::compliance::{Compliance, Spring, curvature, rate};
use crate::motion::direction::{direction, stands};
use crate::motion::drive::{bristles, motor_torque, warmth};
use crate::motion::dry_friction::along_a_log;
use crate::motion::effort_timing::{EffortTiming, shift};
use crate::motion::encoders::{Encoders, JointMotions};
use crate::motion::frame::{Frame, TrialSpring};
use crate::motion::rigid_bodies::{LinkRegressor, link_regressor, loads, tilt};
use crate::motion::slopes::Slopes;
use crate::motion::transmission::{
    Deflection, Gap, LoadAlong, correct_reading, loads_at_rest, play,
};

/// The motion of one run and the efforts that the nominal robot expects along it.
///
/// All signals are indexed `[joint][sample]`.
#[derive(Debug, Clone)]
pub struct RunMotion {
    /// Position of the motor, seen at the joint (rad or m).
    pub q: Vec<Vec<f64>>,
    /// Velocity of the motor, seen at the joint (rad/s or m/s).
    pub qd: Vec<Vec<f64>>,
    /// Acceleration of the motor, seen at the joint (rad/s² or m/s²).
    pub qdd: Vec<Vec<f64>>,
    /// Direction of motion, in [-1, 1]: the sign of the velocity. Below the rest speed it changes linearly over a
    /// brief stand and is proportional to the velocity otherwise. With presliding it is the share of dry friction
    /// that the bristles hold.
    pub direction: Vec<Vec<f64>>,
    /// Velocity as reported, whose sign is that of the motion (rad/s or m/s).
    qd_reported: Vec<Vec<f64>>,
    /// Speed below which a joint counts as at rest (rad/s or m/s).
    rest_speed: Vec<f64>,
    /// Torque that the transmission carries to the link (N·m or N).
    pub load: Vec<Vec<f64>>,
    /// Torque of the nominal robot before its gain and offset (N·m or N).
    pub torque: Vec<Vec<f64>>,
    /// Effort that the nominal robot expects in the log (N·m or N).
    pub effort: Vec<Vec<f64>>,
    /// Middle of the range of each joint over all runs (rad or m).
    pub centre: Vec<f64>,
    /// Reported effort per unit of torque, nominal.
    pub gain: Vec<f64>,
    /// Time between samples (s).
    pub period_s: f64,
    /// Time from when the drives were cold to the first sample (s).
    since_cold_s: f64,
    /// Position, velocity and acceleration of the links.
    pub(crate) link: JointMotions,
    /// Change of the load by a tilt of the base; filled at the first request.
    tilt: OnceLock<Vec<[Vec<f64>; 2]>>,
    /// Change of the load by a displacement of the links; filled at the first request.
    slopes: OnceLock<Slopes>,
    /// Parts of the reported efforts that follow the goals, one entry a joint.
    goal_efforts: Vec<Option<GoalEffort>>,
    /// The nominal robot.
    robot: Robot,
    /// The drives of the nominal robot.
    pub(crate) drives: Vec<Actuator>,
    /// Trial gap of each joint (rad or m); 0 where none is set.
    pub(crate) trial_gaps: Vec<f64>,
    /// Trial spring of each rigid joint; `None` where none is set.
    trial_springs: Vec<Option<TrialSpring>>,
    /// Trial time by which goals are later than described (s); 0 where none is set.
    trial_lateness_s: f64,
    /// Load of the links along the measured motion; `None` where motors and links move as one.
    rigid_load: Option<Vec<Vec<f64>>>,
    /// One for each joint; `None` without a spring between its encoder and its link.
    compliances: Vec<Option<Compliance>>,
}

impl RunMotion {
    /// Evaluates the nominal robot along `reading`: `q`, `qd`, `qdd` as reported (each
    /// `[joint][sample]`, every `period_s`).
    ///
    /// ```text
    /// q = transmission_ratio (q reported - encoder_offset)
    /// load   = Y pi + stiffness x + cubic x³ + loop + counterbalance(q_link),   x = q_link - rest
    /// torque = load + rotor_inertia qdd + viscous qd + dry friction
    /// effort(t) = transmission_ratio torque_gain torque(t + delay - skew) + torque_offset
    ///             + kp (goal(t) - goal(t - lateness))
    /// ```
    ///
    /// The last term is that of efforts which are computed from goals, where these are later than described.
    ///
    /// Twist and play lie between motor and link: `theta - q = load / elasticity + x`,
    /// `|x| <= backlash / 2`.
    ///
    /// # Panics
    ///
    /// When the signals do not have one entry a joint of equal length.
    pub fn new(robot: &Robot, frame: &Frame, reading: [Vec<Vec<f64>>; 3], period_s: f64) -> Self {
        let links = vec![None; robot.joint_count()];
        let goal_efforts = vec![None; robot.joint_count()];
        let encoders = Encoders { reported: reading, links, goal_efforts, since_cold_s: 0.0 };
        Self::from_encoders(robot, frame, encoders, period_s)
    }

    /// The same for runs in which some links have an encoder of their own. The twist is then the measured one, and
    /// the robot's elasticity and backlash are ignored.
    ///
    /// # Panics
    ///
    /// As [`RunMotion::new`].
    pub fn from_encoders(robot: &Robot, frame: &Frame, encoders: Encoders, period_s: f64) -> Self {
        let joints = robot.joint_count();
        let drives: Vec<Actuator> = robot.links().iter().map(|l| l.actuator.clone()).collect();
        let Encoders { reported, links, goal_efforts, since_cold_s } = encoders;
        let qd_reported = reported[1].clone();
        let Deflection { motor, link, rigid_load, compliances } =
            Deflection::new(robot, correct_reading(robot, reported), links, period_s);
        let [q, qd, qdd] = motor;
        let directions = (0..joints).map(|j| {
            let by_speed =
                || direction(qd_reported[j].iter().copied(), frame.rest_speed[j], period_s);
            drives[j].presliding.map_or_else(by_speed, |way| bristles(&q[j], way).held)
        });
        let direction = directions.collect();
        let load = loads(robot, &link);
        let mut motion = Self {
            q,
            qd,
            qdd,
            direction,
            qd_reported,
            rest_speed: frame.rest_speed.clone(),
            load,
            torque: vec![Vec::new(); joints],
            effort: vec![Vec::new(); joints],
            centre: frame.centre.clone(),
            gain: drives.iter().map(|a| a.transmission_ratio * a.torque_gain).collect(),
            period_s,
            since_cold_s,
            link,
            tilt: OnceLock::new(),
            slopes: OnceLock::new(),
            goal_efforts,
            robot: robot.clone(),
            drives,
            trial_gaps: frame.trial_gaps.clone(),
            trial_springs: frame.trial_springs.clone(),
            trial_lateness_s: frame.trial_lateness_s,
            rigid_load,
            compliances,
        };
        motion.add_drives();
        motion
    }

    /// Number of samples.
    pub fn samples(&self) -> usize {
        self.q.first().map_or(0, Vec::len)
    }

    /// Samples in which joint `j` stands for longer than 0.2 s or at either end of the run, by the reported speed.
    /// Its dry friction may then have any value up to the level, so the effort says nothing of it.
    pub fn stands(&self, j: usize) -> Vec<bool> {
        stands(&self.qd_reported[j], self.rest_speed[j], self.period_s)
    }

    /// Samples in which joint `j` is at rest, however briefly, by the reported speed.
    pub fn rests(&self, j: usize) -> Vec<bool> {
        self.qd_reported[j].iter().map(|v| v.abs() < self.rest_speed[j]).collect()
    }

    /// Derivatives of the load of every joint by position, velocity and acceleration of the link of joint `j`.
    pub(crate) fn slopes(&self, j: usize) -> &[[Vec<f64>; 3]] {
        self.slopes.get_or_init(|| Slopes::new(&self.robot, &self.link)).by(j)
    }

    /// `[joint]`: the load per unit of the ten parameters of a link; empty where the joint does not carry it. It is
    /// evaluated at each call, because stored for all links it would dominate the memory of a motion.
    pub(crate) fn link_regressor(&self, link: usize) -> LinkRegressor {
        link_regressor(&self.robot, &self.link, link)
    }

    /// `[joint]`: the load per radian of tilt about the two horizontal axes.
    pub(crate) fn tilt(&self) -> &[[Vec<f64>; 2]] {
        self.tilt.get_or_init(|| tilt(&self.robot, &self.link))
    }

    /// Adds the torques of the drives, then gain, offset and timing.
    fn add_drives(&mut self) {
        for (i, a) in self.drives.iter().enumerate() {
            let torque = |t: usize| {
                let (state, load) =
                    ([self.q[i][t], self.qd[i][t], self.qdd[i][t]], self.load[i][t]);
                let warmth = self.warmth(i, t);
                load + motor_torque(a, state, along_a_log(a, self.direction[i][t]), load, warmth)
            };
            self.torque[i] = (0..self.samples()).map(torque).collect();
            if let (Some(way), Some(damping)) = (a.presliding, a.presliding_damping) {
                let (bent, torque) = (bristles(&self.q[i], way).bending, self.torque[i].iter_mut());
                torque.zip(bent).for_each(|(tau, bent)| *tau += damping * bent / self.period_s);
            }
        }
        self.add_shared_friction();
        for (i, a) in self.drives.iter().enumerate() {
            let scaled = self.torque[i].iter().map(|torque| self.gain[i] * torque).collect();
            let timed = self.with_timing(i, scaled);
            self.effort[i] = timed.into_iter().map(|effort| effort + a.torque_offset).collect();
        }
        self.add_late_goals();
    }

    /// Adds what the reported efforts have of goals that are followed later than described.
    fn add_late_goals(&mut self) {
        for i in 0..self.drives.len() {
            let lateness_s = self.goal_lateness_s(i);
            let Some(late) = self.late_goals(i, lateness_s).filter(|_| lateness_s.abs() > 0.0)
            else {
                continue;
            };
            self.effort[i].iter_mut().zip(late).for_each(|(effort, late)| *effort += late);
        }
    }

    /// Time by which the goals of joint `j` are later in this robot than in the reported effort (s).
    fn goal_lateness_s(&self, j: usize) -> f64 {
        let reported_s = self.goal_efforts[j].as_ref().map_or(0.0, |goal| goal.delay_s);
        self.drives[j].goal_delay_s - reported_s
    }

    /// What the reported effort of joint `j` has of goals that are followed `lateness_s` later, `kp (goal(t) - goal(t - lateness))`;
    /// `None` where the effort is logged.
    pub fn late_goals(&self, j: usize, lateness_s: f64) -> Option<Vec<f64>> {
        let GoalEffort { values, lead, .. } = self.goal_efforts[j].as_ref()?;
        let followed = shift(values, -lateness_s / self.period_s);
        let late = values.iter().zip(followed).map(|(goal, followed)| goal - followed);
        Some(late.skip(*lead).collect())
    }

    /// Change of the reported effort of joint `j` per second by which its goals are followed later: `kp d(goal)/dt`, or the mean
    /// of that over the trial time of a robot without a delay. `None` where the effort is logged.
    pub(crate) fn late_goal_part(&self, j: usize) -> Option<ColumnPart> {
        let GoalEffort { values, lead, .. } = self.goal_efforts[j].as_ref()?;
        let (lateness_s, trial_s) = (self.goal_lateness_s(j), self.trial_lateness_s);
        let values = if lateness_s.abs() > 0.0 || trial_s <= 0.0 {
            let followed = shift(values, -lateness_s / self.period_s);
            differentiate(&followed, self.period_s.recip()).split_off(*lead)
        } else {
            self.late_goals(j, trial_s)?.into_iter().map(|late| late / trial_s).collect()
        };
        Some(ColumnPart { joint: j, values })
    }

    /// Warm-up of the drive of joint `i` in sample `t`: 0 cold, 1 warm.
    fn warmth(&self, i: usize, t: usize) -> f64 {
        let since_cold_s = self.since_cold_s + t as f64 * self.period_s;
        self.drives[i].warming.map_or(0.0, |w| warmth(since_cold_s / w.time_constant_s))
    }

    /// Time since the drives were cold (s), sample by sample.
    pub(crate) fn since_cold_s(&self) -> impl Iterator<Item = f64> + '_ {
        (0..self.samples()).map(|t| self.since_cold_s + t as f64 * self.period_s)
    }

    /// Adds the friction of motors that joints share.
    fn add_shared_friction(&mut self) {
        for j in 0..self.drives.len() {
            let Some(c) = self.drives[j].coupling else { continue };
            for (k, way) in [1.0, -1.0].into_iter().enumerate() {
                let motor = self.motor(j, c.other, way * c.ratio);
                for (t, (w, s)) in motor.into_iter().enumerate() {
                    let friction = c.viscous[k] * w + c.level[k] * s;
                    self.torque[j][t] += friction;
                    self.torque[c.other][t] += way * c.ratio * friction;
                }
            }
        }
    }

    /// Speed and direction of a motor that turns with joint `j` and, by `ratio`, with joint `other`. The direction
    /// follows the rule for a joint, with the two rest speeds added.
    pub(crate) fn motor(&self, j: usize, other: usize, ratio: f64) -> Vec<(f64, f64)> {
        let rest = self.rest_speed[j] + ratio.abs() * self.rest_speed[other];
        let of = |signal: &[Vec<f64>], t: usize| signal[j][t] + ratio * signal[other][t];
        let speeds = (0..self.samples()).map(|t| of(&self.qd_reported, t));
        let directions = direction(speeds, rest, self.period_s);
        directions.into_iter().enumerate().map(|(t, s)| (of(&self.qd, t), s)).collect()
    }

    /// Effort of joint `j` at the times at which the log has it.
    pub(crate) fn with_timing(&self, j: usize, effort: Vec<f64>) -> Vec<f64> {
        EffortTiming::of(&self.drives[j]).with_log_timing(effort, self.period_s)
    }

    /// `d effort / dt` of joint `j`: the change of a command per second of delay or lag.
    pub(crate) fn torque_rate(&self, j: usize) -> EffectColumn {
        let gain = self.gain[j];
        let rate = differentiate(&self.torque[j], self.period_s.recip());
        at_joint(j, rate.into_iter().map(|r| gain * r))
    }

    /// Effort per unit of the load of joint `j` in sample `t`, including friction that grows with the load.
    fn load_gain(&self, j: usize, t: usize) -> f64 {
        let pressed = self.load[j][t].signum() * self.direction[j][t];
        self.gain[j] * (1.0 + self.drives[j].load_friction * pressed)
    }

    /// Effort of joint `j` per unit of its Coulomb level, which may vary with position.
    pub(crate) fn coulomb(&self, j: usize) -> impl Iterator<Item = f64> + '_ {
        let levels = self.coulomb_levels(j).zip(&self.direction[j]);
        levels.map(move |(level, s)| self.gain[j] * level * s)
    }

    /// Effort of joint `j` per unit of half the difference of its Coulomb levels, which may vary with position.
    pub(crate) fn coulomb_skew(&self, j: usize) -> impl Iterator<Item = f64> + '_ {
        let share = move |s: &f64| self.gain[j] * along_a_log(&self.drives[j], *s)[1];
        self.coulomb_levels(j).zip(self.direction[j].iter().map(share)).map(|(l, s)| l * s)
    }

    /// The Coulomb level of joint `j` over its mean.
    fn coulomb_levels(&self, j: usize) -> impl Iterator<Item = f64> + '_ {
        let wave = self.drives[j].friction_wave;
        let level =
            move |q: &f64| 1.0 + wave.map_or(0.0, |w| w.share * (w.periods * q + w.phase).cos());
        self.q[j].iter().map(level)
    }

    /// Change of the effort of joint `j` by a change of its load.
    pub(crate) fn load_part(&self, j: usize, load: impl Iterator<Item = f64>) -> ColumnPart {
        let values = load.enumerate().map(|(t, load)| self.load_gain(j, t) * load);
        ColumnPart { joint: j, values: values.collect() }
    }

    /// Load of joint `j` if motor and link moved as one.
    pub(crate) fn rigid_load(&self, j: usize) -> &[f64] {
        self.rigid_load.as_ref().map_or(&self.load[j], |load| &load[j])
    }

    /// Position that the robot expects from the motor encoder of joint `j` minus that of the link, where both are
    /// measured (rad or m).
    ///
    /// ```text
    /// (q + load / elasticity + x) / transmission_ratio + encoder_offset - q,  |x| <= backlash / 2
    /// ```
    pub fn twist(&self, j: usize) -> Vec<f64> {
        let drive = &self.drives[j];
        let compliance = drive.elasticity.map_or(0.0, f64::recip);
        let gap = Gap::of(drive, drive.backlash);
        let carried = LoadAlong::at_link(&self.load[j], &self.slopes(j)[j]);
        let play = play(carried, gap, self.period_s);
        let signals = self.link[0][j].iter().zip(&self.load[j]).zip(play);
        let twist = |((q, load), x): ((&f64, &f64), f64)| {
            (q + compliance * load + x) / drive.transmission_ratio + drive.encoder_offset - q
        };
        signals.map(twist).collect()
    }

    /// Change of the efforts by an additional `twist`, `theta - q`, of joint `j`, with the response of its spring.
    /// The measured side keeps its motion, and the other side moves by the twist.
    pub(crate) fn twist_column(&self, j: usize, twist: &[f64]) -> EffectColumn {
        let given = self.compliances[j].as_ref().map(|compliance| compliance.twist_under(twist));
        let twist = given.as_deref().unwrap_or(twist);
        let first = rate(twist, self.period_s);
        let second = curvature(twist, self.period_s);
        let drive = &self.drives[j];
        if drive.sensing == SensingSide::Link {
            let motor = |(v, a): (&f64, &f64)| drive.viscous * v + drive.rotor_inertia * a;
            let values = first.iter().zip(&second).map(|state| self.gain[j] * motor(state));
            return vec![ColumnPart { joint: j, values: values.collect() }];
        }
        let mut column = self.displacement_column(j, [twist, &first, &second]);
        column.iter_mut().flat_map(|part| &mut part.values).for_each(|v| *v = -*v);
        column
    }

    /// Change of the efforts by the trial spring of joint `j`, per unit of its compliance; `None` where none is set.
    pub(crate) fn trial_spring_column(&self, j: usize) -> Option<EffectColumn> {
        let spring = self.trial_springs[j].filter(|_| self.drives[j].elasticity.is_none())?;
        let mut robot = self.robot.clone();
        spring.set(&mut robot.link_mut(j)?.actuator);
        let motor = [&self.q, &self.qd, &self.qdd].map(Clone::clone);
        let seen = |i: usize| (i != j).then(|| self.link.each_ref().map(|x| x[i].clone()));
        let links = (0..self.q.len()).map(seen).collect();
        let load = loads(&robot, &Deflection::new(&robot, motor, links, self.period_s).link);
        let part = |(i, (with, without)): (usize, (&Vec<f64>, &Vec<f64>))| {
            let changes = with.iter().zip(without).map(|(with, without)| with - without);
            self.load_part(i, changes.map(|change| spring.stiffness * change))
        };
        Some(load.iter().zip(&self.load).enumerate().map(part).collect())
    }

    /// Change of the efforts by links that swing on their springs, or on trial springs, from where a run begins: no encoder
    /// shows twist and speed of the twist there, and a swing of little damping lasts for seconds.
    pub fn swings(&self) -> Vec<EffectColumn> {
        let of_joint = |j: usize| {
            let trial = self.trial_springs[j].filter(|_| self.drives[j].elasticity.is_none());
            let spring = trial.map(TrialSpring::spring);
            let compliance =
                |spring| Compliance::new(spring, &self.slopes(j)[j], self.period_s).swings();
            let own = self.compliances[j].as_ref();
            own.and_then(Compliance::swings).or_else(|| spring.and_then(compliance))
        };
        let column = |(j, twist): (usize, Vec<f64>)| {
            let (first, second) = (rate(&twist, self.period_s), curvature(&twist, self.period_s));
            self.displacement_column(j, [&twist, &first, &second])
        };
        let all = (0..self.q.len()).filter_map(|j| Some((j, of_joint(j)?)));
        all.flat_map(|(j, twists)| twists.map(|twist| (j, twist))).map(column).collect()
    }

    /// Column of a twist under the load of joint `j` by a trial spring of unknown damping, per unit of its `compliance`:
    /// the effort of the joint itself.
    pub fn trial_compliance_part(&self, j: usize, compliance: f64) -> ColumnPart {
        let spring = Spring { compliance, damping_s: None };
        let slopes = &self.slopes(j)[j];
        let twist = Compliance::new(spring, slopes, self.period_s).twist_under(self.rigid_load(j));
        let (first, second) = (rate(&twist, self.period_s), curvature(&twist, self.period_s));
        let [dq, dqd, dqdd] = slopes;
        let load = |t: usize| -(dq[t] * twist[t] + dqd[t] * first[t] + dqdd[t] * second[t]);
        self.load_part(j, (0..twist.len()).map(load))
    }

    /// Derivative of the load of joint `j` by the acceleration of its link (kg m² or kg), in the mean.
    pub fn mean_inertia(&self, j: usize) -> f64 {
        let inertia = &self.slopes(j)[j][2];
        inertia.iter().sum::<f64>() / inertia.len().max(1) as f64
    }

    /// Whether the twist of joint `j` is followed forward in time, as that of a spring of known damping.
    pub(crate) fn is_forward(&self, j: usize) -> bool {
        self.compliances[j].as_ref().is_some_and(Compliance::is_forward)
    }

    /// Load of joint `j` at rest where the run begins (N·m or N).
    pub(crate) fn load_at_rest(&self, j: usize) -> f64 {
        loads_at_rest(&self.robot, &self.link)[j].unwrap_or(0.0)
    }

    /// Change of the effort of every joint by a displacement `s` of the link of joint `j`, with rates `sd`, `sdd`.
    ///
    /// ```text
    /// d load / dq s + d load / dqd sd + d load / dqdd sdd
    /// ```
    pub(crate) fn displacement_column(&self, j: usize, [s, sd, sdd]: [&[f64]; 3]) -> EffectColumn {
        let dragged = Loop::of(&self.drives[j], &self.link[0][j]).map(|h| h.change_under(s));
        let part = |i: usize| {
            let [dq, dqd, dqdd] = &self.slopes(j)[i];
            let own = dragged.as_ref().filter(|_| i == j);
            let load = |t: usize| {
                dq[t] * s[t] + dqd[t] * sd[t] + dqdd[t] * sdd[t] + own.map_or(0.0, |h| h[t])
            };
            self.load_part(i, (0..s.len()).map(load))
        };
        (0..self.q.len()).map(part).collect()
    }
}
