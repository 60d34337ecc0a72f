#include "run/motion_record.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "base/rounding.hpp"
#include "model/assembly/parts.hpp"
#include "run/curve_record.hpp"

namespace signorini::run {
namespace {

// Limits of the number of rows: with these limits the file has at most about five megabytes if motions are slow.
constexpr std::size_t max_in_all = 40000, max_of_one = 8000, min_of_one = 400;
constexpr double min_intervals = 250.0;  // least number of row intervals in a run, also for a contact at rest
constexpr std::size_t max_drawn = 24;    // limit of the number of contacts with a picture
// The widest picture has 1250 pixels per run, so straight lines have fewer than two rows per pixel.
constexpr double pieces_of_run = 2000.0;
constexpr double growth = 0.2;  // growth of the row spacing per elapsed time. Chosen value

}  // namespace

MotionRecord::MotionRecord(const Model& model, double t_end, const Recorder& recorder, const PartShare& share)
    : t_end_(t_end), spacing_(t_end / pieces_of_run), enabled_(recorder.wants_motion()) {
  if (!recorder.wants_motion() || model.contacts.empty()) return;
  const std::size_t count = model.contacts.size();
  const std::size_t in_all = share.whole() ? count : share.contacts;
  const std::size_t most = std::clamp(max_in_all / in_all, min_of_one, max_of_one);
  for (std::size_t k = 0; k < count; ++k) {
    const bool drawn = share.number(k) < max_drawn;
    tracks_.push_back({{t_end, {most, !drawn, true, t_end / min_intervals}}, drawn});
  }
  const auto parts = assembly::coupled_contacts(model);
  reached_.resize(parts.size());
  for (std::size_t i = 0; i < parts.size(); ++i)
    for (const std::size_t k : parts[i]) tracks_[k].part = i;
}

void MotionRecord::step(double begin, double end, std::span<const double> turning_points) {
  at_ = begin;
  end_ = std::min(end, t_end_);  // the end of a step may be wrong if the motion overflows
  turn_ = 0;
  turns_.clear();
  // Turning points of bodies with equal motions differ by rounding only; they become one row. If the motion overflows,
  // its turning points may not be finite.
  for (const double t : turning_points)
    if (std::isfinite(t) && (turns_.empty() || t - turns_.back() > rounding::time_resolution * std::abs(t)))
      turns_.push_back(t);
}

std::optional<MotionRecord::RowTime> MotionRecord::next() {
  const double never = std::numeric_limits<double>::infinity();
  const double turn = turn_ < turns_.size() ? turns_[turn_] : never;
  // Next row for drawn lines: independent of the step size.
  double line = enabled_ ? std::max(at_, last_ + spacing_) : never;
  if (!(line < end_ - 0.5 * spacing_)) line = never;
  if (turn == never && line == never) return std::nullopt;
  at_ = std::min(turn, line);
  if (turn <= line) ++turn_;
  return RowTime{at_, turn <= line};
}

void MotionRecord::adapt(double t, double asked) {
  asked = std::min(asked, std::exchange(requested_spacing_, std::numeric_limits<double>::infinity()));
  const double wider = spacing_ + growth * std::max(0.0, t - std::exchange(adapted_, t));
  spacing_ = std::clamp(std::min(asked, wider), min_row_spacing * t_end_, t_end_ / pieces_of_run);
}

bool MotionRecord::needs_row(double t) const {
  return !tracks_.empty() && (t - last_ >= spacing_ || t >= t_end_);
}

void MotionRecord::add(double t, const Auditor& auditor, const motion::Forcing& forcing,
                       const contact::ContactStates& states, const motion::Point& point) {
  last_ = t;
  if (tracks_.empty()) return;
  for (std::size_t k = 0; k < tracks_.size(); ++k) {
    Track& track = tracks_[k];
    const std::vector<MotionRow>& rows = track.rows.rows();
    if (!track.drawn && !rows.empty() && t < t_end_ && t - rows.back().t < t_end_ / pieces_of_run) continue;
    const MotionRow row{t, auditor.sample(k, forcing, t, states[k], point)};
    keep(track, row);
    if (track.drawn) requested_spacing_ = std::min(requested_spacing_, spacing_for_track(track, row));
  }
}

void MotionRecord::before(double t, const Auditor& auditor, const motion::Forcing& forcing,
                          const contact::ContactStates& states, const motion::Point& point) {
  for (std::size_t k = 0; k < tracks_.size(); ++k)
    tracks_[k].before = {t, auditor.sample(k, forcing, t, states[k], point)};
}

void MotionRecord::after(double t, const Auditor& auditor, const motion::Forcing& forcing,
                         const contact::ContactStates& states, const motion::Point& point,
                         const std::optional<std::vector<std::size_t>>& changed) {
  if (tracks_.empty()) return;
  reached_.assign(reached_.size(), !changed);
  if (changed)
    for (const std::size_t k : *changed) reached_[tracks_[k].part] = true;
  bool all = true;
  for (std::size_t k = 0; k < tracks_.size(); ++k) {
    Track& track = tracks_[k];
    const double last = track.rows.rows().empty() ? -t_end_ : track.rows.rows().back().t;
    if (!reached_[track.part] && t - last < spacing_) {
      all = false;
      continue;
    }
    if (reached_[track.part] && !track.rows.rows().empty() && last < track.before.t)
      keep(track, track.before);
    const MotionRow row{t, auditor.sample(k, forcing, t, states[k], point)};
    keep(track, row);
    track.last[1] = row;
    track.lasts = 1;
    if (track.drawn && reached_[track.part]) {
      spacing_ = min_row_spacing * t_end_;
      adapted_ = t;  // the spacing grows from here on
    }
  }
  if (all) last_ = t;
}

void MotionRecord::keep(Track& track, const MotionRow& row) {
  track.rows.add(row);
  if (!track.drawn) return;
  force_ = std::max({force_, std::abs(row.sample.N), std::abs(row.sample.T)});
  length_ = std::max({length_, std::abs(row.sample.gap), std::abs(row.sample.ut)});
}

/// Row spacing that a contact needs. Quantities whose range is rounding, relative to other contacts, need no rows.
double MotionRecord::spacing_for_track(Track& track, const MotionRow& row) const {
  double asked = std::numeric_limits<double>::infinity();
  const auto [first, second] = std::exchange(track.last, {track.last[1], row});
  if (++track.lasts < 3 || !(row.t > second.t && second.t > first.t)) return asked;
  const auto a = Drawn{}(first), b = Drawn{}(second), c = Drawn{}(row);
  const double left = second.t - first.t, right = row.t - second.t, part = left / (left + right);
  for (std::size_t i = 0; i < 4; ++i) {
    const double range = track.rows.range(i), least = rounding::elimination * (i < 2 ? force_ : length_);
    if (range > least)
      asked = std::min(asked, row_spacing(left, right, std::abs(b[i] - a[i] - part * (c[i] - a[i])), range));
  }
  return asked;
}

void MotionRecord::write(Recorder& recorder) {
  double length = 0.0, force = 0.0;
  for (const Track& track : tracks_) {
    force = std::max({force, track.rows.size(0), track.rows.size(1)});
    length = std::max({length, track.rows.size(2), track.rows.size(3)});
  }
  force *= rounding::elimination;
  length *= rounding::elimination;
  for (std::size_t k = 0; k < tracks_.size(); ++k) {
    tracks_[k].rows.close({force, force, length, length, 0.0});
    recorder.motion(static_cast<int>(k), tracks_[k].rows.rows());
  }
}

}  // namespace signorini::run
