#!/usr/bin/env python3
"""MSS against the reference implementation of its paper, on the same voxels.

usage: compare_mss.py CACHE [--offset 1.0] [--out docs/mss] [SHAPE ...]
       compare_mss.py CACHE --record tests/mss_reference.csv

Needs the PyPI package `multisphere` (run by this script's own interpreter, never
linked), the meshes in $MORULA_DATA/benchmark and
`cargo build --release --example mss_voxels`. The reference's voxel grids and spheres
are kept in CACHE, so that it runs once. Both clumps are judged by one
evaluator: the reference's grid, a cell counts when its centre lies in a sphere.
Writes OUT.csv and prints a table in markdown; with --record only the reference's figures and
the size of its grids, for `tests/mss_reference.rs`.
"""
import contextlib, io, json, os, resource, subprocess, sys, warnings

for name in ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS"):
    os.environ[name] = "1"
warnings.filterwarnings("ignore")
import numpy as np

NUMBERS = [5, 10, 20, 30, 50, 70, 100]
SHAPES = ["ellipsoid", "femur", "torus", "octahedron", "hexahedron", "bunny", "teapot",
          "swiss_cheese", "ice_cream_cone", "example_mesh", "example_voxels"]
# The paper's own grids and numbers: (shape, cells on the shortest side, spheres).
PAPER = {"ellipsoid102": ("ellipsoid", 102, 10), "femur102": ("femur", 102, 70)}
ROOT = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
OURS = os.path.join(ROOT, "target", "release", "examples", "mss_voxels")


def cpu():
    u = resource.getrusage(resource.RUSAGE_SELF)
    return u.ru_utime + u.ru_stime


def reference(cache, tag, shape, div, numbers):
    """Grid and spheres of the reference, in cells (centres of cells are whole numbers)."""
    if all(os.path.exists(f"{cache}/{tag}_{n}.json") for n in numbers):
        return
    import multisphere as mss
    from multisphere.multisphere_io import _mesh_to_voxel_grid
    data = os.path.join(os.environ["MORULA_DATA"], "benchmark")
    with contextlib.redirect_stdout(io.StringIO()):
        if shape == "example_voxels":
            grid = mss.load_voxels_from_npy(f"{data}/{shape}.npy")
        else:
            grid = _mesh_to_voxel_grid(mss.load_mesh(f"{data}/{shape}.stl"), div=div, padding=2)
    np.save(f"{cache}/{tag}_grid.npy", grid.data.astype(np.uint8))
    last = None
    for n in numbers:
        if last is None or last["n"] >= last["asked"]:
            with contextlib.redirect_stdout(io.StringIO()):
                start = cpu()
                made = mss.multisphere_from_voxels(grid, min_center_distance_vox=4, max_spheres=n)
                seconds = cpu() - start
            h = float(grid.voxel_size)
            spheres = np.column_stack([(made.centers - grid.origin) / h, np.ravel(made.radii) / h])
            last = dict(asked=n, n=len(spheres), cpu=seconds, spheres_vox=spheres.tolist())
        with open(f"{cache}/{tag}_{n}.json", "w") as f:
            json.dump(dict(last), f)


def ours(cache, tag, n, offset):
    out = f"{cache}/{tag}_{n}_{offset}.csv"
    line = subprocess.run([OURS, f"{cache}/{tag}_grid.npy", out, str(n), str(offset)],
                          check=True, capture_output=True, text=True).stdout
    spheres = np.loadtxt(out, delimiter=",", skiprows=1, ndmin=2)
    return spheres, json.loads(line)


def mismatch(target, spheres):
    clump = np.zeros(target.shape, bool)
    for x, y, z, r in spheres:
        cut = [slice(max(0, int(np.floor(c - r))), max(0, int(np.ceil(c + r)) + 1)) for c in (x, y, z)]
        part = clump[tuple(cut)]
        g = np.ogrid[tuple(slice(s.start, s.start + n) for s, n in zip(cut, part.shape))]
        part |= (g[0] - x) ** 2 + (g[1] - y) ** 2 + (g[2] - z) ** 2 <= r * r
    both = np.count_nonzero(target & clump)
    return 1 - 2 * both / (np.count_nonzero(target) + np.count_nonzero(clump))


def main():
    args = sys.argv[1:]
    def take(key, default):
        if key not in args:
            return default
        at = args.index(key)
        value = args[at + 1]
        del args[at:at + 2]
        return value
    record = take("--record", None)
    offset, out = float(take("--offset", "1.0")), take("--out", "docs/mss")
    cache, names = args[0], args[1:] or SHAPES + list(PAPER)
    os.makedirs(cache, exist_ok=True)
    rows = []
    known = []
    for tag in names:
        shape, div, numbers = (*PAPER[tag][:2], [PAPER[tag][2]]) if tag in PAPER else (tag, 100, NUMBERS)
        reference(cache, tag, shape, div, numbers)
        target = np.load(f"{cache}/{tag}_grid.npy") > 0
        for n in numbers:
            with open(f"{cache}/{tag}_{n}.json") as f:
                ref = json.load(f)
            if record:
                figures = (mismatch(target, np.array(ref["spheres_vox"])), *target.shape, np.count_nonzero(target))
                known.append((shape, div, n, ref["n"], "%.6f" % figures[0], *figures[1:]))
                continue
            plain, figures = ours(cache, tag, n, 0.0)
            wide, wide_figures = ours(cache, tag, n, offset)
            rows.append(dict(
                shape=tag, n=n, reference_n=ref["n"], reference_D=mismatch(target, np.array(ref["spheres_vox"])),
                reference_cpu=ref["cpu"], offset_n=len(wide), offset_D=mismatch(target, wide),
                offset_cpu=wide_figures["mss_s"], plain_n=len(plain), plain_D=mismatch(target, plain),
                plain_cpu=figures["mss_s"], bytes_per_cell=figures["bytes"] / figures["cells"]))
            print(rows[-1], file=sys.stderr, flush=True)
    if record:
        with open(record, "w") as f:
            f.write("shape,cells on the shortest side,spheres asked,spheres,D,nx,ny,nz,solid cells\n")
            f.writelines(",".join(map(str, row)) + "\n" for row in known)
        return
    with open(f"{out}.csv", "w") as f:
        f.write(",".join(rows[0]) + "\n")
        for r in rows:
            f.write(",".join(f"{v:.4f}" if isinstance(v, float) else str(v) for v in r.values()) + "\n")
    print("| shape | n | reference D [n] | ours, offset 1 | ours, no offset | reference CPU s | ours CPU s |")
    print("| --- | --- | --- | --- | --- | --- | --- |")
    for r in rows:
        short = lambda k: f" [{r[k + '_n']}]" if r[k + "_n"] < r["n"] else ""
        print(f"| {r['shape']} | {r['n']} | {r['reference_D']:.4f}{short('reference')} | {r['offset_D']:.4f}{short('offset')} "
              f"| {r['plain_D']:.4f}{short('plain')} | {r['reference_cpu']:.2f} | {r['plain_cpu']:.2f} |")
    mean = lambda k: np.exp(np.mean([np.log(r[k] / r["reference_D"]) for r in rows]))
    print(f"\nGeometric mean of D over the reference's D: {mean('offset_D'):.3f} with the offset, {mean('plain_D'):.3f} without.")
    worst = max(rows, key=lambda r: r["offset_D"] - r["reference_D"])
    print(f"Greatest D less the reference's, with the offset: {worst['offset_D'] - worst['reference_D']:+.4f} ({worst['shape']}, n = {worst['n']}).")


main()
