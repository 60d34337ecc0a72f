// What docs/scene.md says about each table besides its keys. Blocks that begin with `schema = 1` are whole
// scenes, and are read by a test.
#include "cli/key_reference.hpp"

namespace signorini::cli {

namespace {

constexpr TableText texts[] = {
    {"", "## Top level", ""},
    {"units", "## `[units]`",
     R"(One of N, kg, m, s; kN, t, m, s; N, t, mm, s; and so on: force = mass * length / time^2 is checked, because a
scene in kN and kg is wrong by 1000.

```toml
units = { force = "kN", mass = "t", length = "m", time = "s" }
```)"},
    {"run", "## `[run]`",
     R"(```toml
[run]
t_end = 1.2
initial = "static"
rtol = 1e-8
output_dt = 1e-3
```

Events are found to full accuracy whatever `output_dt` is: it only says which rows `history.csv` has. `t_end` is
always one of them.

The engine is `ida` where none is named. `engine = "exact"` follows the closed form of the motion between events, to
rounding and whatever `rtol` is; it is the quicker one too, except where stiff dampers or damping beta K on a fine mesh
bring decays that are long over: `check` says what it would cost. `engine = "auto"` takes it but for those, and for laws
that are not linear; `summary.json` says what was taken and why.

A companion beside the run says how far off each event may be, and until when the sequence of events is certain
([output.md](output.md#certified-runs)). By itself it runs where it is expected to cost less than half of the run, which
is where `exact` takes the scene; `certify = true` asks for it.

`geometric = true` is P-delta: forces that stand in the structure push it on where it bends or turns. A first pass finds the forces of
the static loads without that; then they are frozen, and their stiffness acts from the start on. A beam under a compression has
less stiffness across, a bar under a tension is a string, a rigid body with its weight above its feet has the moment -m g h. Loads,
springs and contacts keep their directions. A static start is found again with this stiffness, and refused where the structure would
buckle, with its load factor; `check` prints the lowest ones. A frictional start comes to its end without it, and then it grows as a
last stage, "geometric". Where the state is given, the forces are those of the static equilibrium, which must exist. A run that goes
on has the forces of the run before, if that had any; they stand in its geometric.csv, without which it is refused. What changes in the run changes no force
that is frozen.)"},
    {"run.atol", "### `run.atol`",
     R"(The scales are printed in `summary.json`. Give these where the scene has no natural scale, or where only small
motions matter.)"},
    {"run.initial", "### `run.initial`",
     R"(`initial = "static"`: at rest, in frictionless equilibrium under gravity and the loads with a constant history
and neither start nor end; which contacts are closed is part of the answer, N follows from it, and T = 0 (or `initial_shear`).
A motion that only friction could stop is held at the first contact that can, when the static loads do no work
on it, and `check` names it. A contact whose normal carries nothing holds nothing. A motion that the loads would drive is
refused, and so is a support that would have to pull. With `[matrices]`, such a constant load must say what the weight is.

`initial = "frictional"`: from the undeformed state the loads grow slowly, one stage after the other, with friction and
open contacts in force; so a frame keeps its thrust, and a hot pipe the friction that it slid against. What grows is
named under `[[run.stages]]`; without stages all static loads grow together. Each comes to what it is at t = 0 and stays
there. Between two changes of state everything goes along lines, so the changes are exact; `run` prints them, and
summary.json has them (`model.frictional_start`). Contacts with a gap below zero come apart first, in a stage "fit".
Refused by name: a structure that nothing holds at some part of a stage, one that could only go on by moving, a contact
that begins to slip where its kinetic friction is below the static one, contacts at their limits from which a motion runs
away. Where contacts at their limits leave a motion that nothing resists, many slips go with the same forces: the least of
them is taken, and a warning names the contacts; another warns of flutter, an oscillation that would grow while they slip
(looked for up to 400 degrees of freedom).

`initial = { run = "DIR", t = 3.2 }` goes on from a state that the run in DIR kept in its states.csv: displacements and
velocities of all degrees of freedom and of supports that `acceleration` drives, motions of surfaces, the shears of contacts,
which of them slip, and how far their dashpots are deformed. Its t_end and its `frames` are kept. The units must be the same,
and the structure should: what differs is warned of; loads, motions and temperatures may be others. Scales, and tolerances
and `capture_velocity` with them, and the damping of `alpha_over_omega1` are those of that run, so that the events of two
halves are those of the whole. A reduced model goes on from the amplitudes that the displacements have; a cutoff that
`tolerance` asks for is looked for again. Time begins at 0 again: `shift = -3.2` takes a history along.

Otherwise displacements and velocities are as given, and zero where they are not. Degrees of freedom without mass follow
the forces on them: a velocity given there is not used, nor is a displacement without a damper, a dashpot or friction there. A
warning names such values, with their lines.

```toml
[run]
t_end = 10.0
initial = { A = { ux = 0.01, vy = -0.2 } }           # with [nodes]
# initial = { u = [0.0, 0.01], v = [0.0, 0.0] }      # with [matrices]
```)"},
    {"run.initial.*", "### `run.initial.NODE`", ""},
    {"run.stages[]", "### `[[run.stages]]`",
     R"(```toml
[run]
t_end = 20.0
initial = "frictional"

[[run.stages]]
name = "weight"
loads = ["gravity"]

[[run.stages]]
name = "heat"
loads = ["temperature", "supports"]
steps = 10
```)"},
    {"damping", "## `[damping]`",
     R"(```toml
[damping]
alpha_over_omega1 = 0.2
```

```toml
[damping]
ratios = [0.02, 0.05]
frequencies = [2.0, 15.0]
```

`signorini check` prints the ratios that follow for the first modes. Single dampers are given with `[[springs]]`. Not with `[matrices]`, which bring their own.)"},
    {"reduction", "## `[reduction]`",
     R"(Steps follow the highest frequency of the model, whether anything excites it or not, and a fine mesh has far higher
ones than the motion needs. With a cutoff the modes up to it are kept. All others keep their static compliance, at
every contact and under every load: so statics, contact stiffness and reactions are those of the full model, and what
is left out is the inertia of the high modes.

```toml
[reduction]
cutoff_omega = 2000.0
```

`signorini check` prints how many modes stay, the frequencies on both sides of the cutoff, and how much of the
compliance at each contact is left without inertia. Raise the cutoff until the answers stay:

    signorini run SCENE --set reduction.cutoff_omega=4000

Or say how exact displacements are to be, and the program finds the cutoff:

```toml
[reduction]
tolerance = 1e-6
```

It begins with a few modes, runs, and drives the modes left out with the loads and contact forces of that run: what their
inertia would have added at contacts and named nodes, relative to the greatest displacement there, is `missed`. What is missed
changes contact forces in turn, shifts events and may change their sequence. So each trial is compared with a run of at
least twice the cutoff, and `error` is their difference plus the error that this finer run may still have. The first trial
whose error is within the tolerance gives the cutoff. If none is, all modes are kept. summary.json lists all trials.

Contacts with law `rigid`, sliders that stick rigidly and contacts with dashpots need mass where they act, so the
static shapes that belong to them keep theirs, and bring frequencies above the cutoff.)"},
    {"sections", "## `[sections]`",
     R"(```toml
[sections.pipe]
EA = 9.0e6
EI = 2.0e6
mass_per_length = 0.4
```)"},
    {"sections.*", "### `[sections.NAME]`",
     R"(Or from a shape: EA = E A, EI = E I, the mass of the material and of what is in it and around it; with it stresses are
known.

```toml
[sections.line]
pipe = { diameter = 0.3239, wall = 0.0095, E = 2.0e8, density = 7.85, content = 1.0, insulation = { thickness = 0.08, density = 0.14 } }

[sections.rack]
i = { height = 0.3, width = 0.3, web = 0.011, flange = 0.019, E = 2.1e8, density = 7.85 }
```)"},
    {"sections.*.pipe", "### `sections.NAME.pipe`", ""},
    {"sections.*.pipe.insulation", "### `sections.NAME.pipe.insulation`", ""},
    {"sections.*.box", "### `sections.NAME.box`", ""},
    {"sections.*.i", "### `sections.NAME.i`", ""},
    {"sections.*.round", "### `sections.NAME.round`", ""},
    {"nodes", "## `[nodes]`",
     R"(```toml
[nodes]
A = [0.0, 0.0]
B = [0.0, 6.0]
```)"},
    {"lines[]", "## `[[lines]]`",
     R"(Nodes P0, P1, ..., P20 from (0, 4) to (60, 4), behind those of `[nodes]`. Members, supports, contacts and stops may name
them as a row, `nodes = ["P0..P20:4"]`.

```toml
[[lines]]
name = "P"
from = [0.0, 4.0]
to = [60.0, 4.0]
pieces = 20
```)"},
    {"members[]", "## `[[members]]`",
     R"(```toml
[[members]]
nodes = ["A", "B", "D"]     # two straight pieces
section = "pipe"
elements = [4, 12]          # of A-B and of B-D

[[members]]
nodes = ["A", "D"]
section = "brace"
type = "bar"                # hinged at both ends

[[members]]
nodes = ["P0..P20"]         # of a line of nodes
section = "pipe"
release = ["P20"]           # a hinge at its end
thermal_expansion = 1.2e-5
temperature = { type = "table", times = [0.0, 60.0], values = [0.0, 80.0], hold = true }

[[members]]
nodes = ["D", "E"]          # an elbow, from where one straight pipe ends to where the next begins
section = "pipe"
bend = { radius = 0.457 }   # turns left from D to E
```

The elements of an arc are chords: displacements and forces come to those of the arc with the square of their length.)"},
    {"members[].bend", "### `members.bend`", ""},
    {"masses[]", "## `[[masses]]`",
     R"(```toml
[[masses]]
node = "B"
mass = 0.5
```)"},
    {"rigid[]", "## `[[rigid]]`",
     R"(```toml
[[rigid]]
name = "block"              # its centre is a node of this name
centre = [0.0, 1.0]
nodes = ["L", "R", "top"]
box = { width = 1.0, height = 2.0, density = 2.4, thickness = 0.8 }

[[rigid]]
name = "offset"             # the end of a beam, and a bearing that stands 0.4 below it
centre = "B"
nodes = ["bearing"]
mass = 0.0
inertia = 0.0
```

The nodes have no degrees of freedom of their own: these are eliminated, without stiff members. Members, masses, springs,
contacts, loads, outputs and supports may stand at them as at any node. Results have their motions as those of all
nodes; `initial` is given at the centre. A node belongs to one body. A support of one node holds the body there, which may still
turn about it; the motion of the centre then follows. Two supports of a body's nodes along one direction may not both hold it where
one of them moves. Rotations are small: a weight does no work on them, unless `run.geometric` gives it the moment m g h of a
block that rocks.)"},
    {"rigid[].box", "### `rigid.box`", ""},
    {"supports[]", "## `[[supports]]`",
     R"(What is held moves neither way for ever, or as `motion` says. A support that may open is a contact.

```toml
[[supports]]
node = "A"
fix = ["ux", "uy"]

[[supports]]
node = "D"
fix = ["uy"]
motion = { type = "table", times = [0.0, 0.2, 0.8, 1.0], values = [0.0, 0.0, -0.02, -0.02], interpolation = "steffen", hold = true }
```

The force of supports that move is -K s - C s' - M s'', of the rows of what is free and the columns of what moves; the
audit's energy is that of what is free, and books the work of this force with that of the loads. A motion that jumps, or
has a kink where mass moves with the support, is refused: it would need an impulse. (At t = 0 it is warned of: the initial
state is the one just after.) Displacements are absolute;
`[base_motion]` is the same for all supports at once, seen from them.)"},
    {"springs[]", "## `[[springs]]`",
     R"(```toml
[[springs]]
node = "B"
against = "D"               # the ground without it
direction = [1.0, 0.0]
stiffness = 200.0
damping = 1.5

[[springs]]
node = "B"
rotation_stiffness = 350.0  # a soft footing

[[springs]]                 # a spring hanger: 12 in operation, where the pipe has risen by 0.02; 14 when cold
node = "B"
direction = [0.0, -1.0]     # away from where it hangs
hanger = { hot = 12.0, cold = 14.0, travel = 0.02 }

[[springs]]                 # a constant hanger: no stiffness
node = "D"
direction = [0.0, -1.0]
preload = 12.0

[[springs]]                 # a snubber: it acts against motions alone
node = "D"
direction = [1.0, 0.0]
damping = 40.0
```

The force in a spring is preload + stiffness d + damping d', d: the motion of its node along `direction` less that of the
other end. It pulls the node against `direction`. A preload is a static load, called "preload of spring 2", "preload" in
stages; its work counts with that of the loads. `check` and `model.hangers` in summary.json say what springs with a
preload bear at t = 0, and how far off that is; more than 25 % in equilibrium is warned of. A snubber is linear here: a
damper, which statics do not see.)"},
    {"springs[].hanger", "### `springs.hanger`", ""},
    {"matrices", "## `[matrices]`",
     R"(Whatever another program assembled, instead of gravity, nodes, members, masses, springs, supports and damping.
A matrix is a file in the Matrix Market format (`coordinate` or `array`, `real` or `integer`, `general` or
`symmetric`), found beside the scene, or rows of numbers:

```toml
schema = 1
units = { force = "N", mass = "kg", length = "m", time = "s" }

[run]
t_end = 10.0
initial = { u = [0.0, 0.01], v = [0.0, 0.0] }

[matrices]
dofs = ["d0", "d1"]
mass = [[1.0, 0.0], [0.0, 1.0]]             # or mass = "M.mtx"
stiffness = [[200.0, -100.0], [-100.0, 100.0]]

[[contacts]]
name = "stop"
law = "compliant"
normal = { d1 = -1.0 }                      # gap = 0.02 - u1
gap = 0.02
normal_stiffness = 1e5
```

A degree of freedom whose row of the mass matrix is zero is massless.)"},
    {"contacts[]", "## `[[contacts]]`",
     R"(```toml
[[contacts]]
name = "first"
node = "A"
law = "compliant"
normal = [0.0, 1.0]
normal_stiffness = 1e6
tangential_stiffness = 1e6
friction = 0.3
```

The gap is `gap + n . u`: positive is open, and the contact pushes its node along n. For a floor n is [0, 1]. The
tangent is t = (ny, -nx), [1, 0] for a floor; tangential motion is `t . u` less the motion of the surface.

- `compliant`: N = kn g while closed, T = kt (ut - p) while it sticks, T = -f N along the slip while it slips;
  p, the anchor, moves with slip. States: `open`, `stick`, `slip+`, `slip-`; `open` and `closed` without friction.
- `rigid`: g >= 0 exactly. A contact that closes with g' < 0 is hit: all rigid contacts that touch share the
  impact, with `restitution` along n and Coulomb's law for the impulse along t. Rebounds slower than `capture_velocity`
  rest, so bouncing ends. Stick and slip as above, without springs.
- `slider`: the compression is given, `normal_force`, and there is no gap. Without `tangential_stiffness` it is
  rigid in stick; several on one motion and on ground that stands, as two on one rigid body, share its force by the least
  sum of squares within their limits. While `normal_force` is 0 over an interval it is `open`. With `[nodes]` a normal may stand for the
  tangent that belongs to it.

A dashpot acts beside its spring: N = kn g + cn g' while closed, T = kt (ut - p) + ct ut' in stick. The contact
opens at N = 0, so it never pulls.

N <= 0 is compression. How stiff is stiff enough? `signorini check` compares each contact with the structure, and
validation/contact-stiffness shows what follows from it. Where the surfaces are joined by a layer of some material,
that layer says how stiff:

```toml
[[contacts]]
name = "bedding"
node = "A"
law = "compliant"
normal = [0.0, 1.0]
friction = 0.4
seam = { E = 2.0e5, G = 8.0e4, thickness = 0.05, area = 0.3 }   # kn = E area / thickness, kt = G area / thickness
```

A contact joins its node to the ground, or to what is named by `against`: the gap is then that between the two, and n
points from the touched body to the node.

```toml
[[contacts]]
name = "landing"
node = "ball"
against = ["B", "C"]            # a point on the segment; one name: node to node
law = "rigid"
normal = [0.0, 1.0]
gap = 0.2
restitution = 0.5
friction = 0.3
```)"},
    {"contacts[].friction", "### `contacts.friction`",
     R"(```toml
[[contacts]]
name = "belt"
node = "block"
law = "slider"
tangent = [1.0, 0.0]
normal_force = { type = "harmonic", offset = 10.0, amplitude = 4.0, omega = 3.0 }
friction = { static = 0.4, kinetic = 0.3 }
surface_velocity = 0.2
```

Sliding bearings of PTFE rub more the faster they slide; `fast` is then what a slider's data sheet calls mu_max, 1 / velocity its rate
parameter:

```toml
[[contacts]]
name = "bearing"
node = "slab"
law = "slider"
tangent = [1.0, 0.0]
normal_force = 800.0
tangential_stiffness = 4e4      # before it slides; without it it sticks rigidly
friction = { slow = 0.04, fast = 0.10, velocity = 0.02 }
```)"},
    {"stops[]", "## `[[stops]]`",
     R"(A guide or a line stop: contacts on both sides of a node. All other keys are those of a contact with a gap, for either
side. With [matrices] a stop has no friction.

```toml
[[stops]]
name = "line-stop"
node = "P40"
law = "compliant"
direction = [1.0, 0.0]
gap = 0.01
normal_stiffness = 1e5
```)"},
    {"pendulums[]", "## `[[pendulums]]`",
     R"(A friction pendulum: a contact NAME that rubs, a spring N / radius that brings it back, and with `stop` a rim on either side,
contacts NAME+ and NAME-. Rotations are small, so that the restoring force is N u / radius. `normal_force` is what the bearing
carries. Where it is a number every engine takes the scene. Where it is a history, or follows from the structure by
`normal_stiffness`, the restoring force goes with it, which `ida` knows and the others refuse; the bearing may then lift off.
A static or frictional start is in equilibrium with the restoring force of what each bearing carries there. A reaction of supports that
bear a restoring force which varies is refused.

```toml
[[pendulums]]
name = "west"
node = "slab"
radius = 2.2
normal_force = 800.0
friction = { slow = 0.04, fast = 0.10, velocity = 0.02 }
tangential_stiffness = 4e4
stop = 0.35
stop_stiffness = 2e4
```

friction, tangential_stiffness, tangential_damping and initial_shear are those of [contacts](#contacts), and so is normal_damping,
beside normal_stiffness.)"},
    {"base_motion", "## `[base_motion]`",
     R"(The ground shakes: displacements and velocities are then relative to it, and the load is -M r a(t), with r the
direction on all translations, fixed ones included.

```toml
[base_motion]
direction = [1.0, 0.0]
acceleration = { type = "table", times = [0.0, 0.1, 0.2], values = [0.0, 3.0, 0.0] }
```

Along several directions at once: tables under `[[base_motion]]`. An acceleration may be given in g, and as a record of
PEER, whose heading names its unit, G, CM/S/S, M/S/S, MM/S/S or GAL; its step is in seconds whatever
the scene's unit of time; velocities and displacements are refused:

```toml
[[base_motion]]
direction = [1.0, 0.0]
acceleration = { type = "table", file = "RSN1111_000.AT2" }

[[base_motion]]
direction = [0.0, 1.0]
acceleration = { type = "table", file = "up.txt", time_step = 0.005, unit = "g", amplitude = 0.7 }
```)"},
    {"loads[]", "## `[[loads]]`",
     R"(A force amplitude * f(t) along a direction, a moment, or a force per length of members, with the end forces and moments
that a beam under it would have if it were clamped. Several may act on one node.

```toml
[[loads]]
node = "B"
direction = [0.7071067811865476, 0.7071067811865476]
amplitude = 100.0
history = { type = "rectangle", start = 0.0, end = 0.1 }

[[loads]]
node = "B"
moment = 12.0

[[loads]]
name = "snow"
nodes = ["B", "D"]
direction = [0.0, -1.0]
distributed = 3.5
```)"},
    {"output[]", "## `[[output]]`",
     R"(What the run is computed for: each output is a column of `response.csv`, with its greatest and least value over
the whole motion, not only over rows, in `summary.json` and in what `run` prints. Signs: [output.md](output.md#response-quantities).

```toml
[[output]]
name = "M_foot"              # bending moment where the column A-B stands on A
kind = "member_force"
at = ["A", "B"]
quantity = "M"
station = 0.0

[[output]]
name = "a_roof"              # absolute: what the ground does is added
kind = "acceleration"
at = "C"
direction = [1.0, 0.0]

[[output]]
name = "thrust"
kind = "reaction"
at = "A"
direction = [1.0, 0.0]

[[output]]
name = "drift"
kind = "relative"            # u of C less u of B
at = ["C", "B"]
direction = [1.0, 0.0]

[[output]]
name = "slip"
kind = "contact"
at = "first"
quantity = "slip"

[[output]]
name = "half_thrust"
kind = "combination"
terms = { thrust = 0.5 }

[[output]]
name = "stress_foot"         # both fibres: N/A - M/W and N/A + M/W
kind = "stress"
at = ["A", "B"]
station = 0.0

[[output]]
name = "M_column"            # greatest |M| anywhere between A and B
kind = "envelope"
nodes = ["A", "B"]
quantity = "M"

[[output]]
name = "sigma"               # factors with units: kN/m^2
kind = "combination"
terms = { M_foot = { factor = 820.0, unit = "1/m^3" }, thrust = { factor = 95.0, unit = "1/m^2" } }
```

| kind | what it is |
|---|---|
| `displacement`, `velocity` | of the node `at` along `direction`, relative to the base as in history.csv; or its `rotation` |
| `acceleration` | the same, absolute: that of the base is added |
| `relative` | displacement of the first node of `at` less that of the second |
| `member_force` | `quantity` N, V or M of the piece of a member between the two nodes of `at`, at `station` |
| `stress` | N / area and M / modulus there, positive where they stretch: at the `fibre` to the left or right of the course, or of `both` the greatest magnitude |
| `envelope` | greatest magnitude of `quantity` N, V, M or stress along all pieces from node to node of `nodes` |
| `reaction` | force of the supports of the node `at` on the structure along `direction`, or their moment (`rotation`) |
| `spring` | force in the spring of that number, its preload and the damper beside it included, or their moment (`rotation`) |
| `contact` | `quantity` N, T, gap, slip (as in contacts.csv) or loss (work of its friction since the start) of the contact `at` |
| `combination` | sum of other outputs, `terms` = their factors, which may have units |

With `[matrices]` there are displacements, velocities and accelerations along a `direction` of degrees of freedom, contacts
and combinations.)"},
    {"history", "## Histories",
     R"(The course of a load, a temperature, the motion of a support, of `normal_force` or of `surface_velocity` in time.

| type | f(t) | needs |
|---|---|---|
| `constant` | 1; without a start it has held since ever | |
| `step` | 1 from start on | |
| `rectangle` | 1 from start to end | end |
| `triangle` | up from 0 to 1 in the middle, and down | end |
| `half_sine` | sin(pi (t - start) / duration), duration = end - start | duration or end |
| `harmonic` | sin(omega (t - start) + phase) | omega or frequency |
| `polynomial` | c0 + c1 (t - start) + c2 (t - start)^2 + ... | coefficients |
| `table` | through the points | times and values, or file |

f is zero before start and from end on, a table outside its times (after them with `hold` as it last was); it has neither
start nor end. `period` begins the shape anew every so long, `shift` moves all of it. At a jump f
already has its new value. Where it jumps or has a kink the integration stops and restarts, so that no pulse is
stepped over, however short: times of several histories that differ by rounding, as 0.1 + 0.2 and 0.3 do, are one instant.
Only a pulse shorter than a double tells times apart (2e-14 of the run) has no effect, and is warned of.

```toml
history = { type = "harmonic", frequency = 2.0, start = 0.5, end = 4.5 }
```

```toml
history = { type = "table", times = [0.0, 0.1, 0.1, 0.3], values = [0.0, 1.0, 0.5, 0.0] }
```

```toml
history = { type = "rectangle", start = 0.0, end = 0.2, period = 1.0, shift = 0.5 }     # once a second
```)"},
};

}  // namespace

std::span<const TableText> table_texts() { return texts; }

}  // namespace signorini::cli
