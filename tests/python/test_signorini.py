"""The package: what it returns, its errors, interrupts, threads, and the tutorial. Known answers are those of sums by hand.

python3 -m unittest, with the package on PYTHONPATH
"""
import contextlib
import io
import json
import os
import pathlib
import pickle
import re
import signal
import tempfile
import threading
import time
import unittest

import numpy as np

import signorini

root = pathlib.Path(__file__).resolve().parents[2]

push = {
    "schema": 1,
    "units": {"force": "N", "mass": "kg", "length": "m", "time": "s"},
    "run": {"t_end": 2.0, "output_dt": 0.01},
    "nodes": {"block": [0.0, 0.0]},
    "masses": [{"node": "block", "mass": 1.0}],
    "supports": [{"node": "block", "fix": ["uy"]}],
    "contacts": [{"name": "plate", "node": "block", "law": "slider", "tangent": [1.0, 0.0], "normal_force": 10.0, "friction": 0.3}],
    "loads": [{"node": "block", "direction": [1.0, 0.0], "amplitude": 6.0,
               "history": {"type": "rectangle", "start": 0.5, "end": 1.0}}],
}


class Run(unittest.TestCase):
    def test_a_push_by_hand(self):
        result = signorini.run(push)
        self.assertEqual(result.outcome, "done")
        changes = [e in ("slip", "stick") for e in result.events["event"]]
        np.testing.assert_allclose(result.events["t"][changes], [0.5, 1.5], atol=1e-7)  # 3 m/s^2 up to 1.5 m/s, and down again
        self.assertAlmostEqual(result.history["block.ux"][-1], 0.75, places=6)
        plate = result.contacts["plate"]
        sliding = plate["state"] == "slip+"
        np.testing.assert_allclose(plate["T"][sliding], 3.0)
        np.testing.assert_allclose(plate["N"], -10.0)
        np.testing.assert_allclose(plate["ratio"], np.abs(plate["T"]) / 10.0)
        self.assertEqual((result.units["block.ux"], result.units["block.vx"], result.units["t"]), ("m", "m/s", "s"))
        self.assertAlmostEqual(result.energy["friction"][-1], 3.0 * 0.75, places=6)
        self.assertEqual(len(result.history["t"]), 201)

    def test_files_texts_dicts_and_settings_are_the_same_scene(self):
        text = 'schema = 1\n' + "".join(f"{key} = {signorini.to_toml(value)}\n" for key, value in push.items() if key != "schema")
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder) / "push.toml"
            path.write_text(text)
            last = [signorini.run(scene, {"contacts.plate.friction": 0.5}).history["block.ux"][-1] for scene in (push, text, path, str(path))]
        np.testing.assert_allclose(last, 0.125 + 0.025, atol=1e-6)  # 1 m/s^2 for 0.5 s, then back with 5
        self.assertEqual(len(set(last)), 1)
        self.assertNotEqual(push["contacts"][0]["friction"], 0.5)

    def test_a_directory_is_that_of_the_program(self):
        with tempfile.TemporaryDirectory() as folder:
            directory = pathlib.Path(folder) / "out"
            result = signorini.run(push, directory=directory)
            rows = np.genfromtxt(directory / "history.csv", delimiter=",", names=True, deletechars="")
            np.testing.assert_array_equal(rows["block.ux"], result.history["block.ux"])
            self.assertTrue((directory / "motion.csv").exists() and (directory / "run.toml").exists())
            manifest = json.loads((directory / "manifest.json").read_text())
            self.assertEqual(manifest["outcome"], "done")
            for entry in manifest["files"]:
                self.assertEqual(entry["size"], (directory / entry["file"]).stat().st_size)
            with self.assertRaises(signorini.Error) as caught:
                signorini.run(push, directory=directory)
            self.assertEqual(caught.exception.code, 6)
            signorini.run(push, directory=directory, force=True)

    def test_errors_name_place_and_key(self):
        with self.assertRaises(signorini.Error) as caught:
            signorini.run({**push, "contcats": []})
        self.assertIn("contcats", str(caught.exception))
        self.assertEqual(caught.exception.code, 3)
        with self.assertRaises(signorini.Error) as caught:
            signorini.run(push, {"run.rtol": "tight"})
        self.assertEqual(caught.exception.code, 2)
        with self.assertRaises(signorini.Error) as caught:
            signorini.run("no/such/scene.toml")
        self.assertEqual(caught.exception.code, 6)
        with self.assertRaises(TypeError):
            signorini.run(push, {"run.rtol": object()})

    def test_pandas_where_it_is(self):
        try:
            import pandas
        except ImportError:
            self.skipTest("no pandas")
        frame = signorini.run(push).frame("history")
        self.assertIsInstance(frame, pandas.DataFrame)
        self.assertEqual(frame.attrs["units"]["block.vx"], "m/s")
        self.assertEqual(list(signorini.run(push).frame("events").columns)[:3], ["t", "contact", "event"])

    def test_outputs(self):
        outputs = [{"name": "way", "kind": "displacement", "at": "block", "direction": [1.0, 0.0]},
                   {"name": "rub", "kind": "contact", "at": "plate", "quantity": "T"}]
        with tempfile.TemporaryDirectory() as folder:
            result = signorini.run({**push, "output": outputs}, directory=pathlib.Path(folder) / "out")
            lines = (pathlib.Path(folder) / "out" / "response.csv").read_text().splitlines()
        self.assertEqual(lines[0].split(",")[:3], ["t", "way", "rub"])
        self.assertEqual(len(lines) - 1, len(result.response["t"]))
        self.assertAlmostEqual(result.response["way"][-1], 0.75, places=6)
        self.assertEqual((result.units["way"], result.units["rub"]), ("m", "N"))
        self.assertAlmostEqual(result.response["rub"].max(), 3.0)

    def test_toml_of_hostile_texts_comes_back(self):
        import tomllib
        value = {"a\"b": ["\\", "\n\t\x7f", "é\U0001f600", -0.0, 1e-300, True, 7, np.float64(0.5), np.arange(2)]}
        back = tomllib.loads("x = " + signorini.to_toml(value))["x"]
        self.assertEqual(back['a"b'][:8], ["\\", "\n\t\x7f", "é\U0001f600", -0.0, 1e-300, True, 7, 0.5])
        self.assertEqual(back['a"b'][8], [0, 1])


