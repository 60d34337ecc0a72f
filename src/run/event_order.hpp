// event_order.hpp: whether the order of events is known.
//
//   t_2 - t_1 < e_1 + e_2      e: uncertainty of an event's time;   beyond the resolution of the clock: else it is one instant
//
// Seen in the order of the log: each beside the last before it whose guard fell.
#pragma once

#include <string>

#include "signorini/model.hpp"
#include "signorini/result.hpp"

namespace signorini {

class EventOrder {
 public:
  /// Both must outlive it. Warnings go to the report.
  EventOrder(const Model& model, Report& report) : model_(model), report_(report) {}

  /// One whose t_uncertainty is known.
  void event(const Event& event, double resolution);
  void load_jump(double t);
  void warn(const std::string& which);
  void finish();

 private:
  [[nodiscard]] std::string told(const Event& event) const;

  const Model& model_;
  Report& report_;
  Event last_;  // with a contact whose guard fell
  int unordered_ = 0;
};

}  // namespace signorini
