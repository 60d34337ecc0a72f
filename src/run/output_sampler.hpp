// output_sampler.hpp: rows at requested times: the output times of history.csv and the times of frames.
//
//   for (double t = samples.next(); t < step.end; t = samples.next()) samples.emit(t, state at t)
#pragma once

#include <memory>
#include <utility>
#include <vector>

#include "run/audit.hpp"

namespace signorini::run {

class OutputSampler {
 public:
  /// All arguments must outlive the object. grid: output times shared by several runs; null: the output times of `run`.
  OutputSampler(const Model& model, const RunSpec& run, Auditor& auditor, Recorder& recorder,
                std::shared_ptr<const std::vector<double>> grid = nullptr)
      : model_(model),
        frames_(run.frames),
        auditor_(auditor),
        recorder_(recorder),
        grid_(grid ? std::move(grid) : std::make_shared<const std::vector<double>>(run.grid())) {}

  /// The next output time or frame time; infinity after the last time.
  [[nodiscard]] double next() const;
  /// Records the row at t = next(). ahead: the work done after t, which the auditor has received already.
  void emit(double t, const motion::WorkIntegrals& ahead, const motion::Forcing& forcing,
            const contact::ContactStates& states, const motion::Point& point);
  /// Sample at t; its pointers u and v are valid until the next call. ahead: the work done after t, as in emit().
  [[nodiscard]] Sample sample(double t, const motion::WorkIntegrals& ahead, const motion::Forcing& forcing,
                              const contact::ContactStates& states, const motion::Point& point);

 private:
  const Model& model_;
  const std::vector<double>& frames_;
  Auditor& auditor_;
  Recorder& recorder_;
  std::shared_ptr<const std::vector<double>> grid_;
  std::size_t next_row_ = 0, next_frame_ = 0;
  Vector physical_u_, physical_v_;  // physical u and v, if the model has other unknowns
};

}  // namespace signorini::run