class Kept(unittest.TestCase):
    def test_a_result_survives_pickling_and_has_its_parts_by_name(self):
        result = signorini.run(push)
        again = pickle.loads(pickle.dumps(result))
        self.assertEqual(again.outcome, "done")
        np.testing.assert_array_equal(again.history["block.ux"], result.history["block.ux"])
        self.assertEqual(again.toml, result.toml)
        self.assertIs(result.events, result.events)
        self.assertIn("events", dir(result))
        with self.assertRaises(AttributeError):
            result.evens


class Others(unittest.TestCase):
    def test_check(self):
        facts = signorini.check(push)
        self.assertEqual(facts["degrees_of_freedom"], 1)
        self.assertEqual(facts["mass"]["total"], 1.0)

    def test_compare(self):
        differences = signorini.compare(push, ["exact", "ida"])
        self.assertEqual(list(differences), ["ida"])
        self.assertFalse(differences["ida"]["parted"])
        self.assertLess(differences["ida"]["event_time"]["value"], 1e-6)

    def test_sweep(self):
        rows = signorini.sweep(push, {"contacts.plate.friction": [0.3, 0.5, -1.0], "run.engine": ["ida", "exact"]}, workers=2)
        self.assertEqual([point["contacts.plate.friction"] for point, _ in rows], [0.3, 0.3, 0.5, 0.5, -1.0, -1.0])
        self.assertAlmostEqual(rows[1][1].history["block.ux"][-1], 0.75, places=9)
        self.assertIsInstance(rows[4][1], signorini.Error)

    def test_columns_of_a_sweep(self):
        rows = signorini.sweep(push, {"contacts.plate.friction": [0.3, 0.5, -1.0]}, {"run.engine": "exact"}, workers=2)
        table = signorini.columns(rows, way=lambda result: result.history["block.ux"][-1])
        self.assertEqual(list(table["contacts.plate.friction"]), [0.3, 0.5, -1.0])
        self.assertEqual(list(table["outcome"]), ["done", "done", "refused"])
        # x = 0.075 (6 - 10 f) / f
        self.assertAlmostEqual(table["way"][0], 0.75, places=9)
        self.assertAlmostEqual(table["way"][1], 0.15, places=9)
        self.assertTrue(np.isnan(table["way"][2]))
        self.assertEqual(signorini.columns([])["outcome"].size, 0)
        with self.assertRaises(ValueError):
            signorini.columns(rows, outcome=len)

    def test_sensitivity_by_hand(self):
        # a = 6 - 10 f for 0.5 s, then -10 f: it stops at 1 + 0.5 (6 - 10 f) / (10 f) = 0.5 + 0.3 / f.
        by = signorini.sensitivity(push, "contacts.plate.friction")
        stop = list(by["events"]["event"]).index("stick")
        rates = by["parameters"]["contacts.plate.friction"]
        self.assertAlmostEqual(rates["events"]["dt_dp"][stop], -0.3 / 0.3**2, places=6)
        # x = (6 - 10 f) / 8 + (6 - 10 f)^2 / (80 f) = 0.075 (6 - 10 f) / f
        self.assertAlmostEqual(rates["columns"]["block.ux"][-1], -0.45 / 0.3**2, places=6)
        self.assertEqual(rates["value"], 0.3)

    def test_losses_by_hand(self):
        # 10 f x = 4.5 - 7.5 f is lost
        by = signorini.sensitivity(push, "contacts.plate.friction", losses=True)
        lost, rate = by["parameters"]["contacts.plate.friction"]["figures"]["plate", "lost by friction"]
        self.assertAlmostEqual(lost, 4.5 - 7.5 * 0.3, places=6)
        self.assertAlmostEqual(rate, -7.5, places=6)
        self.assertEqual(list(by["landings"]["contact"]), [])
        with self.assertRaises(signorini.Error) as refused:
            signorini.sensitivity(push, "contacts.plate.friction", {"run.engine": "ida"}, discrete=True)
        self.assertEqual(refused.exception.code, 2)

    def test_schema(self):
        self.assertIn("contacts", signorini.schema()["properties"])


