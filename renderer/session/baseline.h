#pragma once

#include <span>

#include "renderer/adaptive/pass_history.h"

namespace quartet {

/// Whether uniform sampling, at the end of a pass, can be compared with lanes that are at theirs:
/// it has taken as many samples and rays as each of them, and as many seconds. Where seconds ask
/// for more than a quarter more samples they are not waited for: they are measured, and a pass of a
/// lane that the machine held up would ask for samples without end.
bool is_enough(const PassRecord& uniform, std::span<const PassRecord> lanes);

}  // namespace quartet
