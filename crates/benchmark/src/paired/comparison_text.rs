use crate::paired::comparison::PairedComparison;
use crate::paired::paired_mean::PairedMean;
use crate::paired::paired_share::PairedShare;
use crate::paired::turned::Turned;
use crate::statistics::text_table::TextTable;

impl PairedComparison {
    /// Counts, tables within 100 columns, and one line for each trial with different answers.
    pub fn text(&self) -> String {
        let campaign = self.campaign.get(..8).unwrap_or(&self.campaign);
        let mut text = format!("{} trials of campaign {campaign} in both\n", self.pairs);
        for (count, words) in self.alone.iter().zip(["first", "second"]) {
            if *count > 0 {
                text.push_str(&format!("{count} in the {words} alone, which do not count\n"));
            }
        }
        for (count, words) in self.failed.iter().zip(["first", "second"]) {
            if *count > 0 {
                text.push_str(&format!("{count} failed in the {words}, which is not right\n"));
            }
        }
        for table in self.tables().iter().filter(|table| !table.rows.is_empty()) {
            text.push_str(&format!("\n{}", table.text(1)));
        }
        text.push_str(&format!("\n{}\n", self.turns()));
        self.turned
            .iter()
            .for_each(|turned| text.push_str(&format!(" {}\n", Turned::words(turned))));
        text
    }

    /// The table of yes-or-no measures and the table of numeric ones.
    pub fn tables(&self) -> [TextTable; 2] {
        [self.answers(), self.numbers()]
    }

    fn turns(&self) -> String {
        match self.turned.len() {
            0 => "no trial turned".to_owned(),
            1 => "1 trial turned, the second being".to_owned(),
            turned => format!("{turned} trials turned, the second being"),
        }
    }

    fn answers(&self) -> TextTable {
        let row = |share: &PairedShare| {
            let of = |count: usize| format!("{count}");
            vec![
                share.measure.to_string(),
                share.trials.to_string(),
                of(share.first),
                of(share.second),
                share.wins.to_string(),
                share.losses.to_string(),
                share.ties().to_string(),
                share.difference.map_or("-".to_owned(), |d| format!("{:+.1} %", 100.0 * d)),
                ends(share.interval.map(|ends| ends.map(|end| 100.0 * end)), 1),
                format!("{:.3}", share.p),
            ]
        };
        let header =
            ["", "trials", "first", "second", "wins", "losses", "ties", "gain", "95 %", "p"];
        TextTable {
            title: "the second against the first, trial by trial (exact McNemar test)".to_owned(),
            header: header.map(str::to_owned).to_vec(),
            rows: self.shares.iter().map(row).collect(),
        }
    }

    fn numbers(&self) -> TextTable {
        let row = |mean: &PairedMean| {
            let unit = if mean.quantity.is_factor() { "x" } else { "" };
            let sign = |number: f64| match mean.quantity.is_factor() {
                true => format!("{number:.3}{unit}"),
                false => format!("{number:+.3}"),
            };
            vec![
                mean.quantity.to_string(),
                mean.trials.to_string(),
                format!("{:.3}", mean.first),
                format!("{:.3}", mean.second),
                sign(mean.difference),
                ends(mean.interval, 3),
            ]
        };
        let header = ["", "trials", "first", "second", "change", "95 %"];
        TextTable {
            title: "means over the trials that have both; errors and times as factors".to_owned(),
            header: header.map(str::to_owned).to_vec(),
            rows: self.means.iter().map(row).collect(),
        }
    }
}

fn ends(interval: Option<[f64; 2]>, decimals: usize) -> String {
    interval.map_or("-".to_owned(), |[low, high]| format!("{low:.decimals$} to {high:.decimals$}"))
}
