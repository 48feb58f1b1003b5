#!/usr/bin/env python3
"""The tables of bounds and of cases in docs/stability.md, from `morula selftest`.

usage: MORULA_DATA=<data folder> stability.py MORULA

Ends with 1 where a case missed its bound.
"""
import json, os, pathlib, subprocess, sys

page = pathlib.Path(__file__).resolve().parent.parent / "docs/stability.md"
if not os.environ.get("MORULA_DATA"):
    sys.exit("stability.py: MORULA_DATA is not set: the cases on real particles would be missing")
done = subprocess.run([sys.argv[1], "selftest", "--json"], capture_output=True, text=True)
times = os.times()
took = times.children_user + times.children_system
cases = json.loads(done.stdout)["cases"]


def text(s):
    return s.replace("|", "\\|")


def figure(v):
    if v is None:
        return "-"
    if v == 0 or (abs(v) >= 0.01 and abs(v) < 1e4):
        return f"{v:.4g}"
    return f"{v:.2e}"


def after(lines, start, rows):
    """Puts rows below the head of the first table after the line that begins like this."""
    at = next(i for i, line in enumerate(lines) if line.startswith(start))
    at = next(i for i in range(at, len(lines)) if lines[i].startswith("| ---")) + 1
    end = next(i for i in range(at, len(lines)) if not lines[i].startswith("|"))
    lines[at:end] = rows


bounds = {}
for c in cases:
    bounds.setdefault((c["group"], c["measure"], c["bound"]), c["why"])
lines = page.read_text().split("\n")
# Those of `--full` alone stay.
more = [line for line in lines if "(thorough)" in line and line.count("|") - line.count("\\|") == 5]
after(lines, "## Bounds", more + [f"| {g} | {text(m)} | {b} | {text(w)} |" for (g, m, b), w in bounds.items()])
after(lines, "## The matrix", [
    f"| {c['group']} | {text(c['case'])} | {text(c['measure'])} | {c['bound']} | {figure(c['value'])} |"
    f" {'skipped' if c['skipped'] else 'yes' if c['pass'] else 'NO'} |" for c in cases])
missed = sum(not c["pass"] and not c["skipped"] for c in cases)
at = next(i for i, line in enumerate(lines) if line.startswith("`morula selftest` with `MORULA_DATA` set:"))
lines[at] = (f"`morula selftest` with `MORULA_DATA` set: {len(cases)} cases, {missed} missed, in {took:.0f} s of CPU on one core; "
             "60 s are the most that it may take. `scripts/stability.py` renews this table.")
page.write_text("\n".join(lines))
print(f"{len(cases)} cases, {missed} missed, {took:.0f} s of CPU")
sys.exit(missed > 0 or done.returncode != 0)
