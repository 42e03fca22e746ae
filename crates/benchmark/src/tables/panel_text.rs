use crate::panel::judged_spoiling::SpoilingOutcome;
use crate::statistics::share::Share;
use crate::statistics::text_table::TextTable;
use crate::tables::kind_row::KindRow;
use crate::tables::panel_row::{Naming, PanelRow};
use crate::tables::panel_tally::PanelTally;
use crate::tables::slow_diagnosis::SlowDiagnosis;
use crate::tables::spoiling_row::SpoilingRow;
use crate::tables::stranger_row::StrangerRow;

/// Text in place of a missing number.
const NONE: &str = "-";

impl PanelTally {
    /// The tables within 120 columns.
    pub fn text(&self) -> String {
        let tables = self.tables().into_iter().filter(|table| !table.rows.is_empty());
        tables.map(|table| table.text(1)).collect::<Vec<_>>().join("\n")
    }

    /// Names, verdicts, prediction, cost, names of plain least squares, sizes and reasons, kinds of causes, sizes by kind,
    /// effects of no catalogue, spoilt logs, the slowest diagnoses.
    pub fn tables(&self) -> [TextTable; 11] {
        [
            self.names(),
            self.verdicts(),
            self.predictions(),
            self.costs(),
            self.by_hand(),
            self.answers(),
            self.by_kind(),
            self.sizes_by_kind(),
            self.by_stranger(),
            self.by_spoiling(),
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
                "spoilt",
                "hiding",
                "false assurance",
                "clean",
                "false alarm",
            ],
            |row| {
                vec![
                    row.refused.to_string(),
                    row.spoilt.to_string(),
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
            "of joints",
            "worse than by hand",
            "of joints",
            "extended",
            "by hand",
        ];
        self.of_rows(
            "held-out torque worse than as described and than plain least squares (%), median error over that as described",
            &header,
            |row| {
                vec![
                    row.worse.words(),
                    row.worse_joints.words(),
                    row.worse_than_by_hand.words(),
                    row.joints_worse_than_by_hand.words(),
                    number(row.ratios.extended, 2),
                    number(row.ratios.least_squares, 2),
                ]
            },
        )
    }

    fn costs(&self) -> TextTable {
        let header = ["trials that are", "trials", "median s", "90 % s", "logs s", "MB"];
        self.of_rows("cost of a diagnosis", &header, |row| {
            let times = [row.median_s, row.nine_of_ten_s, row.logs_s];
            let times = times.map(|time| number(time, 1)).into_iter();
            times.chain([number(row.peak_memory_mb, 0)]).collect()
        })
    }

    fn by_hand(&self) -> TextTable {
        self.of_rows(
            "names of plain least squares, with 95 % intervals over trials (%)",
            &["trials that are", "trials", "precision", "recall"],
            |row| cells(&row.least_squares),
        )
    }

    fn answers(&self) -> TextTable {
        let header = [
            "trials that are",
            "trials",
            "sizes told",
            "width",
            "covered",
            "kg off",
            "ruled out",
            "contradicting",
        ];
        self.of_rows(
            "sizes, bodies and reasons, with 95 % intervals over trials (%)",
            &header,
            |row| {
                vec![
                    row.sizes_told.words(),
                    per_cent(row.sharpness),
                    row.covered.words(),
                    row.bodies_off.words(),
                    row.ruled_out.words(),
                    row.contradicting.words(),
                ]
            },
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
            vec![
                row.kind.clone(),
                row.visible.to_string(),
                row.named.words(),
                row.ruled_out.words(),
                row.least_squares.words(),
                row.false_findings.to_string(),
            ]
        };
        let header = ["cause", "visible", "named", "ruled out", "least squares", "false"];
        let title = "visible causes that are named, and false findings";
        table(title, &header, self.kinds.iter().map(row).collect())
    }

    fn sizes_by_kind(&self) -> TextTable {
        let told = |row: &&KindRow| row.told.items > 0;
        let row = |row: &KindRow| {
            vec![
                row.kind.clone(),
                row.told.items.to_string(),
                row.told.words(),
                per_cent(row.sharpness),
                row.bodies_off.words(),
                row.sizes.determined.to_string(),
                per_cent(row.sizes.median_error),
                row.sizes.covered.words(),
            ]
        };
        let header =
            ["finding", "findings", "size told", "width", "kg off", "sizes", "error", "covered"];
        let title = "sizes that are told, and their errors where a finding names a visible cause";
        table(title, &header, self.kinds.iter().filter(told).map(row).collect())
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

    fn by_spoiling(&self) -> TextTable {
        let row = |row: &SpoilingRow| {
            let mut cells = vec![row.name.clone(), row.taken_in.of.to_string()];
            cells.extend(row.shares().iter().map(Share::words));
            cells
        };
        let outcomes = SpoilingOutcome::ALL.map(|outcome| outcome.to_string());
        let mut header = vec!["spoilt logs", "trials"];
        header.extend(outcomes.iter().map(String::as_str));
        let title = "logs that are spoilt so that an oracle sees it (%)";
        table(title, &header, self.spoilings.iter().map(row).collect())
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

/// A share with one decimal, in per cent.
fn per_cent(share: Option<f64>) -> String {
    share.map_or(NONE.to_owned(), |share| format!("{:.1} %", 100.0 * share))
}

fn table(title: &str, header: &[&str], rows: Vec<Vec<String>>) -> TextTable {
    let header = header.iter().map(|name| (*name).to_owned()).collect();
    TextTable { title: title.to_owned(), header, rows }
}
