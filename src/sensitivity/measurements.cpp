// read_measurements(): reads a table of measurements.
#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>

#include "base/excerpt.hpp"
#include "base/number.hpp"
#include "result/csv_read.hpp"
#include "signorini/error.hpp"
#include "signorini/fit.hpp"

namespace signorini {
namespace {

class MeasuredTable {
 public:
  explicit MeasuredTable(const std::string& path) : path_(path), reader_(path, LastLine::counts) {}

  Measurements read() {
    event_ = place("event_index");
    t_ = place("t");
    sigma_ = place("sigma");
    contact_ = place("contact");
    type_ = place("event");
    std::string names;
    for (const std::string& name : reader_.header()) names += (names.empty() ? "" : ",") + name;
    if (t_ == none)
      fail(1, fmt::format(
                  "found the columns \"{}\", expected a column t beside event_index, or beside columns of "
                  "history.csv",
                  excerpt(names)));
    Measurements result;
    result.has_sigma = sigma_ != none;
    result.file = path_;
    for (line_ = 2; reader_.next_of_any_length(); ++line_) {
      if (const std::string why = reader_.misfit(); !why.empty()) fail(line_, why);
      if (event_ != none && !reader_.cell(event_).empty()) result.rows.push_back(event_row());
      add_columns(result.rows);
    }
    if (result.rows.empty()) fail(2, "found no measurement, expected at least one row");
    refuse_twice(result.rows);
    return result;
  }

 private:
  static constexpr std::size_t none = static_cast<std::size_t>(-1);

  [[noreturn]] void fail(long line, const std::string& message) const {
    throw Error(ExitCode::scene, fmt::format("{}:{}: {}", path_, line, message));
  }
  [[noreturn]] void fail_at(std::size_t column, const std::string& message) const {
    throw Error(ExitCode::scene, fmt::format("{}:{}:{}: {}: {}", path_, line_, column + 1,
                                             excerpt(reader_.header()[column]), message));
  }
  /// A repeated measurement would count twice.
  void refuse_twice(const std::vector<Measurement>& rows) const {
    std::map<std::tuple<std::size_t, std::string, double>, long> lines;
    for (const Measurement& m : rows) {
      const auto [first, is_new] = lines.try_emplace({m.event, m.column, m.event > 0 ? 0.0 : m.t}, m.line);
      if (is_new) continue;
      fail(m.line,
           m.event > 0
               ? fmt::format("event_index: found {} again, expected each event once; it stands in line {}",
                             m.event, first->second)
               : fmt::format("{}: found t = {} again, expected each time once; it stands in line {}",
                             excerpt(m.column), shortest(m.t), first->second));
    }
  }
  [[nodiscard]] std::size_t place(const std::string& name) const {
    const auto& header = reader_.header();
    const auto at = std::find(header.begin(), header.end(), name);
    return at == header.end() ? none : static_cast<std::size_t>(at - header.begin());
  }
  [[nodiscard]] double number_at(std::size_t column) const {
    const std::optional<double> x = parse_number(reader_.cell(column));
    if (!x || !std::isfinite(*x))
      fail_at(column, fmt::format("found \"{}\", expected a finite number", excerpt(reader_.cell(column))));
    return *x;
  }
  [[nodiscard]] double time() const {
    const double t = number_at(t_);
    if (t < 0.0)
      fail_at(t_, fmt::format("found {}, expected a time from 0, the start of the run", shortest(t)));
    return t;
  }
  [[nodiscard]] double sigma() const {
    if (sigma_ == none) return 1.0;
    const double x = number_at(sigma_);
    if (!(x > 0.0)) fail_at(sigma_, fmt::format("found {}, expected more than zero", x));
    return x;
  }
  [[nodiscard]] Measurement event_row() const {
    Measurement m;
    const double index = number_at(event_);
    if (index < 1.0 || index != std::floor(index) || index > 1e9)
      fail_at(event_, fmt::format("found {}, expected a row of events.csv, from 1", index));
    m.event = static_cast<std::size_t>(index);
    if (contact_ != none) m.contact = reader_.cell(contact_);
    if (type_ != none) m.type = reader_.cell(type_);
    m.line = line_;
    m.value = time();
    m.sigma = sigma();
    return m;
  }
  void add_columns(std::vector<Measurement>& rows) const {
    for (std::size_t c = 0; c < reader_.header().size(); ++c) {
      if (c == t_ || c == sigma_ || c == event_ || reader_.cell(c).empty()) continue;
      if (event_ != none && (c == contact_ || c == type_)) continue;
      Measurement m;
      m.line = line_;
      m.column = reader_.header()[c];
      m.t = time();
      m.value = number_at(c);
      m.sigma = sigma();
      rows.push_back(std::move(m));
    }
  }

  std::string path_;
  CsvReader reader_;
  std::size_t event_ = none, t_ = none, sigma_ = none, contact_ = none, type_ = none;
  long line_ = 1;
};

}  // namespace

Measurements read_measurements(const std::string& path) { return MeasuredTable(path).read(); }

}  // namespace signorini
