"""The whole pipeline through morula.py, and that its tables are those of morula.h.

    MORULA_LIBRARY=libmorula.so MORULA_INCLUDE=include python3 test_morula.py
"""

import ctypes
import gc
import os
import pathlib
import re
import subprocess
import sys
import tempfile
import threading
import unittest

import numpy as np

import morula

BOX = np.array([[x, y, z] for z in (0, 1) for y in (0, 1) for x in (0, 2)], dtype=float)
FACES = [[0, 2, 1], [1, 2, 3], [4, 5, 6], [5, 7, 6], [0, 1, 4], [1, 5, 4],
         [2, 6, 3], [3, 6, 7], [0, 4, 2], [2, 4, 6], [1, 3, 5], [3, 7, 5]]


def box(**options):
    return morula.Shape.from_mesh(BOX, FACES, **options)


def stone(seed=1):
    return morula.Shape.from_primitive("stone", {"seed": seed}, segments=24)


def draft(of, spheres=8, **options):
    return morula.Clump(of, solid={"cells": 24} if isinstance(of, morula.Shape) else None,
                        spheres=spheres, effort="draft", **options)


@unittest.skipUnless(os.environ.get("MORULA_INCLUDE"), "MORULA_INCLUDE does not name the header")
class Drift(unittest.TestCase):
    """The tables against the header."""

    @classmethod
    def setUpClass(cls):
        text = (pathlib.Path(os.environ["MORULA_INCLUDE"]) / "morula.h").read_text()
        text = re.sub(r"/\*.*?\*/", "", text, flags=re.S)
        cls.header = re.sub(r"//.*", "", text)

    KINDS = {"size_t": "z", "int32_t": "i", "uint32_t": "I", "uint64_t": "Q", "double": "d",
             "void": "v", "morula_progress": "p", "morula_log": "p"}

    def kind(self, declared):
        words = declared.replace("struct ", "").strip()
        if words.startswith("const char") and words.count("*") == 1 or words == "char *":
            return "s" if words.startswith("const") else "p"
        return "p" if "*" in words else self.KINDS[words.replace("const", "").strip()]

    def test_constants(self):
        found = {(a, b): int(c) for a, b, c in re.findall(
            r"#define MORULA_([A-Z]+)_([A-Z0-9_]+) (\d+)\n", self.header) if a != "VERSION"}
        ours = {(g, n): v for g, names in morula._ids.items() for n, v in names.items()}
        self.assertEqual(ours, found)
        self.assertGreater(len(found), 100)

    def test_structs(self):
        found = {}
        for name, body in re.findall(r"typedef struct morula_(\w+) \{(.*?)\} ", self.header, re.S):
            fields = [re.match(r"(.*?)(\w+)(?:\[(\d+)\])?$", " ".join(f.split()))
                      for f in body.split(";") if f.strip()]
            found[name] = [(m[2], self.kind(m[1]), int(m[3] or 0)) for m in fields]
        ours = {}
        for name, struct in morula._structs.items():
            ours[name] = []
            for field, kind in struct._fields_:
                length = getattr(kind, "_length_", 0)
                kind = kind._type_ if length else kind
                letter = next(k for k, v in morula._C.items() if v is kind and k != "v")
                ours[name].append((field, letter, length))
        # Two C types that are one to ctypes are one here.
        same = {"Q": "z", "z": "z"}
        fold = lambda all_of: {n: [(f, same.get(k, k), c) for f, k, c in fs]
                               for n, fs in all_of.items()}
        self.assertEqual(fold(ours), fold(found))

    def test_functions(self):
        body = self.header[self.header.index('extern "C"'):]
        found = {}
        for result, name, arguments in re.findall(
                r"\n((?:const )?\w+ \*?)morula_(\w+)\((.*?)\);", body, re.S):
            arguments = " ".join(arguments.split())
            split = [] if arguments == "void" else [a.strip() for a in arguments.split(",")]
            letters = "".join(self.kind(re.match(r"(.*?)\w+$", a)[1]) for a in split)
            found[name] = (self.kind(result), letters)
        ours = {}
        for line in morula._FUNCTIONS.split("\n"):
            if line:
                result, name, *letters = line.split()
                ours[name] = (result, letters[0] if letters else "")
        self.assertEqual(ours, found)

    def test_every_function_is_used(self):
        source = pathlib.Path(morula.__file__).read_text()
        source = source[source.index("_C = {"):]
        nouns = "|".join(h._noun for h in morula._Handle.__subclasses__())
        for name in morula._functions:
            if name in ("sizeof",) or re.fullmatch(
                    rf"({nouns})_(free|counters)|\w+_init|\w+_(note_count|copy_note)|"
                    r"shape_from_grey_\w+", name):
                continue
            self.assertIn(f'"{name}"', source, "no method calls it")

    def test_sizes(self):
        for name, struct in morula._structs.items():
            which = getattr(morula, "STRUCT_" + name.upper())
            self.assertEqual(ctypes.sizeof(struct), morula._functions["sizeof"](which), name)


