#pragma once

#include <cstdint>

namespace quartet {

/// The t that a Student variable with so many degrees of freedom, at least 1, stays below with
/// probability 0.975; relative error below 1e-8.
double student_t_975(std::uint32_t freedom);

/// The x that a chi-square variable with so many degrees of freedom, at least 1, stays below with
/// probability 0.05; relative error below 1e-7.
double chi_square_05(std::uint32_t freedom);

}  // namespace quartet
