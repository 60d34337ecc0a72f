"""Motion of structures on unilateral frictional contacts, event by event.

    import signorini

    result = signorini.run("pipeline.toml", {"run.t_end": 0.4})
    result.events["t"], result.history["A.ux"], result.contacts["first"]["N"], result.units["A.ux"]

Scenes are files, TOML text, or dicts of the same keys (docs/scene.md). Signs and units are those of the program.
"""

from __future__ import annotations

import copy
import itertools
import json
import math
import os
import pathlib
import tempfile
from concurrent.futures import ThreadPoolExecutor

import numpy

from . import _signorini
from ._signorini import Error

__version__ = _signorini.version
__all__ = ["Error", "Result", "check", "columns", "compare", "find_orbit", "follow", "run", "schema", "sensitivity", "sweep", "to_toml"]


def _quoted(text: str) -> str:
    return json.dumps(text, ensure_ascii=False).replace("\x7f", "\\u007f")


def to_toml(value) -> str:
    """A value or a scene as TOML; tables are written in line."""
    if isinstance(value, numpy.generic):
        value = value.item()
    if isinstance(value, numpy.ndarray):
        value = value.tolist()
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, int):
        return str(value)
    if isinstance(value, float):
        return repr(value) if math.isfinite(value) else ("nan" if math.isnan(value) else "inf" if value > 0 else "-inf")
    if isinstance(value, (str, os.PathLike)):
        return _quoted(os.fspath(value))
    if isinstance(value, dict):
        return "{ " + ", ".join(f"{_quoted(str(key))} = {to_toml(item)}" for key, item in value.items()) + " }"
    if isinstance(value, (list, tuple)):
        return "[" + ", ".join(to_toml(item) for item in value) + "]"
    raise TypeError(f"found {type(value).__name__}, expected what TOML has: numbers, strings, flags, lists, dicts")


def _text(scene) -> tuple[str, str]:
    """The text of a scene, and the file that messages and relative paths refer to."""
    if isinstance(scene, dict):
        order = sorted(scene, key=lambda key: key != "schema")
        return "".join(f"{_quoted(key)} = {to_toml(scene[key])}\n" for key in order), "<dict>"
    if isinstance(scene, str) and "\n" in scene:
        return scene, "<text>"
    path = pathlib.Path(scene)
    try:
        return path.read_text(encoding="utf-8"), str(path)
    except (OSError, UnicodeDecodeError) as error:
        failure = Error(f"{path}: {error}")
        failure.code = 6
        raise failure from None


def _settings(settings) -> list[tuple[str, str]]:
    return [(path, to_toml(value)) for path, value in (settings or {}).items()]


def _table(columns) -> dict:
    return {name: numpy.asarray(values) for name, values in columns.items()}


class Result:
    """What a run yields. Tables are dicts of NumPy arrays; texts (contact, event, state) are arrays of strings.

    events, history, energy    tables;   contacts[name]: a table each
    response                   the outputs of the scene ([[output]]), on both sides of every instant
    units                      of the columns of history and response, by name;   scene_units: force, mass, length, time
    summary                    summary.json: outcome, settings, counters, audit, certified, ...
    toml                       the scene with every default filled in
    """

    _parts = ("events", "history", "energy", "contacts", "response", "units", "summary", "toml")

    def __init__(self, run):
        self._run = run

    def __getattr__(self, name):
        # Only what is asked for is converted, once: of a thousand runs one figure each is wanted.
        if name not in self._parts:
            raise AttributeError(f"'Result' object has no attribute '{name}'")
        value = getattr(self._run, name)()
        if name == "summary":
            value = json.loads(value)
        elif name == "contacts":
            value = {contact: _table(columns) for contact, columns in value.items()}
        elif name not in ("units", "toml"):
            value = _table(value)
        setattr(self, name, value)
        return value

    def __getstate__(self):
        return {name: getattr(self, name) for name in self._parts}

    def __setstate__(self, state):
        self.__dict__.update(state)

    def __dir__(self):
        return [*super().__dir__(), *self._parts]

    @property
    def scene_units(self) -> dict:
        return self.summary["units"]

    @property
    def outcome(self) -> str:
        """done or stopped; summary["outcome"] says at what time and why."""
        return self.summary["outcome"]["kind"]

    def frame(self, table="history"):
        """events, history, energy, response, or the name of a contact as a pandas.DataFrame, with its units in attrs."""
        import pandas

        columns = getattr(self, table) if table in ("events", "history", "energy", "response") else self.contacts[table]
        frame = pandas.DataFrame(columns)
        frame.attrs["units"] = self.units if table in ("history", "response") else self.scene_units
        return frame

    def __repr__(self):
        return f"<signorini.Result {self.outcome} at t = {self.summary['outcome']['t']}, {len(self.events['t'])} events>"


def run(scene, settings=None, *, directory=None, force=False) -> Result:
    """Computes a scene. settings: {"run.rtol": 1e-10, "contacts.*.friction": 0.5}. With a directory, all files of
    `signorini run` but pictures are written, too. A run that stops early is a result; what cannot be run is an Error."""
    return _run(scene, settings, directory, force, None)


def _run(scene, settings, directory, force, stop) -> Result:
    text, file = _text(scene)
    folder = None if directory is None else os.fspath(directory)
    return Result(_signorini.run(text, file, _settings(settings), folder, force, stop))


