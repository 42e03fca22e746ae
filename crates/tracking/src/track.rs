use motion::{Motion, State};
use robot::{Machine, MachineFault, Reading};

use crate::controller::{Controller, Feedback};
use crate::error::{TrackingError, period, same_joints};
use crate::feedforward::Feedforward;
use crate::pace::Pace;
use crate::predictor::{Delivery, Predictor, VirtualPredictor, tick_from};
use crate::rows::TrackingRows;
use crate::settings::{RunClock, TrackingSettings};
use crate::timing::Timing;
use crate::tracking::{End, Tracking};
use crate::trust::Trust;
use crate::wall::on_the_wall;
use crate::watch::{ControlTick, Event, Level, TrackingWatch};

/// Tracks `motion` with `machine` from its beginning to its end.
///
/// ```text
/// u(t_k) = limit(u_FF(t_k) + kp error + kd error_rate),   t_k = k T
/// ```
///
/// with `u_FF` the newest prediction of `feedforward`, which is asked for the first tick before the
/// run, so that the arm does not begin without it. The time of a run is counted in ticks: the
/// motion waits for a late tick, so that the reference never jumps. The machine should rest where
/// the motion begins; nothing is commanded after the last tick.
///
/// # Errors
///
/// [`TrackingError`] when the parts are for different numbers of joints, or a gain, a period
/// or a setting cannot be used. What goes wrong in a run is in its [`Tracking::events`] and
/// [`Tracking::end`].
pub fn track(
    machine: &mut dyn Machine,
    motion: &Motion,
    controller: &Controller,
    feedforward: &mut dyn Feedforward,
    settings: &TrackingSettings,
    watch: &mut dyn TrackingWatch,
) -> Result<Tracking, TrackingError> {
    let (joints, period_s) = (machine.joint_count(), machine.period_s());
    period(period_s)?;
    same_joints("the motion", motion.joint_count(), joints)?;
    same_joints("the feedforward", feedforward.joints(), joints)?;
    controller.check(joints)?;
    settings.check()?;

    let words = feedforward.words();
    let ticks = tick_from(motion.duration_s(), period_s);
    let mut run = Run {
        machine,
        motion,
        watch,
        controller,
        period_s,
        reference: State::default(),
        reading: Reading::zero(joints),
        link_positions: Vec::new(),
        feedback: Feedback::new(controller, period_s),
        torques: Torques::zero(joints),
        trust: Trust::new(settings, period_s, joints),
        delivery: Delivery::new(joints),
        rows: TrackingRows::new(joints, ticks),
        events: Vec::new(),
        updates_missed: 0,
    };
    let (end, wall) = match settings.clock {
        RunClock::Virtual(clock) => {
            let mut predictor = VirtualPredictor::new(feedforward, motion, clock, period_s);
            (run.whole(ticks, &mut predictor, &mut Pace::Free), None)
        }
        RunClock::Wall(clock) => {
            let go =
                |predictor: &mut dyn Predictor, pace: &mut Pace| run.whole(ticks, predictor, pace);
            let (end, timing) = on_the_wall(feedforward, motion, clock, period_s, go);
            (end, Some(timing))
        }
    };
    let Run { rows, events, updates_missed, .. } = run;
    let timing = Timing { updates_missed, wall };
    Ok(Tracking { period_s, feedforward: words, rows, events, timing, end })
}

/// The state of a run.
struct Run<'a> {
    machine: &'a mut dyn Machine,
    motion: &'a Motion,
    watch: &'a mut dyn TrackingWatch,
    controller: &'a Controller,
    period_s: f64,
    reference: State,
    reading: Reading,
    /// Empty where the machine does not know them.
    link_positions: Vec<f64>,
    feedback: Feedback<'a>,
    torques: Torques,
    trust: Trust,
    delivery: Delivery,
    rows: TrackingRows,
    events: Vec<Event>,
    updates_missed: usize,
}

/// Torques of one tick (N m or N).
struct Torques {
    feedback: Vec<f64>,
    command: Vec<f64>,
    limited: Vec<bool>,
}

impl Torques {
    fn zero(joints: usize) -> Self {
        let zeros = vec![0.0; joints];
        Self { feedback: zeros.clone(), command: zeros, limited: vec![false; joints] }
    }
}

