#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "renderer/base/interval.h"

namespace quartet {

/// JSON is UTF-8, and paths are any bytes: those that are no UTF-8 become U+FFFD. A command line
/// loses nothing by it, because shell_word() leaves none of them.
inline std::string json_text(const nlohmann::ordered_json& json) {
  return json.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
}

/// Its ends are null where nothing is known of them.
inline nlohmann::ordered_json interval_json(const Interval& interval) {
  return {{"mean", interval.mean}, {"low", interval.low}, {"high", interval.high}};
}

}  // namespace quartet
