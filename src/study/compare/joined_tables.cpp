#include "study/compare/joined_tables.hpp"

#include <algorithm>
#include <cmath>

namespace signorini {

bool same_time(double a, double b) {
  constexpr double roundoff = 1e-13;  // for time grids made by summation instead of multiplication
  return std::abs(a - b) <= roundoff * std::max(std::abs(a), std::abs(b));
}

bool TimeJoin::read(CsvReader& reader, std::size_t& count) const {
  if (!reader.next() || beyond(reader.t(), until_)) return false;
  ++count;
  return true;
}

bool TimeJoin::next() {
  bool more_a = read(a_, rows_.reference), more_b = read(b_, rows_.other);
  while (more_a && more_b) {
    const double ta = a_.t(), tb = b_.t();
    t_ = ta;
    if (same_time(ta, tb)) {
      ++rows_.compared;
      return true;
    }
    if (ta < tb)
      more_a = read(a_, rows_.reference);
    else
      more_b = read(b_, rows_.other);
  }
  while (more_a) more_a = read(a_, rows_.reference);
  while (more_b) more_b = read(b_, rows_.other);
  return false;
}

ContactRowReader::ContactRowReader(const std::filesystem::path& path)
    : reader_(path), contact_(reader_.column("contact")), N_(reader_.column("N")), T_(reader_.column("T")) {
  pending_ = reader_.next();
}

bool ContactRowReader::next() {
  if (!pending_) return false;
  t_ = reader_.t();
  forces_.clear();
  do {
    forces_[reader_.cell(contact_)] = {reader_.number(N_), reader_.number(T_)};
    pending_ = reader_.next();
  } while (pending_ && reader_.t() == t_);
  return true;
}

}  // namespace signorini