impl Run<'_> {
    fn whole(&mut self, ticks: usize, predictor: &mut dyn Predictor, pace: &mut Pace) -> End {
        let first = predictor.first(&mut self.delivery);
        let event = self.trust.begin(first.then_some(&mut self.delivery));
        self.tell(event);
        for tick in 0..ticks {
            pace.wait();
            if let Err(end) = self.tick(tick, predictor) {
                if let End::Fault(fault) = &end {
                    let words = fault.to_string();
                    let time_s = tick as f64 * self.period_s;
                    self.tell(Some(Event { time_s, level: Level::Error, words }));
                }
                return end;
            }
        }
        End::Complete
    }

    /// One turn of the loop: its end where the run ends.
    fn tick(&mut self, tick: usize, predictor: &mut dyn Predictor) -> Result<(), End> {
        let time_s = tick as f64 * self.period_s;
        self.motion.sample(time_s, &mut self.reference);
        self.read(time_s).map_err(End::Fault)?;

        // The newest prediction, if it is to be trusted.
        let newer = predictor.newest(tick, &mut self.delivery);
        self.updates_missed += usize::from(!newer);
        let event = self.trust.tick(time_s, newer.then_some(&mut self.delivery));
        self.tell(event);

        // u = limit(u_FF + kp error + kd error_rate)
        let Torques { feedback, command, limited } = &mut self.torques;
        let lead = self.trust.feedforward();
        self.feedback.fill(&self.reference, lead, &self.reading, feedback);
        for (command, (ahead, back)) in command.iter_mut().zip(lead.tau.iter().zip(&*feedback)) {
            *command = ahead + back;
        }
        self.controller.limits.apply(command, limited);
        if let Some(joint) = command.iter().position(|tau| !tau.is_finite()) {
            return Err(End::Fault(not_finite(time_s, joint, &self.reading)));
        }

        let acted = self.machine.actuate(command);
        let tick = ControlTick {
            time_s,
            reference: &self.reference,
            reading: &self.reading,
            link_positions: Some(&*self.link_positions).filter(|links| !links.is_empty()),
            feedforward: lead,
            feedback,
            command,
            limited,
            age_s: self.trust.age_s(time_s),
        };
        self.rows.push(&tick);
        let goes_on = self.watch.tick(&tick);
        acted.map_err(End::Fault)?;
        if goes_on.is_break() { Err(End::Stopped) } else { Ok(()) }
    }

    fn read(&mut self, time_s: f64) -> Result<(), MachineFault> {
        self.machine.read(&mut self.reading)?;
        let joints = self.reference.q.len();
        let Reading { q, qd, effort, .. } = &self.reading;
        if [q, qd, effort].iter().any(|signal| signal.len() != joints) {
            let lengths = [q.len(), qd.len(), effort.len()];
            return Err(MachineFault {
                time_s,
                joint: "of all".to_owned(),
                found: format!("a reading of {lengths:?} joints instead of {joints}"),
                advice: "the machine's driver has to report every joint".to_owned(),
            });
        }
        self.link_positions.clear();
        let known = self.machine.link_positions().filter(|links| links.len() == joints);
        self.link_positions.extend(known.unwrap_or_default());
        Ok(())
    }

    fn tell(&mut self, event: Option<Event>) {
        if let Some(event) = event {
            self.watch.event(&event);
            self.events.push(event);
        }
    }
}

/// The fault of a command that is not finite. Predictions are checked, so the reading is at fault.
fn not_finite(time_s: f64, joint: usize, reading: &Reading) -> MachineFault {
    let (q, qd) = (reading.q[joint], reading.qd[joint]);
    MachineFault {
        time_s,
        joint: format!("{joint} (counted from 0)"),
        found: format!("no torque follows from position {q} and velocity {qd}"),
        advice: "the machine's driver has to report finite numbers".to_owned(),
    }
}

#[cfg(test)]
mod tests {
    use std::ops::ControlFlow;

    use super::*;
    use crate::controller::ErrorRate;
    use crate::feedforward::NoFeedforward;
    use crate::model_feedforward::{GravityFeedforward, ModelFeedforward};
    use crate::rows::Signal;
    use crate::settings::{Ahead, VirtualClock};
    use crate::testing::{
        GRAVITY, MASS, Of, PERIOD_S, ROD_M, TestPlant, controller, model_of, pendulum, rest,
        slider, swing,
    };
    use crate::torque_limits::TorqueLimits;

    const LEAD_S: f64 = 0.5 * PERIOD_S;

    fn settings(clock: VirtualClock) -> TrackingSettings {
        TrackingSettings { clock: RunClock::Virtual(clock), ..TrackingSettings::default() }
    }

