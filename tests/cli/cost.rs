//! `morula cost`.

use super::*;

fn cost<'a>(extra: &[&'a str]) -> Vec<&'a str> {
    let quick = ["cost", "sample:ellipsoid", "--cells", "20", "--threads", "1", "--columns", "32"];
    [&quick, extra].concat()
}

/// The marks of a page in their order, those within scripts and styles left out.
fn tags(html: &str) -> Vec<String> {
    let mut out = Vec::new();
    let mut rest = html;
    while let Some(at) = rest.find('<') {
        let end = at + rest[at..].find('>').expect("a mark ends");
        let tag = &rest[at + 1..end];
        rest = &rest[end + 1..];
        let name = tag.split([' ', '\n']).next().unwrap().to_string();
        if name == "script" || name == "style" {
            rest = &rest[rest.find(&format!("</{name}>")).expect("it is closed")..];
        }
        out.push(name);
    }
    out
}

#[test]
fn every_file_holds_every_line() {
    let folder = folder("cost");
    let name = folder.join("c");
    let lines = ["--counts", "1,4,10", "--methods", "best-draft,cover", "--json"];
    let printed = succeeds(&cost(&[&lines[..], &["-o", text(&name)]].concat()));
    let v: Value = serde_json::from_str(&printed).unwrap();
    let found = v["lines"].as_array().unwrap();
    assert_eq!(found.len(), 2);
    for line in found {
        let points = line["points"].as_array().unwrap();
        assert_eq!(points.len(), 3, "{line}");
        for (p, n) in points.iter().zip([1, 4, 10]) {
            assert_eq!(p["n"], n);
            for key in ["D", "coverage", "overshoot", "surface_deq", "seconds", "step_cost"] {
                assert!(p[key].is_f64(), "{key} of {p}");
            }
        }
        assert!(line["why"].as_str().unwrap().contains("spheres"), "{line}");
    }
    // The same figure as `morula clump` has for the same number.
    let one = ["clump", "sample:ellipsoid", "--cells", "20", "-n", "10", "--effort", "draft"];
    let one = succeeds(&[&one[..], &["--columns", "32", "--json"]].concat());
    let one: Value = serde_json::from_str(&one).unwrap();
    assert_eq!(found[0]["points"][2]["D"], one["D"]);

    let read = |e: &str| std::fs::read_to_string(folder.join(format!("c.{e}"))).unwrap();
    let csv = read("csv");
    assert_eq!(csv.lines().count(), 7, "{csv}");
    let width = csv.lines().next().unwrap().split(',').count();
    assert!(csv.lines().all(|l| l.split(',').count() == width), "{csv}");

    let svg = read("svg");
    assert!(svg.starts_with("<svg") && svg.trim_end().ends_with("</svg>"));
    for words in ["best-draft", "cover", "mismatch D", "generation time, ms", "spheres"] {
        assert!(svg.contains(words), "{words}");
    }
    assert!(svg.matches("<circle").count() >= 18);

    // One page by itself: nothing is fetched, every mark is closed, the data are whole.
    let html = read("html");
    assert!(!html.contains("http") && !html.contains("src="), "the page points somewhere");
    let mut open: Vec<String> = Vec::new();
    for tag in tags(&html) {
        match tag.as_str() {
            "!DOCTYPE" | "meta" | "canvas/" => {}
            "input" => {}
            closing if closing.starts_with('/') => {
                assert_eq!(open.pop().as_deref(), Some(&closing[1..]), "{closing}");
            }
            _ => open.push(tag),
        }
    }
    assert!(open.is_empty(), "{open:?} are not closed");
    let data = html.split("id=\"data\">").nth(1).unwrap().split("</script>").next().unwrap();
    let data: Value = serde_json::from_str(data).unwrap();
    assert_eq!(data["lines"][1]["clumps"].as_array().unwrap().len(), 3);
    // Ten spheres of four numbers of four bytes, as text.
    assert_eq!(data["lines"][0]["clumps"][2].as_str().unwrap().len(), 216);
    let count = data["mesh"]["count"].as_u64().unwrap() as usize;
    assert_eq!(data["mesh"]["corners"].as_str().unwrap().len(), (18 * count).div_ceil(3) * 4);
    draws(&folder.join("c.html"));
}

