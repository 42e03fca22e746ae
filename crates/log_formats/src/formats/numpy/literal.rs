/// A value in a NumPy header, in Python syntax.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) enum Literal {
    Text(String),
    Count(u64),
    Truth(bool),
    /// A list or a tuple.
    Sequence(Vec<Literal>),
    /// A dictionary with texts as keys.
    Table(Vec<(String, Literal)>),
}

/// Most levels of nested brackets that are parsed. NumPy writes at most six.
const DEEPEST: usize = 12;

impl Literal {
    /// The value in a text; `None` where the text holds anything else.
    pub(crate) fn parse(text: &str) -> Option<Self> {
        let mut parser = Parser { rest: text };
        let value = parser.value(DEEPEST)?;
        parser.rest.trim().is_empty().then_some(value)
    }

    /// The value of a key in a dictionary.
    pub(crate) fn get(&self, key: &str) -> Option<&Self> {
        let Self::Table(entries) = self else { return None };
        entries.iter().find(|(name, _)| name == key).map(|(_, value)| value)
    }
}

struct Parser<'a> {
    rest: &'a str,
}

impl Parser<'_> {
    fn value(&mut self, depth: usize) -> Option<Literal> {
        let depth = depth.checked_sub(1)?;
        if let Some(quote) = ['\'', '"'].into_iter().find(|&quote| self.eat(quote)) {
            return Some(Literal::Text(self.text(quote)?));
        }
        for (open, close) in [('(', ')'), ('[', ']')] {
            if self.eat(open) {
                return Some(Literal::Sequence(self.items(close, |p| p.value(depth))?));
            }
        }
        if self.eat('{') {
            return Some(Literal::Table(self.items('}', |p| p.entry(depth))?));
        }
        for (word, truth) in [("True", true), ("False", false)] {
            if let Some(rest) = self.rest.strip_prefix(word) {
                self.rest = rest;
                return Some(Literal::Truth(truth));
            }
        }
        let end = self.rest.find(|c: char| !c.is_ascii_digit()).unwrap_or(self.rest.len());
        let (digits, rest) = self.rest.split_at(end);
        // Python 2 marked long numbers.
        self.rest = rest.strip_prefix('L').unwrap_or(rest);
        digits.parse().ok().map(Literal::Count)
    }

    fn entry(&mut self, depth: usize) -> Option<(String, Literal)> {
        let Literal::Text(key) = self.value(depth)? else { return None };
        self.eat(':').then_some(())?;
        Some((key, self.value(depth)?))
    }

    fn items<T>(&mut self, close: char, item: impl Fn(&mut Self) -> Option<T>) -> Option<Vec<T>> {
        let mut items = Vec::new();
        while !self.eat(close) {
            items.push(item(self)?);
            if !self.eat(',') {
                return self.eat(close).then_some(items);
            }
        }
        Some(items)
    }

    /// The text before the closing quote. A backslash escapes quotes and itself.
    fn text(&mut self, quote: char) -> Option<String> {
        let mut text = String::new();
        let mut characters = self.rest.chars();
        loop {
            match characters.next()? {
                end if end == quote => break,
                '\\' => text.push(characters.next().filter(|c| ['\\', '\'', '"'].contains(c))?),
                other => text.push(other),
            }
        }
        self.rest = characters.as_str();
        Some(text)
    }

    fn eat(&mut self, expected: char) -> bool {
        self.rest = self.rest.trim_start();
        let after = self.rest.strip_prefix(expected);
        self.rest = after.unwrap_or(self.rest);
        after.is_some()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_header_is_parsed() {
        let header = "{'descr': [('it\\'s', \"<f8\", (2,)), ], 'shape': (600L, 6), 'x': (), 'fortran_order': False, }  \n";
        let header = Literal::parse(header).unwrap();
        let count = |n: u64| Literal::Count(n);
        let text = |t: &str| Literal::Text(t.to_owned());
        assert_eq!(header.get("shape"), Some(&Literal::Sequence(vec![count(600), count(6)])));
        assert_eq!(header.get("x"), Some(&Literal::Sequence(Vec::new())));
        assert_eq!(header.get("fortran_order"), Some(&Literal::Truth(false)));
        let field =
            Literal::Sequence(vec![text("it's"), text("<f8"), Literal::Sequence(vec![count(2)])]);
        assert_eq!(header.get("descr"), Some(&Literal::Sequence(vec![field])));
        assert_eq!(header.get("y"), None);
    }

    #[test]
    fn what_is_no_header_is_none_and_brackets_are_followed_so_far() {
        for text in ["", "{", "{'a' 1}", "{1: 2}", "(1 2)", "'a", "'a\\", "1 2", "-1", "None", "é"]
        {
            assert_eq!(Literal::parse(text), None, "{text}");
        }
        assert_eq!(Literal::parse("99999999999999999999"), None);
        assert_eq!(Literal::parse(&"(".repeat(60_000)), None);
        let nested = |n: usize| format!("{}{}", "(".repeat(n), ")".repeat(n));
        assert!(Literal::parse(&nested(DEEPEST)).is_some());
        assert_eq!(Literal::parse(&nested(DEEPEST + 1)), None);
    }
}