class Shapes(unittest.TestCase):
    def test_mesh(self):
        with box(length_unit=0.5) as shape:
            report = shape.report()
            self.assertEqual((report.vertices, report.faces, report.watertight), (8, 12, 1))
            np.testing.assert_array_equal(report.box_max, [1, 0.5, 0.5])
            moments = shape.moments(4.0)
            self.assertAlmostEqual(moments.mass, 1.0)
            np.testing.assert_allclose(moments.centre, [0.5, 0.25, 0.25])
            self.assertIn("multiplied by 0.5", shape.notes()[0])
            self.assertGreaterEqual(shape.counters().seconds_check, 0)

    def test_inertia_of_an_asymmetric_body(self):
        corner = np.array([[0, 0, 0], [1, 0, 0], [0, 2, 0], [0, 0, 3]], dtype=float)
        with morula.Shape.from_mesh(corner, [[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]]) as shape:
            m = shape.moments()
        turned = m.rotation @ np.diag(m.principal) @ m.rotation.T
        np.testing.assert_allclose(turned, morula.tensor(m.inertia), atol=1e-14)
        # The tetrahedron's integral of x y about its centre: a b volume / 20 - centre's share.
        volume = 1.0
        self.assertAlmostEqual(m.inertia[3], -(1 * 2 * volume / 20 - volume * 0.25 * 0.5))

    def test_voxels_have_x_fastest(self):
        mask = np.zeros((2, 3, 5), dtype=bool)
        mask[:, :, :4] = True
        with morula.Shape.from_mask(mask, spacing=(1, 2, 3), origin=(10, 0, 0)) as shape:
            report = shape.report()
            np.testing.assert_array_equal(report.box_min, [10, 0, 0])
            np.testing.assert_array_equal(report.box_max, [14, 6, 6])
        grey = mask.astype(np.float32)
        for kind in (np.uint8, np.uint16, np.float32):
            with morula.Shape.from_grey((grey * 200).astype(kind), threshold=100) as shape:
                self.assertEqual(shape.report().solid_cells, 24)
                self.assertEqual(shape.report().threshold, 100)
        with self.assertRaises(TypeError):
            morula.Shape.from_grey(grey.astype(np.float64))

    def test_labels(self):
        volume = np.zeros((6, 6, 6), dtype=np.uint32)
        volume[1:5, 1:5, 1:3] = 7
        volume[1:5, 1:5, 3:5] = 9
        ids, cells, boxes, touches = morula.labels(volume)
        self.assertEqual((ids.tolist(), cells.tolist(), touches.tolist()),
                         ([7, 9], [32, 32], [False, False]))
        self.assertEqual(boxes[1].tolist(), [[3, 1, 1], [4, 4, 4]])
        with morula.Shape.from_label(volume, 9) as shape:
            self.assertAlmostEqual(shape.moments().centre[0], 4)
        clumps = morula.Clump.of_labels(volume, [7, 9], spheres=3, effort="draft", threads=2)
        self.assertEqual([len(c) for c in clumps], [3, 3])
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder) / "labels.npy"
            np.save(path, volume.astype(np.uint16))
            for listed in (morula.labels_from_file(path), morula.labels_from_bytes(path.read_bytes())):
                self.assertEqual(listed[0].tolist(), [7, 9])
            with morula.Shape.from_file(path, meaning="label", label=7) as shape:
                self.assertEqual(shape.report().solid_cells, 32)

    def test_files(self):
        text = "solid s\n" + "".join(
            "facet normal 0 0 0\nouter loop\n" + "".join(
                "vertex %g %g %g\n" % tuple(BOX[v]) for v in face) + "endloop\nendfacet\n"
            for face in FACES) + "endsolid\n"
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder) / "bóx.stl"
            path.write_text(text)
            with morula.Shape.from_file(path) as shape:
                self.assertAlmostEqual(shape.moments().volume, 2)
                with morula.Shape.deserialize(shape.serialize()) as again:
                    self.assertEqual(again.serialize(), shape.serialize())
        with morula.Shape.from_bytes(text.encode(), "box.stl", format="stl") as shape:
            self.assertEqual(shape.report().faces, 12)

    def test_silhouettes(self):
        mask = np.zeros((20, 20), dtype=bool)
        mask[5:15, 5:15] = True
        along = lambda u, v: [10 * (np.arange(4) == u) + 10.0 * (np.arange(4) == 3),
                              10 * (np.arange(4) == v) + 10.0 * (np.arange(4) == 3),
                              np.arange(4) == 3]
        views = [(mask, along(u, v)) for u, v in ((0, 1), (1, 2), (0, 2))]
        with morula.Shape.from_silhouettes(views, cells=32, carve="centres") as shape:
            self.assertAlmostEqual(shape.moments().volume, 1.0, delta=0.2)

    def test_primitives(self):
        known = morula.primitives()
        self.assertEqual(known["ellipsoid"], {"a": 1.0, "b": 0.75, "c": 0.5})
        with morula.Shape.from_primitive("sphere", {"radius": 2.0}) as shape:
            self.assertAlmostEqual(shape.moments().volume, 32 * np.pi / 3, delta=0.4)


