#pragma once

#include <exception>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <string_view>

namespace quartet {

/// Each of these gives one reader whatever bytes there are, as a file or as words, and checks what
/// comes out of it. What it does not return from is a fault: a crash, an exception that the reader
/// does not document, or a BrokenPromise. libFuzzer looks for such bytes, and replay_test.cpp
/// repeats what it found.
void feed_scene(std::string_view input);
void feed_obj(std::string_view input);
void feed_exr(std::string_view input);
void feed_png(std::string_view input);
void feed_pfm(std::string_view input);
void feed_hdr(std::string_view input);
void feed_reference(std::string_view input);
void feed_settings(std::string_view input);
void feed_words(std::string_view input);

/// A reader took what it should have refused, or did not say why it refused it.
struct BrokenPromise : std::logic_error {
  using std::logic_error::logic_error;
};

void promise(bool kept, const std::string& what);

/// A message for people is one line that says something, and names `subject`.
void promise_message(std::string_view message, std::string_view subject);

/// The path of a file of that name with these bytes, in a folder of this process. The next one of
/// the same name replaces it.
std::filesystem::path scratch_file(std::string_view name, std::string_view bytes);

/// Returns whether `action` did what it was to do, and not throw the exception that it documents.
/// Its message has to name `subject`.
template <class Documented, class Action>
bool succeeds(std::string_view subject, Action action) {
  try {
    action();
    return true;
  } catch (const Documented& error) {
    promise_message(error.what(), subject);
    return false;
  }
}

}  // namespace quartet

// Where libFuzzer enters, in a program that has one reader only; the tests have all of them.
#ifdef QUARTET_FUZZ_TARGET
#define QUARTET_FUZZ_ENTRY(feed)                                                        \
  extern "C" int LLVMFuzzerTestOneInput(const unsigned char* bytes, std::size_t size);  \
  extern "C" int LLVMFuzzerTestOneInput(const unsigned char* bytes, std::size_t size) { \
    feed({reinterpret_cast<const char*>(bytes), size});                                 \
    return 0;                                                                           \
  }
#else
#define QUARTET_FUZZ_ENTRY(feed)
#endif
