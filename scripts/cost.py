#!/usr/bin/env python3
"""What accuracy costs in time, over the papers' shapes and real particles: writes docs/cost.md.

usage: cost.py MORULA [--no-peers] [--out docs/cost] [--keep FOLDER] [--parts NAME,…]

--keep FOLDER: parts that were made are kept there and not made again; --parts makes only these.

Without MORULA_DATA the built-in particles are all there is. With MORULA_PEER_PYTHON, an interpreter that has the
packages `multisphere` and `clump-python`, those are run together with ours on the same meshes (scripts/peer.py and
cost_peers.py), CLUMP with the parameters of Buchele et al. 2026, table 1. Times of others are processor seconds without imports, ours those
of `morula compare --threads 1`. Writes OUT.md, OUT_peers.csv, OUT_mean.svg and, with chromium, OUT.png; what is missing is named.
"""
import contextlib, io, json, math, os, pathlib, shutil, statistics, subprocess, sys, tempfile

HERE = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(HERE))
import cost_peers, step_cost
morula = os.path.abspath(sys.argv[1])
out = sys.argv[sys.argv.index("--out") + 1] if "--out" in sys.argv else "docs/cost"
peers = os.environ.get("MORULA_PEER_PYTHON") if "--no-peers" not in sys.argv else None
data = os.environ.get("MORULA_DATA")
root = pathlib.Path(data) if data else None
scratch = tempfile.TemporaryDirectory()
work = pathlib.Path(scratch.name)
COUNTS = (1, 2, 3, 5, 10, 20, 30, 50, 100)
PEER_SECONDS = 900
text, missing = [], []
# As fitted, with the steps between two lists.
MODEL = None


def note(words):
    missing.append(words)
    print(f"cost: {words}", file=sys.stderr, flush=True)


def run(*words, seconds=1200):
    done = subprocess.run([str(w) for w in (morula, *words)], capture_output=True, text=True, timeout=seconds)
    if done.returncode:
        raise RuntimeError(done.stderr.strip())
    return done.stdout


def say(*lines):
    text.extend(lines)


def table(head, rows, right=1):
    say("| " + " | ".join(head) + " |", "| " + " | ".join(["---"] * right + ["---:"] * (len(head) - right)) + " |")
    for r in rows:
        say("| " + " | ".join(str(c) for c in r) + " |")
    say("")


def price(shape, methods, counts=COUNTS, *more):
    if MODEL:
        more = (*more, "--step-model", ",".join(f"{v:.6g}" for v in MODEL))
    found = json.loads(run("cost", shape, "--counts", ",".join(map(str, counts)), "--methods", ",".join(methods),
                           "--threads", 1, "--no-files", "--json", "-q", *more))
    return {line["name"]: line for line in found["lines"]}


def stl(shape):
    """A shape as a mesh that other programs read."""
    if not str(shape).startswith("sample:") and pathlib.Path(shape).suffix == ".stl":
        return shape
    to = work / (pathlib.Path(str(shape)).stem.replace(":", "_").replace(",", "_") + ".stl")
    if str(shape).startswith("sample:"):
        run("sample", str(shape)[7:], "-q", "-o", to)
    else:
        import trimesh  # of the peers' interpreter
        trimesh.load_mesh(shape).export(to)
    return to


def label(shape):
    return str(shape).replace("sample:", "") if str(shape).startswith("sample:") else pathlib.Path(shape).stem


def bodies():
    """The shapes of the papers and some others."""
    all_of = ["sample:mandm", "sample:tablet", "sample:stone,seed=7"]
    if root:
        names = ("ellipsoid", "femur", "bunny", "octahedron", "torus")
        all_of = [root / "benchmark" / f"{n}.stl" for n in names] + all_of
    else:
        all_of = ["sample:ellipsoid", "sample:torus", "sample:box"] + all_of
        note("MORULA_DATA is not set: built-in particles only")
    return all_of


def particles():
    if not root:
        return [f"sample:stone,seed={k}" for k in range(1, 9)]
    found = [p for p in (root / "particles").rglob("*") if p.suffix in (".stl", ".obj", ".ply", ".off")]
    return sorted(found, key=str)


