#!/usr/bin/env python3
"""What a step of a DEM solver costs with clumps: runs LAMMPS or our engine, fits a model.

    python3 scripts/step_cost.py [--solver lammps|morula] [--morula PATH] [--repeat N] [--fit] [--numbers 1,3,10,…]

Writes scripts/step_cost.csv, or for our engine scripts/step_cost_morula.csv (what was measured) and prints the
coefficients, which src/cost/step.rs holds; --fit leaves the file as it is and fits it anew. Needs `lmp` (Debian:
lammps), which makes the places of the stones for both.

The scene: stones of one volume (sample:stone,seed=7, d_eq = 1) in a periodic box at a solid fraction of 0.5, 64 of
them pressed together once as clumps of 30 spheres; then clumps of every n stand in the same places, eight such boxes
up to n = 100, one above. Hooke contacts with
tangential history and friction, fix rigid/small with our templates, spheres of one clump excluded from each other's
lists, skin 0.1 d_eq, lists made anew every 50 steps. n = 1 is the sphere of equal volume with fix nve/sphere.
One process; processor time of LAMMPS's own breakdown, the least of the repetitions.

Our engine (`morula simulate`) takes the same stones, places, turns, velocities, stiffness, friction and steps. It has
no periodic boundaries: the boxes stand side by side in free space, more of them for few spheres, for a tenth of a
second at most, in which the outermost stones move by 0.05 d_eq. Its lists are of bodies and are made anew when these
have moved far enough: their cost is in that of the step. Processor time of a long run less that of a short one.

The model, in units of what a step of single spheres costs in the whole:
    step(n) = a + b n + c n^2          contacts, integration, communication
    lists(n) = (d n + e n^2) / 50      neighbour lists, once in 50 steps
and 1 for n = 1. Least squares of relative errors, coefficients not below 0.
"""
import argparse, csv, json, math, os, pathlib, random, re, subprocess, sys, tempfile

HERE = pathlib.Path(__file__).resolve().parent
FILES = {"lammps": HERE / "step_cost.csv", "morula": HERE / "step_cost_morula.csv"}
NUMBERS = (1, 3, 10, 30, 100, 300, 1000)
# Up to here rows are fitted; those beyond tell how far the model holds.
FITTED = {"lammps": 300, "morula": 1000}
SIDE, SPACING, FRACTION = 4, 1.5, 0.5
SHAPE = "sample:stone,seed=7"
REBUILD, SKIN, STEP = 50, 0.1, 2e-4
STIFF = 300.0
VOLUME = math.pi / 6
BOX = (SIDE ** 3 * VOLUME / FRACTION) ** (1 / 3)

HEAD = f"""\
units si
atom_style {{style}}
atom_modify map array
comm_modify vel yes
boundary p p p
newton on
"""
CONTACT = f"""\
pair_style gran/hooke/history {STIFF} NULL 2.0 NULL 0.5 1
pair_coeff * *
timestep {{step}}
neighbor {SKIN} bin
thermo_style custom step
"""
LISTS = f"neigh_modify every {REBUILD} delay 0 check no one 100000 page 2000000\n"


def contact(n):
    """Shorter steps of more spheres, as more of them share a contact; the cost of a step is the same."""
    return CONTACT.format(step=STEP * min(1, 30 / n))


def clump(morula, n, folder):
    """The spheres and masses of a template in its body frame."""
    spheres, mol = folder / f"{n}.csv", folder / f"{n}.mol"
    effort = "normal" if n <= 300 else "draft"
    run = lambda *words: subprocess.run([str(w) for w in (morula, *words)], check=True, stdout=subprocess.DEVNULL)
    run("clump", SHAPE, "-n", n, "--effort", effort, "--density", 1, "-o", spheres, "--quality", "none", "-q", "--least-error")
    run("export", spheres, "--target", SHAPE, "--density", 1, "--to", "lammps", "-o", mol, "--least-error")
    rows, section = {}, None
    head = {}
    for line in mol.read_text().splitlines()[1:]:
        words = line.split()
        if len(words) == 1 and words[0].isalpha():
            section = words[0]
            rows[section] = []
        elif section and words:
            rows[section].append([float(w) for w in words[1:]])
        elif words and words[-1] in ("inertia", "com", "mass"):
            head[words[-1]] = [float(w) for w in words[:-1]]
    return rows, head, mol


