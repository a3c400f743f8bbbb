#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""The parts of scripts/fault_dials.py that need no program: scenes, figures, the page."""
import pathlib
import re
import sys
import tempfile
import tomllib
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "scripts"))
import fault_dials  # noqa: E402
from fault_dials import Dial, Failure, Measured  # noqa: E402

EXPLAINED = """12 photographs, GSD 0.05 m, truth in cells of 0.1 m: flight
Effects in the order in which they act; 4 rays a pixel:
  effect                stage        calls   thread s  because of
  pose_error            metadata         -          -  not named: nothing runs
  haze                  air           5760      0.125  a  b/scene.toml:8: effects.haze
"""


def measured(within=95.0, cpu_s=2.0, **others):
    figures = {name: 1.0 for name, *_ in fault_dials.FIGURES}
    return Measured({**figures, fault_dials.LOSS: within}, cpu_s, **others)


class FaultDialsTest(unittest.TestCase):
    def test_every_effect_has_a_dial(self):
        catalogue = (ROOT / "src/scene/effects/catalogue.h").read_text(encoding="utf-8")
        effects = set(re.findall(r'EffectInfo\{Id::\w+,\s*"(\w+)"', catalogue))
        self.assertGreaterEqual(len(effects), 14)
        self.assertEqual(effects, {dial.effect for dial in fault_dials.DIALS if dial.effect})

    def test_dials_are_told_apart_and_have_a_change_for_each_strength(self):
        names = [fault_dials.folder_name(dial, "") for dial in fault_dials.DIALS]
        self.assertEqual(len(names), len(set(names)))
        for dial in fault_dials.DIALS:
            self.assertEqual(len(dial.labels), len(dial.changes), dial.name)
            self.assertIn(dial.group, fault_dials.GROUPS)
            if dial.effect:
                self.assertTrue(all(path.startswith(f"effects.{dial.effect}.") for c in dial.changes for path in c))

    def test_the_base_scene_survives_being_written(self):
        base = tomllib.loads((ROOT / fault_dials.BASE).read_text(encoding="utf-8"))
        self.assertEqual(tomllib.loads(fault_dials.to_toml(base)), base)

    def test_a_change_reaches_its_table_and_leaves_the_scene_alone(self):
        scene = {"seed": 1, "flight": {"gsd_m": 0.05}}
        changed = fault_dials.with_changes(scene, {"flight.gsd_m": 0.1, "effects.haze.visibility_m": 100, "seed": 2})
        self.assertEqual(tomllib.loads(fault_dials.to_toml(changed)),
                         {"seed": 2, "flight": {"gsd_m": 0.1}, "effects": {"haze": {"visibility_m": 100}}})
        self.assertEqual(scene, {"seed": 1, "flight": {"gsd_m": 0.05}})

    def test_words_truth_values_and_lists_are_written_as_toml_has_them(self):
        scene = {"light": {"shadows": False}, "texture": {"kind": "tiles"}, "camera": {"distortion": [0.05, 0, 0, 0, 0]}}
        self.assertEqual(tomllib.loads(fault_dials.to_toml(scene)), scene)

    def test_distortion_is_hidden_and_nothing_else(self):
        with tempfile.TemporaryDirectory() as folder:
            poses = pathlib.Path(folder) / "poses.csv"
            poses.write_text("image,x,k1,k2,p1,p2,k3\na.jpg,5.612402915954590,0.05,1,2,3,4\n", encoding="utf-8")
            fault_dials.hide_distortion(poses)
            self.assertEqual(poses.read_text(encoding="utf-8").split(),
                             ["image,x,k1,k2,p1,p2,k3", "a.jpg,5.612402915954590,0,0,0,0,0"])

    def test_effects_that_ran_are_read_from_the_explanation(self):
        self.assertEqual(fault_dials.effects_of(EXPLAINED), {"haze": (5760, 0.125)})

    def test_figures_that_are_missing_are_none(self):
        found = fault_dials.figures_of({"masked": {"valid_share": 0.5}, "edges": {"all": {"scores": []}}})
        self.assertEqual(found["with a height"], 50)
        self.assertIsNone(found["edges F"])
        self.assertIsNone(found["ortho shift"])

    def test_a_cell_shows_value_and_change(self):
        self.assertEqual(fault_dials.cell_text(93.14, 95.36, 1), "93.1 (-2.3)")
        self.assertEqual(fault_dials.cell_text(95.04, 95.01, 1), "95.0 (0)")
        self.assertEqual(fault_dials.cell_text(95.04, None, 1), "95.0")
        self.assertEqual(fault_dials.cell_text(None, 95.0, 1), "-")

    def test_a_failed_strength_is_told_with_its_command_and_the_rest_goes_on(self):
        class Program:
            def measure(self, name, scene, *_):
                if name == "haze-mild":
                    raise Failure("skysweep simulate scene.toml\n  ended with 2: no")
                return measured(90 if "effects" in scene else 95, calls=3, effect_s=0.2)

        dial = Dial("haze", "image", ("1 m", "2 m", "3 m"), tuple({"effects.haze.visibility_m": v} for v in (1, 2, 3)))
        told = []
        rows, failed = fault_dials.measure_all([dial], {}, Program(), told.append)
        self.assertEqual(failed, 1)
        self.assertIn("skysweep simulate scene.toml", "\n".join(told))
        self.assertIn("scripts/fault_dials.py --only haze-mild", "\n".join(told))
        page = fault_dials.page(rows, "command", "today", "2 cores")
        self.assertIn("| `haze` | 1 m | failed |", page)
        self.assertIn("90.0 (-5.0)", page)
        self.assertIn("| 3 | 10 % | x 1.0 |", page)
        self.assertIn("at plain strength, in per cent of the cells: `haze` 5.0.", page)

    def test_a_dial_with_a_scene_of_its_own_is_compared_with_that(self):
        class Program:
            def measure(self, name, scene, *_):
                return measured({"undisturbed for lake": 80.0, "undisturbed": 95.0}.get(name, 70.0))

        dial = Dial("lake", "light", ("1", "2", "3"), ({"a.b": 1},) * 3, given={"terrain.water_level_m": 0})
        page = fault_dials.page(fault_dials.measure_all([dial], {}, Program(), lambda _: None)[0], "", "", "")
        self.assertIn("| none, for `lake` |", page)
        self.assertIn("70.0 (-10.0)", page)

    def test_every_row_has_the_columns_of_the_head(self):
        columns = fault_dials.head_of_table()[1].count("|")
        for row in (fault_dials.row_of_table("a", "b", None, None),
                    fault_dials.row_of_table("a", "b", measured(), None),
                    fault_dials.row_of_table("a", "b", measured(calls=2, effect_s=0.001), measured())):
            self.assertEqual(row.count("|"), columns, row)

    def test_dials_are_chosen_by_name_effect_or_folder(self):
        chosen = fault_dials.chosen_dials(["pose_error", "haze.visibility_m-mild", "light.shadows"])
        self.assertEqual({dial.effect for dial in chosen}, {"pose_error", "haze", ""})
        self.assertEqual(fault_dials.chosen_dials(None), fault_dials.DIALS)
        with self.assertRaisesRegex(ValueError, "--only mist: no such dial"):
            fault_dials.chosen_dials(["mist"])


if __name__ == "__main__":
    unittest.main()
