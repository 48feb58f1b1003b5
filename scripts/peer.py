#!/usr/bin/env python3
"""Runs one program of the field in a process of its own.

usage: peer.py mss|clump-eu|clump-fav|clump-fm MESH N OUT.json [DIV RMIN]

Needs the PyPI packages `multisphere` (mss) and `clump-python` (the others), which are GPL-3: they are run,
never linked or copied. RMIN ending with % is a share of the box's shortest edge. Writes the spheres in the
mesh's frame and the seconds of CPU of loading and making, without imports.
"""
import contextlib, io, json, os, resource, sys, warnings

for name in ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS"):
    os.environ[name] = "1"
warnings.filterwarnings("ignore")
import numpy as np
import trimesh


def cpu():
    u = resource.getrusage(resource.RUSAGE_SELF)
    return u.ru_utime + u.ru_stime


peer, mesh, n, out = sys.argv[1], sys.argv[2], int(sys.argv[3]), sys.argv[4]
div, rmin = (int(sys.argv[5]), sys.argv[6]) if len(sys.argv) > 6 else (100, "0")
with contextlib.redirect_stdout(io.StringIO()):
    if peer == "mss":
        import multisphere
        start = cpu()
        made = multisphere.multisphere_from_mesh(
            multisphere.load_mesh(mesh), div=100, min_center_distance_vox=4, max_spheres=n, confine_mesh=False)
        seconds, centers, radii = cpu() - start, made.centers, made.radii
    else:
        import CLUMP
        if not mesh.endswith(".stl"):
            # It reads that format alone.
            trimesh.load_mesh(mesh).export(out + ".stl")
            mesh = out + ".stl"
        bounds = trimesh.load_mesh(mesh).bounds
        shortest = float((bounds[1] - bounds[0]).min())
        rmin = float(rmin[:-1]) / 100 * shortest if rmin.endswith("%") else float(rmin)
        vertices = len(trimesh.load(mesh).vertices)
        start = cpu()
        if peer == "clump-eu":
            # It works in a frame about the middle of the box.
            _, made = CLUMP.GenerateClump_Euclidean_3D(mesh, n, rmin, div, 0.95)
            shift = bounds.mean(0)
        elif peer == "clump-fav":
            _, made = CLUMP.GenerateClump_Favier(mesh, n, chooseDistance="min")
            shift = np.zeros(3)
        else:
            _, made = CLUMP.GenerateClump_Ferellec_McDowell(
                mesh, dmin=0, rmin=0.01 * shortest, rstep=0.01 * shortest, pmax=(n - 0.5) / vertices, seed=5)
            shift = np.zeros(3)
        seconds, centers, radii = cpu() - start, made.positions + shift, made.radii
spheres = np.column_stack([centers, np.ravel(radii)])
with open(out, "w") as f:
    json.dump(dict(cpu=seconds, spheres=spheres.tolist()), f)
