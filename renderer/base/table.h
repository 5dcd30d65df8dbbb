#pragma once

#include <fmt/format.h>

#include <cassert>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace quartet {

/// The ids of a table's rows, separated by commas.
template <class Row>
std::string row_ids(std::span<const Row> table) {
  std::string names;
  for (const Row& row : table) {
    names += names.empty() ? "" : ", ";
    names += row.id;
  }
  return names;
}

/// The row with this id. Throws std::invalid_argument that lists the legal ids; `what` says of what
/// the table is.
template <class Row>
const Row& find_row(std::span<const Row> table, std::string_view id, std::string_view what) {
  for (const Row& row : table) {
    if (row.id == id) {
      return row;
    }
  }
  throw std::invalid_argument(
      fmt::format("unknown {} '{}'; there are: {}", what, id, row_ids(table)));
}

/// The table of an enumeration's rows, in the order of its enumerators, which count from 0.
/// `row_of_key` is a switch without a default, so that the compiler names an enumerator without a
/// row, and returns null for what is none.
template <class Row, class Key>
std::vector<Row> table_of(const Row* (*row_of_key)(Key key)) {
  std::vector<Row> table;
  while (const Row* const row = row_of_key(Key(table.size()))) {
    assert(row->key == Key(table.size()));
    table.push_back(*row);
  }
  return table;
}

/// The row with this key, an enumerator.
template <class Row, class Key>
const Row& row_of(std::span<const Row> table, Key key) {
  for (const Row& row : table) {
    if (row.key == key) {
      return row;
    }
  }
  assert(!"a key without a row");
  return table.front();
}

}  // namespace quartet
