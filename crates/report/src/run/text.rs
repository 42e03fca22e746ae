use crate::diagnosis::forward::remarks;
use crate::run::claims::claim_text;
use crate::run::hidden::{hidden_rows, score_sentence, stray_sentence};
use crate::run::rows::{gain_rows, joint_numbers};
use crate::run::run_report::RunReport;
use pages::{
    BOLD, Cell, GridColumn, TABLE_DIGITS, TERMINAL_WIDTH, push_notes, significant, text_grid, wrap,
};

impl RunReport<'_> {
    /// The run as text for a terminal of 100 columns: the verdict, true beside found effects, and the
    /// gain over all joints and joint by joint.
    pub fn text(&self) -> String {
        let mut out = String::new();
        for line in wrap(&format!("{}.", self.diagnosis.sentence), TERMINAL_WIDTH) {
            out.push_str(&format!("{BOLD}{line}{BOLD:#}\n"));
        }
        out.push_str(&format!("\n{}\n", self.hidden()));
        out.push_str(&self.gains());
        out.push('\n');
        out.push_str(&self.joints());
        if !self.metrics.claims.is_empty() {
            out.push('\n');
            out.push_str(&claim_text(&self.metrics.claims, self.tracked_unit()));
        }
        push_notes(&mut out, &self.remarks());
        out
    }

    /// What was put in, opened after the diagnosis, and what was found of it.
    fn hidden(&self) -> String {
        let score = &self.metrics.score;
        let mut out = format!("{BOLD}{}.{BOLD:#}\n", score_sentence(score));
        let mut rows: Vec<[String; 3]> = Vec::new();
        for row in hidden_rows(score, self.robot) {
            rows.push([row.hidden, String::new(), row.found]);
            rows.extend(row.sizes.into_iter().map(|s| [format!("  {}", s.name), s.truth, s.found]));
        }
        let labels: Vec<String> = rows.iter().map(|row| row[0].clone()).collect();
        let column = |header: &str, of: usize| {
            let cells: Vec<String> = rows.iter().map(|row| row[of].clone()).collect();
            left_column(header, cells)
        };
        if !rows.is_empty() {
            out.push_str(&text_grid("", &labels, &[column("put in", 1), column("found", 2)]));
        }
        if let Some(stray) = stray_sentence(score) {
            wrap(&stray, TERMINAL_WIDTH).iter().for_each(|line| out.push_str(&format!("{line}\n")));
        }
        out
    }

    fn gains(&self) -> String {
        let rows = gain_rows(self.metrics);
        let labels: Vec<String> = rows.iter().map(|row| row.what.clone()).collect();
        let column = |header: &str, cells: Vec<String>| GridColumn {
            header: header.to_owned(),
            cells: cells.into_iter().map(Cell::plain).collect(),
        };
        let columns = [
            column("nominal", rows.iter().map(|row| row.before.clone()).collect()),
            column("extended", rows.iter().map(|row| row.after.clone()).collect()),
            column("less", rows.iter().map(|row| row.times.clone()).collect()),
        ];
        text_grid(&self.test_runs(), &labels, &columns)
    }

    /// One row a joint.
    fn joints(&self) -> String {
        let numbers = joint_numbers(self.metrics);
        let unit = self.position_unit();
        let column = |header: &str, of: &dyn Fn(usize) -> [f64; 2]| GridColumn {
            header: header.to_owned(),
            cells: (0..numbers.len()).map(|joint| Cell::plain(pair(of(joint)))).collect(),
        };
        let columns = [
            column("torque nMSE", &|j| numbers[j].nmse),
            column(&format!("drift in 200 ms ({unit})"), &|j| numbers[j].drift),
            column(&format!("tracking ({unit})"), &|j| numbers[j].tracking),
        ];
        text_grid("nominal -> extended", &self.metrics.joints, &columns)
    }

    /// The runs that took no part in the diagnosis.
    pub(crate) fn test_runs(&self) -> String {
        format!("{}, which the diagnosis has not seen", self.metrics.test.join(", "))
    }

    /// What to know of the numbers.
    pub(crate) fn remarks(&self) -> Vec<String> {
        let stopped = self.metrics.tracking.iter().filter(|run| run.rms.is_none());
        let stopped = stopped
            .map(|run| format!("The run with {} fed forward did not come to its end", run.model));
        remarks(&self.metrics.forward.windows)
            .into_iter()
            .chain(stopped)
            .map(|said| said + ".")
            .collect()
    }
}

