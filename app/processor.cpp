// Stops with a message, instead of an illegal instruction, on a processor older than the build.
//
// CMake compiles this file, and it alone, for plain x86-64. It must call nothing but C functions of
// shared libraries: an inline function of a C++ header could be linked in the copy that another
// file compiled for x86-64-v3.

#include <cstdio>
#include <cstdlib>
#include <cstring>

namespace {

// Priority 101 is the first one open to programs: it comes before the constructors of all globals,
// which may already use the newer instructions.
__attribute__((constructor(101))) void check_processor() {
  // A native build is for the machine it was built on.
  if (std::strcmp(QUARTET_ARCH, "x86-64-v3") != 0) return;
  __builtin_cpu_init();
  // Of the features of x86-64-v3 those that both GCC and Clang can ask for by name; no processor
  // has these without the others (F16C, LZCNT, MOVBE).
  const bool avx2 = __builtin_cpu_supports("avx2");
  const bool fma = __builtin_cpu_supports("fma");
  const bool bmi = __builtin_cpu_supports("bmi");
  const bool bmi2 = __builtin_cpu_supports("bmi2");
  if (avx2 && fma && bmi && bmi2) return;
  std::fprintf(
      stderr,
      "quartet: this processor lacks%s%s%s%s, which a build for x86-64-v3 needs; build for "
      "this processor with: QUARTET_PRESET=native ./quartet\n",
      avx2 ? "" : " AVX2", fma ? "" : " FMA", bmi ? "" : " BMI1", bmi2 ? "" : " BMI2");
  std::_Exit(1);
}

}  // namespace
