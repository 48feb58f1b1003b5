#!/usr/bin/env python3
"""The table of masses over the real particles, and the same problems by another solver.

    MORULA_DATA=<data folder> python3 scripts/masses.py [path to morula] > docs/masses_figures.md

Standard library only; where SciPy is there, HiGHS solves the same linear programs beside.
"""
import csv, json, os, pathlib, subprocess, sys, tempfile, time

try:
    import numpy
    from scipy.optimize import linprog
except ImportError:
    linprog = None

NUMBERS = (10, 20, 30, 50, 100)
morula = sys.argv[1] if len(sys.argv) > 1 else "target/release/morula"
data = os.environ.get("MORULA_DATA")
if not data:
    sys.exit("MORULA_DATA is not set")
root = pathlib.Path(data) / "particles"
files = sorted(p for p in root.rglob("*") if p.suffix in (".stl", ".obj", ".ply", ".off"))
folder = tempfile.TemporaryDirectory()
out = os.path.join(folder.name, "clump.csv")


def clump(path, n, objective):
    words = ["clump", path, "-n", n, "--density", 1, "--masses", objective, "--quality", "overlap",
             "--json", "--format", "csv", "-o", out]
    done = subprocess.run([morula, *map(str, words)], capture_output=True, text=True)
    if done.returncode:
        return None, done.stderr.strip().rsplit("[", 1)[-1].rstrip("]")
    with open(out) as lines:
        rows = list(csv.reader(line for line in lines if not line.startswith("#")))
    return json.loads(done.stdout), [[float(x) for x in row] for row in rows[1:]]


def equations(found, spheres):
    """The ten rows of a unit of mass, without units, in the frame of the principal axes."""
    s = numpy.array(spheres)
    mass, centre, i = found["mass"], numpy.array(found["centre"]), found["inertia"]
    tensor = numpy.array([[i[0], i[3], i[4]], [i[3], i[1], i[5]], [i[4], i[5], i[2]]]) / mass
    moments, axes = numpy.linalg.eigh(tensor)
    length = (0.5 * moments.sum()) ** 0.5
    d = (s[:, :3] - centre) @ axes
    own = 0.4 * s[:, 3] ** 2 + (d * d).sum(axis=1)
    rows = [numpy.ones(len(s))] + [d[:, k] / length for k in range(3)]
    rows += [(own - d[:, k] ** 2) / moments[k] for k in range(3)]
    rows += [-d[:, a] * d[:, b] / (moments[a] * moments[b]) ** 0.5 for a, b in ((0, 1), (0, 2), (1, 2))]
    return numpy.array(rows), numpy.array([1.0, 0, 0, 0, 1, 1, 1, 0, 0, 0])


def by_highs(found, spheres):
    """The greatest least share of the mass with all ten equations, and the least inertia error."""
    a, b = equations(found, spheres)
    n = a.shape[1]
    least = found["min_mass"] / found["mass"]
    start = time.perf_counter()
    most = linprog([0] * n + [-1], A_eq=numpy.c_[a, a.sum(axis=1)], b_eq=b,
                   bounds=[(0, None)] * n + [(None, None)])
    seconds = time.perf_counter() - start
    soft = numpy.vstack([numpy.c_[a[4:], -numpy.ones(6)], numpy.c_[-a[4:], -numpy.ones(6)]])
    error = linprog([0] * n + [1], A_ub=soft, b_ub=numpy.r_[b[4:], -b[4:]],
                    A_eq=numpy.c_[a[:4], numpy.zeros(4)], b_eq=b[:4],
                    bounds=[(least, None)] * n + [(0, None)])
    return -most.fun if most.status == 0 else None, error.fun, seconds


print("# Masses of clumps of real particles\n")
print("Made by `scripts/masses.py`: clumps of the method best at its normal effort, masses with the objective even")
print("for the mass, centre and inertia of the particle, no mass below a thousandth of the whole. `=`: all")
print("ten equations hold, the greatest residual beside it; `~`: mass and centre hold, the inertia error ε beside")
print("it is the least that positive masses allow. In brackets: how many masses are at the least one.\n")
print("| particle | coverage, n = 100 | " + " | ".join(f"n = {n}" for n in NUMBERS) + " |")
print("|---|---:|" + "---|" * len(NUMBERS))
exact = {n: 0 for n in NUMBERS}
count, worst, solves = 0, 0.0, []
apart = {"most": 0.0, "error": 0.0}
for path in files:
    row, coverage = [], 0.0
    for n in NUMBERS:
        found, spheres = clump(path, n, "even")
        if found is None:
            row.append(spheres)
            continue
        r = {key: found[f"{key}_residual"] for key in ("mass", "centre", "inertia")}
        greatest = max(r["mass"], r["centre"], r["inertia"])
        is_exact = found["mass_status"] == "exact"
        exact[n] += is_exact
        coverage = found["coverage"]
        worst = max(worst, greatest if is_exact else max(r["mass"], r["centre"]))
        held = f" ({len(found['binding'])})" if found["binding"] else ""
        row.append(f"{'=' if is_exact else '~'} {greatest:.1e}{held}")
        if linprog is not None:
            most, error, seconds = by_highs(found, spheres)
            solves.append((n, seconds))
            if is_exact:
                other, _ = clump(path, n, "max_min")
                least = min(other["masses"]) / other["mass"]
                apart["most"] = max(apart["most"], abs(least - most))
            else:
                apart["error"] = max(apart["error"], abs(r["inertia"] - error) / error)
    if row:
        count += 1
        name = str(path.relative_to(root))
        print(f"| {name} | {coverage:.3f} | " + " | ".join(row) + " |")
print("| **exact** | | " + " | ".join(f"**{exact[n]} of {count}**" for n in NUMBERS) + " |")
print(f"\nGreatest residual of what is said to hold: {worst:.1e}.")
if linprog is not None:
    print("HiGHS (by SciPy) finds for the same spheres the same greatest least mass, to "
          f"{apart['most']:.0e} of the whole,")
    print(f"and the same least ε, to {apart['error']:.0e} of it.")
