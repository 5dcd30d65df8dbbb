#include "renderer/adaptive/run_lab.h"

#include "renderer/adaptive/lab.h"

namespace quartet {

bool run_lab(Lab& lab, const std::stop_token& stop, const std::function<bool()>& after_pass) {
  do {
    if (stop.stop_requested() || !lab.run_pass(stop) || stop.stop_requested()) {
      return false;
    }
  } while (after_pass());
  return true;
}

}  // namespace quartet
