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

use crate::bounding_box::BoundingBox;
use crate::entities::{DOCUMENT, EVENTS, TIMELINE};
use crate::error::RecordingError;
use crate::plots::Plots;
use crate::properties::Properties;
use crate::scene::SignalQuantity;
use crate::shapes::point;

/// Room about the arms in the picture, as a part of the reach: links are thicker than their joints.
const ROOM: f64 = 0.08;

/// Most lines that a legend names in a plot.
const LEGEND: usize = 8;

/// Height of a line of a legend, and of its edges (pixels, of the viewer's 0.36).
const LEGEND_LINE_PX: f64 = 23.0;
const LEGEND_EDGES_PX: f64 = 8.0;

/// Height of a column of plots in a window of 1000 pixels, and what title and axis take of each plot (pixels).
const COLUMN_PX: f64 = 940.0;
const FRAME_PX: f64 = 47.0;

/// Most of the height of a plot that its legend is given, and what is left below the curves.
const MOST_ABOVE: f64 = 0.6;
const BELOW: f64 = 0.05;

/// What the screen shows: the arm left, a tab a joint in the middle, the verdict right.
#[derive(Debug, Clone)]
pub(crate) struct ScreenLayout {
    pub title: String,
    pub reach_m: f64,
    /// Where the arms were.
    pub seen: BoundingBox,
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

impl ScreenLayout {
    /// Writes the layout; the one written last is shown.
    pub fn send(&self, stream: &RecordingStream) -> Result<(), RecordingError> {
        let mut properties = Properties::default();
        let screen = Horizontal::new([
            self.left_side(&mut properties),
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

    fn left_side(&self, properties: &mut Properties) -> ContainerLike {
        let scene = self.scene(properties);
        let overview = [SignalQuantity::Error, SignalQuantity::Residual, SignalQuantity::Position]
            .into_iter()
            .find(|quantity| self.plots.quantities().any(|q| q == *quantity));
        let Some(quantity) = overview else { return scene };
        let lines = self.plots.joints.len();
        // The legend and the curves have as much height each.
        let share =
            if lines > LEGEND { 0.3 } else { (2.0 * legend_px(lines) + FRAME_PX) / COLUMN_PX };
        let share = share.clamp(0.3, 0.5);
        let axis = Axis { lines, ends: self.plots.ends_of_all(quantity), share };
        let plot = plot(self.plots.of_all(quantity).into(), &axis, properties);
        Vertical::new([scene, plot]).with_row_shares([1.0 - share as f32, share as f32]).into()
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
        // A longer legend needs a higher plot.
        let height = |quantity| 2.0 + self.plots.count(quantity) as f32;
        let heights: Vec<f32> = self.plots.quantities().map(height).collect();
        let all: f32 = heights.iter().sum();
        let tabs: Vec<ContainerLike> = self
            .plots
            .joints
            .iter()
            .map(|joint| {
                let plots = self.plots.quantities().map(|quantity| {
                    let view = self.plots.of_joint(joint, quantity).into();
                    let axis = Axis {
                        lines: self.plots.count(quantity),
                        ends: self.plots.ends_of(&joint.0, quantity),
                        share: f64::from(height(quantity) / all),
                    };
                    plot(view, &axis, properties)
                });
                let plots: Vec<ContainerLike> = plots.collect();
                let plots = Vertical::new(plots).with_row_shares(heights.clone());
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

/// What decides the axis of a plot.
struct Axis {
    /// Lines of its legend.
    lines: usize,
    /// Least and largest number that is shown; none before there is any.
    ends: Option<[f64; 2]>,
    /// Share of the height of its column.
    share: f64,
}

/// A plot below its legend; where that would hide the curves, a line tells its name when it is pointed at.
fn plot(view: ContainerLike, axis: &Axis, properties: &mut Properties) -> ContainerLike {
    let shared = TimeAxis::new().with_link(LinkAxis::LinkToGlobal);
    let view = properties.set(view, "TimeAxis", shared);
    let legend = PlotLegend::new().with_corner(Corner2D::LeftTop);
    let view = properties.set(view, "PlotLegend", legend.with_visible(axis.lines <= LEGEND));
    match axis.range() {
        Some(range) => properties.set(view, "ScalarAxis", ScalarAxis::new().with_range(range)),
        None => view,
    }
}

impl Axis {
    /// The ends of the axis, so that curves lie below the legend.
    fn range(&self) -> Option<[f64; 2]> {
        let [low, high] = self.ends?;
        let above = match self.lines {
            lines if lines > LEGEND => BELOW,
            lines => legend_px(lines) / (self.share * COLUMN_PX - FRAME_PX).max(1.0),
        };
        let above = above.min(MOST_ABOVE);
        let height = (high - low).max(1e-6 * high.abs().max(1e-6)) / (1.0 - above - BELOW);
        Some([low - BELOW * height, high + above * height])
    }
}

/// Height of a legend (pixels).
fn legend_px(lines: usize) -> f64 {
    LEGEND_LINE_PX * lines as f64 + LEGEND_EDGES_PX
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
        // A plot of 188 pixels, whose legend takes 54.
        let axis = Axis { lines: 2, ends: Some([-1.0, 3.0]), share: 0.25 };
        let [low, high] = axis.range().unwrap();
        let height = high - low;
        assert!((high - 3.0 - 54.0 / 188.0 * height).abs() < 1e-9);
        assert!((-1.0 - low - BELOW * height).abs() < 1e-9);
        let [low, high] = Axis { lines: 1, ends: Some([0.0, 0.0]), share: 0.01 }.range().unwrap();
        assert!(low < 0.0 && high > 0.0);
        let [_, high] =
            Axis { lines: LEGEND + 1, ends: Some([0.0, 1.0]), share: 0.3 }.range().unwrap();
        assert!(high < 1.1);
        assert_eq!(Axis { lines: 2, ends: None, share: 0.25 }.range(), None);
    }

    #[test]
    fn the_grid_has_round_steps_for_small_and_large_robots() {
        for (reach_m, expected) in [(0.01, 0.002), (0.5, 0.1), (1.4, 0.2), (30.0, 5.0)] {
            let step = spacing(reach_m);
            assert!((step / expected - 1.0).abs() < 1e-9, "{reach_m}: {step}");
        }
    }
}
