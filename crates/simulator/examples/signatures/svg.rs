use std::fmt::Write;

use crate::panel::{Axis, Panel, Scale, Series, range};

const COLUMNS: usize = 4;
/// Width of the figure, size of a panel and of the plot in it, and where the plot begins (px).
const WIDTH: f64 = 1000.0;
const PANEL: (f64, f64) = (245.0, 196.0);
const PLOT: (f64, f64) = (182.0, 112.0);
const CORNER: (f64, f64) = (56.0, 40.0);
const HEADING: f64 = 40.0;
/// Most points drawn of one series.
const MOST_POINTS: usize = 400;

const SIMULATED: &str = "#66a8ec";
const WITHOUT: &str = "#aeb6bf";
const INK: &str = "#1f2328";
const QUIET: &str = "#59636e";
const GRID: &str = "#e4e8ec";

/// All panels, family by family, as one SVG.
pub fn figure(families: &[(&str, Vec<Panel>)]) -> String {
    let mut body = String::new();
    let mut top = 16.0;
    for (family, panels) in families {
        body += &text((12.0, top + 20.0), "font-size='16' font-weight='700'", family);
        body += &format!("<path d='M12 {:.1}H{:.1}' stroke='{GRID}'/>\n", top + 30.0, WIDTH - 12.0);
        top += HEADING;
        for (i, panel) in panels.iter().enumerate() {
            let x = 8.0 + PANEL.0 * (i % COLUMNS) as f64;
            let y = top + PANEL.1 * (i / COLUMNS) as f64;
            let _ = write!(body, "<g transform='translate({x:.1} {y:.1})'>\n{}</g>\n", draw(panel));
        }
        let left = (COLUMNS - panels.len() % COLUMNS) % COLUMNS;
        top += PANEL.1 * panels.len().div_ceil(COLUMNS) as f64;
        if left > 1 {
            let x = 8.0 + PANEL.0 * (COLUMNS - left) as f64 + CORNER.0;
            body += &legend((x, top - PANEL.1 + 64.0));
        }
    }
    let height = top + 8.0;
    format!(
        "<svg xmlns='http://www.w3.org/2000/svg' width='{WIDTH}' height='{height}' viewBox='0 0 {WIDTH} {height}' \
         font-family=\"system-ui, -apple-system, 'Segoe UI', Roboto, 'Noto Sans', 'DejaVu Sans', sans-serif\" \
         font-size='11' fill='{INK}'>\n<title>The signature of every effect in the simulated torque of a WAM</title>\n\
         <rect width='{WIDTH}' height='{height}' fill='#ffffff'/>\n{body}</svg>\n"
    )
}

fn legend((x, y): (f64, f64)) -> String {
    let lines = [
        (
            format!("<circle cx='10' cy='-4' r='3' fill='{SIMULATED}'/>"),
            "simulated with the effect",
        ),
        (
            format!("<path d='M0 -4H20' stroke='{WITHOUT}' stroke-width='3'/>"),
            "simulated without it",
        ),
        (
            format!(
                "<path d='M0 -4H20' stroke='{INK}' stroke-width='1.2' stroke-dasharray='4 2.5'/>"
            ),
            "closed form of what was put in",
        ),
    ];
    let line = |(i, (mark, words)): (usize, &(String, &str))| {
        let y = y + 22.0 * i as f64;
        format!(
            "<g transform='translate({x:.1} {y:.1})'>{mark}{}</g>\n",
            text((30.0, 0.0), "font-size='13'", words)
        )
    };
    lines.iter().enumerate().map(line).collect()
}

fn draw(panel: &Panel) -> String {
    let frame = Frame::around(panel);
    let mut out = text((CORNER.0, 14.0), "font-size='13' font-weight='600'", panel.name);
    out += &text((CORNER.0, 30.0), &format!("fill='{QUIET}'"), &panel.note);
    out += &frame.axes(panel);
    out += &path(&frame, &panel.without, &format!("stroke='{WITHOUT}' stroke-width='3'"));
    out += &match &panel.with {
        Series::Dots(dots) => {
            // A line of no length with round ends is a dot.
            let dots = thinned(dots).map(|p| frame.place(p));
            let d: String = dots.map(|(x, y)| format!("M{x:.1} {y:.1}h0")).collect();
            format!(
                "<path d='{d}' stroke='{SIMULATED}' stroke-width='4.5' stroke-linecap='round'/>\n"
            )
        }
        Series::Line(line) => path(&frame, line, &format!("stroke='{SIMULATED}' stroke-width='2'")),
    };
    for line in &panel.expected {
        let style = format!("stroke='{INK}' stroke-width='1.2' stroke-dasharray='4 2.5'");
        out += &path(&frame, line, &style);
    }
    out
}

/// Where values stand in the plot.
struct Frame {
    x: (f64, f64),
    y: (f64, f64),
    scales: (Scale, Scale),
}