def lammps(text, folder, name):
    path = folder / name
    path.write_text(text)
    done = subprocess.run(["lmp", "-in", name, "-log", "none"], cwd=folder, capture_output=True, text=True)
    if done.returncode:
        sys.exit(f"lmp failed on {name}:\n{done.stdout[-3000:]}{done.stderr}")
    return done.stdout


def poses(morula, folder):
    """Places and turns of stones pressed together."""
    made, _, mol = clump(morula, 30, folder)
    half = 0.5 * SIDE * SPACING
    text = HEAD.format(style="sphere") + f"""\
lattice sc {SPACING}
region box block {-half} {half} {-half} {half} {-half} {half} units box
create_box 1 box
molecule clump {mol.name}
fix prop all property/atom mol ghost yes
create_atoms 0 box mol clump 4711
neigh_modify exclude molecule/intra all
comm_modify cutoff 2.5
{contact(30)}neigh_modify delay 0 every 5 check yes
fix rigid all rigid/small molecule mol clump
fix press all deform 1 x final {-BOX / 2} {BOX / 2} y final {-BOX / 2} {BOX / 2} z final {-BOX / 2} {BOX / 2} remap x flip no units box
thermo 1000
dump d all custom 2000 poses.txt id mol xu yu zu
dump_modify d sort id format float %.15g
run 12000
unfix press
fix slow all viscous 0.2
run 4000
"""
    lammps(text, folder, "press.in")
    lines = (folder / "poses.txt").read_text().splitlines()
    last = max(i for i, line in enumerate(lines) if line.startswith("ITEM: ATOMS"))
    atoms = [[float(w) for w in line.split()] for line in lines[last + 1:] if line]
    bodies = {}
    for _, body, *x in atoms:
        bodies.setdefault(body, []).append(x)
    assert len(bodies) == SIDE ** 3, len(bodies)
    sides = [line.split() for line in lines[last - 3:last]]
    assert all(abs(float(b) - float(a) - BOX) < 1e-6 for a, b in sides), sides
    # Three atoms far apart tell place and turn.
    at = made["Coords"]
    far = lambda i: max(range(len(at)), key=lambda j: math.dist(at[i], at[j]))
    i = far(0)
    j = far(i)
    k = max(range(len(at)), key=lambda k: area(at[i], at[j], at[k]))
    own = frame(at[i], at[j], at[k])
    found = []
    for spheres in bodies.values():
        now = frame(spheres[i], spheres[j], spheres[k])
        turn = [[sum(now[m][a] * own[m][b] for m in range(3)) for b in range(3)] for a in range(3)]
        centre = [x - y for x, y in zip(spheres[i], turned(turn, at[i]))]
        found.append((centre, turn))
    return found


def cross(a, b):
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


def unit(a):
    length = math.hypot(*a)
    return tuple(x / length for x in a)


def less(a, b):
    return tuple(x - y for x, y in zip(a, b))


def area(a, b, c):
    return math.hypot(*cross(less(b, a), less(c, a)))


def frame(a, b, c):
    x = unit(less(b, a))
    z = unit(cross(x, less(c, a)))
    return x, cross(z, x), z


def turned(turn, p):
    return [sum(a * b for a, b in zip(row, p)) for row in turn]


