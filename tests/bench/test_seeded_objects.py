#!/usr/bin/env python3
"""bench/seeded_objects.py: each object is the truth that reconstructions are judged by."""
import pathlib
import sys
import unittest

try:
    import numpy as np
except ImportError:
    print('skipped: numpy is missing (scripts/setup python)')
    sys.exit(77)

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / 'bench'))
import seeded_objects  # noqa: E402

SEEDS = (2, 4)
seeded_objects.CELLS = 3e4  # a coarser grid, by the same rules


def fans(triangles):
    """How many fans of triangles the vertices have; one each in a 2-manifold. From a triangle's corner
    one goes on across the edge that starts there: each round is a fan."""
    count = triangles.max() + 1
    starts, ends = triangles.ravel(), np.roll(triangles, -1, axis=1).ravel()
    order = np.argsort(starts * count + ends)
    across = order[np.searchsorted((starts * count + ends)[order], ends * count + starts)]
    following = np.roll(np.arange(triangles.size).reshape(triangles.shape), -1, axis=1).ravel()[across]
    smallest = np.arange(triangles.size)  # corner of the fan, in ever longer parts of it
    for _ in range(int(triangles.size).bit_length()):
        smallest, following = np.minimum(smallest, smallest[following]), following[following]
    return len(np.unique(smallest))


class EachObject(unittest.TestCase):
    def each(self):
        for kind in seeded_objects.KINDS:
            for seed in SEEDS:
                with self.subTest(kind=kind, seed=seed):
                    yield seeded_objects.make(kind, seed)

    def test_is_closed_two_manifold_and_outward(self):
        for vertices, triangles in self.each():
            edges = np.concatenate([triangles[:, [k, (k + 1) % 3]] for k in range(3)]).astype(np.int64)
            forth, back = edges @ [len(vertices), 1], edges @ [1, len(vertices)]
            self.assertEqual(len(np.unique(forth)), len(forth))
            np.testing.assert_array_equal(np.sort(forth), np.sort(back))
            self.assertEqual(fans(triangles), len(vertices))
            self.assertGreater(seeded_objects.volume_of(vertices, triangles), 0.0)

    def test_stands_on_the_platter_and_has_a_size_for_it(self):
        for vertices, _ in self.each():
            self.assertAlmostEqual(vertices[:, 1].min(), 0.0)
            self.assertLess(vertices.max(), 320.0)
            self.assertGreater(np.ptp(vertices, axis=0).max(), 55.0)

    def test_is_the_same_for_the_same_seed_and_another_for_another(self):
        for kind in seeded_objects.KINDS:
            first, again, other = (seeded_objects.make(kind, seed)[0] for seed in (2, 2, 4))
            np.testing.assert_array_equal(first, again)
            self.assertFalse(np.array_equal(first, other))


if __name__ == '__main__':
    unittest.main()
