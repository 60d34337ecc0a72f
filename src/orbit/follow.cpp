// follow(): the branch of the orbit that find_orbit() finds, and branches that leave it.
#include <fmt/format.h>

#include <cmath>
#include <deque>

#include "orbit/branch_walk.hpp"
#include "orbit/reader_at.hpp"

namespace signorini {
namespace {

Orbit first_orbit(const SceneReader& read, const BranchOptions& options, Recorder* recorder) {
  OrbitOptions search = options.orbit;
  if (options.path == over_energy) search.energy = options.from;
  return find_orbit(branch_reader(read, options.path, options.from), search, recorder);
}

}  // namespace

Branch follow(const SceneReader& read, const BranchOptions& options, Recorder* recorder,
              const std::function<void(const BranchPoint&)>& seen) {
  if (!(std::isfinite(options.from) && std::isfinite(options.to)) || options.from == options.to)
    throw UsageError("--over: expected PATH=FROM:TO with two different numbers");
  if (options.path == over_energy && !(options.from > 0.0 && options.to > 0.0))
    throw UsageError("--over energy: expected two energies above 0; without energy nothing moves");
  if (options.path == over_energy && options.orbit.energy)
    throw UsageError("--energy: cannot be combined with --over energy, which sets it");
  const Orbit orbit = options.resumed ? options.resumed->orbit : first_orbit(read, options, recorder);
  if (!orbit.found) {
    Branch none;
    none.end = fmt::format("no orbit found at {} = {:.9g}: {}", options.path, options.from, orbit.reason);
    return none;
  }
  Branch branch;
  if (options.resumed) branch.sequences = options.resumed->sequences;
  BranchWalk main(options, BranchMap(read, options, orbit, recorder), branch, 1, 0, seen);
  main.follow();
  branch.end = main.end();
  branch.complete = main.complete();
  branch.last = main.mark();
  std::deque<Junction> waiting(std::make_move_iterator(main.junctions().begin()),
                               std::make_move_iterator(main.junctions().end()));
  while (!waiting.empty() && !branch.interrupted) {
    const Junction junction = std::move(waiting.front());
    waiting.pop_front();
    const int number = static_cast<int>(branch.sides.size()) + 2;
    BranchWalk walk(options, junction.map, branch, number, junction.generation, seen);
    walk.leave(junction);
    branch.sides.push_back({number, junction.from, junction.kind, junction.map.parameter(junction.at.state.s),
                            walk.end(), walk.complete()});
    for (Junction& next : walk.junctions()) waiting.push_back(std::move(next));
  }
  return branch;
}

}  // namespace signorini
