"""The Python module: the same answers as elsewhere, shapes of arrays, and what is wrong input."""

import ast
import doctest
import inspect
import json
import math
import os
import pathlib
import sys
import threading
import unittest
from fractions import Fraction

import numpy as np
import touchstone as ts
from touchstone import _verify


def at(x, y=0, z=0):
    pose = np.eye(4)
    pose[:3, 3] = x, y, z
    return pose


class Pairs(unittest.TestCase):
    def test_a_pose_is_none_a_matrix_or_a_tuple(self):
        box, ball = ts.Body(ts.Shape.box([1, 2, 3])), ts.Shape.sphere(0.5)
        self.assertAlmostEqual(ts.distance(box, ts.Body(ball, at(3))).distance, 1.5)
        self.assertAlmostEqual(ts.distance(box, ts.Body(ball, (np.eye(3), [3, 0, 0]))).distance, 1.5)
        quarter = np.array([[0, -1, 0], [1, 0, 0], [0, 0, 1]])  # x to y: the box is 2 wide along x
        turned = ts.Body(ts.Shape.box([1, 2, 3]), (quarter, np.zeros(3)))
        self.assertAlmostEqual(ts.distance(turned, ts.Body(ball, at(3))).distance, 0.5)
        sheared = at(0)
        sheared[0, 1] = 1  # y moves x
        corners = [[x + y, y, z] for x in (-1, 1) for y in (-2, 2) for z in (-3, 3)]
        one, other = ts.Body(ts.Shape.box([1, 2, 3]), sheared), ts.Body(ts.Shape.hull(corners))
        ball = ts.Body(ball, at(9))
        self.assertAlmostEqual(ts.distance(one, ball).distance, ts.distance(other, ball).distance)

    def test_results_have_points_and_bounds(self):
        a, b = ts.Body(ts.Shape.cone(1, 1)), ts.Body(ts.Shape.capsule(0.5, 1), at(0, 0, 4))
        result = ts.Solver("certified").signed_distance(a, b)
        self.assertEqual((result.answer, result.status), ("separated", "ok"))
        self.assertLessEqual(result.lower, 1.5)
        self.assertGreaterEqual(result.upper, 1.5)
        np.testing.assert_allclose(result.on_a, [0, 0, 1], atol=1e-9)
        np.testing.assert_allclose(result.on_b, [0, 0, 2.5], atol=1e-9)
        np.testing.assert_allclose(result.normal, [0, 0, 1], atol=1e-9)
        self.assertTrue(math.isnan(ts.penetration(a, b).distance))
        self.assertFalse(ts.intersects(a, b))

    def test_many_pairs_are_as_one(self):
        random = np.random.default_rng(1)
        shapes = [ts.Shape.sphere(0.5), ts.Shape.box([0.3, 0.4, 0.5]), ts.Shape.hull(random.normal(size=(20, 3)))]
        poses = np.tile(np.eye(4), (200, 1, 1))
        poses[:, :3, 3] = random.uniform(-2, 2, (200, 3))
        shape_of = random.integers(0, 3, 200)
        pairs = random.integers(0, 200, (1000, 2))
        bodies, solver = ts.Bodies(shapes, shape_of, poses), ts.Solver()
        results = solver.ask("signed_distance", bodies, pairs)
        self.assertEqual(results.shape, (1000,))
        self.assertEqual(results["normal"].shape, (1000, 3))
        seen = set()
        for (i, j), result in zip(pairs, results):
            if i == j:
                continue
            one = ts.signed_distance(ts.Body(shapes[shape_of[i]], poses[i]), ts.Body(shapes[shape_of[j]], poses[j]))
            self.assertEqual(one.answer, ts.ANSWERS[result["answer"]])
            self.assertAlmostEqual(one.distance, result["distance"], places=6)
            seen.add(one.answer)
        self.assertLessEqual({"separated", "overlapping"}, seen)
        again = solver.ask("signed_distance", bodies, pairs, out=results.copy())
        for name in results.dtype.names:
            np.testing.assert_array_equal(again[name], results[name])
        frozen = results.copy()
        frozen.setflags(write=False)
        for out in (frozen, results[:-1], np.repeat(results, 2)[::2], np.zeros(1000), results.tolist(), results[:, None]):
            with self.assertRaisesRegex(ts.Error, "out"):
                solver.ask("signed_distance", bodies, pairs, out=out)
        odd = np.frombuffer(bytearray(results.nbytes + 1), dtype=np.uint8)[1:].view(results.dtype)
        with self.assertRaisesRegex(ts.Error, "expected an aligned array"):
            solver.ask("signed_distance", bodies, pairs, out=odd)
        # Pairs that share memory with the results are read before they are overwritten.
        shared = results.copy()
        asked = shared.view(np.uint32)[-2 * len(pairs):].reshape(-1, 2)
        asked[:] = pairs
        again = solver.ask("signed_distance", bodies, asked, out=shared)
        for name in results.dtype.names:
            np.testing.assert_array_equal(again[name], results[name])
        poses[:, 0, 3] += 1
        bodies.move(poses)
        np.testing.assert_allclose(solver.ask("distance", bodies, pairs)["distance"],
                                   np.where(results["distance"] > 0, results["distance"], np.nan), atol=1e-6)

    def test_casts(self):
        ball = ts.Shape.sphere(1)
        hit = ts.Solver().cast(ts.Body(ball), [4, 0, 0], ts.Body(ball, at(4)), [0, 0, 0])
        self.assertEqual(hit.answer, "hit")
        self.assertAlmostEqual(hit.time, 0.5)
        self.assertEqual(ts.Solver().cast(ts.Body(ball), [0, 4, 0], ts.Body(ball, at(4)), [0, 0, 0]).answer, "miss")

    def test_threads(self):
        wrong = []

        def ask():
            ball = ts.Shape.sphere(1)
            for i in range(500):
                distance = ts.distance(ts.Body(ball), ts.Body(ball, at(3 + i))).distance
                if abs(distance - (1 + i)) > 1e-9:
                    wrong.append(i)

        threads = [threading.Thread(target=ask) for _ in range(2)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        self.assertEqual(wrong, [])

    def test_what_is_wrong(self):
        ball = ts.Body(ts.Shape.sphere(1))
        self.assertTrue(issubclass(ts.Error, ValueError))
        for wrong in (lambda: ts.Shape.sphere(-1), lambda: ts.Shape.box([1, 2]), lambda: ts.Shape.hull(np.zeros((0, 3))),
                      lambda: ts.Shape.hull([[0, 0, math.nan]]), lambda: ts.Body(ts.Shape.sphere(1), np.eye(3)),
                      lambda: ts.distance(ball, ts.Body(ts.Shape.sphere(1), at(math.nan))),
                      lambda: ts.Solver("gkj"), lambda: ts.Solver(margin=-1), lambda: bool(ts.distance(ball, ball)),
                      lambda: ts.Bodies([], [0], [np.eye(4)]), lambda: ts.Bodies([ball.shape], [0], np.eye(4)),
                      lambda: ts.Body(ball.shape, "x"), lambda: ts.Body(ball.shape, [[1], [2, 3]]),
                      lambda: ts.Bodies([ball.shape], [0.9], [np.eye(4)]), lambda: ts.Bodies([ball.shape], [-1], [np.eye(4)]),
                      lambda: ts.Solver().ask("distance", ts.Bodies([ball.shape], [0, 0], [np.eye(4)] * 2), [[2**32, 1]]),
                      lambda: ts.Solver().ask("far", ts.Bodies([], [], np.zeros((0, 4, 4))), np.zeros((0, 2))),
                      lambda: ts.Solver().ask("distance", ts.Bodies([], [], np.zeros((0, 4, 4))), [[0, 1]])):
            self.assertRaises(ts.Error, wrong)
        none = ts.Bodies([], [], [])
        self.assertEqual((len(none), len(ts.Solver().ask("distance", none, []))), (0, 0))
        with self.assertRaisesRegex(ts.Error, r"found a pose of the shape \(3, 3\); expected \(4, 4\)"):
            ts.Body(ts.Shape.sphere(1), np.eye(3))


class Worlds(unittest.TestCase):
    def test_pairs_of_boxes(self):
        random = np.random.default_rng(2)
        low = random.integers(0, 40, (300, 3)) * 0.25
        boxes = np.hstack([low, low + random.integers(0, 8, (300, 3)) * 0.25])
        world = ts.World("packed-rtree")
        handles = world.insert_boxes(boxes)

        def expected():
            a, b = boxes[:, None], boxes[None]
            meet = ((a[..., :3] <= b[..., 3:]) & (b[..., :3] <= a[..., 3:])).all(-1)
            return {frozenset((int(handles[i]), int(handles[j]))) for i, j in zip(*np.nonzero(np.triu(meet, 1)))}

        def found(pairs):
            return {frozenset(map(int, pair)) for pair in pairs}

        world.update()
        self.assertEqual(found(world.pairs()), expected())
        self.assertGreater(len(expected()), 50)
        began, ended = world.changes()
        self.assertEqual((found(began), len(ended)), (expected(), 0))
        before = expected()
        boxes[:100] += [0.5, 0, 0] * 2
        world.move_boxes(handles[:100], boxes[:100])
        world.update()
        began, ended = world.changes()
        self.assertEqual(found(began), expected() - before)
        self.assertEqual(found(ended), before - expected())
        self.assertTrue(len(began) > 0 and len(ended) > 0)
        # What is wrong changes nothing.
        for wrong in (lambda: world.insert_boxes([[0, 0, 0, 1, 1, 1], [math.nan] * 6]),
                      lambda: world.move_boxes(handles[:2], [[0, 0, 0, 1, 1, 1], [0, 0, 0, -1, 1, 1]]),
                      lambda: world.remove(np.array([handles[0], handles[0]])),
                      lambda: world.remove(handles[:2].astype(float))):
            self.assertRaises(ts.Error, wrong)
        self.assertEqual(len(world), 300)
        world.update()
        self.assertEqual(found(world.pairs()), expected())
        self.assertEqual(len(world.insert_boxes([])), 0)
        world.remove(handles)
        self.assertEqual(len(world), 0)
        self.assertNotIn(int(handles[0]), world)
        self.assertRaises(ts.Error, world.remove, int(handles[0]))

    def test_rays(self):
        world = ts.World()
        ball = world.insert(ts.Shape.sphere(1), at(5))
        body, t, normal = world.ray([0, 0, 0], [1, 0, 0])
        self.assertEqual(body, ball)
        self.assertAlmostEqual(t, 4)
        np.testing.assert_allclose(normal, [-1, 0, 0], atol=1e-12)
        self.assertIsNone(world.ray([0, 0, 0], [-1, 0, 0]))
        world.move(ball, at(-5))
        self.assertEqual(world.ray([0, 0, 0], [-1, 0, 0])[0], ball)
        self.assertEqual(world.body(ball).shape.kind, "sphere")
        self.assertRaises(ts.Error, world.insert, ts.Shape.halfspace([0, 0, 1], 0))


class Shapes(unittest.TestCase):
    def test_parameters_make_the_same_shape(self):
        points = np.random.default_rng(3).normal(size=(30, 3))
        shapes = [ts.Shape.sphere(1), ts.Shape.capsule(1, 2), ts.Shape.box([1, 2, 3]), ts.Shape.cylinder(1, 2),
                  ts.Shape.cone(1, 2), ts.Shape.ellipsoid([1, 2, 3]), ts.Shape.hull(points),
                  ts.Shape.halfspace([0, 0, 2], 1)]
        for shape in shapes:
            again = getattr(ts.Shape, shape.kind)(**shape.parameters)
            self.assertEqual(repr(again.parameters), repr(shape.parameters))
        self.assertEqual(shapes[6].parameters["points"].shape[1], 3)
        body = ts.Body(shapes[0], at(1, 2, 3))
        body.pose[:] = 0  # a copy
        np.testing.assert_array_equal(body.pose, at(1, 2, 3))

    def test_arrays_of_any_layout_are_read(self):
        box = ts.Shape.box([1, 2, 3])
        pose = at(4, 5, 6)
        pose[:3, :3] = [[0, -1, 0], [1, 0, 0], [0, 0, 1]]
        wide = np.zeros((8, 8))
        wide[::2, ::2] = pose
        frozen = pose.copy()
        frozen.setflags(write=False)
        odd = np.frombuffer(bytearray(1) + pose.tobytes(), dtype=float, offset=1).reshape(4, 4)
        for same in (np.asfortranarray(pose), odd, wide[::2, ::2], pose[::-1][::-1], frozen, pose.tolist(),
                     pose.astype(np.float32), pose.astype(int), pose.astype(">f8"), pose.astype(np.float16)):
            np.testing.assert_array_equal(ts.Body(box, same).pose, pose)
        points = np.random.default_rng(4).normal(size=(3, 20))
        np.testing.assert_array_equal(ts.Shape.hull(points.T).parameters["points"],
                                      ts.Shape.hull(points.T.copy()).parameters["points"])
        world = ts.World()
        boxes = np.array([[0, 0, 0, 1, 1, 1], [1, 1, 1, 2, 2, 2]], dtype=np.float32)
        self.assertEqual(len(world.insert_boxes(boxes[::-1])), 2)
        self.assertEqual(len(world.insert_boxes(np.asfortranarray(boxes))), 2)

    def test_what_no_array_of_numbers_is_ends_well(self):
        box, world = ts.Shape.box([1, 2, 3]), ts.World()
        wrong = [None, "x", object(), [], [[]], np.zeros((3, 4)), np.zeros((4, 4, 1)), np.zeros((0, 4)), [1, 2], np.nan,
                 np.full((4, 4), "a"), np.array([object()] * 3), {"a": 1}, np.full(3, np.nan), np.array([1, 2, np.inf])]
        for one in wrong:
            for call in (ts.Shape.box, ts.Shape.ellipsoid, ts.Shape.hull, lambda x: ts.Shape.halfspace(x, 1),
                         lambda x: ts.Bodies([box], x, np.zeros((1, 4, 4))), lambda x: ts.Bodies([box], [0], x),
                         lambda x: world.ray(x, [1, 0, 0]), lambda x: world.ray([0, 0, 0], x),
                         lambda x: ts.Body(box, (x, [0, 0, 0])), lambda x: ts.Body(box, (np.eye(3), x))):
                try:
                    call(one)
                except (ts.Error, TypeError):
                    continue
                self.assertIn(str(one), ("[]", "[nan nan nan]", "[ 1.  2. inf]"))  # no bodies; checked when it is asked
        for pose in (np.full((4, 4), np.nan), (np.eye(3), [0, 0, np.inf])):
            with self.assertRaisesRegex(ts.Error, "infinite or NaN"):
                ts.distance(ts.Body(box, pose), ts.Body(box))
        for call in (lambda: ts.Shape.sphere("x"), lambda: ts.distance(box, box), lambda: ts.World(threads=0),
                     lambda: ts.Body(None), lambda: ts.Solver().prepare([None])):
            self.assertRaises((ts.Error, TypeError), call)
        self.assertEqual(len(world), 0)


class Proofs(unittest.TestCase):
    def test_exact_answers(self):
        random = np.random.default_rng(5)
        shapes = [ts.Shape.sphere(0.5), ts.Shape.capsule(0.25, 1), ts.Shape.box([0.3, 0.4, 0.5]), ts.Shape.cylinder(0.5, 1),
                  ts.Shape.cone(1, 0.5), ts.Shape.ellipsoid([1, 0.5, 0.25]), ts.Shape.hull(random.normal(size=(12, 3)))]
        solver, seen = ts.Solver("certified"), set()
        for i in range(60):
            a, b = (ts.Body(shapes[k], at(*random.uniform(-1.5, 1.5, 3))) for k in random.integers(0, 7, 2))
            found, close = ts.exact.distance(a, b), solver.signed_distance(a, b)
            self.assertTrue(ts.verify(found.certificate))
            self.assertEqual(found.answer, close.answer)
            self.assertLessEqual(found.lower, found.upper)
            self.assertAlmostEqual(float(found), close.distance, places=6)
            self.assertLessEqual(close.lower, found.upper)
            self.assertGreaterEqual(close.upper, found.lower)
            seen.add(found.answer)
        self.assertLessEqual({"separated", "overlapping"}, seen)

    def test_fractions_are_exact(self):
        third = ts.Body(ts.Shape.sphere(1 / 3), at(3))
        found = ts.exact.distance(ts.Body(ts.Shape.sphere(0.1)), third)
        self.assertTrue(found.is_exact)
        self.assertEqual(found.lower, 3 - Fraction(0.1) - Fraction(1 / 3))
        plane = ts.Body(ts.Shape.halfspace([0, 0, 1], 0))
        self.assertEqual(ts.exact.distance(plane, ts.Body(ts.Shape.sphere(1), at(0, 0, 4))).lower, 3)
        self.assertEqual(ts.exact.distance(plane, plane).upper, -math.inf)
        touching = ts.exact.distance(ts.Body(ts.Shape.box([1, 1, 1])), ts.Body(ts.Shape.box([1, 1, 1]), at(2)))
        self.assertEqual((touching.answer, touching.lower), ("touching", 0))

    def test_a_forged_proof_is_refused(self):
        found = ts.exact.distance(ts.Body(ts.Shape.box([1, 1, 1])), ts.Body(ts.Shape.sphere(1), at(4, 1, 1)))
        forged = json.loads(found.certificate)
        forged["lower"]["numerator"] = str(int(forged["lower"]["numerator"]) + 1)
        with self.assertRaisesRegex(ts.Error, "the direction does not prove the lower bound"):
            ts.verify(json.dumps(forged))
        moved = json.loads(found.certificate)
        moved["b"]["translation"][0] += 1
        self.assertRaises(ts.Error, ts.verify, json.dumps(moved))
        for wrong in ("", "{}", "[]", "null", found.certificate[:-1], 3, None):
            self.assertRaises(ts.Error, ts.verify, wrong)

    def test_long_integers_are_read_whatever_the_limit(self):
        limit = sys.get_int_max_str_digits() if hasattr(sys, "get_int_max_str_digits") else 0
        self.assertEqual(_verify.integer("-1" + "0" * 99_999), -(10**99_999))
        self.assertEqual(_verify.integer("9" * 20_001), 10**20_001 - 1)
        self.assertEqual([_verify.integer(text) for text in ("0", "-7", "501")], [0, -7, 501])
        for wrong in ("-0", "01", "1_0", "9" * 100_002, 3):
            self.assertRaises(_verify.Malformed, _verify.integer, wrong)
        far, thin = ts.Body(ts.Shape.sphere(1e-300), at(1e300, 1e-300)), ts.Body(ts.Shape.cone(1e-200, 1e150))
        found = ts.exact.distance(thin, far)
        self.assertTrue(ts.verify(found.certificate))
        if limit:
            self.assertEqual(sys.get_int_max_str_digits(), limit)  # nothing of the process changes


class Balls:
    """Right on balls, but for a planted fault."""

    def __init__(self, fault=None):
        self.fault = fault

    def distance(self, a, b):
        if {a.shape.kind, b.shape.kind} != {"sphere"}:
            return None
        if self.fault == "raises":
            raise RuntimeError("planted")
        radii = a.shape.parameters["radius"] + b.shape.parameters["radius"]
        gap = float(np.linalg.norm(b.pose[:3, 3] - a.pose[:3, 3])) - radii
        if self.fault == "dictionary":
            far = {"answer": "separated", "distance": np.float32(gap), "normal": np.eye(3)[0], "id": 7}
            return far if gap > 0 else {"answer": "overlapping"}
        odd = {"set": {"distance": {gap}}, "nan": {"distance": math.nan}, "infinite": math.inf, "key": {(1, 2): 3}}
        if self.fault in odd:
            return odd[self.fault]
        return gap + 0.1 if self.fault == "off" else gap


@unittest.skipUnless(os.environ.get("TOUCHSTONE"), "the program is not built")
class OnesOwn(unittest.TestCase):
    def test_is_graded(self):
        options = {"cases": 12, "groups": ["gap", "depth"], "shapes": ["sphere"]}
        grades = ts.check(Balls(), **options)
        self.assertGreater(grades.counts["right"], 3)
        self.assertEqual((grades.wrong, grades.errors), ([], []))
        self.assertIn("balls@1", str(grades))
        grades = ts.check(Balls("off"), **options)
        self.assertGreater(len(grades.wrong), 0)
        self.assertEqual(grades.wrong[0]["algorithm"], "balls@1")
        grades = ts.check(Balls("raises"), **options)
        self.assertEqual(set(grades.counts), {"gave_up"})
        self.assertIn("RuntimeError: planted", grades.errors[0])
        self.assertEqual(len(grades.errors), len(grades.rows))
        grades = ts.check(Balls("dictionary"), **options)  # which has NumPy's numbers, and an id that is not asked for
        self.assertEqual(grades.errors, [])
        self.assertNotIn("gave_up", grades.counts)
        self.assertNotIn("failed", grades.counts)
        for fault in ("set", "nan", "infinite", "key"):
            grades = ts.check(Balls(fault), **options)
            self.assertEqual(set(grades.counts), {"gave_up"}, fault)
            self.assertEqual(len(grades.errors), 0 if fault == "infinite" else len(grades.rows))

    def test_a_solver_is_graded(self):
        grades = ts.check(ts.Solver("certified"), cases=3, groups=["gap"])
        self.assertGreater(grades.counts["right"], 20)
        self.assertEqual((grades.wrong, grades.errors), ([], []))

    def test_what_is_wrong(self):
        with self.assertRaisesRegex(ts.Error, "without methods"):
            ts.check(object())
        with self.assertRaisesRegex(ts.Error, "no-such"):
            ts.check(Balls(), groups=["no-such"])
        with self.assertRaisesRegex(ts.Error, "/none: No such file"):
            ts.check(Balls(), program="/none")


class Documents(unittest.TestCase):
    def test_examples_are_true(self):
        for module in (ts, ts.exact):
            found = doctest.testmod(module)
            self.assertEqual(found.failed, 0)
            self.assertGreater(found.attempted, 3)

    def test_stubs_name_what_is_there(self):
        stub = ast.parse((pathlib.Path(ts.__file__).parent / "__init__.pyi").read_text())
        named = {}
        for node in stub.body:
            if isinstance(node, ast.ClassDef):
                named[node.name] = {part.name for part in node.body if isinstance(part, ast.FunctionDef)}
            elif isinstance(node, ast.FunctionDef):
                named[node.name] = None
        for name, parts in named.items():
            there = getattr(ts, name)
            if parts is not None and not issubclass(there, Exception):
                public = {part for part in vars(there) if not part.startswith("_")}
                self.assertEqual(public, {part for part in parts if not part.startswith("_")}, name)
        documented = [name for name in ts.__all__ if callable(getattr(ts, name))]
        self.assertLessEqual(set(documented) - {"Grades", "check", "verify"}, set(named))
        for name in documented:
            self.assertTrue(inspect.getdoc(getattr(ts, name)), name)


if __name__ == "__main__":
    unittest.main()
