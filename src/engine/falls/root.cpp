#include "engine/falls/root.hpp"

#include <gsl/gsl_roots.h>

#include <memory>

namespace signorini {
namespace {

double call(double t, void* f) { return (*static_cast<const std::function<double(double)>*>(f))(t); }

}  // namespace

double root_between(const std::function<double(double)>& f, double lo, double hi, double width) {
  const double first = lo, last = hi, at_first = f(lo), at_last = f(hi);
  // GSL ends the program if there is no sign change: in that case the state was wrong from the start on.
  if (!(at_first > 0.0)) return first;
  if (at_last > 0.0) return last;
  const std::function<double(double)> known = [&](double t) {
    return t == first ? at_first : t == last ? at_last : f(t);
  };
  gsl_function function{&call, const_cast<std::function<double(double)>*>(&known)};
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

}  // namespace signorini
