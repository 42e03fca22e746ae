use rerun::blueprint::TimeSeriesView;
use rerun::external::re_sdk_types::blueprint::datatypes::VisualizerComponentMapping;
use rerun::external::re_sdk_types::{VisualizableArchetype, Visualizer};
use rerun::{Color, SeriesLines};
use robot::JointKind;

use crate::signals::joint_path;
use crate::{Quantity, Role, colour};

/// What the plots of all joints have in common: the signals of the scene, without its data.
#[derive(Debug, Clone)]
pub(crate) struct Plots {
    pub joints: Vec<(String, JointKind)>,
    pub signals: Vec<(Quantity, String, Role)>,
}

impl Plots {
    /// The quantities that have a signal, in the order of the plots.
    pub fn quantities(&self) -> impl Iterator<Item = Quantity> {
        let has = |q: &Quantity| self.signals.iter().any(|(own, ..)| own == q);
        Quantity::ALL.into_iter().filter(has)
    }

    /// One quantity of one joint, a line a signal.
    pub fn of_joint(
        &self,
        (name, kind): &(String, JointKind),
        quantity: Quantity,
    ) -> TimeSeriesView {
        let own = || self.signals.iter().filter(|(q, ..)| *q == quantity);
        let path = joint_path(name);
        let lines = SeriesLines::new()
            .with_names(own().map(|(_, name, _)| name.as_str()))
            .with_colors(own().map(|(_, _, role)| colour::solid(colour::rgb(*role))))
            .with_widths(own().map(|(_, _, role)| width(*role)));
        TimeSeriesView::new(quantity.title(*kind))
            .with_origin(path.clone())
            .with_contents(["$origin"])
            .with_override(path, reading(&lines, quantity))
    }

    /// One quantity of all joints, a colour a joint.
    pub fn of_all(&self, quantity: Quantity) -> TimeSeriesView {
        let own: Vec<_> = self.signals.iter().filter(|(q, ..)| *q == quantity).collect();
        let same = self.joints.windows(2).all(|w| w[0].1.is_rotation() == w[1].1.is_rotation());
        let kind = self.joints.first().filter(|_| same).map(|(_, kind)| *kind);
        let title = kind.map_or_else(|| mixed(quantity), |kind| quantity.title(kind));
        let mut view = TimeSeriesView::new(format!("{title} of all joints"))
            .with_origin("joints")
            .with_contents(["$origin/**"]);
        for (i, (joint, _)) in self.joints.iter().enumerate() {
            let name = |signal: &str| match own.len() {
                1 => joint.clone(),
                _ => format!("{joint} {signal}"),
            };
            let lines = SeriesLines::new()
                .with_names(own.iter().map(|(_, signal, _)| name(signal)))
                .with_colors(own.iter().map(|_| -> Color { colour::solid(colour::series(i)) }))
                .with_widths(own.iter().map(|_| 1.0_f32));
            view = view.with_override(joint_path(joint), reading(&lines, quantity));
        }
        view
    }
}

/// The title of a plot that holds sliding joints beside rotating ones.
fn mixed(quantity: Quantity) -> &'static str {
    match quantity {
        Quantity::Position => "position (rad, m)",
        Quantity::Velocity => "velocity (rad/s, m/s)",
        Quantity::Torque => "torque (N m), force (N)",
        Quantity::Residual => "residual (N m, N)",
        Quantity::Error => "error (mrad, mm)",
    }
}

/// Lines that take their numbers from the column of a quantity.
fn reading(lines: &SeriesLines, quantity: Quantity) -> Visualizer {
    let column =
        VisualizerComponentMapping::new_source_component("Scalars:scalars", quantity.key());
    lines.visualizer().with_mappings([column.into()])
}

/// What is asked for is drawn wider, so that it shows beneath what follows it.
fn width(role: Role) -> f32 {
    if role == Role::Desired { 2.5 } else { 1.3 }
}
