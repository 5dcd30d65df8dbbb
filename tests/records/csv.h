#pragma once

#include <algorithm>
#include <set>
#include <sstream>
#include <string>
#include <vector>

namespace quartet {

inline std::vector<std::vector<std::string>> rows_of(const std::string& csv) {
  std::vector<std::vector<std::string>> rows;
  std::istringstream lines(csv);
  for (std::string line; std::getline(lines, line);) {
    std::vector<std::string> fields;
    std::istringstream words(line);
    for (std::string word; std::getline(words, word, ',');) {
      fields.push_back(word);
    }
    rows.push_back(fields);
  }
  return rows;
}

/// Without what no two runs have in common: the column of seconds, and the metrics made of them.
inline std::vector<std::vector<std::string>> without_seconds(const std::string& csv) {
  static const std::set<std::string> timed{"seconds", "efficiency", "equal_time_error"};
  std::vector<std::vector<std::string>> rows = rows_of(csv);
  const auto column = [&](const std::string& name) {
    return std::size_t(std::ranges::find(rows.front(), name) - rows.front().begin());
  };
  const std::size_t seconds = column("seconds");
  const std::size_t metric = column("metric");
  std::erase_if(rows, [&](const std::vector<std::string>& row) {
    return metric < row.size() && timed.contains(row[metric]);
  });
  for (std::vector<std::string>& row : rows) {
    if (seconds < row.size()) {
      row.erase(row.begin() + std::ptrdiff_t(seconds));
    }
  }
  return rows;
}

}  // namespace quartet
