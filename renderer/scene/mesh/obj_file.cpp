#include "renderer/scene/mesh/obj_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cstdint>
#include <stdexcept>
#include <string_view>
#include <utility>

#include "renderer/base/cancel.h"
#include "renderer/base/excerpt.h"
#include "renderer/base/printable.h"
#include "renderer/base/regular_file.h"
#include "renderer/scene/limits.h"
#include "renderer/scene/mesh/corner_table.h"
#include "renderer/scene/mesh/polygon.h"
#include "renderer/scene/xml/number.h"

namespace quartet {
namespace {

constexpr std::size_t largest_mesh_file = std::size_t(4) << 30;  // bytes
constexpr std::size_t most_rows = 3 * most_triangles;            // of v, vt and vn, each

/// The words of a line between white space.
class Words {
 public:
  explicit Words(std::string_view line) : rest_(line) {}

  /// Empty behind the last one.
  std::string_view next() {
    constexpr std::string_view space = " \t\v\f";
    rest_.remove_prefix(std::min(rest_.find_first_not_of(space), rest_.size()));
    const std::string_view word = rest_.substr(0, rest_.find_first_of(space));
    rest_.remove_prefix(word.size());
    return word;
  }

 private:
  std::string_view rest_;
};

struct Face {
  std::size_t first_corner;
  int line;
};

/// Something that is told once for a whole file: how often, and where first.
struct Occurrence {
  std::size_t count = 0;
  int line = 0;
  std::string word;

  void add(int at, std::string_view what = {}) {
    if (count++ == 0) {
      line = at;
      word = excerpt(what);
    }
  }
};

class ObjReader {
 public:
  ObjReader(const std::filesystem::path& path, const std::stop_token& stop)
      : name_(printable(path.string())), stop_(stop), tick_(stop), vertices_(stop) {}

  void read(std::string_view text);
  ObjFile finish();

 private:
  [[noreturn]] void fail(int line, std::string_view message) const {
    throw std::runtime_error(fmt::format("{}:{}: {}", name_, line, message));
  }

  void read_line(std::string_view line);
  void read_row(std::string_view keyword, Words words, std::size_t least, std::size_t most,
                std::vector<float>& rows, std::size_t width);
  void read_face(Words words);
  FaceCorner read_corner(std::string_view word);
  std::int32_t read_index(std::string_view digits, std::string_view word, std::size_t kind);
  void check_indices() const;
  unsigned vertex(const FaceCorner& corner);
  void cut(const Face& face, std::size_t end);

  std::string name_;
  std::stop_token stop_;
  CancelTick tick_;
  int line_ = 0;
  std::array<std::vector<float>, 3> rows_;  // 3 floats a position, 2 a uv, 3 a normal
  std::vector<FaceCorner> corners_;
  std::vector<Face> faces_;
  std::size_t triangles_ = 0;
  // The largest index of each kind and its line: a face may use what stands below it.
  std::array<std::int32_t, 3> largest_index_{-1, -1, -1};
  std::array<int, 3> line_of_largest_{};
  Occurrence left_out_, small_, crossing_;

