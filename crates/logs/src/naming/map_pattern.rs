use crate::naming::map_entry::{MappedColumn, Names, Numbers, Pattern};

impl Pattern {
    /// The column of each of `joints`, in the order of `joints`.
    ///
    /// ```text
    /// {i}      0, 1, ...        {n}  1, 2, ...       {joint}  the joint's name
    /// q[2:8]   q[2] to q[7]     q[:] q[0] and on
    /// ```
    ///
    /// # Errors
    ///
    /// The value found and the value expected, in words.
    pub fn columns(&self, joints: &[String]) -> Result<Vec<MappedColumn>, String> {
        let count = joints.len();
        let names = self.names(joints)?;
        let of = |numbers: &Numbers, what: &str| match numbers {
            Numbers::All(value) => Ok(vec![*value; count]),
            Numbers::Each(list) if list.len() == count => Ok(list.clone()),
            Numbers::Each(list) => Err(format!(
                "{what} has {} numbers, one or {count} were expected, one a joint",
                list.len()
            )),
        };
        let (scales, offsets) = (of(&self.scale, "scale")?, of(&self.offset, "offset")?);
        let numbers = scales.into_iter().zip(offsets);
        let columns = names.into_iter().zip(numbers).map(|(column, (scale, offset))| {
            MappedColumn { column, unit: self.unit, scale, offset }
        });
        Ok(columns.collect())
    }

    fn names(&self, joints: &[String]) -> Result<Vec<String>, String> {
        let count = joints.len();
        let pattern = match &self.column {
            Names::Each(list) if list.len() == count => return Ok(list.clone()),
            Names::Each(list) => {
                let found = list.len();
                return Err(format!(
                    "{found} columns were found, {count} were expected, one a joint"
                ));
            }
            Names::Pattern(pattern) => pattern,
        };
        if let Some((name, first, end)) = slice(pattern) {
            if end.is_some_and(|end| end.checked_sub(first) != Some(count)) {
                return Err(format!("{pattern} has not {count} entries, one a joint was expected"));
            }
            return Ok((0..count).map(|i| format!("{name}[{}]", first + i)).collect());
        }
        let has_place = ["{i}", "{n}", "{joint}"].iter().any(|place| pattern.contains(place));
        if !has_place && count > 1 {
            return Err(format!(
                "{pattern:?} is one column for {count} joints, {{i}} (from 0), {{n}} (from 1) or \
                 {{joint}} was expected in it"
            ));
        }
        let name = |(i, joint): (usize, &String)| {
            let counted =
                pattern.replace("{i}", &i.to_string()).replace("{n}", &(i + 1).to_string());
            counted.replace("{joint}", joint)
        };
        Ok(joints.iter().enumerate().map(name).collect())
    }
}

/// Name, first index and end of `name[first:end]`.
fn slice(text: &str) -> Option<(&str, usize, Option<usize>)> {
    let (name, range) = text.strip_suffix(']')?.rsplit_once('[')?;
    let (first, end) = range.split_once(':')?;
    let number = |text: &str| text.trim().parse::<u16>().ok().map(usize::from);
    let first = if first.trim().is_empty() { 0 } else { number(first)? };
    let end = if end.trim().is_empty() { None } else { Some(number(end)?) };
    Some((name, first, end))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn columns(pattern: &str) -> Result<Vec<String>, String> {
        let joints = ["a", "b", "c"].map(str::to_owned);
        let columns = Pattern::from(Names::Pattern(pattern.to_owned())).columns(&joints)?;
        Ok(columns.into_iter().map(|c| c.column).collect())
    }

    #[test]
    fn a_pattern_is_a_column_a_joint() {
        assert_eq!(columns("q_{i}").unwrap(), ["q_0", "q_1", "q_2"]);
        assert_eq!(columns("q{n}").unwrap(), ["q1", "q2", "q3"]);
        assert_eq!(columns("/{joint}/x").unwrap(), ["/a/x", "/b/x", "/c/x"]);
        assert_eq!(columns("q[2:5]").unwrap(), ["q[2]", "q[3]", "q[4]"]);
        assert_eq!(columns("q[:]").unwrap(), ["q[0]", "q[1]", "q[2]"]);
        assert_eq!(columns("q[{i}]").unwrap(), ["q[0]", "q[1]", "q[2]"]);
    }

    #[test]
    fn a_pattern_that_does_not_fit_is_refused() {
        assert!(columns("q").unwrap_err().contains("one column for 3 joints"));
        assert!(columns("q[2:8]").unwrap_err().contains("has not 3 entries"));
        assert!(columns("q[8:2]").unwrap_err().contains("has not 3 entries"));
        let list = Pattern::from(Names::Each(vec!["x".to_owned()]));
        let message = list.columns(&["a".to_owned(), "b".to_owned()]).unwrap_err();
        assert_eq!(message, "1 columns were found, 2 were expected, one a joint");
    }
}