def measure(morula, n, places, folder, repeat):
    """Seconds of each part of LAMMPS for a step of one particle, the least of some runs."""
    random.seed(7)
    copies = 2 if n <= 100 else 1
    box = copies * BOX
    shifts = [(BOX * (k - (copies - 1) / 2)) for k in range(copies)]
    places = [((p[0] + x, p[1] + y, p[2] + z), turn) for p, turn in places
              for x in shifts for y in shifts for z in shifts]
    gauss = lambda: random.gauss(0, 0.3)
    rows, mol_file = [], None
    if n == 1:
        spheres = [((0.0, 0.0, 0.0), 1.0, VOLUME)]
    else:
        made, head, mol = clump(morula, n, folder)
        spheres = [(tuple(c), d[0], m[0]) for c, d, m in zip(made["Coords"], made["Diameters"], made["Masses"])]
    atoms, speeds, i = [], [], 0
    for k, (x, turn) in enumerate(places):
        v = (gauss(), gauss(), gauss())
        for c, diameter, mass in spheres:
            i += 1
            at = [a + b for a, b in zip(x, turned(turn, c))]
            # LAMMPS takes a density; wrapped coordinates, with images.
            image = [math.floor((a + box / 2) / box) for a in at]
            at = [a - box * m for a, m in zip(at, image)]
            density = mass / (math.pi / 6 * diameter ** 3)
            atoms.append(f"{i} 1 {diameter:.12g} {density:.12g} {at[0]:.12g} {at[1]:.12g} {at[2]:.12g} "
                         f"{image[0]} {image[1]} {image[2]}")
            rows.append(f"{i} {k + 1}")
            speeds.append(f"{i} {v[0]:.6g} {v[1]:.6g} {v[2]:.6g} 0 0 0")
    sides = "".join(f"{-box / 2:.12g} {box / 2:.12g} {a}lo {a}hi\n" for a in "xyz")
    data = f"scene\n\n{i} atoms\n1 atom types\n\n{sides}\nAtoms\n\n" + "\n".join(atoms)
    data += "\n\nVelocities\n\n" + "\n".join(speeds)
    if n > 1:
        data += "\n\nStones\n\n" + "\n".join(rows)
    (folder / "scene.data").write_text(data + "\n")
    text = HEAD.format(style="sphere") + "fix prop all property/atom mol ghost yes\n" * (n > 1)
    text += "read_data scene.data" + " fix prop NULL Stones" * (n > 1) + "\n"
    if n > 1:
        text += "neigh_modify exclude molecule/intra all\nfix rigid all rigid/small molecule\n"
    else:
        text += "fix move all nve/sphere\n"
    text += contact(n) + LISTS + "comm_modify vel yes cutoff 1.1\n" * (n > 1)
    # About the same time for every n, and always whole intervals between lists.
    repeat *= 3 if n <= 30 else 1
    steps = REBUILD * max(2, int(60000 / (copies ** 3 * REBUILD * (1 + n / 4))))
    # Clumps of other numbers than those pressed together push each other into place first.
    text += f"run {REBUILD if n <= 30 else 5 * REBUILD}\n" + f"run {steps}\n" * repeat
    said = lammps(text, folder, "scene.in")
    best = None
    for part in said.split("Loop time of ")[2:]:
        busy = float(re.search(r"([\d.]+)% CPU use", part).group(1)) / 100
        seconds = {m[0].lower(): float(m[1]) * busy for m in re.findall(
            r"^(Pair|Neigh|Comm|Output|Modify|Other)\s*\|\s*(?:[\d.e+-]*\s*\|\s*)?([\d.e+-]+)", part, re.M)}
        total = sum(seconds.values())
        if best is None or total < best[0]:
            best = (total, seconds)
    lists = int(re.findall(r"Neighbor list builds = (\d+)", said)[-1])
    pairs = float(re.findall(r"Total # of neighbors = (\d+)", said)[-1]) / len(places)
    each = {k: v / steps / len(places) for k, v in best[1].items()}
    print(f"n = {n}: {1e6 * best[0] / steps / len(places):.3f} us a step and particle, {steps} steps, "
          f"{lists} lists, {pairs:.0f} pairs in the lists of a particle", flush=True)
    each.update(n=n, steps=steps, lists=lists, pairs=pairs)
    return each


