#!/usr/bin/env python3
"""The figures of the method best: called by scripts/figures.sh.

usage: figures.py MORULA [--full] [--no-peers] [--out docs/best_figures]

Measures every benchmark shape with 5 to 100 spheres by the library's exact columns and, where numpy is there,
by an evaluator that shares nothing with it (scripts/voxels.py), beside what other programs and the study
reach; runs the programs that are installed (scripts/peer.py) on the nine cells of the first table. Writes
OUT.md and OUT.csv, and ends with 1 where a demand is not met. What is missing is named and left out.
Without MORULA_DATA the built-in particles are all there is. --full: effort thorough as well.
"""
import csv, hashlib, json, math, os, pathlib, resource, subprocess, sys, tempfile

NUMBERS = (5, 10, 20, 30, 50, 70, 100)
SHAPES = ("ellipsoid", "femur", "torus", "octahedron", "hexahedron", "bunny", "teapot", "swiss_cheese",
          "ice_cream_cone", "example_mesh", "example_voxels")
SAMPLES = ("tablet", "mandm", "ellipsoid", "stone")
# Shape, n, and what D must not exceed: normal, thorough.
MUST = (("ellipsoid", 10, .0060, .0057), ("femur", 70, .0225, .0213), ("bunny", 30, .043, .041),
        ("bunny", 100, .0225, .0207), ("torus", 20, .0300, .0296), ("hexahedron", 20, .0595, .0585),
        ("octahedron", 20, .0445, .0440), ("teapot", 50, .0205, .0193), ("ice_cream_cone", 20, .0335, .0325))
# Geometric means that must not be exceeded: over the best peer, over the study.
MEANS = {"normal": (0.6, 1.06), "thorough": (0.55, 1.02)}
PEERS = ("mss", "clump-fm", "clump-fav", "clump-eu")
PACKAGES = {"mss": "multisphere", "clump-eu": "CLUMP", "clump-fav": "CLUMP", "clump-fm": "CLUMP"}
LIMIT = 60  # seconds of CPU for one run of a peer

here = pathlib.Path(__file__).resolve().parent
arguments = sys.argv[1:]
full = "--full" in arguments
run_peers = "--no-peers" not in arguments
out = arguments[arguments.index("--out") + 1] if "--out" in arguments else "docs/best_figures"
morula = arguments[0]
efforts = ("normal", "thorough") if full else ("normal",)
scratch = tempfile.TemporaryDirectory()
work = pathlib.Path(scratch.name)
missing, failures = [], []


def note(text):
    missing.append(text)
    print(f"figures: {text}", file=sys.stderr, flush=True)


try:
    sys.path.insert(0, str(here))
    from voxels import Target
except ImportError as e:
    Target = None
    note(f"no independent evaluator: {e}")

data = os.environ.get("MORULA_DATA")
root = pathlib.Path(data) / "benchmark" if data else None
if root is None:
    note("MORULA_DATA is not set: built-in particles only")
    paths = {}
    for name in SAMPLES:
        paths[name] = work / f"{name}.stl"
        subprocess.run([morula, "sample", name, "-q", "-o", paths[name]], check=True)
else:
    paths = {}
    for name in SHAPES:
        found = [p for p in (root / f"{name}.stl", root / f"{name}.npy") if p.exists()]
        if found:
            paths[name] = found[0]
        else:
            note(f"{name} is not in {root.name}")

# The least D of seven other programs with n spheres or fewer, measured once on the same meshes.
others = {}
with open(here / "others.csv", newline="") as f:
    for r in csv.DictReader(f):
        others[r["shape"], int(r["n"])] = (float(r["D"]), int(r["spheres"]), r["program"])
# What a prototype of the method found with two seconds for each clump.
study = {}
with open(here / "study.csv", newline="") as f:
    for r in csv.DictReader(f):
        study.update({(r["shape"], n): float(r[str(n)]) for n in NUMBERS})


def best_peer(shape, n):
    """The least D of any other program with n spheres or fewer."""
    return others.get((shape, n))


def children():
    u = resource.getrusage(resource.RUSAGE_CHILDREN)
    return u.ru_utime + u.ru_stime


def clump(path, n, effort, *more, threads=1):
    """The figures and the spheres."""
    file = work / "clump.csv"
    words = [morula, "clump", path, "-n", n, "--method", "best", "--effort", effort, "--threads", threads,
             "--json", "-o", file, *more]
    before = children()
    done = subprocess.run([str(w) for w in words], capture_output=True, text=True)
    if done.returncode:
        sys.exit(f"figures: {path.name}, {n}: {done.stderr.strip()}")
    figures = json.loads(done.stdout)
    figures["cpu"] = children() - before
    text = file.read_text()
    figures["sum"] = hashlib.sha256(text.encode()).hexdigest()[:16]
    return figures, [[float(v) for v in line.split(",")] for line in text.split()[1:]]


