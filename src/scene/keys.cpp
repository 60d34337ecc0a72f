#include "scene/keys.hpp"

#include <algorithm>
#include <array>
#include <deque>
#include <iterator>
#include <unordered_map>

#include "contact/law/data_laws.hpp"
#include "signorini/engine.hpp"

namespace signorini::scene {

namespace {

using enum KeyType;

/// Marks a key whose choices are "auto" and the names of the engines (signorini/engine.hpp).
constexpr std::string_view engines_and_auto = "engines";
/// Names of the built-in laws; a scene may also name the laws made of data (contact/law/data_laws.hpp).
constexpr std::string_view built_in_laws = "compliant rigid slider";

// clang-format off
constexpr Key table_of_keys[] = {
    {"", "schema", integer, "", "required", "", "Version of the scene format: 1; the first key of the file."},
    {"", "title", text, "", "\"\"", "", "Title of the scene, shown in results and pictures."},
    {"", "units", table, "", "required", "", "Names of the units of all numbers in the file."},
    {"", "gravity", vector, "length/time^2", "[0.0, 0.0]", "", "Acceleration of gravity; acts on every mass."},
    {"", "run", table, "", "required", "", "Duration, accuracy and output times of the computation."},
    {"", "damping", table, "", "", "", "Damping of the structure: C = alpha M + beta K, K without contact springs."},
    {"", "sections", table, "", "", "", "Cross-sections of members, by name."},
    {"", "nodes", table, "", "", "", "Points of the structure, by name; their order is the order of the degrees of freedom."},
    {"", "lines", tables, "", "", "", "Nodes in a row, at equal distances."},
    {"", "members", tables, "", "", "", "Chains of straight beams between nodes."},
    {"", "bodies", tables, "", "", "", "Plane continua, meshed by the program (rectangles and rings) or by Gmsh."},
    {"", "surfaces", tables, "", "", "", "With [matrices]: boundaries for seams, given by the positions and degrees of freedom of their nodes."},
    {"", "seams", tables, "", "", "", "Contacts along the boundary of a body with another boundary, the ground or a line, by dual mortar."},
    {"", "masses", tables, "", "", "", "Point masses."},
    {"", "rigid", tables, "", "", "", "Rigid bodies: nodes tied to a centre that carries the mass and inertia of the body."},
    {"", "supports", tables, "", "", "", "Degrees of freedom that are fixed or follow a given motion."},
    {"", "springs", tables, "", "", "", "Springs and dampers, to the ground or between two nodes."},
    {"", "reduction", table, "", "", "", "Model reduction: modes up to a cutoff are kept; those above it contribute only their static compliance. Without this table all modes are kept."},
    {"", "matrices", table, "", "", "", "Mass, damping and stiffness matrices, instead of nodes and members."},
    {"", "contacts", tables, "", "", "", "Unilateral or frictional contacts."},
    {"", "stops", tables, "", "", "", "Contacts on both sides of a node: guides and line stops."},
    {"", "pendulums", tables, "", "", "", "Bearings that slide on a curved surface: friction pendulums."},
    {"", "loads", tables, "", "", "", "Loads that vary with time."},
    {"", "base_motion", one_or_many, "", "", "", "Ground acceleration; displacements and velocities are then relative to the base."},
    {"", "output", tables, "", "", "", "Response quantities: columns of response.csv."},

    {"units", "force", choice, "", "required", "N kN MN", "Unit of force; must be mass * length / time^2."},
    {"units", "mass", choice, "", "required", "kg t", "Unit of mass."},
    {"units", "length", choice, "", "required", "m mm", "Unit of length."},
    {"units", "time", choice, "", "required", "s ms", "Unit of time."},

    {"run", "t_end", positive, "time", "required", "", "End time of the computation, which starts at t = 0."},
    {"run", "initial", KeyType::initial, "", "{}", "", "Initial state: \"static\"; \"frictional\"; the state of another run, { run = \"DIR\", t = ... }; or displacements and velocities, by node or (with [matrices]) as lists u and v. Values not given are zero."},
    {"run", "stages", tables, "", "", "", "For initial = \"frictional\": order in which the static loads are applied. Default: all at once."},
    {"run", "engine", choice, "", "\"ida\"", engines_and_auto, "Method of time integration; auto: exact where the laws are linear and no decay rate is above 0.2 times the highest circular frequency, else ida."},
    {"run", "geometric", flag, "", "false", "", "P-delta: geometric stiffness from the static axial forces of members and the static forces on rigid bodies. These forces are computed once without it and then kept constant."},
    {"run", "rtol", relative_tolerance, "", "1e-8", "", "Relative tolerance of the integration."},
    {"run", "atol", table, "", "", "", "Absolute tolerances. Default of each: rtol times a scale of the scene."},
    {"run", "output_dt", positive, "time", "", "", "Time interval between rows of history.csv; t_end / 1000 unless output_times is given."},
    {"run", "output_times", numbers, "time", "", "", "Times of the rows of history.csv, ascending, instead of output_dt; t_end is added."},
    {"run", "frames", numbers, "time", "", "", "Times of deformed shapes, from 0 to t_end, ascending; not with [matrices]."},
    {"run", "max_order", tolerance_order, "", "\"auto\"", "", "Greatest order of IDA's formulas, 1 to 5, or \"auto\"."},
    {"run", "max_events_at_once", count, "", "100", "", "Largest number of rounds of state changes at one instant; the run stops if this number is exceeded. Independent parts of the structure (theory.md) are counted separately."},
    {"run", "dt", positive, "time", "", "", "Time step of the engines `newmark` and `friction-iteration`; required for them. With step = \"doubling\": the largest time step."},
    {"run", "refine", choice, "", "\"root\"", "root linear", "How engine newmark locates an event. \"root\": the step is repeated with another length until the condition of the event is met at its end. \"linear\": the step is repeated once, up to the interpolated time (contacts without stiffness use \"root\")."},
    {"run", "step", choice, "", "\"fixed\"", "fixed doubling", "Engine newmark: \"fixed\": every step is dt. \"doubling\": every second step is compared with one step of twice the length; the step is halved while the results differ by more than the tolerance."},
    {"run", "flow", choice, "", "\"auto\"", "auto modal taylor", "Engine exact: form of the motion between events. \"taylor\": power series. \"modal\": mode shapes of each contact state; the cost depends on the motion, not on the mesh, but not every scene can be computed with it. \"auto\" chooses one of three. Real modes: from 16 degrees of freedom on, if the modes are uncoupled (mass-proportional damping only, compliant contacts, piecewise constant loads). Complex modes: from 40 degrees of freedom on, without rigid contacts, with about six contacts at most, if they are faster. Otherwise: taylor."},
    {"run", "certify", automatic_flag, "", "\"auto\"", "", "Start a companion run that gives error bounds of event times and the certified part of the sequence. auto: only if its expected cost is below half the cost of the run, and not if the run turns out to be the quicker one and the companion would take more than half a second."},
    {"run", "companion", choice, "", "\"auto\"", "auto exact finer", "Engine of the companion run. \"exact\", or \"finer\": the run's own engine with a finer setting (ida: rtol / 100; engines with dt: dt / 2, and nothing is certified where dt does not resolve the fastest motion; exact: two runs with every input changed by about one rounding error). auto: the cheaper one; for engines with dt: exact, or ida where exact does not accept the scene."},
    {"run", "relaxation", positive, "", "1.0", "", "Engine friction-iteration: relaxation factor, at most 1: the fraction of the computed change of the friction limit that one iteration applies."},
    {"run", "max_iterations", count, "", "100", "", "Engine friction-iteration: iterations of a step before the run stops."},

    {"run.atol", "displacement", positive, "length", "", "", "Absolute tolerance of displacements. Default: rtol times the scale of displacements."},
    {"run.atol", "velocity", positive, "length/time", "", "", "Absolute tolerance of velocities. Default: rtol times the scale of velocities."},
    {"run.atol", "force", positive, "force", "", "", "Absolute tolerance of contact forces. Default: rtol times the scale of forces."},

    {"run.initial", "u", numbers_or_file, "", "", "", "With [matrices]: initial displacement of each degree of freedom."},
    {"run.initial", "v", numbers_or_file, "", "", "", "With [matrices]: initial velocity of each degree of freedom."},
    {"run.initial", "run", text, "", "", "", "Directory of the run to continue from; relative to the folder of the scene."},
    {"run.initial", "t", number, "time", "", "", "With `run`: time of the state in the states.csv of that run. Default: the last saved time."},
    {"run.initial", "*", table, "", "", "", "Initial state of the node of this name."},
    {"run.initial.*", "ux", number, "length", "", "", "Initial horizontal displacement."},
    {"run.initial.*", "uy", number, "length", "", "", "Initial vertical displacement."},
    {"run.initial.*", "rz", number, "", "", "", "Initial rotation, counter-clockwise, in rad."},
    {"run.initial.*", "vx", number, "length/time", "", "", "Initial horizontal velocity."},
    {"run.initial.*", "vy", number, "length/time", "", "", "Initial vertical velocity."},
    {"run.initial.*", "wz", number, "1/time", "", "", "Initial angular velocity, counter-clockwise."},

    {"run.stages[]", "name", name, "", "required", "", "Name of the stage."},
    {"run.stages[]", "loads", texts, "", "required", "", "Loads that grow from zero to their value at t = 0: \"gravity\", names of loads, \"load 1\", ..., \"temperature\" and \"initial strain\" (of all members), \"preload\" (of all springs), \"supports\" (motions of all supports), \"base motion\"."},
    {"run.stages[]", "steps", count, "", "1", "", "Number of equal load steps, at most 10000. summary.json has the state of the contacts after each step."},

    {"reduction", "cutoff_frequency", positive, "1/time", "", "", "Modes up to this frequency, in cycles per time, are kept; they are the modes of the structure without its contacts. Alternative: cutoff_omega."},
    {"reduction", "cutoff_omega", positive, "1/time", "", "", "Cutoff as a circular frequency in rad per time, instead of cutoff_frequency."},
    {"reduction", "tolerance", positive, "", "", "", "Tolerance instead of a cutoff: the program finds the lowest cutoff that meets it. The neglected inertia then changes displacements of contacts and named nodes by less than this fraction of the greatest displacement."},

    {"damping", "alpha", non_negative, "1/time", "0.0", "", "Factor of the mass matrix."},
    {"damping", "beta", non_negative, "time", "0.0", "", "Factor of the stiffness matrix, without contact springs and the restoring stiffness of pendulums."},
    {"damping", "alpha_over_omega1", non_negative, "", "", "", "alpha as a multiple of omega1, the lowest circular frequency with every initially closed contact stuck; instead of alpha."},
    {"damping", "ratios", numbers, "", "", "", "Damping ratios [z1, z2] at the two `frequencies`, instead of alpha and beta."},
    {"damping", "frequencies", numbers, "1/time", "", "", "The two frequencies [f1, f2] of `ratios`, in cycles per time."},

    {"sections", "*", table, "", "", "", "A cross-section of this name."},
    {"sections.*", "EA", positive, "force", "", "", "Axial stiffness; required unless a shape (pipe, box, i or round) is given."},
    {"sections.*", "EI", positive, "force*length^2", "", "", "Bending stiffness; required for beams, unused by bars."},
    {"sections.*", "mass_per_length", non_negative, "mass/length", "", "", "Mass per length; required unless a shape (pipe, box, i or round) is given."},
    {"sections.*", "area", positive, "length^2", "", "", "Area, for a section without a shape: stresses are N / area."},
    {"sections.*", "modulus", positive, "length^3", "", "", "Section modulus, for a section without a shape: stresses are M / modulus."},
    {"sections.*", "pipe", table, "", "", "", "A round tube, with content and insulation, instead of EA, EI, mass_per_length, area, modulus."},
    {"sections.*", "box", table, "", "", "", "A rectangular section, hollow if `wall` is given; instead of EA, EI, mass_per_length, area and modulus."},
    {"sections.*", "i", table, "", "", "", "Two flanges and a web, instead of EA, EI, mass_per_length, area and modulus."},
    {"sections.*", "round", table, "", "", "", "A round rod, instead of EA, EI, mass_per_length, area and modulus."},

    {"sections.*.pipe", "diameter", positive, "length", "required", "", "Outer diameter."},
    {"sections.*.pipe", "wall", positive, "length", "required", "", "Thickness of the wall."},
    {"sections.*.pipe", "E", positive, "force/length^2", "required", "", "Young's modulus."},
    {"sections.*.pipe", "density", non_negative, "mass/length^3", "required", "", "Density of the wall."},
    {"sections.*.pipe", "content", non_negative, "mass/length^3", "0.0", "", "Density of the content. It adds mass, but no stiffness."},
    {"sections.*.pipe", "insulation", table, "", "", "", "Layer around the pipe. It adds mass, but no stiffness."},
    {"sections.*.pipe.insulation", "thickness", positive, "length", "required", "", "Thickness of the insulation."},
    {"sections.*.pipe.insulation", "density", non_negative, "mass/length^3", "required", "", "Density of the insulation."},

    {"sections.*.box", "width", positive, "length", "required", "", "Extent out of the plane."},
    {"sections.*.box", "height", positive, "length", "required", "", "Extent in the plane, across the member."},
    {"sections.*.box", "wall", positive, "length", "", "", "Thickness of all four walls. Default: a solid section."},
    {"sections.*.box", "E", positive, "force/length^2", "required", "", "Young's modulus."},
    {"sections.*.box", "density", non_negative, "mass/length^3", "required", "", "Density."},

    {"sections.*.i", "width", positive, "length", "required", "", "Width of both flanges."},
    {"sections.*.i", "height", positive, "length", "required", "", "Height over both flanges."},
    {"sections.*.i", "web", positive, "length", "required", "", "Thickness of the web."},
    {"sections.*.i", "flange", positive, "length", "required", "", "Thickness of a flange."},
    {"sections.*.i", "axis", choice, "", "\"strong\"", "strong weak", "\"strong\": the web lies in the plane of the structure; \"weak\": normal to it."},
    {"sections.*.i", "E", positive, "force/length^2", "required", "", "Young's modulus."},
    {"sections.*.i", "density", non_negative, "mass/length^3", "required", "", "Density."},

    {"sections.*.round", "diameter", positive, "length", "required", "", "Diameter."},
    {"sections.*.round", "E", positive, "force/length^2", "required", "", "Young's modulus."},
    {"sections.*.round", "density", non_negative, "mass/length^3", "required", "", "Density."},

    {"nodes", "*", vector, "length", "", "", "Position [x, y] of the node of this name."},

    {"lines[]", "name", name, "", "required", "", "The nodes are called NAME0, NAME1, ..."},
    {"lines[]", "from", vector, "length", "required", "", "Position [x, y] of the first node."},
    {"lines[]", "to", vector, "length", "required", "", "Position [x, y] of the last node."},
    {"lines[]", "pieces", count, "", "required", "", "Number of intervals between the nodes: one less than the number of nodes."},

    {"members[]", "nodes", texts, "", "required", "", "Names of two or more nodes; a straight piece joins each to the next. \"P0..P9\" means P0, P1, ..., P9; \"P0..P9:3\" means P0, P3, P6, P9."},
    {"members[]", "section", name, "", "required", "", "Name of the section."},
    {"members[]", "elements", KeyType::elements, "", "1", "", "Number of finite elements of each piece; one number applies to every piece. Default for arcs: 8."},
    {"members[]", "type", choice, "", "\"beam\"", "beam bar", "\"beam\": Euler-Bernoulli beam; \"bar\": truss member with EA and mass only, hinged at its ends, one element a piece."},
    {"members[]", "mass", choice, "", "\"consistent\"", "consistent lumped", "Mass matrix; \"lumped\" makes rotations massless."},
    {"members[]", "release", texts, "", "[]", "", "End nodes at which a beam is hinged: the first node of the beam, the last node, or both. The beam end then rotates independently of the node."},
    {"members[]", "thermal_expansion", number, "1/temperature", "0.0", "", "Coefficient of thermal expansion: strain per unit of temperature; any unit of temperature may be used."},
    {"members[]", "temperature", number_or_history, "temperature", "0.0", "", "Temperature above that of the undeformed state, uniform in the member; a number or a history."},
    {"members[]", "initial_strain", number_or_history, "", "0.0", "", "Stress-free axial strain; positive if the member is too long; a number or a history."},

    {"members[]", "bend", table, "", "", "", "The pieces are circular arcs of at most half a turn; the elements are chords."},

    {"members[].bend", "radius", number, "length", "required", "", "Radius of the middle line: > 0 if the line from node to node curves to the left, < 0 if it curves to the right."},
    {"members[].bend", "flexibility", positive, "", "", "", "Flexibility factor: EI is divided by it. Default: for a pipe max(1, 1.65 / h) with h = (wall thickness x bend radius) / r^2 and r the mean radius of the wall; otherwise 1."},
    {"members[].bend", "sif", positive, "", "", "", "Stress intensification factor: bending stresses are multiplied by it. Default: for a pipe max(1, 0.9 / h^(2/3)), with h as in flexibility; otherwise 1."},

    {"bodies[]", "name", name, "", "required", "", "Name of the body. Its nodes are called NAME.NUMBER, with the numbers of the Gmsh file; in a rectangle or ring the numbers are 1, 2, ... row by row."},
    {"bodies[]", "mesh", text, "", "", "", "Gmsh file in the folder of the scene, .msh 4.1 or 2.2 in ASCII. Alternatives: rectangle, ring."},
    {"bodies[]", "surfaces", texts, "", "[]", "", "mesh: physical surfaces that form the body. Default: all elements."},
    {"bodies[]", "groups", texts, "", "[]", "", "mesh: names of physical curves and points that the file must contain. All other groups of the file are read as well."},
    {"bodies[]", "rectangle", table, "", "", "", "A rectangle, instead of mesh; its groups are bottom, right, top, left."},
    {"bodies[]", "ring", table, "", "", "", "A sector of a ring, instead of mesh; its groups are inner, outer, start and end. A whole ring has the groups inner and outer only."},
    {"bodies[]", "elements", numbers, "", "", "", "rectangle: elements [along its width, along its height]; ring: [from inside to outside, around]. Required without mesh."},
    {"bodies[]", "shape", choice, "", "\"q4\"", "t3 t6 q4 q8", "rectangle, ring: triangles with 3 or 6 nodes, quadrilaterals with 4 (with incompatible modes) or 8."},
    {"bodies[]", "grading", vector, "", "[1.0, 1.0]", "", "rectangle, ring: ratio of the last element length to the first, for each of the two directions of `elements`."},
    {"bodies[]", "points", table, "", "", "", "Names for nodes of the mesh at given positions; these nodes get columns in history.csv."},
    {"bodies[]", "E", positive, "force/length^2", "required", "", "Young's modulus."},
    {"bodies[]", "nu", number, "", "required", "", "Poisson's ratio, from 0 to below 0.5."},
    {"bodies[]", "density", positive, "mass/length^3", "required", "", "Density."},
    {"bodies[]", "thickness", positive, "length", "1.0", "", "Extent out of the plane."},
    {"bodies[]", "plane", choice, "", "required", "stress strain", "Plane stress or plane strain."},
    {"bodies[]", "mass", choice, "", "\"consistent\"", "consistent lumped", "Mass matrix."},
    {"bodies[]", "thermal_expansion", number, "1/temperature", "0.0", "", "Coefficient of thermal expansion: strain per unit of temperature; any unit of temperature may be used."},
    {"bodies[]", "temperature", number_or_history, "temperature", "0.0", "", "Temperature above that of the undeformed state, uniform in the body; a number or a history."},

    {"bodies[].rectangle", "from", vector, "length", "[0.0, 0.0]", "", "Position [x, y] of the lower left corner."},
    {"bodies[].rectangle", "size", vector, "length", "required", "", "Width and height, both > 0."},
    {"bodies[].rectangle", "degrees", number, "", "0.0", "", "Rotation of the rectangle about its lower left corner, counter-clockwise, in degrees."},

    {"bodies[].ring", "centre", vector, "length", "[0.0, 0.0]", "", "Position [x, y] of the centre."},
    {"bodies[].ring", "inner", positive, "length", "required", "", "Inner radius."},
    {"bodies[].ring", "outer", positive, "length", "required", "", "Outer radius."},
    {"bodies[].ring", "degrees", vector, "", "[0.0, 360.0]", "", "Angles [start, end] in degrees, counter-clockwise from x; a difference of 360 gives a whole ring."},

    {"bodies[].points", "*", vector, "length", "", "", "Position [x, y] of an existing node of the mesh; the node gets this name."},

    {"surfaces[]", "name", name, "", "required", "", "Name of the boundary, for slave and master of seams."},
    {"surfaces[]", "x", numbers, "length", "required", "", "Coordinates x of the nodes of the boundary, in order along the boundary with the body on the left."},
    {"surfaces[]", "y", numbers, "length", "required", "", "Coordinates y of the nodes of the boundary."},
    {"surfaces[]", "ux", texts, "", "required", "", "Degree of freedom of each node along x; \"\" for a node that is fixed along x."},
    {"surfaces[]", "uy", texts, "", "required", "", "Degree of freedom of each node along y; \"\" for a node that is fixed along y."},
    {"surfaces[]", "quadratic", flag, "", "false", "", "The nodes are end, middle, end, ... of edges with three nodes."},
    {"surfaces[]", "closed", flag, "", "false", "", "The boundary is closed: the first node follows the last."},
    {"surfaces[]", "thickness", positive, "length", "1.0", "", "Extent out of the plane."},

    {"seams[]", "name", name, "", "required", "", "Name of the seam; its contacts are NAME.1, NAME.2, ... along the slave boundary."},
    {"seams[]", "slave", text, "", "required", "", "Boundary \"BODY.GROUP\", or surface with [matrices], whose nodes become the contacts; usually the side with the finer mesh."},
    {"seams[]", "master", text, "", "", "", "Boundary \"BODY.GROUP\", or surface with [matrices], that the slave touches, or \"ground\": a fixed surface in the position of the undeformed slave boundary. Alternative: line."},
    {"seams[]", "line", table, "", "", "", "A fixed straight line that the slave touches, instead of master."},
    {"seams[]", "law", choice, "", "required", "compliant rigid tied", "Same values as in [[contacts]]; \"tied\": the slave boundary follows the master, without contacts."},
    {"seams[]", "normal_stiffness", positive, "force/length^3", "", "", "compliant: stiffness per unit area. Alternative: layer."},
    {"seams[]", "tangential_stiffness", positive, "force/length^3", "", "", "compliant, with friction: stiffness along the seam per unit area. Alternative: layer."},
    {"seams[]", "layer", table, "", "", "", "compliant: material between the surfaces, kn = E / thickness, kt = G / thickness per unit area, instead of normal_stiffness and tangential_stiffness."},
    {"seams[]", "normal_damping", non_negative, "force*time/length^3", "0.0", "", "compliant: dashpot parallel to the normal stiffness, per unit area."},
    {"seams[]", "gap", number, "length", "", "", "Constant initial gap along the seam; negative: interference. Default: computed from the node positions."},
    {"seams[]", "contact_mass", choice, "", "\"consistent\"", "consistent none", "\"none\": nodes of the slave boundary have no mass; their mass is moved to nearby nodes; total mass, centre and inertia are unchanged. This reduces the number of events."},

    {"seams[].line", "point", vector, "length", "required", "", "A point [x, y] of the line."},
    {"seams[].line", "normal", vector, "", "required", "", "Direction in which the body lifts off from the line; it is normalised."},

    {"seams[].layer", "E", positive, "force/length^2", "required", "", "Young's modulus of the layer."},
    {"seams[].layer", "G", positive, "force/length^2", "", "", "Shear modulus of the layer; required with friction."},
    {"seams[].layer", "thickness", positive, "length", "required", "", "Thickness of the layer."},

    {"masses[]", "node", name, "", "required", "", "Node that carries the mass."},
    {"masses[]", "mass", non_negative, "mass", "required", "", "Mass."},
    {"masses[]", "inertia", non_negative, "mass*length^2", "0.0", "", "Moment of inertia about the node."},

    {"rigid[]", "name", name, "", "required", "", "Name of the body, and of its centre if `centre` is a position [x, y]."},
    {"rigid[]", "nodes", texts, "", "required", "", "Nodes that move with the centre, by small rotations: u = u_c + rz x (r - r_c); \"P0..P9\" as in members."},
    {"rigid[]", "centre", KeyType::place, "length", "required", "", "Centre of mass, to which the inertia refers: an existing node, or a position [x, y], which becomes a node with the name of the body."},
    {"rigid[]", "mass", non_negative, "mass", "", "", "Mass at the centre; required without box. 0.0 for a rigid connection without mass."},
    {"rigid[]", "inertia", non_negative, "mass*length^2", "", "", "Moment of inertia about the centre; required without box."},
    {"rigid[]", "box", table, "", "", "", "Mass and inertia of a rectangle about its middle, instead of mass and inertia: mass = density width height thickness, inertia = mass (width^2 + height^2) / 12."},

    {"rigid[].box", "width", positive, "length", "required", "", "Width."},
    {"rigid[].box", "height", positive, "length", "required", "", "Height."},
    {"rigid[].box", "density", positive, "mass/length^3", "required", "", "Density."},
    {"rigid[].box", "thickness", positive, "length", "required", "", "Extent out of the plane."},

    {"supports[]", "node", name, "", "", "", "Node that is supported. Alternative: nodes."},
    {"supports[]", "nodes", texts, "", "", "", "Nodes with the same support; \"P0..P9\" as in members."},
    {"supports[]", "fix", texts, "", "required", "", "Fixed directions: any of \"ux\", \"uy\", \"rz\"."},
    {"supports[]", "motion", number_or_history, "length", "", "", "Prescribed displacement (rz: rotation in rad); a number or a history. `fix` must then have exactly one direction. Default: no motion."},
    {"supports[]", "acceleration", number_or_history, "length/time^2", "", "", "Prescribed acceleration, instead of motion; the support starts at rest and at zero displacement."},

    {"springs[]", "node", name, "", "required", "", "Node at one end."},
    {"springs[]", "against", name, "", "", "", "Node at the other end. Default: the ground."},
    {"springs[]", "direction", vector, "", "", "", "Direction of the spring; its length does not matter. Required, except for a rotational spring."},
    {"springs[]", "stiffness", non_negative, "force/length", "0.0", "", "Stiffness."},
    {"springs[]", "damping", non_negative, "force*time/length", "0.0", "", "Damping constant of a damper parallel to the spring."},
    {"springs[]", "preload", number, "force", "0.0", "", "Force in the spring in the undeformed state. A positive force pulls the node against `direction`."},
    {"springs[]", "hanger", table, "", "", "", "Loads of a spring hanger, instead of preload; the cold load is the preload."},
    {"springs[]", "rotation_stiffness", non_negative, "force*length", "0.0", "", "Stiffness against rotation (rz), moment per rad."},
    {"springs[]", "rotation_damping", non_negative, "force*length*time", "0.0", "", "Damping constant of a damper parallel to the rotational spring."},

    {"springs[].hanger", "hot", positive, "force", "required", "", "Operating load, for which the hanger was chosen."},
    {"springs[].hanger", "cold", positive, "force", "", "", "Load in the undeformed state. Give two of `cold`, `travel` and `stiffness`: cold = hot + stiffness * travel."},
    {"springs[].hanger", "travel", number, "length", "", "", "Displacement of the node opposite to `direction`, from cold to hot; upwards if `direction` points down."},

    {"matrices", "dofs", texts, "", "", "", "Names of the degrees of freedom. Default: d0, d1, ..."},
    {"matrices", "mass", matrix, "", "required", "", "Mass matrix, symmetric."},
    {"matrices", "damping", matrix, "", "", "", "Damping matrix, symmetric. Default: zero."},
    {"matrices", "stiffness", matrix, "", "required", "", "Stiffness matrix, symmetric."},

    {"contacts[]", "name", name, "", "", "", "Name in results and in --set. Default: contact1, contact2, ..."},
    {"contacts[]", "node", name, "", "", "", "Node that touches. With [nodes], either `node` or `nodes` is required."},
    {"contacts[]", "nodes", texts, "", "", "", "Nodes with identical contacts; each gets its own contact NAME-NODE; \"P0..P9\" as in members."},
    {"contacts[]", "against", KeyType::against, "", "", "", "Touched node, instead of the ground; or two nodes [B, C] with a straight segment between them. The contact point on the segment is the projection of the undeformed node; its displacement is interpolated linearly between B and C."},
    {"contacts[]", "law", choice, "", "required", built_in_laws, "\"compliant\": springs that open and slip; \"rigid\": g >= 0 exactly, with impacts; \"slider\": friction under a given compression"},
    {"contacts[]", "normal", direction, "", "", "", "Direction in which the contact opens. With [nodes] it is normalised; with [matrices] it is used as given. The tangent is (ny, -nx)."},
    {"contacts[]", "tangent", direction, "", "", "", "Direction of sliding of a slider; with [matrices] of any contact with friction."},
    {"contacts[]", "gap", number, "length", "0.0", "", "Gap of the undeformed state."},
    {"contacts[]", "normal_stiffness", positive, "force/length", "", "", "Stiffness normal to the contact; required for \"compliant\" without a seam"},
    {"contacts[]", "tangential_stiffness", positive, "force/length", "", "", "Stiffness along the contact; required for \"compliant\" with friction and without a seam; a slider without it is rigid in stick."},
    {"contacts[]", "seam", table, "", "", "", "Material between the surfaces of a compliant contact, from which its stiffnesses follow: kn = E area / thickness, kt = G area / thickness; instead of normal_stiffness and tangential_stiffness."},
    {"contacts[]", "normal_force", number_or_history, "force", "", "", "Compression of a slider, positive; a number or a history."},
    {"contacts[]", "friction", KeyType::friction, "", "0.0", "", "Coefficient of friction, or { static, kinetic }, or { slow, fast, velocity }, or { light, heavy, force }."},
    {"contacts[]", "surface_velocity", number_or_history, "length/time", "0.0", "", "Velocity of the touched surface along the tangent; a number or a history."},
    {"contacts[]", "initial_shear", number, "force", "0.0", "", "Force in the tangential spring at t = 0."},
    {"contacts[]", "restitution", fraction, "", "0.0", "", "Newton's coefficient of restitution of a rigid contact, 0 to 1."},
    {"contacts[]", "capture_velocity", non_negative, "length/time", "", "", "A rigid contact stays closed if it would rebound more slowly than this. Default: rtol times the velocity scale, or run.atol.velocity if given."},
    {"contacts[]", "normal_damping", non_negative, "force*time/length", "0.0", "", "Dashpot parallel to the normal stiffness of a compliant contact, which still opens at N = 0 and never pulls."},
    {"contacts[]", "tangential_damping", non_negative, "force*time/length", "0.0", "", "Dashpot parallel to the tangential stiffness, which must then be given; both are in series with the friction element."},

    {"contacts[].seam", "E", positive, "force/length^2", "required", "", "Young's modulus of the seam."},
    {"contacts[].seam", "G", positive, "force/length^2", "", "", "Shear modulus of the seam; required with friction."},
    {"contacts[].seam", "thickness", positive, "length", "required", "", "Thickness of the seam."},
    {"contacts[].seam", "area", positive, "length^2", "required", "", "Tributary area of the contact: spacing of the nodes times width."},

    {"contacts[].friction", "static", non_negative, "", "", "", "Static coefficient of friction. Give `static`, or `slow`, `fast` and `velocity`, or `light`, `heavy` and `force`."},
    {"contacts[].friction", "kinetic", non_negative, "", "", "", "Coefficient while the contact slips, at most the static one. Default: the static one."},
    {"contacts[].friction", "stribeck_velocity", positive, "length/time", "", "", "Velocity of Stribeck's law while the contact slips, f = kinetic + (static - kinetic) exp(-|slip rate| / stribeck_velocity). Only for contacts without tangential_stiffness, and engine \"ida\"."},
    {"contacts[].friction", "slow", positive, "", "", "", "Coefficient at the onset of slip, for friction that rises with the slip rate: f = fast - (fast - slow) exp(-|slip rate| / velocity). The contact sticks while |T| <= slow |N|; friction does not jump when slip begins. Engine \"ida\" only."},
    {"contacts[].friction", "fast", positive, "", "", "", "Coefficient of fast slip, at least slow."},
    {"contacts[].friction", "velocity", positive, "length/time", "", "", "Slip rate at which f has risen by 63 % of the difference between slow and fast."},
    {"contacts[].friction", "light", positive, "", "", "", "Coefficient under a light load, for friction that depends on the normal force in stick and in slip: f = heavy + (light - heavy) exp(-|N| / force). Only with tangential_stiffness, without dashpots, and with engine \"ida\"."},
    {"contacts[].friction", "heavy", positive, "", "", "", "Coefficient under a heavy load."},
    {"contacts[].friction", "force", positive, "force", "", "", "Normal force at which f has changed by 63 % of the difference between light and heavy."},

    {"stops[]", "name", name, "", "", "", "Name of the stop; its contacts are NAME+ and NAME-. Default: stop1, stop2, ..."},
    {"stops[]", "direction", direction, "", "required", "", "Direction of the stopped motion; NAME+ closes if the node moves along it, NAME- if the node moves against it."},
    {"stops[]", "gap", number, "length", "0.0", "", "Gap of the undeformed state on either side."},
    {"stops[]", "gaps", numbers, "length", "", "", "Two different gaps [of NAME+, of NAME-], instead of gap."},

    {"pendulums[]", "name", name, "", "", "", "Name of the pendulum and of its sliding contact; the contacts of its stops are NAME+ and NAME-. Default: pendulum1, pendulum2, ..."},
    {"pendulums[]", "node", name, "", "required", "", "Node that slides."},
    {"pendulums[]", "against", name, "", "", "", "Node that has the curved surface, instead of the ground."},
    {"pendulums[]", "normal", vector, "", "[0.0, 1.0]", "", "Direction of the force of the surface on the node when u = 0; it is normalised. The tangent is (ny, -nx)."},
    {"pendulums[]", "radius", positive, "length", "required", "", "Radius of the surface: the restoring force is N u / radius."},
    {"pendulums[]", "normal_force", number_or_history, "force", "", "", "Compression, positive; a number or a history (engine \"ida\" where it varies). With normal_stiffness: the load at rest, which a static or frictional start computes."},
    {"pendulums[]", "normal_stiffness", positive, "force/length", "", "", "Vertical stiffness of the bearing: its load then follows from the structure, and it can lift off; engine \"ida\"."},
    {"pendulums[]", "stop", positive, "length", "", "", "Distance to the rim on each side. Default: no rim."},
    {"pendulums[]", "stop_stiffness", positive, "force/length", "", "", "Stiffness of the rim. Default: a rigid rim."},

    {"base_motion", "direction", direction, "", "required", "", "Direction of the ground motion. With [nodes] it is normalised; with [matrices] it is used as given."},
    {"base_motion", "acceleration", number_or_history, "length/time^2", "required", "", "Acceleration of the ground; a number or a history."},

    {"loads[]", "name", name, "", "", "", "Name in results and in stages. Default: \"load 1\", \"load 2\", ..."},
    {"loads[]", "node", name, "", "", "", "Node that is loaded; required with [nodes], except for distributed loads, tractions and pressures."},
    {"loads[]", "direction", direction, "", "", "", "Direction of the force. With [nodes] it is normalised; with [matrices] it is used as given and may be the name of a Matrix Market file with one column. Required, except for a moment or a pressure."},
    {"loads[]", "amplitude", number, "force", "", "", "Factor of the history. Alternatives: moment, distributed, traction, pressure."},
    {"loads[]", "moment", number, "force*length", "", "", "Moment about the node, counter-clockwise, as the factor of the history; instead of amplitude."},
    {"loads[]", "distributed", number, "force/length", "", "", "Force per length on pieces of members, as the factor of the history; instead of amplitude."},
    {"loads[]", "traction", number, "force/length^2", "", "", "Force per area on a boundary, along direction, as the factor of the history; instead of amplitude."},
    {"loads[]", "pressure", number, "force/length^2", "", "", "Pressure on a boundary, positive into the body, as the factor of the history; instead of amplitude."},
    {"loads[]", "group", text, "", "", "", "Traction and pressure: boundary \"BODY.GROUP\" that is loaded."},
    {"loads[]", "nodes", texts, "", "", "", "Distributed load: nodes along members, in order; the pieces between consecutive nodes are loaded; \"P0..P9\" as in members."},
    {"loads[]", "axes", choice, "", "\"global\"", "global member", "For distributed loads: axes of `direction`. \"global\": [x, y]. \"member\": [along the piece, normal to it to the left]."},
    {"loads[]", "history", KeyType::history, "", "{ type = \"constant\" }", "", "Time history of the load."},

    {"output[]", "name", name, "", "required", "", "Name of the column of this output in response.csv."},
    {"output[]", "kind", choice, "", "required", "displacement velocity acceleration relative member_force stress envelope reaction spring contact combination", "Kind of the quantity."},
    {"output[]", "at", KeyType::against, "", "", "", "A node; relative, member_force and stress: two nodes [A, B]; stress of a body: one of its nodes; contact: the name of a contact."},
    {"output[]", "nodes", texts, "", "", "", "envelope: nodes along members, in order; the pieces between consecutive nodes are searched for the greatest value; \"P0..P9\" as in members."},
    {"output[]", "direction", direction, "", "", "", "Direction of the component. With [nodes] it is normalised; with [matrices] it is used as given and `at` is not needed. Stress of a body: axis x of the stress components; default [1, 0]."},
    {"output[]", "rotation", flag, "", "false", "", "Rotation of the node, counter-clockwise, instead of the component along a direction; for reaction and spring: the moment."},
    {"output[]", "quantity", choice, "", "", "N V M T gap slip loss stress xx yy xy", "member_force: N (tension is positive), V or M; stress of a member: N or M for the stress by this force alone; stress of a body: xx, yy (tension is positive) or xy; envelope: N, V, M or stress; contact: N, T, gap, slip or loss (the work of its friction, without the work in impacts)."},
    {"output[]", "station", fraction, "", "0.0", "", "member_force, stress: position from A (0) to B (1); at a node between two finite elements: the value in the element towards B."},
    {"output[]", "fibre", choice, "", "\"both\"", "both left right", "For stresses: the outermost fibre to the left or to the right of the line from node to node, or both. With \"both\" the column has the value of greatest magnitude at each time; maximum and minimum in summary.json are the greatest and the least value of both fibres."},
    {"output[]", "sif", positive, "", "", "", "Stress intensification factor: bending stresses are multiplied by it. Default: the factor of the bend, otherwise 1."},
    {"output[]", "spring", count, "", "", "", "spring: number of the spring, counted from 1 in the order of the file."},
    {"output[]", "terms", table, "", "", "", "combination: factors of outputs that are defined earlier in the file; all products of output and factor must have the same unit."},
    {"output[].terms", "*", KeyType::term, "", "", "", "Factor of the output of this name; if it has a unit, a table with the unit, such as \"1/m^2\"."},
    {"output[].terms.*", "factor", number, "", "required", "", "Factor."},
    {"output[].terms.*", "unit", text, "", "required", "", "Unit of the factor, in the units of the scene: \"1/m^2\", \"m\", \"s^2/t\"."},

    {"history", "type", choice, "", "required", "constant step rectangle triangle half_sine harmonic polynomial table", "Shape of the history; it is zero before start and from end on."},
    {"history", "offset", number, "", "0.0", "", "Constant added to the history at all times; in the units of the scene, or in g if `unit` is given. Not in [[loads]]."},
    {"history", "amplitude", number, "", "1.0", "", "Factor of the shape; not in [[loads]]."},
    {"history", "start", number, "time", "0.0", "", "Start time. Without it a constant history acts from the beginning. Not for tables."},
    {"history", "end", number, "time", "", "", "End time. Default: no end. Required for rectangle and triangle; not allowed for tables."},
    {"history", "duration", positive, "time", "", "", "half_sine: end - start, instead of end."},
    {"history", "omega", positive, "1/time", "", "", "harmonic, sin(omega (t - start) + phase): circular frequency in rad per time."},
    {"history", "frequency", positive, "1/time", "", "", "harmonic: cycles per time, instead of omega."},
    {"history", "phase", number, "", "0.0", "", "harmonic: phase in rad."},
    {"history", "coefficients", numbers, "", "", "", "polynomial: coefficients of the ascending powers of t - start."},
    {"history", "times", numbers, "time", "", "", "table: times, ascending; a repeated time is a jump."},
    {"history", "values", numbers, "", "", "", "table: one value for each time."},
    {"history", "interpolation", choice, "", "\"linear\"", "linear steffen", "table: \"linear\": straight lines between the values; \"steffen\": smooth cubics without overshoot."},
    {"history", "file", text, "", "", "", "table: file in the folder of the scene, instead of times and values: two columns, time and value, or a strong-motion record (PEER, CSMIP, COSMOS), whose header names its unit. An acceleration takes a record of acceleration, a support's motion one of displacement, surface_velocity one of velocity."},
    {"history", "column", count, "", "", "", "file: number of the column with the values, 2 or more, for files of more than two columns. Column 1 has the times."},
    {"history", "time_step", positive, "time", "", "", "file: the file has values only, any number per line, at this time interval; the first value is at t = 0. Not needed for records that state their step (PEER, CSMIP)."},
    {"history", "unit", choice, "", "", "g m/s^2 cm/s^2 mm/s^2 m/s cm/s mm/s m cm mm", "Unit of the values and of the offset: of an acceleration, g = 9.80665 m/s^2 or a length/s^2; of surface_velocity a length/s; of a support's motion a length. Default: the units of the scene. Not needed for records whose header names the unit."},
    {"history", "hold", flag, "", "false", "", "table: after the last time the last value remains, instead of zero; with a period, until the shape repeats."},
    {"history", "period", positive, "time", "", "", "Period with which the shape repeats, from its start (a table: from its first time); not shorter than the shape."},
    {"history", "shift", number, "time", "0.0", "", "Time by which the whole history is delayed; negative: earlier."},
};
// clang-format on

/// True if all rows of each table are consecutive.
constexpr bool rows_of_tables_are_consecutive() {
  for (std::size_t i = 1; i < std::size(table_of_keys); ++i) {
    if (table_of_keys[i].table == table_of_keys[i - 1].table) continue;
    for (std::size_t j = 0; j < i; ++j)
      if (table_of_keys[j].table == table_of_keys[i].table) return false;
  }
  return true;
}
static_assert(rows_of_tables_are_consecutive());

/// The table of keys, extended by the laws made of data: `law` gets their names and meanings, and the keys of their
/// constants follow normal_stiffness.
class Keys {
 public:
  Keys() {
    std::string names(built_in_laws), meanings, needing;
    for (const DataLaw* law : data_laws()) {
      names += " " + std::string(law->name);
      meanings += "; \"" + std::string(law->name) + "\": " + std::string(law->meaning);
      needing += " and for \"" + std::string(law->name) + '"';
    }
    for (Key key : table_of_keys) {
      const bool of_contact = key.table == "contacts[]",
                 stiffness = of_contact && key.name == "normal_stiffness";
      if (key.choices == built_in_laws) {
        key.choices = kept(names);
        key.meaning = kept(std::string(key.meaning) + meanings + ".");
      }
      if (stiffness) key.meaning = kept(std::string(key.meaning) + needing + ".");
      rows_.push_back(key);
      if (!stiffness) continue;
      for (const DataLaw* law : data_laws())
        for (const DataLawConstant& c : law->constants)
          rows_.push_back({"contacts[]", c.key, positive, c.unit, "", "", c.meaning});
    }
  }
  [[nodiscard]] std::span<const Key> rows() const { return rows_; }

