/// Names of columns of time, without capitals.
const TIMES: [&str; 8] = [
    "time",
    "t",
    "timestamp",
    "__time",
    "field.header.stamp",
    "time_s",
    "stamp",
    "rosbagtimestamp",
];

/// The columns that are time by their name, the most usual name first.
pub(crate) fn times(names: &[String]) -> impl Iterator<Item = &String> {
    TIMES.iter().flat_map(|time| names.iter().filter(move |name| name.to_lowercase() == *time))
}

/// The only column that is time by its name, where none is called `usual`.
pub(crate) fn other_time(names: &[String], usual: &str) -> Option<String> {
    let mut found = times(names);
    match (found.next(), found.next()) {
        (Some(name), None) if name != usual => Some(name.clone()),
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn time_has_another_name_where_one_column_has_it() {
        let other = |names: &[&str]| {
            other_time(&names.iter().map(|name| (*name).to_owned()).collect::<Vec<_>>(), "time")
        };
        assert_eq!(other(&["q", "Time"]), Some("Time".to_owned()));
        assert_eq!(other(&["timestamp", "q"]), Some("timestamp".to_owned()));
        for names in [&["time", "q"][..], &["time", "t"], &["t", "stamp"], &["q", "tau"]] {
            assert_eq!(other(names), None, "{names:?}");
        }
    }
}