class Clumps(unittest.TestCase):
    def test_solid(self):
        with box() as shape, morula.Solid(shape, cells=20) as solid:
            dims, spacing, origin = solid.grid()
            self.assertTrue((dims * spacing > [2, 1, 1]).all() and (origin < 0).all())
            np.testing.assert_allclose(
                solid.distance([[1, 0.5, 0.5], [3, 0.5, 0.5]]), [-0.5, 1], atol=1e-12)
            self.assertEqual(solid.notes(), [])
            self.assertAlmostEqual(solid.moments(3.0).mass, 6)
            self.assertGreater(solid.counters().cells, 0)

    def test_every_method(self):
        with morula.Shape.from_primitive("ellipsoid") as shape, morula.Solid(shape, cells=28) as solid:
            for method, number in morula._ids["METHOD"].items():
                own = {"effort": "draft"} if method in ("BEST", "INSCRIBED") else {}
                with morula.Clump(solid, method=method.lower(), spheres=12, wants="overlap", **own) as c:
                    self.assertGreater(len(c), 0, method)
                    self.assertTrue(0 < c.overlap().mismatch < 0.7, method)
                self.assertEqual(number, getattr(morula, "METHOD_" + method))

    def test_quality(self):
        with stone() as shape, draft(shape, wants="overlap+surface+moments",
                                     plane_tolerances=[0.01, 0.1]) as clump:
            self.assertEqual(clump.spheres().shape, (8, 4))
            self.assertTrue((clump.spheres()[:, 3] > 0).all())
            self.assertIn("sphere", clump.stopped())
            self.assertEqual(clump.note(), "")
            self.assertEqual(clump.warnings(), [])
            self.assertTrue(0 < clump.overlap().mismatch < 0.3)
            self.assertGreater(clump.surface().hausdorff, 0)
            self.assertEqual(clump.exposed_areas().shape, (8,))
            few, many = clump.plane_contacts(2)
            self.assertLessEqual(few, many)
            self.assertGreater(clump.moments(2.0).mass, 0)
            self.assertGreater(clump.counters().seconds_generate, 0)
            with morula.Clump.deserialize(clump.serialize()) as again:
                np.testing.assert_array_equal(again.spheres(), clump.spheres())

    def test_demands(self):
        with box() as shape, morula.Solid(shape, cells=24) as solid:
            with draft(solid, half_spaces=[[1, 0, 0, 1.5]], symmetry="planes",
                       symmetry_planes=[[0, 1, 0]]) as clump:
                s = clump.spheres()
                self.assertLessEqual((s[:, 0] + s[:, 3]).max(), 1.5 + 1e-9)

    def test_many(self):
        with stone(1) as a, stone(2) as b:
            both = morula.Clump.of_shapes([a, b], solid={"cells": 24}, spheres=5, effort="draft",
                                          threads=2)
            with draft(b, 5) as alone:
                np.testing.assert_array_equal(both[1].spheres(), alone.spheres())
            with morula.Solid(a, cells=24) as solid:
                levels = morula.Clump.levels(solid, [2, 4, 8], effort="draft")
                self.assertEqual([len(c) for c in levels], [2, 4, 8])

    def test_threads_of_python(self):
        with stone() as shape, morula.Solid(shape, cells=24) as solid:
            results = [None] * 4

            def work(i):
                with draft(solid) as clump:
                    results[i] = clump.serialize()
            threads = [threading.Thread(target=work, args=(i,)) for i in range(4)]
            for t in threads:
                t.start()
            for t in threads:
                t.join()
        spheres = []
        for data in results:
            with morula.Clump.deserialize(data) as clump:
                spheres.append(clump.spheres().tobytes())
        self.assertEqual(len(set(spheres)), 1)


