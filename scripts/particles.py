#!/usr/bin/env python3
"""The table over the real particles: what comes in, and the clump at three numbers of spheres.

    MORULA_DATA=<data folder> python3 scripts/particles.py [path to morula] [METHOD] > docs/particles.md

Standard library only. Lengths over the equivalent diameter; seconds are one run on two threads.
"""
import json, math, os, pathlib, subprocess, sys

NUMBERS = (20, 50, 100)
morula = sys.argv[1] if len(sys.argv) > 1 else "target/release/morula"
method = sys.argv[2] if len(sys.argv) > 2 else "best"
data = os.environ.get("MORULA_DATA")
if not data:
    sys.exit("MORULA_DATA is not set")
root = pathlib.Path(data) / "particles"
files = sorted(p for p in root.rglob("*") if p.suffix in (".stl", ".obj", ".ply", ".off"))


def call(*words):
    done = subprocess.run([morula, *map(str, words)], capture_output=True, text=True)
    return (json.loads(done.stdout), "") if done.returncode == 0 else (None, done.stderr.strip())


print("# Clumps of real particles\n")
print(f"Made by `scripts/particles.py` with the method {method}, 64 cells along the longest edge;")
print("D is Buchele et al. 2026, equation 27, measured on columns, not on the grid that made the clump.")
print("Protrusion and RMS distance are over the equivalent diameter; s is one whole run with all")
print(f"quality figures, on {os.cpu_count()} threads.\n")
head = ["particle", "faces", "closed"]
head += [f"D, n = {n}" for n in NUMBERS]
head += ["coverage", "overshoot", "protrusion", "RMS", "s"]
print("| " + " | ".join(head) + " |\n|" + "---|" * 3 + "---:|" * (len(head) - 3))
logs, failures = {n: [] for n in NUMBERS}, []
for path in files:
    info, error = call("info", path, "--json")
    name = str(path.relative_to(root))
    if info is None:
        failures.append((name, error))
        continue
    report = info.get("report", info)
    row = [name, str(report["faces"]), "yes" if report["watertight"] else "no"]
    last = None
    for n in NUMBERS:
        clump, error = call("clump", path, "-n", n, "--method", method, "--json", "--quality", "full", "--threads", 0,
                            "-o", os.devnull, "--format", "csv")
        if clump is None:
            failures.append((name, error))
            break
        row.append(f"{clump['D']:.4f}" + ("" if clump["n"] == n else f" [{clump['n']}]"))
        logs[n].append(math.log(clump["D"]))
        last = clump
    else:
        d = last["equivalent_diameter"]
        row += [f"{last['coverage']:.4f}", f"{last['overshoot']:.4f}",
                f"{last['protrusion'] / d:.4f}", f"{last['rms_distance'] / d:.4f}",
                f"{last['seconds']:.2f}"]
        print("| " + " | ".join(row) + " |")
if logs[NUMBERS[0]]:
    mean = [f"{math.exp(sum(v) / len(v)):.4f}" for v in logs.values()]
    print("| **geometric mean** | | | " + " | ".join(mean) + " | | | | | |")
print(f"\nThe last five columns are those of n = {NUMBERS[-1]}; [k]: only k spheres exist.")
for name, error in failures:
    print(f"\nRefused: {name}: {error}")
