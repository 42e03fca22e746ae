use crate::alarms::alarm::Alarm;
use crate::alarms::alarm_ledger::AlarmLedger;
use crate::alarms::alarm_row::AlarmRow;
use crate::alarms::false_name::FalseName;
use crate::statistics::text_table::TextTable;

impl AlarmLedger {
    /// The tables, each after a blank line; nothing without clean logs.
    pub fn text(&self) -> String {
        let tables = self.tables().into_iter().filter(|table| !table.rows.is_empty());
        tables.map(|table| format!("\n{}", table.text(1))).collect()
    }

    /// Alarms by property, false names by kind, and the alarms one by one.
    pub fn tables(&self) -> [TextTable; 3] {
        let header = ["clean logs", "trials", "alarms", "false names", "unexplained", "refused"];
        let title = "false alarms, with 95 % score intervals (%)";
        let rows = table(title, &header, self.rows.iter().map(row_cells).collect());
        let count = |name: &FalseName| vec![name.effect.clone(), name.trials.to_string()];
        let names = self.names.iter().map(count).collect();
        let names = table("false names in clean logs", &["effect", "trials"], names);
        let header = ["seed", "made by", "corner", "verdict", "named"];
        let alarms = self.alarms.iter().map(alarm_cells).collect();
        [rows, names, table("the alarms", &header, alarms)]
    }
}

fn row_cells(row: &AlarmRow) -> Vec<String> {
    let shares = [row.alarms, row.named, row.unexplained, row.refused];
    let mut cells = vec![row.logs.clone(), row.alarms.of.to_string()];
    cells.extend(shares.map(|share| share.words()));
    cells
}

fn alarm_cells(alarm: &Alarm) -> Vec<String> {
    let Alarm { arm, motion, joints, rate_hz, encoder_bits, effort, .. } = alarm;
    let corner = format!("{arm}-{joints} {motion} {rate_hz} Hz {encoder_bits} bits {effort}");
    let more = alarm.names.len().saturating_sub(1);
    let more = if more > 0 { format!(" + {more}") } else { String::new() };
    let first = alarm.names.first().map_or("-", String::as_str);
    vec![
        alarm.seed.to_string(),
        alarm.origin.name().replace('_', " "),
        corner.replace('_', " "),
        alarm.verdict.to_owned(),
        format!("{first}{more}"),
    ]
}

fn table(title: &str, header: &[&str], rows: Vec<Vec<String>>) -> TextTable {
    let header = header.iter().map(|name| (*name).to_owned()).collect();
    TextTable { title: title.to_owned(), header, rows }
}
