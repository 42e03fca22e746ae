use crate::cause_bench::replay_drift::REPLAY_TIMES_MS;
use crate::cause_bench::score_row::ScoreRow;
use crate::cause_bench::scores::BenchScores;
use crate::statistics::text_table::TextTable;

impl BenchScores {
    /// The tasks, each with its interval, then some by arm, motion and effort.
    pub fn text(&self) -> String {
        let all = self.rows.first().map(tasks).unwrap_or_default();
        let title =
            format!("{} of {}: task, number with its 95 % interval", self.entrant, self.set.name());
        let by_task = TextTable { title, header: words(&["task", "number", "of"]), rows: all };
        let side = |row: &ScoreRow| {
            let count = row.count.to_string();
            let rates = [&row.name, &row.size].map(|rate| rate.words());
            let [name, size] = rates;
            vec![row.trials.clone(), count, name, size, row.predict.words(), row.abstain.words()]
        };
        let by_side = TextTable {
            title: "by property of the trials".to_owned(),
            header: words(&["trials", "", "name", "size", "predict", "abstain"]),
            rows: self.rows.iter().map(side).collect(),
        };
        format!("{}\n{}", by_task.text(2), by_side.text(2))
    }
}

/// The tasks of a row: what they are, the number, and of how many.
fn tasks(row: &ScoreRow) -> Vec<Vec<String>> {
    let rates = [
        ("name: F1 of visible causes", &row.name, "names and causes"),
        ("  names that are true", &row.true_names, "names"),
        ("  visible causes named", &row.named, "causes"),
        ("size: inside the interval", &row.size, "sizes"),
        ("abstain: held back rightly", &row.abstain, "trials"),
    ];
    let rates = rates
        .map(|(task, rate, of)| [task.to_owned(), rate.words(), format!("{} {of}", rate.items)]);
    let replay = REPLAY_TIMES_MS.iter().zip(&row.replay).map(|(ms, drift)| {
        [
            format!("replay: drift after {ms} ms (rad)"),
            drift.words(),
            format!("{} trials", drift.of),
        ]
    });
    let middles = [
        ("  width over value", &row.sharpness, "names"),
        ("predict: nMSE of efforts", &row.predict, "trials"),
        ("cost: processor time (s)", &row.cost_s, "trials"),
    ];
    let middles = middles
        .map(|(task, number, of)| [task.to_owned(), number.words(), format!("{} {of}", number.of)]);
    let [name, true_names, named, size, abstain] = rates;
    let [width, predict, cost] = middles;
    let first = [name, true_names, named, size, width, predict].into_iter();
    first.chain(replay).chain([abstain, cost]).map(Vec::from).collect()
}

fn words(all: &[&str]) -> Vec<String> {
    all.iter().map(|word| (*word).to_owned()).collect()
}
