//! Names of joints that the rows of a table list beside their numbers.

/// A column that holds the name of an entry, the same in every row.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct ListedName {
    /// Place of the column, counted from 0.
    pub column: usize,
    /// The name, as in the first row.
    pub name: String,
}

/// Columns such as `field.name0`, where the first row has a name, and not a number, in them.
///
/// `rostopic echo -p` writes a list `L` of a message as the columns `L0`, `L1` and so on.
pub(crate) fn listed_names(columns: &[String], first: &[String]) -> Vec<ListedName> {
    let listed = columns.iter().zip(first).enumerate().filter(|(_, (column, name))| {
        let stem = column.trim_end_matches(|c: char| c.is_ascii_digit());
        let is_name = stem.len() < column.len() && (stem == "name" || stem.ends_with(".name"));
        is_name && !name.is_empty() && name.parse::<f64>().is_err()
    });
    listed.map(|(column, (_, name))| ListedName { column, name: name.clone() }).collect()
}

/// The columns with the name of an entry in place of its number: `field.position0` becomes `field.position[elbow]`
/// where `field.name0` holds `elbow`.
pub(crate) fn with_names(columns: &[String], listed: &[ListedName]) -> Vec<String> {
    let mut named = columns.to_vec();
    for ListedName { column, name } in listed {
        let list = columns[*column].trim_end_matches(|c: char| c.is_ascii_digit());
        let (number, message) =
            (&columns[*column][list.len()..], &list[..list.len() - "name".len()]);
        for (k, own) in columns.iter().enumerate().filter(|(k, _)| k != column) {
            let entry = own.strip_prefix(message).and_then(|own| own.strip_suffix(number));
            let is_list = |list: &str| {
                !list.is_empty()
                    && !list.contains('.')
                    && !list.ends_with(|c: char| c.is_ascii_digit())
            };
            if let Some(list) = entry.filter(|list| is_list(list)) {
                named[k] = format!("{message}{list}[{name}]");
            }
        }
    }
    named
}

#[cfg(test)]
mod tests {
    use super::*;

    fn owned(names: &[&str]) -> Vec<String> {
        names.iter().map(|name| (*name).to_owned()).collect()
    }

    #[test]
    fn entries_take_the_names_that_their_rows_list() {
        let columns = ["time", "f.name0", "f.name1", "f.q0", "f.q1", "f.q10", "f.x.q0", "name2"];
        let (columns, first) = (owned(&columns), owned(&["1", "a", "b", "2", "3", "4", "5", "7"]));
        let listed = listed_names(&columns, &first);
        assert_eq!(listed.iter().map(|l| l.column).collect::<Vec<_>>(), [1, 2]);
        let expected =
            ["time", "f.name0", "f.name1", "f.q[a]", "f.q[b]", "f.q10", "f.x.q0", "name2"];
        assert_eq!(with_names(&columns, &listed), expected);
    }
}