def quaternion(m):
    """w, x, y, z of a turn."""
    w = math.sqrt(max(0, 1 + m[0][0] + m[1][1] + m[2][2])) / 2
    x, y, z = (math.sqrt(max(0, 1 + 2 * m[k][k] - m[0][0] - m[1][1] - m[2][2])) / 2 for k in range(3))
    return (w, *(math.copysign(v, d) for v, d in ((x, m[2][1] - m[1][2]), (y, m[0][2] - m[2][0]), (z, m[1][0] - m[0][1]))))


SCENE = """\
[run]
end = {end!r}
step = {step!r}
guard = false
overlap = 1000.0
[effects]
normal = "linear"
damping = "contact"
tangential = "mindlin"
[materials.stone]
stiffness = {stiffness}
shear = 0.2857
restitution = 0.9
friction = 0.5
[templates.stone]
{shape}
density = 1
material = "stone"
[output]
measures = ["contacts"]
"""


def processor(words):
    """Processor seconds of a process, and what it printed."""
    with tempfile.TemporaryFile("w+") as said:
        child = subprocess.Popen(words, stdout=said, stderr=subprocess.STDOUT)
        _, status, used = os.wait4(child.pid, 0)
        said.seek(0)
        text = said.read()
    if status:
        sys.exit(f"{' '.join(map(str, words))}: {text[-2000:]}")
    return used.ru_utime + used.ru_stime, text


def measure_ours(morula, n, places, folder, repeat):
    """Seconds of our engine for a step of one particle, the least of some runs."""
    random.seed(7)
    copies = 4 if n <= 10 else 3 if n <= 30 else 2
    repeat = repeat if n <= 100 else 1
    shifts = [(BOX * (k - (copies - 1) / 2)) for k in range(copies)]
    places = [((p[0] + x, p[1] + y, p[2] + z), turn) for p, turn in places
              for x in shifts for y in shifts for z in shifts]
    shape = f'shape = "stone"\nset = {{ seed = 7 }}\ncells = 64\nspheres = {n}\neffort = "{"normal" if n <= 300 else "draft"}"'
    bodies = ""
    for at, turn in places:
        v = [random.gauss(0, 0.3) for _ in range(3)]
        bodies += (f'[[bodies]]\ntemplate = "stone"\nposition = {[float(f"{x:.12g}") for x in at]}\n'
                   f'rotation = {list(quaternion(turn))}\nvelocity = {v}\n')
    step = STEP * min(1, 30 / n)
    first = 50 if n <= 30 else 250
    times, contacts = [], 0
    for steps in (first, first + 400):
        text = SCENE.format(end=steps * step, step=step, stiffness=STIFF, shape="ball = 0.5" if n == 1 else shape) + bodies
        path = folder / f"ours_{n}_{steps}.toml"
        path.write_text(text)
        runs = [processor([str(morula), "simulate", str(path)]) for _ in range(repeat)]
        times.append(min(r[0] for r in runs))
        contacts = float(re.search(r"contacts\s+([\d.e+-]+)", runs[0][1]).group(1)) / len(places)
    each = (times[1] - times[0]) / 400 / len(places)
    print(f"n = {n}: {1e6 * each:.3f} us a step and particle, {contacts:.2f} contacts of a particle", flush=True)
    return dict(n=n, steps=400, bodies=len(places), contacts=contacts, seconds=each)


def least(rows, values):
    """Least squares of relative errors with coefficients of 0 or more: every choice of those that are not 0."""
    m, best = len(rows[0]), None
    for mask in range(1, 1 << m):
        use = [k for k in range(m) if mask >> k & 1]
        scaled = [[r[k] / v for k in use] for r, v in zip(rows, values)]
        a = [[sum(r[i] * r[j] for r in scaled) for j in range(len(use))] + [sum(r[i] for r in scaled)]
             for i in range(len(use))]
        for i in range(len(use)):
            pivot = max(range(i, len(use)), key=lambda k: abs(a[k][i]))
            a[i], a[pivot] = a[pivot], a[i]
            for k in range(len(use)):
                if k != i and a[i][i]:
                    f = a[k][i] / a[i][i]
                    a[k] = [x - f * y for x, y in zip(a[k], a[i])]
        found = [a[i][-1] / a[i][i] if a[i][i] else -1 for i in range(len(use))]
        if min(found) < 0:
            continue
        error = sum((sum(c * x for c, x in zip(found, r)) - 1) ** 2 for r in scaled)
        if best is None or error < best[0]:
            full = [0.0] * m
            for k, c in zip(use, found):
                full[k] = c
            best = (error, full)
    return best[1]


