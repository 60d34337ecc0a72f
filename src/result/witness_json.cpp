#include "result/witness_json.hpp"

namespace signorini {

Json witness_json(const Model& model, const Testimony& witness) {
  Json list = Json::array();
  for (const Violation& v : witness.violations)
    list.push_back(
        {{"t", v.t},
         {"event", v.event},
         {"contact", v.contact < 0 ? Json() : Json(model.contacts[static_cast<std::size_t>(v.contact)].name)},
         {"law", v.law},
         {"value", v.value},
         {"limit", v.limit}});
  return {{"checked", witness.checked}, {"violated", witness.violated}, {"violations", list}};
}

}  // namespace signorini
