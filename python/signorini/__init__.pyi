from os import PathLike
from typing import Any, Callable, Literal, Mapping, Sequence, TypedDict

import numpy
import pandas
from numpy.typing import NDArray

__version__: str
Scene = str | PathLike[str] | dict[str, Any]
Settings = Mapping[str, Any]
Table = dict[str, NDArray[Any]]
Engine = Literal["auto", "exact", "ida", "newmark", "friction-iteration"] | str

class Error(Exception):
    code: int

class Deviation(TypedDict):
    value: float
    t: float
    where: str

class Result:
    events: Table
    history: Table
    energy: Table
    response: Table
    contacts: dict[str, Table]
    units: dict[str, str]
    scene_units: dict[str, str]
    summary: dict[str, Any]
    toml: str
    @property
    def outcome(self) -> str: ...
    def frame(self, table: str = "history") -> pandas.DataFrame: ...

def run(scene: Scene, settings: Settings | None = None, *, directory: str | PathLike[str] | None = None, force: bool = False) -> Result: ...
def check(scene: Scene, settings: Settings | None = None) -> dict[str, Any]: ...
def compare(scene: Scene, engines: Sequence[Engine], settings: Settings | None = None) -> dict[str, dict[str, Any]]: ...
def sweep(
    scene: Scene, vary: Mapping[str, Sequence[Any]], settings: Settings | None = None, *, workers: int | None = None
) -> list[tuple[dict[str, Any], Result | Error]]: ...
def columns(rows: Sequence[tuple[dict[str, Any], Result | Error]], **of: Callable[[Result], Any]) -> Table: ...
def sensitivity(
    scene: Scene,
    parameters: str | Sequence[str],
    settings: Settings | None = None,
    *,
    losses: bool = False,
    discrete: bool = False,
) -> dict[str, Any]: ...
def find_orbit(
    scene: Scene,
    settings: Settings | None = None,
    *,
    period: float | None = None,
    times: int = 1,
    transient: int = 20,
) -> dict[str, Any]: ...
def follow(
    scene: Scene,
    path: str,
    start: float,
    stop: float,
    settings: Settings | None = None,
    *,
    step: float = 0.02,
    most_points: int = 1000,
    switches: int = 0,
    period: float | None = None,
    times: int = 1,
    transient: int = 20,
) -> dict[str, Any]: ...
def schema() -> dict[str, Any]: ...
def to_toml(value: Any) -> str: ...
