// Progressive meshes as files, .tspm, little endian:
//
//   "TSPM", u32 version (1)
//   u32 attributes, of each: u8 kind (0 colour, 1 normal, 2 scalar), u16 length of its name, the name
//   u32 vertices and u32 triangles of the base, u64 splits
//   base vertices: u32 original number, 3 f64 position, f32 values of all attributes
//   base triangles: u32 original number, 3 u32 vertices
//   u64 checksum
//   blocks of up to 1024 splits, each followed by a u64 checksum. A split: u8 vertices (0 to 2), u8 triangles (1 or
//   2);
//     of each vertex: u32 parent, then as in the base, then u32 n and n u32 triangles that change hands;
//     of each triangle: as in the base
//
// A checksum is FNV-1a (64 bits) of all bytes since the one before, checksums left out. What is read of a file is
// thus proportional to the resolution asked for.

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <string>

#include "io/input_file.hpp"
#include "io/output_file.hpp"
#include "tinsmith/progressive.hpp"

namespace tinsmith {

namespace {

static_assert(std::endian::native == std::endian::little, "TSPM is written in the machine's byte order");

constexpr std::uint32_t kMagic = 0x4D505354;  // "TSPM"
constexpr std::uint32_t kVersion = 1;
constexpr std::size_t kSplitsInBlock = 1024;
constexpr std::uint64_t kFnvStart = 0xCBF29CE484222325;

std::uint64_t fnv(std::uint64_t hash, const void* bytes, std::size_t size) {
  const auto* byte = static_cast<const unsigned char*>(bytes);
  for (std::size_t i = 0; i < size; ++i) hash = (hash ^ byte[i]) * 0x100000001B3;
  return hash;
}

class Writer {
 public:
  explicit Writer(const std::string& path) : file_(path) {}

  void put(const void* bytes, std::size_t size) {
    file_.write(bytes, size);
    hash_ = fnv(hash_, bytes, size);
  }
  template <class T>
  void put(const T& value) {
    put(&value, sizeof value);
  }
  template <class T>
  void put_all(const std::vector<T>& values) {
    put(values.data(), values.size() * sizeof(T));
  }
  void put_checksum() {
    file_.write(&hash_, sizeof hash_);
    hash_ = kFnvStart;
  }
  void commit() { file_.commit(); }

 private:
  OutputFile file_;
  std::uint64_t hash_ = kFnvStart;
};

void put_split(Writer& writer, const VertexSplit& split) {
  writer.put(static_cast<std::uint8_t>(split.vertices.size()));
  writer.put(static_cast<std::uint8_t>(split.triangles.size()));
  for (const VertexSplit::Vertex& vertex : split.vertices) {
    writer.put(vertex.parent);
    writer.put(vertex.original);
    writer.put(vertex.position);
    writer.put_all(vertex.values);
    writer.put(static_cast<std::uint32_t>(vertex.triangles.size()));
    writer.put_all(vertex.triangles);
  }
  for (const VertexSplit::Triangle& triangle : split.triangles) {
    writer.put(triangle.original);
    writer.put(triangle.corners);
  }
}

void put_base(Writer& writer, const ProgressiveSurface& progressive) {
  const Surface& base = progressive.base;
  for (std::size_t v = 0; v < base.position.size(); ++v) {
    writer.put(progressive.original_vertex[v]);
    writer.put(base.position[v]);
    for (const SurfaceAttribute& attribute : base.attributes) {
      const auto n = static_cast<std::size_t>(attribute.components());
      writer.put(attribute.values.data() + v * n, n * sizeof(float));
    }
  }
  for (std::size_t t = 0; t < base.triangles.size(); ++t) {
    writer.put(progressive.original_triangle[t]);
    writer.put(base.triangles[t]);
  }
}

class Reader {
 public:
  explicit Reader(const std::string& path) : file_(path) {}

  ProgressiveSurface read(double max_triangles) {
    require(get<std::uint32_t>() == kMagic, "not a progressive mesh (.tspm)");
    require(get<std::uint32_t>() == kVersion, "a version of .tspm that this program doesn't know; use a newer one");
    ProgressiveSurface result;
    read_attributes(result.base);
    n_vertices_ = get<std::uint32_t>();
    n_triangles_ = get<std::uint32_t>();
    const auto n_splits = get<std::uint64_t>();
    require(n_vertices_ <= file_.left() / sizeof(std::array<double, 3>) &&
                n_triangles_ <= file_.left() / sizeof(std::array<std::uint32_t, 4>) && n_splits <= file_.left(),
            "more is announced than the file holds");
    read_base(result);
    read_checksum();
    for (std::uint64_t i = 0; i < n_splits; ++i) {
      VertexSplit split = read_split();
      if (static_cast<double>(n_triangles_) > max_triangles) return result;
      result.splits.push_back(std::move(split));
      if ((i + 1) % kSplitsInBlock == 0 || i + 1 == n_splits) read_checksum();
    }
    require(file_.left() == 0, "bytes after the last split");
    return result;
  }

 private:
  void get(void* bytes, std::size_t size) {
    file_.read(bytes, size);
    hash_ = fnv(hash_, bytes, size);
  }
  template <class T>
  T get() {
    T value;
    get(&value, sizeof value);
    return value;
  }

  void require(bool holds, const char* what) const {
    if (!holds) file_.fail(what);
  }

  void read_checksum() {
    [[maybe_unused]] const bool fits = file_.read<std::uint64_t>() == hash_;
#ifndef FUZZING_BUILD_MODE_UNSAFE_FOR_PRODUCTION  // a fuzzer would not get past it; whoever forges a file does
    require(fits, "the checksum does not fit: the file is damaged");
#endif
    hash_ = kFnvStart;
  }

