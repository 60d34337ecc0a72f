// independent_parts.hpp: uncoupled parts of a model run separately, each with its own time steps.
//
//   for s = s_1 < s_2 < ... t_end:   every part to s;   rows up to the time reached by all are merged and passed on
//
// A stage is t_end / 32 at most, and shorter if many events would wait. The ends of stages do not influence
// results. The steps and events of a part need the data of this part only, so n equal parts take n times as
// long as one. In a common run each event of one part would need a pass over all parts. Data for decisions
// (scales, velocities below which rebounds come to rest) are those of the whole model. If a part stops, the
// others end at the same time. Listeners, steering, and records of both sides of instants need one motion of
// the whole model: parts then run together (parts_to_run).
#pragma once

#include "model/assembly/parts.hpp"
#include "run/loop.hpp"

namespace signorini::run {

// Joins the results of parts that ran separately into one report.
//
//   works, energies, counters, scales of energy:   sums over parts
//   extremes:                                      the largest of any part; error of the balance: the sum of the parts'
//                                                  largest errors, an upper bound at any instant
//
// All values are in the units of the whole model.

/// Adds the results of the parts to `report`, which has outcome, method, events and load jumps of the whole model
/// already. Returns the sum of RunEnd::energy_rounding.
double merge_results(const Model& whole, const std::vector<assembly::PartModel>& parts,
                     const std::vector<RunEnd>& endings, Report& report);

/// Runs the parts of `whole`, in the units of `whole`. spec.engine must not be automatic.
[[nodiscard]] RunEnd run_independent_parts(const Model& whole, std::vector<assembly::PartModel> parts,
                                           const RunSpec& spec, const EngineRow& engine, Method method,
                                           Recorder& recorder);

/// Parts of the model if it is to be run in parts; empty: it is run as a whole.
[[nodiscard]] std::vector<assembly::PartModel> parts_to_run(const Model& model, const Method& method,
                                                            const Recorder& recorder, const RunHooks& hooks);

}  // namespace signorini::run
