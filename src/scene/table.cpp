#include "scene/table.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <climits>
#include <cmath>
#include <functional>
#include <stdexcept>

#include "base/text.hpp"

namespace signorini::scene {

namespace {

const toml::table empty_table;

bool in_range(KeyType type, double value) {
  switch (type) {
    case KeyType::positive:
      return value > 0.0;
    case KeyType::fraction:
      return value >= 0.0 && value <= 1.0;
    case KeyType::non_negative:
      return value >= 0.0;
    case KeyType::relative_tolerance:
      return value >= 1e-14 && value < 1.0;  // smaller tolerances would make steps fail by rounding
    case KeyType::count:
      return value >= 1.0;
    default:
      return true;
  }
}

std::optional<double> finite_value(const toml::node& node) {
  if (const auto* number = node.as_integer()) return static_cast<double>(number->get());
  const auto* number = node.as_floating_point();
  return number && std::isfinite(number->get()) ? std::optional(number->get()) : std::nullopt;
}

/// The default of a key. All defaults are parsed once, because a scene needs dozens of defaults and a sweep needs
/// millions.
const toml::node* default_of(const Key& key) {
  static const std::vector<toml::table> parsed = [] {
    std::vector<toml::table> all;
    for (const Key& row : all_keys()) {
      const bool has_one = !row.default_value.empty() && row.default_value != "required";
      all.push_back(has_one ? toml::parse(fmt::format("value = {}", row.default_value)) : toml::table());
    }
    return all;
  }();
  return parsed[static_cast<std::size_t>(&key - all_keys().data())].get("value");
}

}  // namespace

double finite_number(const toml::node& node, const std::string& path, const std::string& expected) {
  if (const auto value = finite_value(node)) return *value;
  const bool infinite = node.is_floating_point();
  refuse(place_of(node), path,
         "found " + describe(node) + ", expected " + expected + (infinite ? " that is finite" : ""));
}

std::vector<double> number_array(const toml::node& node, const std::string& path,
                                 const std::string& expected) {
  const toml::array* array = node.as_array();
  if (!array) refuse(place_of(node), path, "found " + describe(node) + ", expected " + expected);
  std::vector<double> values;
  values.reserve(array->size());
  for (const toml::node& item : *array) values.push_back(finite_number(item, path, "a number"));
  return values;
}

void check_name(const std::string& name, const SourcePlace& place, const std::string& path) {
  constexpr std::size_t longest = 255;
  if (name.empty()) refuse(place, path, "found an empty name, expected a name");
  if (name.size() > longest)
    refuse(place, base::excerpt(path),
           fmt::format("found a name of {} bytes, expected at most {}", name.size(), longest));
  if (std::any_of(name.begin(), name.end(), is_control)) {
    refuse(place, path, "found a name with a line break or another control character, expected a plain name");
  }
  for (const char c : name) {
    if (std::string_view(".,;*\"'=[]{}#").find(c) != std::string_view::npos)
      refuse(place, path,
             "the name contains one of the characters . , ; * \" ' = [ ] { } #, which are not allowed");
  }
  if (name.front() == ' ' || name.back() == ' ' || name.find("  ") != std::string::npos)
    refuse(place, path,
           fmt::format("found \"{}\", expected a name without leading, trailing or double blanks", name));
}

void check_reference(const std::string& name, const SourcePlace& place, const std::string& path) {
  const std::size_t dot = name.find('.');
  check_name(name.substr(0, dot), place, path);
  if (dot != std::string::npos) check_name(name.substr(dot + 1), place, path);
}

bool Names::add(const std::string& name) {
  if (!index_.emplace(name, list_.size()).second) return false;
  list_.push_back(name);
  return true;
}

std::optional<std::size_t> Names::index(const std::string& name) const {
  const auto found = index_.find(name);
  return found == index_.end() ? std::nullopt : std::optional(found->second);
}

std::size_t check_known(const std::string& name, const Names& known, const std::string& what,
                        const SourcePlace& place, const std::string& path) {
  if (const auto index = known.index(name)) return *index;
  refuse(place, path, fmt::format("unknown {} \"{}\"{}", what, name, base::suggestion(name, known.list())));
}

Table::Table(const toml::table* node, std::string kind, std::string path, SourcePlace place)
    : node_(node ? node : &empty_table),
      kind_(std::move(kind)),
      path_(std::move(path)),
      place_(std::move(place)) {
  const auto is_known_key = [&](const toml::key& name) { return find_key(kind_, name.str()) != nullptr; };
  bool fits = true;
  for (const auto& [name, value] : *node_) fits = fits && is_known_key(name);
  if (fits) return;
  for (const Entry& entry : entries_of(*node_)) {  // the message names the first unknown key in the file
    if (!find_key(kind_, entry.name))
      refuse(entry.place(), this->path(entry.name),
             "unknown key" + base::suggestion(entry.name, key_names(kind_)));
  }
}

std::string Table::path(std::string_view name) const {
  if (name.empty()) return path_;
  return path_.empty() ? std::string(name) : path_ + "." + std::string(name);
}

SourcePlace Table::place(std::string_view name) const {
  const toml::node* found = node_->get(name);
  return found ? place_of(*found) : place_;
}

const Key& Table::key(std::string_view name) const {
  const Key* found = find_key(kind_, name);
  if (!found) throw std::logic_error(fmt::format("no key {} in the table of keys under '{}'", name, kind_));
  return *found;
}

const toml::node* Table::raw(std::string_view name) {
  const toml::node* found = node_->get(name);
  if (found) read_.push_back(found);
  return found;
}

const toml::node* Table::value(const Key& key, std::string_view name) {
  if (const toml::node* found = raw(name)) return found;
  if (key.default_value == "required") require(name, "");
  if (key.default_value.empty()) return nullptr;
  return default_of(key);
}

double Table::number(std::string_view name) {
  require(name, "");
  return *optional_number(name);
}

std::optional<double> Table::optional_number(std::string_view name) {
  const Key& row = key(name);
  const toml::node* found = value(row, name);
  if (!found) return std::nullopt;
  const auto finite = finite_value(*found);
  const double result = finite ? *finite : finite_number(*found, path(name), describe_type(row));
  if (!in_range(row.type, result)) wrong(name, describe_type(row));
  record_.set(name, toml_number(result));
  return result;
}

int Table::integer(std::string_view name) {
  const Key& row = key(name);
  const toml::node* found = value(row, name);
  const auto* number = found ? found->as_integer() : nullptr;
  if (!number || number->get() < INT_MIN || number->get() > INT_MAX ||
      !in_range(row.type, static_cast<double>(number->get()))) {
    wrong(name, describe_type(row));
  }
  record_.set(name, fmt::format("{}", number->get()));
  return static_cast<int>(number->get());
}

bool Table::flag(std::string_view name) {
  const Key& row = key(name);
  const toml::node* found = value(row, name);
  if (!found || !found->is_boolean()) wrong(name, describe_type(row));
  const bool result = found->value_or(false);
  record_.set(name, result ? "true" : "false");
  return result;
}

std::string Table::text(std::string_view name) {
  require(name, "");
  return *optional_text(name);
}

std::optional<std::string> Table::optional_text(std::string_view name) {
  const Key& row = key(name);
  const toml::node* found = value(row, name);
  if (!found) return std::nullopt;
  if (!found->is_string()) wrong(name, describe_type(row));
  const std::string& result = found->as_string()->get();
  if (row.type == KeyType::name)
    (name == "name" ? check_name : check_reference)(result, place_of(*found), path(name));
  record_.set(name, toml_string(result));
  return result;
}

std::string Table::choice(std::string_view name) {
  std::string result = text(name);
  const std::vector<std::string> choices = choices_of(key(name));
  if (std::find(choices.begin(), choices.end(), result) == choices.end()) {
    wrong(name, describe_type(key(name)) + base::did_you_mean(result, choices));
  }
  return result;
}

std::array<double, 2> Table::vector(std::string_view name) {
  const Key& row = key(name);
  const toml::node* found = value(row, name);
  if (!found) require(name, "");
  const std::string expected = "an array of two numbers [x, y]";
  const std::vector<double> values = number_array(*found, path(name), expected);
  if (values.size() != 2) wrong(name, expected);
  record_.set(name, toml_numbers(values));
  return {values[0], values[1]};
}

std::optional<std::vector<double>> Table::numbers(std::string_view name) {
  const Key& row = key(name);
  const toml::node* found = value(row, name);
  if (!found) return std::nullopt;
  std::vector<double> values = number_array(*found, path(name), describe_type(row));
  record_.set(name, toml_numbers(values));
  return values;
}

std::vector<std::string> Table::texts(std::string_view name) {
  const Key& row = key(name);
  const toml::node* found = value(row, name);
  if (!found) return {};
  const toml::array* array = found->as_array();
  if (!array) wrong(name, describe_type(row));
  std::vector<std::string> result;
  for (const toml::node& item : *array) {
    if (!item.is_string()) {
      refuse(place_of(item), path(name), "found " + describe(item) + ", expected a string");
    }
    result.push_back(item.as_string()->get());
  }
  record_.set(name, toml_strings(result));
  return result;
}

Table Table::child(std::string_view name) {
  const toml::node* found = raw(name);
  if (found && !found->is_table()) wrong(name, describe_type(key(name)));
  const std::string kind = kind_.empty() ? std::string(name) : kind_ + "." + std::string(name);
  return {found ? found->as_table() : nullptr, kind, path(name), place(name)};
}

void Table::require(std::string_view name, const std::string& why) {
  const Key& row = key(name);
  if (has(name) || (!row.default_value.empty() && row.default_value != "required")) return;
  refuse(place_, path(name), fmt::format("missing{}, expected {}", why, describe_type(row)));
}

void Table::wrong(std::string_view name, const std::string& expected) const {
  const toml::node* found = node_->get(name);
  fail(name, (found ? "found " + describe(*found) : "missing") + ", expected " + expected);
}

void Table::fail(std::string_view name, const std::string& message) const {
  refuse(place(name), path(name), message);
}

void Table::finish(const std::string& why) const {
  std::vector<const toml::node*> read = read_;
  std::sort(read.begin(), read.end(), std::less<>());
  const auto is_read = [&](const toml::node& value) {
    return std::binary_search(read.begin(), read.end(), &value, std::less<>());
  };
  bool whole = true;
  for (const auto& [name, value] : *node_) whole = whole && is_read(value);
  if (whole) return;
  for (const Entry& entry : entries_of(*node_))
    if (!is_read(*entry.node)) refuse(entry.place(), path(entry.name), why);
}

ResolvedTable Table::record() const {
  std::vector<std::string> order;
  for (const Entry& entry : entries_of(*node_)) order.push_back(entry.name);
  return record_.arranged(order);
}

std::vector<Table> tables_of(Table& top, std::string_view key) {
  std::vector<Table> result;
  const toml::node* found = top.raw(key);
  if (!found) return result;
  const std::string expected = fmt::format("tables under [[{}]]", key);
  const toml::array* array = found->as_array();
  if (!array) top.wrong(key, expected);
  for (const toml::node& item : *array) {
    if (!item.is_table()) {
      refuse(place_of(item), std::string(key), "found " + describe(item) + ", expected " + expected);
    }
    const std::optional<std::string> name = (*item.as_table())["name"].value<std::string>();
    const std::string label = name && !name->empty() ? *name : fmt::format("{}", result.size() + 1);
    result.emplace_back(item.as_table(), fmt::format("{}[]", key), fmt::format("{}.{}", key, label),
                        place_of(item));
  }
  return result;
}

}  // namespace signorini::scene