def measured(solver):
    """The rows of what was measured."""
    lines = (line for line in open(FILES[solver]) if not line.startswith("#"))
    return [{k: float(v) for k, v in row.items()} for row in csv.DictReader(lines)]


def fit(solver="lammps"):
    rows = measured(solver)
    for row in rows:
        row.setdefault("neigh", 0.0)
    one = next(r for r in rows if r["n"] == 1)
    parts = ("pair", "neigh", "comm", "output", "modify", "other") if solver == "lammps" else ("seconds",)
    unit = sum(one[p] for p in parts)
    clumps = [r for r in rows if r["n"] > 1]
    step = [(sum(r[p] for p in parts) - r["neigh"]) / unit for r in clumps]  # neigh is one of the parts, or 0
    lists = [r["neigh"] / unit * REBUILD for r in clumps]
    ns = [r["n"] for r in clumps]
    use = sum(n <= FITTED[solver] for n in ns)
    a, b, c = least([[1, n, n * n] for n in ns[:use]], step)
    d, e = least([[n, n * n] for n in ns[:use]], lists) if any(lists) else (0.0, 0.0)
    print(f"a = {a:.4g}, b = {b:.4g}, c = {c:.4g}; d = {d:.4g}, e = {e:.4g}")
    print("|n|measured|model|\n|---:|---:|---:|")
    for n, s, l in zip(ns, step, lists):
        whole, model = s + l / REBUILD, a + b * n + c * n * n + (d * n + e * n * n) / REBUILD
        print(f"|{n:g}|{whole:.4g} ({s:.4g} + {l / REBUILD:.4g})|{model:.4g}|")
    return a, b, c, d, e


if __name__ == "__main__":
    words = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    words.add_argument("--morula", default=str(HERE.parent / "target/release/morula"))
    words.add_argument("--solver", choices=FILES, default="lammps")
    words.add_argument("--repeat", type=int, default=1)
    words.add_argument("--fit", action="store_true")
    words.add_argument("--numbers")
    words = words.parse_args()
    if not words.fit:
        morula = pathlib.Path(words.morula).resolve()
        with tempfile.TemporaryDirectory() as folder:
            folder = pathlib.Path(folder)
            places = poses(morula, folder)
            numbers = [int(n) for n in words.numbers.split(",")] if words.numbers else NUMBERS
            cpu = next((line.split(":", 1)[1].strip() for line in open("/proc/cpuinfo") if "model name" in line), "?")
            if words.solver == "lammps":
                version = subprocess.run(["lmp", "-h"], capture_output=True, text=True).stdout.split("\n")
                version = next((line.strip() for line in version if "Parallel Simulator" in line), "LAMMPS")
                version, of = "LAMMPS " + version.split(" - ", 1)[-1], measure
                keys = ("n", "steps", "lists", "pairs", "pair", "neigh", "comm", "output", "modify", "other")
            else:
                version = subprocess.run([str(morula), "--version"], capture_output=True, text=True).stdout.strip()
                keys, of = ("n", "bodies", "steps", "contacts", "seconds"), measure_ours
            with open(FILES[words.solver], "w", newline="") as out:
                out.write(f"# {version}; {cpu}; one process; seconds of a step and particle\n")
                table = csv.writer(out, lineterminator="\n")
                table.writerow(keys)
                for n in numbers:
                    row = of(morula, n, places, folder, words.repeat)
                    table.writerow([f"{row.get(k, 0):.6g}" for k in keys])
                    out.flush()
    fit(words.solver)
