use std::f64::consts::PI;

/// The numbers that decide whether logs have an error, with their units and reasons.
#[derive(Debug, Clone, PartialEq)]
pub struct InspectionThresholds {
    /// Torque constants that an error of a drive may make, least and largest (1): a factor 3 either way. A diagnosis finds
    /// those within as a cause.
    pub drive_gain: [f64; 2],
    /// Least share of the effort that the log as it stands must leave at the joint that a reading improves most (power, 1):
    /// models that err by some per cent leave a twentieth, friction and rotors are taken off before. The second is for
    /// readings of the second gain.
    pub misfit: [f64; 2],
    /// Largest share that a reading may leave at the joint that it improves most (power, 1).
    pub mended: f64,
    /// Share below which a residual is model error (power, 1): no reading is preferred for less.
    pub floor: f64,
    /// Error of a model as a share of the whole effort of a joint (RMS, 1): some per cent in mass, some mm in centre of mass.
    pub model_error: f64,
    /// Least logarithm of the factor by which a reading reduces the residual, summed over joints (nats), and the one from
    /// which on the smaller misfit is enough.
    pub gain: [f64; 2],
    /// The same for a turned sign where the nominal torque leaves more than all of the effort of the joint that is improved
    /// most (nats): it is contradicted then, and more than inexact.
    pub contradicted_gain: f64,
    /// Least difference of that logarithm by which one reading is preferred to another one (nats).
    pub margin: f64,
    /// Least angle between the gravity of the efforts and of the description (rad): bases that stand on a floor
    /// are tilted by less.
    pub gravity_angle: f64,
    /// Least factor between the sizes of gravity (1).
    pub gravity_factor: f64,
    /// Largest part of the nominal torque of gravity in efforts that lack it (1).
    pub held_gravity: f64,
    /// Fewest joints that tell by themselves that efforts lack gravity: a counterbalance takes it from one.
    pub joints_without_gravity: usize,
    /// Rows that one independent sample stands for, in tests of single joints (1): rows follow one another closely, and what a
    /// model lacks changes slowly.
    pub rows_of_independent: f64,
    /// Least range of a joint that moves (rad, and m at a sliding joint).
    pub moves: [f64; 2],
    /// Difference between factors of all joints, as a share, up to which they have one reason (1).
    pub alike: f64,
    /// Least relative difference between a velocity column and the derivative of the position (1).
    pub velocity_factor: f64,
    /// Least factor by which time is off, as efforts alone show it (1): unknown rotors do less.
    pub time_factor: f64,
    /// Rate below which no logger of an arm works (Hz).
    pub slowest_hz: f64,
    /// Least share of samples at the limit of the effort (1).
    pub at_limit: f64,
    /// Least time that two overlapping runs share (s).
    pub shared_s: f64,
    /// Fewest rows that two overlapping runs share: at a low rate `shared_s` is a few rows, which may be alike by chance.
    pub shared_rows: usize,
    /// Torque constants of a drive that is nearly right, least and largest (1): for tests in which a free constant could
    /// take away the error that is looked for.
    pub exact_gain: [f64; 2],
    /// Torque constants that are tried beside another unit of the efforts (1): between a unit and a constant the
    /// constant is the smaller change.
    pub unit_gain: [f64; 2],
    /// Least number of rows by which logs can be judged.
    pub least_rows: usize,
    /// Share of the largest speed of a joint from which on it moves (1): at rest dry friction holds any effort.
    pub moving_speed: f64,
    /// Rows of a joint's own motion that are enough to judge it by.
    pub enough_rows: usize,
    /// A step of time longer than so many usual ones ends a piece (1): more is not interpolated.
    pub longest_step: f64,
    /// Difference of steps of time from the usual one, as a share of it, up to which a clock is even (1).
    pub even_step: f64,
    /// Shortest piece that is looked at, in times over which the low-pass settles: it settles at both ends.
    pub shortest_piece: usize,
    /// Spans of the longest second difference that the longest piece holds (1): a slower motion has too few periods.
    pub spans_of_piece: f64,
    /// Ratio of second differences over two spans, one twice the other, from which on a signal is smooth at the shorter
    /// (1): 4 for a parabola, `4 cos²(w s / 2)` for a sine, about 1 for noise.
    pub smooth: f64,
    /// Second difference over that of neighbouring samples, which is all that noise can have, from which on motion
    /// prevails (1).
    pub above_noise: f64,
    /// Factors between which a velocity column is off by less than a third (1): a filter of the logger may do so much.
    pub close_velocity: [f64; 2],
    /// Correlation of a velocity column with the derivative of the position from which on it can be compared (1).
    pub velocity_correlation: f64,
    /// The same where the column is off by less than a third (1).
    pub close_velocity_correlation: f64,
    /// Rows of a joint in a run from which its velocity is compared with the derivative of its position.
    pub rows_of_clock: usize,
    /// Factors of the velocity columns of all joints that are the same, to this share (1).
    pub same_velocity_factor: f64,
    /// Rate of the slowest usual logger (Hz).
    pub least_rate_hz: f64,
    /// Factor by which a unit of time may be off the power of ten that it is (1): velocities show it to some per mille.
    pub time_unit: f64,
    /// Angle up to which gravity has the direction of the description (rad).
    pub aligned_gravity: f64,
    /// Least and largest gravity of a place where arms work (m/s²): that of the moon, and twice that of the earth.
    pub gravity_sizes: [f64; 2],
    /// Least share of the effort of a joint that counts as its deviation in a fit over all joints (1).
    pub pooled_share: f64,
    /// Largest mass of a tool over that of the arm that carries it (1).
    pub heaviest_tool: f64,
    /// Farthest that a tool's centre of mass lies from the origin of the last link (m).
    pub farthest_tool_m: f64,
    /// Largest step between the positions of a locked joint that are tried (rad).
    pub lock_step: f64,
    /// Step at which the search for the position of a locked joint ends (rad).
    pub lock_precision: f64,
    /// Gain that a locked joint must make, beside the others; with less it counts as standing where it is described.
    pub idle_lock: f64,
    /// Most locked joints that are tried in pairs.
    pub paired_locks: usize,
    /// Most errors that are reported of one set of logs.
    pub most_readings: usize,
    /// Number of rivals from which on none of them is reported.
    pub most_rivals: usize,
    /// Range of a rotation from which on its position may be in degrees (rad).
    pub degrees_range: f64,
    /// Cosine of the angle between two axes from which on they are parallel (1).
    pub parallel: f64,
    /// Factor by which the residual of a joint falls that confirms a reading (1).
    pub confirms: f64,
    /// A reading of the whole arm is confirmed by one joint in so many: the others may carry too little to show it.
    pub joints_of_confirming: usize,
    /// Joints that are enough to confirm a reading of the whole arm.
    pub most_confirming: usize,
    /// Factor by which friction alone leaves more than with the nominal torque, where a joint shows its unit (1).
    pub shows_unit: f64,
    /// Share left from which on a nominal torque is contradicted (1).
    pub contradicted: f64,
    /// Factor by which a drive alone leaves less where the nominal torque is contradicted (1).
    pub contradicted_by: f64,
    /// Part of the residual of a drive alone that is left where a joint agrees with its nominal torque (1).
    pub agrees: f64,
    /// Fewest joints that contradict the description of the robot.
    pub fewest_contradicted: usize,
    /// Joints that must contradict the description for each one that agrees with it: an arm of another type agrees at
    /// a quarter of its joints at most.
    pub against_agreeing: usize,
    /// Factor by which a share must exceed that of model errors to count (1): twice their size, as power.
    pub above_floor: f64,
    /// Longest shift of the efforts against the motion that is looked for (s).
    pub longest_shift_s: f64,
    /// Such shifts that the shortest piece of a run holds: what a shift moves out of a piece is not compared.
    pub piece_of_shifts: usize,
    /// Difference from its limit up to which an effort is at it, as a share of the limit (1).
    pub near_limit: f64,
    /// Efforts that exceed their limit by this factor are not clipped there (1).
    pub beyond_limit: f64,
    /// Samples at an extreme value that are exceeded both ways where the effort is clipped: a peak has one or two.
    pub clipped_rows: usize,
    /// Fewest values of an effort that is not coarsely quantised.
    pub fewest_values: usize,
    /// Share of the rows that two runs share that must differ from the row before (1): at rest all rows are alike.
    pub moving_rows: f64,
    /// Factor by which an offset for each run must reduce the residual of a joint against one for all (power, 1): models that
    /// err leave as much within a run.
    pub zeros_of_runs: f64,
    /// Share of the effort of a joint that counts as nothing beside the offsets of its runs (power, 1).
    pub zeros_floor: f64,
    /// Fewest rows in which a joint moves in a run whose zero is told.
    pub zero_rows: usize,
    /// Share of its range by which a joint must be beyond a limit to count as beyond it (1): ends of a range are kept about.
    pub beyond_range: f64,
    /// Share of the samples beyond a limit from which on positions in degrees may be none (1).
    pub rows_beyond_range: f64,
    /// Errors at some moments of a run.
    pub moments: MomentThresholds,
}