class Manners(unittest.TestCase):
    long = {"run.t_end": 1e6, "run.output_dt": 1e5, "run.certify": False, "run.engine": "ida"}
    belt = str(root / "models" / "belt.toml")

    def test_an_interrupt_ends_a_run(self):
        # A shell starts what it sends to the background with interrupts ignored.
        self.addCleanup(signal.signal, signal.SIGINT, signal.signal(signal.SIGINT, signal.default_int_handler))
        timer = threading.Timer(0.4, lambda: os.kill(os.getpid(), signal.SIGINT))
        start = time.monotonic()
        timer.start()
        with self.assertRaises(KeyboardInterrupt):
            signorini.run(self.belt, self.long)
        self.assertLess(time.monotonic() - start, 10.0)

    def test_an_interrupt_ends_a_sweep_and_starts_no_other_run(self):
        self.addCleanup(signal.signal, signal.SIGINT, signal.signal(signal.SIGINT, signal.default_int_handler))
        timer = threading.Timer(0.4, lambda: os.kill(os.getpid(), signal.SIGINT))
        start = time.monotonic()
        timer.start()
        with self.assertRaises(KeyboardInterrupt):
            signorini.sweep(self.belt, {"contacts.belt.friction.static": [1.2, 1.3, 1.4, 1.5, 1.6]}, self.long, workers=2)
        self.assertLess(time.monotonic() - start, 10.0)  # each of the five takes minutes

    def test_others_go_on_while_a_run_computes(self):
        counts = []
        done = threading.Event()

        def count():
            while not done.is_set():
                counts.append(time.monotonic())
                time.sleep(0.005)

        thread = threading.Thread(target=count)
        thread.start()
        start = time.monotonic()
        signorini.run(self.belt, {**self.long, "run.t_end": 4000.0, "run.output_dt": 400.0})
        end = time.monotonic()
        done.set()
        thread.join()
        self.assertGreater(sum(start < t < end for t in counts), 3)


