#pragma once

#include <fmt/format.h>

#include <span>
#include <stdexcept>
#include <string>
#include <string_view>

namespace quartet {

/// The row of a table whose `id` is the one asked for. Throws std::runtime_error that names what is
/// unknown and lists the legal ids, out of the same table.
template <class Row>
const Row& row_from_id(std::span<const Row> rows, std::string_view id, std::string_view noun) {
  std::string legal;
  for (const Row& row : rows) {
    if (row.id == id) {
      return row;
    }
    legal += (legal.empty() ? "" : ", ");
    legal += row.id;
  }
  throw std::runtime_error(fmt::format("unknown {} '{}'; legal are: {}", noun, id, legal));
}

}  // namespace quartet