def check(scene, settings=None) -> dict:
    """What `signorini check --json` says."""
    text, file = _text(scene)
    return json.loads(_signorini.check(text, file, _settings(settings)))


def compare(scene, engines, settings=None) -> dict:
    """Runs a scene with several engines; the first is the reference. By engine: the greatest difference of event times,
    displacements, forces, ..., each {value, t, where}; `parted`: whether the sequences of events differ."""
    with tempfile.TemporaryDirectory() as folder:
        runs = {}
        for engine in engines:
            runs[engine] = os.path.join(folder, engine)
            run(scene, {**(settings or {}), "run.engine": engine}, directory=runs[engine])
        return {engine: _signorini.compare(runs[engines[0]], runs[engine]) for engine in engines[1:]}


def sweep(scene, vary, settings=None, *, workers=None) -> list[tuple[dict, Result | Error]]:
    """Runs a scene for all combinations of {"PATH": values}, the last one fastest, several at a time. A run that is refused
    is its Error in the list. Ctrl-C ends the runs in progress at their next step, and starts no other."""
    points = [dict(zip(vary, values)) for values in itertools.product(*vary.values())]
    scene = copy.deepcopy(scene) if isinstance(scene, dict) else scene
    stop = _signorini.Stop()

    def one(point):
        try:
            return _run(scene, {**(settings or {}), **point, "run.certify": False}, None, False, stop)
        except Error as error:
            return error

    pool = ThreadPoolExecutor(workers or os.cpu_count())
    try:
        return list(zip(points, pool.map(one, points)))
    except BaseException:
        stop.ask()
        raise
    finally:
        pool.shutdown(cancel_futures=True)


def columns(rows, **of) -> dict[str, numpy.ndarray]:
    """The rows of a sweep as arrays, one value a row: each key that varies, `outcome` ("done", "stopped" or "refused"), and
    what each of the functions `of` says about a Result. Where a run was refused that is nan."""
    table = {path: numpy.asarray([point[path] for point, _ in rows]) for path in (rows[0][0] if rows else {})}
    table["outcome"] = numpy.asarray(["refused" if isinstance(r, Error) else r.outcome for _, r in rows], dtype=str)
    for name, function in of.items():
        if name in table:
            raise ValueError(f"{name}: is the name of a column already")
        table[name] = numpy.asarray([math.nan if isinstance(r, Error) else function(r) for _, r in rows])
    return table


def sensitivity(scene, parameters, settings=None, *, losses=False, discrete=False) -> dict:
    """Derivatives of a run by keys of its scene, along its engine (docs/command-line.md). parameters: a path, or several.
    losses: energies, works, losses and landings, too. discrete: with engine newmark, of its steps.

    events, t, columns         the run's own: tables of arrays
    parameters[path]           value, until, reason, and by this parameter
        events                 dt_dp, dN_dp, ...: an array a column, a value an event
        columns                derivatives of columns at the times t
        figures                {(contact, "peak N"): (value, derivative)}; with losses ("", "lost by damping"), ...
        landings               with losses: dstart_dp, dend_dp, dimpulse_dp, dpeak_force_dp
    landings                   with losses: contact, start, end, impulse, peak_force: a list or array each
    """
    text, file = _text(scene)
    paths = [parameters] if isinstance(parameters, str) else list(parameters)
    result = _signorini.sensitivity(text, file, paths, _settings(settings), losses, discrete)
    result["events"] = {name: numpy.asarray(values) for name, values in result["events"].items()}
    return result


def find_orbit(scene, settings=None, *, period=None, times=1, transient=20) -> dict:
    """The periodic motion of a scene, and its stability: what orbit.json has (docs/command-line.md), with

    multipliers    an array of complex numbers, by magnitude, descending
    result         the Result of a run over one period; None where no orbit was found: `reason` says why

    Units are those of the scene. period: of the loads; times: periods of them after which the orbit closes; transient:
    periods that are run before Newton's method begins.
    """
    text, file = _text(scene)
    found, once = _signorini.find_orbit(text, file, _settings(settings), period, times, transient)
    orbit = json.loads(found)
    orbit["multipliers"] = numpy.asarray([complex(*mu) for mu in orbit["multipliers"]], dtype=complex)
    orbit["result"] = None if once is None else Result(once)
    return orbit


def follow(scene, path, start, stop, settings=None, *, step=0.02, most_points=1000, switches=0, period=None, times=1,
           transient=20) -> dict:
    """A branch of orbits over a key of the scene, from one value to another, past folds: what branch.json has, with

    points    the columns of branch.csv as arrays: parameter, period, amplitude, "NAME minimum" and "NAME maximum" of every
              output, max_multiplier, stable (1, 0, or nan where undecided), loss, sequence, events, special, branch, ...

    step: the greatest, as a fraction of the range. switches: so many times in a row the walk changes to branches that leave at
    flips and branch points. A branch that ends early raises nothing: `complete` is False, and `end` says why.
    """
    text, file = _text(scene)
    points, told = _signorini.follow(text, file, _settings(settings), period, times, transient, path, float(start),
                                     float(stop), step, most_points, switches)
    branch = json.loads(told)
    branch["points"] = _table(points)
    return branch


def schema() -> dict:
    """The JSON Schema of scenes."""
    return json.loads(_signorini.schema())