# ---- parts ----

def hardware():
    cpu = next((l.split(":", 1)[1].strip() for l in open("/proc/cpuinfo") if "model name" in l), "?")
    load = os.getloadavg()[0]
    say("# What accuracy costs in time", "",
        "Made by `sh scripts/figures.sh` (its part `scripts/cost.py`), with `MORULA_DATA` naming the meshes and",
        f"`MORULA_PEER_PYTHON` the interpreter of the other programs. {cpu}, {os.cpu_count()} cores, load {load:.1f} when",
        "it began: read times as ratios. One thread each.", "",
        "```sh", "morula cost stone.stl -n 100 -o stone        # the table, stone.csv, stone.svg, stone.html",
        "morula cost stone.stl --goal spheres --max-mismatch 0.05 --no-files",
        "morula cost stone.stl --goal mismatch --max-step-cost 50 --max-seconds 0.1 --no-files", "```", "",
        "From C: `morula_cost_curve`, `_copy`, `_clump`, `_choose`, and `morula_sweep_from_shape` over grids, methods and deadlines;",
        "in Rust `cost::{curve, choose, sweep}`; on the command line `--sweep-cells 24,48 --methods best,mss --seconds 0,0.01`.", "",
        "![The page of a stone](cost.png)", "")


def fitted():
    """What the fit tells; sets the model."""
    global MODEL
    told = io.StringIO()
    with contextlib.redirect_stdout(told):
        MODEL = (*step_cost.fit(), step_cost.REBUILD)
    return told.getvalue()


def model():
    told = fitted()
    a, b, c, d, e, _ = MODEL
    first = open(HERE / "step_cost.csv").readline().lstrip("# ").strip()
    row = lambda line: line.replace("|n|", "| n |") if line.startswith("|n|") else line
    say("## The cost of a step", "",
        "What a solver pays for a step with clumps of n spheres, over one with as many single spheres of the same volume:",
        "", f"    {a:.3g} + {b:.3g} n + {c:.3g} n² + ({d:.3g} n + {e:.3g} n²) / K        and 1 for n = 1", "",
        "with lists of neighbours made anew every K = 50 steps. Fitted by `scripts/step_cost.py` to LAMMPS: stones of the",
        "same places and turns at a solid fraction of 0.5, `gran/hooke/history`, `fix rigid/small` with our templates,",
        f"skin 0.1 d_eq ({first}). Rows beyond n = {step_cost.FITTED['lammps']} were not fitted. Two neighbours have n² pairs of spheres; the lists hold those within the skin,",
        "and the smaller the spheres the more these are: a step costs more than n times as much, and the more so the more",
        "spheres there are. A clump also allows a shorter step (`time step` below, over that of a sphere of the same mass, one spring):",
        "what simulated time costs is the quotient. In brackets: contacts and the rest + lists.", "")
    say(*map(row, told.splitlines()[1:]), "")
    own = io.StringIO()
    with contextlib.redirect_stdout(own):
        a, b, c, _, _ = step_cost.fit("morula")
    first = open(step_cost.FILES["morula"]).readline().lstrip("# ").strip()
    say("### The library's own engine", "",
        "`--step-model morula` (`StepModel::MORULA`; in C put the numbers into `step` and zeros into `lists`) prices with the",
        "engine of `morula simulate` in place of LAMMPS:", "",
        f"    {a:.3g} + {b:.3g} n + {c:.3g} n²        and 1 for n = 1", "",
        "The same stones, places, turns, speeds, stiffness and steps, by `scripts/step_cost.py --solver morula`; free space in place of the",
        f"periodic box ({first}). The engine keeps lists of bodies, not of spheres, and finds the spheres that touch by a tree in each clump:",
        "a step costs about what it does with single spheres up to hundreds of spheres, and more only by the contacts themselves. Its lists",
        "are in the cost of the step.", "")
    rows = step_cost.measured("morula")
    say(*map(row, own.getvalue().splitlines()[1:]), "",
        "Contacts of a stone: " + ", ".join(f"{r['contacts']:.1f} at n = {r['n']:g}" for r in rows) + ".", "")


