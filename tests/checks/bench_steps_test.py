"""scripts/bench steps: what it reads from callgrind, and what it says against an earlier run."""

import importlib.machinery
import importlib.util
import pathlib
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
LOADER = importlib.machinery.SourceFileLoader("bench", str(ROOT / "scripts/bench"))
bench = importlib.util.module_from_spec(importlib.util.spec_from_loader("bench", LOADER))
LOADER.exec_module(bench)

LISTED = """
Ir
10,000 (100.0%)  PROGRAM TOTALS
 9,000 (90.00%)  ???:turnscan::run_reconstruction(int) [/x/turnscan]
 6,000 (60.00%)  ???:turnscan::ReconstructionStream::finish(int) [/x/turnscan]
 4,000 (40.00%)  ???:turnscan::mesh_refinement::fit_mesh(int) [/x/turnscan]
 2,000 (20.00%)  ???:turnscan::ReconstructionStream::add(int) [/x/turnscan]
 1,900 (19.00%)  ???:turnscan::ReconstructionStream::add(int, int) [/x/turnscan]
   700 ( 7.00%)  ???:turnscan::write_run_meshes[abi:cxx11](int) [/x/turnscan]
   200 ( 2.00%)  ???:turnscan::run_report[abi:cxx11](int) [/x/turnscan]
"""


def grown(now, before, case="doll"):
    made = bench.Bench.__new__(bench.Bench)
    made.rows = [{"case": "doll", "instructions": now}]
    return made.grown([{"case": case, "instructions": before}])


class BenchSteps(unittest.TestCase):
    def test_a_step_has_what_its_functions_call_and_the_rests_complete_the_process(self):
        self.assertEqual(
            bench.instructions_of(LISTED),
            {"all": 10000, "frames": 2000, "stages": 6000, "  fit": 4000, "  rest of stages": 2000,
             "writing": 900, "start and rest": 1100})

    def test_every_step_is_a_function_of_the_library(self):
        text = "".join(p.read_text() for p in (ROOT / "src/turnscan").rglob("*.hpp"))
        steps = [f for functions, parts in bench.STEPS.values()
                 for names in (functions, *parts.values()) for f in names]
        for name in steps + [f for functions in bench.SHARED.values() for f in functions]:
            self.assertIn(f" {name.split('::')[-1]}(", text, name)

    def test_names_what_grew_by_more_than_a_twentieth(self):
        self.assertEqual(grown({"all": 2000, "fit": 1040, "frames": 110},
                               {"all": 2000, "fit": 1000, "frames": 100}),
                         ["doll: frames grew by 10 %"])

    def test_leaves_out_what_nobody_waits_for(self):
        self.assertEqual(grown({"all": 10000, "fit": 9}, {"all": 10000, "fit": 1}), [])

    def test_names_a_step_that_is_not_found_any_more(self):
        self.assertEqual(grown({"all": 2000}, {"all": 2000, "fit": 1000}),
                         ["doll: fit is gone: look for it in STEPS"])

    def test_says_when_there_is_nothing_to_compare(self):
        self.assertEqual(len(grown({"all": 1}, {"all": 1}, case="bunny")), 1)


if __name__ == "__main__":
    unittest.main()