def mean(values):
    values = list(values)
    return math.exp(sum(map(math.log, values)) / len(values)) if values else float("nan")


def figure(d):
    return "–" if d is None else f"{d:.4f}"


targets = {}


def other(shape, spheres):
    """D by the evaluator that shares nothing with the library."""
    if Target is None:
        return None
    if shape not in targets:
        targets.clear()
        targets[shape] = Target(paths[shape])
    return float(targets[shape].mismatch(spheres))


def finer(shape, spheres):
    """The same with twice the cells along each edge, and with the holes of the mesh capped as the study had them."""
    return float(Target(paths[shape], 512, True).mismatch(spheres))


# Every cell.
rows = []
kept = {}
for shape, path in paths.items():
    for n in NUMBERS:
        for effort in efforts:
            made, spheres = clump(path, n, effort, "--quality", "overlap", "--columns", 512)
            peer = best_peer(shape, n)
            kept[shape, n, effort] = spheres
            rows.append(dict(
                shape=shape, n=n, effort=effort, made=made["n"], D=made["D"], other=other(shape, spheres),
                peer=peer and peer[0], peer_name=peer and peer[2], study=study.get((shape, n)) if root else None,
                seconds=made["stages"]["generate"]))
            print(rows[-1], file=sys.stderr, flush=True)
cells = {(r["shape"], r["n"], r["effort"]): r for r in rows}
with open(f"{out}.csv", "w", newline="") as f:
    writer = csv.writer(f, lineterminator="\n")
    writer.writerow(("shape", "n", "effort", "spheres", "D", "D by voxels", "best peer", "peer", "study",
                     "seconds of the generator"))
    for r in rows:
        writer.writerow([f"{v:.6f}" if isinstance(v, float) else ("" if v is None else v) for v in r.values()])

lines = []
say = lines.append
say("# Figures of the method `best`\n")
say("Made by `scripts/figures.sh`. D by exact intervals along 512 × 512 columns of the library (`ours`) and by voxel\n"
    "centres at 256 in a program that shares nothing with it (`other`); default seed, 64 cells along the longest\n"
    "edge, one thread. A peer counts with as many spheres or fewer. All figures of every cell are in\n"
    f"`{pathlib.Path(out).name}.csv`.\n")


def demand(met, text):
    say(f"- {'met' if met else '**missed**'}: {text}")
    if not met:
        failures.append(text)


# The nine cells that must be reached, and what the peers need for them in the same run.
peer_runs = {}
python = os.environ.get("MORULA_PEER_PYTHON", sys.executable)
if root and run_peers:
    for package in sorted(set(PACKAGES.values())):
        there = subprocess.run([python, "-c", f"import {package}, trimesh"], capture_output=True)
        if there.returncode:
            pip = {"CLUMP": "clump-python"}.get(package, package)
            note(f"the PyPI package {pip} is not installed for {python}: its programs are not run "
                 "(MORULA_PEER_PYTHON names another interpreter)")
            PEERS = tuple(p for p in PEERS if PACKAGES[p] != package)
elif not run_peers:
    PEERS = ()


def limit():
    resource.setrlimit(resource.RLIMIT_CPU, (LIMIT, LIMIT))


def peer_run(peer, shape, n):
    file = work / "peer.json"
    file.unlink(missing_ok=True)
    done = subprocess.run([python, str(here / "peer.py"), peer, str(paths[shape]), str(n), str(file)],
                          capture_output=True, text=True, preexec_fn=limit)
    if done.returncode or not file.exists():
        last = (done.stderr.strip().splitlines() or [f"more than {LIMIT} s of CPU"])[-1]
        note(f"{peer}, {shape}, {n}: {last[:100]}")
        return None
    made = json.loads(file.read_text())
    spheres = [s for s in made["spheres"] if all(map(math.isfinite, s))]
    return dict(n=len(spheres), D=other(shape, spheres) if spheres else None, cpu=made["cpu"])


