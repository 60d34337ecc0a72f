"""Every scene of models and of the reference cases against `signorini schema`, by Debian's jsonschema; and what is wrong.

schema.py PROGRAM
"""
import copy
import json
import pathlib
import subprocess
import sys
import tomllib

import jsonschema

root = pathlib.Path(__file__).resolve().parents[2]
schema = json.loads(subprocess.run([sys.argv[1], "schema"], check=True, capture_output=True).stdout)
jsonschema.Draft7Validator.check_schema(schema)
validator = jsonschema.Draft7Validator(schema)

scenes = [*root.glob("models/*.toml"), *root.glob("tests/cases/*.toml"), *root.glob("src/cli/scenes/*.toml")]
assert len(scenes) > 30, scenes
for path in scenes:
    for error in validator.iter_errors(tomllib.loads(path.read_text())):
        sys.exit(f"{path}: {error.json_path}: {error.message}")

portal = tomllib.loads((root / "src/cli/scenes/portal.toml").read_text())
wrong = [
    lambda s: s.update(contcats=[]),
    lambda s: s.pop("run"),
    lambda s: s["run"].update(engine="idea"),
    lambda s: s["run"].update(t_end=0),
    lambda s: s["contacts"][0].update(friction=-0.1),
    lambda s: s["contacts"][0].pop("law"),
    lambda s: s["nodes"].update(A=[0.0]),
]
for change in wrong:
    scene = copy.deepcopy(portal)
    change(scene)
    assert not validator.is_valid(scene), change.__code__.co_consts
print(f"{len(scenes)} scenes are valid, {len(wrong)} wrong ones are not")