 private:
  /// Stores a text at a fixed address, because a Key has only a view of it.
  std::string_view kept(std::string made) { return texts_.emplace_back(std::move(made)); }

  std::deque<std::string> texts_;
  std::vector<Key> rows_;
};

/// The rows of one table; empty for an unknown table.
std::span<const Key> rows_of(std::string_view table) {
  static const std::unordered_map<std::string_view, std::span<const Key>> tables = [] {
    std::unordered_map<std::string_view, std::span<const Key>> all;
    for (const Key& key : all_keys()) {
      std::span<const Key>& rows = all.try_emplace(key.table, &key, 0).first->second;
      rows = {rows.data(), static_cast<std::size_t>(&key - rows.data()) + 1};
    }
    return all;
  }();
  const auto found = tables.find(table);
  return found == tables.end() ? std::span<const Key>() : found->second;
}

}  // namespace

std::span<const Key> all_keys() {
  static const Keys keys;
  return keys.rows();
}

namespace {

constexpr std::string_view pendulums_table = "pendulums[]";
/// Keys that a pendulum shares with contacts.
constexpr std::array<std::string_view, 5> contact_keys_of_pendulums = {
    "friction", "tangential_stiffness", "tangential_damping", "initial_shear", "normal_damping"};
/// Keys that a seam shares with contacts.
constexpr std::array<std::string_view, 4> contact_keys_of_seams = {"friction", "surface_velocity",
                                                                   "restitution", "capture_velocity"};

template <class Names>
bool is_among(const Names& names, std::string_view name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

}  // namespace

const Key* find_key(std::string_view table, std::string_view name) {
  if (table.starts_with(pendulums_table) &&
      (table != pendulums_table || is_among(contact_keys_of_pendulums, name)))
    return find_key("contacts[]" + std::string(table.substr(pendulums_table.size())), name);
  constexpr std::string_view seams = "seams[]";
  if (table == "seams[].friction" || (table == seams && is_among(contact_keys_of_seams, name)))
    return find_key("contacts[]" + std::string(table.substr(seams.size())), name);
  constexpr std::string_view stops = "stops[]";
  if (table.starts_with(stops) && !(table == stops && (name == "normal" || name == "tangent"))) {
    for (const Key& key : all_keys())
      if (key.table == stops && table == stops && key.name == name) return &key;
    return find_key("contacts[]" + std::string(table.substr(stops.size())), name);
  }
  const Key* any = nullptr;
  for (const Key& key : rows_of(table)) {
    if (key.name == name) return &key;
    if (key.name == "*") any = &key;
  }
  return any;
}

std::vector<std::string> key_names(std::string_view table) {
  std::vector<std::string> names;
  for (const Key& key : all_keys()) {
    if (key.table == table && key.name != "*") names.emplace_back(key.name);
  }
  if (table == pendulums_table)
    names.insert(names.end(), contact_keys_of_pendulums.begin(), contact_keys_of_pendulums.end());
  if (table == "seams[]")
    names.insert(names.end(), contact_keys_of_seams.begin(), contact_keys_of_seams.end());
  if (table == "stops[]")
    for (const std::string& name : key_names("contacts[]"))
      if (find_key(table, name) && find_key(table, name)->table != table) names.push_back(name);
  return names;
}

std::vector<std::string> choices_of(const Key& key) {
  std::string choices(key.choices);
  if (key.choices == engines_and_auto) {
    choices = to_string(Engine::automatic);
    for (const EngineInfo& engine : all_engines) choices.append(" ").append(engine.name);
  }
  std::vector<std::string> words;
  for (std::string_view rest = choices; !rest.empty();) {
    const std::string_view word = rest.substr(0, rest.find(' '));
    rest.remove_prefix(std::min(word.size() + 1, rest.size()));
    if (!word.empty()) words.emplace_back(word);
  }
  return words;
}

namespace {

std::string one_of(const std::vector<std::string>& words) {
  std::string list;
  for (const std::string& word : words) list += (list.empty() ? "\"" : ", \"") + word + '"';
  return "one of " + list;
}

std::string heading(const Key& key) {
  return "[[" + (key.table.empty() ? "" : std::string(key.table) + ".") + std::string(key.name) + "]]";
}

}  // namespace

std::string describe_type(const Key& key) {
  switch (key.type) {
    case number:
      return "a number";
    case positive:
      return "a number > 0";
    case non_negative:
      return "a number >= 0";
    case relative_tolerance:
      return "a number >= 1e-14 (roundoff) and < 1";
    case count:
    case integer:
      return key.type == integer ? "an integer" : "an integer >= 1";
    case text:
    case name:
      return key.type == text ? "a string" : "a name";
    case choice:
      return one_of(choices_of(key));
    case vector:
      return "an array of two numbers [x, y]";
    case numbers:
    case texts:
      return key.type == numbers ? "an array of numbers" : "an array of strings";
    case numbers_or_file:
      return "an array of numbers, or the name of a Matrix Market file with one column";
    case table:
      return "a table";
    case tables:
    case one_or_many:
      return (key.type == tables ? "tables under " : "a table, or tables under ") + heading(key);
    case tolerance_order:
      return "\"auto\" or an integer from 1 to 5";
    case automatic_flag:
    case flag:
      return key.type == flag ? "true or false" : "\"auto\", true or false";
    case KeyType::elements:
      return "an integer >= 1, or an array of such integers, one for each piece";
    case KeyType::initial:
      return "\"static\", \"frictional\" or a table";
    case fraction:
      return "a number from 0 to 1";
    case KeyType::place:
      return "the name of a node, or an array of two numbers [x, y]";
    case KeyType::against:
      return "the name of a node, or an array of two names";
    case KeyType::friction:
      return "a number >= 0 or a table such as { static, kinetic }";
    case KeyType::term:
      return "a number or a table { factor, unit }";
    case direction:
      return "an array [x, y], or with [matrices] a table { degree of freedom = number }";
    case KeyType::history:
      return "a table { type = ... }";
    case number_or_history:
      return "a number or a table { type = ... }";
    case matrix:
      break;
  }
  return "the name of a Matrix Market file, or rows of numbers";
}

}  // namespace signorini::scene