class Masses(unittest.TestCase):
    def test_masses(self):
        with morula.Shape.from_primitive("box", {"a": 2, "b": 1.2}) as shape, draft(shape, 40) as clump, \
                morula.Body(clump, density=2.0) as body:
            result, moments = body.result(), body.moments()
            self.assertEqual((result.status, len(body)), (morula.MASSES_EXACT, 40))
            self.assertTrue(body.status())
            self.assertEqual(len(body.binding()), result.binding)
            masses, spheres = body.masses(), body.spheres()
            self.assertAlmostEqual(masses.sum(), moments.mass)
            np.testing.assert_allclose(masses @ spheres[:, :3] / moments.mass, moments.centre,
                                       atol=1e-9)
            self.assertEqual(body.spheres_f32().dtype, np.float32)
            own = body.spheres("body")[:, :3] @ moments.rotation.T + moments.centre
            np.testing.assert_allclose(own, spheres[:, :3], atol=1e-12)
            step = body.timestep(stiffness=1e5)
            self.assertGreater(step.clump, 0)
            self.assertGreater(clump.timestep(stiffness=1e5, masses={"density": 2.0}).clump,
                               0.999 * step.clump)
            with body.transform(2.0, position=(1, 2, 3), quaternion=(0, 0, 0, 1)) as placed:
                self.assertAlmostEqual(placed.moments().mass, 8 * moments.mass)
                np.testing.assert_allclose(placed.moments().centre, [1, 2, 3])
            with clump.placed(2.0, masses={"density": 2.0}) as placed:
                self.assertAlmostEqual(placed.moments().mass, 8 * moments.mass)

    def test_spheres_of_ones_own(self):
        pair = [[0, 0, 0, 1], [1, 0, 0, 1]]
        with morula.Body(pair, target="union", infeasible="least_error") as body:
            self.assertAlmostEqual(body.moments().mass, np.pi * 9 / 4, places=9)

    def test_export(self):
        with stone() as shape, draft(shape, 6) as clump, morula.Body(clump) as body, \
                tempfile.TemporaryDirectory() as folder:
            for name in morula._ids["EXPORT"]:
                files = body.files(name.lower(), name="grain", facets=1)
                self.assertTrue(files and all(files.values()), name)
                path = pathlib.Path(folder) / name
                body.write(name.lower(), path, name="grain", facets=1)
                for added, data in files.items():
                    self.assertEqual((path / added if path.is_dir() else pathlib.Path(
                        str(path) + added)).read_bytes(), data)
            clump.write("csv", os.path.join(folder, "of_clump.csv"))

    def test_cost(self):
        with stone() as shape, morula.Solid(shape, cells=20) as solid, morula.Cost(
                solid, cost={"counts": [2, 4, 8], "contact": {"stiffness": 10.0}, "surface": 0},
                effort="draft") as cost:
            points = cost.points()
            self.assertEqual([p.asked for p in points], [2, 4, 8])
            self.assertFalse(cost.cut())
            index, why = cost.choose(goal="mismatch")
            self.assertTrue(points[index].mismatch == min(p.mismatch for p in points) and why)
            with cost.clump(1) as clump:
                self.assertEqual(len(clump), 4)

    def test_sweep(self):
        with stone() as shape, morula.Sweep(
                shape, [16, 20], ["best", "mss"], ["draft", "normal"],
                cost={"counts": [2, 4], "surface": 0}) as sweep:
            lists = sweep.lists()
            self.assertEqual([(one.resolution, one.method) for one in lists],
                             [(n, m) for n in (16, 20) for m in (morula.METHOD_BEST, morula.METHOD_MSS)])
            self.assertTrue(all(one.status == 0 and one.lines == 2 for one in lists))
            curve = sweep.curve(2)
            with self.assertRaises(morula.Error) as error:
                sweep.curve(4)
            self.assertEqual(error.exception.status, morula.STATUS_INDEX_OUT_OF_RANGE)
        with curve:
            self.assertEqual([p.asked for p in curve.points()], [2, 4])
        with stone() as shape, self.assertRaises(ValueError):
            morula.Sweep(shape, [16], ["best", "mss"], ["draft"])

    def test_orientations(self):
        q = morula.random_orientations(3, 10)
        np.testing.assert_allclose((q ** 2).sum(axis=1), 1)


