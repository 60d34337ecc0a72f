// witness_json.hpp: results of a witness, for summary.json and `signorini witness --json`.
#pragma once

#include "base/json.hpp"
#include "signorini/result.hpp"

namespace signorini {

/// {"checked", "violated", "violations": [{"t", "event", "contact", "law", "value", "limit"}, ...]}
[[nodiscard]] Json witness_json(const Model& model, const Testimony& witness);

}  // namespace signorini