def knee(line):
    return line["points"][line["choice"]]["n"] if line["choice"] is not None else "–"


def where(points):
    """The last point to which a doubling of the spheres still takes a fifth off D."""
    last = points[0]
    for before, after in zip(points, points[1:]):
        doublings = math.log2(after["n"] / before["n"]) if after["n"] > before["n"] else 0
        if doublings and (before["D"] / max(after["D"], 1e-9)) ** (1 / doublings) >= 1.25:
            last = after
    return last


def lists():
    say("## Price lists", "",
        "Method `best`. *time*: from a mesh that is read, with the distance field; *inertia*: error of the inertia that",
        "is left with corrected masses; *step*, *simulated time*: over single spheres.", "")
    fitted()
    paying = []
    for shape in bodies():
        try:
            found = price(shape, ["best", "best-draft"])
        except (RuntimeError, subprocess.TimeoutExpired) as e:
            note(f"{label(shape)}: {e}")
            continue
        points = found["best"]["points"]
        rows = [(p["n"], f"{p['D']:.4f}", f"{100 * p['coverage']:.1f}", f"{100 * p['overshoot']:.1f}",
                 f"{100 * p['surface_deq']:.2f}", f"{math.degrees(p['roughness_rad']):.1f}",
                 f"{100 * p['inertia']:.2g}", f"{1e3 * p['seconds']:.0f}", f"{p['step_factor']:.2f}",
                 f"{p['step_cost']:.3g}", f"{p['time_cost']:.3g}") for p in points]
        say(f"### {label(shape)}", "")
        table(("n", "D", "coverage %", "overshoot %", "surface % d_eq", "roughness °", "inertia %", "time ms",
               "time step", "step", "simulated time"), rows, 0)
        stop = where(points)
        before, after = points[-2:]
        fall = 100 * (1 - (after["D"] / before["D"]) ** (1 / math.log2(after["n"] / before["n"])))
        paying.append((label(shape), stop["n"], f"{stop['D']:.4f}", f"{stop['step_cost']:.3g}", knee(found["best"]),
                       f"{points[-1]['D']:.4f}", fall))
        print(f"cost: {label(shape)} done", file=sys.stderr, flush=True)
    return paying


def sentence(body, pays, there, step, bend, last, fall):
    """Where more spheres stop paying, of one body."""
    if pays < COUNTS[-1]:
        text = f"- {body}: more than {pays} spheres no longer pay, D is {there} there and {last} with {COUNTS[-1]}"
    else:
        text = (f"- {body}: the shape itself does not end it, the last doubling before {COUNTS[-1]} spheres still takes {fall:.0f} % "
                f"off D; what ends it is the cost of a step, {step} times that of a sphere there")
    if bend != "–" and bend < COUNTS[-1]:
        text += f"; against that cost the curve bends at {bend} already"
    return text + "."


def words(paying):
    say("## Where more spheres stop paying", "",
        "*pays to*: the last n of the list to which a doubling of the spheres still takes a fifth or more off D;",
        "*knee*: what `morula cost` chooses on its own, by D against the cost of a step (the last n where the curve has no",
        "knee).", "")
    table(("body", "pays to n", "D there", "step there", "knee", "D at the last n"), [p[:6] for p in paying])
    for p in paying:
        say(sentence(*p))
    say("")


def kept_table(name, heading):
    """A table of another page of ours, by the heading above it."""
    lines = (HERE.parent / "docs" / name).read_text().split(heading, 1)[1].splitlines()
    first = next(i for i, line in enumerate(lines) if line.startswith("|"))
    last = next((i for i in range(first, len(lines)) if not lines[i].startswith("|")), len(lines))
    return lines[first:last]


# Coverage in per cent and the spheres for it, Yuan 2019, table 2 and figure 11.
YUAN = {"M&M": ((95, 48), (99, 181), (99.9, 461), (99.99, 675)),
        "tablet": ((95.04, 96), (99, 456), (99.9, 1329)),
        "bunny": ((95, 255), (99, 1147), (99.9, 2855), (99.99, 4090))}


