#include "renderer/base/version.h"

namespace quartet {

std::string_view version() {
  return QUARTET_VERSION;
}

}  // namespace quartet