    fn run(
        mut machine: TestPlant,
        motion: &Motion,
        controller: &Controller,
        feedforward: &mut dyn Feedforward,
        clock: VirtualClock,
    ) -> Tracking {
        let settings = settings(clock);
        track(&mut machine, motion, controller, feedforward, &settings, &mut ()).unwrap()
    }

    fn errors(tracking: &Tracking) -> Vec<f64> {
        let rows = &tracking.rows;
        let (q_ref, q) = (rows.column(Signal::QRef, 0), rows.column(Signal::Q, 0));
        q_ref.zip(q).map(|(q_ref, q)| q_ref - q).collect()
    }

    fn largest(values: &[f64]) -> f64 {
        values.iter().fold(0.0, |most: f64, v| most.max(v.abs()))
    }

    /// Every number of a run, so that NaN equals NaN.
    fn bits(tracking: &Tracking) -> Vec<u64> {
        let rows = &tracking.rows;
        let joint = [Signal::Q, Signal::Feedforward, Signal::Feedback, Signal::Command];
        joint
            .iter()
            .flat_map(|s| rows.column(*s, 0))
            .chain(rows.time_s())
            .map(f64::to_bits)
            .collect()
    }

    #[test]
    fn a_perfect_model_tracks_to_the_error_of_a_held_command() {
        let (robot, model) = (pendulum(), model_of(&pendulum()));
        let motion = swing(&robot, 6.0);
        let mut feedforward = ModelFeedforward::new(&model, LEAD_S);
        let low = controller(2.0, 0.3);
        let clock = VirtualClock::default();
        let tracking = run(TestPlant::pendulum(&motion), &motion, &low, &mut feedforward, clock);
        assert_eq!((tracking.end.clone(), tracking.rows.len()), (End::Complete, 3000));
        assert!(tracking.events.is_empty() && tracking.timing.updates_missed == 0);
        let most = largest(&errors(&tracking));
        assert!(most < 2e-6, "{most} rad");
    }

    #[test]
    fn a_held_command_lags_half_a_period_unless_the_feedforward_leads_by_it() {
        let (robot, model) = (slider(), model_of(&slider()));
        let motion = swing(&robot, 4.0);
        let open = controller(0.0, 0.0);
        let of = |lead_s| {
            let mut feedforward = ModelFeedforward::new(&model, lead_s);
            let clock = VirtualClock::default();
            run(TestPlant::slider(&motion), &motion, &open, &mut feedforward, clock)
        };
        let (held, leads) = (of(0.0), of(LEAD_S));
        let speeds = held.rows.column(Signal::QdRef, 0);
        for (error, qd) in errors(&held).into_iter().zip(speeds) {
            assert!((error - LEAD_S * qd).abs() < 2e-5, "{error} m at {qd} m/s");
        }
        assert!(largest(&errors(&held)) > 50.0 * largest(&errors(&leads)));
    }

    #[test]
    fn feedback_alone_is_left_with_the_load_over_its_gain() {
        let (robot, model) = (pendulum(), model_of(&pendulum()));
        let motion = rest(&robot, 0.4, 8.0);
        let clock = VirtualClock::default();
        let pd = controller(100.0, 10.0);
        let none = &mut NoFeedforward { joints: 1 };
        let alone = run(TestPlant::pendulum(&motion), &motion, &pd, none, clock);
        let last = alone.rows.len() - 1;
        let q = alone.rows.row(last, Signal::Q)[0];
        let expected = MASS * GRAVITY * ROD_M * q.sin() / 100.0;
        assert!((errors(&alone)[last] - expected).abs() < 1e-9, "{expected}");
        // With the load known nothing is left.
        let mut gravity = GravityFeedforward::new(&model, LEAD_S);
        let helped = run(TestPlant::pendulum(&motion), &motion, &pd, &mut gravity, clock);
        assert!(largest(&errors(&helped)) < 1e-12);
    }

    #[test]
    fn gravity_alone_is_the_model_at_rest() {
        // Friction and inertia of the rotor would show what is not rest.
        let mut robot = pendulum();
        let actuator = &mut robot.link_mut(0).unwrap().actuator;
        (actuator.viscous, actuator.rotor_inertia) = (3.0, 0.5);
        let model = model_of(&robot);
        let motion = swing(&robot, 3.0);
        let mut gravity = GravityFeedforward::new(&model, 0.1);
        let mut prediction = crate::feedforward::TorquePrediction::zero(1);
        gravity.predict(&motion, 1.3, &mut prediction);
        let expected = MASS * GRAVITY * ROD_M * motion.at(1.4).q[0].sin();
        assert!((prediction.tau[0] - expected).abs() < 1e-12, "{prediction:?}");
    }