impl Frame {
    /// A frame with a little room around everything that is drawn.
    fn around(panel: &Panel) -> Self {
        let drawn = || {
            let lines = panel.expected.iter().flatten();
            lines.chain(panel.with.points()).chain(&panel.without)
        };
        let scales = (panel.x.scale, panel.y.scale);
        let of = |k: usize, scale: Scale, room: f64| {
            let (low, high) = range(drawn().map(|p| scaled(scale, p[k])));
            let room = room * (high - low).max(1e-9);
            (low - room, high + room)
        };
        Self { x: of(0, scales.0, 0.03), y: of(1, scales.1, 0.09), scales }
    }

    fn place(&self, [x, y]: [f64; 2]) -> (f64, f64) {
        let share = |value: f64, (low, high): (f64, f64)| (value - low) / (high - low);
        let x = share(scaled(self.scales.0, x), self.x);
        let y = share(scaled(self.scales.1, y), self.y);
        (CORNER.0 + PLOT.0 * x, CORNER.1 + PLOT.1 * (1.0 - y))
    }

    fn axes(&self, panel: &Panel) -> String {
        let (left, top) = CORNER;
        let (right, bottom) = (left + PLOT.0, top + PLOT.1);
        let mut out = String::new();
        for (value, words) in ticks(&panel.x, self.x) {
            let x = left + PLOT.0 * (value - self.x.0) / (self.x.1 - self.x.0);
            let _ = write!(out, "<path d='M{x:.1} {top}V{bottom}' stroke='{GRID}'/>");
            out +=
                &text((x, bottom + 14.0), &format!("fill='{QUIET}' text-anchor='middle'"), &words);
        }
        for (value, words) in ticks(&panel.y, self.y) {
            let y = bottom - PLOT.1 * (value - self.y.0) / (self.y.1 - self.y.0);
            let _ = write!(out, "<path d='M{left} {y:.1}H{right}' stroke='{GRID}'/>");
            out +=
                &text((left - 5.0, y + 4.0), &format!("fill='{QUIET}' text-anchor='end'"), &words);
        }
        let _ = writeln!(
            out,
            "<path d='M{left} {top}V{bottom}H{right}' fill='none' stroke='{QUIET}'/>"
        );
        let middle = format!("fill='{INK}' text-anchor='middle'");
        out += &text((0.5 * (left + right), bottom + 29.0), &middle, panel.x.label);
        let turned = format!("{middle} transform='rotate(-90)'");
        out + &text((-0.5 * (top + bottom), 11.0), &turned, panel.y.label)
    }
}

fn scaled(scale: Scale, value: f64) -> f64 {
    match scale {
        Scale::Linear => value,
        Scale::Logarithmic => value.log10(),
    }
}

/// Places on the scaled axis, and what stands there.
fn ticks(axis: &Axis, (low, high): (f64, f64)) -> Vec<(f64, String)> {
    if axis.scale == Scale::Logarithmic {
        let decades = low.floor() as i32..=high.ceil() as i32;
        let marks: &[f64] = if high - low > 2.0 { &[1.0] } else { &[1.0, 2.0, 5.0] };
        let values = decades.flat_map(|d| marks.iter().map(move |m| m * 10.0_f64.powi(d)));
        let inside = values.filter(|v| (low..=high).contains(&v.log10()));
        return inside.map(|v| (v.log10(), format!("{v}"))).collect();
    }
    // The largest of 1, 2 or 5 times a power of ten that leaves room for two and a half of it.
    let most = (high - low) / 2.5;
    let decade = 10.0_f64.powf(most.log10().floor());
    let step = [5.0, 2.0, 1.0].map(|m| m * decade).into_iter().find(|s| *s <= most);
    let step = step.unwrap_or(most);
    let decimals = (-step.log10().floor()).max(0.0) as usize;
    let (first, last) = ((low / step).ceil() as i64, (high / step).floor() as i64);
    let tick = |k: i64| {
        let value = k as f64 * step;
        (value, format!("{value:.decimals$}").replace('-', "−"))
    };
    (first..=last).map(tick).collect()
}

fn path(frame: &Frame, points: &[[f64; 2]], style: &str) -> String {
    if points.is_empty() {
        return String::new();
    }
    let place = |(i, point)| {
        let (x, y) = frame.place(point);
        format!("{}{x:.1} {y:.1}", if i == 0 { 'M' } else { 'L' })
    };
    let d: String = thinned(points).enumerate().map(place).collect();
    format!("<path d='{d}' fill='none' {style}/>\n")
}

fn thinned(points: &[[f64; 2]]) -> impl Iterator<Item = [f64; 2]> + '_ {
    points.iter().copied().step_by(points.len().div_ceil(MOST_POINTS).max(1))
}

fn text((x, y): (f64, f64), style: &str, words: &str) -> String {
    format!("<text x='{x:.1}' y='{y:.1}' {style}>{words}</text>\n")
}