class Breaking(unittest.TestCase):
    def test_break(self):
        with stone() as shape, morula.Solid(shape, cells=24) as solid, draft(solid) as clump, \
                morula.Parent(solid, clump) as parent:
            held = parent.held(2.0, velocity=(1, 0, 0), angular_velocity=(0, 0, 5),
                               position=(0, 0, 9), quaternion=(1, 0, 0, 0))
            self.assertGreater(parent.bytes(), 0)
            with morula.Fragments(parent, held, cells=3, seed=4, masses=1) as pieces:
                everything = [pieces[i] for i in range(len(pieces))] + pieces.dust()
                self.assertAlmostEqual(sum(p.mass for p in everything), held.mass)
                momentum = sum(p.mass * p.velocity for p in everything)
                np.testing.assert_allclose(momentum, held.mass * np.array(held.velocity), atol=1e-12)
                self.assertLess(abs(pieces.totals().energy), 1e-9)
                n = pieces[0].sphere_count
                self.assertEqual(pieces.spheres(0, "world").shape, (n, 4))
                self.assertGreaterEqual(pieces.grown(0, 0.5, pieces.spheres(1))[:, 3].sum(),
                                        pieces.spheres(0)[:, 3].sum())
                starts, parents, shares = pieces.map(0)
                self.assertTrue(starts[-1] == len(parents) == len(shares))
                self.assertEqual(pieces.half_spaces(0).shape[1], 4)
                if pieces[0].masses == morula.MASSES_EXACT:
                    self.assertAlmostEqual(pieces.masses(0).sum(), pieces[0].mass)
                with pieces.shape(0) as surface:
                    self.assertAlmostEqual(surface.moments().volume, pieces[0].volume, places=9)
                data = pieces.serialize(0)
                with morula.Fragments.deserialize(parent, data, pieces.held(0)) as again:
                    np.testing.assert_array_equal(again.spheres(0), pieces.spheres(0))
                with morula.Fragments((pieces, 0), pieces.held(0), cells=2) as smaller:
                    self.assertGreaterEqual(len(smaller) + len(smaller.dust()), 1)
                self.assertIsInstance(pieces.notes(), list)
            many = morula.Fragments.of_parents([parent, parent], [held, held],
                                               [{"seed": 1, "threads": 2}, {"seed": 2}])
            with morula.Fragments(parent, held, seed=2) as alone:
                np.testing.assert_array_equal(many[1].spheres(0), alone.spheres(0))

    def test_other_breaks(self):
        volume = np.zeros((10, 10, 10), dtype=np.uint32)
        volume[1:9, 1:9, 1:5] = 1
        volume[1:9, 1:9, 5:9] = 2
        at_rest = {"mass": 512.0, "centre": [5, 5, 5], "inertia": [5461, 5461, 5461, 0, 0, 0]}
        with morula.Fragments.from_labels(volume, at_rest, [[5, 5, 5, 3]], within_union=0) as two:
            self.assertEqual(len(two), 2)
        with box() as shape, morula.Solid(shape, cells=24) as solid, morula.Cache(1 << 26) as cache:
            grown = {"mass": 2.0, "centre": [1, 0.5, 0.5], "inertia": [1 / 3, 5 / 6, 5 / 6, 0, 0, 0]}
            with morula.Fragments.reclump(solid, [[1, 0.5, 0.5, 0.4]], grown) as new:
                self.assertEqual(len(new), 1)
            with cache.parent(shape, cells=20), cache.parent(shape, cells=20) as parent:
                self.assertEqual((cache.counters().hits, cache.counters().misses), (1, 1))
                with morula.Fragments(parent, parent.held(1.0), kind="planes",
                                      half_spaces=[[1, 0, 0, 1]], walls=[[0, 0, 1, 0.9]]) as halves:
                    self.assertAlmostEqual(halves[0].volume, 1.0)
                with morula.Fragments(parent, parent.held(1.0), kind="points",
                                      points=[[0.5, 0.5, 0.5], [1.5, 0.5, 0.5]],
                                      weights=[0, 0]) as cells:
                    self.assertEqual(len(cells), 2)
            cache.clear()
            self.assertEqual(cache.counters().parents, 0)


