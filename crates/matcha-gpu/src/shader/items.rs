//! WGSL taken apart: top-level items, what they are called and which names they use. The
//! build script reads this file, too.

/// A declaration at the top of a WGSL module.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Item {
    /// Its name; empty for directives (`enable …;`) and assertions.
    pub name: String,
    /// Its text, attributes included.
    pub text: String,
    /// Every name in it, its own too, each once.
    pub uses: Vec<String>,
}

/// Takes WGSL apart. What is not well-formed ends in an item that a compiler will refuse.
pub fn items(source: &str) -> Vec<Item> {
    let mut items = Vec::new();
    let mut tokens = Tokens { source, at: 0 }.peekable();
    while let Some(first) = tokens.peek() {
        let start = first.at;
        let mut item = Builder::default();
        let mut end = start;
        for token in tokens.by_ref() {
            end = token.at + token.text.len();
            if item.take(token.text) {
                break;
            }
        }
        items.push(Item {
            name: item.name,
            text: source[start..end].to_owned(),
            uses: item.uses,
        });
    }
    items
}

/// The size of the workgroups of an entry point, from its attribute; 1 where it has none.
pub fn workgroup_size(item: &Item) -> u32 {
    let Some((_, after)) = item.text.split_once("@workgroup_size(") else {
        return 1;
    };
    let sizes = after.split(')').next().unwrap_or_default();
    sizes
        .split(',')
        .filter_map(|size| size.trim().trim_end_matches('u').parse::<u32>().ok())
        .product()
}

/// What has been read of an item.
#[derive(Default)]
struct Builder {
    name: String,
    uses: Vec<String>,
    depth: usize,
    /// In the parentheses or the name of an attribute.
    attribute: bool,
    /// The word that says what is declared was seen.
    keyword: bool,
    /// In the template of `var<…>`.
    template: bool,
}

impl Builder {
    /// Takes a token; true if the item ends with it.
    fn take(&mut self, token: &str) -> bool {
        match token {
            "{" | "(" | "[" => self.depth += 1,
            "}" | ")" | "]" => {
                self.depth = self.depth.saturating_sub(1);
                return self.depth == 0 && token == "}";
            }
            ";" => return self.depth == 0,
            "@" if self.depth == 0 => self.attribute = true,
            "<" if self.depth == 0 && self.keyword && self.name.is_empty() => self.template = true,
            ">" if self.depth == 0 => self.template = false,
            _ if is_name(token) => self.word(token),
            _ => {}
        }
        false
    }

    fn word(&mut self, word: &str) {
        if !self.uses.iter().any(|used| used == word) {
            self.uses.push(word.to_owned());
        }
        if self.depth > 0 || self.template {
            return;
        }
        if self.attribute {
            self.attribute = false;
        } else if !self.keyword {
            self.keyword = true;
            // Directives declare nothing, but their words must not be taken for a name.
            if matches!(word, "enable" | "requires" | "diagnostic" | "const_assert") {
                self.template = true;
            }
        } else if self.name.is_empty() {
            word.clone_into(&mut self.name);
        }
    }
}

fn is_name(token: &str) -> bool {
    token.starts_with(|c: char| c.is_alphabetic() || c == '_')
}

/// Words, numbers and single signs, without blanks and comments.
struct Tokens<'s> {
    source: &'s str,
    at: usize,
}

struct Token<'s> {
    at: usize,
    text: &'s str,
}

impl Tokens<'_> {
    fn skip_blanks(&mut self) {
        loop {
            let rest = &self.source[self.at..];
            let trimmed = rest.trim_start();
            self.at += rest.len() - trimmed.len();
            if trimmed.starts_with("//") {
                self.at += trimmed.find('\n').unwrap_or(trimmed.len());
            } else if trimmed.starts_with("/*") {
                self.at += comment(trimmed);
            } else {
                return;
            }
        }
    }
}

/// Length of the block comment, others in it included, that a text begins with.
fn comment(text: &str) -> usize {
    let mut depth = 0;
    let mut at = 0;
    while at < text.len() {
        let rest = &text.as_bytes()[at..];
        if rest.starts_with(b"/*") {
            depth += 1;
            at += 2;
        } else if rest.starts_with(b"*/") {
            depth -= 1;
            at += 2;
            if depth == 0 {
                return at;
            }
        } else {
            at += 1;
        }
    }
    at
}

impl<'s> Iterator for Tokens<'s> {
    type Item = Token<'s>;

    fn next(&mut self) -> Option<Token<'s>> {
        self.skip_blanks();
        let rest = &self.source[self.at..];
        let first = rest.chars().next()?;
        let in_word = |c: char| c.is_alphanumeric() || c == '_';
        let length = if in_word(first) {
            rest.find(|c| !in_word(c)).unwrap_or(rest.len())
        } else {
            first.len_utf8()
        };
        let token = Token {
            at: self.at,
            text: &rest[..length],
        };
        self.at += length;
        Some(token)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn names(source: &str) -> Vec<String> {
        items(source).into_iter().map(|item| item.name).collect()
    }

    #[test]
    fn items_have_their_names() {
        let source = "
            enable f16; // not a name
            struct Hit { t: f32, @size(16) id: u32 }
            const FAR: f32 = 1e30;
            /* a /* nested */ comment; fn no() {} */
            @group(0) @binding(1) var<storage, read_write> words: array<u32>;
            var<workgroup> shared_words: array<u32, 64>;
            override size: u32 = 3u;
            fn helper(x: u32) -> array<u32, 3> { if x > 1u { return array<u32, 3>(x, x, x); } return array<u32, 3>(); }
            @compute @workgroup_size(64) fn main(@builtin(global_invocation_id) id: vec3u) { helper(id.x); }";
        let expected = [
            "",
            "Hit",
            "FAR",
            "words",
            "shared_words",
            "size",
            "helper",
            "main",
        ];
        assert_eq!(names(source), expected);
    }

    #[test]
    fn an_item_knows_what_it_uses() {
        let all = items("fn a(x: Hit) -> u32 { return b(x.t) + FAR; }");
        for name in ["a", "Hit", "b", "FAR"] {
            assert!(all[0].uses.iter().any(|used| used == name), "{name}");
        }
    }

    #[test]
    fn workgroups_have_a_size() {
        let size = |source: &str| workgroup_size(&items(source)[0]);
        assert_eq!(size("@compute @workgroup_size(8, 4u) fn a() {}"), 32);
        assert_eq!(size("@compute @workgroup_size(64) fn a() {}"), 64);
        assert_eq!(size("fn a() {}"), 1);
    }
}
