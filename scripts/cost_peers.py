#!/usr/bin/env python3
"""Ours and the programs of the field over all real particles, at one number of spheres: writes docs/cost_peers.csv.

usage: cost_peers.py MORULA [--out docs/cost_peers.csv] [--keep FOLDER] [--only-peers]

Needs MORULA_DATA (the meshes) and MORULA_PEER_PYTHON (an interpreter with `multisphere` and `clump-python`). Runs
`multisphere` at div 100 and CLUMP, Euclidean 3D, overlap 0.95, at div 100 with rMin 2 % of the shortest edge of the
box; ours are `best` and `best-draft`. All on one thread; times are processor seconds (user + system) of making, theirs
with loading and without imports. A run of theirs is ended after 120 of these seconds, and said to be.
--keep FOLDER: what they made is kept there and not made again; --only-peers makes that alone.
"""
import csv, json, os, pathlib, resource, statistics, subprocess, sys, tempfile

HERE = pathlib.Path(__file__).resolve().parent
SPHERES, LIMIT = 30, 120
PROGRAMS = {"multisphere": ("mss",), "CLUMP": ("clump-eu", "100", "2%")}
OURS = ("best", "best-draft")
KEYS = ("particle", "program", "outcome", "spheres", "D", "cpu_seconds")


def theirs(python, kind, mesh, n, keep, *more, limit=LIMIT):
    """What a program made: spheres and processor seconds."""
    name = "_".join(map(str, (kind, pathlib.Path(mesh).stem, n, *more))).replace("%", "pc")
    path, failed = keep / f"{name}.peer.json", keep / f"{name}.failed"
    if failed.exists():
        raise RuntimeError(failed.read_text())
    if not path.exists():
        done = subprocess.run([python, str(HERE / "peer.py"), kind, str(mesh), str(n), str(path), *map(str, more)],
                              capture_output=True, text=True,
                              preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_CPU, (limit, limit + 5)))
        if done.returncode or not path.exists():
            path.unlink(missing_ok=True)
            why = (f"cut after {limit} s" if done.returncode in (-24, -9) else
                   (done.stderr.strip() or "no result").splitlines()[-1][:120])
            failed.write_text(why)
            raise RuntimeError(why)
    return json.loads(path.read_text())


def meshes(data):
    found = (p for p in (data / "particles").rglob("*") if p.suffix in (".stl", ".obj", ".ply", ".off"))
    return sorted(found, key=str)


def run(morula, *words):
    done = subprocess.run([str(w) for w in (morula, *words)], capture_output=True, text=True)
    if done.returncode:
        raise RuntimeError(done.stderr.strip().splitlines()[-1])
    return json.loads(done.stdout)


def judged(morula, spheres, shape, work):
    """D of spheres by our exact columns."""
    path = work / "theirs.csv"
    path.write_text("x,y,z,r\n" + "".join(",".join(f"{v:.17g}" for v in s) + "\n" for s in spheres))
    return run(morula, "measure", path, "--target", shape, "--bodies", "largest", "--json", "-q")["D"]


def measure(morula, python, data, out, keep, only_peers=False):
    """A row for each particle and program, written as they come."""
    with open(os.devnull if only_peers else out, "w", newline="") as f, tempfile.TemporaryDirectory() as work:
        table = csv.DictWriter(f, KEYS, lineterminator="\n")
        table.writeheader()
        for mesh in meshes(data):
            rows = []
            if not only_peers:
                made = run(morula, "compare", mesh, "-n", SPHERES, "--methods", ",".join(OURS), "--threads", 1,
                           "--bodies", "largest", "--no-picture", "--json", "-q")["clumps"]
                rows = [(c["method"], "made" if c["error"] is None else c["error"], c.get("spheres"), c.get("D"),
                         c.get("cpu_seconds")) for c in made]
            for name, (kind, *more) in PROGRAMS.items():
                try:
                    got = theirs(python, kind, mesh, SPHERES, keep, *more)
                    d = None if only_peers else judged(morula, got["spheres"], mesh, pathlib.Path(work))
                    rows.append((name, "made", len(got["spheres"]), d, got["cpu"]))
                except RuntimeError as e:
                    rows.append((name, str(e), None, None, None))
                print(f"cost_peers: {mesh.stem}, {name}: {rows[-1][1:]}", file=sys.stderr, flush=True)
            for name, outcome, n, d, cpu in rows:
                table.writerow(dict(particle=mesh.stem, program=name, outcome=outcome, spheres=n or "",
                                    D="" if d is None else f"{d:.5f}", cpu_seconds="" if cpu is None else f"{cpu:.3f}"))
            f.flush()


def spread(values):
    return f"{statistics.mean(values):.4f} ± {statistics.stdev(values) if len(values) > 1 else 0:.4f}"


def summary(out):
    """The head and rows of a table, a row for each program, and the sentences below it."""
    by = {}
    for row in csv.DictReader(open(out)):
        by.setdefault(row["program"], {})[row["particle"]] = row
    made = lambda name: {p: r for p, r in by.get(name, {}).items() if r["D"]}
    head = ("program", "particles", "D", "D of `best`", "D of `best-draft`", "time over `best`", "over `best-draft`",
            "worst for `best`: particle, theirs, ours")
    rows, words = [], []
    ours = [made(name) for name in OURS]
    for name in PROGRAMS:
        all_of = made(name)
        both = [p for p in all_of if all(p in o for o in ours)]
        if not both:
            words.append(f"{name} made nothing.")
            continue
        d = lambda row: float(row["D"])
        time = lambda o: statistics.median(float(all_of[p]["cpu_seconds"]) / float(o[p]["cpu_seconds"]) for p in both)
        worst = max(both, key=lambda p: d(ours[0][p]) / d(all_of[p]))
        rows.append((name, len(both), spread([d(all_of[p]) for p in both]), *(spread([d(o[p]) for p in both]) for o in ours),
                     *(f"{time(o):.1f}" for o in ours), f"{worst}: {d(all_of[worst]):.4f}, {d(ours[0][worst]):.4f}"))
        better = sum(d(ours[0][p]) < d(all_of[p]) for p in both)
        words.append(f"`best` has the less D of the two on {better} of {len(both)} particles that {name} made.")
        lost = [f"{p} ({r['outcome']})" for p, r in by[name].items() if not r["D"]]
        if lost:
            words.append(f"Not made by {name}: {', '.join(lost)}.")
        fewer = [f"{p} ({r['spheres']})" for p, r in all_of.items() if int(r["spheres"]) != SPHERES]
        if fewer:
            words.append(f"Other than {SPHERES} spheres came from {name} for {', '.join(fewer)}.")
    return head, rows, words


if __name__ == "__main__":
    option = lambda name: sys.argv[sys.argv.index(name) + 1] if name in sys.argv else None
    with tempfile.TemporaryDirectory() as scratch:
        keep = pathlib.Path(option("--keep") or scratch)
        keep.mkdir(parents=True, exist_ok=True)
        out = option("--out") or str(HERE.parent / "docs/cost_peers.csv")
        only = "--only-peers" in sys.argv
        measure(os.path.abspath(sys.argv[1]), os.environ["MORULA_PEER_PYTHON"], pathlib.Path(os.environ["MORULA_DATA"]),
                out, keep, only)
        if not only:
            for part in summary(out):
                print(part)