if root:
    say("## What must be reached\n")
    head = "| shape, n | best peer | study | `normal` must | ours | other | CPU s |"
    say(head + (" `thorough` must | ours | other | CPU s |" if full else ""))
    say("| --- |" + " ---: |" * (10 if full else 6))
    worst, close = [], []
    for shape, n, normal, thorough in MUST:
        if shape not in paths:
            continue
        peer = best_peer(shape, n)
        line = f"| {shape} {n} | {figure(peer and peer[0])} | {figure(study.get((shape, n)))}"
        for effort, most in (("normal", normal), ("thorough", thorough)):
            if effort in efforts:
                cell = cells[shape, n, effort]
                # End to end, from the file to the spheres.
                cell["cpu"] = min(clump(paths[shape], n, effort, "--quality", "none")[0]["cpu"] for _ in range(3))
                line += f" | {most:.4f} | {figure(cell['D'])} | {figure(cell['other'])} | {cell['cpu']:.2f}"
                where = f"{shape} {n} `{effort}`, must be {most:.4f}"
                if cell["D"] > most:
                    worst.append(f"{where}: {cell['D']:.4f} by ours")
                if cell["other"] is not None and cell["other"] > most:
                    fine = finer(shape, kept[shape, n, effort])
                    (worst if fine > most else close).append(f"{where}: {cell['other']:.5f} by other, {fine:.5f} finer")
        say(line + " |")
    say("\nCPU seconds are of the whole program (reading, grid, spheres, one thread, the least of three).\n")
    demand(not worst, "every cell of this table" + ("" if not worst else ": " + "; ".join(worst)))
    if close:
        say("- above by `other`, but not by the same program at 512 cells with the holes of the mesh capped by fans, as the\n"
            "  study had them (`finer`): " + "; ".join(close))
    for effort in efforts:
        mine = [r for r in rows if r["effort"] == effort]
        by = [(r, r["D"] / r["peer"]) for r in mine if r["peer"]]
        if by:
            above = [f"{r['shape']} {r['n']}" for r, q in by if q > 1]
            demand(not above, f"`{effort}` is above the best peer in {len(above)} of {len(by)} cells {', '.join(above)}".rstrip())
            m = mean(q for _, q in by)
            demand(m <= MEANS[effort][0], f"`{effort}`: geometric mean of D over the best peer's {m:.3f} (must be {MEANS[effort][0]})")
        by = [r["D"] / r["study"] for r in mine if r["study"]]
        if by:
            m = mean(by)
            demand(m <= MEANS[effort][1], f"`{effort}`: geometric mean of D over the study's {m:.3f} (must be {MEANS[effort][1]})")
        by = [r["other"] / r["D"] for r in mine if r["other"]]
        if by:
            say(f"- `{effort}`: geometric mean of D by `other` over `ours` {mean(by):.4f}, from {min(by):.3f} to {max(by):.3f}")

for effort in efforts:
    say(f"\n## Every cell, `{effort}`: ours (best peer)\n")
    say("| shape |" + "".join(f" n = {n} |" for n in NUMBERS))
    say("| --- |" + " ---: |" * len(NUMBERS))
    for shape in paths:
        line = f"| {shape} |"
        for n in NUMBERS:
            r = cells[shape, n, effort]
            line += f" {figure(r['D'])}" + (f" ({figure(r['peer'])})" if r["peer"] else "") + " |"
        say(line)

if root and PEERS:
    say("\n## Beside programs that are installed, in one run\n")
    say("D by `other`, the number of spheres where it is not n, seconds of CPU of loading and making (imports left out),\n"
        "and these over the CPU seconds of `normal` from the file to the spheres.\n")
    say("| shape, n | `normal` | " + " | ".join(PEERS) + " |")
    say("| --- | --- |" + " --- |" * len(PEERS))
    ratios = {p: [] for p in PEERS}
    for shape, n, *_ in MUST:
        if shape not in paths:
            continue
        cell = cells[shape, n, "normal"]
        line = f"| {shape} {n} | {figure(cell['other'])}, {cell['cpu']:.2f} s |"
        for peer in PEERS:
            made = peer_run(peer, shape, n)
            print(peer, shape, n, made, file=sys.stderr, flush=True)
            if made is None:
                line += " – |"
                continue
            few = "" if made["n"] == n else f" [{made['n']}]"
            ratio = made["cpu"] / cell["cpu"]
            ratios[peer].append((ratio, made["D"] / cell["other"] if made["D"] and cell["other"] else None))
            line += f" {figure(made['D'])}{few}, {made['cpu']:.1f} s, {ratio:.0f}× |"
        say(line)
    say("| geometric mean over `normal` | |" + "".join(
        f" D {mean(d for _, d in r if d):.1f}×, CPU {mean(q for q, _ in r):.0f}× |" if r else " – |" for r in ratios.values()))

say("\n## The same bytes for any number of threads\n")
say("| shape, n, effort | 1 thread | 2 | 8 |\n| --- | --- | --- | --- |")
alike = True
names = list(paths)
for shape, n, effort in ((names[0], 10, "normal"), (names[1], 70, "normal"), (names[-1], 100, "normal"),
                         (names[1], 30, "thorough" if full else "draft"), (names[0], 1000, "draft")):
    sums = [clump(paths[shape], n, effort, "--quality", "none", threads=t)[0]["sum"] for t in (1, 2, 8)]
    alike &= len(set(sums)) == 1
    say(f"| {shape}, {n}, `{effort}` | " + " | ".join(f"`{s}`" for s in sums) + " |")
say("")
demand(alike, "the checksums (SHA-256 of the CSV file) agree")
if missing:
    say("\n## What was missing in this run\n")
    lines += [f"- {text}" for text in missing]
with open(f"{out}.md", "w") as f:
    f.write("\n".join(lines) + "\n")
print("\n".join(lines))
sys.exit(1 if failures else 0)