def papers():
    say("## The papers' own curves", "",
        "Inscribed spheres until a share of the volume is covered (`--method cover`, Yuan 2019) and spheres fitted to the",
        "surface (`--method surface-fit`, Price et al. 2007), beside what the papers say. The tables are those of",
        "[cover.md](cover.md) and [surface_fit.md](surface_fit.md), from where this page takes them; `cargo bench --bench cover",
        "-- table2 figure6 figure9` and `scripts/surface_fit.py` make them.", "",
        "### Yuan 2019, table 2: spheres for a coverage", "", *kept_table("cover.md", "## Table 2"), "",
        "*paper*: its spheres; the others ours with the difference in brackets: analytic candidates and those of thinned voxels,",
        "counted on all cells (V_p) or on those that any candidate covers (V_cs); *true*: exact coverage. A dash: out of reach.", "")
    for body, points in YUAN.items():
        (a, n), (b, m) = points[:2]
        (c, k), (d, l) = points[-2:]
        say(f"- {body}: the {m - n} spheres from {n} to {m} cover {b - a:.3g} % more, {(m - n) / (b - a):.0f} for each per cent; the "
            f"{l - k} from {k} to {l} cover {d - c:.2g} %, {(l - k) / (d - c):.0f} for each: beyond {m} they no longer pay.")
    say("", "### Yuan 2019, figure 6: coverage against n and the number of cells N", "",
        *kept_table("cover.md", "## Figure 6"), "",
        "Paper, another flat particle: 51, 50 and 49 spheres at 90 % for N = 60, 80 and 100, 41 with analytic candidates; V_cs / V_p 98.8 % at",
        "60 and 99.0 % at 100. More cells than 50 along the diameter hardly pay.", "",
        "### Yuan 2019, figure 9: spheres against sphericity", "", *kept_table("cover.md", "## Figure 9"), "",
        "### Price et al. 2007, figure 7: errors of a clump limited to n", "",
        "Of volume, centroid and spread (root of the covariance's eigenvalues), RMS over the particles, in per cent.", "",
        *kept_table("surface_fit.md", "## Fewer spheres"), "",
        "The paper's figure is a graph without numbers; in words it has an equilibrium near 10 spheres, beyond which more do not",
        "improve the mass properties of its compact diamonds; unlimited, table 2, their RMS errors are 0.4, 0.4 and 0.3 %. Here the",
        "error of the volume levels at 12 spheres, those of centroid and spread fall on to 20.", "")


def routes():
    say("## Levels that are free, chained or nested", "",
        "One solid and one distance field serve all. Free levels are what single calls give; chained ones start from the one",
        "before, which leaves them alike but is hardly quicker, as most of the time goes into the search after the start;",
        "nested ones hold all spheres of the one before, in its order, so that a solver takes as many as it needs. Their small",
        "levels must reach out less, and the large ones keep the spheres of the small. D of the levels, and seconds of all.", "")
    rows = []
    for shape in bodies()[:4] + ["sample:stone,seed=7"]:
        for levels in ("free", "chained", "nested"):
            try:
                line = price(shape, ["best"], (3, 10, 30, 100), "--levels", levels)["best"]
            except (RuntimeError, subprocess.TimeoutExpired) as e:
                note(f"{label(shape)}, {levels}: {e}")
                continue
            points = line["points"]
            rows.append((label(shape), levels, *(f"{p['D']:.4f}" for p in points), f"{points[-1]['seconds_so_far']:.2f}"))
    table(("body", "levels", "n = 3", "10", "30", "100", "s for all"), rows, 2)


MEAN_COUNTS = (1, 3, 10, 30, 100)