/// A column whose cells stand to the left.
fn left_column(header: &str, cells: Vec<String>) -> GridColumn {
    let width = cells.iter().map(|cell| cell.chars().count()).max().unwrap_or(0);
    let width = width.max(header.chars().count());
    let fill = |text: &str| format!("{text:<width$}");
    GridColumn { header: fill(header), cells: cells.iter().map(|c| Cell::plain(fill(c))).collect() }
}

/// Two numbers, the second of which stands in a column of its own.
fn pair([before, after]: [f64; 2]) -> String {
    format!("{} -> {:>8}", significant(before, TABLE_DIGITS), significant(after, TABLE_DIGITS))
}

#[cfg(test)]
mod tests {
    use experiment::{Claim, ClaimCase, Scope};

    use crate::run::sample;
    use pages::without_escapes;

    #[test]
    fn the_text_tells_what_was_put_in_what_was_found_and_what_that_gains() {
        let text = without_escapes(&sample::run().report().text());
        let row = |start: &str| {
            let row = text.lines().find(|line| line.starts_with(start));
            row.unwrap_or_else(|| panic!("{start} is missing: {text}"))
                .split_whitespace()
                .collect::<Vec<_>>()
                .join(" ")
        };
        assert!(text.starts_with("Partly explained: "), "{text}");
        row("1 of 2 effects that were put in were found.");
        assert_eq!(row("FR02"), "FR02 Coulomb friction at shoulder found, 41 % of the gap");
        assert_eq!(row("  level"), "level 2.10 N·m 2.00 (1.80 to 2.20)");
        assert_eq!(row("IN01"), "IN01 payload at <elbow> not found, 60 % of the detectable size");
        assert_eq!(row("Named"), "Named, but not put in: TR01 backlash at elbow");
        // The root of 0.3² + 0.4².
        assert_eq!(
            row("torque error"),
            "torque error, RMS over all joints 0.500 N·m 0.0500 N·m 10x"
        );
        assert_eq!(row("drift of"), "drift of the simulated tip in 200 ms 40.0 mm 2.00 mm 20x");
        assert_eq!(row("tracking"), "tracking error of the tip, gains low 30.0 mm 1.00 mm 30x");
        assert_eq!(row("shoulder"), "shoulder 0.0900 -> 0.000900 80.0 -> 4.00 30.0 -> 1.00");
        assert_eq!(row("elbow"), "elbow - -> - 40.0 -> 2.00 15.0 -> 0.500");
        row("The run with gp fed forward did not come to its end.");
        assert!(!text.contains("holds"), "{text}");
    }

    #[test]
    fn claims_about_the_tracking_are_told_in_thousandths() {
        let mut sample = sample::run();
        let case = ClaimCase::beside(
            ("gp-rbd", Some(0.004)),
            ("rbd", Some(0.002)),
            "shoulder",
            (1.0, 0.0),
        );
        sample.metrics.claims = vec![Claim::new("it is closer", Scope::Every, vec![case])];
        let text = without_escapes(&sample.report().text());
        let text = text.split_whitespace().collect::<Vec<_>>().join(" ");
        assert!(text.contains("does not hold: it is closer (in 0 of 1 case, not gp-rbd at shoulder: 4.00 mrad, 2.00 times the 2.00 mrad of rbd)."), "{text}");
        let page = sample.report().page().unwrap();
        assert!(page.contains("it is closer") && page.contains("tracking/report.html"));
    }
}
