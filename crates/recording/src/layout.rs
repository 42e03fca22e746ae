use rerun::blueprint::components::{Corner2D, LinkAxis, PanelState};
use rerun::blueprint::{
    BarChartView, Blueprint, BlueprintPanel, ContainerLike, Horizontal, SelectionPanel,
    Spatial3DView, Tabs, TextDocumentView, TextLogView, TimePanel, Vertical,
};
use rerun::external::re_sdk_types::blueprint::archetypes::{
    Background, EyeControls3D, LineGrid3D, PlotLegend, ScalarAxis, TextLogColumns, TimeAxis,
    VisibleTimeRanges,
};
use rerun::external::re_sdk_types::blueprint::datatypes::{
    TextLogColumn, TextLogColumnKind, TimelineColumn,
};
use rerun::external::re_sdk_types::datatypes::{TimeRange, TimeRangeBoundary, VisibleTimeRange};
use rerun::{EntityPath, RecordingStream};

use crate::plots::Plots;
use crate::properties::Properties;
use crate::recorder::{DOCUMENT, EVENTS, TIMELINE};
use crate::seen::Seen;
use crate::shapes::point;
use crate::{Quantity, RecordingError};

/// Room about the arms in the picture, as a part of the reach: links are thicker than their joints.
const ROOM: f64 = 0.08;

/// Most lines that a legend names in a plot.
const LEGEND: usize = 8;

/// Share of the height of a plot that a line of its legend takes, and that is left below the curves.
const LEGEND_LINE: f64 = 0.07;
const BELOW: f64 = 0.05;

/// What the screen shows: the arm left, a tab a joint in the middle, the verdict right.
#[derive(Debug, Clone)]
pub(crate) struct Layout {
    pub title: String,
    pub reach_m: f64,
    /// Where the arms were.
    pub seen: Seen,
    pub plots: Plots,
    /// The bar charts, which are not known before they come.
    pub bars: Vec<Bars>,
    /// Index of the joint whose tab is open, which is not known at first either.
    pub opened: Option<usize>,
}

/// Name of the tabs of the joints.
const JOINTS: &str = "joints";

/// A bar chart.
#[derive(Debug, Clone)]
pub(crate) struct Bars {
    pub title: String,
    pub path: EntityPath,
    /// The series in it.
    pub names: Vec<String>,
}

impl Layout {
    /// Writes the layout; the one written last is shown.
    pub fn send(&self, stream: &RecordingStream) -> Result<(), RecordingError> {
        let mut properties = Properties::default();
        let screen = Horizontal::new([
            self.left(&mut properties),
            self.joints(&mut properties),
            self.right(&mut properties),
        ]);
        let layout = Blueprint::new(screen.with_column_shares([2.0, 2.0, 1.3]))
            .with_auto_views(false)
            .with_auto_layout(false)
            .with_blueprint_panel(BlueprintPanel::from_state(PanelState::Hidden))
            .with_selection_panel(SelectionPanel::from_state(PanelState::Hidden))
            .with_time_panel(
                TimePanel::new().with_state(PanelState::Collapsed).with_timeline(TIMELINE),
            );
        properties.send(&layout, stream)
    }

    fn left(&self, properties: &mut Properties) -> ContainerLike {
        let scene = self.scene(properties);
        let overview = [Quantity::Error, Quantity::Residual, Quantity::Position]
            .into_iter()
            .find(|quantity| self.plots.quantities().any(|q| q == *quantity));
        let Some(quantity) = overview else { return scene };
        let lines = self.plots.joints.len() * self.plots.count(quantity);
        let ends = self.plots.ends_of_all(quantity);
        let plot = plot(self.plots.of_all(quantity).into(), (lines, ends), properties);
        Vertical::new([scene, plot]).with_row_shares([2.4, 1.0]).into()
    }

    /// The arms, seen from where all of their motion fits the picture; before there is any, from a
    /// place that the reach decides.
    fn scene(&self, properties: &mut Properties) -> ContainerLike {
        let reach = self.reach_m as f32;
        let [place, target] = match self.seen.eye(ROOM * self.reach_m) {
            Some(eye) => eye.map(|at| point(&at)),
            None => [[0.95 * reach, -1.05 * reach, 0.85 * reach], [0.0, 0.0, 0.42 * reach]],
        };
        let view = Spatial3DView::new(self.title.as_str()).with_origin("world");
        let eye = EyeControls3D::new()
            .with_position(place)
            .with_look_target(target)
            .with_eye_up([0.0_f32, 0.0, 1.0]);
        let grid = LineGrid3D::new().with_visible(true).with_spacing(spacing(self.reach_m) as f32);
        // Pieces of a path are each written once: all up to now make the path.
        let so_far = VisibleTimeRange {
            timeline: TIMELINE.into(),
            range: TimeRange {
                start: TimeRangeBoundary::Infinite,
                end: TimeRangeBoundary::CursorRelative(0.into()),
            },
        };
        let dark = Background::new(rerun::blueprint::components::BackgroundKind::GradientDark);
        let view = properties.set(view.into(), "EyeControls3D", eye);
        let view = properties.set(view, "LineGrid3D", grid);
        let view = properties.set(view, "Background", dark);
        properties.set(view, "VisibleTimeRanges", VisibleTimeRanges::new([so_far]))
    }

