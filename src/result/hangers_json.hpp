// hangers_json.hpp: springs with a preload, in check and summary.json.
#pragma once

#include "base/json.hpp"
#include "model/outputs/hangers.hpp"

namespace signorini {

inline Json hangers_json(const Model& model) {
  Json list = Json::array();
  for (const HangerLoad& hanger : model.hangers) {
    Json json = {{"spring", hanger.spring}, {"cold", hanger.cold}, {"at_start", hanger.at_start}};
    if (hanger.hot) json["hot"] = *hanger.hot;
    if (hanger.at_start != 0.0) json["variability"] = variability(hanger);
    list.push_back(std::move(json));
  }
  return list;
}

}  // namespace signorini
