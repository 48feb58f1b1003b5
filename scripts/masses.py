#!/usr/bin/env python3
"""The figures of masses: what real particles take, the same problems by other solvers, and times.

    MORULA_DATA=<data folder> python3 scripts/masses.py [--morula PATH] [--profile NAME] [stones | least | times …]

Without words all three parts, as docs/masses_figures.md has them. `stones` needs the standard
library alone and compares with HiGHS where SciPy is there; `least` and `times` need SciPy. `times`
builds the benchmark (cargo bench --bench masses) and uses GLPK where glpsol is there; run it on a
machine that does nothing else.
"""
import argparse, csv, json, os, pathlib, shutil, subprocess, sys, tempfile, time

try:
    import numpy
    from scipy.optimize import linprog
except ImportError:
    linprog = None

NUMBERS = (10, 20, 30, 50, 100)
folder = tempfile.TemporaryDirectory()
out = os.path.join(folder.name, "clump.csv")


def particles():
    data = os.environ.get("MORULA_DATA")
    if not data:
        sys.exit("MORULA_DATA is not set")
    root = pathlib.Path(data) / "particles"
    files = sorted(p for p in root.rglob("*") if p.suffix in (".stl", ".obj", ".ply", ".off"))
    return [(p, str(p.relative_to(root))) for p in files]


def say(*words):
    done = subprocess.run([morula, *map(str, words)], capture_output=True, text=True)
    return (json.loads(done.stdout), "") if done.returncode == 0 else (None, done.stderr.strip())


def rows_of(path):
    with open(path) as lines:
        rows = list(csv.reader(line for line in lines if not line.startswith("#")))
    return [[float(x) for x in row] for row in rows[1:]]


def clump(path, n, objective, *more):
    found, wrong = say("clump", path, "-n", n, "--density", 1, "--masses", objective, "--quality", "overlap",
                       "--json", "--format", "csv", "-o", out, *more)
    return (found, rows_of(out)) if found else (None, wrong.rsplit("[", 1)[-1].rstrip("]"))


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


def least_share(n):
    """The least share of the mass that is asked for where nothing else is said."""
    return min(1e-3, 0.1 / n)


def greatest_least(a, b):
    """The greatest least share of the mass with these equations; None where there is none."""
    n = a.shape[1]
    most = linprog([0] * n + [-1], A_eq=numpy.c_[a, a.sum(axis=1)], b_eq=b,
                   bounds=[(0, None)] * n + [(None, None)])
    return -most.fun if most.status == 0 else None


def least_error(a, b, least):
    """The least error of the inertia, mass and centre exact: eq 8 of Yuan 2019."""
    n, m = a.shape[1], len(b) - 4
    soft = numpy.vstack([numpy.c_[a[4:], -numpy.ones(m)], numpy.c_[-a[4:], -numpy.ones(m)]])
    error = linprog([0] * n + [1], A_ub=soft, b_ub=numpy.r_[b[4:], -b[4:]],
                    A_eq=numpy.c_[a[:4], numpy.zeros(4)], b_eq=b[:4],
                    bounds=[(least, None)] * n + [(0, None)])
    return error.fun if error.status == 0 else None


def is_exact(a, b):
    most = greatest_least(a, b)
    return most is not None and most >= least_share(a.shape[1]) * (1 - 1e-9)


