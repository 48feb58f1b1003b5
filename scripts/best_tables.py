#!/usr/bin/env python3
"""The tables of demands and of symmetry in docs/best.md, and that of the built-in particles in README.md.

usage: [MORULA_DATA=<data folder>] best_tables.py MORULA [--keep]

Puts the rows measured anew below the marks <!-- rows: NAME --> of both files; --keep prints them only. Tables whose
shapes are not there stay as they are. Default seed; lengths in parts of the equivalent diameter d.
"""
import functools, json, math, os, pathlib, subprocess, sys

morula, keep = sys.argv[1], "--keep" in sys.argv
home = pathlib.Path(__file__).resolve().parent.parent
data = os.environ.get("MORULA_DATA")
benchmark = pathlib.Path(data) / "benchmark" if data else None
BUNNY, HEXAHEDRON, FEMUR = ("bunny", 30), ("hexahedron", 20), ("femur", 70)
BUILT_IN = ("tablet", "mandm", "ellipsoid", "stone,seed=7")
SYMMETRIC = ("sample:box", "sample:ellipsoid", "sample:torus", "sample:tablet", "sample:cone", "octahedron")


@functools.cache
def clump(shape, n, *flags):
    """The figures of a clump."""
    if not shape.startswith("sample:"):
        if benchmark is None:
            raise FileNotFoundError(shape)
        shape = str(next(p for p in (benchmark / f"{shape}.stl", benchmark / f"{shape}.npy") if p.exists()))
    done = subprocess.run([morula, "clump", shape, "-n", str(n), "-q", "--json", *flags],
                          check=True, capture_output=True, text=True)
    out = json.loads(done.stdout)
    out["d"] = out["equivalent_diameter"]
    out["greatest"] = max(s[3] for s in out["spheres"]) / out["d"]
    return out


def diameter(shape):
    return clump(shape, 1, "--effort", "draft", "--quality", "overlap")["d"]


def rows(of, values, cells):
    """A row for each shape and value; the shape is named once."""
    out = []
    for shape, n in of:
        for k, value in enumerate(values):
            out.append([f"{shape} {n}" if k == 0 else "", *cells(shape, n, value)])
    return out


def percent(x, places=2):
    return f"{100 * x:.{places}f} %"


def overshoot(shape, n, w):
    r = clump(shape, n, *(() if w == 1 else ("--overshoot-weight", str(w))))
    return f"{w:g}", f"{r['D']:.4f}", f"{r['coverage']:.4f}", f"{r['overshoot']:.4f}", percent(r["protrusion"] / r["d"])


def protrusion(shape, n, most):
    r = clump(shape, n, *(() if most is None else ("--max-protrusion", repr(most / 100 * diameter(shape)))))
    return ("any" if most is None else f"{most:g} %", f"{r['D']:.4f}", f"{r['coverage']:.4f}",
            f"{r['overshoot']:.4f}", percent(r["protrusion"] / r["d"]))


def radius(shape, n, part):
    free = clump(shape, n)["greatest"]
    r = clump(shape, n) if part == 1 else clump(shape, n, "--max-radius", repr(part * free * diameter(shape)))
    return (f"{'any: ' if part == 1 else ''}{part * free:.3f} d", f"{r['D']:.4f}", f"{r['coverage']:.4f}",
            f"{r['overshoot']:.4f}")


def volume(shape, n, equal):
    r = clump(shape, n, *(("--equal-volume",) if equal else ()))
    error = r["coverage"] + r["overshoot"] - 1
    return ("yes" if equal else "no", f"{r['D']:.4f}", f"{r['coverage']:.4f}", f"{r['overshoot']:.4f}",
            f"{error:.0e}".replace("e-0", "e-").replace("-", "−", 1) if error < 0 else f"{error:.0e}".replace("e-0", "e-"))


def smoothness(shape, n, s):
    r = clump(shape, n, *(() if s == 0 else ("--smoothness", str(s))))
    return (f"{s:g}", f"{r['D']:.4f}", percent(r["rms_distance"] / r["d"]), percent(r["protrusion"] / r["d"]),
            f"{r['roughness']:.3f}")


def symmetry():
    out, quotients = [], []
    for shape in SYMMETRIC:
        row = [shape.removeprefix("sample:")]
        for n in (5, 10, 20, 50, 100):
            free, kept = (clump(shape, n, *f)["D"] for f in ((), ("--symmetry", "auto")))
            quotients.append((kept / free, f"{row[0]} {n}"))
            row.append(f"{free:.4f} / {kept:.4f}")
        out.append(row)
    mean = math.exp(sum(math.log(q) for q, _ in quotients) / len(quotients))
    print(f"symmetry: {mean:.3f} in the geometric mean, at most {max(quotients)}")
    for shape in ("hexahedron", "teapot"):
        r = clump(shape, 20, "--symmetry-plane", "1,0,0"), clump(shape, 20)
        print(f"one mirror plane, {shape} 20: {r[0]['D']:.4f} for {r[1]['D']:.4f}")
    return out


def built_in():
    out = []
    for name in BUILT_IN:
        for n in (10, 50, 200):
            cells = []
            for method in ("mss", "best"):
                r = clump(f"sample:{name}", n, "--method", method)
                cells.append(f"{r['D']:.3f} ({percent(r['coverage'], 1)})")
            out.append([f"`{name}`" if n == 10 else "", str(n), *cells])
    return out


TABLES = {
    "overshoot weight": lambda: rows((BUNNY, HEXAHEDRON), (.3, 1, 3, 10), overshoot),
    "greatest protrusion": lambda: rows((BUNNY, HEXAHEDRON), (.1, .5, 1, 3, None), protrusion),
    "greatest radius": lambda: rows((BUNNY, HEXAHEDRON), (1, .7, .5), radius),
    "equal volume": lambda: rows((BUNNY, HEXAHEDRON), (False, True), volume),
    "smoothness": lambda: rows((BUNNY, HEXAHEDRON, FEMUR), (0, .3, 1, 4), smoothness),
    "symmetry": symmetry,
    "built-in particles": built_in,
}
made = {}
for name, table in TABLES.items():
    try:
        made[name] = [("| " + " | ".join(row) + " |").replace("|  |", "| |") for row in table()]
        print(f"{name}:", *made[name], sep="\n", flush=True)
    except (FileNotFoundError, StopIteration):
        print(f"{name}: the shapes are not there, the table stays", file=sys.stderr)

for path in () if keep else (home / "docs/best.md", home / "README.md"):
    out, lines = [], path.read_text().split("\n")
    while lines:
        line = lines.pop(0)
        out.append(line)
        if line.startswith("<!-- rows: "):
            name = line.removeprefix("<!-- rows: ").removesuffix(" -->")
            if name in made:
                out += [""] + [lines.pop(0) for _ in range(3)][1:] + made[name]
                while lines and lines[0].startswith("|"):
                    lines.pop(0)
    path.write_text("\n".join(out))
