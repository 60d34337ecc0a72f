// apart.hpp: parts of a model that nothing couples run apart, each on its own clock.
//
//   for s = s_1 < s_2 < ... t_end:   every part to s;   what all of them have reached is passed on, merged
//
// From stage to stage no more than t_end / 32, and less where many events would wait. Where a stage ends changes nothing.
// A part's steps and events ask for what is its own only: n parts that are alike take n times as long as one, where together
// each event of one would cost a sweep over all. What decides (scales, velocities below which rebounds rest) is of
// the whole. Where a part stops, the others end at that time, too. Whoever follows a run from inside, steers it, or keeps
// both sides of its instants sees one motion: then parts run together (parts_to_run).
#pragma once

#include "model/assembly/part_models.hpp"
#include "run/loop.hpp"

namespace signorini {

/// In the units of `whole`, whose parts these are. spec.engine is not automatic.
[[nodiscard]] RunEnd run_apart(const Model& whole, std::vector<PartModel> parts, const RunSpec& spec,
                               const EngineRow& engine, Method method, Recorder& recorder);

/// Its parts, if a run in this way is made of them; empty: it is made of the whole.
[[nodiscard]] std::vector<PartModel> parts_to_run(const Model& model, const Method& method,
                                                  const Recorder& recorder, const RunHooks& hooks);

}  // namespace signorini