def stones():
    print("## Residuals\n")
    print("Clumps of the method best at its normal effort, masses with the objective even for the mass, centre and")
    print("inertia of the particle, no mass below a thousandth of the whole. `=`: all ten equations hold, the")
    print("greatest residual beside it; `~`: mass and centre hold, the inertia error ε beside it is the least that")
    print("positive masses allow. In brackets: how many masses are at the least one.\n")
    print("| particle | coverage, n = 100 | " + " | ".join(f"n = {n}" for n in NUMBERS) + " |")
    print("|---|---:|" + "---|" * len(NUMBERS))
    exact = {n: 0 for n in NUMBERS}
    count, worst = 0, 0.0
    apart = {"most": 0.0, "error": 0.0}
    for path, name in particles():
        row, coverage = [], 0.0
        for n in NUMBERS:
            found, spheres = clump(path, n, "even")
            if found is None:
                row.append(spheres)
                continue
            r = {key: found[f"{key}_residual"] for key in ("mass", "centre", "inertia")}
            greatest = max(r["mass"], r["centre"], r["inertia"])
            holds = found["mass_status"] == "exact"
            exact[n] += holds
            coverage = found["coverage"]
            worst = max(worst, greatest if holds else max(r["mass"], r["centre"]))
            held = f" ({len(found['binding'])})" if found["binding"] else ""
            row.append(f"{'=' if holds else '~'} {greatest:.1e}{held}")
            if linprog is None:
                continue
            a, b = equations(found, spheres)
            if holds:
                other, _ = clump(path, n, "max_min")
                least = min(other["masses"]) / other["mass"]
                apart["most"] = max(apart["most"], abs(least - greatest_least(a, b)))
            else:
                error = least_error(a, b, found["min_mass"] / found["mass"])
                apart["error"] = max(apart["error"], abs(r["inertia"] - error) / error)
        count += 1
        print(f"| {name} | {coverage:.3f} | " + " | ".join(row) + " |", flush=True)
    print("| **exact** | | " + " | ".join(f"**{exact[n]} of {count}**" for n in NUMBERS) + " |")
    print(f"\nGreatest residual of what is said to hold: {worst:.1e}.")
    if linprog is not None:
        print("HiGHS (by SciPy) finds for the same spheres the same greatest least mass, to "
              f"{apart['most']:.0e} of the whole,")
        print(f"and the same least ε, to {apart['error']:.0e} of it.")


def prefixes(path):
    """Of the clumps that are the first n spheres of a cover: n, spheres, union, coverage."""
    found, spheres = say("clump", path, "--method", "cover", "--candidates", "analytic", "-n", 100, "--density", 1,
                         "--masses", "none", "--quality", "none", "--json", "--format", "csv", "-o", out)
    if found is None:
        return
    spheres = rows_of(out)
    for n in range(2, len(spheres) + 1):
        with open(out, "w") as file:
            file.write("x,y,z,r\n" + "".join(",".join(map(repr, s)) + "\n" for s in spheres[:n]))
        union, _ = say("measure", out, "--density", 1, "--json")
        # No sphere of a cover reaches beyond the surface.
        yield n, spheres[:n], union, union["mass"] / found["mass"], found


def trace(body):
    return sum(body["inertia"][:3])


def of_cover(path):
    """What Yuan 2019, section 4, has of each of its particles."""
    cells = {}
    for n, spheres, union, coverage, whole in prefixes(path):
        a, b = equations(union, spheres)
        for name, rows in (("seven", 7), ("ten", 10)):
            if name not in cells and n >= 4 and is_exact(a[:rows], b[:rows]):
                cells[name] = n
        for part in (0.90, 0.95):
            if part not in cells and coverage >= part:
                lacking = 1 - trace(union) / trace(whole)
                cells[part] = (n, lacking, 1 - coverage ** (5 / 3))
                if part == 0.90:
                    cells["errors"] = [least_error(a[:k], b[:k], least_share(n)) for k in (7, 10)]
        if len(cells) == 5:
            break
    if "ten" in cells:
        # The library's own word on the same clumps.
        for n, status in ((cells["ten"], "exact"), (cells["ten"] - 1, "relaxed")):
            ours, why = clump(path, n, "max_min", "--method", "cover", "--candidates", "analytic", "--target", "union")
            if ours is None or ours["mass_status"] != status:
                cells["ours"] = f"differs at {n}: {ours['mass_status'] if ours else why}"
    return cells