/// That a browser draws target and clump without an error, where there is one.
#[expect(clippy::print_stdout)]
fn draws(page: &Path) {
    let url = format!("file://{}", text(page));
    let flags = "--headless=new --no-sandbox --use-gl=angle --use-angle=swiftshader \
                 --enable-unsafe-swiftshader --window-size=1280,800 --virtual-time-budget=8000 --dump-dom";
    let asked = Command::new("chromium").args(flags.split_whitespace()).arg(url).output();
    let Ok(output) = asked else {
        println!("skipped: chromium is not installed");
        return;
    };
    let page = stdout(&output);
    let head: String = page.chars().take(400).collect();
    assert!(!head.contains("data-error"), "{head}");
    assert!(head.contains("data-state=\"drawn\""), "{head}");
    for half in ["target", "clump"] {
        let key = format!("data-{half}=\"");
        let pixels = head.split(&key).nth(1).and_then(|rest| rest.split('"').next());
        let pixels: u32 = pixels.and_then(|n| n.parse().ok()).unwrap_or(0);
        assert!(pixels > 5000, "{half}: {pixels} pixels show something: {head}");
    }
    // Three charts, each with a circle for every point.
    assert!(page.matches("<circle").count() >= 18 && page.contains("generation time, ms"));
}

#[test]
fn a_choice_is_told_with_its_reason() {
    let few = ["--counts", "2,5,12", "--methods", "best-draft", "--no-files"];
    let table =
        succeeds(&cost(&[&few[..], &["--goal", "spheres", "--max-mismatch", "0.05"]].concat()));
    let last = table.lines().last().unwrap();
    assert!(last.contains("fewest spheres of those with D ≤ 0.05"), "{table}");
    let table = succeeds(&cost(&[&few[..], &["--max-mismatch", "0.000001"]].concat()));
    assert!(table.lines().last().unwrap().contains("the nearest"), "{table}");
    // Lines over cells and deadlines; contacts by Hertz have a Rayleigh step.
    let sweep = ["--sweep-cells", "16,24", "--seconds", "0,5", "--young", "1e7", "--json"];
    let printed = succeeds(&cost(&[&few[..], &sweep].concat()));
    let v: Value = serde_json::from_str(&printed).unwrap();
    let names: Vec<&str> =
        v["lines"].as_array().unwrap().iter().map(|l| l["name"].as_str().unwrap()).collect();
    assert_eq!(names.len(), 4);
    assert!(names.iter().all(|n| n.contains("cells")), "{names:?}");
    assert!(names[0].ends_with("no deadline") && names[1].ends_with("5 s"), "{names:?}");
    assert!(v["lines"][0]["points"][0]["rayleigh"].as_f64().unwrap() > 0.0);
    // A method that cannot do what is asked leaves its line out, all of them are a failure.
    let nested = ["--levels", "nested", "--methods", "mss", "--no-files", "-q"];
    let said = fails(&cost(&[&["--counts", "2,5"], &nested[..]].concat()), 1);
    assert!(said.contains("UNSUPPORTED"), "{said}");
    fails(&cost(&["--counts", "5,2", "--no-files", "-q"]), 1);
    fails(&cost(&["-n", "0"]), 2);
    // What a step costs, by the solver.
    let step = |model: &[&str]| {
        let printed = succeeds(&cost(&[&few[..], &["--json"], model].concat()));
        let v: Value = serde_json::from_str(&printed).unwrap();
        v["lines"][0]["points"][2]["step_cost"].as_f64().unwrap()
    };
    let by_name = [step(&["--step-model", "lammps"]), step(&["--step-model", "morula"])];
    assert!(step(&[]) == by_name[0] && by_name[1] > 1.0 && by_name[1] != by_name[0]);
    let given = step(&["--step-model", "1,2,3,4,5,10"]);
    assert!((given - (1.0 + 24.0 + 432.0 + 4.8 + 72.0)).abs() < 1e-6, "{given}");
    fails(&cost(&["--step-model", "liggghts", "--no-files"]), 2);
    fails(&cost(&["--step-model", "1,2,3", "--no-files"]), 2);
}

#[test]
fn shapes_of_papers_are_known() {
    let args = ["cost", "sample:mandm", "--cells", "16", "--threads", "1", "--columns", "16"];
    let few = ["--counts", "3", "--methods", "best-draft", "--no-files", "--json"];
    let v: Value = serde_json::from_str(&succeeds(&[&args[..], &few].concat())).unwrap();
    let marks = v["papers"].as_array().unwrap();
    assert_eq!(marks.len(), 4, "{v}");
    assert_eq!(marks[1]["n"], 181);
    assert!((marks[1]["D"].as_f64().unwrap() - 0.01 / 1.99).abs() < 1e-12);
}
