//! What `include/morula.h` declares.

use std::collections::BTreeMap;

/// A parameter or a field: `const double *vertices`, `double centre[3]`.
#[derive(Debug, Clone)]
pub struct Declaration {
    /// `const double*`
    pub of: String,
    pub name: String,
    /// 3 of `centre[3]`.
    pub dim: Option<usize>,
}

#[derive(Debug, Default)]
pub struct Header {
    /// Name → the type of the result and the parameters.
    pub functions: BTreeMap<String, (String, Vec<Declaration>)>,
    pub structs: BTreeMap<String, Vec<Declaration>>,
    /// Name → `int32_t (double fraction, void *user)`.
    pub callbacks: BTreeMap<String, String>,
    pub constants: BTreeMap<String, i64>,
}

pub fn read() -> Header {
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/include/morula.h");
    parse(&std::fs::read_to_string(path).unwrap())
}

fn parse(header: &str) -> Header {
    let mut found = Header::default();
    let code: Vec<&str> = header.lines().filter(|l| !l.trim_start().starts_with("//")).collect();
    for line in &code {
        let words: Vec<&str> = line.split_whitespace().collect();
        if let ["#define", name, value] = words[..]
            && let Ok(value) = value.parse()
        {
            found.constants.insert(name.to_owned(), value);
        }
    }
    let code = code.join("\n");
    for part in code.split("typedef struct ").skip(1) {
        let Some((name, rest)) = part.split_once(" {") else { continue };
        if name.contains(';') {
            continue;
        }
        let body = rest.split('}').next().unwrap();
        let fields = body.split(';').map(str::trim).filter(|f| !f.is_empty());
        found.structs.insert(name.to_owned(), fields.map(declaration).collect());
    }
    let flat = code.split_whitespace().collect::<Vec<_>>().join(" ");
    for statement in flat.split(';') {
        let Some((head, parameters)) = statement.rsplit_once('(') else { continue };
        let Some(parameters) = parameters.strip_suffix(')') else { continue };
        if let Some((result, name)) = head.split_once("(*") {
            let result = result.trim().trim_start_matches("typedef ");
            let name = name.trim_end_matches(')');
            found.callbacks.insert(name.to_owned(), format!("{result} ({parameters})"));
            continue;
        }
        // The name, and before it the result's type, of one or two words.
        let Some(at) = head.find("morula_") else { continue };
        let (result, name) = head.split_at(at);
        let result = ["const char *", "uint32_t ", "int32_t ", "size_t ", "void "]
            .into_iter()
            .find(|r| result.ends_with(r))
            .unwrap_or_else(|| panic!("{name} gives back {result}"));
        let parameters = parameters.split(", ").filter(|p| *p != "void").map(declaration);
        found.functions.insert(name.to_owned(), (tight(result), parameters.collect()));
    }
    found
}

fn declaration(text: &str) -> Declaration {
    let (text, dim) = match text.split_once('[') {
        Some((t, d)) => (t, Some(d.trim_end_matches(']').parse().unwrap())),
        None => (text, None),
    };
    let at = text.rfind([' ', '*']).unwrap() + 1;
    Declaration { of: tight(&text[..at]), name: text[at..].to_owned(), dim }
}

/// Without `struct`, and without spaces before stars.
fn tight(of: &str) -> String {
    let words = of.replace("struct ", "").replace('*', " * ");
    words.split_whitespace().collect::<Vec<_>>().join(" ").replace(" *", "*")
}
