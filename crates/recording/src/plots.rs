use rerun::blueprint::TimeSeriesView;
use rerun::external::re_sdk_types::blueprint::datatypes::VisualizerComponentMapping;
use rerun::external::re_sdk_types::{VisualizableArchetype, Visualizer};
use rerun::{EntityPath, SeriesLines};
use robot::JointKind;

use crate::colour;
use crate::entities::part;
use crate::scene::{SceneRole, SceneSignal, SignalQuantity};

/// What the plots of all joints have in common: the signals of the scene, without its data.
#[derive(Debug, Clone)]
pub(crate) struct Plots {
    pub joints: Vec<(String, JointKind)>,
    /// Signals that share their times; the first ones are those of the scene.
    sets: Vec<Vec<Line>>,
    /// Least and largest number of every signal of the sets, joint by joint.
    ends: Vec<Vec<Vec<[f64; 2]>>>,
}

/// Ends between which nothing was seen.
const NOTHING: [f64; 2] = [f64::INFINITY, f64::NEG_INFINITY];

/// A signal as a line.
#[derive(Debug, Clone)]
struct Line {
    quantity: SignalQuantity,
    name: String,
    role: SceneRole,
}

impl Plots {
    pub fn new(joints: Vec<(String, JointKind)>, signals: &[SceneSignal<'_>]) -> Self {
        let ends = vec![vec![vec![NOTHING; joints.len()]; signals.len()]];
        Self { joints, sets: vec![lines(signals)], ends }
    }

    /// Takes the numbers of the signals of a set, row-major with a number a joint.
    pub fn see(&mut self, set: usize, signals: &[&[f64]]) {
        let joints = self.joints.len();
        let ends = self.ends.get_mut(set).into_iter().flatten();
        for (ends, values) in ends.zip(signals) {
            for row in values.chunks_exact(joints.max(1)) {
                for ([low, high], value) in ends.iter_mut().zip(row).filter(|(_, v)| v.is_finite())
                {
                    (*low, *high) = (low.min(*value), high.max(*value));
                }
            }
        }
    }

    /// Least and largest number of a quantity of one joint, as it is shown; none before there is any.
    pub fn ends_of(&self, joint: &str, quantity: SignalQuantity) -> Option<[f64; 2]> {
        let joint = self.joints.iter().position(|(name, _)| name == joint)?;
        let all = self.sets.iter().flatten().zip(self.ends.iter().flatten());
        let own = all.filter(|(line, _)| line.quantity == quantity).map(|(_, ends)| ends[joint]);
        axis_range(own, quantity)
    }

    /// The same of what [`Self::of_all`] shows.
    pub fn ends_of_all(&self, quantity: SignalQuantity) -> Option<[f64; 2]> {
        let all = self.sets.first()?.iter().zip(self.ends.first()?);
        let own = all.filter(|(line, _)| line.quantity == quantity);
        axis_range(own.flat_map(|(_, ends)| ends.iter().copied()), quantity)
    }

    /// Adds signals with times of their own; returns their entities, one a joint.
    pub fn add(&mut self, signals: &[SceneSignal<'_>]) -> Vec<EntityPath> {
        self.sets.push(lines(signals));
        self.ends.push(vec![vec![NOTHING; self.joints.len()]; signals.len()]);
        let set = self.sets.len() - 1;
        self.joints.iter().map(|(joint, _)| path(joint, set)).collect()
    }

    /// Index of the signals that were added last.
    pub fn last_set(&self) -> usize {
        self.sets.len() - 1
    }

    /// Whether there are signals with times of their own.
    pub fn has_further(&self) -> bool {
        self.sets.len() > 1
    }

    /// The entities of the signals of the scene, one a joint.
    pub fn joint_paths(&self) -> impl Iterator<Item = EntityPath> {
        self.joints.iter().map(|(joint, _)| path(joint, 0))
    }

    /// The quantities that have a signal, in the order of the plots.
    pub fn quantities(&self) -> impl Iterator<Item = SignalQuantity> {
        SignalQuantity::ALL.into_iter().filter(|quantity| self.count(*quantity) > 0)
    }

    /// Lines in the plot of a quantity of one joint.
    pub fn count(&self, quantity: SignalQuantity) -> usize {
        self.sets.iter().flatten().filter(|line| line.quantity == quantity).count()
    }

    /// One quantity of one joint, a line a signal.
    pub fn of_joint(
        &self,
        (joint, kind): &(String, JointKind),
        quantity: SignalQuantity,
    ) -> TimeSeriesView {
        let title = format!("{} of {joint}", quantity.title(*kind));
        let mut view = TimeSeriesView::new(title).with_origin(path(joint, 0));
        let mut contents = vec![];
        for (set, lines) in self.sets.iter().enumerate() {
            let own = || lines.iter().filter(|line| line.quantity == quantity);
            if own().next().is_none() {
                continue;
            }
            let shown = SeriesLines::new()
                .with_names(own().map(|line| line.name.as_str()))
                .with_colors(own().map(|line| colour::solid(colour::rgb(line.role))))
                .with_widths(own().map(|line| width(line.role)));
            contents.push(path(joint, set).to_string());
            view = view.with_override(path(joint, set), with_column(&shown, quantity));
        }
        view.with_contents(contents)
    }

    /// One quantity of all joints: a colour and a line of the legend a joint; of several signals the
    /// first is the broadest.
    pub fn of_all(&self, quantity: SignalQuantity) -> TimeSeriesView {
        let lines = self.sets.first().into_iter().flatten();
        let own: Vec<&Line> = lines.filter(|line| line.quantity == quantity).collect();
        let mut view = TimeSeriesView::new(self.title_of_all(quantity, &own))
            .with_origin("joints")
            .with_contents(self.joint_paths().map(|path| path.to_string()));
        for (i, (joint, _)) in self.joints.iter().enumerate() {
            let color = colour::solid(colour::series(i));
            // The viewer joins lines of the same name to one line of the legend.
            let lines = SeriesLines::new()
                .with_names(own.iter().map(|_| joint.as_str()))
                .with_colors(own.iter().map(|_| color))
                .with_widths((0..own.len()).map(|k| width_among(k, own.len())));
            view = view.with_override(path(joint, 0), with_column(&lines, quantity));
        }
        view
    }

    fn title_of_all(&self, quantity: SignalQuantity, own: &[&Line]) -> String {
        let same = self.joints.windows(2).all(|w| w[0].1.is_rotation() == w[1].1.is_rotation());
        let kind = self.joints.first().filter(|_| same).map(|(_, kind)| *kind);
        let title = kind.map_or_else(|| mixed_title(quantity), |kind| quantity.title(kind));
        let names: Vec<&str> = own.iter().map(|line| line.name.as_str()).collect();
        match names.len() {
            0 | 1 => format!("{title} of all joints"),
            _ => format!("{title} of all joints, broad to fine: {}", names.join(", ")),
        }
    }
}

/// All ends together, as they are shown.
fn axis_range(ends: impl Iterator<Item = [f64; 2]>, quantity: SignalQuantity) -> Option<[f64; 2]> {
    let [low, high] = ends.fold(NOTHING, |[low, high], [a, b]| [low.min(a), high.max(b)]);
    (low <= high).then_some([low, high].map(|end| quantity.scale() * end))
}

fn lines(signals: &[SceneSignal<'_>]) -> Vec<Line> {
    let line =
        |s: &SceneSignal<'_>| Line { quantity: s.quantity, name: s.name.to_owned(), role: s.role };
    signals.iter().map(line).collect()
}

/// The entity of a joint: of the signals of the scene, or below it of those of a further set.
fn path(joint: &str, set: usize) -> EntityPath {
    let own = [part("joints"), part(joint)];
    let below = (set > 0).then(|| part(&format!("further{set}")));
    EntityPath::new(own.into_iter().chain(below).collect())
}

/// The title of a plot that holds sliding joints beside rotating ones.
fn mixed_title(quantity: SignalQuantity) -> &'static str {
    match quantity {
        SignalQuantity::Position => "position (rad, m)",
        SignalQuantity::Velocity => "velocity (rad/s, m/s)",
        SignalQuantity::Torque => "torque (N·m), force (N)",
        SignalQuantity::Residual => "residual (N·m, N)",
        SignalQuantity::Error => "error (mrad, mm)",
    }
}

/// Lines that take their numbers from the column of a quantity.
fn with_column(lines: &SeriesLines, quantity: SignalQuantity) -> Visualizer {
    let column =
        VisualizerComponentMapping::new_source_component("Scalars:scalars", quantity.key());
    lines.visualizer().with_mappings([column.into()])
}

/// What is asked for is drawn wider, so that it shows beneath what follows it.
fn width(role: SceneRole) -> f32 {
    if role == SceneRole::Desired { 2.5 } else { 1.3 }
}

/// Width of line `k` of `count` that have the colour of their joint: from 2.4 to 0.8.
fn width_among(k: usize, count: usize) -> f32 {
    if count < 2 { 1.0 } else { 2.4 - 1.6 * k as f32 / (count - 1) as f32 }
}

#[cfg(test)]
mod tests {
    use rerun::RecordingStreamBuilder;
    use rerun::blueprint::{Blueprint, BlueprintActivation};
    use rerun::external::re_log_types::LogMsg;
    use rerun::log::Chunk;

    use super::*;

    /// What the layout of a view says of its lines, entity by entity.
    fn names(view: TimeSeriesView) -> Vec<Vec<String>> {
        let (stream, messages) = RecordingStreamBuilder::new("plots").memory().unwrap();
        let activation = BlueprintActivation { make_active: true, make_default: true };
        Blueprint::new(view).send(&stream, activation).unwrap();
        stream.flush_blocking().unwrap();
        let component = SeriesLines::descriptor_names().component;
        let of = |message: LogMsg| {
            let LogMsg::ArrowMsg(_, rows) = message else { return None };
            let chunk = Chunk::from_arrow_msg(&rows).unwrap();
            let names = chunk.iter_slices::<String>(component).next()?;
            Some(names.iter().map(|name| name.as_str().to_owned()).collect())
        };
        let mut all: Vec<Vec<String>> = messages.take().into_iter().filter_map(of).collect();
        all.sort();
        all
    }

    #[test]
    fn the_legend_of_all_joints_names_them() {
        let joints = ["elbow", "wrist"].map(|joint| (joint.to_owned(), JointKind::Revolute));
        let signal = |name, role| SceneSignal { quantity: SignalQuantity::Residual, name, role };
        let signals =
            [signal("nominal", SceneRole::Nominal), signal("extended", SceneRole::Predicted)];
        for count in [1, 2] {
            let plots = Plots::new(joints.to_vec(), &signals[..count]);
            let expected = ["elbow", "wrist"].map(|joint| vec![joint.to_owned(); count]);
            assert_eq!(names(plots.of_all(SignalQuantity::Residual)), expected);
        }
        let plots = Plots::new(joints.to_vec(), &signals);
        let own: Vec<&Line> = plots.sets[0].iter().collect();
        let title = plots.title_of_all(SignalQuantity::Residual, &own);
        assert_eq!(title, "residual torque (N·m) of all joints, broad to fine: nominal, extended");
        assert_eq!(
            names(plots.of_joint(&joints[0], SignalQuantity::Residual)),
            [["nominal", "extended"]]
        );
    }

    #[test]
    fn the_first_of_several_lines_is_the_broadest() {
        let widths: Vec<f32> = (0..3).map(|k| width_among(k, 3)).collect();
        assert!(widths.windows(2).all(|pair| pair[0] > pair[1]) && widths[2] > 0.0, "{widths:?}");
    }
}