class Borders(unittest.TestCase):
    def test_errors(self):
        with self.assertRaises(morula.Error) as caught:
            box(length_unit=-1.0)
        self.assertEqual((caught.exception.status, caught.exception.name),
                         (morula.STATUS_INVALID_ARGUMENT, "INVALID_ARGUMENT"))
        self.assertIn("-1", caught.exception.message)
        for wrong in (lambda: box(lenght_unit=1.0), lambda: box(reserved=1)):
            self.assertRaises(TypeError, wrong)
        self.assertRaises(ValueError, lambda: morula.constant("METHOD", "worst"))
        self.assertRaises(ValueError, lambda: morula.Shape.from_mesh([[0, 1]], FACES))
        with self.assertRaises(morula.Error) as caught:
            morula.Shape.from_file("no such file.stl")
        self.assertEqual(caught.exception.name, "IO")

    def test_closed_handles(self):
        shape = box()
        shape.close()
        shape.close()
        with self.assertRaisesRegex(ctypes.ArgumentError, "this Shape is closed"):
            shape.report()

    def test_the_collector_frees(self):
        freed = []
        original = morula._functions["shape_free"]
        morula._functions["shape_free"] = lambda p: (freed.append(p), original(p))
        try:
            shape = box()
            del shape
            gc.collect()
        finally:
            morula._functions["shape_free"] = original
        self.assertEqual(len(freed), 1)

    def test_progress(self):
        seen = []
        with stone() as shape, morula.Solid(shape, cells=24) as solid:
            with morula.Clump(solid, spheres=8, progress=seen.append):
                self.assertTrue(seen and all(0 <= f <= 1 for f in seen))
            with morula.Clump(solid, spheres=200, method="mss",
                              progress=lambda f: f < 0.5) as clump:
                self.assertEqual(clump.stopped(), "cancelled")
            with self.assertRaises(morula.Error) as caught:
                morula.Solid(shape, cells=64, progress=lambda f: False)
            self.assertEqual(caught.exception.name, "CANCELLED")

            def broken(_):
                raise ZeroDivisionError("in the callback")
            self.assertRaises(ZeroDivisionError, lambda: morula.Solid(shape, progress=broken))
            self.assertRaises(ZeroDivisionError,
                              lambda: morula.Clump(solid, spheres=8, progress=broken))
            self.assertRaises(ZeroDivisionError, lambda: morula.Clump.levels(
                solid, [4, 8], progress=broken))

    def test_log(self):
        lines = []
        morula.set_log(lambda level, text: lines.append((level, text)))
        try:
            with morula.Shape.from_mesh(BOX, FACES[:-1]):
                pass
        finally:
            morula.set_log(None)
        self.assertIn(morula.LOG_WARNING, [level for level, _ in lines])

    def test_a_library_that_is_not_there(self):
        env = dict(os.environ, MORULA_LIBRARY="/no/such/libmorula.so")
        ran = subprocess.run([sys.executable, "-c", "import morula"], env=env, text=True,
                             capture_output=True, cwd=os.path.dirname(morula.__file__))
        self.assertNotEqual(ran.returncode, 0)
        self.assertIn("set MORULA_LIBRARY", ran.stderr)


if __name__ == "__main__":
    unittest.main()
