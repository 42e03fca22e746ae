//! Reference motions: what the joints of a robot are asked to do.
//!
//! ```text
//! MotionSpec (a table of a scenario) --build--> Motion --sample(t)--> q, qd, qdd
//! ```
//!
//! Every motion is made of closed forms: sums of sinusoids, one sine of rising frequency,
//! or polynomials of degree five between knots. So velocity and acceleration are exact
//! derivatives, at any time and any rate. A motion never leaves the position and velocity
//! limits of its robot: [`MotionSpec::build`] refuses one that would.
//!
//! ```
//! # fn main() -> Result<(), Box<dyn std::error::Error>> {
//! use motion::{MotionSpec, State};
//! let robot = robot::Robot::from_urdf(r#"<robot name="arm"><link name="base"/>
//!   <link name="upper"><inertial><mass value="2"/>
//!     <inertia ixx="0.01" ixy="0" ixz="0" iyy="0.01" iyz="0" izz="0.01"/></inertial></link>
//!   <joint name="shoulder" type="revolute"><parent link="base"/><child link="upper"/>
//!     <axis xyz="0 1 0"/><limit lower="-2" upper="2" velocity="3" effort="50"/></joint>
//! </robot>"#)?;
//! let spec: MotionSpec = toml::from_str(
//!     "[sinusoids]\nseed = 1\nterms = 3\nlowest_hz = 0.1\nhighest_hz = 0.5\nduration_s = 20.0",
//! )?;
//! let motion = spec.build(&robot, std::path::Path::new("."))?;
//! let mut state = State::default();
//! motion.sample(7.5, &mut state);
//! assert!(state.q[0].abs() <= 0.8 * 2.0 && state.qd[0].abs() <= 0.8 * 3.0);
//! # Ok(())
//! # }
//! ```
//!
//! In the keys of a spec `rad` stands for m at a prismatic joint, as in `robot.toml`.

mod clock;
mod curve;
mod error;
mod extremes;
mod harmonics;
mod kinematics;
mod knots;
mod motion;
mod rising_sine;
mod site;
mod spec;
mod spline;

pub use error::{LimitedQuantity, MotionError};
pub use motion::{Motion, State};
pub use rising_sine::Growth;
pub use spec::chirp::Chirp;
pub use spec::fourier::{Coefficients, Fourier, FourierJoint, FourierSeries};
pub use spec::hold::Hold;
pub use spec::motion_spec::MotionSpec;
pub use spec::ramp::Ramp;
pub use spec::recorded::Recorded;
pub use spec::rhythm::{Figure, Plane, Rhythm};
pub use spec::sinusoids::Sinusoids;
pub use spec::sweep::Sweep;
pub use spec::waypoints::{Via, Waypoints};