    fn joints(&self, properties: &mut Properties) -> ContainerLike {
        let tabs: Vec<ContainerLike> = self
            .plots
            .joints
            .iter()
            .map(|joint| {
                let plots = self.plots.quantities().map(|quantity| {
                    let view = self.plots.of_joint(joint, quantity).into();
                    let ends = self.plots.ends_of(&joint.0, quantity);
                    plot(view, (self.plots.count(quantity), ends), properties)
                });
                let plots: Vec<ContainerLike> = plots.collect();
                // A longer legend needs a higher plot.
                let heights = self.plots.quantities().map(|q| 2.0 + self.plots.count(q) as f32);
                let plots = Vertical::new(plots).with_row_shares(heights.collect::<Vec<_>>());
                plots.with_name(joint.0.as_str()).into()
            })
            .collect();
        if let Some((joint, _)) = self.opened.and_then(|j| self.plots.joints.get(j)) {
            properties.open(JOINTS, joint);
        }
        Tabs::new(tabs).with_name(JOINTS).into()
    }

    fn right(&self, properties: &mut Properties) -> ContainerLike {
        let verdict = TextDocumentView::new("verdict").with_origin(DOCUMENT).into();
        let mut events = TextLogView::new("events").with_origin(EVENTS).into();
        let shown = [TextLogColumnKind::LogLevel, TextLogColumnKind::Body];
        let columns = TextLogColumns::new()
            .with_timeline_columns([TimelineColumn {
                visible: true.into(),
                timeline: TIMELINE.into(),
            }])
            .with_text_log_columns(shown.map(|kind| TextLogColumn { visible: true.into(), kind }));
        events = properties.set(events, "TextLogColumns", columns);
        let bars = self.bars.iter().map(|bars| -> ContainerLike {
            // The legend knows paths, not names, and would cover the bars.
            let title = format!("{} by joint: {}", bars.title, bars.names.join(", "));
            let legend = PlotLegend::new().with_visible(false);
            let view = BarChartView::new(title).with_origin(bars.path.clone());
            properties.set(view.into(), "PlotLegend", legend)
        });
        let bars: Vec<_> = bars.collect();
        if bars.is_empty() {
            return Vertical::new([verdict, events]).with_row_shares([2.5, 1.0]).into();
        }
        let bars = Tabs::new(bars).with_name("metrics").into();
        Vertical::new([verdict, bars, events]).with_row_shares([2.0, 1.2, 1.0]).into()
    }
}

/// A plot of so many lines between these ends, below its legend; where that would hide them, a line
/// tells its name when it is pointed at.
fn plot(
    view: ContainerLike,
    (lines, ends): (usize, Option<[f64; 2]>),
    properties: &mut Properties,
) -> ContainerLike {
    let shared = TimeAxis::new().with_link(LinkAxis::LinkToGlobal);
    let view = properties.set(view, "TimeAxis", shared);
    let legend = PlotLegend::new().with_corner(Corner2D::LeftTop);
    let view = properties.set(view, "PlotLegend", legend.with_visible(lines <= LEGEND));
    match ends {
        Some(ends) => {
            let axis = ScalarAxis::new().with_range(with_room(ends, lines));
            properties.set(view, "ScalarAxis", axis)
        }
        None => view,
    }
}

/// The ends of an axis whose curves lie below a legend of so many lines.
fn with_room([low, high]: [f64; 2], lines: usize) -> [f64; 2] {
    let above = if lines <= LEGEND { LEGEND_LINE * (lines as f64 + 1.0) } else { BELOW };
    let height = (high - low).max(1e-6 * high.abs().max(1e-6)) / (1.0 - above - BELOW);
    [low - BELOW * height, high + above * height]
}

/// Distance of the lines of the grid: 1, 2 or 5 times a power of ten, about a quarter of
/// the reach.
fn spacing(reach_m: f64) -> f64 {
    let wanted = 0.25 * reach_m;
    let decade = 10_f64.powf(wanted.log10().floor());
    let steps = [5.0, 2.0, 1.0].map(|step| step * decade);
    steps.into_iter().find(|step| *step <= wanted).unwrap_or(decade)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn curves_lie_below_the_legend() {
        let [low, high] = with_room([-1.0, 3.0], 2);
        let height = high - low;
        assert!((high - 3.0 - 3.0 * LEGEND_LINE * height).abs() < 1e-9);
        assert!((-1.0 - low - BELOW * height).abs() < 1e-9);
        let [low, high] = with_room([0.0, 0.0], 1);
        assert!(low < 0.0 && high > 0.0);
    }

    #[test]
    fn the_grid_has_round_steps_for_small_and_large_robots() {
        for (reach_m, expected) in [(0.01, 0.002), (0.5, 0.1), (1.4, 0.2), (30.0, 5.0)] {
            let step = spacing(reach_m);
            assert!((step / expected - 1.0).abs() < 1e-9, "{reach_m}: {step}");
        }
    }
}
