// read_measurements(): a table of what was measured.
#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "base/number.hpp"
#include "result/csv_read.hpp"
#include "signorini/error.hpp"
#include "signorini/fit.hpp"

namespace signorini {
namespace {

class MeasuredTable {
 public:
  explicit MeasuredTable(const std::string& path) : path_(path), reader_(path) {}

  Measurements read() {
    event_ = place("event_index");
    t_ = place("t");
    sigma_ = place("sigma");
    contact_ = place("contact");
    type_ = place("event");
    if (t_ == none) fail(1, "expected a column t beside event_index, or beside columns of history.csv");
    Measurements result;
    result.has_sigma = sigma_ != none;
    result.file = path_;
    for (line_ = 2; reader_.next(); ++line_) {
      if (event_ != none && !reader_.cell(event_).empty()) result.rows.push_back(event_row());
      add_columns(result.rows);
    }
    if (result.rows.empty()) fail(2, "expected at least one row");
    return result;
  }

 private:
  static constexpr std::size_t none = static_cast<std::size_t>(-1);

  [[noreturn]] void fail(long line, const std::string& message) const {
    throw Error(ExitCode::scene, fmt::format("{}:{}: {}", path_, line, message));
  }
  [[nodiscard]] std::size_t place(const std::string& name) const {
    const auto& header = reader_.header();
    const auto at = std::find(header.begin(), header.end(), name);
    return at == header.end() ? none : static_cast<std::size_t>(at - header.begin());
  }
  [[nodiscard]] double number_at(std::size_t column) const {
    const std::optional<double> x = parse_number(reader_.cell(column));
    if (!x || !std::isfinite(*x))
      fail(line_, fmt::format("{}: found \"{}\", expected a finite number", reader_.header()[column],
                              reader_.cell(column)));
    return *x;
  }
  [[nodiscard]] double sigma() const {
    if (sigma_ == none) return 1.0;
    const double x = number_at(sigma_);
    if (!(x > 0.0)) fail(line_, fmt::format("sigma: found {}, expected more than zero", x));
    return x;
  }
  [[nodiscard]] Measurement event_row() const {
    Measurement m;
    const double index = number_at(event_);
    if (index < 1.0 || index != std::floor(index) || index > 1e9)
      fail(line_, fmt::format("event_index: found {}, expected a row of events.csv, from 1", index));
    m.event = static_cast<std::size_t>(index);
    if (contact_ != none) m.contact = reader_.cell(contact_);
    if (type_ != none) m.type = reader_.cell(type_);
    m.line = line_;
    m.value = number_at(t_);
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
      m.t = number_at(t_);
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