def mean():
    names = ("best", "best-draft", "inscribed", "mss")
    found = {n: [] for n in names}
    used = 0
    for shape in particles():
        try:
            lines = price(shape, names, MEAN_COUNTS, "--bodies", "largest") if root else price(shape, names, MEAN_COUNTS)
        except (RuntimeError, subprocess.TimeoutExpired) as e:
            note(f"{label(shape)}: {e}")
            continue
        used += 1
        for n, line in lines.items():
            found[n].append({p["asked"]: p for p in line["points"]})
    say(f"## The mean over {used} real particles", "",
        "After figure 11 of Buchele et al. 2026 (there 402 grains of the Sand Atlas, here those of the data folder): mean of D",
        "and its standard deviation; in brackets the mean time over that of `mss` at the smallest n.", "",
        "![Mean mismatch against the number of spheres](cost_mean.svg)", "")
    least = statistics.mean(c[MEAN_COUNTS[0]]["seconds"] for c in found["mss"] if MEAN_COUNTS[0] in c)
    rows, curves = [], {}
    for n in names:
        row, curve = [n], []
        for k in MEAN_COUNTS:
            ds = [c[k]["D"] for c in found[n] if k in c]
            ts = [c[k]["seconds"] for c in found[n] if k in c]
            if len(ds) < 2:
                row.append("–")
                continue
            m, s = statistics.mean(ds), statistics.stdev(ds)
            row.append(f"{m:.4f} ± {s:.4f} ({statistics.mean(ts) / least:.1f})")
            curve.append((k, m, s))
        rows.append(row)
        curves[n] = curve
    table(("method", *(f"n = {k}" for k in MEAN_COUNTS)), rows)
    errors = []
    for k in MEAN_COUNTS:
        some = [c[k] for c in found["best"] if k in c]
        rms = lambda key: math.sqrt(statistics.mean(p[key] ** 2 for p in some)) if some else 0
        errors.append((k, f"{100 * rms('union_inertia'):.2f}", f"{100 * rms('inertia'):.2g}"))
    say("After figure 7 of Price et al. 2007: RMS error of the inertia of `best` over the same particles, of the union of the",
        "spheres and with corrected masses, in per cent. (Figure 7 by the method of that paper, and figures 6 and 9 and table 2",
        "of Yuan 2019, stand below.)", "")
    table(("n", "union", "corrected masses"), errors, 0)
    say("With few spheres corrected masses leave more than the bare union does: a solver adds up the spheres, each with its own",
        "2/5 m r², and where overlapping ones share the mass no positive masses make up for the volume that lies between and",
        "outside of the small ones. The union is what a solver has that takes mass and inertia as they are.", "")
    picture(curves, used)


COLOURS = {"best": "#1f5fa0", "best-draft": "#e67e22", "inscribed": "#008c78", "mss": "#6e6e6e"}


def picture(curves, used):
    w, h, left, right, top, bottom = 860, 420, 70, 150, 30, 56
    ds = [d for c in curves.values() for _, m, s in c for d in (m + s, max(m - s, m / 3))]
    low, high = min(ds) * 0.9, max(ds) * 1.1
    x = lambda n: left + (w - left - right) * math.log10(n) / 2
    y = lambda d: h - bottom - (h - top - bottom) * math.log(max(d, low) / low) / math.log(high / low)
    svg = [f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {w} {h}" font-family="sans-serif" font-size="14">',
           f'<rect width="{w}" height="{h}" fill="#fff"/>']
    for n in (1, 2, 5, 10, 20, 50, 100):
        svg.append(f'<line x1="{x(n):.1f}" x2="{x(n):.1f}" y1="{top}" y2="{h - bottom}" stroke="#e6e6e6"/>'
                   f'<text x="{x(n):.1f}" y="{h - bottom + 19}" text-anchor="middle" fill="#5f646e">{n}</text>')
    for d in (.002, .005, .01, .02, .05, .1, .2, .5):
        if low <= d <= high:
            svg.append(f'<line x1="{left}" x2="{w - right}" y1="{y(d):.1f}" y2="{y(d):.1f}" stroke="#e6e6e6"/>'
                       f'<text x="{left - 8}" y="{y(d) + 5:.1f}" text-anchor="end" fill="#5f646e">{d:g}</text>')
    for name, c in curves.items():
        band = [f"{x(n):.1f} {y(m + s):.1f}" for n, m, s in c] + [f"{x(n):.1f} {y(max(m - s, m / 3)):.1f}" for n, m, s in reversed(c)]
        svg.append(f'<path d="M{"L".join(band)}Z" fill="{COLOURS[name]}" opacity="0.12"/>')
    for name, c in curves.items():
        svg.append(f'<path d="M{"L".join(f"{x(n):.1f} {y(m):.1f}" for n, m, _ in c)}" fill="none" stroke="{COLOURS[name]}" stroke-width="2.5"/>')
        svg += [f'<circle cx="{x(n):.1f}" cy="{y(m):.1f}" r="4" fill="{COLOURS[name]}"/>' for n, m, _ in c]
        if c:
            svg.append(f'<text x="{x(c[-1][0]) + 12:.1f}" y="{y(c[-1][1]) + 5:.1f}" fill="{COLOURS[name]}">{name}</text>')
    svg.append(f'<text x="{(left + w - right) / 2}" y="{h - 12}" text-anchor="middle">spheres</text>'
               f'<text x="18" y="{(top + h - bottom) / 2}" text-anchor="middle" transform="rotate(-90 18 {(top + h - bottom) / 2})">mismatch D</text>'
               f'<text x="{left}" y="20">mean over {used} real particles, band: standard deviation</text></svg>')
    pathlib.Path(out + "_mean.svg").write_text("\n".join(svg) + "\n")


