#!/usr/bin/env python3
"""How much inscribed clumps cover.

    MORULA_DATA=<data folder> python3 scripts/inscribed.py [path to morula] > docs/inscribed.md

Standard library only; one thread.
"""
import json, os, pathlib, subprocess, sys

# Shape, spheres, and how many the plain greedy cover of the study needs for 90 %.
NINETY = (("bunny", 100, 140), ("hexahedron", 72, 89), ("femur", 90, 119))
NUMBERS = (10, 30, 100)
TOLERANCES = (0, 0.01, 0.02)
morula = sys.argv[1] if len(sys.argv) > 1 else "target/release/morula"
data = os.environ.get("MORULA_DATA")
if not data:
    sys.exit("MORULA_DATA is not set")
root = pathlib.Path(data) / "benchmark"


def clump(name, effort, *more):
    words = [morula, "clump", root / f"{name}.stl", "--method", "inscribed", "--effort", effort,
             "--cells", 128, "--threads", 1, "--json", "-o", os.devnull, "--format", "csv", *more]
    done = subprocess.run(list(map(str, words)), capture_output=True, text=True)
    if done.returncode:
        sys.exit(f"{name}: {done.stderr.strip()}")
    return json.loads(done.stdout)


def cell(c):
    return f"{100 * c['coverage']:.2f} %, {c['stages']['generate']:.2f} s"


print("""# Clumps within the surface

Made by `scripts/inscribed.py`: the method `inscribed` on 128 cells along the longest edge, default
seed, one thread. Coverage is measured on columns that have nothing to do with the method; the time
is that of the generator, without reading, grid and quality. The protrusion is the greatest reach
of any sphere beyond the mesh over the equivalent diameter. The surface is that of the triangles: at a
hole of an open mesh the inside ends at none, and spheres may reach out through it as far as its
edges let them.

## 90 % of the volume

| shape | spheres | `draft` | `normal` | `thorough` | protrusion | plain greedy cover needs |
| --- | ---: | ---: | ---: | ---: | ---: | ---: |""")
for name, n, greedy in NINETY:
    all_three = [clump(name, e, "-n", n) for e in ("draft", "normal", "thorough")]
    worst = max(c["protrusion"] / c["equivalent_diameter"] for c in all_three)
    cells = " | ".join(map(cell, all_three))
    print(f"| {name} | {n} | {cells} | {worst:.1e} | {greedy} |", flush=True)
print("\n## All benchmark shapes, `normal`\n\n| shape | " +
      " | ".join(f"n = {n}" for n in NUMBERS) + " |\n| --- |" + " ---: |" * len(NUMBERS))
for path in sorted(root.glob("*.stl")):
    cells = " | ".join(cell(clump(path.stem, "normal", "-n", n)) for n in NUMBERS)
    print(f"| {path.stem} | {cells} |", flush=True)

print("""
## With a tolerance

`--tolerance`, here over the equivalent diameter: every radius is the depth and so much more. What the
spheres cover; for 30 of them also how much of the volume they add outside and how far they reach beyond
the mesh, over the equivalent diameter.

| shape | tolerance | n = 10 | n = 30 | n = 100 | outside | protrusion |
| --- | ---: | ---: | ---: | ---: | ---: | ---: |""")
for name, _, _ in NINETY:
    size = clump(name, "draft", "-n", 1)["equivalent_diameter"]
    for tolerance in TOLERANCES:
        made = [clump(name, "normal", "-n", n, "--tolerance", tolerance * size) for n in NUMBERS]
        covered = " | ".join(f"{100 * c['coverage']:.2f} %" for c in made)
        outside, reach = 100 * made[1]["overshoot"], made[1]["protrusion"] / size
        print(f"| {name} | {tolerance} | {covered} | {outside:.2f} % | {reach:.4f} |", flush=True)
