#!/usr/bin/env python3
"""Single impacts of a clump on a plane, here and in LAMMPS with the template that `morula export` writes.

    scripts/scenes_lammps.py [path of morula]

Both have a linear spring without damping or friction (there `wall/gran hooke`, here `normal = "linear"`: the same law), the same
step, the same poses. Printed are the greatest differences of velocity over the speed of the blow, and of spin times the clump's greatest
radius. Needs Debian's lmp. Exits with 1 where a difference is above 1e-3.
"""

import csv
import math
import os
import random
import subprocess
import sys
import tempfile

MORULA = sys.argv[1] if len(sys.argv) > 1 else "morula"
STIFFNESS, DENSITY, SPEED, STEP, STEPS, POSES = 1e6, 2600.0, 3.0, 2e-7, 6000, 12

INPUT = """\
units si
atom_style sphere
atom_modify map array
comm_modify vel yes
boundary f f f
region box block -0.2 0.2 -0.2 0.2 -0.2 0.2
create_box 1 box
molecule clump {folder}/clump.mol
fix prop all property/atom mol ghost yes
create_atoms 0 single {at[0]!r} {at[1]!r} {at[2]!r} mol clump 12345 rotate {angle!r} {axis[0]!r} {axis[1]!r} {axis[2]!r} units box
neighbor 1e-3 bin
neigh_modify exclude molecule/intra all
comm_modify cutoff 0.05
pair_style gran/hooke {k} 0 0 0 0 0
pair_coeff * *
timestep {step}
fix rigid all rigid/small molecule mol clump infile {folder}/body.txt
fix floor all wall/gran hooke {k} 0 0 0 0 0 zplane 0 NULL
thermo_style custom step
compute b all rigid/local rigid id vx vy vz omegax omegay omegaz
dump d all local {steps} {folder}/out.txt index c_b[2] c_b[3] c_b[4] c_b[5] c_b[6] c_b[7]
dump_modify d format float %.17g
run {steps}
"""

SCENE = """\
[run]
end = {end!r}
step = {step!r}
speed = {speed!r}
[effects]
normal = "linear"
[materials.m]
stiffness = {k!r}
[templates.clump]
spheres_file = "made.csv"
density = {density!r}
material = "m"
[[walls]]
plane = {{ normal = [0, 0, 1], offset = 0 }}
material = "m"
[[bodies]]
template = "clump"
position = [0, 0, {height!r}]
rotation = [{q[0]!r}, {q[1]!r}, {q[2]!r}, {q[3]!r}]
velocity = [0, 0, {down!r}]
[output]
measures = ["vx:0", "vy:0", "vz:0", "wx:0", "wy:0", "wz:0", "energy"]
"""


def call(*words):
    done = subprocess.run(words, capture_output=True, text=True)
    if done.returncode:
        sys.exit(f"{' '.join(words)}: {done.stdout[-800:]}{done.stderr}")


def section(text, name):
    """The numbers of a section of a molecule."""
    lines = text.split(f"\n{name}\n", 1)[1].strip("\n").split("\n")
    rows = []
    for line in lines:
        words = line.split()
        if not words or not words[0].isdigit():
            break
        rows.append([float(w) for w in words[1:]])
    return rows


