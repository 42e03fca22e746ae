use std::collections::BTreeMap;

use nalgebra::{Matrix3, Vector3};
use rand::RngExt;
use rand_chacha::ChaCha8Rng;
use robot::{Inertia, Robot};

use crate::corner::FieldFeature;
use crate::dice::{
    direction, happens, log_uniform_between, one_of, round_to_digits, weighted_index,
};
use crate::error::PopulationError;
use crate::robot_files::RobotFiles;
use crate::trial::differences::Drives;
use crate::trial::field::inertial::{body_of, with_body, with_damping, with_hand};
use crate::trial::field::tool::SampledTool;

/// How often each error comes.
const ERRORS: [(FieldFeature, f64); 7] = [
    (FieldFeature::WrongMass, 0.22),
    (FieldFeature::WrongCentre, 0.22),
    (FieldFeature::PlaceholderInertia, 0.14),
    (FieldFeature::InertiaUnit, 0.12),
    (FieldFeature::DummyDamping, 0.1),
    (FieldFeature::ToolTakenOff, 0.1),
    (FieldFeature::ToolUnknown, 0.1),
];

/// Share of wrong models with a second error.
const TWO: f64 = 0.3;

/// Nominal over true mass, or true over nominal.
const MASS_FACTOR: [f64; 2] = [1.5, 4.0];

/// Error of a centre of mass (m), at most its distance from the joint and some.
const CENTRE_M: [f64; 2] = [0.01, 0.08];

/// Placeholders of exporters and hands for the three moments of inertia (kg m2).
const PLACEHOLDERS: [f64; 3] = [1.0, 1e-3, 1e-6];

/// A kg m2 in g mm2 and in g cm2.
const UNITS: [f64; 2] = [1e9, 1e7];

/// Damping that a simulator is kept stable with (N m s/rad or N s/m).
const DAMPINGS: [f64; 5] = [1.0, 2.0, 3.0, 5.0, 10.0];

/// A nominal model that is off by more than a few per cent.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct WrongUrdf {
    /// What is wrong with it.
    pub errors: Vec<FieldFeature>,
    /// The model.
    pub model: RobotFiles,
}

impl WrongUrdf {
    /// Draws one or two errors of a model. `truth` is the URDF of the arm and `robot` the arm, `tool` what a wrong
    /// tool is; a damping is no error where no effort shows it.
    pub fn draw(
        truth: &str,
        robot: &Robot,
        (model, tool): (&RobotFiles, &SampledTool),
        drives: Drives,
        random: &mut ChaCha8Rng,
    ) -> Result<Self, PopulationError> {
        let errors = draw_errors(drives, random);
        let mut bodies = Bodies { truth, robot, wrong: BTreeMap::new() };
        let mut model = RobotFiles { toml: without_rotors(&model.toml), ..model.clone() };
        for error in &errors {
            match error {
                FieldFeature::WrongMass => bodies.one(random, mass)?,
                FieldFeature::WrongCentre => bodies.one(random, centre)?,
                FieldFeature::PlaceholderInertia => {
                    let moment = one_of(random, PLACEHOLDERS);
                    let placeholder = move |body: Inertia, _: &mut ChaCha8Rng| Inertia {
                        about_com: Matrix3::identity() * moment,
                        ..body
                    };
                    bodies.one_or_all(random, placeholder)?;
                }
                FieldFeature::InertiaUnit => {
                    let unit = one_of(random, UNITS);
                    let in_unit = move |body: Inertia, _: &mut ChaCha8Rng| Inertia {
                        about_com: body.about_com * unit,
                        ..body
                    };
                    bodies.one_or_all(random, in_unit)?;
                }
                FieldFeature::DummyDamping => {
                    model.urdf = with_damping(&model.urdf, one_of(random, DAMPINGS));
                }
                FieldFeature::ToolTakenOff => {
                    model.urdf = with_hand(&model.urdf, &tool.link, &tool.body);
                }
                // The arm has it; the model stays as it is.
                _ => {}
            }
        }
        for (link, body) in &bodies.wrong {
            model.urdf = with_body(&model.urdf, link, body)?;
            model.toml = without_link(&model.toml, link);
        }
        Ok(Self { errors, model })
    }
}

