//! Equations between `$` or `$$` become MathML, which browsers draw without scripts, fonts or a network.

use mdbook_preprocessor::book::Book;
use mdbook_preprocessor::errors::{Error, Result};
use mdbook_preprocessor::{Preprocessor, PreprocessorContext};
use pulldown_cmark::{Event, Options, Parser};
use pulldown_latex::config::{DisplayMode, RenderConfig};
use pulldown_latex::{Storage, push_mathml};

/// The step of building the book that replaces equations.
pub struct Equations;

impl Preprocessor for Equations {
    fn name(&self) -> &str {
        "equations"
    }

    fn run(&self, _: &PreprocessorContext, mut book: Book) -> Result<Book> {
        let mut mistakes = Vec::new();
        book.for_each_chapter_mut(|chapter| match with_mathml(&chapter.content) {
            Ok(content) => chapter.content = content,
            Err(error) => {
                mistakes.push(format!("docs/{}: {error:#}", chapter.path.clone().unwrap_or_default().display()));
            }
        });
        if !mistakes.is_empty() {
            return Err(Error::msg(mistakes.join("\n")));
        }
        Ok(book)
    }
}

/// A page in Markdown with MathML in place of its equations.
fn with_mathml(page: &str) -> Result<String> {
    let mut done = String::with_capacity(page.len());
    let mut end = 0;
    for (event, place) in Parser::new_ext(page, Options::ENABLE_MATH | Options::ENABLE_TABLES).into_offset_iter() {
        let (equation, display_mode) = match &event {
            Event::InlineMath(equation) => (equation, DisplayMode::Inline),
            Event::DisplayMath(equation) => (equation, DisplayMode::Block),
            _ => continue,
        };
        done += &page[end..place.start];
        done += &mathml(equation, display_mode)?;
        end = place.end;
    }
    Ok(done + &page[end..])
}

/// An equation in TeX as MathML, in one line without marks of Markdown.
fn mathml(equation: &str, display_mode: DisplayMode) -> Result<String> {
    let storage = Storage::new();
    let events = pulldown_latex::Parser::new(equation, &storage)
        .collect::<std::result::Result<Vec<_>, _>>()
        .map_err(|error| Error::msg(format!("the equation {equation}: {error}")))?;
    let mut written = String::new();
    let config = RenderConfig { display_mode, annotation: Some(equation), ..RenderConfig::default() };
    push_mathml(&mut written, events.into_iter().map(Ok::<_, std::convert::Infallible>), config)?;
    let mut is_tag = false;
    let mut done = String::with_capacity(written.len());
    for character in written.chars() {
        is_tag = (is_tag || character == '<') && character != '>';
        match character {
            '\n' => done.push(' '),
            '*' | '_' | '|' | '[' | ']' | '\\' | '`' | '$' | '~' if !is_tag => {
                done += &format!("&#{};", u32::from(character));
            }
            other => done.push(other),
        }
    }
    Ok(done)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn equations_become_mathml_and_code_stays() {
        let page = "The width $w_a$ and `$HOME`:\n\n$$\n\\frac{a}{b} = [c] * d\n$$\n\n```sh\n$ echo $A $B\n```\n";
        let done = with_mathml(page).unwrap();
        assert!(done.contains("<msub><mi>w</mi><mi>a</mi></msub>") && done.contains("<mfrac>"), "{done}");
        assert!(done.contains("`$HOME`") && done.contains("$ echo $A $B"), "{done}");
        assert!(done.contains(r#"display="block""#) && !done.contains("$$") && !done.contains("[c]"), "{done}");
        let in_book: String =
            Parser::new(&done).filter(|event| matches!(event, Event::Start(_))).map(|_| ".").collect();
        assert_eq!(in_book, "...", "two paragraphs and a block of code, nothing emphasized: {done}");
    }

    #[test]
    fn a_mistake_names_the_equation() {
        let error = with_mathml("So $\\fraction{a}$ it is.").unwrap_err();
        assert!(format!("{error:#}").contains("the equation \\fraction{a}: "), "{error:#}");
    }
}
