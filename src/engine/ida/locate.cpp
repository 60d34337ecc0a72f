#include "engine/ida/locate.hpp"

#include <algorithm>
#include <functional>

#include "engine/events/first_root.hpp"

namespace signorini::ida {

double locate(BdfIntegrator& bdf, motion::ConsistentMotion& consistent, const engine::Segment& segment,
              const Model& model, std::size_t slot, double begin, double end, double time,
              double resolution) {
  const std::size_t contact = model.layout.contact_of_guard(slot);
  const GuardForm& guard = segment.decision->guard(slot);
  const motion::Forcing& forcing = *segment.forcing;
  motion::Point point;
  const std::function<double(double)> value = [&](double t) {
    bdf.evaluate(t, point);
    consistent.make(segment.decision->system, forcing, t, point);
    return guard.value(motion::motion_of(model.contacts[contact], contact, forcing, t, point));
  };
  const double g = value(time);
  if (g == 0.0) return time;
  double width = 0.25 * resolution;
  if (g > 0.0) {  // the crossing is after `time`
    for (double lo = time; lo < end; width *= 4.0) {
      const double hi = std::min(end, time + width);
      if (value(hi) <= 0.0) return events::root_between(value, lo, hi, 0.25 * resolution);
      lo = hi;
    }
  } else {
    for (double hi = time; hi > begin; width *= 4.0) {
      const double lo = std::max(begin, time - width);
      if (value(lo) > 0.0) return events::root_between(value, lo, hi, 0.25 * resolution);
      hi = lo;
    }
  }
  return time;
}

namespace {

/// Power coefficients a_k = C(n, k) sum_i (-1)^(k-i) C(k, i) b_i, computed by repeated differences of the b_i.
std::array<double, events::max_degree + 1> powers_of(events::Bernstein p) {
  std::array<double, events::max_degree + 1> a{};
  double choose = 1.0;
  for (int k = 0; k <= p.degree; ++k) {
    a[events::z(k)] = choose * p.b[0];
    choose *= static_cast<double>(p.degree - k) / static_cast<double>(k + 1);
    for (int i = 0; i < p.degree - k; ++i) p.b[events::z(i)] = p.b[events::z(i + 1)] - p.b[events::z(i)];
  }
  return a;
}

bool is_monotone(const events::Bernstein& p) {
  bool rises = false, falls = false;
  for (int i = 0; i < p.degree; ++i) {
    rises = rises || p.b[events::z(i + 1)] > p.b[events::z(i)];
    falls = falls || p.b[events::z(i + 1)] < p.b[events::z(i)];
  }
  return !(rises && falls);
}

constexpr std::size_t slide_place = static_cast<std::size_t>(
    std::find(events::TurningPointDetector::watched_fields.begin(),
              events::TurningPointDetector::watched_fields.end(), motion::ContactSeries::slide) -
    events::TurningPointDetector::watched_fields.begin());

}  // namespace

void HistoryTurningPoints::start(const decide::Decision& decision, const motion::Forcing& forcing) {
  detector_.start(decision);
  forcing_ = &forcing;
  moving_surfaces_.clear();
  for (std::size_t c = 0; c < contacts_; ++c)
    if (forcing.surface_moves(c)) moving_surfaces_.push_back(c);
}

void HistoryTurningPoints::find(const events::StepHistory& history, double x_end) {
  detector_.open();
  // Fast path: in most steps all values stay within their earlier ranges, so no search is needed.
  const double *last = history.last_values() + first_, *bend = history.variation_bounds() + first_;
  const events::TurningPointDetector::Range* seen = detector_.ranges();
  const std::size_t shown = count();
  for (std::size_t i = 0; i < shown; ++i)
    if (!(last[i] + bend[i] <= seen[i].greatest) || !(last[i] - bend[i] >= seen[i].least))
      search(i, history, x_end);
  for (const std::size_t c : moving_surfaces_) search_slide(c, history, x_end);
  detector_.close();
}

void HistoryTurningPoints::search_slide(std::size_t c, const events::StepHistory& history, double x_end) {
  const events::Bernstein p =
      history.polynomial(first_ + events::TurningPointDetector::watched_fields.size() * c + slide_place);
  const std::array<double, events::max_degree + 1> a = powers_of(p);
  const double h = history.end() - history.begin();
  const std::size_t count = forcing_->surface_terms(c);
  of_surface_.resize(count);
  forcing_->expand_surface(c, history.begin(), h, count, of_surface_.data());
  series_.assign(std::max(count, events::z(p.degree) + 1), 0.0);
  std::copy_n(a.begin(), events::z(p.degree) + 1, series_.begin());
  for (std::size_t k = 0; k < count; ++k) series_[k] -= of_surface_[k];
  detector_.find(c, motion::ContactSeries::slide, series_.data(), series_.size() - 1, x_end, history.begin(),
                 h);
}

void HistoryTurningPoints::search(std::size_t shown, const events::StepHistory& history, double x_end) {
  const std::size_t i = first_ + shown, c = shown / events::TurningPointDetector::watched_fields.size();
  const motion::ContactSeries::Field field =
      events::TurningPointDetector::watched_fields[shown %
                                                   events::TurningPointDetector::watched_fields.size()];
  if (field == motion::ContactSeries::slide && forcing_->surface_moves(c)) return;
  const double last = history.last(i);
  if (x_end == 1.0 && history.clearly_monotone(i)) return detector_.extend_range(c, field, last);
  const events::Bernstein p = history.polynomial(i);
  if (is_monotone(p)) return detector_.extend_range(c, field, x_end == 1.0 ? last : p.value(x_end));
  const std::array<double, events::max_degree + 1> a = powers_of(p);
  detector_.find(c, field, a.data(), static_cast<std::size_t>(p.degree), x_end, history.begin(),
                 history.end() - history.begin());
}

}  // namespace signorini::ida
