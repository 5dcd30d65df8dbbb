#pragma once

#include <algorithm>
#include <utility>
#include <vector>

namespace quartet {

/// Appends what is not in the list yet: a user may name a thing twice.
template <class T>
void add_once(std::vector<T>& list, T value) {
  if (std::ranges::find(list, value) == list.end()) {
    list.push_back(std::move(value));
  }
}

}  // namespace quartet
