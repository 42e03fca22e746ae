use crate::statistics::text_table::TextTable;
use crate::tables::kind_row::KindRow;
use crate::tables::panel_row::{Naming, PanelRow};
use crate::tables::panel_tally::PanelTally;
use crate::tables::slow_diagnosis::SlowDiagnosis;
use crate::tables::stranger_row::StrangerRow;

/// Text in place of a missing number.
const NONE: &str = "-";

impl PanelTally {
    /// The tables within 120 columns.
    pub fn text(&self) -> String {
        let tables = self.tables().into_iter().filter(|table| !table.rows.is_empty());
        tables.map(|table| table.text(1)).collect::<Vec<_>>().join("\n")
    }

    /// Names, verdicts, prediction and cost, baselines, kinds of causes, effects of no catalogue, the
    /// slowest diagnoses.
    pub fn tables(&self) -> [TextTable; 7] {
        [
            self.names(),
            self.verdicts(),
            self.predictions(),
            self.baselines(),
            self.by_kind(),
            self.by_stranger(),
            self.by_time(),
        ]
    }

    fn names(&self) -> TextTable {
        let header = ["trials that are", "trials", "precision", "recall"];
        let by_torque = ["precision by torque", "recall by torque"];
        self.of_rows(
            "names of the diagnosis, with 95 % intervals over trials (%)",
            &[&header[..], &by_torque].concat(),
            |row| [cells(&row.named), cells(&row.named_by_torque)].concat(),
        )
    }

    fn verdicts(&self) -> TextTable {
        self.of_rows(
            "verdicts, with 95 % score intervals (%)",
            &[
                "trials that are",
                "trials",
                "refused",
                "hiding",
                "false assurance",
                "clean",
                "false alarm",
            ],
            |row| {
                vec![
                    row.refused.to_string(),
                    row.false_assurance.of.to_string(),
                    row.false_assurance.words(),
                    row.false_alarm.of.to_string(),
                    row.false_alarm.words(),
                ]
            },
        )
    }

    fn predictions(&self) -> TextTable {
        let header = [
            "trials that are",
            "trials",
            "worse",
            "extended",
            "least squares",
            "two questions",
            "median s",
            "90 % s",
            "logs s",
            "MB",
        ];
        self.of_rows(
            "median error of held-out torque over that of the robot as described, and cost of a diagnosis",
            &header,
            |row| {
                let ratios = [
                    row.ratios.extended,
                    row.ratios.least_squares,
                    row.ratios.two_questions,
                ];
                let times = [row.median_s, row.nine_of_ten_s, row.logs_s];
                let mut cells = vec![row.worse.words()];
                cells.extend(ratios.map(|ratio| number(ratio, 2)));
                cells.extend(times.map(|time| number(time, 1)));
                cells.push(number(row.peak_memory_mb, 0));
                cells
            },
        )
    }

    fn baselines(&self) -> TextTable {
        let header = [
            "trials that are",
            "trials",
            "2 questions: precision",
            "recall",
            "least squares: precision",
            "recall",
        ];
        self.of_rows(
            "names of the baselines, with 95 % intervals over trials (%)",
            &header,
            |row| [cells(&row.two_questions), cells(&row.least_squares)].concat(),
        )
    }

    fn of_rows(
        &self,
        title: &str,
        header: &[&str],
        cells: impl Fn(&PanelRow) -> Vec<String>,
    ) -> TextTable {
        let row = |row: &PanelRow| {
            let mut all = vec![row.side.to_string(), row.trials.to_string()];
            all.extend(cells(row));
            all
        };
        table(title, header, self.rows.iter().map(row).collect())
    }

    fn by_kind(&self) -> TextTable {
        let row = |row: &KindRow| {
            let error = row.sizes.median_error.map(|error| 100.0 * error);
            vec![
                row.kind.clone(),
                row.visible.to_string(),
                row.named.words(),
                row.two_questions.words(),
                row.least_squares.words(),
                row.false_findings.to_string(),
                error.map_or(NONE.to_owned(), |error| format!("{error:.1} %")),
                row.sizes.covered.words(),
            ]
        };
        let header = [
            "cause",
            "visible",
            "named",
            "2 questions",
            "least squares",
            "false",
            "error",
            "covered",
        ];
        let title =
            "visible causes that are named, false findings, and sizes where a finding names it";
        table(title, &header, self.kinds.iter().map(row).collect())
    }

    fn by_stranger(&self) -> TextTable {
        let row = |row: &StrangerRow| {
            vec![
                row.name.replace('_', " "),
                row.trials.to_string(),
                row.open.of.to_string(),
                row.open.words(),
                row.assured.words(),
                row.misnamed.words(),
            ]
        };
        let header =
            ["stranger", "trials", "visible", "left open", "consistent or explained", "misnamed"];
        let title = "effects of no catalogue that an oracle sees (%)";
        table(title, &header, self.strangers.iter().map(row).collect())
    }

    fn by_time(&self) -> TextTable {
        let row = |slow: &SlowDiagnosis| {
            vec![
                slow.seed.to_string(),
                slow.corner.clone(),
                slow.joints.to_string(),
                slow.logs.to_string(),
                format!("{:.0}", slow.samples),
                slow.findings.to_string(),
                format!("{:.1}", slow.time_s),
            ]
        };
        let header = ["seed", "corner", "joints", "logs", "samples", "findings", "s"];
        let title = "the ten slowest diagnoses, and all over 60 s";
        table(title, &header, self.slowest.iter().map(row).collect())
    }
}

fn cells(naming: &Naming) -> Vec<String> {
    vec![naming.precision.words(), naming.recall.words()]
}

fn number(number: Option<f64>, decimals: usize) -> String {
    number.map_or(NONE.to_owned(), |number| format!("{number:.decimals$}"))
}

fn table(title: &str, header: &[&str], rows: Vec<Vec<String>>) -> TextTable {
    let header = header.iter().map(|name| (*name).to_owned()).collect();
    TextTable { title: title.to_owned(), header, rows }
}
