#include "engine/exact/modal/settle_guard.hpp"

#include <algorithm>
#include <cmath>

#include "base/rounding.hpp"
#include "engine/falls/first_fall.hpp"

namespace signorini {
namespace {

/// True if the guard's rate, including its ripple, is negative from `from` to `to`, places in the step.
bool decreases(const GuardOnStep& guard, double h, double from, double to) {
  const std::vector<double>& p = guard.p;
  std::vector<double> q(p.size() - 1);
  for (std::size_t j = 0; j < q.size(); ++j) q[j] = -static_cast<double>(j + 1) * p[j + 1];
  for (std::size_t i = 0; i + 1 < q.size(); ++i)  // about `from`
    for (std::size_t j = q.size() - 1; j-- > i;) q[j] += from * q[j + 1];
  double power = 1.0, rest = 0.0;
  for (double& entry : q) {
    entry *= power;
    power *= to - from;
    rest = std::max(rest, std::abs(entry));
  }
  q[0] -= guard.ripple_rate * h + rounding::of_elimination * rest;
  return q[0] > 0.0 && first_fall(q.data(), q.size() - 1, 0.0).kind == FirstFall::Kind::none;
}

/// The only zero between two places of the step, in closed form: secants, kept inside (Illinois).
double only_fall(const std::function<double(double)>& g, double from, double to) {
  double low = g(from), high = g(to);
  if (!(low > 0.0)) return from;
  if (!(high < 0.0)) return to;
  int side = 0;
  double x = from;
  for (int i = 0; i < 100; ++i) {
    const double next = from + (to - from) * low / (low - high);
    const double step = std::abs(next - x);
    x = std::clamp(next, from, to);
    const double now = g(x);
    if (now == 0.0 || (i > 0 && step <= 2.0 * rounding::eps * to)) break;
    if (now > 0.0) {
      from = x;
      low = now;
      if (side > 0) high *= 0.5;
      side = 1;
    } else {
      to = x;
      high = now;
      if (side < 0) low *= 0.5;
      side = -1;
    }
    if (to - from <= 2.0 * rounding::eps * to) break;
  }
  return x;
}

/// Treats a guard that starts at zero.
bool leave_zero(GuardOnStep& guard, std::size_t slot, Arming& arming, double& limit) {
  std::vector<double>& q = guard.p;
  double scale = 0.0;
  for (const double entry : q) scale += std::abs(entry);
  // The decision knows that it rises; the remainder of the series is subtracted.
  q[0] -= std::min(guard.ripple + rounding::of_many * scale, 0.5 * q[0]);
  if (!(q[0] > 0.0)) {
    arming.doubt(slot);
    return false;
  }
  const FirstFall fall = first_fall(q.data(), q.size() - 1, 0.0);
  if (fall.kind == FirstFall::Kind::fall) limit = std::min(limit, 0.9 * fall.x);
  return true;
}

}  // namespace

std::vector<double> derivative_of(const std::vector<double>& p, std::size_t m, double h) {
  std::vector<double> q(p.begin() + static_cast<std::ptrdiff_t>(m), p.end());
  double factor = 1.0;
  for (std::size_t i = 1; i <= m; ++i) factor *= static_cast<double>(i) / h;
  for (std::size_t j = 0; j < q.size(); ++j) {
    q[j] *= factor;
    factor *= static_cast<double>(j + m + 1) / static_cast<double>(j + 1);
  }
  return q;
}

bool settle_guard(GuardOnStep& guard, std::size_t slot, double h,
                  const std::function<double(double)>& value_at, Arming& arming, Passage& passage,
                  double& limit, double& event) {
  std::vector<double>& p = guard.p;
  const std::size_t degree = p.size() - 1;
  const auto fires = [&](double x) {
    if (x >= event) return;
    event = x;
    passage.fired = slot;
    passage.unseen = !guard.armed;
  };
  if (guard.leading > 0) return leave_zero(guard, slot, arming, limit);
  if (!guard.armed) {
    p[0] += guard.noise + guard.slack;
    const FirstFall fall = first_fall(p.data(), degree, 0.0);
    if (fall.kind == FirstFall::Kind::fall) fires(fall.x);
    return true;
  }
  if (guard.ripple == 0.0) {
    const FirstFall fall = first_fall(p.data(), degree, guard.slack);
    if (fall.kind == FirstFall::Kind::fall) fires(fall.x);
    if (fall.kind == FirstFall::Kind::touch) passage.touches.push_back(slot);
    return true;
  }
  const double off = guard.slack + guard.ripple, start = p[0];
  p[0] = start - 2.0 * off;
  const FirstFall doubtful = first_fall(p.data(), degree, 0.0);
  if (doubtful.kind != FirstFall::Kind::fall || doubtful.x >= event) return true;
  p[0] = start + off;
  const FirstFall certain = first_fall(p.data(), degree, 0.0);
  if (certain.kind == FirstFall::Kind::fall && decreases(guard, h, doubtful.x, certain.x))
    fires(only_fall(value_at, doubtful.x, certain.x));
  else
    limit = std::min(limit, doubtful.x);
  return true;
}

std::optional<Passage> end_of_step(Passage passage, bool doubted, double limit, double event, double h,
                                   bool& full) {
  if (doubted || (limit == 0.0 && !full)) {  // else a guard is too close to zero for any ripple
    full = full || !doubted;
    return std::nullopt;
  }
  if (limit < event) passage.fired.reset();
  const double x = std::min(limit, event > 1.0 ? 1.0 : event);
  full = !passage.fired && x < 1e-3;
  passage.length = h * x;
  return passage;
}

double stays_above(const double* a, std::size_t degree, double x_end, double sign, double above,
                   std::vector<double>& p) {
  double power = 1.0;
  for (std::size_t j = 0; j <= degree; ++j, power *= x_end) p[j] = sign * a[j] * power;
  p[0] += above;
  if (!(p[0] > 0.0)) return 0.0;
  const FirstFall fall = first_fall(p.data(), degree, 0.0);
  return fall.kind == FirstFall::Kind::none ? 1.0 : fall.x;
}

}  // namespace signorini