def of_best(path, target):
    """The least number of spheres with masses for seven equations, and for all ten by the library."""
    seven = ten = None
    for n in range(4, 101):
        found, spheres = clump(path, n, "max_min", "--target", target)
        if found is None:
            continue
        a, b = equations(found, spheres)
        if seven is None and is_exact(a[:7], b[:7]):
            seven = n
        if found["mass_status"] == "exact":
            ten = n
            break
    return seven, ten


def least():
    print("## The least number of spheres\n")
    print("Yuan 2019, section 4: the masses of a clump for the moments of its own union. *Seven*: mass, centre")
    print("and the three moments in the principal frame, as there; *ten*: with the products, which seven leave as")
    print("they come. The first n with masses of at least a thousandth of the whole (a tenth of the mean beyond")
    print("100); greater ones may have none. Cover: the first n spheres of one clump (analytic candidates, the paper's")
    print("method); best: a clump for each n, for its union and for the particle itself. ε: least inertia error at")
    print("90 % coverage; ε_w: what")
    print("the union lacks of the particle's inertia, with what a particle shrunk to that coverage would, 1 − c^(5/3).\n")
    print("| particle | cover: seven | ten | n at 90 % | ε seven | ε ten | ε_w | 1 − c^(5/3) | n at 95 % | ε_w | "
          "1 − c^(5/3) | best, union: seven | ten | best, particle: seven | ten |")
    print("|---|" + "---:|" * 14)
    dash = lambda value: "–" if value is None else str(value)
    share = lambda value: "–" if value is None else f"{100 * value:.1f} %"
    error = lambda value: "–" if value is None else "0" if value < 1e-9 else share(value)
    counted = {}
    for path, name in particles():
        c = of_cover(path)
        coarse, fine = c.get(0.90, (None,) * 3), c.get(0.95, (None,) * 3)
        errors = c.get("errors", (None, None))
        best = [*of_best(path, "union"), *of_best(path, "mesh")]
        cells = [dash(c.get("seven")), dash(c.get("ten")), dash(coarse[0]), error(errors[0]), error(errors[1]),
                 share(coarse[1]), share(coarse[2]), dash(fine[0]), share(fine[1]), share(fine[2]), *map(dash, best)]
        keep = {"cover seven": c.get("seven"), "cover ten": c.get("ten"), "best seven": best[0], "best ten": best[1],
                "particle seven": best[2], "particle ten": best[3], "w90": coarse[1], "w95": fine[1]}
        for key, value in keep.items():
            counted.setdefault(key, []).append(value)
        print(f"| {name} | " + " | ".join(cells) + " |" + (f" {c['ours']}" if "ours" in c else ""), flush=True)
    print("\n| | least | median | greatest | beyond 100 |\n|---|---:|---:|---:|---:|")
    for key, values in counted.items():
        there = sorted(v for v in values if v is not None)
        shown = share if key.startswith("w") else dash
        key = {"w90": "ε_w at 90 %", "w95": "ε_w at 95 %"}.get(key, key)
        row = [shown(v) for v in (there[0], there[len(there) // 2], there[-1])] if there else ["–"] * 3
        print(f"| {key} | " + " | ".join(row) + f" | {len(values) - len(there)} |")


def program(row, objective):
    """Costs, equations and bounds of an objective, in multiples of the mean mass."""
    a, b = equations(row, row["spheres"])
    n = row["n"]
    a = a / n
    least = row["min_mass"] * n / row["mass"]
    if objective == "max_min":
        rows = numpy.c_[a, a.sum(axis=1)]
        return [0.0] * n + [-1.0], rows, b, [(0, None)] * n + [(least, None)]
    return [0.0] * (n - 1) + [-1.0], a, b, [(least, None)] * n


def by_highs(parts):
    costs, rows, right, bounds = parts
    least = float("inf")
    for _ in range(15):
        start = time.perf_counter()
        found = linprog(costs, A_eq=rows, b_eq=right, bounds=bounds, method="highs")
        least = min(least, time.perf_counter() - start)
    return 1e3 * least, -found.fun if found.status == 0 else None


def by_glpk(parts):
    """GLPK as a process that reads the program from a file."""
    if not shutil.which("glpsol"):
        return None, None
    costs, rows, right, bounds = parts
    mps, said = os.path.join(folder.name, "masses.mps"), os.path.join(folder.name, "masses.txt")
    with open(mps, "w") as file:
        file.write("NAME masses\nROWS\n N cost\n" + "".join(f" E r{r}\n" for r in range(len(right))) + "COLUMNS\n")
        for j, cost in enumerate(costs):
            cells = [("cost", cost)] + [(f"r{r}", rows[r][j]) for r in range(len(right))]
            file.writelines(f" x{j} {name} {float(v)!r}\n" for name, v in cells if v != 0)
        file.write("RHS\n" + "".join(f" b r{r} {float(v)!r}\n" for r, v in enumerate(right) if v != 0) + "BOUNDS\n")
        file.writelines(f" LO bound x{j} {low!r}\n" for j, (low, _) in enumerate(bounds))
        file.write("ENDATA\n")
    least = float("inf")
    for _ in range(15):
        start = time.perf_counter()
        subprocess.run(["glpsol", "--freemps", mps, "-w", said], capture_output=True, check=True)
        least = min(least, time.perf_counter() - start)
    with open(said) as lines:
        status = next(line.split() for line in lines if line.startswith("s bas"))
    return 1e3 * least, -float(status[-1]) if status[5] == "f" else None


def times():
    print("## Times\n")
    print("Milliseconds for scattered spheres with about twenty neighbours each, the least of 15 runs, one thread;")
    print("`union`: the moments; HiGHS through SciPy with its own checks, GLPK as a process that reads the same")
    print("program from a file. Made by `scripts/masses.py times`.\n")
    ran = subprocess.run(["cargo", "bench", "--quiet", "--profile", args.profile, "--bench", "masses"], capture_output=True, text=True)
    if ran.returncode:
        sys.exit(ran.stderr)
    print("| spheres | union | `even` | `max_min` | HiGHS | GLPK | `max_last` | HiGHS | GLPK |")
    print("|---:|" + "---:|" * 8)
    apart, statuses = 0.0, set()
    shown = lambda value: "–" if value is None else f"{value:.2g}" if value < 10 else f"{value:.0f}"
    for line in ran.stdout.splitlines():
        if not line.startswith("{"):
            continue
        row = json.loads(line)
        statuses.update(row["statuses"])
        cells = [row["union"], row["even"]]
        for objective, best in (("max_min", row["best_least"]), ("max_last", row["best_last"])):
            parts = program(row, objective)
            cells.append(row[objective])
            for seconds, optimum in (by_highs(parts), by_glpk(parts)):
                cells.append(seconds)
                if optimum is not None:
                    apart = max(apart, abs(best * row["n"] / row["mass"] / optimum - 1))
        print(f"| {row['n']} | " + " | ".join(map(shown, cells)) + " |", flush=True)
    print(f"\nAll are {' or '.join(sorted(statuses))}; the optima of all solvers agree to {apart:.0e}.")


PARTS = {"stones": stones, "least": least, "times": times}
reader = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
reader.add_argument("parts", nargs="*", metavar="stones | least | times")
reader.add_argument("--morula", default="target/release/morula", help="the program [target/release/morula]")
reader.add_argument("--profile", default="bench", help="how the benchmark is built [bench]")
args = reader.parse_args()
morula = args.morula
for part in args.parts:
    if part not in PARTS:
        reader.error(f"{part} is no part: {', '.join(PARTS)}")
asked = args.parts or list(PARTS)
if linprog is None and asked != ["stones"]:
    sys.exit("SciPy is not there: only the part stones can be made")
print("# Masses of clumps of real particles\n\nMade by `scripts/masses.py`.")
for part in asked:
    print()
    PARTS[part]()
