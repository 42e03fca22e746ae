//! Serial arms as they are built: joints, links, a gripper.

use std::f64::consts::{FRAC_PI_2, FRAC_PI_4};

use nalgebra::{Isometry3, Rotation3, Translation3, Vector3};
use rand::RngExt;
use rand_chacha::ChaCha8Rng;
use robot::JointKind;

use crate::arms::bodies::{BodyError, SampledBody};
use crate::arms::make::Make;
use crate::corner::ArmClass;
use crate::dice::{between, happens, log_uniform_between, one_of};

/// A joint and the link that it carries.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct ChainJoint {
    /// Name of the joint.
    pub name: String,
    /// How it moves: revolute or prismatic.
    pub kind: JointKind,
    /// Pose in the parent's frame at zero.
    pub parent_from_joint: Isometry3<f64>,
    /// Axis in its own frame.
    pub axis: Vector3<f64>,
    /// Lowest and highest position (rad or m).
    pub range: [f64; 2],
    /// Largest speed (rad/s or m/s).
    pub speed: f64,
    /// The link.
    pub body: SampledBody,
}

/// A serial arm.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Chain {
    /// Name of the robot.
    pub name: String,
    /// Joints from the base on.
    pub joints: Vec<ChainJoint>,
    /// A body fixed to the last link, with its pose there.
    pub gripper: Option<(SampledBody, Isometry3<f64>)>,
}

/// How the frames of the links lie.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Frames {
    /// All alike at zero.
    Aligned,
    /// z along the axis, as Denavit and Hartenberg have it.
    AlongAxis,
}

/// Axes from the base on: z turns about the vertical or the link, y pitches.
const PATTERNS: [&str; 6] = ["zyyzyz", "zyyyzy", "zyzyzyz", "zyyzyz", "zyyzyzz", "yzyzyyz"];

impl Chain {
    /// A chain of a class with so many joints.
    pub(crate) fn draw(class: ArmClass, count: usize, random: &mut ChaCha8Rng) -> Self {
        let make = Make::of(class);
        let frames = match happens(random, 0.4) {
            true => Frames::AlongAxis,
            false => Frames::Aligned,
        };
        let turns = axes(count, random);
        let slider =
            if count > 1 && happens(random, 0.15) { Some(slide(count, random)) } else { None };
        let elbow_x = happens(random, 0.4);
        let mut joints = Vec::with_capacity(count);
        let (mut at, mut last) = (base_height(&make, random), Rotation3::identity());
        for (i, letter) in turns.iter().enumerate() {
            let along = if elbow_x && i >= 2 { Vector3::x() } else { Vector3::z() };
            let slides = slider == Some(i);
            let drawn = JointDraw { make: &make, i, count, along, letter: *letter, slides };
            let length = drawn.length(random);
            let axis = drawn.axis(random);
            let mass = drawn.mass(random);
            let body =
                SampledBody::draw(format!("link{}", i + 1), &make, mass, length, along, random);
            let (range, speed) = (drawn.range(length, random), drawn.speed(random));
            let frame = match frames {
                Frames::Aligned => Rotation3::identity(),
                Frames::AlongAxis => along_z(axis),
            };
            let rotation = last.inverse() * frame;
            joints.push(ChainJoint {
                name: drawn.name(),
                kind: if slides { JointKind::Prismatic } else { JointKind::Revolute },
                parent_from_joint: Isometry3::from_parts(
                    Translation3::from(last.inverse() * at),
                    rotation.into(),
                ),
                axis: frame.inverse() * axis,
                range,
                speed,
                body: body.in_turned_frame(&frame.inverse()),
            });
            let aside = length * between(random, [-0.15, 0.15]);
            at = along * length;
            if happens(random, 0.5) {
                at.y += aside;
            }
            last = frame;
        }
        let gripper = gripper(&make, joints.last(), last.inverse() * at, random);
        Self { name: format!("{class}{count}"), joints, gripper }
    }

    /// The chain as a model has it whose bodies are off, one error a moving body.
    pub(crate) fn with_errors(&self, errors: &[BodyError]) -> Self {
        let mut chain = self.clone();
        for (joint, error) in chain.joints.iter_mut().zip(errors) {
            joint.body.inertia = error.of(&joint.body.inertia);
        }
        if let (Some((body, pose)), Some(error)) = (&mut chain.gripper, errors.last()) {
            let turn = pose.rotation.to_rotation_matrix().inverse();
            body.inertia = error.in_turned_frame(&turn).of(&body.inertia);
        }
        chain
    }
}

/// What is known of a joint when it is drawn.
struct JointDraw<'a> {
    make: &'a Make,
    i: usize,
    count: usize,
    along: Vector3<f64>,
    letter: char,
    slides: bool,
}