impl Default for InspectionThresholds {
    #[expect(clippy::too_many_lines, reason = "one line a field")]
    fn default() -> Self {
        Self {
            moments: MomentThresholds::default(),
            drive_gain: [1.0 / 3.0, 3.0],
            misfit: [0.3, 0.1],
            mended: 0.3,
            floor: 0.02,
            model_error: 0.07,
            gain: [1.8, 2.6],
            contradicted_gain: 1.1,
            margin: 0.7,
            gravity_angle: 0.7,
            gravity_factor: 1.6,
            held_gravity: 0.2,
            joints_without_gravity: 2,
            rows_of_independent: 20.0,
            moves: [0.02, 0.005],
            alike: 0.15,
            velocity_factor: 0.04,
            time_factor: 1.3,
            slowest_hz: 2.0,
            at_limit: 1.0 / 3.0,
            shared_s: 0.5,
            shared_rows: 50,
            exact_gain: [0.8, 1.25],
            unit_gain: [2.0 / 3.0, 1.5],
            least_rows: 40,
            moving_speed: 0.03,
            enough_rows: 30,
            longest_step: 5.5,
            even_step: 0.02,
            shortest_piece: 4,
            spans_of_piece: 24.0,
            smooth: 3.4,
            above_noise: 12.0,
            close_velocity: [0.75, 1.33],
            velocity_correlation: 0.95,
            close_velocity_correlation: 0.995,
            rows_of_clock: 12,
            same_velocity_factor: 0.02,
            least_rate_hz: 10.0,
            time_unit: 1.05,
            aligned_gravity: 0.3,
            gravity_sizes: [1.0, 20.0],
            pooled_share: 0.01,
            heaviest_tool: 1.0,
            farthest_tool_m: 1.0,
            lock_step: PI / 12.0,
            lock_precision: 1e-3,
            idle_lock: 0.1,
            paired_locks: 4,
            most_readings: 4,
            most_rivals: 6,
            degrees_range: 10.0,
            parallel: 0.999,
            confirms: 2.0,
            joints_of_confirming: 3,
            most_confirming: 2,
            shows_unit: 4.0,
            contradicted: 0.5,
            contradicted_by: 1.3,
            agrees: 0.6,
            fewest_contradicted: 3,
            against_agreeing: 3,
            above_floor: 4.0,
            longest_shift_s: 1.5,
            piece_of_shifts: 4,
            near_limit: 1e-3,
            beyond_limit: 1.05,
            clipped_rows: 2,
            fewest_values: 20,
            moving_rows: 0.5,
            zeros_of_runs: 16.0,
            zeros_floor: 1e-4,
            zero_rows: 10,
            beyond_range: 0.1,
            rows_beyond_range: 0.1,
        }
    }
}

