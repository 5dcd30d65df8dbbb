#pragma once

#include "app/commands.h"

namespace quartet {

/// As in commands.h: the commands that run many experiments and say what they show together.
void add_bias_command(CLI::App& app, const Program& program);
void add_stability_command(CLI::App& app, const Program& program);

}  // namespace quartet
