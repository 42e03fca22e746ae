/// From where on something is told, and why there.
#[derive(Debug, Clone, PartialEq)]
pub struct Thresholds {
    /// Torque constants that a drive's error may make, least and largest: a factor 3 either way. What lies
    /// within is a cause that a diagnosis finds.
    pub drive_gain: [f64; 2],
    /// Share of the effort of the joint mended most that the log as it stands must leave: models that err by some
    /// per cent leave a twentieth, friction and rotors are taken off before. The second is for readings of the
    /// second gain.
    pub misfit: [f64; 2],
    /// Share that a reading may leave at the joint that it mends most.
    pub mended: f64,
    /// Share that counts as nothing: what is left below it is model error, and no reading is better for it.
    pub floor: f64,
    /// Error of a model as a share of the whole effort of a joint: some per cent in mass, some mm in centre of
    /// mass.
    pub model_error: f64,
    /// Least logarithm of the factor by which a reading shortens what is left, summed over joints, and the one
    /// from which on a smaller misfit does.
    pub gain: [f64; 2],
    /// The same for a turned sign where the nominal torque leaves more than all of the effort of the joint mended most: it is then
    /// contradicted, not only inexact.
    pub contradicted_gain: f64,
    /// Least difference of that logarithm by which one reading is preferred to another one.
    pub margin: f64,
    /// Least angle between the gravity of the efforts and of the description (rad): bases that stand on a floor
    /// are tilted by less.
    pub gravity_angle: f64,
    /// Least factor between the sizes of gravity.
    pub gravity_factor: f64,
    /// Largest part of the nominal torque of gravity in efforts that lack it.
    pub held_gravity: f64,
    /// Least range of a joint that moves (rad, and m at a sliding joint).
    pub moves: [f64; 2],
    /// Factors that are the same at all joints, to that share, have one reason.
    pub alike: f64,
    /// Least relative difference between a velocity column and the derivative of the position.
    pub velocity_factor: f64,
    /// Least factor by which time is off, as efforts alone show it: unknown rotors do less.
    pub time_factor: f64,
    /// Rate below which no logger of an arm works (Hz).
    pub slowest_hz: f64,
    /// Least time for which all signals stand still (s).
    pub held_s: f64,
    /// Least time for which one position stands still (s): drives rest for less in the middle of a motion.
    pub stuck_s: f64,
    /// A freeze breaks motion off: the step into it over the largest change from one step to the next that is
    /// usual, and the step out of it over the largest step that is usual. Arms brake over several samples.
    pub freeze: [f64; 2],
    /// Height of a spike over the largest usual second difference.
    pub spike: f64,
    /// Share of samples at the limit of the effort.
    pub at_limit: f64,
    /// Least time that two runs share (s).
    pub shared_s: f64,
}

impl Default for Thresholds {
    fn default() -> Self {
        Self {
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
            moves: [0.02, 0.005],
            alike: 0.15,
            velocity_factor: 0.04,
            time_factor: 1.3,
            slowest_hz: 2.0,
            held_s: 0.2,
            stuck_s: 1.0,
            freeze: [2.0, 6.0],
            spike: 8.0,
            at_limit: 1.0 / 3.0,
            shared_s: 0.5,
        }
    }
}