/// When a signal counts as frozen, and a row as a spike or a jump.
#[derive(Debug, Clone, PartialEq)]
pub struct MomentThresholds {
    /// Least time for which all signals stand still (s).
    pub held_s: f64,
    /// Least time for which one position stands still (s): drives rest for less in the middle of a motion.
    pub stuck_s: f64,
    /// Fewest rows for which signals stand still, at any rate: a slow logger repeats a row or two.
    pub held_rows: usize,
    /// Rows over which the steps about a freeze are taken: one, and three for an encoder of coarse steps.
    pub step_rows: [usize; 2],
    /// Least way that a joint goes while its position stands still, as a share of its range (1): its velocity column may
    /// be noisy.
    pub hidden_way: f64,
    /// Share of its range over which another signal must move while a position stands still (1).
    pub goes_on: f64,
    /// Least step into a freeze over the largest change from one step to the next elsewhere, and least step out of it over
    /// the largest step elsewhere (1): arms brake over several samples, a freeze breaks motion off.
    pub freeze: [f64; 2],
    /// Steps of the encoder that a velocity must exceed while a position stands still (1).
    pub stuck_counts: f64,
    /// Rows about a freeze that are not compared with it.
    pub beside_freeze: usize,
    /// Least height of a spike over the largest usual second difference (1).
    pub spike: f64,
    /// A spike is no more than one row in so many: what is more frequent is noise.
    pub rare_spike: usize,
    /// Least height of frequent spikes over the noise of the position (1).
    pub spike_over_noise: f64,
    /// Second difference beside a frequent spike on its own side, as a share of it, up to which it returns (1).
    pub beside_spike: f64,
    /// Part of the rows that may be spikes or beside one: one in so many.
    pub bulk_of_rows: usize,
    /// Least height of a spike, in steps of the encoder (1).
    pub spike_counts: f64,
    /// Least height of a spike (rad or m): low-passes handle smaller ones.
    pub least_spike: f64,
    /// Neighbours of a row that are farther apart than so many usual steps of time have a gap between them (1).
    pub gap: f64,
    /// Difference from half a spike, as a share of it, up to which its neighbours are those of a single row (1).
    pub single: f64,
    /// Difference of a jump from full turns (rad).
    pub full_turn: f64,
    /// Step of time over the usual one up to which no row is missing between two (1): over a gap an arm may turn.
    pub next_row: f64,
    /// Share of a turn that no other step of a log with jumps reaches (1): a faster joint may have turned.
    pub fastest_turn: f64,
}

impl Default for MomentThresholds {
    fn default() -> Self {
        Self {
            held_s: 0.2,
            stuck_s: 1.0,
            held_rows: 10,
            step_rows: [1, 3],
            hidden_way: 0.2,
            goes_on: 0.2,
            freeze: [2.0, 6.0],
            stuck_counts: 20.0,
            beside_freeze: 8,
            spike: 8.0,
            rare_spike: 100,
            spike_over_noise: 10.0,
            beside_spike: 0.25,
            bulk_of_rows: 20,
            spike_counts: 5.0,
            least_spike: 2e-3,
            gap: 3.5,
            single: 0.4,
            full_turn: 0.5,
            next_row: 1.5,
            fastest_turn: 0.25,
        }
    }
}
