#pragma once

#include <fmt/format.h>

#include <span>
#include <string>
#include <string_view>

#include "ui/widgets/widgets.h"

namespace quartet {

/// What combo() opens for a table: a row of the box for each of the table's, which has a key, an id
/// and a label, and `tip`, if one is given, as its tooltip. Returns whether another key was chosen.
template <class Row, class Key>
bool table_rows(Ui& ui, const std::string& name, std::span<const Row> table, Key& chosen,
                std::string_view Row::*tip = nullptr) {
  bool changed = false;
  for (const Row& row : table) {
    if (combo_row(ui, fmt::format("{}.{}", name, row.id), std::string(row.label), row.key == chosen,
                  tip ? std::string(row.*tip) : std::string())) {
      chosen = row.key;
      changed = true;
    }
  }
  return changed;
}

}  // namespace quartet
