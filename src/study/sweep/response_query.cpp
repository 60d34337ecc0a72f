#include "study/sweep/response_query.hpp"

#include <fmt/core.h>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "base/text.hpp"
#include "signorini/error.hpp"

namespace signorini::sweep {

std::vector<std::string> event_names() { return names_of(all_event_types); }

std::optional<EventQuery> parse_event_query(const std::string& option, const std::string& text,
                                            const Model& model) {
  const std::size_t at = text.find('@');
  const auto row = std::find_if(all_event_types.begin(), all_event_types.end(),
                                [&](const EventTypeName& type) { return text.substr(0, at) == type.name; });
  if (row == all_event_types.end()) return std::nullopt;
  EventQuery query{row->type, {}};
  if (at == std::string::npos) return query;
  query.contact = text.substr(at + 1);
  check_known(option, "contact", query.contact, names_of(model.contacts));
  return query;
}

void check_known(const std::string& option, const char* what, const std::string& name,
                 const std::vector<std::string>& known) {
  if (std::find(known.begin(), known.end(), name) != known.end()) return;
  throw UsageError(fmt::format("{}: unknown {} \"{}\"{}", option, what, name, base::suggestion(name, known)));
}

namespace {

using Kind = ResponseQuery::Kind;

struct Word {
  const char* word;
  Kind kind;
};
constexpr std::array words{
    Word{"max", Kind::max},     Word{"min", Kind::min},           Word{"abs", Kind::abs},
    Word{"tmax", Kind::tmax},   Word{"tmin", Kind::tmin},         Word{"end", Kind::end},
    Word{"count", Kind::count}, Word{"residual", Kind::residual}, Word{"impulse", Kind::impulse}};

std::size_t index_of(const std::string& name, const Model& model) {
  std::size_t k = 0;
  while (model.contacts[k].name != name) ++k;
  return k;
}

}  // namespace

ResponseQuery parse_query(const std::string& text, const Model& model) {
  const std::string option = "--response " + text;
  if (!base::is_plain_text(text))
    throw UsageError(base::excerpt(option) + ": found bytes that are not plain UTF-8 text");
  const std::size_t colon = text.find(':');
  const auto row = std::find_if(words.begin(), words.end(),
                                [&](const Word& w) { return text.substr(0, colon) == w.word; });
  if (colon == std::string::npos || row == words.end()) {
    std::string list;
    for (const Word& w : words) list += fmt::format("{}{}:", list.empty() ? "" : ", ", w.word);
    throw UsageError(fmt::format("{}: expected one of {}, followed by a name", option, list));
  }
  ResponseQuery query;
  query.kind = row->kind;
  query.text = text;
  const std::string rest = text.substr(colon + 1);
  const std::vector<std::string> contacts = names_of(model.contacts);
  std::size_t at = rest.find('@');
  if (query.kind != Kind::count) {  // the name of an output or a contact may contain an @
    at = rest.rfind('@');
    if (std::find(contacts.begin(), contacts.end(), rest) != contacts.end()) at = std::string::npos;
  }
  query.name = rest.substr(0, at);
  const std::string behind = at == std::string::npos ? "" : rest.substr(at + 1);
  if (query.of_output()) {
    check_known(option, "output", rest, names_of(model.outputs));
    query.name = rest;
    return query;
  }
  if (query.kind == Kind::count) {
    check_known(option, "event", query.name, event_names());
    query.event = parse_event_query(option, rest, model).value();
    query.name = query.event.contact;
    return query;
  }
  check_known(option, "contact", query.name, contacts);
  if (at == std::string::npos) return query;
  const auto number = query.kind == Kind::impulse ? base::parse_integer(behind) : std::nullopt;
  if (!number || *number < 1)
    throw UsageError(fmt::format(
        "{}: found \"@{}\", expected {}", option, behind,
        query.kind == Kind::impulse ? "the number of a landing, from 1" : "nothing after the contact"));
  query.number = static_cast<std::size_t>(*number);
  return query;
}

QueryRecorder::QueryRecorder(const std::vector<ResponseQuery>& queries, const Model& model)
    : queries_(queries), model_(model), counts_(queries.size(), 0.0) {}

void QueryRecorder::event(const Event& event) {
  for (std::size_t i = 0; i < queries_.size(); ++i) {
    const ResponseQuery& query = queries_[i];
    if (query.kind == Kind::count && query.event.matches(event, model_)) counts_[i] += 1.0;
  }
  for (const int part : {event.contact, static_cast<int>(event.type), static_cast<int>(event.to)})
    sequence_ = (sequence_ ^ static_cast<std::uint64_t>(part + 1)) * 1099511628211U;
}

std::string QueryRecorder::sequence() const { return fmt::format("{:016x}", sequence_); }

void QueryRecorder::sample(const Sample& sample) {
  last_slip_.clear();
  for (const ContactSample& contact : sample.contacts) last_slip_.push_back(contact.slip);
  if (first_slip_.empty()) first_slip_ = last_slip_;
}

double QueryRecorder::value(const ResponseQuery& query, std::size_t i, const Report& report) const {
  constexpr double none = std::numeric_limits<double>::quiet_NaN();
  if (report.outcome.kind != Outcome::Kind::done)
    return none;  // the run ended early: values would cover only a part of the motion
  if (query.kind == Kind::count) return counts_[i];
  if (query.kind == Kind::residual) {
    if (last_slip_.empty()) return none;
    const std::size_t k = index_of(query.name, model_);
    return last_slip_[k] - first_slip_[k];
  }
  if (query.kind == Kind::impulse) {
    const std::vector<Landing>& landings = report.landings[index_of(query.name, model_)];
    if (query.number > 0) return query.number <= landings.size() ? landings[query.number - 1].impulse : none;
    double greatest = 0.0;
    for (const Landing& landing : landings) greatest = std::max(greatest, landing.impulse);
    return greatest;
  }
  std::size_t o = 0;
  while (model_.outputs[o].name != query.name) ++o;
  const OutputExtremes& e = report.response[o];
  switch (query.kind) {
    case Kind::max:
      return e.maximum;
    case Kind::min:
      return e.minimum;
    case Kind::abs:
      return std::max(std::abs(e.maximum), std::abs(e.minimum));
    case Kind::tmax:
      return e.t_maximum;
    case Kind::tmin:
      return e.t_minimum;
    default:
      return e.last;
  }
}

std::vector<double> QueryRecorder::values(const Report& report) const {
  std::vector<double> list;
  for (std::size_t i = 0; i < queries_.size(); ++i) list.push_back(value(queries_[i], i, report));
  return list;
}

std::string unit_of(const ResponseQuery& query, const Model& model) {
  const Units& u = model.units;
  if (query.kind == Kind::count) return "";
  if (query.kind == Kind::residual) return u.length;
  if (query.kind == Kind::impulse) return u.force + " " + u.time;
  if (query.kind == Kind::tmax || query.kind == Kind::tmin) return u.time;
  for (const Output& output : model.outputs)
    if (output.name == query.name) return unit_text(output.unit, u);
  return "";
}

}  // namespace signorini::sweep