class Orbits(unittest.TestCase):
    belt = {
        "schema": 1,
        "units": {"force": "N", "mass": "kg", "length": "m", "time": "s"},
        "run": {"t_end": 60.0, "engine": "exact"},
        "nodes": {"block": [0.0, 0.0]},
        "masses": [{"node": "block", "mass": 1.0}],
        "supports": [{"node": "block", "fix": ["uy"]}],
        "springs": [{"node": "block", "direction": [1.0, 0.0], "stiffness": 1.0}],
        "contacts": [{"name": "belt", "node": "block", "law": "slider", "tangent": [1.0, 0.0], "normal_force": 1.0,
                      "friction": {"static": 1.0, "kinetic": 0.5}, "surface_velocity": 0.2}],
    }

    def test_the_period_of_a_block_on_a_belt(self):
        orbit = signorini.find_orbit(self.belt)
        self.assertTrue(orbit["found"], orbit["reason"])
        self.assertAlmostEqual(orbit["period"], np.pi + 2.0 * np.arctan(0.4) + 5.0, places=10)
        self.assertTrue(orbit["stable"])
        self.assertEqual(orbit["multipliers"].dtype, complex)
        once = orbit["result"].history["block.ux"]
        self.assertAlmostEqual(once[0], once[-1], places=10)

    def test_a_branch_over_the_speed_of_the_belt(self):
        branch = signorini.follow(self.belt, "contacts.belt.surface_velocity", 0.2, 0.4, step=0.2)
        self.assertTrue(branch["complete"], branch["end"])
        v = branch["points"]["parameter"]
        self.assertGreater(len(v), 3)
        np.testing.assert_allclose(branch["points"]["period"], np.pi + 2.0 * np.arctan(2.0 * v) + 1.0 / v, atol=1e-8)
        self.assertTrue(np.all(branch["points"]["stable"] == 1.0))
        self.assertEqual(set(branch["points"]["branch"]), {1.0})

    def test_no_orbit_is_a_value_and_no_period_an_error(self):
        lost = signorini.find_orbit(self.belt, {"run.t_end": 1.0})
        self.assertFalse(lost["found"])
        self.assertIsNone(lost["result"])
        self.assertTrue(lost["reason"])
        with self.assertRaises(signorini.Error) as refused:
            signorini.find_orbit({**self.belt, "contacts": []})
        self.assertEqual(refused.exception.code, 3)


class Tutorial(unittest.TestCase):
    def test_its_programs_run_and_print_what_it_says(self):
        text = (root / "docs" / "python.md").read_text()
        space = {}
        folder = os.getcwd()
        try:
            os.chdir(root)
            for code, said in re.findall(r"```python\n(.*?)```\n(?:\n```text\n(.*?)```\n)?", text, re.DOTALL):
                out = io.StringIO()
                with contextlib.redirect_stdout(out):
                    exec(compile(code, "docs/python.md", "exec"), space)
                if said:
                    self.assertEqual(out.getvalue(), said)
        finally:
            os.chdir(folder)
        self.assertIn("result", space)


if __name__ == "__main__":
    unittest.main()