    #[test]
    fn a_slow_predictor_is_one_whose_reference_is_shifted_by_hand() {
        const N: usize = 7;
        let motion = swing(&slider(), 2.0);
        let pd = controller(50.0, 10.0);
        let torque = |time_s: f64| MASS * (5.0 * time_s).sin();
        let slow = VirtualClock { prediction_time_s: 0.0135, ..VirtualClock::default() };
        let slow = run(TestPlant::slider(&motion), &motion, &pd, &mut Of(torque), slow);
        let by_hand = |time_s: f64| {
            let tick = (time_s / PERIOD_S).round() as usize;
            torque((tick / N * N).saturating_sub(N) as f64 * PERIOD_S)
        };
        let at_once = VirtualClock::default();
        let at_once = run(TestPlant::slider(&motion), &motion, &pd, &mut Of(by_hand), at_once);
        assert_eq!(bits(&slow), bits(&at_once));
        assert_eq!(slow.timing.updates_missed, 1000 - 1000 / N);
        let ages: Vec<f64> = slow.rows.age_s().map(|age| (age / PERIOD_S).round()).collect();
        assert_eq!(ages[..9], [0.0, 1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0, 8.0]);
        assert_eq!(ages[13..16], [13.0, 7.0, 8.0]);
    }

    #[test]
    fn a_prediction_for_its_arrival_is_of_the_middle_of_its_use() {
        let motion = swing(&slider(), 2.0);
        for (ticks, time_s) in [(1, 0.0), (1, 0.002), (5, 0.0095)] {
            let clock =
                VirtualClock { prediction_time_s: time_s, ahead: Ahead::Arrival, stops_at_s: None };
            let feedforward = &mut Of(|time_s| time_s);
            let tracking = run(
                TestPlant::slider(&motion),
                &motion,
                &controller(50.0, 10.0),
                feedforward,
                clock,
            );
            let rows = &tracking.rows;
            let behind =
                rows.time_s().zip(rows.column(Signal::Feedforward, 0)).map(|(t, of)| t - of);
            let behind: Vec<f64> = behind.collect();
            for held in behind.chunks_exact(ticks) {
                let mean = held.iter().sum::<f64>() / ticks as f64;
                assert!(mean.abs() < 1e-12, "{held:?}");
                assert!((held[ticks - 1] - held[0] - (ticks - 1) as f64 * PERIOD_S).abs() < 1e-12);
            }
        }
    }

    #[test]
    fn a_run_is_the_same_to_the_last_bit() {
        let (robot, model) = (pendulum(), model_of(&pendulum()));
        let motion = swing(&robot, 3.0);
        let of = || {
            let clock = VirtualClock {
                prediction_time_s: 0.007,
                ahead: Ahead::Arrival,
                stops_at_s: Some(2.0),
            };
            let mut feedforward = ModelFeedforward::new(&model, LEAD_S);
            run(
                TestPlant::pendulum(&motion),
                &motion,
                &controller(5.0, 0.5),
                &mut feedforward,
                clock,
            )
        };
        let (first, second) = (of(), of());
        assert_eq!(bits(&first), bits(&second));
        assert_eq!((first.events, first.timing), (second.events, second.timing));
    }

    #[test]
    fn a_predictor_that_dies_leaves_the_arm_on_feedback() {
        let motion = swing(&slider(), 3.0);
        let pd = controller(200.0, 30.0);
        let told = VirtualClock { stops_at_s: Some(1.0), ..VirtualClock::default() };
        let panics = |time_s: f64| {
            assert!(time_s < 1.0, "out of memory");
            3.0
        };
        let told = run(TestPlant::slider(&motion), &motion, &pd, &mut Of(|_| 3.0), told);
        let by_itself = VirtualClock::default();
        let by_itself = run(TestPlant::slider(&motion), &motion, &pd, &mut Of(panics), by_itself);
        assert_eq!(bits(&told), bits(&by_itself));
        assert_eq!(told.end, End::Complete);
        assert!(by_itself.events[0].words.contains("out of memory"), "{:?}", by_itself.events);
        for (t, tau) in told.rows.time_s().zip(told.rows.column(Signal::Feedforward, 0)) {
            let expected = 3.0 * (1.0 - (t - 1.0) / 0.5).clamp(0.0, 1.0);
            assert!((tau - expected).abs() < 1e-9, "{tau} at {t} s");
        }
        let feedback: Vec<f64> = told.rows.column(Signal::Feedback, 0).collect();
        assert!(feedback[1400..].iter().any(|tau| tau.abs() > 0.1));
    }