  void read_attributes(Surface& surface) {
    const auto n = get<std::uint32_t>();
    require(n <= file_.left(), "more attributes than the file holds");
    for (std::uint32_t i = 0; i < n; ++i) {
      const auto kind = get<std::uint8_t>();
      require(kind <= 2, "an attribute of no known kind");
      SurfaceAttribute attribute;
      attribute.kind = static_cast<AttributeKind>(kind);
      attribute.name.resize(get<std::uint16_t>());
      get(attribute.name.data(), attribute.name.size());
      require(attribute.kind == AttributeKind::kScalar || surface.find(attribute.kind) == nullptr,
              "a second colour or normal");
      kinds_.insert(kinds_.end(), static_cast<std::size_t>(attribute.components()), attribute.kind);
      surface.attributes.push_back(std::move(attribute));
    }
  }

  std::array<double, 3> read_position() {
    const auto position = get<std::array<double, 3>>();
    require(std::all_of(position.begin(), position.end(), [](double x) { return std::isfinite(x); }),
            "a vertex at no finite place");
    return position;
  }

  /// Of all attributes of a vertex.
  void read_values(std::vector<float>& values) {
    values.resize(kinds_.size());
    get(values.data(), values.size() * sizeof(float));
    for (std::size_t i = 0; i < values.size(); ++i)
      require(kinds_[i] == AttributeKind::kColour ? values[i] >= 0 && values[i] <= 1 : std::isfinite(values[i]),
              "a colour beyond 0 to 1, or another value that is not finite");
  }

  std::array<std::uint32_t, 3> read_corners() {
    const auto corners = get<std::array<std::uint32_t, 3>>();
    require(std::all_of(corners.begin(), corners.end(), [&](std::uint32_t v) { return v < n_vertices_; }),
            "a triangle with a vertex that isn't there");
    return corners;
  }

  void read_base(ProgressiveSurface& result) {
    std::vector<float> values;
    for (std::uint64_t v = 0; v < n_vertices_; ++v) {
      result.original_vertex.push_back(get<std::uint32_t>());
      result.base.position.push_back(read_position());
      read_values(values);
      auto from = values.begin();
      for (SurfaceAttribute& attribute : result.base.attributes) {
        const auto to = from + attribute.components();
        attribute.values.insert(attribute.values.end(), from, to);
        from = to;
      }
    }
    for (std::uint64_t t = 0; t < n_triangles_; ++t) {
      result.original_triangle.push_back(get<std::uint32_t>());
      result.base.triangles.push_back(read_corners());
    }
  }

  VertexSplit read_split() {
    const auto n_new_vertices = get<std::uint8_t>();
    const auto n_new_triangles = get<std::uint8_t>();
    require(n_new_vertices <= 2 && n_new_triangles >= 1 && n_new_triangles <= 2, "a split that none can be");
    VertexSplit split;
    for (std::uint8_t i = 0; i < n_new_vertices; ++i) split.vertices.push_back(read_vertex());
    for (std::uint8_t i = 0; i < n_new_triangles; ++i) {
      const auto original = get<std::uint32_t>();
      split.triangles.push_back({original, read_corners()});
    }
    n_triangles_ += n_new_triangles;
    return split;
  }

  VertexSplit::Vertex read_vertex() {
    VertexSplit::Vertex vertex;
    vertex.parent = get<std::uint32_t>();
    require(vertex.parent < n_vertices_, "a split of a vertex that isn't there");
    vertex.original = get<std::uint32_t>();
    vertex.position = read_position();
    read_values(vertex.values);
    const auto n = get<std::uint32_t>();
    require(n <= n_triangles_, "a split that changes more triangles than there are");
    vertex.triangles.resize(n);
    get(vertex.triangles.data(), n * sizeof(std::uint32_t));
    require(std::all_of(vertex.triangles.begin(), vertex.triangles.end(),
                        [&](std::uint32_t t) { return t < n_triangles_; }),
            "a split that changes a triangle that isn't there");
    ++n_vertices_;
    return vertex;
  }

  InputFile file_;
  std::uint64_t hash_ = kFnvStart;
  std::vector<AttributeKind> kinds_;  // of the values of a vertex
  std::uint64_t n_vertices_ = 0;      // so far
  std::uint64_t n_triangles_ = 0;     // so far
};

}  // namespace

void write_progressive(const std::string& path, const ProgressiveSurface& progressive) {
  Writer writer(path);
  writer.put(kMagic);
  writer.put(kVersion);
  writer.put(static_cast<std::uint32_t>(progressive.base.attributes.size()));
  for (const SurfaceAttribute& attribute : progressive.base.attributes) {
    writer.put(static_cast<std::uint8_t>(attribute.kind));
    writer.put(static_cast<std::uint16_t>(attribute.name.size()));
    writer.put(attribute.name.data(), attribute.name.size());
  }
  writer.put(static_cast<std::uint32_t>(progressive.base.position.size()));
  writer.put(static_cast<std::uint32_t>(progressive.base.triangles.size()));
  writer.put(static_cast<std::uint64_t>(progressive.splits.size()));
  put_base(writer, progressive);
  writer.put_checksum();
  for (std::size_t i = 0; i < progressive.splits.size(); ++i) {
    put_split(writer, progressive.splits[i]);
    if ((i + 1) % kSplitsInBlock == 0 || i + 1 == progressive.splits.size()) writer.put_checksum();
  }
  writer.commit();
}

ProgressiveSurface read_progressive(const std::string& path, double max_triangles) {
  return Reader(path).read(max_triangles);
}

}  // namespace tinsmith
