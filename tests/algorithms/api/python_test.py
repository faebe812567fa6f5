"""The Python module: the same answers as elsewhere, shapes of arrays, and what is wrong input."""

import math
import threading
import unittest

import numpy as np
import touchstone as ts


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


if __name__ == "__main__":
    unittest.main()
