// The beginning of docs/scene.md.
#include "cli/key_reference.hpp"

namespace signorini::cli {

namespace {

constexpr std::string_view introduction =
    R"(<!-- Generated: signorini keys --markdown > docs/scene.md. Text: src/cli/key_*.cpp; keys: src/scene/keys.cpp -->

# Scene files

A scene is a [TOML](https://toml.io) file. It says how long to compute, what the structure is, where it touches
something, what loads it, and in which units all of that is meant. This is a whole one, a block of 1 kg that is
pushed over a plate:

```toml
schema = 1
units = { force = "N", mass = "kg", length = "m", time = "s" }

[run]
t_end = 2.0

[nodes]
block = [0.0, 0.0]

[[masses]]
node = "block"
mass = 1.0

[[supports]]
node = "block"
fix = ["uy"]

[[contacts]]
name = "plate"
node = "block"
law = "slider"
tangent = [1.0, 0.0]
normal_force = 10.0
friction = 0.3

[[loads]]
node = "block"
direction = [1.0, 0.0]
amplitude = 6.0
history = { type = "rectangle", start = 0.5, end = 1.0 }
```

- `signorini check SCENE` reads a scene, says what it holds and whether it can be computed, and computes nothing.
- An unknown key is an error with a suggestion; so is a value of the wrong kind, a name that nothing has, a
  negative mass. Every message names file, line, column and key.
- Numbers are finite. An integer will do where a number is asked for.
- The order of tables does not matter, except that `schema` is the first key.
- `x` points to the right, `y` up, rotations turn counter-clockwise and are in rad. Displacements are measured
  from the undeformed state.
- `--set PATH=VALUE` changes any key from the command line: [command-line.md](command-line.md).
- `run.toml` in the directory of a run is the scene with every default filled in.

A structure is given either by `[nodes]` with members, masses, springs and supports, or by `[matrices]`. A degree
of freedom exists only where a member, mass, spring or contact needs it: a mass that slides along x on a spring
along x needs `uy` fixed, because masses move both ways, and no `rz`, because nothing there turns.

Below, units are those of the scene: `force/length` is N/m in a scene in N, kg, m, s, and kN/m in one in kN, t,
m, s. No default means that the key may be left out.
)";

}  // namespace

std::string_view reference_introduction() { return introduction; }

}  // namespace signorini::cli
