#include "result/trace_writer.hpp"

#include <cerrno>

#include "base/input_file.hpp"
#include "base/json.hpp"
#include "base/output_directory.hpp"

#include "signorini/error.hpp"

namespace signorini {
namespace {

Json names(const std::vector<NamedGuard>& guards, const Model& model, bool with_signs) {
  Json result = Json::array();
  for (const NamedGuard& g : guards) {
    result.push_back({{"contact", model.contacts[g.contact].name}, {"guard", g.guard}});
    if (with_signs) result.back().update({{"order", g.order}, {"excess", g.excess}});
  }
  return result;
}

}  // namespace

TraceWriter::TraceWriter(const std::filesystem::path& path, const Model& model) : model_(model), path_(path) {
  check_output_file(path, "trace", R"(,"round":1,"fired":[)");
  errno = 0;
  file_.open(path);
  if (!file_) throw FileError(path.string(), "cannot be created" + because(errno));
}

void TraceWriter::write(const Round& round) {
  Json touching = Json::array(), tried = Json::object();
  for (const std::size_t c : round.touching) touching.push_back(model_.contacts[c].name);
  for (std::size_t c = 0; c < round.tried.size(); ++c)
    tried[model_.contacts[c].name] = to_string(round.tried[c].state);
  const Json line = {{"t", round.t},
                     {"round", round.number},
                     {"fired", names(round.fired, model_, false)},
                     {"touching", touching},
                     {"impact", round.impact},
                     {"tried", tried},
                     {"failed", names(round.failed, model_, true)},
                     {"holds", round.failed.empty()}};
  file_ << json_line(line) << std::endl;
  if (!file_) throw FileError(path_.string(), "cannot be written");
}

}  // namespace signorini