  CornerTable vertices_;
  bool has_uvs_ = true;
  bool has_normals_ = true;
  Mesh mesh_;
};

struct RowKind {
  std::string_view keyword;
  std::string_view name;
  std::size_t width;        // floats that count
  std::size_t least, most;  // that may stand there
};

// Behind a position may stand a weight, or a colour and more; behind a uv a depth.
constexpr std::array row_kinds = {
    RowKind{"v", "vertex", 3, 3, 7},
    RowKind{"vt", "uv", 2, 2, 3},
    RowKind{"vn", "normal", 3, 3, 3},
};

/// What says nothing of the shape.
constexpr std::array<std::string_view, 14> harmless = {
    "o",      "g",   "s",     "mg",       "usemtl",   "mtllib",     "usemap",
    "maplib", "lod", "bevel", "c_interp", "d_interp", "shadow_obj", "trace_obj"};

void ObjReader::read(std::string_view text) {
  constexpr std::string_view byte_order_mark = "\xef\xbb\xbf";
  if (text.starts_with(byte_order_mark)) {
    text.remove_prefix(byte_order_mark.size());
  }
  std::string joined;  // lines that end in a backslash, and what follows
  int next_line = 1;
  while (!text.empty()) {
    tick_();
    const std::size_t end = std::min(text.find_first_of("\r\n"), text.size());
    std::string_view line = text.substr(0, end);
    text.remove_prefix(std::min(end + (text.substr(end).starts_with("\r\n") ? 2 : 1), text.size()));
    line_ = joined.empty() ? next_line : line_;
    ++next_line;
    if (line.ends_with('\\') && line.find('#') == std::string_view::npos) {
      line.remove_suffix(1);
      joined.append(line).append(1, ' ');
      continue;
    }
    if (!joined.empty()) {
      joined.append(line);
      line = joined;
    }
    read_line(line.substr(0, line.find('#')));
    joined.clear();
  }
  if (!joined.empty()) {
    read_line(joined);
  }
}

void ObjReader::read_line(std::string_view line) {
  Words words(line);
  const std::string_view keyword = words.next();
  if (keyword.empty()) {
    return;
  }
  if (keyword == "f") {
    read_face(words);
    return;
  }
  for (std::size_t kind = 0; kind < row_kinds.size(); ++kind) {
    const RowKind& row = row_kinds[kind];
    if (keyword == row.keyword) {
      read_row(keyword, words, row.least, row.most, rows_[kind], row.width);
      return;
    }
  }
  if (std::find(harmless.begin(), harmless.end(), keyword) == harmless.end()) {
    left_out_.add(line_, keyword);
  }
}

void ObjReader::read_row(std::string_view keyword, Words words, std::size_t least, std::size_t most,
                         std::vector<float>& rows, std::size_t width) {
  std::size_t count = 0;
  for (std::string_view word = words.next(); !word.empty(); word = words.next()) {
    tick_();
    const std::optional<float> number = parse_float(word);
    if (!number) {
      fail(line_, fmt::format("'{}' is not a finite number", excerpt(word)));
    }
    if (count < width) {
      rows.push_back(*number);
    }
    ++count;
  }
  if (count < least || count > most) {
    fail(line_, fmt::format("'{}' has {} numbers, expected {}{}", keyword, count, least,
                            most > least ? fmt::format(" to {}", most) : ""));
  }
  if (rows.size() > most_rows * width) {
    fail(line_, fmt::format("more than {} lines of '{}', which is the limit", most_rows, keyword));
  }
}

void ObjReader::read_face(Words words) {
  const std::size_t first = corners_.size();
  for (std::string_view word = words.next(); !word.empty(); word = words.next()) {
    tick_();
    corners_.push_back(read_corner(word));
  }
  const std::size_t count = corners_.size() - first;
  if (count < 3) {
    small_.add(line_);
    corners_.resize(first);
    return;
  }
  triangles_ += count - 2;
  if (triangles_ > most_triangles) {
    fail(line_, fmt::format("more than {} triangles, which is the limit", most_triangles));
  }
  faces_.push_back({first, line_});
}

/// "v", "v/vt", "v//vn" or "v/vt/vn".
FaceCorner ObjReader::read_corner(std::string_view word) {
  FaceCorner corner;
  std::string_view rest = word;
  for (std::size_t kind = 0; kind < 3; ++kind) {
    const std::size_t slash = rest.find('/');
    const std::string_view digits = rest.substr(0, slash);
    const bool last = slash == std::string_view::npos;
    // Only a uv may be missing between two slashes.
    if (!(digits.empty() && kind == 1 && !last)) {
      corner.rows[kind] = read_index(digits, word, kind);
    }
    if (last) {
      return corner;
    }
    rest.remove_prefix(slash + 1);
  }
  fail(line_, fmt::format("'{}' is no corner of a face, expected v, v/vt, v//vn or v/vt/vn",
                          excerpt(word)));
}

std::int32_t ObjReader::read_index(std::string_view digits, std::string_view word,
                                   std::size_t kind) {
  std::int32_t index = 0;
  const char* const end = digits.data() + digits.size();
  const auto [stop, error] = std::from_chars(digits.data(), end, index);
  if (error != std::errc() || stop != end || index == 0) {
    fail(line_, fmt::format("'{}' is no corner of a face, expected whole numbers from 1, or below "
                            "0 to count backwards, as v, v/vt, v//vn or v/vt/vn",
                            excerpt(word)));
  }
  const std::size_t there = rows_[kind].size() / row_kinds[kind].width;
  if (index > 0) {
    --index;
  } else if (std::int64_t(there) + index < 0) {
    fail(line_, fmt::format("a face uses {} {}, there are {} above it", row_kinds[kind].name, index,
                            there));
  } else {
    index += std::int32_t(there);
  }
  if (index > largest_index_[kind]) {
    largest_index_[kind] = index;
    line_of_largest_[kind] = line_;
  }
  return index;
}

void ObjReader::check_indices() const {
  for (std::size_t kind = 0; kind < 3; ++kind) {
    const std::size_t there = rows_[kind].size() / row_kinds[kind].width;
    if (largest_index_[kind] >= 0 && std::size_t(largest_index_[kind]) >= there) {
      fail(line_of_largest_[kind],
           fmt::format("a face uses {} {}, the file has {}", row_kinds[kind].name,
                       std::int64_t(largest_index_[kind]) + 1, there));
    }
  }
}

unsigned ObjReader::vertex(const FaceCorner& corner) {
  const auto [number, is_new] = vertices_.number_of(corner);
  if (is_new) {
    const auto& [v, vt, vn] = corner.rows;
    const float* const position = &rows_[0][std::size_t(v) * 3];
    mesh_.positions.emplace_back(position[0], position[1], position[2]);
    has_uvs_ = has_uvs_ && vt >= 0;
    has_normals_ = has_normals_ && vn >= 0;
    if (has_uvs_) {
      const float* const uv = &rows_[1][std::size_t(vt) * 2];
      mesh_.uvs.emplace_back(uv[0], uv[1]);
    }
    if (has_normals_) {
      const float* const normal = &rows_[2][std::size_t(vn) * 3];
      mesh_.normals.emplace_back(normal[0], normal[1], normal[2]);
    }
  }
  return number;
}

void ObjReader::cut(const Face& face, std::size_t end) {
  const std::span<const FaceCorner> corners(corners_.data() + face.first_corner,
                                            end - face.first_corner);
  std::vector<glm::vec3> positions;
  positions.reserve(corners.size());
  for (const FaceCorner& corner : corners) {
    const float* const p = &rows_[0][std::size_t(corner.rows[0]) * 3];
    positions.emplace_back(p[0], p[1], p[2]);
  }
  std::vector<glm::uvec3> triangles;
  switch (cut_polygon(positions, triangles, stop_)) {
    case PolygonCut::whole:
      break;
    case PolygonCut::crossing:
      crossing_.add(face.line);
      break;
    case PolygonCut::too_many:
      fail(face.line,
           fmt::format("a face of {} corners that is not convex, at most {} are possible",
                       corners.size(), most_concave_corners));
  }
  for (const glm::uvec3& triangle : triangles) {
    const unsigned a = vertex(corners[triangle.x]);
    const unsigned b = vertex(corners[triangle.y]);
    const unsigned c = vertex(corners[triangle.z]);
    mesh_.triangles.emplace_back(a, b, c);
  }
}

ObjFile ObjReader::finish() {
  check_indices();
  for (std::size_t i = 0; i < faces_.size(); ++i) {
    tick_();
    cut(faces_[i], i + 1 < faces_.size() ? faces_[i + 1].first_corner : corners_.size());
  }
  if (!has_uvs_) mesh_.uvs.clear();
  if (!has_normals_) mesh_.normals.clear();
  ObjFile file;
  if (left_out_.count > 0) {
    file.warnings.push_back(
        fmt::format("{} lines that are no faces of flat surfaces are left out (the first: '{}' in "
                    "line {})",
                    left_out_.count, left_out_.word, left_out_.line));
  }
  if (small_.count > 0) {
    file.warnings.push_back(
        fmt::format("{} faces of fewer than 3 corners are left out (the first "
                    "in line {})",
                    small_.count, small_.line));
  }
  if (crossing_.count > 0) {
    file.warnings.push_back(
        fmt::format("{} faces cross themselves or enclose nothing and are cut "
                    "as their corners come (the first in line {})",
                    crossing_.count, crossing_.line));
  }
  file.mesh = std::move(mesh_);
  return file;
}

}  // namespace

ObjFile read_obj(const std::filesystem::path& path, const std::stop_token& stop) {
  ObjReader reader(path, stop);
  reader.read(read_regular_file(path, largest_mesh_file, stop));
  return reader.finish();
}

}  // namespace quartet
