#!/usr/bin/env python3
"""The table over the real particles of the method surface-fit: mass properties as in table 2 of
Price, Murariu and Morrison (DEM 2007).

    MORULA_DATA=<data folder> python3 scripts/surface_fit.py [path to morula] > docs/surface_fit.md

Standard library only.
"""
import csv, json, math, os, pathlib, statistics, subprocess, sys

SEEDS = (0, 1, 2)
COMPACT = 0.93
morula = sys.argv[1] if len(sys.argv) > 1 else "target/release/morula"
data = os.environ.get("MORULA_DATA")
if not data:
    sys.exit("MORULA_DATA is not set")
root = pathlib.Path(data) / "particles"
files = sorted(p for p in root.rglob("*") if p.suffix in (".stl", ".obj", ".ply", ".off"))
with open(pathlib.Path(data) / "MANIFEST.csv") as f:
    convexity = {r["path"]: float(r["convexity"] or 0) for r in csv.DictReader(f)}


def clump(path, *words):
    done = subprocess.run(
        [morula, "clump", str(path), "--method", "surface-fit", "--json", "--quality", "overlap",
         "--frame", "body", "--density", "1", "--masses", "none", "-o", os.devnull, "--format", "csv",
         *map(str, words)],
        capture_output=True, text=True)
    if done.returncode != 0:
        sys.exit(f"{path}: {done.stderr.strip()}")
    return json.loads(done.stdout)


def spreads(moments, volume):
    """Square roots of the eigenvalues of the covariance, from principal moments of inertia."""
    return [math.sqrt((sum(moments) / 2 - i) / volume) for i in moments]


def errors(c):
    """Of volume, of the centroid over d_eq, of the three spreads (RMS), in per cent."""
    target = spreads(c["inertia"][:3], c["volume"])
    union = spreads([i * (1 + e) for i, e in zip(c["inertia"], c["moment_errors"])],
                    c["volume"] * (1 + c["volume_error"]))
    spread = rms([u / t - 1 for u, t in zip(union, target)])
    return [100 * c["volume_error"], 100 * c["centroid_error"], 100 * spread]


def rms(values):
    return math.sqrt(sum(v * v for v in values) / len(values))


def row(*cells):
    print("| " + " | ".join(map(str, cells)) + " |")


print("""# Surface fit: spheres through four points, fitted

Method `surface-fit`: M. Price, V. Murariu, G. Morrison, *Sphere clump generation and trajectory
comparison for real particles* (DEM 2007). Spheres through four random points of the surface; those
that touch it from inside stay; alike ones are brought together; then points are given to spheres and
spheres fitted to their points by Levenberg-Marquardt, in turn, which squeezes some out. The number
of spheres is the method's own; `-n` limits it.

## What differs from the paper, and why

- **Points by area, not vertices** (4096, one in each equal part of the area along a space-filling
  curve; over the openings of an open mesh too). Vertices stand where the mesh maker put them (a cube
  has eight) and all lie outside of a polyhedron's mean surface; points by area keep the volume. Walls
  within the body and closed cavities get none: spheres cannot leave these open.
- **A point belongs to the sphere it lies deepest in**, or least outside of. That is its distance from
  the union; to the nearest centre, or surface, a sphere may reach out beyond its points unseen.
- **Equation 7 on both sides, then the surface.** The paper culls only spheres that lie too deep. Here
  a sphere may reach beyond the hull or stay from the surface by 3 % of the equivalent diameter, and
  15 % of its radius, at most; in a waist, which no plane of the hull touches, the surface decides. The
  hull is that of half-spaces in 512 directions, half of them normals of the body: it needs no care
  for flat or tiny bodies, and what little more it holds the surface sieves out.
- **Half of the quadruples come from windows of the list**, of any width: neighbours on the surface.
  Four of all points are hardly ever those of one small corner.
- **Strides of at most 1 % of the equivalent diameter in a round.** The best sphere of a nearly flat
  patch is huge. On its way it comes to hold points beyond the patch, which keep it; without this, six
  of the particles below ended as one or two spheres, the volume up to 3.7 times too great.
- **Spheres go one at a time**, the poorest first (less than 2.5 % of the points), and one of two that
  became alike. Given to each at once, points might have saved another.
- **Limited to n**, the largest n are fitted once more, so that they share all points.

Levenberg-Marquardt over all spheres at once and over each sphere are the same: with points given
to spheres no two of them share a residual. Degenerate quadruples (coincident, collinear, cocircular,
coplanar) are told apart by heights of the tetrahedron over its longest edge: exact signs of the
determinant would not help, as a sphere through nearly flat points is no use, whatever its sign.

## Mass properties of real particles

Made by `scripts/surface_fit.py`, n free, seeds 0, 1, 2. Volume: mean signed error; centroid: RMS
distance over the equivalent diameter; spread: RMS relative error of the square roots of the
covariance's eigenvalues; of the union of spheres against the exact moments, in per cent. Convexity is
the volume over that of the convex hull.
""")
row("particle", "convexity", "n", "D", "volume %", "centroid %", "spread %", "s")
print("|---|---:|---|---:|---:|---:|---:|---:|")
every, compact, per_stone = [], [], []
for path in files:
    name = str(path.relative_to(root))
    runs = [clump(path, "--seed", s) for s in SEEDS]
    e = [errors(c) for c in runs]
    volume = statistics.mean(x[0] for x in e)
    centroid, spread = rms([x[1] for x in e]), rms([x[2] for x in e])
    per_stone.append([rms([x[0] for x in e]), centroid, spread])
    every += e
    solid = convexity.get(f"particles/{name}", 0.0)
    if solid >= COMPACT:
        compact += e
    row(name, f"{solid:.3f}", ", ".join(str(c["n"]) for c in runs),
        f"{statistics.mean(c['D'] for c in runs):.4f}", f"{volume:+.2f}", f"{centroid:.2f}",
        f"{spread:.2f}", f"{statistics.mean(c['stages']['generate'] for c in runs):.2f}")

print("\n## Beside table 2 of the paper\n")
row("RMS error, %", "paper (7 diamonds)", f"compact (convexity ≥ {COMPACT})", "all particles",
    "all, median", "all, greatest")
print("|---|---:|---:|---:|---:|---:|")
for k, (what, paper) in enumerate((("volume", 0.4), ("centroid", 0.4), ("spread", 0.3))):
    column = [s[k] for s in per_stone]
    row(what, paper, f"{rms([x[k] for x in compact]):.2f}", f"{rms([x[k] for x in every]):.2f}",
        f"{statistics.median(column):.2f}", f"{max(column):.2f}")
print("""
The paper's 7 diamonds took 8 to 19 spheres. Its centroid error is relative to the coordinates, which
depends on where the origin lies; here it is over the equivalent diameter.

## Fewer spheres (figure 7)

RMS errors over all particles at seed 0, in per cent.
""")
row("n at most", "volume", "centroid", "spread", "D, geometric mean")
print("|---:|---:|---:|---:|---:|")
for n in (1, 2, 3, 5, 8, 12, 20):
    runs = [clump(path, "-n", n) for path in files]
    e = [errors(c) for c in runs]
    d = math.exp(statistics.mean(math.log(c["D"]) for c in runs))
    row(n, *(f"{rms([x[k] for x in e]):.2f}" for k in range(3)), f"{d:.4f}")