    #[test]
    fn a_model_that_gives_no_number_never_reaches_the_arm() {
        let motion = swing(&slider(), 3.0);
        let pd = controller(200.0, 30.0);
        let broken = |time_s: f64| if (1.0..1.5).contains(&time_s) { f64::NAN } else { 3.0 };
        let clock = VirtualClock::default();
        let tracking = run(TestPlant::slider(&motion), &motion, &pd, &mut Of(broken), clock);
        let levels: Vec<Level> = tracking.events.iter().map(|event| event.level).collect();
        assert_eq!(
            (tracking.end.clone(), levels),
            (End::Complete, vec![Level::Warning, Level::Info])
        );
        assert!(tracking.rows.column(Signal::Command, 0).all(f64::is_finite));
        // From the beginning: never any feedforward.
        let tracking = run(TestPlant::slider(&motion), &motion, &pd, &mut Of(|_| f64::NAN), clock);
        assert!(tracking.rows.column(Signal::Feedforward, 0).all(|tau| tau == 0.0));
        assert!(tracking.rows.age_s().all(f64::is_nan));
        assert_eq!((tracking.end, tracking.events.len()), (End::Complete, 1));
    }

    #[test]
    fn a_reading_that_is_no_number_ends_the_run_before_it_is_answered() {
        let motion = swing(&slider(), 3.0);
        let lost = TestPlant::new(|q, tau| if q > 0.35 { f64::NAN } else { tau / MASS }, &motion);
        let clock = VirtualClock::default();
        let model = model_of(&slider());
        let mut feedforward = ModelFeedforward::new(&model, LEAD_S);
        let tracking = run(lost, &motion, &controller(5.0, 1.0), &mut feedforward, clock);
        let End::Fault(fault) = &tracking.end else { panic!("{:?}", tracking.end) };
        assert!(fault.found.contains("position NaN"), "{fault}");
        assert_eq!(tracking.events.last().map(|event| event.level), Some(Level::Error));
        assert!(tracking.rows.column(Signal::Command, 0).all(f64::is_finite));
    }

    /// Stops in its fifty-first tick, or forgets a joint in it.
    struct Faulty(TestPlant, usize, Lapse);

    #[derive(PartialEq)]
    enum Lapse {
        Stops,
        Forgets,
    }

    impl Machine for Faulty {
        fn joint_count(&self) -> usize {
            self.0.joint_count()
        }

        fn period_s(&self) -> f64 {
            self.0.period_s()
        }

        fn read(&mut self, reading: &mut Reading) -> Result<(), MachineFault> {
            self.0.read(reading)?;
            self.1 += 1;
            if self.1 == 51 && self.2 == Lapse::Forgets {
                reading.qd.clear();
            }
            Ok(())
        }

        fn actuate(&mut self, effort: &[f64]) -> Result<(), MachineFault> {
            let (joint, found) = ("x".to_owned(), "a bang".to_owned());
            let fault = MachineFault { time_s: 0.1, joint, found, advice: "look".to_owned() };
            if self.1 == 51 { Err(fault) } else { self.0.actuate(effort) }
        }
    }

    #[test]
    fn a_machine_that_stops_ends_the_run_and_its_last_tick_is_kept() {
        let motion = swing(&slider(), 3.0);
        let of = |lapse| {
            let mut machine = Faulty(TestPlant::slider(&motion), 0, lapse);
            let (pd, usual) = (controller(9.0, 1.0), TrackingSettings::default());
            track(&mut machine, &motion, &pd, &mut Of(f64::sin), &usual, &mut ()).unwrap()
        };
        let (stopped, forgot) = (of(Lapse::Stops), of(Lapse::Forgets));
        assert_eq!((stopped.rows.len(), forgot.rows.len()), (51, 50));
        assert!(matches!(&stopped.end, End::Fault(fault) if fault.found == "a bang"));
        assert!(stopped.events[0].words.contains("a bang"), "{:?}", stopped.events);
        let End::Fault(fault) = forgot.end else { panic!("{:?}", forgot.end) };
        assert!(fault.found.contains("[1, 0, 1] joints instead of 1"), "{fault}");
    }

