//! The statement that made a table of SQLite.

use std::iter::Peekable;
use std::str::Chars;

/// Words with which a constraint of the whole table begins; behind them stand no further columns.
const CONSTRAINTS: [&str; 5] = ["constraint", "primary", "unique", "check", "foreign"];

/// A part of a statement.
#[derive(Debug, PartialEq)]
enum Token {
    /// A name or a keyword, or what stands in quotes: `"name"`, `[name]`, `` `name` ``, `'text'`.
    Word {
        text: String,
        is_quoted: bool,
    },
    Open,
    Close,
    Comma,
}

/// The column names in a statement `CREATE TABLE name(column type, ...)`, in lower case as SQLite compares them.
pub(crate) fn columns(sql: &str) -> Vec<String> {
    let (mut names, mut depth, mut is_first) = (Vec::new(), 0_usize, false);
    let mut rest = sql.chars().peekable();
    while let Some(token) = token(&mut rest) {
        let is_name = depth == 1 && is_first;
        is_first = false;
        match token {
            Token::Open => {
                depth += 1;
                is_first = depth == 1;
            }
            Token::Close => depth = depth.saturating_sub(1),
            Token::Comma => is_first = depth == 1,
            Token::Word { text, is_quoted } if is_name => {
                let name = text.to_ascii_lowercase();
                if !is_quoted && CONSTRAINTS.contains(&name.as_str()) {
                    break;
                }
                names.push(name);
            }
            Token::Word { .. } => {}
        }
    }
    names
}

/// The next part of a statement, behind blanks and comments.
fn token(rest: &mut Peekable<Chars>) -> Option<Token> {
    loop {
        return Some(match rest.next()? {
            '(' => Token::Open,
            ')' => Token::Close,
            ',' => Token::Comma,
            '[' => Token::Word {
                text: rest.by_ref().take_while(|c| *c != ']').collect(),
                is_quoted: true,
            },
            quote @ ('"' | '`' | '\'') => {
                Token::Word { text: quoted_text(rest, quote), is_quoted: true }
            }
            '-' if rest.peek() == Some(&'-') => {
                rest.by_ref().find(|c| *c == '\n')?;
                continue;
            }
            '/' if rest.peek() == Some(&'*') => {
                rest.next();
                let mut last = ' ';
                rest.by_ref().find(|c| std::mem::replace(&mut last, *c) == '*' && *c == '/')?;
                continue;
            }
            c if is_of_name(c) => {
                let mut text = String::from(c);
                while let Some(c) = rest.next_if(|c| is_of_name(*c)) {
                    text.push(c);
                }
                Token::Word { text, is_quoted: false }
            }
            _ => continue,
        });
    }
}

/// What stands in quotes, of which the first is read already; two of them in a row are one of the text.
fn quoted_text(rest: &mut Peekable<Chars>, quote: char) -> String {
    let mut text = String::new();
    while let Some(c) = rest.next() {
        if c == quote && rest.next_if_eq(&quote).is_none() {
            break;
        }
        text.push(c);
    }
    text
}

fn is_of_name(c: char) -> bool {
    c.is_alphanumeric() || matches!(c, '_' | '$')
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn columns_are_told_by_the_statement_that_made_them() {
        let sql =
            "CREATE TABLE messages(id INTEGER PRIMARY KEY,topic_id INTEGER NOT NULL, \n data BLOB)";
        assert_eq!(columns(sql), ["id", "topic_id", "data"]);
        assert!(columns("CREATE TABLE broken").is_empty());
    }

    #[test]
    fn names_in_quotes_commas_in_parentheses_comments_and_constraints_are_told_apart() {
        let sql = "CREATE TABLE 'a(b'(\"id\" INTEGER CHECK(id in (1, 2)), -- a, b\n [Topic Id] DECIMAL(10, 5) \
                   DEFAULT ',(', `data` BLOB /* , c */, \"a\"\"b\" TEXT, UNIQUE(id, data), CHECK (1, 2))";
        assert_eq!(columns(sql), ["id", "topic id", "data", "a\"b"]);
    }

    #[test]
    fn a_statement_that_ends_early_ends() {
        for sql in [
            "CREATE TABLE a(\"b",
            "CREATE TABLE a([",
            "CREATE TABLE a(b /* ",
            "CREATE TABLE a(b -- ",
        ] {
            assert!(columns(sql).len() <= 1, "{sql}");
        }
    }
}
