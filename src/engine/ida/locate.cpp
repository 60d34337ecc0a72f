#include "engine/ida/locate.hpp"

#include <algorithm>
#include <functional>

#include "engine/falls/root.hpp"

namespace signorini {

double locate(BdfIntegrator& bdf, ConsistentMotion& consistent, const Segment& segment, const Model& model,
              std::size_t slot, double begin, double end, double time, double resolution) {
  const std::size_t contact = contact_of_guard(slot);
  const GuardForm& guard = segment.decision->guard(slot);
  const Forcing& forcing = *segment.forcing;
  Point point;
  const std::function<double(double)> value = [&](double t) {
    bdf.evaluate(t, point);
    consistent.make(segment.decision->system, forcing, t, point);
    return guard.value(motion_of(model.contacts[contact], contact, forcing, t, point));
  };
  const double g = value(time);
  if (g == 0.0) return time;
  double width = 0.25 * resolution;
  if (g > 0.0) {  // the crossing is later
    for (double lo = time; lo < end; width *= 4.0) {
      const double hi = std::min(end, time + width);
      if (value(hi) <= 0.0) return root_between(value, lo, hi, 0.25 * resolution);
      lo = hi;
    }
  } else {
    for (double hi = time; hi > begin; width *= 4.0) {
      const double lo = std::max(begin, time - width);
      if (value(lo) > 0.0) return root_between(value, lo, hi, 0.25 * resolution);
      hi = lo;
    }
  }
  return time;
}

}  // namespace signorini