    /// Ends a run with its hundredth tick.
    #[derive(Default)]
    struct Impatient(usize, Vec<Event>);

    impl TrackingWatch for Impatient {
        fn tick(&mut self, tick: &ControlTick) -> ControlFlow<()> {
            self.0 += 1;
            let parts = tick.feedforward.tau[0] + tick.feedback[0];
            assert!((tick.command[0] - parts).abs() < 1e-15);
            if self.0 == 100 { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
        }

        fn event(&mut self, event: &Event) {
            self.1.push(event.clone());
        }
    }

    #[test]
    fn the_watch_sees_every_tick_and_event_and_ends_the_run() {
        let motion = swing(&slider(), 3.0);
        let mut machine = TestPlant::slider(&motion);
        let mut watch = Impatient::default();
        let settings = settings(VirtualClock { stops_at_s: Some(0.1), ..VirtualClock::default() });
        let feedforward = &mut Of(f64::sin);
        let pd = controller(9.0, 1.0);
        let tracking =
            track(&mut machine, &motion, &pd, feedforward, &settings, &mut watch).unwrap();
        assert_eq!((tracking.end, tracking.rows.len(), watch.0), (End::Stopped, 100, 100));
        assert_eq!((tracking.events.len(), tracking.events), (1, watch.1));
    }

    #[test]
    fn a_command_stays_within_the_limits_and_says_where() {
        let motion = swing(&slider(), 3.0);
        let limits = TorqueLimits::new(vec![2.0], vec![]).unwrap();
        let limited =
            Controller { limits, error_rate: ErrorRate::Reading, ..controller(50.0, 5.0) };
        let feedforward = &mut Of(|time_s: f64| 5.0 * (3.0 * time_s).sin());
        let clock = VirtualClock::default();
        let rows = run(TestPlant::slider(&motion), &motion, &limited, feedforward, clock).rows;
        let mut cut = 0;
        for tick in 0..rows.len() {
            let of = |signal| rows.row(tick, signal)[0];
            let asked = of(Signal::Feedforward) + of(Signal::Feedback);
            assert!((of(Signal::Command) - asked.clamp(-2.0, 2.0)).abs() < 1e-15);
            assert_eq!(of(Signal::Limited) > 0.0, asked.abs() > 2.0);
            cut += usize::from(asked.abs() > 2.0);
        }
        assert!(cut > 100, "{cut}");
    }

    #[test]
    fn a_tick_allocates_nothing() {
        let model = model_of(&pendulum());
        let taken = |duration_s| {
            let motion = swing(&pendulum(), duration_s);
            let mut machine = TestPlant::pendulum(&motion);
            machine.link = Some([0.0]);
            let mut feedforward = ModelFeedforward::new(&model, LEAD_S);
            let (pd, usual) = (controller(5.0, 0.5), TrackingSettings::default());
            let go = || {
                track(&mut machine, &motion, &pd, &mut feedforward, &usual, &mut ()).unwrap();
            };
            allocation_counter::measure(go).count_total
        };
        assert_eq!(taken(3.0), taken(30.0));
        assert!(taken(3.0) > 0);
    }

    #[test]
    fn parts_that_do_not_fit_are_refused() {
        let motion = swing(&slider(), 3.0);
        let of = |controller: &Controller, joints, settings: &TrackingSettings| {
            let machine = &mut TestPlant::slider(&motion);
            track(machine, &motion, controller, &mut NoFeedforward { joints }, settings, &mut ())
                .unwrap_err()
                .to_string()
        };
        let (pd, usual) = (controller(1.0, 1.0), TrackingSettings::default());
        assert_eq!(of(&pd, 2, &usual), "the feedforward is for 2 joints, 1 were expected");
        let limits = Controller { limits: TorqueLimits::none(3), ..pd.clone() };
        assert!(of(&limits, 1, &usual).contains("torque limits is for 3 joints"));
        let never = TrackingSettings { fade_s: f64::NAN, ..usual };
        assert!(of(&pd, 1, &never).contains("the time of a fade (s) is NaN"));
        let still = TrackingSettings { stall_s: f64::INFINITY, ..usual };
        assert!(of(&pd, 1, &still).contains("the time to a stall (s) is inf"));
        let slow = settings(VirtualClock { prediction_time_s: -1.0, ..VirtualClock::default() });
        assert!(of(&pd, 1, &slow).contains("the time of a prediction (s) is -1"));
    }
}
