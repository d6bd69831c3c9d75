//! The words of a command, as a shell splits them, without a shell.

/// Words that only a shell understands.
const OF_SHELLS: [&str; 10] = ["|", "||", "&", "&&", ";", "<", ">", ">>", "2>", "2>&1"];

/// Splits a command at white space. Single quotes keep everything between them; double quotes keep white
/// space, and a backslash before `"` or `\` in them keeps that character. Outside of quotes a backslash
/// keeps the next character, except on Windows, where it separates folders. Nothing else is interpreted:
/// no variables, no wildcards, no pipes.
///
/// # Errors
/// There is no word, a quote is not closed, or a word is an operator of a shell.
pub(super) fn words(command: &str) -> Result<Vec<String>, String> {
    let mut words = Vec::new();
    let mut word: Option<String> = None;
    let mut was_quoted = false;
    let mut characters = command.chars().peekable();
    loop {
        match characters.next() {
            Some(quote @ ('"' | '\'')) => {
                was_quoted = true;
                let word = word.get_or_insert_default();
                loop {
                    match characters.next() {
                        Some(end) if end == quote => break,
                        Some('\\') if quote == '"' => match characters.peek() {
                            Some(&kept @ ('"' | '\\')) => {
                                characters.next();
                                word.push(kept);
                            }
                            _ => word.push('\\'),
                        },
                        Some(inner) => word.push(inner),
                        None => return Err(format!("`{command}` has a {quote} without an end")),
                    }
                }
            }
            Some('\\') if !cfg!(windows) => {
                was_quoted = true;
                let kept = characters.next();
                word.get_or_insert_default()
                    .push(kept.ok_or_else(|| format!("`{command}` ends with a backslash"))?);
            }
            Some(other) if !other.is_whitespace() => word.get_or_insert_default().push(other),
            end => {
                if let Some(word) = word.take() {
                    if !was_quoted && OF_SHELLS.contains(&word.as_str()) {
                        return Err(format!(
                            "`{command}` has `{word}`, but is started without a shell; \
                             write sh -c '...'"
                        ));
                    }
                    words.push(word);
                }
                was_quoted = false;
                if end.is_none() {
                    break;
                }
            }
        }
    }
    if words.is_empty() {
        return Err("the command of the simulator is empty".to_owned());
    }
    Ok(words)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn words_are_those_of_a_shell() {
        let split = |command: &str| words(command).unwrap();
        assert_eq!(split("  python3\tpendulum.py  --fast "), ["python3", "pendulum.py", "--fast"]);
        assert_eq!(split(r#"sh -c 'a "b" \c'"#), ["sh", "-c", r#"a "b" \c"#]);
        assert_eq!(split(r#"x "my file.py" a"b c"d """#), ["x", "my file.py", "ab cd", ""]);
        assert_eq!(split(r#"x "say \"hi\" \n \\""#), ["x", r#"say "hi" \n \"#]);
        assert_eq!(split("sim $HOME *.py '|'"), ["sim", "$HOME", "*.py", "|"]);
        #[cfg(not(windows))]
        assert_eq!(split(r"a\ b \'c"), ["a b", "'c"]);
        #[cfg(windows)]
        assert_eq!(split(r"C:\bin\sim.exe x"), [r"C:\bin\sim.exe", "x"]);
    }

    #[test]
    fn commands_that_need_a_shell_are_errors() {
        let error = |command: &str| words(command).unwrap_err();
        assert_eq!(error(" \t"), "the command of the simulator is empty");
        assert_eq!(error("sim 'a b"), "`sim 'a b` has a ' without an end");
        let piped = "`sim | tail` has `|`, but is started without a shell; write sh -c '...'";
        assert_eq!(error("sim | tail"), piped);
        #[cfg(not(windows))]
        assert_eq!(error("sim \\"), "`sim \\` ends with a backslash");
    }
}
