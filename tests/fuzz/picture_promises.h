#pragma once

#include <filesystem>
#include <string_view>

#include "renderer/files/picture.h"
#include "tests/fuzz/feed.h"

namespace quartet {

/// The picture in this file is refused with a message that names it, or it is one.
inline void promise_picture(const std::filesystem::path& path, std::string_view name) {
  succeeds<std::runtime_error>(name, [&] {
    const Picture picture = read_picture(path);
    promise(!picture.image.empty(), "a picture has no pixels");
    promise(picture.left >= 0 && picture.top >= 0 &&
                picture.left + picture.image.width() <= picture.width &&
                picture.top + picture.image.height() <= picture.height,
            "pixels of a picture lie outside of it");
    for (const std::string& note : picture.notes) {
      promise_message(note, "");
    }
  });
}

}  // namespace quartet
