#include "result/instants.hpp"

#include <fcntl.h>
#include <fmt/core.h>
#include <unistd.h>
#include <cerrno>
#include <cmath>
#include <sstream>

#include "base/files.hpp"
#include "base/json.hpp"
#include "base/text.hpp"
#include "signorini/error.hpp"

namespace signorini::result {
namespace {

// Columns in this order: Head, then the degrees of freedom, then Part for each contact.
enum Head : std::size_t {
  at_t,
  at_side,
  at_resolution,
  at_start,
  at_breakpoint,
  at_load,
  at_located,
  at_forgiven,
  at_dependence,
  heads
};
constexpr const char* head_names[heads] = {"t",          "side",    "resolution", "start",     "breakpoint",
                                           "load_jumps", "located", "forgiven",   "dependence"};
enum Part : std::size_t {
  of_state,
  of_p,
  of_N,
  of_T,
  of_blows,
  of_capture_n,
  of_capture_t,
  of_released,
  parts
};
constexpr const char* part_names[parts] = {".state", ".p",         ".N",         ".T",
                                           ".blows", ".capture_n", ".capture_t", ".released"};

std::vector<std::string> columns_of(const Model& model) {
  std::vector<std::string> names(head_names, head_names + heads);
  for (const Dof& dof : model.dofs) names.push_back(dof.displacement);
  for (const Dof& dof : model.dofs) names.push_back(dof.velocity);
  for (const Dof& dof : model.dofs) names.push_back(dof.displacement + ".acceleration");
  for (const Contact& contact : model.contacts)
    for (const char* part : part_names) names.push_back(contact.name + part);
  return names;
}

std::string text_of(State state) {
  if (is_user_law_state(state)) return std::to_string(signorini::user_law_state_number(state));
  return state == State::inside               ? "inside"
         : state == State::static_limit_plus  ? "held+"
         : state == State::static_limit_minus ? "held-"
                                              : signorini::to_string(state);
}

}  // namespace

InstantWriter::InstantWriter(const std::filesystem::path& directory, const Model& model)
    : model_(model), file_(directory / instants_file) {
  for (const std::string& name : columns_of(model)) block_.text(name);
  block_.end_row();
  file_.write(block_);
}

void InstantWriter::write(const InstantRow& row) {
  side(row, false);
  side(row, true);
  file_.write(block_);
}

void InstantWriter::side(const InstantRow& row, bool after) {
  const InstantSide& s = after ? row.after : row.before;
  block_.number(row.t).text(after ? "after" : "before").number(row.resolution);
  for (const bool flag : {row.start, row.breakpoint, row.load_jumps, row.located})
    block_.text(flag ? "1" : "0");
  block_.number(row.tolerated_violation).number(row.eigenvector_condition);
  const auto numbers = [&](const Vector& x) {
    for (Eigen::Index i = 0; i < x.size(); ++i) block_.number(x[i]);
    for (Eigen::Index i = x.size(); i < model_.size(); ++i) block_.empty();
  };
  numbers(s.u);
  numbers(s.v);
  numbers(s.a);
  for (std::size_t k = 0; k < model_.contacts.size(); ++k) {
    const auto in_N = static_cast<Eigen::Index>(model_.layout.normal(k)),
               in_T = static_cast<Eigen::Index>(model_.layout.tangent(k));
    block_.text(text_of(s.states[k].state))
        .number(s.states[k].anchor)
        .number(s.forces[in_N])
        .number(s.forces[in_T]);
    if (!after) {
      block_.empty().empty().empty().empty();
      continue;
    }
    std::string blows;
    for (const InstantImpact& impact : row.impacts)
      if (impact.contact == static_cast<int>(k))
        blows += fmt::format("{}{}:{}:{}", blows.empty() ? "" : " ", impact.impact_number,
                             base::format_number(impact.normal), base::format_number(impact.tangent));
    block_.text(blows);
    for (const Eigen::Index i : {in_N, in_T})
      if (row.capture_impulses.size() > 0)
        block_.number(row.capture_impulses[i]);
      else
        block_.empty();
    bool released = false;
    for (const int contact : row.released) released = released || contact == static_cast<int>(k);
    block_.text(released ? "1" : "0");
  }
  block_.end_row();
}

InstantReader::InstantReader(const std::filesystem::path& directory, const Model& model)
    : path_(directory / instants_file), model_(model), header_(columns_of(model)), reader_(path_) {
  const std::vector<std::string>& found = reader_.header();
  for (std::size_t i = 0; i < std::max(found.size(), header_.size()); ++i) {
    if (i < found.size() && i < header_.size() && found[i] == header_[i]) continue;
    throw FileError(path_.string(),
                    fmt::format("line 1, column {}: found {}, expected {}", i + 1,
                                i < found.size() ? "\"" + base::excerpt(found[i]) + "\"" : "no column",
                                i < header_.size() ? "\"" + header_[i] + "\"" : "no further column"));
  }
}

void InstantReader::fail(std::size_t column, const std::string& expected) const {
  throw FileError(path_.string(),
                  fmt::format("line {}: {}: found \"{}\", expected {}", reader_.line(), header_[column],
                              base::excerpt(reader_.cell(column)), expected));
}

double InstantReader::number(std::size_t column) const {
  const std::optional<double> value = base::parse_number(reader_.cell(column));
  if (!value || !std::isfinite(*value)) fail(column, "a number");
  return *value;
}

bool InstantReader::flag(std::size_t column) const {
  if (reader_.cell(column) != "0" && reader_.cell(column) != "1") fail(column, "0 or 1");
  return reader_.cell(column) == "1";
}

Vector InstantReader::vector(std::size_t column) const {
  Vector x(model_.size());
  for (Eigen::Index i = 0; i < x.size(); ++i) x[i] = number(column + static_cast<std::size_t>(i));
  return x;
}

ContactState InstantReader::state(std::size_t contact, std::size_t column) const {
  const std::string& text = reader_.cell(column);
  const std::vector<State> own = model_.contacts[contact].law->user_law_states();
  ContactState result;
  result.anchor = number(column + of_p);
  if (!own.empty()) {
    const std::optional<double> found = base::parse_number(text);
    for (std::size_t i = 0; i < own.size(); ++i)
      if (found && *found == static_cast<double>(i)) {
        result.state = own[i];
        return result;
      }
    fail(column, "the number of a state of the contact's law");
  }
  for (const State known : {State::open, State::inside, State::closed, State::stick, State::slip_plus,
                            State::slip_minus, State::static_limit_plus, State::static_limit_minus})
    if (text == text_of(known)) {
      result.state = known;
      return result;
    }
  fail(column, "open, inside, closed, stick, slip+, slip-, held+ or held-");
}

std::size_t InstantReader::of_contact(std::size_t contact) const {
  return heads + 3 * static_cast<std::size_t>(model_.size()) + parts * contact;
}

void InstantReader::take_side(InstantSide& side, bool after) const {
  const auto n = static_cast<std::size_t>(model_.size());
  side.u = vector(heads);
  side.v = vector(heads + n);
  if (after) side.a = vector(heads + 2 * n);
  side.forces.resize(model_.force_count());
  for (std::size_t k = 0; k < model_.contacts.size(); ++k) {
    const std::size_t column = of_contact(k);
    side.states.push_back(state(k, column));
    side.forces[static_cast<Eigen::Index>(model_.layout.normal(k))] = number(column + of_N);
    side.forces[static_cast<Eigen::Index>(model_.layout.tangent(k))] = number(column + of_T);
  }
}

void InstantReader::take_impulses(std::size_t contact, std::size_t column, InstantRow& row) const {
  std::istringstream blows(reader_.cell(column + of_blows));
  for (std::string word; blows >> word;) {
    const std::size_t first = word.find(':'), second = word.find(':', first + 1);
    if (first == std::string::npos || second == std::string::npos)
      fail(column + of_blows, "impulses turn:Pn:Pt separated by blanks");
    const auto turn = base::parse_number(word.substr(0, first)),
               n = base::parse_number(word.substr(first + 1, second - first - 1)),
               t = base::parse_number(word.substr(second + 1));
    if (!turn || !n || !t || !(*turn >= 1.0 && *turn < 1e6) || !std::isfinite(*n) || !std::isfinite(*t))
      fail(column + of_blows, "impulses turn:Pn:Pt separated by blanks");
    row.impacts.push_back({static_cast<int>(contact), static_cast<int>(*turn), *n, *t});
  }
  if (!reader_.cell(column + of_capture_n).empty()) {
    if (row.capture_impulses.size() == 0) row.capture_impulses = Vector::Zero(model_.force_count());
    row.capture_impulses.data()[model_.layout.normal(contact)] = number(column + of_capture_n);
    row.capture_impulses.data()[model_.layout.tangent(contact)] = number(column + of_capture_t);
  }
  if (flag(column + of_released)) row.released.push_back(static_cast<int>(contact));
}

std::optional<InstantRow> InstantReader::next() {
  if (!reader_.next()) return std::nullopt;
  InstantRow row;
  row.t = number(at_t);
  if (reader_.cell(at_side) != "before") fail(at_side, "before");
  row.resolution = number(at_resolution);
  row.start = flag(at_start);
  row.breakpoint = flag(at_breakpoint);
  row.load_jumps = flag(at_load);
  row.located = flag(at_located);
  row.tolerated_violation = number(at_forgiven);
  row.eigenvector_condition = number(at_dependence);
  take_side(row.before, false);
  if (!reader_.next())
    throw FileError(
        path_.string(),
        fmt::format("line {}: the file is cut, expected the row of the side \"after\" at t = {:.9g}",
                    reader_.line(), row.t));
  if (reader_.cell(at_side) != "after") fail(at_side, "after");
  if (number(at_t) != row.t)
    fail(at_t, fmt::format("{}, the time of the row of the side \"before\"", base::format_number(row.t)));
  take_side(row.after, true);
  for (std::size_t k = 0; k < model_.contacts.size(); ++k) take_impulses(k, of_contact(k), row);
  return row;
}

namespace {

base::Json names(const std::vector<NamedGuard>& guards, const Model& model, bool with_signs) {
  base::Json result = base::Json::array();
  for (const NamedGuard& g : guards) {
    result.push_back({{"contact", model.contacts[g.contact].name}, {"guard", g.guard}});
    if (with_signs) result.back().update({{"order", g.order}, {"excess", g.excess}});
  }
  return result;
}

}  // namespace

namespace {

/// Opens a named pipe that some program reads; -1 for other files. The caller closes it after its own opening, because a reader
/// that sees no writer left ends. Errors: FileError if no program reads the pipe; opening it would wait for a reader.
int open_if_pipe(const std::filesystem::path& path) {
  std::error_code error;
  if (!std::filesystem::is_fifo(path, error)) return -1;
  const int pipe = ::open(path.c_str(), O_WRONLY | O_NONBLOCK | O_CLOEXEC);
  if (pipe < 0 && errno == ENXIO)
    throw FileError(path.string(), "is a pipe that no program reads; start its reader first, or give a file");
  return pipe;
}

}  // namespace

TraceWriter::TraceWriter(const std::filesystem::path& path, const Model& model) : model_(model), path_(path) {
  base::check_output_file(path, "trace", R"(,"round":1,"fired":[)");
  const int pipe = open_if_pipe(path);
  errno = 0;
  file_.open(path);
  const int error = errno;
  if (pipe >= 0) ::close(pipe);
  if (!file_) throw FileError(path.string(), "cannot be created" + base::system_error_text(error));
}

void TraceWriter::write(const DecisionRound& round) {
  base::Json touching = base::Json::array(), tried = base::Json::object();
  for (const std::size_t c : round.touching) touching.push_back(model_.contacts[c].name);
  for (std::size_t c = 0; c < round.states.size(); ++c)
    tried[model_.contacts[c].name] = signorini::to_string(round.states[c].state);
  const base::Json line = {{"t", round.t},
                           {"round", round.number},
                           {"fired", names(round.triggered, model_, false)},
                           {"touching", touching},
                           {"impact", round.impact},
                           {"tried", tried},
                           {"failed", names(round.failed, model_, true)},
                           {"holds", round.failed.empty()}};
  file_ << base::json_line(line) << std::endl;
  if (!file_) throw FileError(path_.string(), "cannot be written");
}

}  // namespace signorini::result