# Peer, shape, n, and for CLUMP div and rMin of table 1 (None: swept).
def cells():
    if not root:
        return
    bench, real = root / "benchmark", root / "particles"
    for shape, n, div, rmin in ((bench / "ellipsoid.stl", 10, 100, .25), (bench / "femur.stl", 70, 150, 4),
                                (real / "stone" / "stone_S02.stl", 30, 100, None),
                                (real / "cement" / "ma160_01731_equant.stl", 30, 100, None)):
        yield shape, n, div, rmin


def beside():
    say("## Ours and theirs, at equal n and at equal time", "",
        "Same meshes, same run, one thread, processor seconds. `multisphere` (div 100) and CLUMP, Euclidean 3D, overlap",
        "0.95, with div and rMin of Buchele et al. 2026, table 1: ellipsoid 100 and 0.25, femur 150 and 4; for particles,",
        "where the table has 'varying', rMin 0, 2 and 5 % of the shortest edge at div 100, and the best of them. D by our exact columns for all.",
        "*equal time*: the least D of ours (`best`, draft, normal or thorough) within their time; *same D*: the fewest of our",
        "spheres that are as good, and their time by the clock with the distance field. Theirs hold loading, ours of the other columns the method alone.", "")
    rows = []
    for shape, n, div, rmin in cells():
        if not pathlib.Path(shape).exists():
            note(f"{shape} is missing")
            continue
        ours = json.loads(run("compare", shape, "-n", n, "--methods", "best-draft,best,best-thorough", "--threads", 1,
                              "--no-picture", "--json", "-q"))["clumps"]
        ours = [(c["method"], c["D"], c["cpu_seconds"] or c["wall_seconds"]) for c in ours if c["error"] is None]
        curve = price(shape, ["best"], (2, 3, 5, 7, 10, 15, 20, 30, 50, 70, 100))["best"]["points"]
        box = json.loads(run("info", shape, "--json"))
        shortest = min(b - a for a, b in zip(box["report"]["box_min"], box["report"]["box_max"]))
        runs = {"multisphere": [("mss",)]}
        radii = [rmin] if rmin is not None else [0, .02 * shortest, .05 * shortest]
        runs["CLUMP"] = [("clump-eu", div, r) for r in radii]
        for name, ways in runs.items():
            best = None
            for kind, *more in ways:
                try:
                    got = cost_peers.theirs(peers, kind, stl(shape), n, keep, *more, limit=PEER_SECONDS)
                    d = cost_peers.judged(morula, got["spheres"], shape, work)
                except (RuntimeError, subprocess.TimeoutExpired) as e:
                    note(f"{name} on {label(shape)}, n = {n}: {type(e).__name__} {str(e)[-160:]}")
                    continue
                if best is None or d < best[0]:
                    best = (d, got["cpu"], len(got["spheres"]))
            if best is None:
                rows.append((label(shape), n, name, "failed", "", "", "", ""))
                continue
            d, cpu, made = best
            normal = next(o for o in ours if o[0] == "best")
            within = [o for o in ours if o[2] <= cpu]
            equal = min(within, key=lambda o: o[1]) if within else None
            same = next((p for p in curve if p["D"] <= d), None)
            rows.append((label(shape), n, name + ("" if made == n else f" [{made}]"), f"{d:.4f} / {cpu:.2f} s",
                         f"{normal[1]:.4f} / {normal[2]:.2f} s",
                         f"{equal[1]:.4f} / {equal[2]:.2f} s" if equal else "–",
                         f"{same['n']}, {same['seconds']:.2f} s" if same else "–", f"{d / normal[1]:.1f}"))
            print(f"cost: {rows[-1]}", file=sys.stderr, flush=True)
    table(("body", "n", "program", "theirs: D / CPU", "ours, equal n", "ours, equal time", "same D with n", "D over ours"),
          rows, 3)
    say("[k]: only k spheres came.", "")


