// event_order.hpp: detects events whose order is unknown.
//
//   t_2 - t_1 < e_1 + e_2      e: uncertainty of an event's time;   events of one instant are not compared
//
// Each event is compared with the last one before it in the log whose guard was zero.
#pragma once

#include <string>

#include "signorini/model.hpp"
#include "signorini/result.hpp"

namespace signorini {

class EventOrder {
 public:
  /// Model and report must outlive the object. Warnings go to the report.
  EventOrder(const Model& model, Report& report) : model_(model), report_(report) {}

  /// Adds an event whose t_uncertainty is known.
  void event(const Event& event, double resolution);
  void load_jump(double t);
  void warn(const std::string& which);
  void finish();

 private:
  [[nodiscard]] std::string told(const Event& event) const;

  const Model& model_;
  Report& report_;
  Event last_;  // last event with a contact and a guard
  int unordered_ = 0;
};

}  // namespace signorini
