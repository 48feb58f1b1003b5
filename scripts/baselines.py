#!/usr/bin/env python3
"""The baselines of the field over the benchmark shapes, beside the programs that made them known.

    MORULA_DATA=<data folder> [MORULA_PEERS=<csv>] python3 scripts/baselines.py [morula] > docs/baselines.md

The csv holds what other programs reach: columns peer, variant, shape, n_asked, n_got, status, D.
Standard library only.
"""
import csv, json, math, os, pathlib, subprocess, sys

NUMBERS = (10, 30, 100)
# Ours, its tolerance in hundredths of the shortest edge of the box, the program beside it, its name
# and variant in the csv.
PAIRS = (
    ("euclidean", 0.0, None, None, None),
    ("euclidean", 0.5, "CLUMP-EU", "clump_eu", "overlap.95"),
    ("ferellec-mcdowell", 0.0, "CLUMP-FM", "clump_fm", "dmin0"),
    ("favier", 0.0, "CLUMP-Fav", "clump_fav", "min"),
    ("uniform-grid", 0.0, None, None, None),
)
morula = sys.argv[1] if len(sys.argv) > 1 else "target/release/morula"
data = os.environ.get("MORULA_DATA")
if not data:
    sys.exit("MORULA_DATA is not set")
root = pathlib.Path(data) / "benchmark"
shapes = sorted(p for p in root.iterdir() if p.suffix in (".stl", ".npy"))
peers = {}
if os.environ.get("MORULA_PEERS"):
    with open(os.environ["MORULA_PEERS"], newline="") as file:
        for r in csv.DictReader(file):
            if r["status"] == "ok" and r["D"]:
                key = (r["peer"], r["variant"], r["shape"], int(r["n_asked"]))
                peers[key] = (float(r["D"]), int(r["n_got"]))


def shortest(path):
    done = subprocess.run([morula, "info", str(path), "--json"], capture_output=True, text=True)
    report = json.loads(done.stdout)
    report = report.get("report", report)
    return min(hi - lo for lo, hi in zip(report["box_min"], report["box_max"]))


def clump(path, method, tolerance, n):
    words = [morula, "clump", path, "--method", method, "-n", n, "--json", "--quality", "overlap",
             "--threads", 0, "-o", os.devnull, "--format", "csv", "--tolerance", tolerance]
    done = subprocess.run([str(w) for w in words], capture_output=True, text=True)
    if done.returncode:
        return None, done.stderr.strip().splitlines()[-1].replace(str(path), path.name)
    figures = json.loads(done.stdout)
    return (figures["D"], figures["n"]), ""


def cell(found, n):
    if found is None:
        return "–"
    return f"{found[0]:.4f}" + ("" if found[1] == n else f" [{found[1]}]")


print("""# The baselines of the field

Four generators of the literature, for comparison in one library. All measure exact distances to the
surface, of meshes and of voxels, work in any unit, give the same bytes for any number of threads, and
say why there are fewer spheres than were asked for. `--tolerance` lets spheres reach so far beyond the
surface; without it none does. The surface is that of the triangles: at a hole of an open mesh the inside
ends at none, and spheres may reach out through it as far as its edges let them.

## What differs from the sources

- **euclidean** (CLUMP, Angelidakis et al. 2021): the greatest ball in what is left, then the ball is
  shrunk by the overlap (`--overlap`, 0.9: nine tenths of its radius) and taken away. What is taken away
  are balls, so the depth of what is left follows from the depth of the body by a subtraction: one
  distance field serves all spheres where the source makes one for each. Centres are found between
  the cells, radii are exact; the source has half a cell too much in each, and its shift.
- **ferellec-mcdowell** (Ferellec and McDowell 2010): balls that touch the surface at its points from
  inside. The points are spread by area (the source takes vertices, so that a cube has eight and the
  result depends on the triangles); a ball shrinks to the surface (Ma, Bae and Choi 2012) instead of
  growing step by step to vertices, which never ends on a mesh inside out; the next ball is
  that which comes near most points that none is near, where the source draws at random. Where the
  normal says little (steps of voxels) the slope of the distance stands beside it. It ends where
  every point has its ball: the source's percentage is the number of spheres here.
- **favier** (Favier et al. 1999; CLUMP): balls about an axis, that of revolution or of the least moment
  of inertia. Radii are exact depths on the axis, not distances of vertices in slices, which may be
  empty; balls that others hold are left out; the centres are spread evenly over the rest. For a body
  whose axis runs outside of it there is no clump, and the error says so.
- **uniform-grid** (Garcia et al. 2009; Li, Xu and Meng 2015): a ball about every cell of the grid, each
  time the one that covers most cells not yet covered. Garcia's demand that each sphere meet one before it
  is not made. Balls that reach less than a fifth of a cell beyond a neighbour's are left out;
  of balls of more than twenty cells across, some rows of cells stand for all.

Where parts of a surface cross each other, the inner walls limit the balls too.

`ferellec-mcdowell` is poor at `example_mesh` and `example_voxels`, a heap of grown-together grains: it chooses
by the surface that balls touch, and the large ones in the middle touch little of it. In voxels, where balls
have no room in the steps, it is poorer again. On an ellipsoid of 128 voxels it is as good as
`uniform-grid` (D 0.112, 0.058, 0.046 against 0.125, 0.066, 0.044).

Spheres at the vertices of the Voronoi diagram of surface points (Hubbard 1996) are not offered: they are
the balls of `ferellec-mcdowell` up to the spacing of the points, and would take a Delaunay triangulation
in three dimensions for it.
""")
print("## D\n")
print("Made by `scripts/baselines.py`: defaults, 64 cells along the longest edge; D is Buchele et al. 2026,")
print("equation 27, on exact columns. [k]: only k spheres. CLUMP is `clump-python` 0.3.3 with 100 cells")
print("along the shortest edge, its D by an independent evaluator on 256 cells along the longest. The")
print("spheres of CLUMP-EU are half a cell too large: beside it stands `euclidean, t` with a tolerance")
print("of half such a cell. `ice_cream_cone` is a staircase: balls inside have no room in its steps.\n")
head = ["shape", "n"]
for ours, beyond, theirs, _, _ in PAIRS:
    head += [ours + (", t" if beyond else "")] + ([theirs] if peers and theirs else [])
print("| " + " | ".join(head) + " |\n|---|" + "---:|" * (len(head) - 1))
ratios, failures = {theirs: [] for _, _, theirs, _, _ in PAIRS if theirs}, {}
for path in shapes:
    hundredth = 0.01 * shortest(path)
    for n in NUMBERS:
        row = [path.stem, str(n)]
        for ours, beyond, theirs, peer, variant in PAIRS:
            found, error = clump(path, ours, beyond * hundredth, n)
            if error:
                failures[(path.name, ours)] = error
            row.append(cell(found, n))
            if peers and theirs:
                other = peers.get((peer, variant, path.stem, n))
                row.append(cell(other, n))
                if found and other and other[0] < 0.9:
                    ratios[theirs].append(math.log(found[0] / other[0]))
        print("| " + " | ".join(row) + " |", flush=True)
if peers:
    print("\nGeometric mean of D over that of CLUMP, where it delivers a clump of D below 0.9:")
    means = [(theirs, math.exp(sum(v) / len(v)), len(v)) for theirs, v in ratios.items() if v]
    print(", ".join(f"{theirs} {mean:.2f} ({k} cells)" for theirs, mean, k in means) + ".")
for (name, method), error in failures.items():
    print(f"\nRefused: {name}, {method}: {error}")
