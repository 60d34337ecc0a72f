// runs.hpp: the scenes of this folder through an engine, and what their rows and events say.
#pragma once

#include <optional>

#include "published/figure.hpp"

namespace signorini::published {

/// Runs a scene of this folder (or, with a slash, of a path). Throws std::runtime_error where it stops early.
[[nodiscard]] Result run(const std::string& scene, const Settings& settings,
                         std::vector<Override> changes = {});

/// The n-th event (from 0) of this type; nullptr where there are fewer.
[[nodiscard]] const Event* nth(const Result& result, EventType type, std::size_t n);
/// Its time, or `missing`.
[[nodiscard]] double time_of(const Result& result, EventType type, std::size_t n);
/// The row at an output time; throws std::runtime_error where there is none within rounding.
[[nodiscard]] const Result::Row& row_at(const Result& result, double t);

/// "[a, b]" with all digits, for --set.
[[nodiscard]] std::string list(const std::vector<double>& values);

}  // namespace signorini::published