def everyone():
    path = out + "_peers.csv"
    if not (peers and root):
        if not pathlib.Path(path).exists():
            note("others' programs over all particles were not run")
            return
        note("others' programs over all particles: the figures are those of the last run")
    else:
        cost_peers.measure(morula, peers, root, path, keep)
    head, rows, sentences = cost_peers.summary(path)
    say(f"## Ours and theirs over real particles, n = {cost_peers.SPHERES}", "",
        "`multisphere` at div 100; CLUMP, Euclidean 3D, overlap 0.95, div 100, rMin 2 % of the shortest edge of the box, one set for all.",
        f"A run is ended after {cost_peers.LIMIT} s of processor time. Mean and standard deviation of D by our exact columns; *time*: median of",
        f"theirs over ours, processor seconds, one thread (`scripts/cost_peers.py`; every row in [{pathlib.Path(path).name}]({pathlib.Path(path).name})).", "")
    table(head, rows)
    say(*sentences, "")


def page():
    chromium = shutil.which("chromium")
    name = work / "page"
    fitted()
    run("cost", "sample:stone,seed=7", "-n", 100, "--step-model", ",".join(f"{v:.6g}" for v in MODEL), "-o", name, "-q", "--threads", 0)
    if not chromium:
        note("no chromium: the screenshot stays as it is")
        return
    subprocess.run([chromium, "--headless=new", "--no-sandbox", "--use-gl=angle", "--use-angle=swiftshader",
                    "--enable-unsafe-swiftshader", "--hide-scrollbars", "--window-size=1280,800",
                    "--virtual-time-budget=8000", f"--screenshot={os.path.abspath(out)}.png", f"file://{name}.html"],
                   check=True, capture_output=True, timeout=300)


def others():
    if peers and root:
        beside()
    else:
        note("others' programs were not run: MORULA_PEER_PYTHON and MORULA_DATA name them and their meshes")


PARTS = dict(head=hardware, mean=mean, others=others, everyone=everyone, model=model, lists=lambda: words(lists()), papers=papers,
             levels=routes, page=page)
option = lambda name: sys.argv[sys.argv.index(name) + 1] if name in sys.argv else None
keep = pathlib.Path(option("--keep") or work)
keep.mkdir(parents=True, exist_ok=True)
wanted = (option("--parts") or ",".join(PARTS)).split(",")
for name in wanted:
    kept = keep / f"{name}.json"
    if not kept.exists():
        text, missing = [], []
        PARTS[name]()
        kept.write_text(json.dumps([text, missing]))
if set(wanted) == set(PARTS):
    text, missing = [], []
    for name in PARTS:
        a, b = json.loads((keep / f"{name}.json").read_text())
        text, missing = text + a, missing + b
    if missing:
        text += ["## Left out", "", *(f"- {m}" for m in missing), ""]
    pathlib.Path(out + ".md").write_text("\n".join(text).rstrip() + "\n")
