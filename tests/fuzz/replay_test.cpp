#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <string>
#include <vector>

#include "tests/files/temp_folder.h"
#include "tests/fuzz/feed.h"

namespace quartet {
namespace {

struct CorpusReader {
  const char* name;  ///< of the folder with its inputs
  void (*feed)(std::string_view input);
};

class FuzzCorpus : public testing::TestWithParam<CorpusReader> {};

/// What fuzzing found worth keeping: inputs that reach different code, and those that broke it.
TEST_P(FuzzCorpus, IsReadOrRefused) {
  const std::filesystem::path folder = std::filesystem::path(QUARTET_FUZZ_CORPUS) / GetParam().name;
  std::size_t inputs = 0;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    ++inputs;
    EXPECT_NO_THROW(GetParam().feed(bytes_of(entry.path()))) << entry.path();
  }
  EXPECT_GT(inputs, 0u) << folder;
}

INSTANTIATE_TEST_SUITE_P(
    Readers, FuzzCorpus,
    testing::Values(CorpusReader{"scene", feed_scene}, CorpusReader{"obj", feed_obj},
                    CorpusReader{"exr", feed_exr}, CorpusReader{"png", feed_png},
                    CorpusReader{"pfm", feed_pfm}, CorpusReader{"hdr", feed_hdr},
                    CorpusReader{"reference", feed_reference},
                    CorpusReader{"settings", feed_settings}, CorpusReader{"words", feed_words}),
    [](const auto& reader) { return std::string(reader.param.name); });

}  // namespace
}  // namespace quartet
