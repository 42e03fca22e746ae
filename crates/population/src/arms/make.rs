use crate::corner::ArmClass;

/// Least rate of a controller (Hz) where no arm of a class has one that fits the rate of a log.
const LEAST_CONTROL_HZ: f64 = 100.0;

/// What arms of a class have in common.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Make {
    /// How often there are one to seven joints.
    pub joints: [f64; 7],
    /// Length of a link (m).
    pub length_m: [f64; 2],
    /// Mass of a link (kg).
    pub mass_kg: [f64; 2],
    /// Mass of a link over the volume of its hull (kg/m^3).
    pub density: [f64; 2],
    /// Largest error of a centre of mass in the nominal model (m).
    pub com_error_m: f64,
    /// Turns of a motor in a turn of its joint.
    pub gear: [f64; 2],
    /// Rated torque over the inertia of a rotor, seen at the joint (rad/s^2).
    pub rotor_acceleration: [f64; 2],
    /// Least and largest inertia of a rotor, seen at the joint (kg m^2).
    pub rotor_inertia: [f64; 2],
    /// Least torque limit of a drive (N m), and force limit (N).
    pub least_limit: [f64; 2],
    /// Largest speed of a joint (rad/s), and of a sliding one (m/s).
    pub speed: [[f64; 2]; 2],
    /// Acceleration that a drive is sized for (rad/s^2), and of a sliding one (m/s^2).
    pub acceleration: [[f64; 2]; 2],
    /// Coulomb friction over the torque limit.
    pub friction: [f64; 2],
    /// Rate of the controller (Hz) and of the log.
    pub rates: &'static [[f64; 2]],
}

impl Make {
    /// Rate of the controller of an arm (Hz) that is logged at this rate: the least of its class of which the log has
    /// a whole part, else the least whole multiple of the log's from 100 Hz on.
    pub fn control_rate_hz(&self, log_rate_hz: f64) -> f64 {
        let fits = |rate: &f64| {
            let rows = rate / log_rate_hz;
            rows > 0.5 && (rows - rows.round()).abs() < 1e-9
        };
        let known = self.rates.iter().map(|[control, _]| *control).filter(fits);
        let least = known.fold(f64::INFINITY, f64::min);
        let whole = (LEAST_CONTROL_HZ / log_rate_hz).ceil().max(1.0) * log_rate_hz;
        if least.is_finite() { least } else { whole }
    }

    /// What arms of a class have in common.
    pub(crate) fn of(class: ArmClass) -> Self {
        match class {
            ArmClass::Hobby => HOBBY,
            ArmClass::Cobot => COBOT,
            ArmClass::Industrial => INDUSTRIAL,
            ArmClass::Wam => WAM,
        }
    }
}

const HOBBY: Make = Make {
    joints: [1.0, 1.0, 2.0, 3.0, 3.0, 3.0, 1.0],
    length_m: [0.03, 0.12],
    mass_kg: [0.05, 0.3],
    density: [300.0, 2500.0],
    com_error_m: 0.002,
    gear: [200.0, 400.0],
    rotor_acceleration: [60.0, 150.0],
    rotor_inertia: [1e-4, 1e-2],
    least_limit: [0.3, 10.0],
    speed: [[4.0, 6.5], [0.15, 0.4]],
    acceleration: [[8.0, 25.0], [1.0, 3.0]],
    friction: [0.03, 0.08],
    rates: &[
        [200.0, 200.0],
        [200.0, 100.0],
        [200.0, 50.0],
        [500.0, 125.0],
        [500.0, 100.0],
        [500.0, 50.0],
    ],
};

const COBOT: Make = Make {
    joints: [1.0, 1.0, 1.0, 1.0, 1.0, 4.0, 5.0],
    length_m: [0.06, 0.45],
    mass_kg: [0.5, 5.0],
    density: [250.0, 3000.0],
    com_error_m: 0.004,
    gear: [50.0, 160.0],
    rotor_acceleration: [50.0, 200.0],
    rotor_inertia: [0.01, 3.0],
    least_limit: [6.0, 60.0],
    speed: [[1.8, 3.2], [0.3, 0.8]],
    acceleration: [[4.0, 12.0], [1.0, 4.0]],
    friction: [0.02, 0.07],
    rates: &[
        [125.0, 125.0],
        [250.0, 250.0],
        [250.0, 125.0],
        [500.0, 500.0],
        [500.0, 250.0],
        [500.0, 125.0],
        [1000.0, 1000.0],
        [1000.0, 500.0],
        [1000.0, 250.0],
        [1000.0, 100.0],
    ],
};

const INDUSTRIAL: Make = Make {
    joints: [1.0, 1.0, 1.0, 2.0, 1.0, 6.0, 1.0],
    length_m: [0.15, 1.1],
    mass_kg: [5.0, 60.0],
    density: [300.0, 4000.0],
    com_error_m: 0.005,
    gear: [60.0, 200.0],
    rotor_acceleration: [15.0, 60.0],
    rotor_inertia: [0.2, 400.0],
    least_limit: [40.0, 400.0],
    speed: [[1.5, 4.5], [0.3, 1.2]],
    acceleration: [[2.0, 8.0], [0.5, 3.0]],
    friction: [0.015, 0.06],
    rates: &[
        [100.0, 100.0],
        [200.0, 200.0],
        [200.0, 100.0],
        [250.0, 250.0],
        [250.0, 125.0],
        [500.0, 500.0],
        [500.0, 250.0],
        [500.0, 100.0],
    ],
};

const WAM: Make = Make {
    speed: [[2.5, 2.5], [0.5, 0.5]],
    acceleration: [[4.0, 12.0], [1.0, 4.0]],
    com_error_m: 0.004,
    friction: [0.01, 0.03],
    rates: &[[500.0, 500.0], [500.0, 250.0], [500.0, 125.0]],
    ..COBOT
};

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_controller_runs_at_a_whole_multiple_of_the_rate_of_its_log() {
        for &class in ArmClass::ALL {
            let make = Make::of(class);
            for rate in [20.0, 30.0, 50.0, 100.0, 125.0, 250.0, 500.0, 1000.0, 2000.0, 5000.0] {
                let rows = make.control_rate_hz(rate) / rate;
                assert!(rows >= 1.0 && (rows - rows.round()).abs() < 1e-9, "{class}: {rate}");
                assert!(rows * rate >= LEAST_CONTROL_HZ, "{class}: {rate}");
            }
        }
        let cobot = Make::of(ArmClass::Cobot);
        for (log, control) in [(125.0, 125.0), (5000.0, 5000.0), (30.0, 120.0)] {
            assert!((cobot.control_rate_hz(log) - control).abs() < 1e-9);
        }
    }
}