/// One error, or two that do not hide one another.
fn draw_errors(drives: Drives, random: &mut ChaCha8Rng) -> Vec<FieldFeature> {
    let weight = |errors: &[FieldFeature], (error, weight): (FieldFeature, f64)| {
        use FieldFeature as F;
        let among = |one: F, other: F| errors.contains(&one) && error == other;
        let is_hidden = errors.contains(&error)
            || (error == F::DummyDamping && drives == Drives::Unseen)
            || among(F::PlaceholderInertia, F::InertiaUnit)
            || among(F::InertiaUnit, F::PlaceholderInertia)
            || among(F::ToolTakenOff, F::ToolUnknown)
            || among(F::ToolUnknown, F::ToolTakenOff);
        if is_hidden { 0.0 } else { weight }
    };
    let mut errors = Vec::new();
    for _ in 0..1 + usize::from(happens(random, TWO)) {
        let weights = ERRORS.map(|error| weight(&errors, error));
        errors.push(ERRORS[weighted_index(random, &weights)].0);
    }
    errors
}

/// The wrong bodies of a model by the name of the link, each made from the true one.
struct Bodies<'a> {
    truth: &'a str,
    robot: &'a Robot,
    wrong: BTreeMap<String, Inertia>,
}

impl Bodies<'_> {
    fn spoil(
        &mut self,
        link: usize,
        random: &mut ChaCha8Rng,
        error: &impl Fn(Inertia, &mut ChaCha8Rng) -> Inertia,
    ) -> Result<(), PopulationError> {
        let name = &self.robot.links()[link].name;
        let body = match self.wrong.get(name) {
            Some(body) => body.clone(),
            None => body_of(self.truth, name)?,
        };
        self.wrong.insert(name.clone(), error(body, random));
        Ok(())
    }

    /// An error of one link.
    fn one(
        &mut self,
        random: &mut ChaCha8Rng,
        error: impl Fn(Inertia, &mut ChaCha8Rng) -> Inertia,
    ) -> Result<(), PopulationError> {
        let link = random.random_range(0..self.robot.joint_count());
        self.spoil(link, random, &error)
    }

    /// An error of one link or, as often, of the whole export.
    fn one_or_all(
        &mut self,
        random: &mut ChaCha8Rng,
        error: impl Fn(Inertia, &mut ChaCha8Rng) -> Inertia,
    ) -> Result<(), PopulationError> {
        if happens(random, 0.5) {
            return self.one(random, error);
        }
        (0..self.robot.joint_count()).try_for_each(|link| self.spoil(link, random, &error))
    }
}

/// Another density: mass and inertia are off by one factor.
fn mass(body: Inertia, random: &mut ChaCha8Rng) -> Inertia {
    let factor = round_to_digits(log_uniform_between(random, MASS_FACTOR), 3);
    let factor = if happens(random, 0.5) { factor } else { 1.0 / factor };
    Inertia { mass: body.mass * factor, about_com: body.about_com * factor, ..body }
}

/// A centre of mass off by centimetres or, as often, with the sign of its largest component turned.
fn centre(body: Inertia, random: &mut ChaCha8Rng) -> Inertia {
    let com = body.com_in_link;
    let largest = com.iamax();
    if happens(random, 0.5) && com[largest].abs() >= CENTRE_M[0] {
        let mut turned = com;
        turned[largest] = -com[largest];
        return Inertia { com_in_link: turned, ..body };
    }
    let [least, most] = CENTRE_M;
    let shift = log_uniform_between(random, [least, most.min(least + com.norm())]);
    let shift: Vector3<f64> = direction(random).into_inner() * shift;
    Inertia { com_in_link: com + shift, ..body }
}

/// A `robot.toml` without rotors.
fn without_rotors(toml: &str) -> String {
    let kept = toml.lines().filter(|line| !line.starts_with("rotor_inertia_kg_m2"));
    kept.flat_map(|line| [line, "\n"]).collect()
}

/// A `robot.toml` without what it says of the body of a link.
fn without_link(toml: &str, link: &str) -> String {
    let header = format!("[link.{link}]");
    let mut within = false;
    let mut text = String::with_capacity(toml.len());
    for line in toml.lines() {
        within = line == header || within && !line.is_empty() && !line.starts_with('[');
        if !within {
            text += line;
            text.push('\n');
        }
    }
    text
}

#[cfg(test)]
mod tests {
    use rand_chacha::rand_core::SeedableRng;

    use super::*;

    const URDF: &str = r#"<robot name="arm"><link name="base"/>
        <link name="a"><inertial><origin xyz="0.3 0.01 0" rpy="0 0 0"/><mass value="2"/>
        <inertia ixx="0.01" ixy="0" ixz="0" iyy="0.02" iyz="0" izz="0.025"/></inertial></link>
        <joint name="j" type="revolute"><parent link="base"/><child link="a"/><axis xyz="0 0 1"/>
        <limit lower="-2" upper="2" velocity="3" effort="50"/></joint></robot>"#;