impl JointDraw<'_> {
    fn name(&self) -> String {
        let role = match (self.slides, self.i, self.letter) {
            (true, 0, _) => "track",
            (true, ..) => "lift",
            (_, 0, 'z') => "base_yaw",
            (_, 0 | 1, _) => "shoulder_pitch",
            (_, 2 | 3, 'y') => "elbow_pitch",
            (_, _, 'y') => "wrist_pitch",
            _ => "roll",
        };
        format!("j{}_{role}", self.i + 1)
    }

    fn length(&self, random: &mut ChaCha8Rng) -> f64 {
        let [low, high] = self.make.length_m;
        let long = self.letter == 'y' && (1..=3).contains(&self.i) || self.count <= 3;
        let share = if long { [0.5, 1.0] } else { [0.0, 0.45] };
        round_mm(low + (high - low) * between(random, share))
    }

    fn mass(&self, random: &mut ChaCha8Rng) -> f64 {
        let outward = self.i as f64 / self.count.max(2) as f64;
        let share = 0.7 * (1.0 - outward) + between(random, [0.0, 0.3]);
        let [low, high] = self.make.mass_kg;
        low * (high / low).powf(share.clamp(0.0, 1.0))
    }

    fn axis(&self, random: &mut ChaCha8Rng) -> Vector3<f64> {
        let axis = match (self.slides, self.i, self.letter) {
            (true, 0, _) => one_of(random, [Vector3::x(), Vector3::y(), Vector3::z()]),
            (true, ..) => self.along,
            (_, 0, 'z') => Vector3::z(),
            (_, _, 'z') => self.along,
            _ => Vector3::y(),
        };
        if happens(random, 0.25) { -axis } else { axis }
    }

    fn range(&self, length: f64, random: &mut ChaCha8Rng) -> [f64; 2] {
        if self.slides {
            return [0.0, round_mm(length * between(random, [0.8, 2.0]))];
        }
        let half = match self.letter {
            'z' => between(random, [1.5, 2.9]),
            _ => between(random, [1.0, 2.0]),
        };
        let middle = if self.letter == 'y' { between(random, [-0.6, 0.6]) } else { 0.0 };
        [middle - half, middle + half].map(|end| (100.0 * end).round() / 100.0)
    }

    fn speed(&self, random: &mut ChaCha8Rng) -> f64 {
        let range = self.make.speed[usize::from(self.slides)];
        let outward = self.i as f64 / self.count.max(2) as f64;
        let share = 0.6 * outward + between(random, [0.0, 0.4]);
        let speed = range[0] + share * (range[1] - range[0]);
        (100.0 * speed).round() / 100.0
    }
}

/// The letters of an arm's axes.
fn axes(count: usize, random: &mut ChaCha8Rng) -> Vec<char> {
    if count == 1 {
        return vec![if happens(random, 0.75) { 'y' } else { 'z' }];
    }
    let fitting: Vec<&str> = PATTERNS.into_iter().filter(|p| p.len() >= count).collect();
    let at = random.random_range(0..fitting.len().max(1));
    let pattern = fitting.get(at).copied().unwrap_or(PATTERNS[2]);
    pattern.chars().take(count).collect()
}

/// The joint of an arm that slides.
fn slide(count: usize, random: &mut ChaCha8Rng) -> usize {
    if count > 2 && happens(random, 0.5) { random.random_range(2..count) } else { 0 }
}

fn base_height(make: &Make, random: &mut ChaCha8Rng) -> Vector3<f64> {
    Vector3::z() * round_mm(make.length_m[1] * between(random, [0.3, 0.8]))
}

/// A gripper at the end of half the arms; its frame is turned against the link's in some.
fn gripper(
    make: &Make,
    last: Option<&ChainJoint>,
    at: Vector3<f64>,
    random: &mut ChaCha8Rng,
) -> Option<(SampledBody, Isometry3<f64>)> {
    let last = last.filter(|_| happens(random, 0.5))?;
    let mass = last.body.inertia.mass * log_uniform_between(random, [0.15, 0.6]);
    let length = make.length_m[0] * between(random, [0.8, 2.0]);
    let out = at.try_normalize(1e-9).unwrap_or_else(Vector3::z);
    let body = SampledBody::draw("gripper".to_owned(), make, mass, length, Vector3::z(), random);
    let turn = Rotation3::rotation_between(&Vector3::z(), &out);
    let turn =
        turn.unwrap_or_else(|| Rotation3::from_axis_angle(&Vector3::x_axis(), 2.0 * FRAC_PI_2));
    let about =
        Rotation3::from_axis_angle(&Vector3::z_axis(), one_of(random, [0.0, FRAC_PI_2, FRAC_PI_4]));
    Some((body, Isometry3::from_parts(Translation3::from(at), (turn * about).into())))
}

/// A rotation that takes z to an axis.
fn along_z(axis: Vector3<f64>) -> Rotation3<f64> {
    Rotation3::rotation_between(&Vector3::z(), &axis)
        .unwrap_or_else(|| Rotation3::from_axis_angle(&Vector3::x_axis(), 2.0 * FRAC_PI_2))
}

fn round_mm(length: f64) -> f64 {
    ((1e3 * length).round() * 1e-3).max(0.001)
}