def matrix(q):
    w, x, y, z = q
    return [
        [1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
        [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
        [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)],
    ]


def compare(name, words, folder):
    """The greatest differences over all poses."""
    made = os.path.join(folder, "made.csv")
    call(MORULA, "clump", *words, "-o", made)
    # Both take the body that the union of these spheres is, and its axes.
    for form, path in (("lammps", "clump.mol"),):
        call(MORULA, "export", made, "--density", str(DENSITY), "--to", form, "-o", os.path.join(folder, path))
    with open(os.path.join(folder, "clump.mol")) as f:
        text = f.read()
    spheres = [c + [0.5 * d[0]] for c, d in zip(section(text, "Coords"), section(text, "Diameters"))]
    mass = float(text.split(" mass\n")[0].split("\n")[-1])
    moments = [float(w) for w in text.split(" inertia\n")[0].split("\n")[-1].split()[:3]]
    reach = max(math.dist((0, 0, 0), s[:3]) + s[3] for s in spheres)
    chance = random.Random(1)
    worst = [0.0, 0.0]
    rebounds = []
    for _ in range(POSES):
        q = [chance.gauss(0, 1) for _ in range(4)]
        size = math.sqrt(sum(c * c for c in q))
        q = [c / size for c in q]
        half = math.acos(max(-1.0, min(1.0, q[0])))
        axis = [c / math.sin(half) for c in q[1:]]
        r = matrix(q)
        low = min(sum(r[2][k] * s[k] for k in range(3)) - s[3] for s in spheres)
        height = 1e-5 - low
        # A molecule is put where the mean of its atoms is, not its centre of mass.
        mean = [sum(s[k] for s in spheres) / len(spheres) for k in range(3)]
        at = [sum(r[a][k] * mean[k] for k in range(3)) for a in range(3)]
        at[2] += height
        j = [[sum(r[a][k] * moments[k] * r[b][k] for k in range(3)) for b in range(3)] for a in range(3)]
        own = [j[0][0], j[1][1], j[2][2], j[0][1], j[0][2], j[1][2]]
        body = " ".join(repr(v) for v in [mass, 0.0, 0.0, height, *own, 0.0, 0.0, -SPEED, 0.0, 0.0, 0.0])
        with open(os.path.join(folder, "body.txt"), "w") as f:
            f.write(f"1\n1 {body} 0 0 0\n")
        about = dict(folder=folder, height=height, k=STIFFNESS, step=STEP, steps=STEPS)
        with open(os.path.join(folder, "in.txt"), "w") as f:
            f.write(INPUT.format(angle=2 * math.degrees(half), axis=axis, at=at, **about))
        call("lmp", "-in", os.path.join(folder, "in.txt"), "-log", "none")
        with open(os.path.join(folder, "out.txt")) as f:
            theirs = [float(w) for w in f.read().strip().split("\n")[-1].split()[1:]]
        with open(os.path.join(folder, "scene.toml"), "w") as f:
            f.write(SCENE.format(end=STEP * STEPS, speed=SPEED, density=DENSITY, q=q, down=-SPEED, **about))
        call(MORULA, "simulate", os.path.join(folder, "scene.toml"), "-o", folder, "--quiet")
        with open(os.path.join(folder, "measures.csv")) as f:
            ours = [float(v) for v in list(csv.reader(f))[-1]]
        worst[0] = max(worst[0], math.dist(ours[:3], theirs[:3]) / SPEED)
        worst[1] = max(worst[1], math.dist(ours[3:6], theirs[3:6]) * reach / SPEED)
        rebounds.append(ours[2] / SPEED)
    print(
        f"{name}: {len(spheres)} spheres, {POSES} poses, vz/V from {min(rebounds):.3f} to {max(rebounds):.3f};"
        f" greatest difference of velocity {worst[0]:.1e}, of spin {worst[1]:.1e}"
    )
    return max(worst)


def main():
    # A built-in stone is 1 wide, the tablet in millimetres, the cylinder 1 high.
    cases = [
        ("stone", ["sample:stone", "--length-unit", "0.01", "-n", "30"]),
        ("tablet", ["sample:tablet", "--length-unit", "0.001", "-n", "60"]),
        ("cylinder", ["sample:cylinder", "--length-unit", "0.01", "-n", "100"]),
    ]
    worst = 0.0
    for name, words in cases:
        with tempfile.TemporaryDirectory() as folder:
            worst = max(worst, compare(name, words, folder))
    sys.exit(worst > 1e-3)


if __name__ == "__main__":
    main()