    /// Models that are wrong in one way, with the body that each of them has.
    fn wrong(error: FieldFeature) -> Vec<(Robot, Inertia)> {
        let robot = Robot::from_urdf(URDF).unwrap();
        let files =
            RobotFiles { urdf: URDF.to_owned(), toml: "urdf = \"robot.urdf\"\n".to_owned() };
        let mut all = Vec::new();
        for seed in 0..400 {
            let mut random = ChaCha8Rng::seed_from_u64(seed);
            let tool = SampledTool::draw(&robot, &mut random).unwrap();
            let drawn =
                WrongUrdf::draw(URDF, &robot, (&files, &tool), Drives::Seen, &mut random).unwrap();
            if drawn.errors == [error] {
                let body = body_of(&drawn.model.urdf, "a").unwrap();
                all.push((Robot::from_urdf(&drawn.model.urdf).unwrap(), body));
            }
        }
        assert!(all.len() >= 10, "{error}: {}", all.len());
        all
    }

    #[test]
    fn a_mass_is_off_by_a_factor_of_one_and_a_half_to_four_either_way() {
        let factors: Vec<f64> =
            wrong(FieldFeature::WrongMass).iter().map(|(_, body)| body.mass / 2.0).collect();
        for factor in &factors {
            let size = factor.max(1.0 / factor);
            assert!((1.5..=4.0).contains(&(size * (1.0 + 1e-6 * (2.0 - size).signum()))), "{size}");
        }
        assert!(factors.iter().any(|f| *f > 1.0) && factors.iter().any(|f| *f < 1.0));
    }

    #[test]
    fn a_centre_is_off_by_centimetres_or_in_its_sign() {
        let right = Vector3::new(0.3, 0.01, 0.0);
        let mut turned = 0;
        for (_, body) in wrong(FieldFeature::WrongCentre) {
            let shift = (body.com_in_link - right).norm();
            let is_turned = (body.com_in_link - Vector3::new(-0.3, 0.01, 0.0)).norm() < 1e-9;
            assert!(is_turned || (0.0099..0.0801).contains(&shift), "{shift}");
            assert!((body.mass - 2.0).abs() < 1e-9);
            turned += usize::from(is_turned);
        }
        assert!(turned >= 3, "{turned}");
    }

    /// The largest moment of the true body is .025 kg m2.
    #[test]
    fn inertias_are_placeholders_or_in_other_units() {
        for (_, body) in wrong(FieldFeature::PlaceholderInertia) {
            let moment = body.about_com[(0, 0)];
            assert!(PLACEHOLDERS.contains(&moment), "{moment}");
            assert_eq!(body.about_com, Matrix3::identity() * moment);
        }
        for (_, body) in wrong(FieldFeature::InertiaUnit) {
            let unit = body.about_com[(2, 2)] / 0.025;
            assert!(UNITS.iter().any(|known| (unit / known - 1.0).abs() < 1e-9), "{unit}");
        }
    }

    #[test]
    fn a_damping_is_of_one_to_ten_and_a_tool_makes_the_last_body_heavier() {
        for (robot, _) in wrong(FieldFeature::DummyDamping) {
            let damping = robot.links()[0].actuator.viscous;
            assert!((1.0..=10.0).contains(&damping), "{damping}");
        }
        for (robot, body) in wrong(FieldFeature::ToolTakenOff) {
            let tool = robot.links()[0].inertia.mass - body.mass;
            assert!((0.0399..0.1601).contains(&tool), "{tool}");
        }
        for (robot, _) in wrong(FieldFeature::ToolUnknown) {
            assert_eq!(robot.links(), Robot::from_urdf(URDF).unwrap().links());
        }
    }

    #[test]
    fn a_link_and_the_rotors_are_taken_out_of_a_description() {
        let toml = "urdf = \"a\"\n[joint.j]\nrotor_inertia_kg_m2 = 1.0\nkp_nm_per_rad = 2.0\n\n\
                    [link.a]\nmass_kg = 1.0\ncom_m = [0, 0, 0]\n\n[link.b]\nmass_kg = 2.0\n";
        let without = without_link(&without_rotors(toml), "a");
        let expected =
            "urdf = \"a\"\n[joint.j]\nkp_nm_per_rad = 2.0\n\n\n[link.b]\nmass_kg = 2.0\n";
        assert_eq!(without, expected);
    }
}
