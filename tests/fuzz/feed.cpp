#include "tests/fuzz/feed.h"

#include <fmt/format.h>

#include <fstream>

#include "tests/files/temp_folder.h"

namespace quartet {

void promise(bool kept, const std::string& what) {
  if (!kept) {
    throw BrokenPromise(what);
  }
}

void promise_message(std::string_view message, std::string_view subject) {
  promise(!message.empty(), "an error says nothing");
  promise(message.find('\n') == std::string_view::npos,
          fmt::format("an error has more than one line: {}", message));
  promise(message.find(subject) != std::string_view::npos,
          fmt::format("an error does not say that it is about {}: {}", subject, message));
}

std::filesystem::path scratch_file(std::string_view name, std::string_view bytes) {
  static const TempFolder folder;
  std::filesystem::path path = folder / std::string(name);
  std::ofstream file(path, std::ios::binary);
  file.write(bytes.data(), std::streamsize(bytes.size()));
  file.close();
  if (!file) {
    throw std::runtime_error(fmt::format("cannot write {}", path.string()));
  }
  return path;
}

}  // namespace quartet
