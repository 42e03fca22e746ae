/// Prior sizes of effects, and the limits beyond which a size is not accepted.
///
/// Lengths of a joint are rad where it turns and m where it slides.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Priors {
    /// Standard deviation of a time skew, a delay and a lag (s): some samples of a control loop.
    pub time_sd_s: f64,
    /// Standard deviation of the delay of a goal on its way to a servo (s): a bus and a program that sends at 30 to 50 Hz.
    pub goal_delay_sd_s: f64,
    /// Standard deviation of a torque gain (1): published constants of one drive differ by 5 to 30 per cent (Barrett
    /// puck IPNM values, 2472 to 2755 and 17474 to 21400).
    pub torque_gain_sd: f64,
    /// Largest relative error of a torque gain (1): beyond it another cause is more believable.
    pub torque_gain_limit: f64,
    /// Standard deviation of a transmission ratio (1): published ratios of one arm differ by up to 4.3 per cent
    /// (Barrett WAM).
    pub transmission_ratio_sd: f64,
    /// Largest relative error of a transmission ratio (1): more than that of a pulley that was taken for another one.
    pub transmission_ratio_limit: f64,
    /// Standard deviation of the ratio by which the next joint turns shared motors (1).
    pub shared_ratio_sd: f64,
    /// Log odds (nats) against motors that are shared and described nowhere: few arms share motors, and friction of
    /// the sum and difference of two speeds passes for what else goes with both joints. In the panel, whose arms share
    /// none, 33 such findings are 11 with it, and those of a Stäubli TX40, whose wrist shares two, stay; with 30 they
    /// are 22, with 300 most of the TX40's go.
    pub shared_motors_log_odds_against: f64,
    /// Standard deviation of a gap (rad or m): gears have tenths of a milliradian, worn joints some ten.
    pub gap_sd: f64,
    /// Standard deviation of the twist of a transmission under the RMS effort (rad or m).
    pub twist_sd: f64,
    /// Standard deviation of an encoder offset (rad or m): a scribed zero is good to a few hundredths.
    pub encoder_offset_sd: f64,
    /// Standard deviation of the tilt of the base (rad): a base is rarely off by more than a few degrees.
    pub tilt_sd_rad: f64,
    /// Largest tilt of the base that the linear columns describe (rad).
    pub tilt_limit_rad: f64,
    /// Standard deviation of the coefficient of friction that grows with the load (1).
    pub load_friction_sd: f64,
    /// Largest difference of the forward and backward Coulomb levels, as a share of their sum (1): one that is three
    /// times the other. A larger difference is that of an offset.
    pub asymmetry_limit: f64,
    /// Least Stribeck excess, as a share of the Coulomb level (1).
    pub stribeck_least_excess: f64,
    /// Least Stribeck velocity, in speeds below which the joint counts as at rest (1): an excess that is gone before
    /// the direction of motion is known shows neither height nor width.
    pub stribeck_least_velocity: f64,
    /// Standard deviation of a Stribeck velocity and of a warm-up time constant, as a share of it (1).
    pub shape_sd_share: f64,
    /// Standard deviation of a presliding way (rad or m).
    pub presliding_way_sd: f64,
    /// Shortest presliding way (rad or m): drives have 0.2 to 5 mrad, and encoders count in tenths of that.
    pub presliding_shortest_way: f64,
    /// The same in changes of position that the logs resolve (1): a shorter way is dry friction whose reversal the
    /// encoder shows late.
    pub presliding_resolved: f64,
    /// Fewest periods in a turn of friction that varies with position (1): a longer wave is no wave.
    pub wave_fewest_periods: f64,
    /// Most periods in a turn of friction that varies with position (1).
    pub wave_most_periods: f64,
    /// Standard deviation of these periods, times the range of motion (rad or m): a phase of one over half the range.
    pub wave_periods_sd: f64,
    /// Largest share of the Coulomb level that varies with position (1): friction opposes the motion everywhere.
    pub wave_share_limit: f64,
    /// Longest warm-up time constant that is tried, in sessions (1): of a longer one the logs have only the start.
    pub warming_longest_sessions: f64,
    /// Standard deviation of the rest position of a cable spring, over the range of motion (1).
    pub spring_rest_sd: f64,
    /// Farthest centre of mass of a payload from the origin of the link that holds it (m).
    pub payload_reach_m: f64,
    /// Standard deviation of the mass of a link beyond its own mass, in mean masses of a link (1).
    pub link_mass_sd_share: f64,
    /// Scales of the prior of an effect whose size is unknown by decades, all as likely (1).
    pub scales: [f64; 5],
    /// Share by which masses and inertias of CAD are wrong (1): cables, screws and castings are not in it.
    pub cad_share: f64,
    /// Distance by which centres of mass of CAD are wrong (m).
    pub cad_centre_m: f64,
    /// Smallest mass that the CAD error is taken of (kg).
    pub cad_least_mass_kg: f64,
}

impl Default for Priors {
    fn default() -> Self {
        Self {
            time_sd_s: 0.005,
            goal_delay_sd_s: 0.03,
            torque_gain_sd: 0.2,
            torque_gain_limit: 0.4,
            transmission_ratio_sd: 0.03,
            transmission_ratio_limit: 0.25,
            shared_ratio_sd: 0.2,
            shared_motors_log_odds_against: 100.0,
            gap_sd: 0.01,
            twist_sd: 0.01,
            encoder_offset_sd: 0.05,
            tilt_sd_rad: 0.1,
            tilt_limit_rad: 0.5,
            load_friction_sd: 0.2,
            asymmetry_limit: 0.5,
            stribeck_least_excess: 0.1,
            stribeck_least_velocity: 2.0,
            shape_sd_share: 0.5,
            presliding_way_sd: 0.005,
            presliding_shortest_way: 1e-4,
            presliding_resolved: 2.0,
            wave_fewest_periods: 1.0,
            wave_most_periods: 42.0,
            wave_periods_sd: 2.0,
            wave_share_limit: 0.9,
            warming_longest_sessions: 3.0,
            spring_rest_sd: 0.25,
            payload_reach_m: 0.5,
            link_mass_sd_share: 0.3,
            scales: [1.0, 0.3, 0.1, 0.03, 0.01],
            cad_share: 0.1,
            cad_centre_m: 0.01,
            cad_least_mass_kg: 0.01,
        }
    }
}
