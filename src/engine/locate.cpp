#include "engine/locate.hpp"

#include <gsl/gsl_roots.h>

#include <algorithm>
#include <functional>
#include <memory>

namespace signorini {
namespace {

double call(double t, void* f) { return (*static_cast<const std::function<double(double)>*>(f))(t); }

/// lo, hi with f(lo) > 0 > f(hi); narrows to `width` and returns the right end.
double brent(const std::function<double(double)>& f, double lo, double hi, double width) {
  gsl_function function{&call, const_cast<std::function<double(double)>*>(&f)};
  const std::unique_ptr<gsl_root_fsolver, void (*)(gsl_root_fsolver*)> solver(
      gsl_root_fsolver_alloc(gsl_root_fsolver_brent), gsl_root_fsolver_free);
  gsl_root_fsolver_set(solver.get(), &function, lo, hi);
  for (int i = 0; i < 100; ++i) {
    gsl_root_fsolver_iterate(solver.get());
    lo = gsl_root_fsolver_x_lower(solver.get());
    hi = gsl_root_fsolver_x_upper(solver.get());
    if (hi - lo <= width) break;
  }
  return gsl_root_fsolver_root(solver.get());
}

}  // namespace

double locate(IdaStepper& stepper, const Expander& expander, const Forcing& forcing, const Model& model,
              const GuardStart& guard, std::size_t contact, double begin, double end, double time,
              double resolution) {
  Point point;
  const std::function<double(double)> value = [&](double t) {
    stepper.evaluate(t, point);
    expander.consistent(forcing, t, point);
    return guard.form.value(motion_of(model.contacts[contact], contact, forcing, t, point));
  };
  const double g = value(time);
  if (g == 0.0) return time;
  double width = 0.25 * resolution;
  if (g > 0.0) {  // the fall lies later
    for (double lo = time; lo < end; width *= 4.0) {
      const double hi = std::min(end, time + width);
      if (value(hi) <= 0.0) return brent(value, lo, hi, 0.25 * resolution);
      lo = hi;
    }
  } else {
    for (double hi = time; hi > begin; width *= 4.0) {
      const double lo = std::max(begin, time - width);
      if (value(lo) > 0.0) return brent(value, lo, hi, 0.25 * resolution);
      hi = lo;
    }
  }
  return time;
}

}  // namespace signorini
