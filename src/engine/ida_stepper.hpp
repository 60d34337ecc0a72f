// ida_stepper.hpp: SUNDIALS IDA on the first-order form.
//
//   0 = u' - v
//   0 = M v' + C v + K u - P(t) + sum_k ( n_k N_k + t_k T_k )
//   0 = rows of each contact's state
//
// y = [u, v, N, T]; degrees of freedom without mass have no v: their row is the second one, with u' as
// velocity (index 1). The segment's rows stay in force past an event; guards are IDA's root functions,
// positive before their event, watched for falls only, and masked (+1) while idle or not armed.
#pragma once

#include <memory>

#include "engine/stepper.hpp"

namespace signorini {

class IdaStepper final : public Stepper {
 public:
  IdaStepper(const Model& model, const Structure& structure, const Settings& settings);
  ~IdaStepper() override;

  void start(const Segment& segment) override;
  [[nodiscard]] Step advance() override;
  void evaluate(double t, Point& point) override;
  [[nodiscard]] double residual() override;

 private:
  struct Memory;
  std::unique_ptr<Memory> m_;
};

}  // namespace signorini
